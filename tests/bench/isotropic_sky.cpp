// SPDX-License-Identifier: MIT
#include "bench/isotropic_sky.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace bench {
namespace {

using welkin::AirInput;
using welkin::SkyColor;

constexpr double PI = std::numbers::pi;
constexpr double ISOTROPIC = 1 / (4 * PI);
constexpr double TOP = 1e5;  // of the air, as published for the Earth

// Directions over the hemisphere for light on the ground, which the paper leaves to the renderer;
// twice as many in each angle change multiple scattering by 6e-3 at most.
constexpr int GROUND_ZENITHS = 24;
constexpr int GROUND_AZIMUTHS = 24;  // of half the circle

double altitudeAt(double altitude, double viewMu, double radius, double distance) {
  const double r = radius + altitude;
  const double q = distance * (2 * r * viewMu + distance) + altitude * (2 * radius + altitude);
  return q / (std::sqrt(radius * radius + q) + radius);
}

// Distance to the top of the air from below it.
double topDistance(double altitude, double viewMu, double radius) {
  const double r = radius + altitude;
  const double rise = (TOP - altitude) * (2 * radius + TOP + altitude);
  return std::sqrt(r * r * viewMu * viewMu + rise) - r * viewMu;
}

struct Coefficients {
  SkyColor scattering;
  SkyColor extinction;
};

Coefficients coefficientsAt(const AirInput& air, double altitude) {
  const double density = std::exp(-altitude / air.airScaleHeight);
  const double fog =
      air.fogExtinction * std::exp((air.fogBaseAltitude - altitude) / air.fogScaleHeight);
  Coefficients result{};
  for (size_t c = 0; c < 3; ++c) {
    result.scattering[c] = air.airScattering[c] * density + air.fogAlbedo[c] * fog;
    result.extinction[c] = air.airScattering[c] * density + fog;
  }
  return result;
}

// What reaches a point of the light itself.
SkyColor lightAt(const welkin::SkyFieldInput& input, double altitude, double sunMu) {
  double depth[3];
  double visibility = 0;
  welkin::evalLightDepth(input.air, altitude, sunMu, input.lightAngularRadius, depth, &visibility);
  SkyColor light{};
  for (size_t c = 0; c < 3; ++c) {
    light[c] = visibility > 0 ? visibility * std::exp(-depth[c]) : 0;
  }
  return light;
}

// Scattering coefficient times attenuation, integrated over a step of constant coefficients.
double stepWeight(double scattering, double extinction, double length, double depthBefore) {
  const double own = extinction * length;
  const double mean = own > 1e-6 ? -std::expm1(-own) / own : 1 - own / 2;
  return scattering * length * mean * std::exp(-depthBefore);
}

double cosineAfter(double radius, double there, double cosine, double distance, double along) {
  return std::clamp((radius * cosine + distance * along) / there, -1.0, 1.0);
}

double henyeyGreenstein(double g, double cosine) {
  return (1 - g * g) * ISOTROPIC / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

}  // namespace

IsotropicSky::IsotropicSky(const welkin::SkyFieldInput& input) : input_(input) {
  for (int a = 0; a < NODES; ++a) {
    for (int s = 0; s < NODES; ++s) {
      table_.push_back(solveNode(TOP * a / (NODES - 1), 2.0 * s / (NODES - 1) - 1));
    }
  }
}

// Once-scattered light that arrives, its phase function isotropic, and what would arrive if every
// point shone with radiance 1 (the transfer factor); the mean of both over all directions.
SkyColor IsotropicSky::solveNode(double altitude, double sunMu) const {
  const AirInput& air = input_.air;
  const double r = air.planetRadius + altitude;
  SkyColor second{};
  SkyColor transfer{};
  for (int i = 0; i < DIRECTIONS * DIRECTIONS; ++i) {
    const double viewMu = 1 - 2 * (i / DIRECTIONS + 0.5) / DIRECTIONS;
    const double azimuth = 2 * PI * (i % DIRECTIONS + 0.5) / DIRECTIONS;
    const double viewSun =
        viewMu * sunMu + std::sqrt((1 - viewMu * viewMu) * (1 - sunMu * sunMu)) * std::cos(azimuth);
    const double ground = welkin::evalGroundDistance(altitude, viewMu, air.planetRadius);
    const double length =
        (ground >= 0 ? ground : topDistance(altitude, viewMu, air.planetRadius)) / STEPS;
    SkyColor depth{};
    for (int k = 0; k < STEPS; ++k) {
      const double t = (k + 0.5) * length;
      const double h = altitudeAt(altitude, viewMu, air.planetRadius, t);
      const Coefficients here = coefficientsAt(air, h);
      const SkyColor light =
          lightAt(input_, h, cosineAfter(r, air.planetRadius + h, sunMu, t, viewSun));
      for (size_t c = 0; c < 3; ++c) {
        const double weight = stepWeight(here.scattering[c], here.extinction[c], length, depth[c]);
        transfer[c] += weight;
        second[c] += weight * ISOTROPIC * light[c];
        depth[c] += here.extinction[c] * length;
      }
    }
    if (ground >= 0) {
      const double foot = cosineAfter(r, air.planetRadius, sunMu, ground, viewSun);
      const SkyColor light = lightAt(input_, 0, foot);
      for (size_t c = 0; c < 3; ++c) {
        second[c] +=
            std::exp(-depth[c]) * input_.groundAlbedo[c] / PI * std::max(foot, 0.0) * light[c];
      }
    }
  }
  SkyColor mean{};
  for (size_t c = 0; c < 3; ++c) {
    constexpr double SHARE = 1.0 / (DIRECTIONS * DIRECTIONS);
    mean[c] = second[c] * SHARE / (1 - transfer[c] * SHARE);
  }
  return mean;
}

SkyColor IsotropicSky::meanAt(double altitude, double sunMu) const {
  const double x = std::clamp(altitude / TOP, 0.0, 1.0) * (NODES - 1);
  const double y = (0.5 + 0.5 * sunMu) * (NODES - 1);
  const int a = std::min(static_cast<int>(x), NODES - 2);
  const int s = std::min(static_cast<int>(y), NODES - 2);
  const double u = x - a;
  const double v = y - s;
  const SkyColor* low = table_.data() + a * NODES + s;
  const SkyColor* high = low + NODES;
  SkyColor mean{};
  for (size_t c = 0; c < 3; ++c) {
    mean[c] = (1 - u) * ((1 - v) * low[0][c] + v * low[1][c]) +
              u * ((1 - v) * high[0][c] + v * high[1][c]);
  }
  return mean;
}

// Along a ray inside the air that ends before the ground; steps dense towards the eye.
SkyColor IsotropicSky::airLight(double altitude, double viewMu, double sunMu, double viewSun,
                                double distance, int steps, SkyColor& depth) const {
  const AirInput& air = input_.air;
  const double r = air.planetRadius + altitude;
  SkyColor radiance{};
  depth = {};
  for (int k = 0; k < steps; ++k) {
    const double begin = distance * k * k / (steps * steps);
    const double end = distance * (k + 1) * (k + 1) / (steps * steps);
    const double t = 0.5 * (begin + end);
    const double h = altitudeAt(altitude, viewMu, air.planetRadius, t);
    const Coefficients here = coefficientsAt(air, h);
    const SkyColor mean = meanAt(h, cosineAfter(r, air.planetRadius + h, sunMu, t, viewSun));
    for (size_t c = 0; c < 3; ++c) {
      radiance[c] +=
          mean[c] * stepWeight(here.scattering[c], here.extinction[c], end - begin, depth[c]);
      depth[c] += here.extinction[c] * (end - begin);
    }
  }
  return radiance;
}

// Irradiance of the sky on the ground: of this scheme and of exact single scattering, the fog's
// phase function that of Henyey and Greenstein with the mean cosine given.
SkyColor IsotropicSky::groundLight(double sunMu) const {
  SkyColor irradiance{};
  for (int i = 0; i < GROUND_ZENITHS * GROUND_AZIMUTHS; ++i) {
    const double viewMu = (i / GROUND_AZIMUTHS + 0.5) / GROUND_ZENITHS;
    const double weight = 2 * PI * viewMu / (GROUND_ZENITHS * GROUND_AZIMUTHS);
    const double azimuth = PI * (i % GROUND_AZIMUTHS + 0.5) / GROUND_AZIMUTHS;
    const double viewSun =
        viewMu * sunMu + std::sqrt((1 - viewMu * viewMu) * (1 - sunMu * sunMu)) * std::cos(azimuth);
    SkyColor phase{};
    for (size_t c = 0; c < 3; ++c) {
      phase[c] = henyeyGreenstein(input_.fogMoments[0][c], viewSun);
    }
    SkyColor single{};
    SkyColor depth{};
    welkin::evalAirRay(input_.air, 0, viewMu, sunMu, viewSun,
                       std::numeric_limits<double>::infinity(), phase.data(),
                       input_.lightAngularRadius, single.data(), depth.data());
    const SkyColor multiple = airLight(
        0, viewMu, sunMu, viewSun, topDistance(0, viewMu, input_.air.planetRadius), STEPS, depth);
    for (size_t c = 0; c < 3; ++c) {
      irradiance[c] += weight * (single[c] + multiple[c]);
    }
  }
  return irradiance;
}

SkyColor IsotropicSky::radianceAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                     double distance, int steps) const {
  const double radius = input_.air.planetRadius;
  const double ground = welkin::evalGroundDistance(altitude, viewMu, radius);
  const bool grounded = ground >= 0 && ground <= distance;
  const double end = grounded ? ground : std::min(distance, topDistance(altitude, viewMu, radius));
  SkyColor depth{};
  SkyColor radiance = airLight(altitude, viewMu, sunMu, viewSun, end, steps, depth);
  if (grounded) {
    const SkyColor light =
        groundLight(cosineAfter(radius + altitude, radius, sunMu, ground, viewSun));
    for (size_t c = 0; c < 3; ++c) {
      radiance[c] += std::exp(-depth[c]) * input_.groundAlbedo[c] / PI * light[c];
    }
  }
  return radiance;
}

}  // namespace bench
