// SPDX-License-Identifier: MIT
#include "tables/sky_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/air_input.hpp"
#include "model/model.hpp"
#include "tables/sky_ray.hpp"

namespace welkin {

namespace {

using namespace model::f64;

constexpr double PI = std::numbers::pi;

}  // namespace

SkyField::Moments SkyField::momentsAt(double altitude, double sunMu) const {
  const SkyNode sun = nodeAt(SkyAxes::sunCoordinate(sunMu), SUNS);
  float pair[2 * VALUES];
  blendAltitudes(moments_, nodeAt(SkyAxes(air_).coordinate(altitude), ALTITUDES),
                 sun.index * VALUES, 2 * VALUES, pair);
  Moments result{};
  for (size_t k = 0; k < MOMENTS; ++k) {
    for (size_t c = 0; c < 3; ++c) {
      const float* value = pair + LANES * k + c;
      result[k][c] = (1 - sun.share) * static_cast<double>(value[0]) +
                     sun.share * static_cast<double>(value[VALUES]);
    }
  }
  return result;
}

double SkyField::top() const {
  return SkyAxes(air_).top();
}

SkyColor SkyField::peakIrradianceAt(double altitude, double sunMu) const {
  const Air airs[2] = {airFrom(air_), airFrom(attenuated_)};
  const double visible = lightVisibility(airs[0], altitude, sunMu, lightAngularRadius_);
  const vec3 all = lightOpticalDepth(airs[0], altitude, sunMu);
  const vec3 less = lightOpticalDepth(airs[1], altitude, sunMu);
  SkyColor result{};
  for (int c = 0; c < 3; ++c) {
    result[static_cast<size_t>(c)] =
        visible * std::max(std::exp(-all[c]) - std::exp(-less[c]), 0.0);
  }
  return result;
}

SkyColor SkyField::irradianceAt(double sunMu) const {
  const Lanes lanes = irradianceIn(irradiance_, sunMu);
  return {static_cast<double>(lanes[0]), static_cast<double>(lanes[1]),
          static_cast<double>(lanes[2])};
}

SkyColor SkyField::radianceAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                 double distance, int steps) const {
  const SkyAxes axes(air_);
  const SkyRay plan = planRay(eye_, axes, altitude, viewMu, distance, steps);
  const FogTerms terms = fogTerms(eyeMoments_);
  const double r = air_.planetRadius + altitude;
  const SkyAim aim{static_cast<float>(r), static_cast<float>(viewMu), static_cast<float>(sunMu),
                   static_cast<float>(viewSun)};
  SkyColor result{};
  for (const SkyStep& step : plan.steps) {
    const SkyPlace place = placeAt(aim, step);
    const SkyNode sun = sunNode(place.sunMu);
    float pair[2 * VALUES];
    blendAltitudes(moments_, step.high, sun.index * VALUES, 2 * VALUES, pair);
    const SkyLight g = gatherMoments(pair, place.view, {0, sun.share});
    for (size_t c = 0; c < 3; ++c) {
      const float source =
          g.mean[c] + terms.first[c] * g.along[c] + terms.second[c] * (3 * g.square[c] - g.mean[c]);
      result[c] += static_cast<double>(step.air[c] * RAYLEIGH * (g.mean[c] + g.square[c]) +
                                       step.fog[c] * ISOTROPIC * std::max(source, 0.0F));
    }
  }
  if (plan.ground >= 0) {
    const double foot = (r * sunMu + plan.ground * viewSun) / air_.planetRadius;
    const SkyColor irradiance = irradianceAt(std::clamp(foot, -1.0, 1.0));
    for (size_t c = 0; c < 3; ++c) {
      result[c] += static_cast<double>(plan.atGround[c]) * groundAlbedo_[c] / PI * irradiance[c];
    }
  }
  return result;
}

SkyField::Once SkyField::onceAlong(const AirInput& input, double altitude, double viewMu,
                                   double sunMu, double viewSun, double distance,
                                   const SkyColor& phase) const {
  const Air air = airFrom(input);
  const double ground = groundDistance(altitude, viewMu, air.planetRadius);
  const bool toGround = ground >= 0 && ground <= distance;
  const double reach = toGround ? ground : distance;
  AirRay ray;
  ray.altitude = altitude;
  ray.viewMu = viewMu;
  ray.sunMu = sunMu;
  ray.viewSun = viewSun;
  const AirResult along = airAlongRay(air, ray, reach, rayleighPhase(1 - viewSun),
                                      vec3(phase[0], phase[1], phase[2]), lightAngularRadius_);
  Once once{};
  vec3 depth(0.0);
  double lit = 0;
  if (toGround) {
    const double foot = std::clamp(
        ((air.planetRadius + altitude) * sunMu + reach * viewSun) / air.planetRadius, -1.0, 1.0);
    depth = lightOpticalDepth(air, 0.0, foot);
    lit = std::max(foot, 0.0) * lightVisibility(air, 0.0, foot, lightAngularRadius_);
  }
  for (size_t c = 0; c < 3; ++c) {
    const int k = static_cast<int>(c);
    once.depth[c] = along.opticalDepth[k];
    once.radiance[c] = along.radiance[k] +
                       groundAlbedo_[c] / PI * lit * std::exp(-depth[k] - along.opticalDepth[k]);
  }
  return once;
}

// Besides the moments: the first order with the peak's light counted as unscattered, less the first
// order itself; and what comes through the peak from beyond the ray's end.
SkyColor SkyField::higherOrdersAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                     double distance, const SkyColor& fogPhase) const {
  SkyColor result = radianceAlong(altitude, viewMu, sunMu, viewSun, distance);
  if (!(peak_ > 0) || !(air_.fogExtinction > 0)) {
    return result;
  }
  SkyColor phase{};
  for (size_t c = 0; c < 3; ++c) {
    // In its own direction the peak is what is left out.
    const double top = (1 + 3 * fogMoments_[0][c] + 5 * fogMoments_[1][c]) / (4 * PI);
    phase[c] = std::min(fogPhase[c] / (1 - eyePeak_), top);
  }
  const Once bright = onceAlong(eye_, altitude, viewMu, sunMu, viewSun, distance, phase);
  const Once dim = onceAlong(attenuated_, altitude, viewMu, sunMu, viewSun, distance, phase);
  for (size_t c = 0; c < 3; ++c) {
    result[c] += std::max(bright.radiance[c] - dim.radiance[c], 0.0);
  }
  const double radius = air_.planetRadius;
  const double ground = groundDistance(altitude, viewMu, radius);
  const bool endsInAir = !(ground >= 0 && ground <= distance) && distance < 1e7;
  if (endsInAir) {
    const double there = altitudeAlongRay(altitude, viewMu, radius, distance);
    const double r = radius + altitude;
    const double scale = 1 / (radius + there);
    const double view = std::clamp((r * viewMu + distance) * scale, -1.0, 1.0);
    const double sun = std::clamp((r * sunMu + distance * viewSun) * scale, -1.0, 1.0);
    constexpr double INF = std::numeric_limits<double>::infinity();
    const SkyColor more = radianceAlong(there, view, sun, viewSun, INF);
    const Once first = onceAlong(eye_, there, view, sun, viewSun, INF, phase);
    for (size_t c = 0; c < 3; ++c) {
      const double through = std::max(std::exp(-bright.depth[c]) - std::exp(-dim.depth[c]), 0.0);
      result[c] += through * (more[c] + first.radiance[c]);
    }
  }
  return result;
}

}  // namespace welkin
