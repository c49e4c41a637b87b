// SPDX-License-Identifier: MIT
#include "tables/sky_field.hpp"

#include <algorithm>
#include <cmath>

#include "model/model.hpp"
#include "tables/sky_air.hpp"
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
  const SkyRay plan = planRay(air_, axes, altitude, viewMu, distance, steps);
  const FogTerms terms = fogTerms(fogMoments_);
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

// First order with the peak's light counted as unscattered, less the first order itself.
SkyColor SkyField::higherOrdersAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                     double distance, const SkyColor& fogPhase) const {
  SkyColor result = radianceAlong(altitude, viewMu, sunMu, viewSun, distance);
  if (!(peak_ > 0) || !(air_.fogExtinction > 0)) {
    return result;
  }
  const double ground = groundDistance(altitude, viewMu, air_.planetRadius);
  const bool toGround = ground >= 0 && ground <= distance;
  const double reach = toGround ? ground : distance;
  AirRay ray;
  ray.altitude = altitude;
  ray.viewMu = viewMu;
  ray.sunMu = sunMu;
  ray.viewSun = viewSun;
  vec3 phase;
  for (size_t c = 0; c < 3; ++c) {
    // In its own direction the peak is what is left out.
    const double top = (1 + 3 * fogMoments_[0][c] + 5 * fogMoments_[1][c]) / (4 * PI);
    phase[static_cast<int>(c)] = std::min(fogPhase[c] / (1 - peak_), top);
  }
  const Air airs[2] = {airFrom(air_), airFrom(attenuated_)};
  double light[2][3];
  for (size_t i = 0; i < 2; ++i) {
    const AirResult along =
        airAlongRay(airs[i], ray, reach, rayleighPhase(1 - viewSun), phase, lightAngularRadius_);
    const double foot = std::clamp(
        ((air_.planetRadius + altitude) * sunMu + reach * viewSun) / air_.planetRadius, -1.0, 1.0);
    const vec3 depth = lightOpticalDepth(airs[i], 0.0, foot);
    const double lit =
        toGround ? std::max(foot, 0.0) * lightVisibility(airs[i], 0.0, foot, lightAngularRadius_)
                 : 0.0;
    for (int c = 0; c < 3; ++c) {
      const double reflected = groundAlbedo_[static_cast<size_t>(c)] / PI * lit;
      light[i][c] = along.radiance[c] + reflected * std::exp(-depth[c] - along.opticalDepth[c]);
    }
  }
  for (size_t c = 0; c < 3; ++c) {
    result[c] += std::max(light[0][c] - light[1][c], 0.0);
  }
  return result;
}

}  // namespace welkin
