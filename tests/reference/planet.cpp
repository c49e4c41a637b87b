// SPDX-License-Identifier: MIT
#include "reference/planet.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "reference/quadrature.hpp"

namespace welkin::reference {
namespace {

constexpr double DARK = 1e-6;    // radiance below which errors do not count
constexpr double VACUUM = 40.0;  // scale heights after which a density no longer counts

double altitudeAt(const Planet& planet, double altitude, double mu, double t) {
  const long double r = static_cast<long double>(planet.radius) + altitude;
  const long double up = r + static_cast<long double>(mu) * t;
  const long double across2 =
      (1.0L - static_cast<long double>(mu) * mu) * static_cast<long double>(t) * t;
  return static_cast<double>(std::sqrt(up * up + across2) - planet.radius);
}

// Distances at which the ray leaves the spheres through the given altitudes, ascending half.
double halfChord(const Planet& planet, double lowestRadius, double altitude) {
  const double r = planet.radius + altitude;
  return r > lowestRadius ? std::sqrt((r - lowestRadius) * (r + lowestRadius)) : 0.0;
}

// Ends of panels on which the layer's density changes by at most about e.
std::vector<double> layerCuts(const Planet& planet, double altitude, double mu, double length,
                              double base, double scaleHeight) {
  const double r = planet.radius + altitude;
  const double lowestRadius = r * std::sqrt(std::max((1.0 - mu) * (1.0 + mu), 0.0));
  const double lowest = -r * mu;
  const double lowestAltitude = lowestRadius - planet.radius;
  const double start =
      std::min(altitude, altitudeAt(planet, altitude, mu, std::clamp(lowest, 0.0, length)));
  std::vector<double> cuts;
  const double top = std::max(start, base) + VACUUM * scaleHeight;
  const double reach = halfChord(planet, lowestRadius, top);
  const double begin = std::clamp(lowest - reach, 0.0, length);
  const double end = std::clamp(lowest + reach, 0.0, length);
  cuts.push_back(begin);
  cuts.push_back(end);
  const double first = std::max(start, lowestAltitude);
  for (int i = 0; i < 24; ++i) {
    // Four panels within the first scale height, where a grazing ray is curved most.
    const double rise = i < 4 ? 0.05 * i * i : static_cast<double>(i - 3);
    const double half = halfChord(planet, lowestRadius, first + rise * scaleHeight);
    for (const double t : {lowest - half, lowest + half}) {
      if (t > begin && t < end) {
        cuts.push_back(t);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

double layerColumn(const Planet& planet, double altitude, double mu, double length, double base,
                   double scaleHeight) {
  static const GaussRule rule = gaussLegendre(8);
  const std::vector<double> cuts = layerCuts(planet, altitude, mu, length, base, scaleHeight);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double width = cuts[i + 1] - cuts[i];
    for (std::size_t k = 0; width > 0.0 && k < rule.node.size(); ++k) {
      const double t = cuts[i] + width * static_cast<double>(rule.node[k]);
      const double h = altitudeAt(planet, altitude, mu, t);
      sum += static_cast<double>(rule.weight[k]) * width * std::exp((base - h) / scaleHeight);
    }
  }
  return sum;
}

bool absorbs(const Planet& planet) {
  return *std::max_element(planet.absorption.begin(), planet.absorption.end()) > 0.0;
}

// Ends of panels on which the absorber's density is smooth: the spheres through its knots, each met
// twice, and the lowest point. Between them the altitude is a hyperbola of the distance, with its
// singularities at +-i times the lowest radius: panels grow no faster than that distance does.
std::vector<double> absorberCuts(const Planet& planet, double altitude, double mu, double length) {
  const double r = planet.radius + altitude;
  const double lowestRadius = r * std::sqrt(std::max((1.0 - mu) * (1.0 + mu), 0.0));
  const double lowest = -r * mu;
  const double bottom = std::max(planet.absorberPeak - planet.absorberWidth, 0.0);
  std::vector<double> halves = {0.0};
  for (const double knot :
       {bottom, planet.absorberPeak, planet.absorberPeak + planet.absorberWidth}) {
    const double end = halfChord(planet, lowestRadius, knot);
    double next = std::max(2.0 * halves.back(), lowestRadius);
    for (; 0.0 < next && next < end; next *= 2.0) {
      halves.push_back(next);
    }
    halves.push_back(end);
  }
  std::vector<double> cuts;
  for (const double half : halves) {
    cuts.push_back(std::clamp(lowest - half, 0.0, length));
    cuts.push_back(std::clamp(lowest + half, 0.0, length));
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

double absorberDensity(const Planet& planet, double altitude) {
  const double fall = std::fabs(altitude - planet.absorberPeak) / planet.absorberWidth;
  return altitude >= 0.0 ? std::max(1.0 - fall, 0.0) : 0.0;
}

double absorberColumn(const Planet& planet, double altitude, double mu, double length) {
  static const GaussRule rule = gaussLegendre(12);
  const std::vector<double> cuts = absorberCuts(planet, altitude, mu, length);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double width = cuts[i + 1] - cuts[i];
    for (std::size_t k = 0; width > 0.0 && k < rule.node.size(); ++k) {
      const double t = cuts[i] + width * static_cast<double>(rule.node[k]);
      const double h = altitudeAt(planet, altitude, mu, t);
      sum += static_cast<double>(rule.weight[k]) * width * absorberDensity(planet, h);
    }
  }
  return sum;
}

struct Integrand {
  const Planet& planet;
  const PlanetRay& ray;
  double airPhase;
  double fogPhase;
  double angularRadius;
  const GaussRule& rule;

  // Radiance of [t0, t1] seen from the origin, `before` in front of t0.
  std::array<double, 3> panel(double t0, double t1, const Columns& before) const {
    std::array<double, 3> sum = {0.0, 0.0, 0.0};
    const double r = planet.radius + ray.altitude;
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double t = t0 + (t1 - t0) * static_cast<double>(rule.node[k]);
      const double h = altitudeAt(planet, ray.altitude, ray.viewMu, t);
      const double mu =
          std::clamp((r * ray.lightMu + t * ray.viewLight) / (planet.radius + h), -1.0, 1.0);
      const double lit = visibleFraction(planet, h, mu, angularRadius);
      if (lit <= 0.0) {
        continue;
      }
      const double r0 = planet.radius + altitudeAt(planet, ray.altitude, ray.viewMu, t0);
      const double mu0 = std::clamp((r * ray.viewMu + t0) / r0, -1.0, 1.0);
      Columns path = columns(planet, r0 - planet.radius, mu0, t - t0);
      const Columns light = columns(planet, h, mu, std::numeric_limits<double>::infinity());
      path.air += before.air + light.air;
      path.fog += before.fog + light.fog;
      path.absorber += before.absorber + light.absorber;
      const std::array<double, 3> depth = depthOf(planet, path);
      const double air = std::exp(-h / planet.airScaleHeight);
      const double fog =
          planet.fogExtinction * std::exp((planet.fogBaseAltitude - h) / planet.fogScaleHeight);
      for (std::size_t c = 0; c < 3; ++c) {
        const double source =
            planet.airScattering[c] * air * airPhase + fog * planet.fogAlbedo[c] * fogPhase;
        sum[c] +=
            static_cast<double>(rule.weight[k]) * (t1 - t0) * lit * source * std::exp(-depth[c]);
      }
    }
    return sum;
  }

  // Bisects until halves and whole agree to `allowed`.
  std::array<double, 3> refine(double t0, double t1, const Columns& before,
                               const std::array<double, 3>& whole, double allowed,
                               int level) const {
    const double middle = 0.5 * (t0 + t1);
    const double r = planet.radius + ray.altitude;
    const double h = altitudeAt(planet, ray.altitude, ray.viewMu, t0);
    const double mu = std::clamp((r * ray.viewMu + t0) / (planet.radius + h), -1.0, 1.0);
    const Columns half = columns(planet, h, mu, middle - t0);
    const Columns between = {before.air + half.air, before.fog + half.fog,
                             before.absorber + half.absorber};
    const std::array<double, 3> a = panel(t0, middle, before);
    const std::array<double, 3> b = panel(middle, t1, between);
    double error = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      error = std::max(error, std::fabs(a[c] + b[c] - whole[c]));
    }
    if (error <= allowed || level >= 12) {
      return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    }
    const std::array<double, 3> x = refine(t0, middle, before, a, allowed, level + 1);
    const std::array<double, 3> y = refine(middle, t1, between, b, allowed, level + 1);
    return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
  }
};

}  // namespace

Columns columns(const Planet& planet, double altitude, double mu, double length) {
  Columns c{};
  c.air = layerColumn(planet, altitude, mu, length, 0.0, planet.airScaleHeight);
  if (planet.fogExtinction > 0.0) {
    c.fog =
        layerColumn(planet, altitude, mu, length, planet.fogBaseAltitude, planet.fogScaleHeight);
  }
  if (absorbs(planet)) {
    c.absorber = absorberColumn(planet, altitude, mu, length);
  }
  return c;
}

std::array<double, 3> depthOf(const Planet& planet, const Columns& c) {
  std::array<double, 3> depth{};
  for (std::size_t i = 0; i < 3; ++i) {
    depth[i] = planet.airScattering[i] * c.air + planet.fogExtinction * c.fog +
               planet.absorption[i] * c.absorber;
  }
  return depth;
}

double visibleFraction(const Planet& planet, double altitude, double lightMu,
                       double angularRadius) {
  const double h = std::max(altitude, 0.0);
  const double horizon = std::acos(planet.radius / (planet.radius + h));
  const double height = std::asin(std::clamp(lightMu, -1.0, 1.0)) + horizon;
  if (angularRadius <= 0.0 || std::fabs(height) >= angularRadius) {
    return height > 0.0 ? 1.0 : 0.0;
  }
  const double x = height / angularRadius;
  return 0.5 + (std::asin(x) + x * std::sqrt(1.0 - x * x)) / std::acos(-1.0);
}

std::array<double, 3> inscatter(const Planet& planet, const PlanetRay& ray, double airPhase,
                                double fogPhase, double angularRadius, double tolerance) {
  static const GaussRule rule = gaussLegendre(5);
  std::vector<double> cuts =
      layerCuts(planet, ray.altitude, ray.viewMu, ray.length, 0.0, planet.airScaleHeight);
  if (planet.fogExtinction > 0.0) {
    const std::vector<double> fog = layerCuts(planet, ray.altitude, ray.viewMu, ray.length,
                                              planet.fogBaseAltitude, planet.fogScaleHeight);
    cuts.insert(cuts.end(), fog.begin(), fog.end());
  }
  if (absorbs(planet)) {
    // Where its column has a bend.
    const std::vector<double> knots = absorberCuts(planet, ray.altitude, ray.viewMu, ray.length);
    cuts.insert(cuts.end(), knots.begin(), knots.end());
  }
  std::sort(cuts.begin(), cuts.end());
  const Integrand f{planet, ray, airPhase, fogPhase, angularRadius, rule};
  const double r = planet.radius + ray.altitude;
  std::vector<Columns> before(cuts.size());
  std::vector<std::array<double, 3>> coarse(cuts.size());
  Columns sum{};
  double total = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    before[i] = sum;
    coarse[i] = f.panel(cuts[i], cuts[i + 1], sum);
    total += std::max({coarse[i][0], coarse[i][1], coarse[i][2]});
    const double h = altitudeAt(planet, ray.altitude, ray.viewMu, cuts[i]);
    const double mu = std::clamp((r * ray.viewMu + cuts[i]) / (planet.radius + h), -1.0, 1.0);
    const Columns part = columns(planet, h, mu, cuts[i + 1] - cuts[i]);
    sum.air += part.air;
    sum.fog += part.fog;
    sum.absorber += part.absorber;
  }
  std::array<double, 3> result = {0.0, 0.0, 0.0};
  const double allowed = tolerance * std::max(total, DARK) / static_cast<double>(cuts.size());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] <= cuts[i]) {
      continue;
    }
    const std::array<double, 3> part =
        f.refine(cuts[i], cuts[i + 1], before[i], coarse[i], allowed, 0);
    for (std::size_t c = 0; c < 3; ++c) {
      result[c] += part[c];
    }
  }
  return result;
}

}  // namespace welkin::reference
