// SPDX-License-Identifier: MIT
// The sky that game engines have in common, from tables on the GPU, for comparison only: passes in
// lut/, after S. Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering
// Technique (EGSR). Written from the paper, for air of one species that only scatters. Lengths in
// m, radiance in irradiance of the light per sr.
#pragma once

#include <array>
#include <cstdint>

#include "bench/gpu.hpp"

namespace bench {

// As lut/air.glsl has it.
struct LutScene {
  std::array<float, 4> right{};
  std::array<float, 4> up{};
  std::array<float, 4> forward{};
  std::array<float, 4> size{};
  std::array<float, 4> light{};
  std::array<float, 4> irradiance{};
  std::array<float, 4> scattering{};
  std::array<float, 4> ground{};
  std::array<float, 4> horizon{};
};

struct LutOptions {
  // Where in a step the air is sampled; 0.5 is more accurate.
  float sampleAt = 0.3f;
  // Of the tables, else half as published.
  bool singlePrecision = false;
};

class LutSky {
 public:
  enum Pass : uint32_t { TRANSMITTANCE, SCATTERING, SKY_VIEW, FROXELS, COMPOSITE, PASS_COUNT };
  static constexpr std::array<const char*, PASS_COUNT> PASS_NAMES = {
      "transmittance", "multiple scattering", "sky view", "froxels", "composite"};

  LutSky(Gpu& gpu, const GpuTargets& targets, const LutOptions& options = {});
  ~LutSky();
  LutSky(const LutSky&) = delete;
  LutSky& operator=(const LutSky&) = delete;

  // Fills in what follows from the rest (`horizon`, `size`).
  void setScene(const LutScene& scene);
  // A frame: all passes from `first` on.
  void record(VkCommandBuffer commands, Pass first = TRANSMITTANCE);
  // Of the last frame, which must have run. Bytes: those of the tables.
  GpuCounts counts() const;
  const GpuImage& table(Pass pass) const { return tables_[pass]; }

 private:
  void makeSet(const GpuTargets& targets);
  void makePipelines(const LutOptions& options);

  Gpu& gpu_;
  std::array<GpuImage, COMPOSITE> tables_;
  GpuBuffer scene_;
  std::array<std::array<uint32_t, 2>, PASS_COUNT> groups_{};
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::array<VkPipeline, PASS_COUNT> pipelines_{};
  VkQueryPool queries_ = VK_NULL_HANDLE;
  Pass first_ = TRANSMITTANCE;
  uint64_t texelBytes_;
  uint32_t width_;
  uint32_t height_;
};

}  // namespace bench
