// SPDX-License-Identifier: MIT
#include "reference/layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/quadrature.hpp"

namespace welkin::reference {
namespace {

constexpr double VACUUM = 60;  // scale heights above the base or the lowest point: e^-60 is nothing
constexpr double REACH = 23;   // scale heights of a column: the rest is 1e-10 of it
constexpr size_t NODES = 16;

struct Rule {
  std::array<double, NODES> node{};
  std::array<double, NODES> weight{};
  Rule() {
    const GaussRule rule = gaussLegendre(static_cast<int>(NODES));
    for (size_t i = 0; i < NODES; ++i) {
      node[i] = static_cast<double>(rule.node[i]);
      weight[i] = static_cast<double>(rule.weight[i]);
    }
  }
};

const Rule& rule() {
  static const Rule nodes;
  return nodes;
}

// Integral of e^(-rise / scaleHeight) over `length` of a ray that does not sink. The integrand is
// entire in t, between an exponential and a Gaussian: one panel is enough.
double risingColumn(const Climb& ray, double scaleHeight, double length) {
  const Rule& nodes = rule();
  const double end = std::min(length, ray.below(ray.altitude + REACH * scaleHeight).end);
  double sum = 0;
  for (size_t i = 0; i < NODES; ++i) {
    sum += nodes.weight[i] * std::exp(-ray.rise(nodes.node[i] * end) / scaleHeight);
  }
  return sum * end;
}

// The same over a plane: (1 - e^-x) / x times the length, x = mu length / scaleHeight.
double flatColumn(double mu, double scaleHeight, double length) {
  if (length == FAR) {
    return mu > 0 ? scaleHeight / mu : FAR;
  }
  const double x = mu * length / scaleHeight;
  return std::fabs(x) < 1e-12 ? length : -std::expm1(-x) / x * length;
}

}  // namespace

double ExponentialLayer::opticalDepth(const Climb& ray, size_t channel, double length) const {
  if (extinction[channel] <= 0 || length <= 0) {
    return 0;
  }
  const auto scale = [&](double altitude) {
    return extinction[channel] * std::exp(-(altitude - base) / scaleHeight);
  };
  if (ray.curvature == 0) {
    return scale(ray.altitude) * flatColumn(ray.mu, scaleHeight, length);
  }
  if (ray.mu >= 0) {
    return scale(ray.altitude) * risingColumn(ray, scaleHeight, length);
  }
  const double lowest = -ray.mu / ray.curvature;  // distance to the point nearest to the centre
  if (length <= lowest) {
    // The same stretch seen from its lower end.
    Climb back = ray.after(length);
    back.mu = -back.mu;
    return scale(back.altitude) * risingColumn(back, scaleHeight, length);
  }
  Climb low = ray.after(lowest);
  low.mu = 0;
  return scale(low.altitude) *
         (risingColumn(low, scaleHeight, lowest) + risingColumn(low, scaleHeight, length - lowest));
}

double ExponentialLayer::collision(const Climb& ray, size_t channel, double length,
                                   Random& random) const {
  if (extinction[channel] <= 0) {
    return FAR;
  }
  const Climb::Interval part = ray.below(base + VACUUM * scaleHeight);
  double t = part.begin;
  const double end = std::min(length, part.end);
  while (t < end) {
    const Climb here = ray.after(t);
    // So short that the majorant is at most e^0.7 times the density.
    const double reach = std::min(end - t, std::sqrt(1.4 * scaleHeight / here.curvature));
    const double beta = extinction[channel] * std::exp(-(here.altitude - base) / scaleHeight);
    const double free = random.exponential() / beta;
    const double x = free * here.mu / scaleHeight;
    // x >= 1: beyond the whole majorant of this stretch, which the next one replaces.
    const double s = x >= 1 ? FAR : std::fabs(x) < 1e-12 ? free : -std::log1p(-x) / x * free;
    if (!(s < reach)) {
      t += reach;
      continue;
    }
    t += s;
    const double excess = (here.rise(s) - here.mu * s) / scaleHeight;
    if (here.curvature == 0 || random.uniform() < std::exp(-excess)) {
      return t;
    }
  }
  return FAR;
}

Climb::Interval UniformLayer::within(const Climb& ray, double length) const {
  if (ray.mu == 0) {
    return {0, ray.altitude > bottom && ray.altitude < top ? length : 0};
  }
  const double a = (bottom - ray.altitude) / ray.mu;
  const double b = (top - ray.altitude) / ray.mu;
  return {std::max(std::min(a, b), 0.0), std::min(std::max(a, b), length)};
}

double UniformLayer::opticalDepth(const Climb& ray, size_t channel, double length) const {
  const Climb::Interval part = within(ray, length);
  return part.end > part.begin ? extinction[channel] * (part.end - part.begin) : 0.0;
}

double UniformLayer::collision(const Climb& ray, size_t channel, double length,
                               Random& random) const {
  const Climb::Interval part = within(ray, length);
  if (extinction[channel] <= 0 || part.end <= part.begin) {
    return FAR;
  }
  const double t = part.begin + random.exponential() / extinction[channel];
  return t < part.end ? t : FAR;
}

double AbsorbingLayer::opticalDepth(const Climb& ray, size_t channel, double length) const {
  if (extinction[channel] <= 0 || length <= 0) {
    return 0;
  }
  const auto density = [&](double altitude) {
    return std::max(1 - std::fabs(altitude - peak) / halfWidth, 0.0);
  };
  // Over a panel without a knot, which on a plane may be endless. A ray is level there.
  const auto column = [&](double from, double to) {
    const double begin = std::min(from, length);
    const double end = std::min(to, length);
    if (end <= begin) {
      return 0.0;
    }
    if (end == FAR) {
      return density(ray.altitude) > 0 ? FAR : 0.0;
    }
    double sum = 0;
    for (size_t i = 0; i < NODES; ++i) {
      const double t = begin + (end - begin) * rule().node[i];
      sum += rule().weight[i] * density(ray.altitude + ray.rise(t));
    }
    return sum * (end - begin);
  };
  // Where the ray is below each knot; a part that it does not reach is empty and at the end.
  Climb::Interval outer = ray.below(peak + halfWidth);
  double sum = 0;
  for (const double knot : {peak, std::max(peak - halfWidth, 0.0)}) {
    Climb::Interval inner = ray.below(knot);
    if (inner.end <= inner.begin) {
      inner = {outer.end, outer.end};
    }
    sum += column(outer.begin, inner.begin) + column(inner.end, outer.end);
    outer = inner;
  }
  return extinction[channel] * sum;
}

}  // namespace welkin::reference
