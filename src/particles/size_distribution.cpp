// SPDX-License-Identifier: MIT
#include "particles/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

// A normal distribution beyond 4.5 standard deviations: 3.4e-6.
constexpr double TAIL = 4.5;

// Largest or smallest z at which z^shape e^-z, a gamma density over ln z, has fallen to e^-(TAIL^2
// / 2 + 1) of its maximum at z = shape: tails below 1e-5 for every shape >= 3.
double gammaTail(double shape, bool above) {
  const double wanted = -(TAIL * TAIL / 2 + 1);
  const auto fall = [&](double z) { return shape * std::log(z / shape) - (z - shape); };
  double inside = shape;
  double outside = shape;
  while (fall(outside) > wanted) {
    outside *= above ? 2 : 0.5;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + outside) / 2;
    (fall(middle) > wanted ? inside : outside) = middle;
  }
  return outside;
}

}  // namespace

double sizeDensity(const SizeDistribution& sizes, double radius_um) {
  const double z = radius_um / sizes.radius_um;
  if (z <= 0 || sizes.kind == SizeKind::Monodisperse) {
    return 0;
  }
  if (sizes.kind == SizeKind::LogNormal) {
    const double t = std::log(z) / sizes.spread;
    return std::exp(-t * t / 2) /
           (radius_um * sizes.spread * std::sqrt(2 * std::numbers::pi));
  }
  return std::exp((sizes.spread - 1) * std::log(z) - z - std::lgamma(sizes.spread)) /
         sizes.radius_um;
}

double meanPower(const SizeDistribution& sizes, double power) {
  double relative = 1;
  if (sizes.kind == SizeKind::LogNormal) {
    const double t = power * sizes.spread;
    relative = std::exp(t * t / 2);
  } else if (sizes.kind == SizeKind::Gamma) {
    relative = std::exp(std::lgamma(sizes.spread + power) - std::lgamma(sizes.spread));
  }
  return std::pow(sizes.radius_um, power) * relative;
}

double effectiveRadius(const SizeDistribution& sizes) {
  return meanPower(sizes, 3) / meanPower(sizes, 2);
}

SizeRange sizeRange(const SizeDistribution& sizes) {
  double low = 1;
  double high = 1;
  if (sizes.kind == SizeKind::LogNormal) {  // r^k n(r) is log-normal about exp(k s^2) r_median
    const double s = sizes.spread;
    low = std::exp(2 * s * s - TAIL * s);
    high = std::exp(4 * s * s + TAIL * s);
  } else if (sizes.kind == SizeKind::Gamma) {
    low = gammaTail(sizes.spread + 2, false);
    high = gammaTail(sizes.spread + 4, true);
  }
  return {low * sizes.radius_um, high * sizes.radius_um};
}

double logSpread(const SizeDistribution& sizes) {
  switch (sizes.kind) {
    case SizeKind::LogNormal:
      return sizes.spread;
    case SizeKind::Gamma:
      return 1 / std::sqrt(sizes.spread + 2);
    case SizeKind::Monodisperse:
      break;
  }
  return 0;
}

SizeNodes sizeNodes(std::span<const SizeDistribution> sizes, double logStep, double offset) {
  SizeNodes nodes;
  const auto add = [&](double radius) {
    nodes.radius_um.push_back(radius);
    nodes.weight.resize(nodes.weight.size() + sizes.size(), 0.0);
    return nodes.weight.end() - static_cast<std::ptrdiff_t>(sizes.size());
  };
  std::vector<SizeRange> ranges;
  for (const SizeDistribution& one : sizes) {
    ranges.push_back(sizeRange(one));
  }
  double next = 0;  // the radius below which every node is done
  for (;;) {
    // The next radius that any spread distribution covers.
    double start = std::numeric_limits<double>::infinity();
    for (size_t d = 0; d < sizes.size(); ++d) {
      if (sizes[d].kind != SizeKind::Monodisperse && ranges[d].high_um > next) {
        start = std::min(start, std::max(next, ranges[d].low_um));
      }
    }
    if (std::isinf(start)) {
      break;
    }
    const double place = std::floor(std::log(start) / logStep - offset) + 1;
    const double radius = std::exp((place + offset) * logStep);
    next = std::nextafter(radius, std::numeric_limits<double>::infinity());
    const auto weight = add(radius);
    for (size_t d = 0; d < sizes.size(); ++d) {
      if (radius >= ranges[d].low_um && radius <= ranges[d].high_um) {
        weight[static_cast<std::ptrdiff_t>(d)] = sizeDensity(sizes[d], radius) * radius * logStep;
      }
    }
  }
  return nodes;
}

}  // namespace welkin
