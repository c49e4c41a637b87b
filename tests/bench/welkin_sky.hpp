// SPDX-License-Identifier: MIT
// The library as an engine uses it, for one case of welkin_sky_cost.
#pragma once

#include <cstdint>
#include <welkin/welkin.hpp>

#include "bench/gpu.hpp"
#include "bench/sky_cost_scene.hpp"

namespace bench {

class WelkinSky {
 public:
  // Moving: every frame from a centimetre further on, so that nothing of the last one can be kept.
  WelkinSky(const Gpu& gpu, const GpuTargets& targets, const SkyCase& one, uint32_t scattering,
            bool moving);

  // A frame, the one before complete.
  void record(VkCommandBuffer commands);
  // Of the last frame but for the times, which are those of the one before. Bytes: all device
  // memory of the context.
  GpuCounts counts() const;

 private:
  welkin::Context context_;
  WlkView view_{};
  WlkCamera camera_{};
  bool moving_;
  uint64_t frame_ = 0;
  WlkVulkanImage depth_{};
  WlkVulkanImage color_{};
  WlkVulkanImage target_{};
};

}  // namespace bench
