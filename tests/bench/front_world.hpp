// SPDX-License-Identifier: MIT
// A context with a case's scene in it, and views of that scene.
#pragma once

#include <vector>

#include "bench/front_methods.hpp"
#include "common/apply.hpp"

namespace bench {

/// What one frame recorded and held.
struct FrameCounts {
  uint32_t dispatches = 0;
  uint32_t draws = 0;
  uint32_t barriers = 0;
  uint64_t invocations = 0;
  /// Invocations of the passes over volumes; times slabs per batch, steps through voxels.
  uint64_t volumeInvocations = 0;
  uint64_t deviceMemory = 0;
  uint64_t hostMemory = 0;
  /// Pixels that were not finite before the library's own guard.
  uint64_t nonFinite = 0;
  /// Sum over the passes. ns.
  uint64_t gpuTime_ns = 0;
};

class World {
 public:
  World(const Case& one, bool analytic, bool ambient = true);

  /// Every view of it needs prepare() before it renders. Its edges are `scale` times the case's.
  WlkView addView(const WlkQuality& quality, uint32_t scale = 1);
  void removeView(WlkView view);
  void prepare();

  void render(WlkView view, const host::RasterResult& opaque);
  [[nodiscard]] host::Image read(WlkView view) const;
  [[nodiscard]] FrameCounts counts(WlkView view) const;
  [[nodiscard]] WlkErrorEstimate estimate(WlkView view) const;

  /// The opaque picture as this scene's air lights it, for views of that scale.
  [[nodiscard]] host::RasterResult makeOpaque(uint32_t scale = 1) const;
  [[nodiscard]] const host::Scene& scene() const { return scene_; }
  [[nodiscard]] WlkCapabilities capabilities() const;

 private:
  host::Scene scene_;
  host::LogCounter log_;  // outlives the context
  host::ContextPtr context_;
};

}  // namespace bench
