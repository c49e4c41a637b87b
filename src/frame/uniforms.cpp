// SPDX-License-Identifier: MIT
#include "frame/uniforms.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "model/model.hpp"

namespace welkin {
namespace {

glm::vec3 vec(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

// Of the moments' top: where pixels begin to gather their own light.
constexpr double SPACE = 1.5;

void fillSky(const AirState& air, double altitude, const Plan& plan, const SkyLightConstants& sky,
             interface_::FrameUniforms& out) {
  const double radius = air.planet.radius;
  const double h = std::max(altitude, 0.0);
  const double r = radius + h;
  // Rays from above the moments' air that meet it at all.
  const double rise = (radius + SPACE * sky.top) / r;
  const double upper = rise < 1 ? -std::sqrt((1 - rise) * (1 + rise)) : 1;
  out.skyLight = {static_cast<float>(sky.top), static_cast<float>(sky.fogShare),
                  plan.lightReaches ? 1.0f : 0.0f, plan.allLight ? 1.0f : 0.0f};
  out.skyView = {static_cast<float>(model::f64::horizonMu(h, radius)), static_cast<float>(upper),
                 static_cast<float>(sky.fogScaleHeight), 0};
  out.eyeFog = sky.eyeFog;
  // The eye's fog is a part of the scene's, which may be thicker or thinner than the solved one.
  const double share = sky.fogExtinction > 0 ? out.eyeFog.w / sky.fogExtinction : 1;
  out.eyeFog.w = static_cast<float>(share * (air.fog ? air.fog->extinction : 0.0));
  out.fogFirst = sky.fogFirst;
  out.fogSecond = sky.fogSecond;
  out.fogBound = sky.fogBound;
}

}  // namespace

float targetLimit(uint32_t welkinFormat) {
  switch (welkinFormat) {
    case WLK_TARGET_RGBA32_FLOAT:
      return 3.0e38f;
    case WLK_TARGET_B10G11R11_FLOAT:
      return 64512.0f;  // largest 10-bit float: blue has one mantissa bit less
    default:
      return 65504.0f;
  }
}

bool seenFromSpace(const SkyLightConstants& sky, double altitude) {
  return altitude > SPACE * sky.top;
}

bool tableHoldsAllLight(const Plan& plan, double altitude, double sunMu) {
  // Measured: tests/image/sky_light_test.cpp.
  constexpr double HIGHEST = 2e4;
  constexpr double LOWEST_SUN = 0.05;
  return plan.multiple && plan.air && !plan.fog && !plan.space && plan.lightReaches &&
         altitude < HIGHEST && sunMu > LOWEST_SUN;
}

void fillFrame(const AirState& air, const SkyLightState& sky, const ViewState& view,
               interface_::FrameUniforms& out) {
  out = {};
  const float width = static_cast<float>(view.info.width);
  const float height = static_cast<float>(view.info.height);
  out.eyeFromNdc = glm::mat4(view.eyeFromNdc);
  out.viewport = {width, height, 1.0f / width, 1.0f / height};
  out.output_ = {static_cast<float>(view.skyDepth), view.camera.preExposure,
                 targetLimit(view.info.targetFormat), 0.0f};
  const glm::dvec3 position(view.camera.position[0], view.camera.position[1],
                            view.camera.position[2]);
  const PlanetFrame frame = planetFrameAt(air.planet, position);
  out.eye = glm::vec4(glm::vec3(frame.up), static_cast<float>(frame.altitude));
  out.ground = glm::vec4(vec(air.planet.groundAlbedo), 0.0f);
  out.fog.w = air.planet.radius;
  out.fog.z = 1.0f;
  out.air.w = 1.0f;
  out.lightDisk.w = 1e-30f;  // no disk: keeps y / edge from 0 / 0 for a view into the light
  if (air.light) {
    const glm::dvec3 to = glm::normalize(
        glm::dvec3(air.light->direction[0], air.light->direction[1], air.light->direction[2]));
    const double radius = 0.5 * air.light->angularDiameter;
    out.light = glm::vec4(glm::vec3(to), static_cast<float>(radius));
    out.lightIrradiance =
        glm::vec4(vec(air.light->irradiance), static_cast<float>(glm::dot(to, frame.up)));
    const double sine = std::sin(radius);
    const double half = std::sin(0.5 * radius);
    // Radiance of a uniform disk: E / (pi sin^2 r); the rim's 1 - cos r = 2 sin^2(r / 2). The soft
    // rim (diskCoverage: a smoothstep over the last 8 % of the area) keeps 0.96 of the area.
    // A disk under 0.2 arc seconds covers no pixel, and its radiance would overflow a float.
    if (sine > 1e-6) {
      const double solidAngle = std::numbers::pi * sine * sine * 0.96;
      out.lightDisk = glm::vec4(vec(air.light->irradiance) / static_cast<float>(solidAngle),
                                static_cast<float>(2.0 * half * half));
    }
  }
  if (air.sky) {
    out.air = glm::vec4(vec(air.sky->rayleighScattering), air.sky->scaleHeight);
  }
  if (air.fog) {
    out.fog = {air.fog->extinction, air.fog->baseAltitude, air.fog->scaleHeight, air.planet.radius};
    out.fogAlbedo = glm::vec4(vec(air.fog->singleScatteringAlbedo), 0.0f);
  }
  const PixelRect& rect = view.plan.volumeRect;
  out.volumeRect = {static_cast<float>(rect.x0), static_cast<float>(rect.y0),
                    static_cast<float>(rect.x1), static_cast<float>(rect.y1)};
  fillSky(air, frame.altitude, view.plan, sky.now, out);
}

SkyTableKey skyTableKeyOf(const interface_::FrameUniforms& frame) {
  const std::array rows{frame.eye,    frame.light,     frame.lightIrradiance, frame.air,
                        frame.fog,    frame.fogAlbedo, frame.skyLight,        frame.skyView,
                        frame.eyeFog, frame.fogFirst};
  SkyTableKey key;
  static_assert(sizeof key == sizeof rows);
  std::memcpy(key.data(), rows.data(), sizeof key);
  return key;
}

void fillVolume(const VolumeState& volume, const PlannedVolume& planned, const glm::dvec3& eye,
                const SliceQuality& quality, interface_::VolumeUniforms& out) {
  out = {};
  glm::dmat4x3 box = volume.worldFromBox;
  box[3] -= eye;
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(box));
  glm::dmat4 boxFromEye(inverse);
  boxFromEye[3] = glm::dvec4(-(inverse * box[3]), 1.0);
  const SliceLayout& layout = planned.layout;
  out.boxFromEye = glm::mat4(boxFromEye);
  out.lightU = glm::vec4(layout.lightU);
  out.lightV = glm::vec4(layout.lightV);
  out.plane = glm::vec4(layout.plane);
  const glm::dvec3 origin = inverse * (layout.texelOrigin - box[3]);
  // Longest stretch of a ray between two samples: at 1.5 slabs, stretches of optical depth 2 drew
  // contour lines on a cumulus lit from the side; at 0.75 none are left.
  const double maxStep = layout.slabThickness * 0.75;
  out.texelOrigin = glm::vec4(glm::vec3(origin), 0.0f);
  out.texelA = glm::vec4(glm::vec3(inverse * layout.texelU), static_cast<float>(layout.lightPath));
  out.texelB =
      glm::vec4(glm::vec3(inverse * layout.texelV), static_cast<float>(quality.sliceCount));
  out.texelC = glm::vec4(glm::vec3(inverse * layout.texelC), static_cast<float>(maxStep));
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    const std::array<double, RGB> albedo = field.medium.scaledAlbedo();
    const int c = static_cast<int>(i);
    const bool present = field.external.has_value() || field.image;
    out.extinctionScale[c] =
        present ? field.extinctionScale * static_cast<float>(field.medium.extinctionFactor())
                : 0.0f;
    out.albedo[i] = glm::vec4(static_cast<float>(albedo[0]), static_cast<float>(albedo[1]),
                              static_cast<float>(albedo[2]), 0.0f);
    out.meanAlbedo[c] = (out.albedo[i].x + out.albedo[i].y + out.albedo[i].z) / 3.0f;
    const auto& forward = volume.tables[quality.form()].forwardFraction[i];
    for (size_t n = 0; n < forward.size(); ++n) {
      out.forwardFraction[n][c] = forward[n];
    }
  }
  out.rect = {static_cast<float>(planned.rect.x0), static_cast<float>(planned.rect.y0),
              static_cast<float>(planned.rect.x1), static_cast<float>(planned.rect.y1)};
}

}  // namespace welkin
