// SPDX-License-Identifier: MIT
#include "particles/types/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "particles/mie_average.hpp"
#include "particles/refractive_index.hpp"

namespace welkin {
namespace {

double indexAt(bool ice, double wavelength_um) {
  return ice ? iceIndex(wavelength_um) : waterIndex(wavelength_um, WATER_TEMPERATURE_C);
}

// Least part of the nearer channel that a continued mix may fall to: keeps P positive.
constexpr double LEAST = 0.25;

}  // namespace

double angleOf(double y) {
  return 2 * std::asin(std::sqrt(std::clamp(y / 2, 0.0, 1.0)));
}

WavelengthMix wavelengthMix(Features features, bool ice, const ParticleParams& params,
                            size_t channel) {
  WavelengthMix mix;
  if (params.wavelength_um == 0) {
    mix.wavelength_um = RGB_WAVELENGTH_UM[channel];
    mix.index = indexAt(ice, mix.wavelength_um);
    mix.channel = {channel, channel};
    mix.weight = {1, 0};
    return mix;
  }
  mix.wavelength_um = params.wavelength_um;
  mix.index = indexAt(ice, mix.wavelength_um);
  mix.channel = mix.wavelength_um > RGB_WAVELENGTH_UM[1] ? std::array<size_t, 2>{0, 1}
                                                         : std::array<size_t, 2>{1, 2};
  const double low = indexAt(ice, RGB_WAVELENGTH_UM[mix.channel[0]]);
  const double high = indexAt(ice, RGB_WAVELENGTH_UM[mix.channel[1]]);
  const double t = (mix.index - low) / (high - low);
  // Sharp features tell the channels apart: there, continue by shifting alone.
  const double limited = features == Features::Halos ? std::clamp(t, 0.0, 1.0) : t;
  mix.weight = {1 - limited, limited};
  return mix;
}

PhaseCurve calibratedCurve(const std::function<double(size_t channel, double angle)>& phase,
                           const std::array<double, RGB>& asymmetry) {
  const auto plain = [&](size_t channel, double y) { return phase(channel, angleOf(y)); };
  const PhaseCurve first = makePhaseCurve(plain);
  std::array<double, RGB> border{};
  std::array<double, RGB> factor{};
  for (size_t c = 0; c < RGB; ++c) {
    border[c] = samplePhaseCurve(first, c, 0.5);
    double inner = 0;  // of 1 - cos, over the half within the border
    for (size_t i = 0; i + 1 < first.y.size() && first.y[i + 1] <= border[c]; ++i) {
      const double energy = first.cdf[c][i + 1] - first.cdf[c][i];
      inner += energy * (first.y[i] + first.y[i + 1]) / 2;
    }
    const double target = 1 - asymmetry[c];
    const double outer = meanOneMinusCosine(first, c) - inner;
    // (k inner + outer) / (k / 2 + 1 / 2) = target.
    const double k = (outer - target / 2) / (target / 2 - inner);
    factor[c] = std::isfinite(k) ? std::clamp(k, 0.9, 1.1) : 1;
  }
  return makePhaseCurve([&](size_t channel, double y) {
    return plain(channel, y) * (y < border[channel] ? factor[channel] : 1);
  });
}

ParticleOptics tableOptics(const PhaseTable& table, bool ice, const ParticleParams& params,
                           const std::function<double(double, double)>& axisValue) {
  ParticleOptics optics;
  for (size_t c = 0; c < RGB; ++c) {
    const WavelengthMix mix = wavelengthMix(table.features, ice, params, c);
    for (size_t k = 0; k < 2; ++k) {
      const size_t channel = mix.channel[k];
      const double axis = axisValue(RGB_WAVELENGTH_UM[channel], mix.wavelength_um);
      optics.efficiency[c] += mix.weight[k] * tableEfficiency(table, axis, channel);
      optics.delta[c] += mix.weight[k] * tableDelta(table, axis, channel);
    }
  }
  return optics;
}

Particle tableParticle(const PhaseTable& table, bool ice, const ParticleParams& params,
                       const std::function<double(double, double)>& axisValue) {
  std::array<WavelengthMix, RGB> mix;
  std::vector<TableFunction> functions;
  std::array<double, RGB> asymmetry{};
  Particle particle;
  particle.optics = tableOptics(table, ice, params, axisValue);
  for (size_t c = 0; c < RGB; ++c) {
    mix[c] = wavelengthMix(table.features, ice, params, c);
    for (size_t k = 0; k < 2; ++k) {
      const size_t channel = mix[c].channel[k];
      const double axis = axisValue(RGB_WAVELENGTH_UM[channel], mix[c].wavelength_um);
      functions.emplace_back(table, axis, channel);
      asymmetry[c] += mix[c].weight[k] * tableAsymmetry(table, axis, channel);
    }
  }
  particle.curve = calibratedCurve(
      [&](size_t c, double angle) {
        const double knot = knotAngle(table.features, mix[c].index, angle);
        const double near = functions[2 * c](knot);
        if (mix[c].weight[1] == 0) {
          return near;
        }
        const double far = functions[2 * c + 1](knot);
        const double mixed = mix[c].weight[0] * near + mix[c].weight[1] * far;
        return std::max(mixed, LEAST * std::min(near, far));
      },
      asymmetry);
  return particle;
}

}  // namespace welkin
