// SPDX-License-Identifier: MIT
#include "frame/uniforms.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "frame/transport.hpp"
#include "frame/transport_layer.hpp"
#include "model/model.hpp"

namespace welkin {
namespace {

glm::vec3 vec(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

// Of the march through all slabs, in slabs. On the noise cloud of welkin_volume_cost, 128 slabs,
// steps of 1, 0.75, 0.5 and 0.25 have errors of 0.13, 0.11, 0.07 and 0.05 % for 50, 65, 75 and 127
// ms of CPU: the density's kinks are what is missed, and light at fewer slabs is the cheaper half.
constexpr double MARCH_STEP = 0.5;

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
                 static_cast<float>(sky.fogScaleHeight), 1};
  if (plan.absorber) {
    out.absorber = glm::vec4(vec(air.absorber->absorption), air.absorber->peakAltitude);
    out.skyView.w = air.absorber->halfWidth;
  }
  out.eyeFog = sky.eyeFog;
  // The eye's fog is a part of the scene's, which may be thicker or thinner than the solved one.
  const double share = sky.fogExtinction > 0 ? out.eyeFog.w / sky.fogExtinction : 1;
  out.eyeFog.w = static_cast<float>(share * (air.fog ? air.fog->extinction : 0.0));
  out.fogTable = sky.fogTable;
  out.skyZeniths.x = sky.groundFog;
  out.skyZeniths.w = static_cast<float>(plan.skyZeniths - interface_::SKY_BELOW);
  out.fogBound = sky.fogBound;
}

void fillLight(const WlkLight& light, const glm::dvec3& up, interface_::LightUniforms& out) {
  const glm::dvec3 to =
      glm::normalize(glm::dvec3(light.direction[0], light.direction[1], light.direction[2]));
  const double radius = 0.5 * light.angularDiameter;
  out.direction = glm::vec4(glm::vec3(to), static_cast<float>(radius));
  out.irradiance = glm::vec4(vec(light.irradiance), static_cast<float>(glm::dot(to, up)));
  out.limb = glm::vec4(vec(light.limbDarkening), 0.0f);
  if (litByAnother(light)) {
    const glm::dvec3 from =
        glm::normalize(glm::dvec3(light.litFrom[0], light.litFrom[1], light.litFrom[2]));
    out.litFrom =
        glm::vec4(glm::vec3(from), static_cast<float>(model::f64::phaseIntegral(to, from)));
  }
  const double sine = std::sin(radius);
  const double half = std::sin(0.5 * radius);
  // Radiance of a uniform disk: E / (pi sin^2 r); the rim's 1 - cos r = 2 sin^2(r / 2). The soft
  // rim (diskCoverage: a smoothstep over the last 8 % of the area) keeps DISK_KEPT of the area.
  // A disk under 0.2 arc seconds covers no pixel, and its radiance would overflow a float.
  if (sine > 1e-6) {
    const double solidAngle = std::numbers::pi * sine * sine * model::f64::DISK_KEPT;
    out.disk = glm::vec4(vec(light.irradiance) / static_cast<float>(solidAngle),
                         static_cast<float>(2.0 * half * half));
  }
}

// From the unit box to the cells of a grid, whose image has room for `room` cubed.
struct GridPlace {
  glm::vec4 scale{0};
  glm::vec4 offset{0};
  glm::vec4 end{0};
};
GridPlace placeGrid(const TransportShape& shape, uint32_t room) {
  GridPlace grid;
  for (int i = 0; i < 3; ++i) {
    const double cells = shape.cells[static_cast<size_t>(i)];
    grid.scale[i] = static_cast<float>(cells / shape.size[i]);
    grid.offset[i] = static_cast<float>(-shape.origin[i] * cells / shape.size[i]);
    grid.end[i] = static_cast<float>(cells - 0.5);
  }
  grid.scale.w = shape.layer ? 1.0f : 0.0f;
  grid.end.w = 1.0f / static_cast<float>(transportImageEdge(room));
  return grid;
}

}  // namespace

bool hasShapedDisk(const WlkLight& light) {
  return litByAnother(light) || light.limbDarkening[0] > 0 || light.limbDarkening[1] > 0 ||
         light.limbDarkening[2] > 0;
}

bool litByAnother(const WlkLight& light) {
  return light.litFrom[0] != 0 || light.litFrom[1] != 0 || light.litFrom[2] != 0;
}

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

void chooseSkyTable(const SkyLightConstants& sky, double planetRadius, const PlanetFrame& eye,
                    Plan& plan) {
  // A quarter of the air that matters, 20 km on Earth, while the sun stands above the horizon that
  // the highest fifth of it sees, 3 degrees. Lower suns draw the planet's shadow into the sky,
  // whose edge is the sharper the higher the eye: from 12 km the nodes miss it by up to 30 %, from
  // the ground by 9 % in a few directions. Measured: tests/image/sky_light_test.cpp.
  const double HIGHEST = 0.25 * sky.top;
  const double HIGHEST_IN_TWILIGHT = 0.02 * sky.top;
  const double LOWEST_SUN = std::sqrt(0.2 * sky.top / planetRadius);
  bool twilight = false;
  for (uint32_t i = 0; i < plan.lights.count; ++i) {
    twilight = twilight || glm::dot(eye.up, plan.lights.light[i].toLight) <= LOWEST_SUN;
  }
  plan.space = plan.multiple && seenFromSpace(sky, eye.altitude);
  plan.allLight = plan.multiple && plan.air && !plan.fog && !plan.space && plan.lightReaches &&
                  eye.altitude < (twilight ? HIGHEST_IN_TWILIGHT : HIGHEST);
  plan.skyZeniths = plan.allLight && twilight ? interface_::SKY_ZENITHS
                                              : interface_::SKY_ABOVE + interface_::SKY_BELOW;
}

// Linear sRGB: fitted to skies of 40 wavelengths (tests/bench/sky_color.cpp,
// docs/results/sky-color.json).
ColorRows colorRows(uint32_t colorSpace) {
  if (colorSpace == WLK_COLOR_LINEAR_SRGB) {
    return {{{0.67230f, 0.55480f, -0.12925f},
             {-0.05182f, 1.02662f, 0.00212f},
             {-0.03470f, 0.05153f, 0.92361f}}};
  }
  return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
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
  out.air.w = 8000.0f;  // where fog alone is seen, steps of light that grazes follow it
  for (interface_::LightUniforms& light : out.lights) {
    light.disk.w = 1e-30f;  // no disk: keeps y / edge from 0 / 0 for a view into the light
  }
  for (uint32_t i = 0; i < view.plan.lights.count; ++i) {
    fillLight(air.lights[view.plan.lights.light[i].index], frame.up, out.lights[i]);
  }
  const ColorRows color = colorRows(view.info.colorSpace);
  const auto row = [&](size_t i) { return glm::vec4(color[i][0], color[i][1], color[i][2], 0); };
  out.colorRed = row(0);
  out.colorGreen = row(1);
  out.colorBlue = row(2);
  if (air.sky) {
    out.air = glm::vec4(vec(air.sky->rayleighScattering), air.sky->scaleHeight);
  }
  if (air.fog) {
    out.fog = {air.fog->extinction, air.fog->baseAltitude, air.fog->scaleHeight, air.planet.radius};
    out.fogAlbedo = glm::vec4(vec(air.fog->singleScatteringAlbedo), 0.0f);
  }
  out.fogAlbedo.w = 1.0f / static_cast<float>(std::max(view.resources.lights, 1U));
  const PixelRect& rect = view.plan.volumeRect;
  out.volumeRect = {static_cast<float>(rect.x0), static_cast<float>(rect.y0),
                    static_cast<float>(rect.x1), static_cast<float>(rect.y1)};
  out.froxelRange.w = view.plan.ground ? 1.0f : 0.0f;
  if (view.plan.quality.multipleSky) {
    const double level = glm::dot(view.plan.lights.light[0].toLight, frame.up);
    out.shadowRange.w = static_cast<float>(std::clamp(level, 0.1, 1.0));
  }
  fillSky(air, frame.altitude, view.plan, sky.now, out);
}

SkyTableKey skyTableKeyOf(const interface_::FrameUniforms& frame) {
  const auto& [first, second] = frame.lights;
  const std::array rows{frame.eye,         first.direction, first.irradiance, second.direction,
                        second.irradiance, frame.air,       frame.fog,        frame.fogAlbedo,
                        frame.skyLight,    frame.skyView,   frame.eyeFog,     frame.fogTable,
                        frame.skyZeniths,  frame.absorber};
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
  // The margin of layoutSlices keeps filtering inside the part of the buffer that is used.
  const double used = static_cast<double>(quality.lightSize) / quality.lightRoom;
  out.lightU = glm::vec4(layout.lightU * used);
  out.lightV = glm::vec4(layout.lightV * used);
  out.plane = glm::vec4(layout.plane);
  // Relative to the box: the same for every eye, bit for bit.
  const SliceLayout& own = planned.ownLayout;
  const glm::dvec3 origin = inverse * own.texelOrigin;
  // Longest stretch of a ray between two samples: at 1.5 slabs, stretches of optical depth 2 drew
  // contour lines on a cumulus lit from the side; at 0.75 none are left.
  const double maxStep = layout.slabThickness * 0.75;
  const double peak = volume.transport ? volume.transport->peak : 0.0;
  out.texelOrigin = glm::vec4(glm::vec3(origin), static_cast<float>(1 - peak));
  out.texelA = glm::vec4(glm::vec3(inverse * own.texelU), static_cast<float>(own.lightPath));
  out.texelB = glm::vec4(glm::vec3(inverse * own.texelV), static_cast<float>(quality.sliceCount));
  out.texelC = glm::vec4(glm::vec3(inverse * own.texelC), static_cast<float>(maxStep));
  out.middle = glm::vec4(glm::vec3(box * glm::dvec4(0.5, 0.5, 0.5, 1.0)),
                         static_cast<float>(layout.eyeStep * MARCH_STEP));
  const TransportShape shape =
      quality.transport ? transportShape(volume, quality.transportCells) : flatShape(volume);
  out.flatStretches = glm::vec4(flatStretches(shape, quality.sliceCount, quality.transport), 0.0f);
  if (quality.transport) {
    const GridPlace grid = placeGrid(shape, quality.cellRoom);
    if (shape.layer) {
      out.gridNormal = glm::vec4(glm::vec3(layerNormal(glm::dmat3(box), shape.thinAxis)), 0.0f);
    }
    out.gridScale = grid.scale;
    out.gridOffset = grid.offset;
    out.gridEnd = grid.end;
    for (int i = 0; i < 32; ++i) {
      out.pairShape[i / 4][i % 4] =
          static_cast<float>(transportPair(*volume.transport, 0, std::numbers::pi * i / 31.0));
    }
  }
  if (planned.ambient) {
    const GridPlace grid =
        placeGrid(transportShape(volume, quality.ambientCells), quality.ambientRoom);
    out.ambientScale = grid.scale;
    out.ambientOffset = grid.offset;
    out.ambientEnd = grid.end;
  }
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
  fillBricks(volume, out);
  out.rect = {static_cast<float>(planned.rect.x0), static_cast<float>(planned.rect.y0),
              static_cast<float>(planned.rect.x1), static_cast<float>(planned.rect.y1)};
}

}  // namespace welkin
