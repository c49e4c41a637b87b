// SPDX-License-Identifier: MIT
#include "tables/canonical_phase.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particles/mie_average.hpp"
#include "tables/angular_moments.hpp"

namespace welkin {
namespace {

constexpr double RADIANS = std::numbers::pi / 180;
constexpr double EDGE = 5;                                        // degrees
constexpr SizeDistribution DROPLETS = {SizeKind::Gamma, 1.5, 2};  // r_e = (gamma + 2) r_n
constexpr double WAVELENGTH_um = 0.55;
constexpr double TEMPERATURE_C = 20;
constexpr double NODES_PER_SPREAD = 1024;  // 0.5 % at the glory, against four times as many

}  // namespace

CanonicalPhase canonicalPhase() {
  std::vector<double> angle;
  angle.reserve(801);
  for (int i = 0; i < 100; ++i) {
    angle.push_back(EDGE * RADIANS * i / 100);
  }
  for (int i = 0; i <= 700; ++i) {
    angle.push_back((EDGE + i * (180 - EDGE) / 700) * RADIANS);
  }
  MieSettings settings;
  settings.nodesPerSpread = NODES_PER_SPREAD;
  const MieAverage mie =
      averageMie(DROPLETS, waterSample(WAVELENGTH_um, TEMPERATURE_C), angle, settings);
  CanonicalPhase phase;
  phase.value = mie.phase;
  phase.asymmetry = mie.asymmetry;
  for (const double theta : angle) {
    const double sine = std::sin(theta / 2);
    phase.y.push_back(2 * sine * sine);
  }
  phase.y.back() = 2;
  const double whole = sphereIntegral(phase.y, phase.value);
  for (int i = 0; i < 100; ++i) {
    double& value = phase.value[static_cast<size_t>(i)];
    value = std::min(value, phase.value[100]);
  }
  const double rest = sphereIntegral(phase.y, phase.value);
  phase.removed = 1 - rest / whole;
  for (double& value : phase.value) {
    value /= rest;
  }
  return phase;
}

std::vector<double> canonicalMoments(const CanonicalPhase& phase, size_t count) {
  std::vector<double> chi(count);
  legendreMoments(phase.y, phase.value, chi);
  return chi;
}

}  // namespace welkin
