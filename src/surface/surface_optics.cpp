// SPDX-License-Identifier: MIT
#include "surface/surface_optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double EDGE = 5 * std::numbers::pi / 180;
constexpr std::array<int, CANONICAL_SETS> FIRST_ORDER = {2, 3, 5, 7, 9, 13, 19, 31};

// Energy of what P has within the edge above its value there.
double peakOf(const PhaseCurve& curve, size_t channel, double edgeValue) {
  const std::vector<double>& y = curve.y;
  const std::vector<double>& p = curve.value[channel];
  double sum = 0;
  for (size_t i = 1; i < y.size() && y[i - 1] < 1 - std::cos(EDGE); ++i) {
    const double above = std::max(p[i - 1] - edgeValue, 0.0) + std::max(p[i] - edgeValue, 0.0);
    sum += std::numbers::pi * above * (y[i] - y[i - 1]);
  }
  return sum;
}

double meanOf(const std::array<double, RGB>& v) {
  return (v[0] + v[1] + v[2]) / 3;
}

}  // namespace

SurfaceOptics surfaceOptics(const Medium& medium, double canonicalAsymmetry) {
  const PhaseCurve& phase = medium.particle->curve;
  const double edge = 1 - std::cos(EDGE);
  std::array<double, RGB> edgeValue{};
  std::array<double, RGB> peak{};
  std::array<double, RGB> gap{};  // 1 - g
  for (size_t c = 0; c < RGB; ++c) {
    edgeValue[c] = evalPhaseCurve(phase, c, edge);
    peak[c] = std::clamp(peakOf(phase, c, edgeValue[c]), 0.0, 0.999);
    gap[c] = meanOneMinusCosine(phase, c);
  }
  const double removed = meanOf(peak);
  const std::array<double, RGB> albedo = medium.scaledAlbedo();
  const double mean = meanOf(albedo);
  const double factor = medium.extinctionFactor();
  const double scale = meanOf(gap) / (1 - canonicalAsymmetry);

  SurfaceOptics optics;
  optics.whole = factor;
  optics.smooth = factor * (1 - mean * removed);
  optics.canonical = factor * (mean * scale + 1 - mean);
  for (size_t c = 0; c < RGB; ++c) {
    optics.albedo[c] = std::min((1 - removed) * albedo[c] / (1 - mean * removed), 1.0);
    const double more = std::min(albedo[c] * scale / (albedo[c] * scale + 1 - albedo[c]), 1.0);
    for (size_t set = 0; set < CANONICAL_SETS; ++set) {
      optics.orders[set][c] = std::pow(more, FIRST_ORDER[set]);
    }
  }
  const double smoothMean = meanOf(optics.albedo);
  optics.peakAlbedo = smoothMean > 0 ? mean / smoothMean : 0;
  optics.curve.resize(2 * kCurveNodes);
  for (size_t i = 0; i < kCurveNodes; ++i) {
    for (size_t c = 0; c < RGB; ++c) {
      const double p = phase.value[c][i];
      const double kept = phase.y[i] < edge ? std::min(p, edgeValue[c]) : p;
      optics.curve[i][c] = static_cast<float>(kept / (1 - removed));
      optics.curve[kCurveNodes + i][c] = static_cast<float>(p - kept);
    }
  }
  return optics;
}

}  // namespace welkin
