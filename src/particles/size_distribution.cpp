// SPDX-License-Identifier: MIT
#include "particles/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
    return std::exp(-t * t / 2) / (radius_um * sizes.spread * std::sqrt(2 * std::numbers::pi));
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
  std::vector<SizeRange> ranges;
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (size_t d = 0; d < sizes.size(); ++d) {
    ranges.push_back(sizeRange(sizes[d]));
    if (sizes[d].kind == SizeKind::Monodisperse) {
      nodes.radius_um.push_back(sizes[d].radius_um);
      nodes.weight.resize(nodes.weight.size() + sizes.size(), 0.0);
      nodes.weight[nodes.weight.size() - sizes.size() + d] = 1;
    } else {
      low = std::min(low, ranges[d].low_um);
      high = std::max(high, ranges[d].high_um);
    }
  }
  if (high == 0) {
    return nodes;
  }
  const auto first = static_cast<long>(std::ceil(std::log(low) / logStep - offset));
  const auto last = static_cast<long>(std::floor(std::log(high) / logStep - offset));
  std::vector<double> weight(sizes.size());
  for (long i = first; i <= last; ++i) {
    const double radius = std::exp((static_cast<double>(i) + offset) * logStep);
    bool used = false;
    for (size_t d = 0; d < sizes.size(); ++d) {
      const bool inside = radius >= ranges[d].low_um && radius <= ranges[d].high_um;
      weight[d] = inside ? sizeDensity(sizes[d], radius) * radius * logStep : 0;
      used = used || weight[d] > 0;
    }
    if (used) {
      nodes.radius_um.push_back(radius);
      nodes.weight.insert(nodes.weight.end(), weight.begin(), weight.end());
    }
  }
  return nodes;
}

}  // namespace welkin
