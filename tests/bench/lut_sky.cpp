// SPDX-License-Identifier: MIT
#include "bench/lut_sky.hpp"

#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "lut_composite_spv.h"
#include "lut_froxels_spv.h"
#include "lut_scattering_spv.h"
#include "lut_sky_view_spv.h"
#include "lut_transmittance_spv.h"

namespace bench {
namespace {

constexpr uint32_t GROUP = 8;  // edge of a workgroup

// In the order of Pass.
constexpr std::array<VkExtent3D, LutSky::COMPOSITE> SIZES = {
    {{256, 64, 1}, {32, 32, 1}, {192, 108, 1}, {32, 32, 32}}};

// Bindings: scene, tables sampled, depth, colour, tables stored, target.
constexpr uint32_t FIRST_SAMPLED = 1;
constexpr uint32_t DEPTH = 5;
constexpr uint32_t COLOR = 6;
constexpr uint32_t FIRST_STORED = 7;
constexpr uint32_t TARGET = 11;
constexpr uint32_t BINDINGS = 12;

std::span<const uint32_t> codeOf(LutSky::Pass pass) {
  switch (pass) {
    case LutSky::TRANSMITTANCE:
      return lut_transmittance_spv;
    case LutSky::SCATTERING:
      return lut_scattering_spv;
    case LutSky::SKY_VIEW:
      return lut_sky_view_spv;
    case LutSky::FROXELS:
      return lut_froxels_spv;
    default:
      return lut_composite_spv;
  }
}

VkDescriptorType typeOf(uint32_t binding) {
  if (binding == 0) {
    return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  }
  return binding < FIRST_STORED ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

}  // namespace

LutSky::LutSky(Gpu& gpu, const GpuTargets& targets, const LutOptions& options)
    : gpu_(gpu),
      texelBytes_(options.singlePrecision ? 16 : 8),
      width_(targets.target.extent.width),
      height_(targets.target.extent.height) {
  const VkFormat format =
      options.singlePrecision ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
  for (uint32_t i = 0; i < COMPOSITE; ++i) {
    tables_[i] = gpu.makeImage(format, SIZES[i]);
    groups_[i] = {(SIZES[i].width + GROUP - 1) / GROUP, (SIZES[i].height + GROUP - 1) / GROUP};
  }
  groups_[COMPOSITE] = {(width_ + GROUP - 1) / GROUP, (height_ + GROUP - 1) / GROUP};
  scene_ = gpu.makeBuffer(sizeof(LutScene), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  makeSet(targets);
  makePipelines(options);
  VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = PASS_COUNT + 1;
  check(vkCreateQueryPool(gpu.handle(), &queries, nullptr, &queries_), "vkCreateQueryPool");
}

LutSky::~LutSky() {
  const VkDevice device = gpu_.handle();
  vkDeviceWaitIdle(device);
  vkDestroyQueryPool(device, queries_, nullptr);
  for (VkPipeline pipeline : pipelines_) {
    vkDestroyPipeline(device, pipeline, nullptr);
  }
  vkDestroyPipelineLayout(device, layout_, nullptr);
  vkDestroyDescriptorPool(device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(device, setLayout_, nullptr);
  vkDestroySampler(device, sampler_, nullptr);
}

void LutSky::makeSet(const GpuTargets& targets) {
  const VkDevice device = gpu_.handle();
  VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW =
      VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  check(vkCreateSampler(device, &sampler, nullptr, &sampler_), "vkCreateSampler");
  std::array<VkDescriptorSetLayoutBinding, BINDINGS> bindings{};
  for (uint32_t i = 0; i < BINDINGS; ++i) {
    bindings[i] = {i, typeOf(i), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo layout{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  layout.bindingCount = BINDINGS;
  layout.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device, &layout, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout");
  const std::array<VkDescriptorPoolSize, 3> sizes = {
      {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
       {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, FIRST_STORED - FIRST_SAMPLED},
       {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, BINDINGS - FIRST_STORED}}};
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = 1;
  pool.poolSizeCount = static_cast<uint32_t>(sizes.size());
  pool.pPoolSizes = sizes.data();
  check(vkCreateDescriptorPool(device, &pool, nullptr, &pool_), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &setLayout_;
  check(vkAllocateDescriptorSets(device, &allocate, &set_), "vkAllocateDescriptorSets");

  const VkDescriptorBufferInfo buffer{scene_.handle, 0, VK_WHOLE_SIZE};
  std::array<VkDescriptorImageInfo, BINDINGS> images{};
  for (uint32_t i = 0; i < COMPOSITE; ++i) {
    images[FIRST_SAMPLED + i].imageView = tables_[i].view;
    images[FIRST_STORED + i].imageView = tables_[i].view;
  }
  images[DEPTH].imageView = targets.depth.view;
  images[COLOR].imageView = targets.color.view;
  images[TARGET].imageView = targets.target.view;
  std::array<VkWriteDescriptorSet, BINDINGS> writes{};
  for (uint32_t i = 0; i < BINDINGS; ++i) {
    images[i].sampler = sampler_;
    images[i].imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set_;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = typeOf(i);
    writes[i].pImageInfo = &images[i];
    writes[i].pBufferInfo = &buffer;
  }
  vkUpdateDescriptorSets(device, BINDINGS, writes.data(), 0, nullptr);
}

void LutSky::makePipelines(const LutOptions& options) {
  const VkDevice device = gpu_.handle();
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  check(vkCreatePipelineLayout(device, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
  const VkSpecializationMapEntry entry{0, 0, sizeof(float)};
  const VkSpecializationInfo constants{1, &entry, sizeof(float), &options.sampleAt};
  for (uint32_t i = 0; i < PASS_COUNT; ++i) {
    const std::span<const uint32_t> code = codeOf(static_cast<Pass>(i));
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = code.size_bytes();
    moduleInfo.pCode = code.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device, &moduleInfo, nullptr, &module), "vkCreateShaderModule");
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &constants;
    info.layout = layout_;
    const VkResult result =
        vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipelines_[i]);
    vkDestroyShaderModule(device, module, nullptr);
    check(result, "vkCreateComputePipelines");
  }
}

void LutSky::setScene(const LutScene& scene) {
  LutScene filled = scene;
  filled.size = {static_cast<float>(width_), static_cast<float>(height_),
                 1 / static_cast<float>(width_), 1 / static_cast<float>(height_)};
  const double radius = double{scene.irradiance[3]};
  const double dip = std::acos(radius / (radius + double{scene.ground[3]}));
  const double flat = std::hypot(double{scene.light[0]}, double{scene.light[2]});
  filled.horizon = {static_cast<float>(std::numbers::pi / 2 + dip),
                    static_cast<float>(std::numbers::pi / 2 - dip),
                    static_cast<float>(flat > 0 ? double{scene.light[0]} / flat : 1),
                    static_cast<float>(flat > 0 ? double{scene.light[2]} / flat : 0)};
  std::memcpy(scene_.data, &filled, sizeof filled);
}

void LutSky::record(VkCommandBuffer commands, Pass first) {
  first_ = first;
  vkCmdResetQueryPool(commands, queries_, 0, PASS_COUNT + 1);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0,
                          nullptr);
  vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, first);
  for (uint32_t i = first; i < PASS_COUNT; ++i) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_[i]);
    vkCmdDispatch(commands, groups_[i][0], groups_[i][1], 1);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, i + 1);
  }
}

GpuCounts LutSky::counts() const {
  std::array<uint64_t, PASS_COUNT + 1> ticks{};
  const uint32_t count = PASS_COUNT + 1 - first_;
  check(vkGetQueryPoolResults(gpu_.handle(), queries_, first_, count, count * sizeof ticks[0],
                              &ticks[first_], sizeof ticks[0], VK_QUERY_RESULT_64_BIT),
        "vkGetQueryPoolResults");
  GpuCounts counts;
  counts.dispatches = PASS_COUNT - first_;
  for (uint32_t i = first_; i < PASS_COUNT; ++i) {
    counts.invocations += uint64_t{GROUP} * GROUP * groups_[i][0] * groups_[i][1];
    counts.passes_ms.emplace_back(PASS_NAMES[i],
                                  1e-6 * double{gpu_.properties().limits.timestampPeriod} *
                                      static_cast<double>(ticks[i + 1] - ticks[i]));
  }
  for (const VkExtent3D& size : SIZES) {
    counts.bytes += texelBytes_ * size.width * size.height * size.depth;
  }
  return counts;
}

}  // namespace bench
