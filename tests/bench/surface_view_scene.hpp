// SPDX-License-Identifier: MIT
// Bodies bounded by meshes through the API, as a cloud surface or as a volume of the same body, and
// pictures in 1/sr per unit irradiance as means over pixels' areas.
#pragma once

#include <vector>

#include "bench/surface_views.hpp"
#include "common/api.hpp"

namespace bench {

/// Means over the voxels of a box of what is inside, x fastest.
struct BodyVoxels {
  std::array<uint32_t, 3> size{};
  welkin::reference::Point low{};
  welkin::reference::Point edge{};  // of the box
  std::vector<float> cover;
};
/// About cubes, `across` of them along the box's longest edge, with an empty layer around.
BodyVoxels voxelsOf(const welkin::reference::MeshBody& body, uint32_t across);

/// How a body is shown.
struct SurfaceMethod {
  bool volume = false;      // or as a surface
  uint32_t voxels = 0;      // of a volume, along the longest edge
  uint32_t scattering = 0;  // WLK_SCATTERING_* of a volume
  uint32_t level = 2;       // WLK_QUALITY_*
  uint32_t resolution = 0;  // WLK_VOLUME_RESOLUTION_*
};

/// One context with one body and one view.
class SurfaceWorld {
 public:
  /// Light is scattered by this phase function.
  explicit SurfaceWorld(const CanonicalCurve& curve);
  ~SurfaceWorld();
  SurfaceWorld(const SurfaceWorld&) = delete;
  SurfaceWorld& operator=(const SurfaceWorld&) = delete;
  /// Takes the place of what was shown. `rays`: along a pixel's edge.
  void show(const SurfaceView& view, const BodyMesh& mesh, const SurfaceMethod& method,
            uint32_t rays);
  /// CPU time of all threads of the process, ms.
  double render();
  /// The light by `steps` millionths of a radian beside its place: what was kept is void.
  void turnLight(int steps);
  /// Gives the surface detail so deep, m, with lumps three times as large; 0 takes it away.
  void detail(double depth);
  /// GPU time of the last frame's passes of a kind, WLK_PASS_*, ms.
  [[nodiscard]] double passTime(uint32_t pass) const;
  /// Green of the last frame, one value per pixel of the view.
  [[nodiscard]] std::vector<double> picture() const;

 private:
  void clear();
  void addSurface(const BodyMesh& mesh);
  void addVolume(const BodyMesh& mesh, uint32_t voxels);

  host::LogCounter log_;  // outlives the context
  host::ContextPtr context_;
  WlkMedium medium_{};
  WlkSurface surface_{};
  WlkVolume volume_{};
  WlkView shown_{};
  SurfaceView view_;
  uint32_t rays_ = 1;
};

/// Of a picture against the truth, in the pixels of a region or in all (nullopt): ratio of the
/// sums, and rms of the difference over that of the truth, the truth's noise taken off. NaN if the
/// region is empty.
struct SurfaceErrors {
  double total = 0;
  double rms = 0;
  size_t pixels = 0;
};
SurfaceErrors surfaceErrorsIn(const std::vector<double>& picture, const SurfaceView& view,
                              const SurfaceTruthImage& truth, const SurfaceRegion* region);

}  // namespace bench
