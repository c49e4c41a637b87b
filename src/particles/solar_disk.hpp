// SPDX-License-Identifier: MIT
// Convolution of a function of the scattering angle with the sun's disk, as sums over angles.
#pragma once

#include <numbers>
#include <span>
#include <vector>

namespace welkin {

constexpr double SUN_RADIUS = 959.63 / 3600 * std::numbers::pi / 180;  // rad, at mean distance

// Angles (rad, [0, pi]) to evaluate, and how to add the values up to those at the angles asked for:
// value[i] = sum of weight[j] f(angles[j]), j in [begin[i], begin[i + 1]). Each i's weights add up
// to 1.
struct AnglePlan {
  std::vector<double> angles;
  std::vector<double> weight;
  std::vector<size_t> begin;
};

// The function itself.
AnglePlan pointPlan(std::span<const double> angles);

// Its mean over a uniform disk of SUN_RADIUS (no limb darkening): 8 angles each, 48 to 96 within 4
// radii of 0 and pi, where diffraction peaks narrower than the disk are resolved.
AnglePlan solarDiskPlan(std::span<const double> angles);

}  // namespace welkin
