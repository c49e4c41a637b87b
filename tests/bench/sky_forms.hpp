// SPDX-License-Identifier: MIT
// Forms of the sky that every pixel computes for itself, one dispatch each, for welkin_sky_cost:
// the flat closed form and the two-ended segments, both of light scattered once. And that light's
// truth. Radiance in irradiance of the light per sr.
#pragma once

#include <vector>

#include "bench/lut_sky.hpp"
#include "bench/sky_truth.hpp"

namespace bench {

class SkyForm {
 public:
  // NONE: no air, what the picture costs by itself. Shaders in forms/.
  enum Kind : uint32_t { NONE, FLAT, SEGMENTS };

  SkyForm(Gpu& gpu, const GpuTargets& targets, Kind kind);
  ~SkyForm();
  SkyForm(const SkyForm&) = delete;
  SkyForm& operator=(const SkyForm&) = delete;

  void setScene(const LutScene& scene);
  // A frame.
  void record(VkCommandBuffer commands) const;
  // No tables, so no bytes.
  GpuCounts counts() const;

 private:
  void makeSet(const GpuTargets& targets);
  void makePipeline(Kind kind);

  Gpu& gpu_;
  GpuBuffer scene_;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  uint32_t width_;
  uint32_t height_;
};

// Light scattered once by quadrature, with the transmittance of `truths`, for pixels that have any:
// the others (darker than DARKEST_SINGLE in a colour, in the planet's shadow) are left out of both
// lists.
constexpr double DARKEST_SINGLE = 1e-5;
struct SingleTruth {
  std::vector<SkyPixel> pixels;
  std::vector<SkyTruth> truths;
};
SingleTruth singleTruth(const SkyCase& one, const std::vector<SkyPixel>& pixels,
                        const std::vector<SkyTruth>& truths);

}  // namespace bench
