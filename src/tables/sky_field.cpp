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

SkyColor sumOf(const SkyField::Parts& parts) {
  SkyColor sum{};
  for (size_t c = 0; c < 3; ++c) {
    sum[c] = parts.air[c] + parts.ground[c];
  }
  return sum;
}

}  // namespace

SkyField::Moments SkyField::momentsAt(double altitude, double sunMu) const {
  const SunNodes sun = sunNodes(sunMu);
  float row[4 * VALUES];
  blendAltitudes(moments_, nodeAt(SkyAxes(air_).coordinate(altitude), ALTITUDES),
                 sun.first * VALUES, 4 * VALUES, row);
  Moments result{};
  for (size_t k = 0; k < MOMENTS; ++k) {
    for (size_t c = 0; c < 3; ++c) {
      for (size_t n = 0; n < 4; ++n) {
        result[k][c] += static_cast<double>(sun.weights[n] * row[n * VALUES + LANES * k + c]);
      }
      // Cubics may run below zero in the dark: squares of cosines cannot.
      result[k][c] = k < 3 ? std::max(result[k][c], 0.0) : result[k][c];
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
  return {std::max(static_cast<double>(lanes[0]), 0.0),
          std::max(static_cast<double>(lanes[1]), 0.0),
          std::max(static_cast<double>(lanes[2]), 0.0)};
}

// In twilight fog darkens as the ground does.
SkyColor SkyField::fogSourceAt(double altitude, const SkyPlace& place, double viewSun) const {
  const auto sunMu = static_cast<double>(place.sunMu);
  const auto viewMu = static_cast<double>(place.view.y);
  const double flat = std::sqrt(std::max((1 - viewMu) * (1 + viewMu), 0.0));
  const double azimuth =
      std::clamp(static_cast<double>(place.view.x) / std::max(flat, 1e-6), -1.0, 1.0);
  SkyColor source = fogLight_->sourceAt(altitude, sunMu, {viewMu, azimuth, viewSun});
  if (sunMu < 0) {
    const SkyColor now = irradianceAt(sunMu);
    const SkyColor before = irradianceAt(0);
    for (size_t c = 0; c < 3; ++c) {
      source[c] *= std::min(now[c] / std::max(before[c], 1e-300), 1.0);
    }
  }
  return source;
}

SkyField::Parts SkyField::gatheredAlong(double altitude, double viewMu, double sunMu,
                                        double viewSun, double distance, int steps) const {
  const SkyAxes axes(air_);
  // Frames ask for such rays: their steps lie on the stack.
  constexpr size_t USUAL_STEPS = 64;
  static_assert(EYE_STEPS <= USUAL_STEPS);
  alignas(SkyStep) std::array<std::byte, USUAL_STEPS * sizeof(SkyStep)> room;
  std::pmr::monotonic_buffer_resource memory(room.data(), room.size());
  SkyRay plan{std::pmr::vector<SkyStep>(&memory)};
  plan.steps.reserve(static_cast<size_t>(steps));
  planRay(eye_, axes, altitude, viewMu, distance, steps, plan);
  const double r = air_.planetRadius + altitude;
  const SkyAim aim{static_cast<float>(r), static_cast<float>(viewMu), static_cast<float>(sunMu),
                   static_cast<float>(viewSun)};
  Parts result;
  for (const SkyStep& step : plan.steps) {
    const SkyPlace place = placeAt(aim, step);
    const SunNodes sun = sunNodes(static_cast<double>(place.sunMu));
    float row[4 * VALUES];
    blendAltitudes(moments_, step.high, sun.first * VALUES, 4 * VALUES, row);
    const SkyLight g = gatherMoments(row, place.view, {0, sun.weights});
    const SkyColor fog = fogLight_ ? fogSourceAt(step.altitude, place, viewSun) : SkyColor{};
    for (size_t c = 0; c < 3; ++c) {
      // Cubics may run below zero in the dark.
      const float even = std::max(g.mean[c] + g.square[c], 0.0F);
      result.air[c] += static_cast<double>(step.air[c] * RAYLEIGH * even) +
                       static_cast<double>(step.fog[c]) * fog[c];
    }
  }
  if (plan.ground >= 0) {
    const double foot = (r * sunMu + plan.ground * viewSun) / air_.planetRadius;
    const SkyColor irradiance = irradianceAt(std::clamp(foot, -1.0, 1.0));
    for (size_t c = 0; c < 3; ++c) {
      result.ground[c] =
          static_cast<double>(plan.atGround[c]) * groundAlbedo_[c] / PI * irradiance[c];
    }
  }
  return result;
}

SkyColor SkyField::radianceAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                 double distance, int steps) const {
  return sumOf(gatheredAlong(altitude, viewMu, sunMu, viewSun, distance, steps));
}

SkyField::Once SkyField::onceAlong(const AirInput& input, double altitude, double viewMu,
                                   double sunMu, double viewSun, double distance,
                                   const SkyColor& phase) const {
  const Air air = airFrom(input);
  AirRay ray;
  ray.altitude = altitude;
  ray.viewMu = viewMu;
  ray.sunMu = sunMu;
  ray.viewSun = viewSun;
  const AirResult along = airAlongRay(air, ray, distance, rayleighPhase(1 - viewSun),
                                      vec3(phase[0], phase[1], phase[2]), lightAngularRadius_);
  return {{along.radiance.x, along.radiance.y, along.radiance.z},
          {along.opticalDepth.x, along.opticalDepth.y, along.opticalDepth.z}};
}

SkyField::Lit SkyField::groundAt(double sunMu) const {
  const Air air = airFrom(air_);
  const double lit = std::max(sunMu, 0.0) * lightVisibility(air, 0.0, sunMu, lightAngularRadius_);
  const vec3 less = lightOpticalDepth(air, 0.0, sunMu);
  const vec3 all = lightOpticalDepth(airFrom(attenuated_), 0.0, sunMu);
  Lit ground{};
  for (size_t c = 0; c < 3; ++c) {
    const int k = static_cast<int>(c);
    ground.straight[c] = groundAlbedo_[c] / PI * lit * std::exp(-less[k]);
    ground.unscattered[c] = groundAlbedo_[c] / PI * lit * std::exp(-all[k]);
  }
  return ground;
}

// Besides what is gathered: the first order with the peak's light counted as unscattered, less the
// first order itself; and what comes through the peak from beyond the ray's end. Of that, the
// ground's own light is what also misses the peak.
SkyField::Parts SkyField::higherOrders(double altitude, double viewMu, double sunMu, double viewSun,
                                       double distance, const SkyColor& fogPhase) const {
  Parts result = gatheredAlong(altitude, viewMu, sunMu, viewSun, distance, EYE_STEPS);
  if (!(peak_ > 0) || !(air_.fogExtinction > 0)) {
    return result;
  }
  SkyColor phase{};
  for (size_t c = 0; c < 3; ++c) {
    phase[c] = std::min(fogPhase[c] / (1 - eyePeak_), fogBound_[c]);
  }
  const double radius = air_.planetRadius;
  const double r = radius + altitude;
  const double toGround = groundDistance(altitude, viewMu, radius);
  const bool ends = toGround >= 0 && toGround <= distance;
  const double reach = ends ? toGround : distance;
  const Once bright = onceAlong(eye_, altitude, viewMu, sunMu, viewSun, reach, phase);
  const Once dim = onceAlong(attenuated_, altitude, viewMu, sunMu, viewSun, reach, phase);
  SkyColor through{};
  for (size_t c = 0; c < 3; ++c) {
    result.air[c] += std::max(bright.radiance[c] - dim.radiance[c], 0.0);
    through[c] = std::max(std::exp(-bright.depth[c]) - std::exp(-dim.depth[c]), 0.0);
  }
  if (ends) {
    const Lit lit = groundAt(std::clamp((r * sunMu + reach * viewSun) / radius, -1.0, 1.0));
    for (size_t c = 0; c < 3; ++c) {
      const double straight = std::exp(std::min(bright.depth[c] - dim.depth[c], 0.0));
      result.air[c] += through[c] * lit.straight[c] + (1 - straight) * result.ground[c];
      result.ground[c] = straight * result.ground[c] +
                         std::exp(-dim.depth[c]) * (lit.straight[c] - lit.unscattered[c]);
    }
  } else if (distance < 1e7) {
    const double there = altitudeAlongRay(altitude, viewMu, radius, distance);
    const double scale = 1 / (radius + there);
    const double view = std::clamp((r * viewMu + distance) * scale, -1.0, 1.0);
    const double sun = std::clamp((r * sunMu + distance * viewSun) * scale, -1.0, 1.0);
    constexpr double INF = std::numeric_limits<double>::infinity();
    const SkyColor more = radianceAlong(there, view, sun, viewSun, INF);
    const double beyond = groundDistance(there, view, radius);
    const Once first =
        onceAlong(eye_, there, view, sun, viewSun, beyond >= 0 ? beyond : INF, phase);
    SkyColor ground{};
    if (beyond >= 0) {
      const double foot = ((radius + there) * sun + beyond * viewSun) / radius;
      ground = groundAt(std::clamp(foot, -1.0, 1.0)).straight;
    }
    for (size_t c = 0; c < 3; ++c) {
      const double seen = first.radiance[c] + std::exp(-first.depth[c]) * ground[c];
      result.air[c] += through[c] * (more[c] + seen);
    }
  }
  return result;
}

SkyColor SkyField::higherOrdersAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                     double distance, const SkyColor& fogPhase) const {
  return sumOf(higherOrders(altitude, viewMu, sunMu, viewSun, distance, fogPhase));
}

}  // namespace welkin
