// SPDX-License-Identifier: MIT
// Canonical transport of light in a slab ([B08] section 5, Eq. 5): light of each set of scattering
// orders, where it came in, and how far from each other its ways came in. Radiance per unit
// irradiance on a surface facing the sun; lengths and depths optical; nothing is absorbed. By
// successive orders, the last set by a solution in one step (slab_tail.hpp). No Vulkan.
//
// x points along the light's horizontal direction of travel, depth downwards; a direction of travel
// has a cosine mu > 0 downwards and an azimuth phi against the light's.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tables/slab_tail.hpp"

namespace welkin {

constexpr size_t SLAB_SETS = 8;
// Scattering orders of set s: SLAB_ORDERS[s] .. SLAB_ORDERS[s + 1] - 1; the last set has no end.
constexpr std::array<int, SLAB_SETS> SLAB_ORDERS = {2, 3, 5, 7, 9, 13, 19, 31};

// What one set brings to a point from a direction.
struct SlabTransport {
  double radiance = 0;  // [B08] T
  double x = 0;         // [B08] c: mean entry point on the top, seen from the point
  double y = 0;
  double width = 0;  // [B08] sigma: root of the mean square distance from there, both axes
};

// Light along some directions at some depths, by modes.
class SlabLight {
 public:
  SlabTransport at(size_t lane, size_t direction, bool up, size_t depth, double phi) const;
  // Mean over the azimuth.
  double mean(size_t lane, size_t direction, bool up, size_t depth) const;

 private:
  friend class SlabOrders;
  size_t place(size_t lane, size_t direction, bool up, size_t depth) const;
  size_t directions_ = 0;
  size_t depths_ = 0;
  std::vector<std::vector<double>> intensity_;  // [m][up][direction][depth][lane]
  std::vector<std::vector<double>> shift_;      // [modes + m]
  std::vector<std::vector<double>> spread_;
};

class SlabOrders {
 public:
  // Cosines of at most SLAB_LANES suns' zenith angles, > 0. Modes whose light is below `dropped` of
  // the strongest's are left out from there on.
  SlabOrders(const SlabTail& tail, std::span<const double> suns, double dropped = 1e-7);

  // Light of a set along directions given by |mu|, both ways, at depths in [0, thickness].
  SlabLight light(size_t set, const SlabDirections& directions,
                  std::span<const double> depths) const;
  // Light scattered once, mean over the azimuth, along |mu|; from the series of the moments.
  double firstOrderMean(size_t lane, double mu, bool up, double depth) const;

  // What remains unsolved of the last set, of its largest moment; steps that it took.
  double residual() const { return residual_; }
  int steps() const { return steps_; }

 private:
  const SlabMedium& medium_;
  std::array<double, SLAB_LANES> suns_{};
  std::array<SlabMoments, SLAB_SETS> sources_;  // moments of the orders before, added up
  double residual_ = 0;
  int steps_ = 0;
};

}  // namespace welkin
