// SPDX-License-Identifier: MIT
#include "tables/sky_ray.hpp"

#include "model/air_input.hpp"
#include "model/model.hpp"

namespace welkin {
namespace {

using namespace model::f64;

// End of step i of `count`: dense towards the eye, or towards the densest point of a ray that
// sinks.
double stopAt(double lowest, double reach, int count, int i) {
  const auto quadratic = [](double from, double to, int n, int k, bool denseAtEnd) {
    const double x = static_cast<double>(k) / n;
    return from + (to - from) * (denseAtEnd ? x * (2 - x) : x * x);
  };
  const int half = count / 2;
  if (i >= count) {
    return reach;
  }
  if (lowest <= 0) {
    return quadratic(0, reach, count, i, false);
  }
  if (lowest >= reach) {
    return quadratic(0, reach, count, i, true);
  }
  return i < half ? quadratic(0, lowest, half, i, true)
                  : quadratic(lowest, reach, count - half, i - half, false);
}

}  // namespace

void planRay(const AirInput& input, const SkyAxes& axes, double altitude, double viewMu,
             double distance, int count, SkyRay& plan) {
  const Air air = airFrom(input);
  plan.steps.clear();
  plan.ground = -1;
  const double ground = groundDistance(altitude, viewMu, air.planetRadius);
  if (ground >= 0 && ground <= distance) {
    plan.ground = ground;
    distance = ground;
  }
  AirRay ray;
  ray.altitude = altitude;
  ray.viewMu = viewMu;
  ray.sunMu = 1;
  ray.viewSun = viewMu;
  const AirPath path = clipToAir(air, ray, distance);
  double before = 0;
  if (altitude > path.altitude) {
    // The path starts where the ray enters: the way there follows from its radius.
    const double r = air.planetRadius + altitude;
    const double rTop = air.planetRadius + path.altitude;
    before = -r * viewMu -
             std::sqrt(std::max((rTop - path.lowestRadius) * (rTop + path.lowestRadius), 0.0));
  }
  double columns[3] = {0, 0, 0};
  const auto depthOf = [&](size_t c) {
    const auto k = static_cast<int>(c);
    return air.airScattering[k] * columns[0] + air.fogExtinction * columns[1] +
           air.absorption[k] * columns[2];
  };
  if (path.reach > 0) {
    AirPoint near = airPoint(air, path, 0.0);
    for (int i = 0; i < count; ++i) {
      const AirPoint far = airPoint(air, path, stopAt(path.lowest, path.reach, count, i + 1));
      const AirSpan span = airSpan(air, path, near, far);
      const double length = far.distance - near.distance;
      SkyStep step{};
      double own[3];
      double start[3];
      for (size_t c = 0; c < 3; ++c) {
        start[c] = depthOf(c);
      }
      const double middleDepth = depthOfColumns(air, columnsOf(span)).y;
      columns[0] += span.air.column;
      columns[1] += span.fog.column;
      columns[2] += span.absorber;
      for (size_t c = 0; c < 3; ++c) {
        own[c] = depthOf(c) - start[c];
        const double seen =
            std::exp(-start[c]) * (own[c] > 1e-6 ? -std::expm1(-own[c]) / own[c] : 1 - own[c] / 2);
        const int k = static_cast<int>(c);
        step.air[c] = static_cast<float>(air.airScattering[k] * span.air.column * seen);
        step.fog[c] =
            static_cast<float>(air.fogExtinction * air.fogAlbedo[k] * span.fog.column * seen);
      }
      // Where the light comes from in the mean, by the attenuation in the middle of the spectrum.
      const double centre = middleDepth > 1e-3 ? 1 / middleDepth - 1 / std::expm1(middleDepth)
                                               : 0.5 - middleDepth / 12;
      const double at = near.distance + centre * length;
      step.distance = static_cast<float>(before + at);
      step.altitude = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, at);
      step.radius = static_cast<float>(air.planetRadius + step.altitude);
      step.high = nodeAt(axes.coordinate(step.altitude), SkyField::ALTITUDES);
      plan.steps.push_back(step);
      near = far;
    }
  }
  for (size_t c = 0; c < 3; ++c) {
    plan.atGround[c] = static_cast<float>(std::exp(-depthOf(c)));
  }
}

namespace {

float rootOf(float x) {
  return std::sqrt(std::max(x, 0.0F));
}

}  // namespace

SkyPlace placeAt(const SkyAim& aim, const SkyStep& step) {
  const float scale = 1 / step.radius;
  SkyPlace place;
  place.sunMu =
      std::clamp((aim.radius * aim.sunMu + step.distance * aim.viewSun) * scale, -1.0F, 1.0F);
  place.view.y = std::clamp((aim.radius * aim.viewMu + step.distance) * scale, -1.0F, 1.0F);
  const float sine = rootOf((1 - place.sunMu) * (1 + place.sunMu));
  const float flat = rootOf((1 - place.view.y) * (1 + place.view.y));
  const float x = (aim.viewSun - place.sunMu * place.view.y) / std::max(sine, 1e-4F);
  place.view.x = std::clamp(x, -flat, flat);
  place.view.z = rootOf((flat - place.view.x) * (flat + place.view.x));
  return place;
}

}  // namespace welkin
