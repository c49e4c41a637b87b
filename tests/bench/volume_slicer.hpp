// SPDX-License-Identifier: MIT
// Half-angle slicing of a volume as [R04] publishes it, one pair of draws per slice, in its best
// form, for comparison only. Slice polygons are clipped to the volume's box on the CPU in every
// frame; the light buffer holds optical depth, to which blending adds each slice in place; light is
// that of the slab's middle and opacity 1 - e^-x. Radiance per unit irradiance, RGB, and
// transmittance.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/volume_set.hpp"

namespace bench {

class Slicer {
 public:
  // Draws into `target`, RGBA32F with COLOR_ATTACHMENT usage.
  Slicer(Gpu& gpu, const GpuImage& density, const GpuImage& target, const Vec3& toLight,
         uint32_t slices, uint32_t lightSize);
  ~Slicer();
  Slicer(const Slicer&) = delete;
  Slicer& operator=(const Slicer&) = delete;

  void record(VkCommandBuffer commands);
  uint32_t draws() const { return draws_; }
  const GpuImage& target() const { return target_; }

 private:
  struct Polygon {
    uint32_t first;
    uint32_t count;
  };
  enum Pipe : uint32_t { EYE, LIGHT, RESOLVE, PIPES };
  void makePipelines();
  std::vector<Polygon> cutPolygons() const;

  Gpu& gpu_;
  GpuImage target_;
  GpuImage light_;
  GpuImage eye_;
  CloudSlabs slabs_;
  uint32_t slices_;
  bool towardsEye_;  // later slices are nearer to the eye
  VolumeSet set_;
  GpuBuffer corners_;
  std::array<VkPipeline, PIPES> pipelines_{};
  uint32_t draws_ = 0;
};

}  // namespace bench
