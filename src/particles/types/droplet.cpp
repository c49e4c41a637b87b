// SPDX-License-Identifier: MIT
#include "particles/types/droplet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
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

Particle fromTable(const PhaseTable& table, const ParticleParams& params) {
  return tableParticle(table, false, params, [&](double tableWavelength, double wavelength) {
    return std::log(params.diameter_um * tableWavelength / wavelength);
  });
}

// P linear in both, so that the integral and the mean cosine stay right.
Particle blended(const Particle& a, const Particle& b, double t) {
  Particle result;
  result.curve = makePhaseCurve([&](size_t channel, double y) {
    return (1 - t) * evalPhaseCurve(a.curve, channel, y) + t * evalPhaseCurve(b.curve, channel, y);
  });
  for (size_t c = 0; c < RGB; ++c) {
    result.optics.efficiency[c] = std::lerp(a.optics.efficiency[c], b.optics.efficiency[c], t);
  }
  return result;
}

Particle fromTables(const ParticleParams& params) {
  const double t =
      std::log(params.diameter_um / BLEND_BEGIN_um) / std::log(BLEND_END_um / BLEND_BEGIN_um);
  if (t <= 0) {
    return fromTable(HAZE_TABLE, params);
  }
  const Particle large = fromTable(DROPLET_TABLE, params);
  return t >= 1 ? large : blended(fromTable(HAZE_TABLE, params), large, t * t * (3 - 2 * t));
}

// Angles at even steps of the coordinate s, dense enough for the rings of a narrow spread.
std::vector<double> mieAngles() {
  constexpr int COUNT = 384;
  std::vector<double> angles;
  for (int i = 0; i < COUNT; ++i) {
    const double s = i / (COUNT - 1.0);
    const double c = 2 * s - 1;  // see curveEnd in shaders/model/phase/curve.glsl
    const double sum = std::sqrt(std::sqrt(8 * (1 + c * c * c * c)) - 3 * c * c);
    const double a = std::max(0.5 * (sum + c), 0.0);
    angles.push_back(i == 0 ? 0 : 2 * std::asin(std::min(a * a, 1.0)));
  }
  angles.back() = PI;
  return angles;
}

// 1024 nodes per spread: within 1 % of four times as many at any angle.
Particle fromMie(const ParticleParams& params) {
  const std::vector<double> angles = mieAngles();
  const SizeDistribution sizes = sizesOf(params);
  MieSettings settings;
  settings.nodesPerSpread = 1024;
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
  const bool tabulated = params.analytic || (params.spread == DROPLET_SPREAD && within);
  Particle particle = tabulated ? fromTables(params) : fromMie(params);
  if (params.analytic) {
    particle.analytic = true;
    particle.phase = phaseParameters(PhaseKind::HgDraine, params.diameter_um, 0);
    particle.curve = makePhaseCurve([&](size_t, double y) { return evalPhase(particle.phase, y); });
  }
  const SizeDistribution sizes = sizesOf(params);
  particle.optics.area_um2 = PI * meanPower(sizes, 2);
  particle.optics.effectiveRadius_um = effectiveRadius(sizes);
  return particle;
}

}  // namespace welkin
