// SPDX-License-Identifier: MIT
// Density per sr of directions close to the lights, in the shape of the scene's forward peaks.
//
// A path that happens to travel towards a light within a forward peak gets up to 1e5 times the
// usual light at its next collision; left to chance, this is all the noise. Paths are therefore
// branched into this density on purpose and with small weights (R. Buras and B. Mayer 2011,
// Efficient unbiased variance reduction techniques for Monte Carlo simulations of radiative
// transfer in cloudy atmospheres: the idea, not the form).
#pragma once

#include <vector>

#include "reference/monte_carlo.hpp"

namespace welkin::reference {

class LightLobe {
 public:
  explicit LightLobe(const Scene& scene);

  // Whether there is any peak in the channel. Else density is 0 and sample must not be called.
  bool empty(size_t channel) const { return peaks_[channel].empty(); }
  // 1/sr; integral over the sphere 1.
  double density(size_t channel, const Point& direction) const;
  Point sample(size_t channel, Random& random) const;

 private:
  // The part of a phase function next to the forward direction that is above PEAK.
  struct Peak {
    const PhaseFunction* phase;
    double edge;    // y
    double energy;  // within it
  };
  struct Light {
    Point direction;
    double share;
  };
  void add(const PhaseFunction& phase);

  std::vector<Light> lights_;
  std::vector<Peak> peaks_[3];
};

}  // namespace welkin::reference
