// SPDX-License-Identifier: MIT
#include "bench/volume_bare.hpp"

#include <span>
#include <vector>

#include "volume_bare_comp_spv.h"

namespace bench {
namespace {

constexpr uint32_t GROUP = 8;

}  // namespace

BareLoop::BareLoop(Gpu& gpu, const GpuImage& density, const GpuImage& target, const Vec3& toLight,
                   uint32_t slices, uint32_t lightSize)
    : gpu_(gpu),
      light_(gpu.makeImage(VK_FORMAT_R32_SFLOAT, {lightSize, lightSize, slices + 1})),
      set_(gpu,
           slicerScene(cloudSlabs(toLight * -1.0, toLight, slices, lightSize), toLight,
                       target.extent.width),
           {GpuImage{}, density, GpuImage{}, GpuImage{}, light_, target}),
      size_(target.extent.width) {
  const std::vector<float> values(size_t{lightSize} * lightSize * (slices + 1), 0.5f);
  gpu.uploadBytes(light_, std::as_bytes(std::span(values)));
  const VkDevice device = gpu.handle();
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = makeModule(device, volume_bare_comp_spv);
  info.stage.pName = "main";
  info.layout = set_.layout();
  const VkResult result =
      vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
  vkDestroyShaderModule(device, info.stage.module, nullptr);
  check(result, "vkCreateComputePipelines");
}

BareLoop::~BareLoop() {
  vkDeviceWaitIdle(gpu_.handle());
  vkDestroyPipeline(gpu_.handle(), pipeline_, nullptr);
}

void BareLoop::record(VkCommandBuffer commands) const {
  set_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  const uint32_t groups = (size_ + GROUP - 1) / GROUP;
  vkCmdDispatch(commands, groups, groups, 1);
}

}  // namespace bench
