// SPDX-License-Identifier: MIT
#include "api/sky_light.hpp"

#include <cmath>
#include <cstring>

#include "api/sky_query.hpp"
#include "tables/sky_table.hpp"

namespace welkin {
namespace {

bool shown(WlkContext_T& c) {
  if (!c.air.sky && !c.fogActive()) {
    return false;
  }
  for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
    const ViewState* view = c.views.at(i);
    if (view != nullptr && resolveQuality(view->quality).multipleSky &&
        (view->info.layers & (WLK_LAYER_SKY | WLK_LAYER_FOG)) != 0) {
      return true;
    }
  }
  return false;
}

bool same(const SkyLightSource& a, const SkyLightSource& b) {
  return a.air == b.air && a.groundAlbedo == b.groundAlbedo && a.angularRadius == b.angularRadius &&
         a.fogPhase == b.fogPhase;
}

// Rows of the image: a block of altitudes for each moment, then the light of the ground.
constexpr uint32_t ROWS = SkyField::MOMENTS * SkyField::ALTITUDES + 1;
static_assert(ROWS == interface_::MOMENT_ROWS);
static_assert(SkyField::SUNS == interface_::MOMENT_SUNS);
static_assert(SkyField::ALTITUDES == interface_::MOMENT_ALTITUDES);
constexpr size_t ROW_FLOATS = SkyField::SUNS * LANES;
static_assert(FogLight::SUNS == interface_::FOG_SUNS);
static_assert(FogLight::HEIGHTS == interface_::FOG_HEIGHTS);
static_assert(FogLight::AZIMUTHS == interface_::FOG_AZIMUTHS);
static_assert(FogLight::VIEWS == interface_::FOG_VIEWS);

void fillRows(const SkyField& field, float* rows) {
  for (size_t a = 0; a < SkyField::ALTITUDES; ++a) {
    for (size_t s = 0; s < SkyField::SUNS; ++s) {
      for (size_t m = 0; m < SkyField::MOMENTS; ++m) {
        const float* from = field.moments().data() + (a * SkyField::SUNS + s) * VALUES + m * LANES;
        float* to = rows + (m * SkyField::ALTITUDES + a) * ROW_FLOATS + s * LANES;
        std::memcpy(to, from, LANES * sizeof *to);
      }
    }
  }
  std::memcpy(rows + (ROWS - 1) * ROW_FLOATS, field.irradiance().data(), ROW_FLOATS * sizeof *rows);
  if (field.fogLight() != nullptr) {
    const std::vector<float>& table = field.fogLight()->table();
    std::memcpy(rows + ROWS * ROW_FLOATS, table.data(), table.size() * sizeof *rows);
  }
}

vk::Image imageOf(WlkContext_T& c, VkImageType type, const VkExtent3D& extent) {
  vk::ImageInfo info;
  info.type = type;
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  info.extent = extent;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return vk::Image(*c.device, info);
}

glm::vec4 colour(const SkyColor& c, double w) {
  return glm::vec4(glm::dvec4(c[0], c[1], c[2], w));
}

SkyLightConstants constantsOf(const SkyField& field, const AirInput& air) {
  SkyLightConstants light;
  light.fogExtinction = air.fogExtinction;
  light.fogScaleHeight = air.fogScaleHeight;
  light.top = field.top();
  light.fogShare = field.air().fogExtinction > 0 ? SkyAxes::FOG_SHARE : 0;
  const AirInput& eye = field.eyeAir();
  light.eyeFog = colour({eye.fogAlbedo[0], eye.fogAlbedo[1], eye.fogAlbedo[2]}, eye.fogExtinction);
  if (air.fogExtinction > 0) {
    light.groundFog = static_cast<float>(field.air().fogExtinction / air.fogExtinction);
  }
  if (field.fogLight() != nullptr) {
    const FogLight& fog = *field.fogLight();
    light.fogTable = colour({fog.depth(), 1 / std::log1p(fog.depth()), fog.asymmetry()},
                            1 / (1 - field.eyePeak()));
  }
  light.fogBound = colour(field.fogBound(), 0);
  return light;
}

// The present air; without a light as for the one that may be set later, probably as large as the
// last one, or as the Sun.
AirQuery presentAir(const WlkContext_T& c) {
  AirQuery query = airQueryOf(c.air);
  if (!query.light) {
    constexpr double SUN_RADIUS = 0.00466;
    const double last = c.skyLightSource.angularRadius;
    query.angularRadius = last >= 0 ? last : SUN_RADIUS;
  }
  return query;
}

SkyLightSource sourceOf(const WlkContext_T& c, const AirQuery& query) {
  SkyLightSource source;
  source.air = query.air;
  source.groundAlbedo = {c.air.planet.groundAlbedo[0], c.air.planet.groundAlbedo[1],
                         c.air.planet.groundAlbedo[2]};
  source.angularRadius = query.angularRadius;
  source.fogPhase = c.fogActive() ? c.air.fogPhase : nullptr;
  return source;
}

// Hands a field over to the next recordUpdate, or changes nothing.
void stage(WlkContext_T& c, const SkyField& field, const SkyLightSource& source) {
  vk::Image made;
  vk::Image fog;
  if (!c.skyLight.moments) {
    made = imageOf(c, VK_IMAGE_TYPE_2D, {SkyField::SUNS, ROWS, 1});
  }
  const bool foggy = field.fogLight() != nullptr;
  if (foggy && !c.skyLight.fog) {
    fog = imageOf(c, VK_IMAGE_TYPE_3D,
                  {FogLight::VIEWS, FogLight::AZIMUTHS, FogLight::SUNS * FogLight::HEIGHTS});
  }
  const size_t floats = ROWS * ROW_FLOATS + (foggy ? FogLight::VALUES : 0);
  vk::Buffer staging(*c.device, floats * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
  fillRows(field, static_cast<float*>(staging.data()));
  c.skyLight.staging = std::move(staging);
  if (made) {
    c.skyLight.moments = std::move(made);
  }
  if (fog) {
    c.skyLight.fog = std::move(fog);
  }
  c.skyLight.fogStaged = foggy;
  c.shownField = std::make_shared<const SkyField>(field);
  ++c.shownFieldVersion;
  c.skyLight.staged = constantsOf(field, source.air);
  c.skyLightSource = source;
}

}  // namespace

void prepareSkyLight(WlkContext_T& c) {
  if (!c.device || !shown(c)) {
    return;
  }
  const AirQuery query = presentAir(c);
  const SkyLightSource source = sourceOf(c, query);
  if (!same(source, c.skyLightSource)) {
    stage(c, skyFieldOf(c, query), source);
  }
  c.skyLightWork.reset();
}

void advanceSkyLight(WlkContext_T& c) {
  constexpr size_t ROWS_PER_CALL = 8;
  if (!shown(c)) {
    return;
  }
  const AirQuery query = presentAir(c);
  const SkyLightSource source = sourceOf(c, query);
  if (c.skyLightSource.angularRadius < 0) {
    prepareSkyLight(c);
    return;
  }
  if (same(source, c.skyLightSource)) {
    c.skyLightWork.reset();
    return;
  }
  if (!c.skyLightWork) {
    c.skyLightWork = std::make_unique<SkyLightWork>(
        SkyLightWork{source, SkyFieldSolver(skyFieldInputOf(c, query)), {}});
  }
  SkyLightWork& work = *c.skyLightWork;
  if (!work.solver.advance(ROWS_PER_CALL)) {
    return;
  }
  if (!work.field) {
    SkyField field = work.solver.take();
    if (work.source.fogPhase) {
      finishSkyField(field, work.source.fogPhase->particle);
    }
    work.field = std::move(field);
  }
  stage(c, *work.field, work.source);
  c.skyLightWork.reset();
}

}  // namespace welkin
