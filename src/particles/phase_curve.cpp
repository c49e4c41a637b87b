// SPDX-License-Identifier: MIT
#include "particles/phase_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "model/model.hpp"

namespace welkin {
namespace {

namespace f32 = model::f32;
namespace f64 = model::f64;

constexpr double PI = std::numbers::pi;
constexpr size_t NODES = static_cast<size_t>(f64::CURVE_NODES);
constexpr size_t CELLS = NODES - 1;
static_assert(NODES == kCurveNodes);

// Gauss-Legendre on [0, 1].
constexpr size_t POINTS = 2;
constexpr double POINT[POINTS] = {0.211324865405187118, 0.788675134594812882};
constexpr double WEIGHT[POINTS] = {0.5, 0.5};

// The model text by scalar type.
template <typename T>
struct Text;
template <>
struct Text<double> {
  static double coordinate(double y) { return f64::phaseCoordinate(y); }
  static double value(double y0, double y1, double p0, double p1, double y) {
    return f64::curveCellValue(y0, y1, p0, p1, y);
  }
};
template <>
struct Text<float> {
  static float coordinate(float y) { return f32::phaseCoordinate(y); }
  static float value(float y0, float y1, float p0, float p1, float y) {
    return f32::curveCellValue(y0, y1, p0, p1, y);
  }
};

// Integrals of one channel against the hat functions of the nodes, and the range of P about each.
struct Projection {
  std::vector<double> load = std::vector<double>(NODES);
  std::vector<double> low = std::vector<double>(NODES, std::numeric_limits<double>::infinity());
  std::vector<double> high = std::vector<double>(NODES);
};

Projection project(const PhaseFunction& phase, size_t channel, std::span<const double> y) {
  Projection result;
  for (size_t i = 0; i < CELLS; ++i) {
    const double width = y[i + 1] - y[i];
    for (size_t k = 0; k < POINTS; ++k) {
      const double raw = phase(channel, y[i] + POINT[k] * width);
      const double p = std::isfinite(raw) && raw > 0 ? raw : 0;
      result.load[i] += p * WEIGHT[k] * width * (1 - POINT[k]);
      result.load[i + 1] += p * WEIGHT[k] * width * POINT[k];
      for (const size_t node : {i, i + 1}) {
        result.low[node] = std::min(result.low[node], p);
        result.high[node] = std::max(result.high[node], p);
      }
    }
  }
  return result;
}

// Least squares in y: width / 6 (p[i - 1] + 2 p[i]) + width / 6 (2 p[i] + p[i + 1]) = load[i], by
// elimination. The hats add up to 1 and, weighted, to y: so both integrals stay exact.
std::vector<double> fit(const Projection& projection, std::span<const double> y) {
  std::vector<double> diagonal(NODES);
  std::vector<double> value = projection.load;
  for (size_t i = 0; i < NODES; ++i) {
    const double before = i > 0 ? y[i] - y[i - 1] : 0;
    const double after = i < CELLS ? y[i + 1] - y[i] : 0;
    diagonal[i] = (before + after) / 3;
    if (i > 0) {
      const double ratio = before / 6 / diagonal[i - 1];
      diagonal[i] -= ratio * before / 6;
      value[i] -= ratio * value[i - 1];
    }
  }
  value[CELLS] /= diagonal[CELLS];
  for (size_t i = CELLS; i-- > 0;) {
    value[i] = (value[i] - (y[i + 1] - y[i]) / 6 * value[i + 1]) / diagonal[i];
  }
  // At a jump of P the fit rings, down below zero. A quarter of the local range is more than any
  // parabola needs (at its vertex the fit lies 0.2 of the range outside), so that this acts at
  // jumps and kinks only.
  for (size_t i = 0; i < NODES; ++i) {
    const double low = projection.low[i];
    const double high = projection.high[i];
    const double slack = 0.25 * (high - low);
    value[i] = std::clamp(value[i], std::max(low - slack, 0.5 * low), high + slack);
  }
  return value;
}

// Scales a channel to integral 1, and sums its energies up from both ends.
void finishChannel(PhaseCurve& curve, size_t channel) {
  std::vector<double>& p = curve.value[channel];
  const auto energy = [&](size_t i) {
    return f64::curveCellEnergy(curve.y[i], curve.y[i + 1], p[i], p[i + 1]);
  };
  double total = 0;
  for (size_t i = 0; i < CELLS; ++i) {
    total += energy(i);
  }
  if (!(total > 0 && std::isfinite(total))) {
    p.assign(NODES, 1);
    total = 4 * PI;
  }
  for (double& value : p) {
    value /= total;
  }
  std::vector<double>& cdf = curve.cdf[channel];
  std::vector<double>& tail = curve.tail[channel];
  cdf.assign(NODES, 0);
  tail.assign(NODES, 0);
  for (size_t i = 0; i < CELLS; ++i) {
    cdf[i + 1] = std::min(cdf[i] + energy(i), 1.0);
    tail[CELLS - 1 - i] = std::min(tail[CELLS - i] + energy(CELLS - 1 - i), 1.0);
  }
  cdf[CELLS] = 1;
  tail[0] = 1;
}

// The cell of y. The coordinate may be off by its rounding, the nodes decide.
template <typename T>
size_t cellOf(const BasicPhaseCurve<T>& curve, T y) {
  const T s = Text<T>::coordinate(y) * static_cast<T>(CELLS);
  size_t i = std::min(static_cast<size_t>(s), CELLS - 1);
  while (i > 0 && y < curve.y[i]) {
    --i;
  }
  while (i + 1 < CELLS && y > curve.y[i + 1]) {
    ++i;
  }
  return i;
}

template <typename T>
T eval(const BasicPhaseCurve<T>& curve, size_t channel, T y) {
  const std::vector<T>& p = curve.value[channel];
  const size_t i = cellOf(curve, y);
  return Text<T>::value(curve.y[i], curve.y[i + 1], p[i], p[i + 1], y);
}

// A cell and the part q of its energy between its node `near` and the sample.
template <typename T>
struct Drawn {
  size_t near;
  size_t far;
  T q;
};

// From the nearer end in energy, since 1 - xi is exact from 1/2 on.
template <typename T>
Drawn<T> draw(const BasicPhaseCurve<T>& curve, size_t channel, T xi) {
  if (xi <= T(0.5)) {
    const std::vector<T>& cdf = curve.cdf[channel];
    const T part = std::max(xi, T(0));
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, part);
    const auto i = static_cast<size_t>(above - cdf.begin()) - 1;
    const T q = std::clamp((part - cdf[i]) / (cdf[i + 1] - cdf[i]), T(0), T(1));
    return {i, i + 1, q};
  }
  const std::vector<T>& tail = curve.tail[channel];
  const T part = std::max(T(1) - xi, T(0));
  const auto below = std::lower_bound(tail.begin() + 1, tail.end() - 1, part,
                                      [](T energy, T sought) { return energy > sought; });
  const auto i = static_cast<size_t>(below - tail.begin()) - 1;
  const T q = std::clamp((part - tail[i + 1]) / (tail[i] - tail[i + 1]), T(0), T(1));
  return {i + 1, i, q};
}

}  // namespace

PhaseCurve makePhaseCurve(const PhaseFunction& phase) {
  PhaseCurve curve;
  curve.y.resize(NODES);
  for (size_t i = 0; i < NODES; ++i) {
    curve.y[i] = f64::curveNode(static_cast<double>(i) / static_cast<double>(CELLS));
  }
  for (size_t channel = 0; channel < kCurveChannels; ++channel) {
    curve.value[channel] = fit(project(phase, channel, curve.y), curve.y);
    finishChannel(curve, channel);
  }
  return curve;
}

PhaseCurveF roundPhaseCurve(const PhaseCurve& curve) {
  const auto rounded = [](const std::vector<double>& values) {
    std::vector<float> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(),
                   [](double value) { return static_cast<float>(value); });
    return result;
  };
  PhaseCurveF result;
  result.y = rounded(curve.y);
  for (size_t channel = 0; channel < kCurveChannels; ++channel) {
    result.value[channel] = rounded(curve.value[channel]);
    result.cdf[channel] = rounded(curve.cdf[channel]);
    result.tail[channel] = rounded(curve.tail[channel]);
  }
  return result;
}

double evalPhaseCurve(const PhaseCurve& curve, size_t channel, double y) {
  return eval(curve, channel, y);
}

float evalPhaseCurve(const PhaseCurveF& curve, size_t channel, float y) {
  return eval(curve, channel, y);
}

double samplePhaseCurve(const PhaseCurve& curve, size_t channel, double xi) {
  const Drawn<double> d = draw(curve, channel, xi);
  const std::vector<double>& p = curve.value[channel];
  return f64::curveCellInvert(curve.y[d.near], curve.y[d.far], p[d.near], p[d.far], d.q);
}

// The nodes lie in mirror image: node i of the backward half is as far from the backward end as
// node CELLS - i from the forward end.
AxisAngleF samplePhaseCurve(const PhaseCurveF& curve, size_t channel, float xi) {
  const Drawn<float> d = draw(curve, channel, xi);
  const bool backward = std::min(d.near, d.far) >= NODES / 2;
  const auto y = [&](size_t i) { return curve.y[backward ? CELLS - i : i]; };
  const std::vector<float>& p = curve.value[channel];
  return {f32::curveCellInvert(y(d.near), y(d.far), p[d.near], p[d.far], d.q), backward};
}

float evalPhaseCurve(const PhaseCurveF& curve, size_t channel, AxisAngleF angle) {
  if (!angle.backward) {
    return eval(curve, channel, angle.y);
  }
  const size_t i = cellOf(curve, angle.y);
  const std::vector<float>& p = curve.value[channel];
  return f32::curveCellValue(curve.y[i], curve.y[i + 1], p[CELLS - i], p[CELLS - i - 1], angle.y);
}

double phaseCurveCdf(const PhaseCurve& curve, size_t channel, double y) {
  const size_t i = cellOf(curve, y);
  const double p = evalPhaseCurve(curve, channel, y);
  return curve.cdf[channel][i] + f64::curveCellEnergy(curve.y[i], y, curve.value[channel][i], p);
}

double meanOneMinusCosine(const PhaseCurve& curve, size_t channel) {
  const std::vector<double>& y = curve.y;
  const std::vector<double>& p = curve.value[channel];
  double sum = 0;
  for (size_t i = 0; i < CELLS; ++i) {
    const double moment = p[i] * (2 * y[i] + y[i + 1]) + p[i + 1] * (y[i] + 2 * y[i + 1]);
    sum += PI / 3 * (y[i + 1] - y[i]) * moment;
  }
  return sum;
}

double meanCosine(const PhaseCurve& curve, size_t channel) {
  return 1 - meanOneMinusCosine(curve, channel);
}

double forwardFraction(const PhaseCurve& curve, size_t channel) {
  return phaseCurveCdf(curve, channel, 1);
}

}  // namespace welkin
