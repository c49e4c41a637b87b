// SPDX-License-Identifier: MIT
#include "bench/volume_set.hpp"

#include <cstring>

namespace bench {
namespace {

constexpr double NEAR_PLANE = 0.1;

using Row = SlicerScene::Row;

Row row(const Vec3& v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
          static_cast<float>(w)};
}

VkDescriptorType typeOf(uint32_t binding) {
  if (binding == VolumeSet::SCENE) {
    return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  }
  return binding == VolumeSet::TARGET ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                      : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

}  // namespace

VkShaderModule makeModule(VkDevice device, std::span<const uint32_t> code) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
  return module;
}

GpuImage uploadCloud(Gpu& gpu, const Cloud& cloud) {
  const auto n = static_cast<uint32_t>(CLOUD_VOXELS);
  const GpuImage image = gpu.makeImage(VK_FORMAT_R16_SFLOAT, {n, n, n});
  gpu.uploadBytes(image, std::as_bytes(std::span(cloud.halves)));
  return image;
}

void clearImage(VkCommandBuffer commands, VkImage image) {
  constexpr VkClearColorValue BLACK{{0, 0, 0, 1}};
  const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_GENERAL, &BLACK, 1, &all);
  VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  memory.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       0, 1, &memory, 0, nullptr, 0, nullptr);
}

SlicerScene slicerScene(const CloudSlabs& slabs, const Vec3& toLight, uint32_t size) {
  const Vec3 corner = cloudCorner();
  const double edge = CLOUD_EDGE;
  SlicerScene s;
  s.eye = {row({edge, 0, 0}, corner.x), row({0, edge, 0}, corner.y), row({0, 0, edge}, corner.z)};
  s.box = {row({1 / edge, 0, 0}, -corner.x / edge), row({0, 1 / edge, 0}, -corner.y / edge),
           row({0, 0, 1 / edge}, -corner.z / edge)};
  // Reversed infinite depth; columns are images of the box's axes and corner.
  const auto clip = [](const Vec3& p, double w) {
    return Row{static_cast<float>(p.x / CLOUD_TANGENT), static_cast<float>(-p.y / CLOUD_TANGENT),
               static_cast<float>(NEAR_PLANE * w), static_cast<float>(-p.z)};
  };
  s.clipFromBox = {clip({edge, 0, 0}, 0), clip({0, edge, 0}, 0), clip({0, 0, edge}, 0),
                   clip(corner, 1)};
  s.light = {row(slabs.u * edge, dot(corner, slabs.u) + slabs.uAt),
             row(slabs.v * edge, dot(corner, slabs.v) + slabs.vAt)};
  s.axis = row(slabs.axis, slabs.thickness);
  s.optics = {static_cast<float>(CLOUD_EXTINCTION), static_cast<float>(slabs.lightPath),
              static_cast<float>(CLOUD_G), static_cast<float>(1 / (EYE_STEP * slabs.thickness))};
  s.right = row({CLOUD_TANGENT, 0, 0}, 0);
  s.up = row({0, CLOUD_TANGENT, 0}, 0);
  s.forward = row({0, 0, -1}, 0);
  s.toLight = row(toLight, 0);
  const auto pixels = static_cast<float>(size);
  s.size = {pixels, pixels, 1 / pixels, 1 / pixels};
  s.plane = row(slabs.axis * (1 / slabs.thickness), slabs.offset);
  return s;
}

VolumeSet::VolumeSet(Gpu& gpu, const SlicerScene& scene,
                     const std::array<GpuImage, BINDINGS>& images)
    : gpu_(gpu), scene_(gpu.makeBuffer(sizeof scene, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)) {
  std::memcpy(scene_.data, &scene, sizeof scene);
  const VkDevice device = gpu.handle();
  VkSamplerCreateInfo filter{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  filter.magFilter = filter.minFilter = VK_FILTER_LINEAR;
  filter.addressModeU = filter.addressModeV = filter.addressModeW =
      VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  check(vkCreateSampler(device, &filter, nullptr, &sampler_), "vkCreateSampler");
  std::array<VkDescriptorSetLayoutBinding, BINDINGS> bindings{};
  std::array<VkDescriptorPoolSize, BINDINGS> sizes{};
  std::array<VkDescriptorImageInfo, BINDINGS> infos{};
  std::array<VkWriteDescriptorSet, BINDINGS> writes{};
  const VkDescriptorBufferInfo buffer{scene_.handle, 0, VK_WHOLE_SIZE};
  const VkImageView spare = images[DENSITY].view;
  for (uint32_t i = 0; i < BINDINGS; ++i) {
    bindings[i] = {
        i, typeOf(i), 1,
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT,
        nullptr};
    sizes[i] = {typeOf(i), 1};
    // The driver reads every binding of a set, also those that no shader of a pipeline has.
    const VkImageView view = images[i].view != VK_NULL_HANDLE ? images[i].view : spare;
    infos[i] = {sampler_, view, VK_IMAGE_LAYOUT_GENERAL};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = typeOf(i);
    writes[i].pImageInfo = &infos[i];
    writes[i].pBufferInfo = &buffer;
  }
  VkDescriptorSetLayoutCreateInfo layout{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  layout.bindingCount = BINDINGS;
  layout.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device, &layout, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout");
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = 1;
  pool.poolSizeCount = BINDINGS;
  pool.pPoolSizes = sizes.data();
  check(vkCreateDescriptorPool(device, &pool, nullptr, &pool_), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &setLayout_;
  check(vkAllocateDescriptorSets(device, &allocate, &set_), "vkAllocateDescriptorSets");
  for (uint32_t i = 0; i < BINDINGS; ++i) {
    writes[i].dstSet = set_;
  }
  vkUpdateDescriptorSets(device, BINDINGS, writes.data(), 0, nullptr);
  VkPipelineLayoutCreateInfo pipeline{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  pipeline.setLayoutCount = 1;
  pipeline.pSetLayouts = &setLayout_;
  check(vkCreatePipelineLayout(device, &pipeline, nullptr, &layout_), "vkCreatePipelineLayout");
}

VolumeSet::~VolumeSet() {
  const VkDevice device = gpu_.handle();
  vkDeviceWaitIdle(device);
  vkDestroyPipelineLayout(device, layout_, nullptr);
  vkDestroyDescriptorPool(device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(device, setLayout_, nullptr);
  vkDestroySampler(device, sampler_, nullptr);
}

void VolumeSet::bind(VkCommandBuffer commands, VkPipelineBindPoint point) const {
  vkCmdBindDescriptorSets(commands, point, layout_, 0, 1, &set_, 0, nullptr);
}

}  // namespace bench
