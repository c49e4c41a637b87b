// SPDX-License-Identifier: MIT
#include "bench/sky_forms.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "form_flat_spv.h"
#include "form_none_spv.h"
#include "form_segments_spv.h"
#include "reference/phase_function.hpp"
#include "reference/planet.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr uint32_t GROUP = 8;  // edge of a workgroup
constexpr double SINGLE_TOLERANCE = 1e-5;

enum Binding : uint32_t { SCENE, DEPTH, COLOR, TARGET, BINDINGS };

VkDescriptorType typeOf(uint32_t binding) {
  if (binding == SCENE) {
    return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  }
  return binding == TARGET ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                           : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

std::span<const uint32_t> codeOf(SkyForm::Kind kind) {
  switch (kind) {
    case SkyForm::FLAT:
      return form_flat_spv;
    case SkyForm::SEGMENTS:
      return form_segments_spv;
    default:
      return form_none_spv;
  }
}

}  // namespace

SkyForm::SkyForm(Gpu& gpu, const GpuTargets& targets, Kind kind)
    : gpu_(gpu), width_(targets.target.extent.width), height_(targets.target.extent.height) {
  scene_ = gpu.makeBuffer(sizeof(LutScene), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  makeSet(targets);
  makePipeline(kind);
}

SkyForm::~SkyForm() {
  const VkDevice device = gpu_.handle();
  vkDeviceWaitIdle(device);
  vkDestroyPipeline(device, pipeline_, nullptr);
  vkDestroyPipelineLayout(device, layout_, nullptr);
  vkDestroyDescriptorPool(device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(device, setLayout_, nullptr);
  vkDestroySampler(device, sampler_, nullptr);
}

void SkyForm::makeSet(const GpuTargets& targets) {
  const VkDevice device = gpu_.handle();
  const VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
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
       {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2},
       {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}}};
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

void SkyForm::makePipeline(Kind kind) {
  const VkDevice device = gpu_.handle();
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  check(vkCreatePipelineLayout(device, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
  const std::span<const uint32_t> code = codeOf(kind);
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
  info.layout = layout_;
  const VkResult result =
      vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
  vkDestroyShaderModule(device, module, nullptr);
  check(result, "vkCreateComputePipelines");
}

void SkyForm::setScene(const LutScene& scene) {
  LutScene filled = scene;
  filled.size = {static_cast<float>(width_), static_cast<float>(height_),
                 1 / static_cast<float>(width_), 1 / static_cast<float>(height_)};
  std::memcpy(scene_.data, &filled, sizeof filled);
}

void SkyForm::record(VkCommandBuffer commands) const {
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0,
                          nullptr);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vkCmdDispatch(commands, (width_ + GROUP - 1) / GROUP, (height_ + GROUP - 1) / GROUP, 1);
}

GpuCounts SkyForm::counts() const {
  GpuCounts counts;
  counts.dispatches = 1;
  counts.invocations =
      uint64_t{GROUP} * GROUP * ((width_ + GROUP - 1) / GROUP) * ((height_ + GROUP - 1) / GROUP);
  return counts;
}

SingleTruth singleTruth(const SkyCase& one, const std::vector<SkyPixel>& pixels,
                        const std::vector<SkyTruth>& truths) {
  const host::Vec3 sun = sunDirection(one);
  rt::Planet planet;
  planet.radius = SKY_PLANET_RADIUS;
  planet.airScattering = SKY_SCATTERING;
  planet.airScaleHeight = SKY_SCALE_HEIGHT;
  SingleTruth result;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const double viewSun = host::dot(pixels[i].direction, sun);
    SkyTruth truth;
    truth.radiance = rt::inscatter(
        planet, {one.altitude, pixels[i].direction.y, sun.y, viewSun, pixels[i].distance},
        rt::PhaseFunction::rayleigh().value(0, 1 - viewSun), 0, 0, SINGLE_TOLERANCE);
    truth.transmittance = truths[i].transmittance;
    if (*std::min_element(truth.radiance.begin(), truth.radiance.end()) >= DARKEST_SINGLE) {
      result.pixels.push_back(pixels[i]);
      result.truths.push_back(truth);
    }
  }
  return result;
}

}  // namespace bench
