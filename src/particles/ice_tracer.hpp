// SPDX-License-Identifier: MIT
// Light scattered by a hexagonal ice prism in random orientation, by geometric optics: energy per
// bin of the scattering angle, dimensionless (a share of the light that meets the crystal).
// Follows Macke, Mueller and Raschke 1996, J. Atmos. Sci. 53, 2813: rays split at every face into a
// reflected and a refracted part with the reflectance of unpolarised light. Neglected: the state of
// polarisation between two faces, absorption (below 1e-3 of visible light for crystals under 1 mm)
// and diffraction, which the caller adds. No Vulkan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace welkin {

// Roughness is the standard deviation of each of the two slopes by which a facet is tilted at every
// meeting with a ray (sigma of Macke's and Yang's formulas is sqrt(2) of it).
struct IceCrystal {
  double aspect = 1;     // length / (2 a), a = circumscribed radius of the hexagon; [0.01, 100]
  double roughness = 0;  // dimensionless; 0 = smooth, 0.03 slightly rough, 0.5 snow
};

struct IceTracing {
  size_t rays = 1'000'000;  // that hit the crystal; at least 1
  uint64_t seed = 0;        // another seed, another independent sample of the same size
  double minWeight = 1e-5;  // of the ray; what is left inside below it is counted as lost
};

struct IceScattering {
  std::vector<double> energy;    // per bin; the sum is 1 - deltaTransmission - lost
  std::vector<double> variance;  // of energy, as if all exits were independent of each other
  double deltaTransmission = 0;  // leaves within 1e-6 rad of where it went: through parallel faces
  double lost = 0;               // below minWeight or after 1000 reflections: 3e-6 to 5e-6
  double projectedArea = 0;      // mean over orientations, in a^2
  double asymmetry = 0;          // mean cosine of all that left the crystal
  double asymmetryOfBins = 0;    // the same without deltaTransmission
};

// Reflectance of unpolarised light (mean of both polarisations) at a plane; cosine of the angle of
// incidence in [0, 1], index of the far side relative to the near one. 1 in total reflection.
double fresnelReflectance(double cosine, double index);

// index: of ice relative to air, real, >= 1. edges: of the bins, rad, ascending from 0 to pi, at
// least 2; an angle on an edge belongs to the bin above. Same bits for the same arguments, which
// the caller has checked: with a NaN it would never end.
IceScattering traceIce(const IceCrystal& crystal, double index, std::span<const double> edges,
                       const IceTracing& tracing);

}  // namespace welkin
