// SPDX-License-Identifier: MIT
// Light of a distant sun that one voxel field without absorption scatters, all orders, by Monte
// Carlo: 1/sr per unit irradiance normal to the beam. Does what reference/path_tracer does, for
// this case only and ten times as fast; volume_truth_test compares the two.
//
// Paths start at the eye; at each collision the sun is sampled. For a sun in direction +z of the
// box the depth to it is a closed form: along an axis a trilinear field is a line in each cell, and
// four columns' running integrals hold all of it. Other suns take the reference's sum over cells.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "reference/phase_function.hpp"
#include "reference/random.hpp"
#include "reference/vector.hpp"
#include "reference/voxels.hpp"

namespace bench {

// Trilinear between voxel centres at (i + 0.5) / n of a box around 0, constant beyond the outermost
// centres, nothing outside the box.
class VoxelBox {
 public:
  // extent: in any unit of length; extinction: 1 / that unit, x fastest.
  VoxelBox(const std::array<int, 3>& size, const welkin::reference::Point& extent,
           std::vector<float> extinction);

  // Voxel i has its centre at i, here and below.
  welkin::reference::Point voxelsFrom(const welkin::reference::Point& position) const;
  double at(const welkin::reference::Point& p) const;
  // Optical depth along +z to the box's face.
  double depthAlongZ(const welkin::reference::Point& p) const;

 private:
  friend class VolumeTracer;
  struct Cell {
    std::array<size_t, 4> column{};
    std::array<double, 4> weight{};
    size_t low = 0;
    size_t high = 0;
    double f = 0;
  };
  Cell cellOf(const welkin::reference::Point& p) const;
  void findMajorants();

  std::array<int, 3> size_;
  std::array<int, 3> bricks_{};
  welkin::reference::Point extent_;
  welkin::reference::Point scale_{};  // voxels per unit of length
  std::vector<float> extinction_;
  std::vector<float> byColumn_;   // the same, z fastest
  std::vector<double> integral_;  // from each centre to the face at +z, z fastest
  std::vector<float> majorant_;   // per brick
};

// Sums over paths.
struct Sample {
  double value = 0;
  double square = 0;
  uint64_t paths = 0;
  double mean() const { return value / static_cast<double>(paths); }
  double error() const;  // standard, of the mean
};

struct TracerRay {
  welkin::reference::Point origin;     // in the box's unit of length
  welkin::reference::Point direction;  // unit vector
};

class VolumeTracer {
 public:
  // sun: unit vector towards it.
  VolumeTracer(const VoxelBox& box, const welkin::reference::PhaseFunction& phase,
               const welkin::reference::Point& sun);
  // `count` paths, each along a ray of its own. The same numbers for the same seed and pixel.
  Sample trace(const std::function<TracerRay(welkin::reference::Random&)>& ray, uint64_t count,
               uint64_t seed, uint64_t pixel) const;

 private:
  struct Path {
    welkin::reference::Point position;   // voxel coordinates
    welkin::reference::Point direction;  // unit vector in space
    double share = 1;
  };
  bool collide(Path& path, welkin::reference::Random& random) const;
  bool keep(Path& path, double share, double lobe, welkin::reference::Random& random) const;
  double lobeDensity(double y) const;
  double depthToSun(const welkin::reference::Point& position, double enough) const;

  const VoxelBox& box_;
  const welkin::reference::PhaseFunction& phase_;
  welkin::reference::Point sun_;
  std::optional<welkin::reference::VoxelVolume> slanted_;  // for suns that are not in +z
  double lobeEdge_ = 0;                                    // y
  double lobeEnergy_ = 0;                                  // of the phase function within it
};

}  // namespace bench
