// SPDX-License-Identifier: MIT
// A bare loop with the fetches of the library's eye pass: the device's sample rate, for
// welkin_volume_cost.
#pragma once

#include "bench/volume_set.hpp"

namespace bench {

// As many fetches as the library's eye pass has at this number of slabs.
class BareLoop {
 public:
  BareLoop(Gpu& gpu, const GpuImage& density, const GpuImage& target, const Vec3& toLight,
           uint32_t slices, uint32_t lightSize);
  ~BareLoop();
  BareLoop(const BareLoop&) = delete;
  BareLoop& operator=(const BareLoop&) = delete;

  void record(VkCommandBuffer commands) const;

 private:
  Gpu& gpu_;
  GpuImage light_;
  VolumeSet set_;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  uint32_t size_;
};

}  // namespace bench
