// SPDX-License-Identifier: MIT
// A cloud on the device, and the descriptor set that the passes in volume/ read: what the
// competitors of welkin_volume_cost share. Lengths in m.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bench/gpu.hpp"
#include "bench/volume_scene.hpp"

namespace bench {

VkShaderModule makeModule(VkDevice device, std::span<const uint32_t> code);

// Density of a cloud on the device, half precision.
GpuImage uploadCloud(Gpu& gpu, const Cloud& cloud);

// The engine's picture, black and in layout GENERAL, which a competitor then blends over.
void clearImage(VkCommandBuffer commands, VkImage image);

// As volume/scene.glsl has it.
struct SlicerScene {
  using Row = std::array<float, 4>;
  std::array<Row, 4> clipFromBox{};
  std::array<Row, 3> eye{};
  std::array<Row, 2> light{};
  Row axis{};
  Row optics{};
  Row right{};
  Row up{};
  Row forward{};
  Row toLight{};
  Row size{};
  std::array<Row, 3> box{};
  Row plane{};
};
SlicerScene slicerScene(const CloudSlabs& slabs, const Vec3& toLight, uint32_t size);

// One descriptor set over one scene: what both competitors need.
class VolumeSet {
 public:
  enum Binding : uint32_t { SCENE, DENSITY, LIGHT, EYE, LIGHT_VOLUME, TARGET, BINDINGS };
  VolumeSet(Gpu& gpu, const SlicerScene& scene, const std::array<GpuImage, BINDINGS>& images);
  ~VolumeSet();
  VolumeSet(const VolumeSet&) = delete;
  VolumeSet& operator=(const VolumeSet&) = delete;

  VkPipelineLayout layout() const { return layout_; }
  VkDescriptorSet handle() const { return set_; }
  void bind(VkCommandBuffer commands, VkPipelineBindPoint point) const;

 private:
  Gpu& gpu_;
  GpuBuffer scene_;
  VkSampler sampler_ = VK_NULL_HANDLE;  // at the edge
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

}  // namespace bench
