// SPDX-License-Identifier: MIT
// Rain drops as spheres, seen in the light of the sun's disk; radius 1 mm by default ([R04] Table
// 2: 2 pi r^2 = 6.28e-6 m^2). Real drops above 1 mm are flatter: their bows are wider apart.
#include <cmath>
#include <numbers>

#include "particles/phase_table.hpp"
#include "particles/size_distribution.hpp"
#include "particles/types/spectrum.hpp"

namespace welkin {
namespace {

constexpr double SPREAD = 0.25;

Particle makeRain(const ParticleParams& params) {
  Particle particle =
      tableParticle(RAIN_TABLE, false, params, [&](double tableWavelength, double wavelength) {
        return std::log(params.diameter_um * tableWavelength / wavelength);
      });
  const SizeDistribution sizes{SizeKind::LogNormal, params.diameter_um / 2, SPREAD};
  particle.optics.area_um2 = std::numbers::pi * meanPower(sizes, 2);
  particle.optics.effectiveRadius_um = effectiveRadius(sizes);
  return particle;
}

}  // namespace

const ParticleKind RAIN = {"rain", {100, 2000, 2000}, {SPREAD, SPREAD, SPREAD}, {}, true,
                           false,  makeRain};

}  // namespace welkin
