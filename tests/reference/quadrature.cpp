// SPDX-License-Identifier: MIT
#include "reference/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace welkin::reference {
namespace {

constexpr long double PI = 3.14159265358979323846264338327950288L;

// Depth from the eye to t. [R04] Eq. 11.
long double depthTo(const FlatRay& ray, long double t) {
  const long double rate = ray.inverseScaleHeight * ray.viewSlope;
  return rate == 0.0L ? ray.extinction * t : -ray.extinction * std::expm1(-rate * t) / rate;
}

// ln of the integrand of [R04] Eq. 14 over beta. One exponential: e^x from expm1(x) or the reverse,
// whichever does not cancel.
long double logIntegrand(const FlatRay& ray, long double t) {
  const long double rate = ray.inverseScaleHeight * ray.viewSlope;
  const long double fall = rate * t;
  const bool small = std::fabs(fall) < 1.0L;
  const long double e = small ? std::expm1(-fall) : std::exp(-fall);
  const long double density = small ? 1.0L + e : e;
  const long double less = small ? -e : 1.0L - e;
  const long double depth = rate == 0.0L ? ray.extinction * t : ray.extinction * less / rate;
  const long double light = ray.extinction * density / (ray.inverseScaleHeight * ray.lightSlope);
  return -fall - depth - light;
}

// The stretch on which the integrand can matter: 80 scale heights, 80 lengths of total extinction.
long double effectiveEnd(const FlatRay& ray) {
  long double end = ray.distance;
  const long double rate = std::fabs(ray.inverseScaleHeight * ray.viewSlope);
  if (rate > 0.0L) {
    end = std::min(end, 80.0L / rate);
  }
  if (ray.viewSlope <= 0.0L && ray.extinction > 0.0L) {
    end = std::min(end, 120.0L / ray.extinction);
  }
  return end;
}

}  // namespace

GaussRule gaussLegendre(int count) {
  GaussRule rule;
  for (int i = 0; i < count; ++i) {
    long double x = std::cos(PI * (static_cast<long double>(i) + 0.75L) /
                             (static_cast<long double>(count) + 0.5L));
    long double slope = 1.0L;
    for (int pass = 0; pass < 100; ++pass) {
      long double p0 = 1.0L;
      long double p1 = x;
      for (int n = 2; n <= count; ++n) {
        const auto k = static_cast<long double>(n);
        const long double p2 = ((2.0L * k - 1.0L) * x * p1 - (k - 1.0L) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = static_cast<long double>(count) * (x * p1 - p0) / (x * x - 1.0L);
      const long double step = p1 / slope;
      x -= step;
      if (std::fabs(step) < 4.0L * std::numeric_limits<long double>::epsilon()) {
        break;
      }
    }
    rule.node.push_back(0.5L * (1.0L - x));
    rule.weight.push_back(1.0L / ((1.0L - x * x) * slope * slope));
  }
  return rule;
}

long double flatOpticalDepth(const FlatRay& ray) {
  return depthTo(ray, ray.distance);
}

long double flatInscatter(const FlatRay& ray) {
  static const GaussRule fine = gaussLegendre(22);
  static const GaussRule coarse = gaussLegendre(8);  // where the integrand changes by < e^0.5
  constexpr int GRADES = 22;                         // factors of 4: 6e-14 of the stretch
  constexpr int HEIGHTS = 80;                        // scale heights along the ray
  std::array<long double, 2 * GRADES + HEIGHTS + 2> cut{};
  std::size_t count = 0;
  const long double end = effectiveEnd(ray);
  cut[count++] = 0.0L;
  cut[count++] = end;
  long double fraction = 1.0L;
  for (int i = 0; i < GRADES; ++i) {
    fraction /= 4.0L;
    cut[count++] = end * fraction;
    cut[count++] = end - end * fraction;
  }
  const long double rate = std::fabs(ray.inverseScaleHeight * ray.viewSlope);
  for (int i = 1; i < HEIGHTS && rate * end > static_cast<long double>(i); ++i) {
    cut[count++] = static_cast<long double>(i) / rate;
  }
  std::sort(cut.begin(), cut.begin() + static_cast<std::ptrdiff_t>(count));

  std::array<long double, 2 * GRADES + HEIGHTS + 2> height{};
  long double highest = -std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    height[i] = logIntegrand(ray, cut[i]);
    highest = std::max(highest, height[i]);
  }
  // Panels more than e^-45 below the peak at both ends are left out: peaks are wider than panels.
  long double sum = 0.0L;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const long double width = cut[i + 1] - cut[i];
    if (!(width > 0.0L) || std::max(height[i], height[i + 1]) < highest - 45.0L) {
      continue;
    }
    const GaussRule& rule = std::fabs(height[i + 1] - height[i]) < 0.5L ? coarse : fine;
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const long double t = cut[i] + width * rule.node[k];
      sum += rule.weight[k] * width * std::exp(logIntegrand(ray, t));
    }
  }
  return ray.extinction * sum;
}

}  // namespace welkin::reference
