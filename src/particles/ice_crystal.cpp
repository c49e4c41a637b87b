// SPDX-License-Identifier: MIT
#include "particles/ice_crystal.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "particles/solar_disk.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;
constexpr size_t LAST = 7200;       // the nodes are 0 .. LAST
constexpr double STEP = PI / LAST;  // 0.025 degrees
// Standard deviations of independent rays. The tracer's points are evener than that, except for
// what random tilts decide.
constexpr double SMOOTH_NOISE = 1;
constexpr double ROUGH_NOISE = 3;
constexpr double MIN_WEIGHT = 1e-4;  // loses less than 1e-4 of the light

double angleOf(size_t node) {
  return static_cast<double>(node) * STEP;
}

// Around every node a ring (at both ends a cap) of half a step to both sides: the tracer's bins.
std::vector<double> ringEdges() {
  std::vector<double> edges = {0};
  for (size_t i = 0; i < LAST; ++i) {
    edges.push_back((static_cast<double>(i) + 0.5) * STEP);
  }
  edges.push_back(PI);
  return edges;
}

// solidAngle: integral over the sphere of the function that is 1 at the node and falls linearly to
// 0 at its neighbours, so that sums over nodes are exact integrals of what is interpolated between.
struct Rings {
  std::vector<double> solidAngle;
  std::vector<double> sine;         // 1e-30 at both ends, which may be divided by
  std::vector<double> inverseRoot;  // 1 / sqrt(sine)

  Rings() : solidAngle(LAST + 1), sine(LAST + 1), inverseRoot(LAST + 1) {
    const double half = std::sin(STEP / 2);
    for (size_t i = 0; i <= LAST; ++i) {
      sine[i] = i % LAST == 0 ? 1e-30 : std::sin(angleOf(i));
      inverseRoot[i] = 1 / std::sqrt(sine[i]);
      solidAngle[i] =
          2 * PI * (i % LAST == 0 ? 1 - std::sin(STEP) / STEP : sine[i] * 4 * half * half / STEP);
    }
  }
};

// exp(-x) I0(x) for 0 <= x < 20: Abramowitz and Stegun 9.8.1 and 9.8.2, relative error below 3e-7.
double scaledBesselI0(double x) {
  constexpr std::array<double, 7> NEAR = {1,         3.5156229, 3.0899424, 1.2067492,
                                          0.2659732, 0.0360768, 0.0045813};
  constexpr std::array<double, 9> FAR = {0.39894228,  0.01328592,  0.00225319,
                                         -0.00157565, 0.00916281,  -0.02057706,
                                         0.02635537,  -0.01647633, 0.00392377};
  const auto sum = [](const auto& terms, double t) {
    return std::accumulate(terms.rbegin(), terms.rend(), 0.0,
                           [&](double all, double term) { return all * t + term; });
  };
  const double t = x / 3.75;
  return t < 1 ? std::exp(-x) * sum(NEAR, t * t) : sum(FAR, 1 / t) / std::sqrt(x);
}

// The sun's disk around node i.
struct Disk {
  const Rings& rings;

  double reach(size_t /*i*/) const { return SUN_RADIUS; }

  // Share of ring j inside: half arc / pi, hav R = hav(difference) + sin sin hav(half arc), in the
  // middle of 4 parts of the ring.
  double share(size_t i, size_t j) const {
    constexpr int PARTS = 4;
    const double havRadius = std::pow(std::sin(SUN_RADIUS / 2), 2);
    double sum = 0;
    for (int k = 0; k < PARTS; ++k) {
      const double theta = angleOf(j) + ((k + 0.5) / PARTS - 0.5) * STEP;
      const double away = std::sin((theta - angleOf(i)) / 2);
      const double product = std::max(rings.sine[i] * std::abs(std::sin(theta)), 1e-300);
      const double hav = std::clamp((havRadius - away * away) / product, 0.0, 1.0);
      sum += 2 * std::asin(std::sqrt(hav)) / PI;
    }
    return sum / PARTS;
  }
};

// The Gaussian of the sphere, exp((cos - 1) / rms^2), around node i.
class Gauss {
 public:
  Gauss(const Rings& rings, const std::vector<double>& rms) : rings_(rings), rms_(rms) {}

  double reach(size_t i) {
    const double reach = 4 * rms_[i];  // the rest, 6e-5 of a line, is left out
    if (rms_[i] != fallOf_) {
      fallOf_ = rms_[i];
      fall_.clear();
      for (size_t k = 0; static_cast<double>(k) * STEP <= reach + STEP; ++k) {
        const double chord = 2 * std::sin(angleOf(k) / 2);
        fall_.push_back(std::exp(-chord * chord / (2 * fallOf_ * fallOf_)));
      }
    }
    return reach;
  }

  // Its mean over ring j: the mean over the azimuth is a Bessel function of x; from 20 on its
  // asymptotic series, wrong by 225 / 3072 / x^3, 1e-5.
  double share(size_t i, size_t j) const {
    const double root = fallOf_ * rings_.inverseRoot[i] * rings_.inverseRoot[j];  // x^(-1/2)
    const double inverse = root * root;
    constexpr double FLAT = 0.3989422804014327;  // 1 / sqrt(2 pi)
    const double mean = inverse < 0.05
                            ? FLAT * root * (1 + inverse * (0.125 + inverse * (9.0 / 128)))
                            : scaledBesselI0(1 / inverse);
    return fall_[i > j ? i - j : j - i] * mean;
  }

 private:
  const Rings& rings_;
  const std::vector<double>& rms_;
  std::vector<double> fall_;  // by steps from node i
  double fallOf_ = 0;
};

// Per node: values in 1/sr, and their variances as long as those of the nodes are independent.
struct Curve {
  std::vector<double> value, variance;
};

// Mean over the nodes within reach of a kernel, weighted with its share x solid angle: leaves a
// constant as it is, whatever the reach does from node to node.
template <typename Kernel>
Curve average(const Rings& rings, const Curve& in, Kernel kernel) {
  Curve out;
  for (size_t i = 0; i <= LAST; ++i) {
    const auto width = static_cast<size_t>(std::ceil(kernel.reach(i) / STEP));
    const size_t end = std::min(i + width, LAST);
    double total = 0;
    double value = 0;
    double variance = 0;
    for (size_t j = i > width ? i - width : 0; j <= end; ++j) {
      const double weight = kernel.share(i, j) * rings.solidAngle[j];
      total += weight;
      value += weight * in.value[j];
      variance += weight * weight * in.variance[j];
    }
    out.value.push_back(value / total);
    out.variance.push_back(variance / (total * total));
  }
  return out;
}

// Minimum deviation in a wedge; pi when no ray passes.
double haloEdge(double index, double wedge) {
  const double sine = index * std::sin(wedge / 2);
  return sine < 1 ? 2 * std::asin(sine) - wedge : PI;
}

// How wide each node may be blurred (rms) on top of a blur of rms `already`: the widest of a ladder
// at which the curve stays within `noise` standard deviations of all narrower ones (Lepski 1991),
// the narrowest around the edges of both halos, and growing slowly away from places that need a
// narrow one.
std::vector<double> blurWidths(const Rings& rings, const Curve& in, double index, double least,
                               double already, double noise) {
  constexpr double WIDEST = 2 * DEGREE;
  constexpr double GROWTH = 0.15;  // 6.7 rms to the place that wants a narrow one
  constexpr double BEFORE = 0.5 * DEGREE;
  constexpr double AFTER = 1 * DEGREE;
  std::vector<bool> open(LAST + 1, true);
  for (const double wedge : {60 * DEGREE, 90 * DEGREE}) {
    const double edge = haloEdge(index, wedge);
    for (size_t i = 0; i <= LAST; ++i) {
      if (angleOf(i) > edge - BEFORE && angleOf(i) < edge + AFTER) {
        open[i] = false;
      }
    }
  }
  std::vector<double> result(LAST + 1, least);
  std::vector<Curve> curves;
  for (double rms = least; rms <= WIDEST; rms *= 2) {
    const std::vector<double> all(LAST + 1, std::hypot(rms, already));
    const Curve wide = average(rings, in, Gauss(rings, all));
    for (size_t i = 0; i <= LAST; ++i) {
      for (const Curve& narrow : curves) {
        const double limit = noise * std::sqrt(narrow.variance[i]);
        open[i] = open[i] && std::abs(wide.value[i] - narrow.value[i]) <= limit;
      }
      if (open[i]) {
        result[i] = rms;
      }
    }
    curves.push_back(wide);
  }
  for (size_t i = 1; i <= LAST; ++i) {
    result[i] = std::min(result[i], result[i - 1] + GROWTH * STEP);
  }
  for (size_t i = LAST; i > 0; --i) {
    result[i - 1] = std::min(result[i - 1], result[i] + GROWTH * STEP);
  }
  return result;
}

}  // namespace

IcePhase icePhase(const IceCrystal& crystal, double index, std::span<const double> angles,
                  const IceSettings& settings) {
  assert(settings.smoothing >= 5e-4 && settings.smoothing <= 0.05);
  IceTracing tracing;
  tracing.rays = settings.rays;
  tracing.seed = settings.seed;
  tracing.minWeight = MIN_WEIGHT;
  const IceScattering traced = traceIce(crystal, index, ringEdges(), tracing);
  const Rings rings;
  Curve curve = {traced.energy, traced.variance};
  for (size_t i = 0; i <= LAST; ++i) {
    curve.value[i] /= rings.solidAngle[i];
    curve.variance[i] /= rings.solidAngle[i] * rings.solidAngle[i];
  }
  const double already = settings.solarDisk ? SUN_RADIUS / 2 : 0;  // rms of the disk
  const std::vector<double> widths = blurWidths(rings, curve, index, settings.smoothing, already,
                                                crystal.roughness > 0 ? ROUGH_NOISE : SMOOTH_NOISE);
  if (settings.solarDisk) {
    curve = average(rings, curve, Disk{rings});
  }
  curve = average(rings, curve, Gauss(rings, widths));

  IcePhase result;
  result.deltaTransmission = traced.deltaTransmission;
  double total = 0;
  double cosine = 0;
  for (size_t i = 0; i <= LAST; ++i) {
    const double energy = curve.value[i] * rings.solidAngle[i];
    total += energy;
    cosine += energy * std::cos(angleOf(i));
  }
  result.asymmetry = cosine / total;
  for (const double angle : angles) {
    const double place = std::clamp(angle / STEP, 0.0, static_cast<double>(LAST));
    const size_t i = std::min(static_cast<size_t>(place), LAST - 1);
    const double t = place - static_cast<double>(i);
    result.phase.push_back((curve.value[i] * (1 - t) + curve.value[i + 1] * t) / total);
  }
  return result;
}

}  // namespace welkin
