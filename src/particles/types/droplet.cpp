// SPDX-License-Identifier: MIT
#include "particles/types/droplet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "particles/mie_average.hpp"
#include "particles/phase_table.hpp"
#include "particles/types/spectrum.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;

// Both droplet tables hold 4 to 6 um: between 4 and 5 they are blended.
constexpr double BLEND_BEGIN_um = 4;
constexpr double BLEND_END_um = 5;

SizeDistribution sizesOf(const ParticleParams& params) {
  return {SizeKind::LogNormal, params.diameter_um / 2, params.spread};
}

// Place on a droplet table's axis.
auto scaledSize(const ParticleParams& params) {
  return [&params](double tableWavelength, double wavelength) {
    return std::log(params.diameter_um * tableWavelength / wavelength);
  };
}

Particle fromTable(const PhaseTable& table, const ParticleParams& params) {
  return tableParticle(table, false, params, scaledSize(params));
}

// Part of DROPLET_TABLE in the blend.
double largeShare(const ParticleParams& params) {
  const double t = std::clamp(
      std::log(params.diameter_um / BLEND_BEGIN_um) / std::log(BLEND_END_um / BLEND_BEGIN_um), 0.0,
      1.0);
  return t * t * (3 - 2 * t);
}

// Efficiencies alone.
ParticleOptics opticsFromTables(const ParticleParams& params) {
  const double t = largeShare(params);
  ParticleOptics optics = tableOptics(HAZE_TABLE, false, params, scaledSize(params));
  const ParticleOptics large = tableOptics(DROPLET_TABLE, false, params, scaledSize(params));
  for (size_t c = 0; c < RGB; ++c) {
    optics.efficiency[c] = std::lerp(optics.efficiency[c], large.efficiency[c], t);
  }
  return optics;
}

// P linear in both tables, so that the integral and the mean cosine stay right.
Particle fromTables(const ParticleParams& params) {
  const double t = largeShare(params);
  if (t == 0) {
    return fromTable(HAZE_TABLE, params);
  }
  Particle particle = fromTable(DROPLET_TABLE, params);
  if (t < 1) {
    const PhaseCurve small = fromTable(HAZE_TABLE, params).curve;
    const PhaseCurve large = std::move(particle.curve);
    particle.curve = makePhaseCurve([&](size_t channel, double y) {
      return std::lerp(evalPhaseCurve(small, channel, y), evalPhaseCurve(large, channel, y), t);
    });
    particle.optics = opticsFromTables(params);
  }
  return particle;
}

// Angles at even steps of the coordinate s, and every 0.1 degrees where a narrow spread has rings:
// a fifth of their period for 50 um at 440 nm.
std::vector<double> mieAngles() {
  constexpr int COUNT = 256;
  constexpr double STEP = PI / 1800;
  constexpr int CORONA = 80;
  constexpr int GLORY = 50;
  std::vector<double> angles;
  for (int i = 0; i < COUNT; ++i) {
    const double s = i / (COUNT - 1.0);
    const double c = 2 * s - 1;  // see curveEnd in shaders/model/phase/curve.glsl
    const double sum = std::sqrt(std::sqrt(8 * (1 + c * c * c * c)) - 3 * c * c);
    const double a = std::max(0.5 * (sum + c), 0.0);
    const double angle = 2 * std::asin(std::min(a * a, 1.0));
    if (angle > (CORONA + 0.5) * STEP && angle < PI - (GLORY + 0.5) * STEP) {
      angles.push_back(angle);
    }
  }
  for (int i = 0; i <= CORONA; ++i) {
    angles.push_back(i * STEP);
  }
  for (int i = 0; i <= GLORY; ++i) {
    angles.push_back(PI - i * STEP);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

// 1024 nodes per spread, fewer above 0.25, where there are as many in all; against four times as
// many: within 1 % at the angles computed.
Particle fromMie(const ParticleParams& params) {
  const std::vector<double> angles = mieAngles();
  const SizeDistribution sizes = sizesOf(params);
  MieSettings settings;
  settings.nodesPerSpread = 1024 * std::min(1.0, DROPLET_SPREAD / params.spread);
  std::vector<PhaseColumn> columns;
  std::array<double, RGB> asymmetry{};
  Particle particle;
  for (size_t c = 0; c < RGB; ++c) {
    const double wavelength =
        params.wavelength_um > 0 ? params.wavelength_um : RGB_WAVELENGTH_UM[c];
    if (c > 0 && params.wavelength_um > 0) {
      columns.push_back(columns[0]);
      asymmetry[c] = asymmetry[0];
      particle.optics.efficiency[c] = particle.optics.efficiency[0];
      continue;
    }
    const MieAverage mean =
        averageMie(sizes, waterSample(wavelength, WATER_TEMPERATURE_C), angles, settings);
    std::vector<double> logPhase;
    for (const double p : mean.phase) {
      logPhase.push_back(std::log(p));
    }
    columns.emplace_back(angles, logPhase);
    asymmetry[c] = mean.asymmetry;
    particle.optics.efficiency[c] = mean.extinction_um2 / (PI * meanPower(sizes, 2));
  }
  particle.curve = calibratedCurve(
      [&](size_t channel, double angle) { return columns[channel](angle); }, asymmetry);
  return particle;
}

}  // namespace

Particle makeDroplets(const ParticleParams& params) {
  // Beyond the tables' wavelengths their mix errs by up to 20 % at a bow.
  const bool within = params.wavelength_um == 0 || (params.wavelength_um >= RGB_WAVELENGTH_UM[2] &&
                                                    params.wavelength_um <= RGB_WAVELENGTH_UM[0]);
  Particle particle;
  if (params.analytic) {
    particle.analytic = true;
    particle.phase = phaseParameters(PhaseKind::HgDraine, params.diameter_um, 0);
    particle.curve = makePhaseCurve([&](size_t, double y) { return evalPhase(particle.phase, y); });
    particle.optics = opticsFromTables(params);
  } else if (params.spread == DROPLET_SPREAD && within) {
    particle = fromTables(params);
  } else {
    particle = fromMie(params);
  }
  const SizeDistribution sizes = sizesOf(params);
  particle.optics.area_um2 = PI * meanPower(sizes, 2);
  particle.optics.effectiveRadius_um = effectiveRadius(sizes);
  return particle;
}

}  // namespace welkin
