// SPDX-License-Identifier: MIT
// Fields of particles in a box of voxels: trilinear between voxel centres at (i + 0.5) / n of the
// unit box, constant beyond the outermost centres, nothing outside the box. Optical depths along a
// ray and distances to collisions, in m and 1/m.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/globe.hpp"
#include "reference/phase_function.hpp"
#include "reference/random.hpp"

namespace welkin::reference {

struct ParticleField {
  std::vector<float> values;  // >= 0, x fastest
  Rgb extinctionScale{};      // 1/m at value 1
  Rgb albedo{1, 1, 1};
  PhaseFunction phase = PhaseFunction::isotropic();
};

struct VoxelCollision {
  double distance;  // FAR: none
  size_t field;
};

class VoxelVolume {
 public:
  // worldFromBox: row-major 3x4, unit box to the world. Throws std::invalid_argument.
  VoxelVolume(const std::array<int, 3>& size, const std::array<double, 12>& worldFromBox,
              std::vector<ParticleField> fields);

  const std::vector<ParticleField>& fields() const { return fields_; }

  // Depth over the first `length` metres: along a straight line the extinction is a cubic in each
  // cell, for which two Gauss points are exact. Stops counting above `enough`.
  double opticalDepth(const Point& origin, const Point& direction, size_t channel, double length,
                      double enough = FAR) const;

  // Unbiased estimate of e^-depth by ratio tracking.
  double ratioTracking(const Point& origin, const Point& direction, size_t channel, double length,
                       Random& random) const;

  // By delta tracking against each brick's largest extinction.
  VoxelCollision collision(const Point& origin, const Point& direction, size_t channel,
                           double length, Random& random) const;

 private:
  struct Line;
  struct Brick;
  Line lineOf(const Point& origin, const Point& direction, double length) const;
  template <typename Visit>
  void eachBrick(const Line& line, Visit visit) const;
  double depthInBrick(const Line& line, size_t channel, double from, double to) const;
  double valueAt(const ParticleField& field, const Point& position) const;
  double extinctionAt(const Line& line, size_t channel, double t) const;

  std::array<int, 3> size_;
  std::array<int, 3> bricks_;
  std::array<double, 12> boxFromWorld_;
  std::vector<ParticleField> fields_;
  std::vector<std::array<float, 3>> majorant_;  // 1/m, per brick, not below the extinction in it
};

}  // namespace welkin::reference
