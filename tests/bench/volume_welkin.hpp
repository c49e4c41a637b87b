// SPDX-License-Identifier: MIT
// The library as an engine uses it, for the clouds of welkin_volume_cost.
#pragma once

#include <cstdint>
#include <deque>
#include <welkin/welkin.hpp>

#include "bench/gpu.hpp"
#include "bench/volume_scene.hpp"

namespace bench {

struct WelkinVolumeOptions {
  uint32_t slices = 0;  // 0: those of the level HIGH, as is the light buffer's size
  uint32_t lightSize = 0;
  uint32_t views = 1;        // side by side, 6 cm apart
  bool fresh = false;        // light is computed in every frame
  bool half = false;         // rays of some pixels
  uint32_t deep = 1;         // the volume in clouds' edges, all but the nearest of them empty
  bool emptyVolume = false;  // a second volume that holds nothing
  // The default sky and orders of scattering, and the cloud below the horizon in the picture.
  bool underSky = false;
};

class WelkinVolume {
 public:
  // Draws into `target`, over black. `cloud` may be null.
  WelkinVolume(Gpu& gpu, const GpuImage& target, const Cloud* cloud, const Vec3& toLight,
               const WelkinVolumeOptions& options);

  // A frame of all views, the one before complete.
  void record(VkCommandBuffer commands);
  // Of the last frame but for the times, which are those of the one before.
  GpuCounts counts(size_t view = 0) const;
  // Commands recorded for each pass of a view, volumes together.
  std::vector<std::pair<std::string, uint32_t>> commands(size_t view) const;

 private:
  void addVolume(const Cloud* cloud, uint32_t deep);
  std::vector<WlkPassStats> passes(size_t view, WlkFrameStats& stats) const;

  welkin::Context context_;
  std::vector<WlkView> views_;
  std::deque<WlkVulkanImage> targets_;
  uint64_t frame_ = 0;
};

}  // namespace bench
