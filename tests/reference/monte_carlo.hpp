// SPDX-License-Identifier: MIT
// Radiance along rays by Monte Carlo integration of the radiative transfer equation: any number of
// scatterings in layers and voxels, reflection at the ground. Unbiased; the error is the
// statistical one, which is estimated with each value. Unit: that of the lights' irradiance per sr.
//
// Paths start at the eye. In each component a collision distance is drawn on its own; the nearest
// one is the path's, since the smallest of independent exponential optical depths is distributed as
// the depth of the sum. At each collision the lights are sampled (next-event estimation). A layer
// that absorbs only is never hit: on each stretch of a path its transmittance is a factor.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "reference/globe.hpp"
#include "reference/layers.hpp"
#include "reference/voxels.hpp"

namespace welkin::reference {

struct DistantLight {
  Point direction{0, 1, 0};  // unit vector towards it
  Rgb irradiance{1, 1, 1};   // on a surface facing it
  // Full angle of a disk of uniform radiance, rad; 0: a point, which no ray sees.
  double angularDiameter = 0;
  // Whether the disk's size counts for scattering and reflection, or only for the rays that see it.
  bool blurs = false;
};

struct Scene {
  Globe globe;
  bool ground = false;  // Lambertian, at altitude 0
  Rgb groundAlbedo{};
  std::vector<ExponentialLayer> layers;
  std::vector<UniformLayer> uniformLayers;  // need a flat globe
  std::vector<AbsorbingLayer> absorbers;
  std::vector<VoxelVolume> volumes;
  std::vector<DistantLight> lights;
  Rgb environment{};  // radiance from everywhere outside

  // Whether red, green and blue take the same paths.
  bool grey() const;
};

struct EyeRay {
  Point origin;
  Point direction;  // unit vector
  double length =
      FAR;           // to something opaque; only this ray sees it, scattered light passes through
  Rgb background{};  // its radiance
};

enum class Shadow {
  // Optical depths, exactly up to SHADOW_DEPTH; beyond it light survives with probability
  // e^(SHADOW_DEPTH - depth), which has the right mean and spares the way through the rest.
  EXACT,
  // Ratio tracking in voxels, for comparison.
  RATIO_TRACKING
};
constexpr double SHADOW_DEPTH = 5;

constexpr uint32_t ALL_ORDERS = UINT32_MAX;

struct RenderOptions {
  uint64_t samples = 64;  // paths per ray, and per channel unless the scene is grey
  uint64_t seed = 1;
  // Scatterings and reflections that count: order 0 is the lights' disks, the background and the
  // environment seen directly.
  uint32_t firstOrder = 0;
  uint32_t lastOrder = ALL_ORDERS;
  Shadow shadow = Shadow::EXACT;
  unsigned threads = 0;                  // 0: all cores. The result is the same, bit by bit
  std::function<void(double)> progress;  // part done, from one thread at a time
};

struct Estimate {
  Rgb radiance{};
  Rgb variance{};       // of the mean: squared standard error
  Rgb transmittance{};  // of the whole ray, exact; 0 at the ground
};

struct RenderResult {
  std::vector<Estimate> pixels;
  uint64_t paths = 0;   // a grey path serves three channels and counts once
  uint64_t events = 0;  // scatterings and reflections
};

// What does not vary is not sampled: disks, background, environment and sunlit ground seen
// directly. Throws std::invalid_argument if the scene is not one.
RenderResult render(const Scene& scene, const std::vector<EyeRay>& rays,
                    const RenderOptions& options);

}  // namespace welkin::reference
