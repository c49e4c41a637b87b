// SPDX-License-Identifier: MIT
// The scenes of volume_truth.hpp through the API: their volumes, lights and cameras, and pictures
// in 1/sr per unit irradiance as means over the truth's pixels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/volume_truth.hpp"
#include "common/api.hpp"
#include "common/camera.hpp"
#include "common/volume.hpp"

namespace bench {

/// One picture, or one direction through a slab, and what is true of it.
struct VolumeShot {
  std::string name;
  host::CameraDesc camera;
  TruthImage truth;
};

/// Shots of one volume in one light.
struct VolumeGroup {
  std::string name;
  std::string kind;  // "sphere", "cumulus", "les", "les-single", "slab"
  std::array<uint32_t, 3> size{};
  std::function<std::vector<float>()> extinction;  // 1/m, x fastest
  host::Affine place{};
  bool droplets = false;
  host::Vec3 sun;
  /// Rays along a pixel's edge. Point samples at silver rims would otherwise weigh more than the
  /// model's error: rms 27 % of a cumulus before the sun with 4, 21 % with 8.
  uint32_t perPixel = 1;
  std::vector<VolumeShot> shots;
};

/// Spheres, clouds and slabs of the folder's files; the cloud of a large-eddy simulation by its
/// data's file, if one is given.
std::vector<VolumeGroup> volumeGroups(const std::string& folder, const std::string& les);

struct VolumeFrame {
  double cpu_ms = 0;           // of all threads of the process
  bool lightComputed = false;  // else kept, or the form has none
};

/// One context with one volume and one view.
class VolumeWorld {
 public:
  // 0: the light buffer of the level.
  explicit VolumeWorld(uint32_t lightBufferSize = 0, uint32_t cells = 0);
  /// Takes the place of the volume and the view before.
  void show(const VolumeGroup& group, uint32_t level, uint32_t scattering);
  /// The light by `steps` millionths of a radian beside its place: what was kept is void.
  void turnLight(int steps);
  VolumeFrame render(const VolumeShot& shot);
  /// Green of the last frame, a value per pixel of the truth.
  [[nodiscard]] std::vector<double> picture() const;
  [[nodiscard]] WlkCapabilities capabilities() const;

 private:
  void clear();

  host::LogCounter log_;  // outlives the context
  host::ContextPtr context_;
  uint32_t lightBufferSize_;
  uint32_t cells_;
  const VolumeGroup* group_ = nullptr;
  uint32_t width_ = 0;
  uint32_t height_ = 0;
  WlkMedium medium_{};
  WlkVolume volume_{};
  WlkView view_{};
};

}  // namespace bench
