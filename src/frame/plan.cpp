// SPDX-License-Identifier: MIT
#include "frame/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/model.hpp"

namespace welkin {
namespace {

// Angle between the horizontal and the horizon at altitude `h`. rad.
double horizonDip(double h, double radius) {
  return std::acos(radius / (radius + std::max(h, 0.0)));
}

// Whether a light with zenith cosine `mu`, its disk included, stands above the horizon of something
// at most `h` high and `reach` rad (seen from the planet's centre) away.
bool aboveHorizon(double mu, double h, double reach, double radius, double angularRadius) {
  return std::asin(std::clamp(mu, -1.0, 1.0)) + angularRadius > -(horizonDip(h, radius) + reach);
}

// Where the model text ends the highest layer (clipToAir). m.
double airTop(const PlanInput& in) {
  const double extent = model::f64::LAYER_EXTENT;
  return std::max(in.sky ? extent * in.airScaleHeight : 0.0,
                  in.fog ? std::max(in.fogBaseAltitude, 0.0) + extent * in.fogScaleHeight : 0.0);
}

// The eye sees air as far as its own horizon and that of the air's top lie apart, and the light
// reaches it there: in twilight long after the light has set for the eye.
bool lightReachesAir(const PlanInput& in, const PlanLight& light, const PlanetFrame& eye) {
  const double radius = in.planet.radius;
  const double top = std::max(airTop(in), eye.altitude);
  const double reach = horizonDip(eye.altitude, radius) + horizonDip(top, radius);
  return aboveHorizon(glm::dot(eye.up, light.toLight), top, reach, radius, light.angularRadius);
}

// To positions relative to the eye.
glm::dmat4x3 relativeBox(const PlanInput& in, const PlanVolume& volume) {
  glm::dmat4x3 box = volume.worldFromBox;
  box[3] -= in.eye;
  return box;
}

std::array<glm::dvec3, 8> cornersOf(const glm::dmat4x3& box) {
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<size_t>(i)] = box * glm::dvec4(i & 1, i >> 1 & 1, i >> 2 & 1, 1);
  }
  return corners;
}

// Pixels that the box may cover: its edges clipped to the half space in front of the eye.
PixelRect coverOf(const std::array<glm::dvec3, 8>& corners, const PlanInput& in) {
  // Clip-space w 0.1 mm before the eye, whatever the matrix's scale; at the eye it is 0.
  const glm::dvec3 rise(in.clipFromEye[0].w, in.clipFromEye[1].w, in.clipFromEye[2].w);
  const double nearW = 1e-4 * glm::length(rise);
  glm::dvec2 lo(1e300);
  glm::dvec2 hi(-1e300);
  const auto add = [&](const glm::dvec4& p) {
    const glm::dvec2 ndc = glm::dvec2(p.x, p.y) / p.w;
    lo = glm::min(lo, ndc);
    hi = glm::max(hi, ndc);
  };
  std::array<glm::dvec4, 8> clip;
  for (size_t i = 0; i < 8; ++i) {
    clip[i] = in.clipFromEye * glm::dvec4(corners[i], 1.0);
    if (clip[i].w > nearW) {
      add(clip[i]);
    }
  }
  for (size_t i = 0; i < 8; ++i) {
    for (size_t axis = 1; axis < 8; axis <<= 1) {
      const size_t j = i | axis;
      if (j != i && (clip[i].w > nearW) != (clip[j].w > nearW)) {
        const double t = (nearW - clip[i].w) / (clip[j].w - clip[i].w);
        glm::dvec4 p = clip[i] + (clip[j] - clip[i]) * t;
        p.w = nearW;
        add(p);
      }
    }
  }
  PixelRect rect;
  if (!(lo.x <= hi.x)) {
    return rect;
  }
  const glm::dvec2 size(in.width, in.height);
  const glm::dvec2 a = glm::clamp((lo * 0.5 + 0.5) * size - 1.0, glm::dvec2(0), size);
  const glm::dvec2 b = glm::clamp((hi * 0.5 + 0.5) * size + 1.0, glm::dvec2(0), size);
  rect.x0 = static_cast<uint32_t>(std::floor(a.x));
  rect.y0 = static_cast<uint32_t>(std::floor(a.y));
  rect.x1 = static_cast<uint32_t>(std::ceil(b.x));
  rect.y1 = static_cast<uint32_t>(std::ceil(b.y));
  if (hi.x < -1 || hi.y < -1 || lo.x > 1 || lo.y > 1) {
    rect = {};
  }
  return rect;
}

bool contains(const glm::dmat4x3& box, const glm::dvec3& point) {
  const glm::dmat3 linear(box);
  const glm::dvec3 local = glm::inverse(linear) * (point - box[3]);
  return glm::all(glm::greaterThanEqual(local, glm::dvec3(0))) &&
         glm::all(glm::lessThanEqual(local, glm::dvec3(1)));
}

// Distance from the eye (the origin) to the box's nearest point: of a box with right angles along
// its axes, else on an edge or at the foot of the normal on a face.
double distanceTo(const glm::dmat4x3& box) {
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(box));
  const glm::dvec3 local = glm::clamp(inverse * -box[3], 0.0, 1.0);
  const double along = glm::length(box * glm::dvec4(local, 1.0));
  double nearest = along;
  for (int i = 0; i < 3; ++i) {
    for (int side = 0; side < 4; ++side) {
      const double first = side & 1;
      const double second = side >> 1;
      const glm::dvec3 from = box[3] + box[(i + 1) % 3] * first + box[(i + 2) % 3] * second;
      const double t = -glm::dot(from, box[i]) / glm::dot(box[i], box[i]);
      nearest = std::min(nearest, glm::length(from + box[i] * glm::clamp(t, 0.0, 1.0)));
    }
    const glm::dvec3 normal(inverse[0][i], inverse[1][i], inverse[2][i]);
    for (const glm::dvec3& from : {box[3], box[3] + box[i]}) {
      const glm::dvec3 foot = normal * (glm::dot(from, normal) / glm::dot(normal, normal));
      glm::dvec3 place = inverse * (foot - box[3]);
      place[i] = 0;
      if (place == glm::clamp(place, 0.0, 1.0)) {
        nearest = std::min(nearest, glm::length(foot));
      }
    }
  }
  // Rounding must not tell boxes apart that share their nearest point.
  return nearest < along * (1 - 1e-9) ? nearest : along;
}

PixelRect unite(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) {
    return b;
  }
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// Where a box (corners relative to the eye) stands on the planet.
struct VolumePlace {
  PlanetFrame middle;
  double top = -1e300;  // m
  double reach = 0;     // by which the local up turns at most from the middle: asin x <= 1.6 x
};

VolumePlace placeOf(const PlanInput& in, const std::array<glm::dvec3, 8>& corners) {
  const glm::dvec3 middle = 0.5 * (corners[0] + corners[7]);
  VolumePlace place;
  place.middle = planetFrameAt(in.planet, middle + in.eye);
  for (const glm::dvec3& corner : corners) {
    place.top = std::max(place.top, planetFrameAt(in.planet, corner + in.eye).altitude);
    place.reach = std::max(place.reach, 1.6 * glm::length(corner - middle) / in.planet.radius);
  }
  return place;
}

bool showsAir(const PlanInput& in) {
  return (in.sky && (in.layers & WLK_LAYER_SKY) != 0) ||
         (in.fog && (in.layers & WLK_LAYER_FOG) != 0);
}

// Whether the light may reach the box or the air between it and the eye, which the volume's passes
// shade as well.
bool lightReachesVolume(const PlanInput& in, const PlanLight& light, VolumePlace place) {
  const glm::dvec3 up = place.middle.up;
  if (showsAir(in)) {
    const PlanetFrame eye = planetFrameAt(in.planet, in.eye);
    place.reach += std::acos(std::clamp(glm::dot(up, eye.up), -1.0, 1.0));
    place.top = std::max(place.top, std::min(eye.altitude, airTop(in)));
  }
  return aboveHorizon(glm::dot(up, light.toLight), place.top, place.reach, in.planet.radius,
                      light.angularRadius);
}

// Roughly the light on and around a box, to tell the lights' order by: all of it, or that of
// twilight, 4e-3 of it and ten times less with each 2.5 degrees (400 lx with the sun at the
// horizon, 0.01 lx at -12 degrees).
double brightnessAt(const PlanInput& in, const PlanLight& light, const VolumePlace& place) {
  constexpr double DEGREE = std::numbers::pi / 180;
  const double mu = std::clamp(glm::dot(place.middle.up, light.toLight), -1.0, 1.0);
  const double above =
      std::asin(mu) + light.angularRadius + place.reach + horizonDip(place.top, in.planet.radius);
  const double twilight = showsAir(in) ? 4e-3 * std::pow(10.0, above / (2.5 * DEGREE)) : 0.0;
  return light.irradiance * (above > 0 ? 1.0 : twilight);
}

// The lights that reach the air the eye sees, the brightest on a volume first: volumes are lit by
// the first. If none reaches the air, only the brightest.
PlanLights chooseLights(const PlanInput& in, const PlanetFrame& eye, bool& reachesAir) {
  struct Candidate {
    PlanLight light;
    bool reaches = false;
    double brightness = 0;
  };
  std::array<Candidate, MAX_LIGHTS> candidates;
  const auto end = candidates.begin() + in.lights.count;
  for (uint32_t i = 0; i < in.lights.count; ++i) {
    Candidate& one = candidates[i];
    one.light = in.lights.light[i];
    one.reaches = lightReachesAir(in, one.light, eye);
    reachesAir = reachesAir || one.reaches;
    for (const std::span<const PlanVolume> boxes : {in.volumes, in.surfaces}) {
      for (const PlanVolume& box : boxes) {
        if (in.lights.count > 1 && box.anyDensity) {
          const VolumePlace place = placeOf(in, cornersOf(relativeBox(in, box)));
          one.brightness = std::max(one.brightness, brightnessAt(in, one.light, place));
        }
      }
    }
  }
  // Insertion: std::stable_sort allocates.
  for (auto next = candidates.begin(); next != end; ++next) {
    const auto place = std::upper_bound(
        candidates.begin(), next, *next, [](const Candidate& a, const Candidate& b) {
          return a.reaches != b.reaches ? a.reaches : a.brightness > b.brightness;
        });
    std::rotate(place, next, next + 1);
  }
  PlanLights chosen;
  for (auto one = candidates.begin(); one != end; ++one) {
    if (one->reaches || chosen.count == 0 || in.quality.noSkip) {
      chosen.light[chosen.count++] = one->light;
    }
  }
  return chosen;
}

// Of a volume that is drawn.
uint32_t ambientReasonOf(const PlanInput& in) {
  if (!in.ambient || in.quality.ambientCells == 0) {
    return WLK_REASON_LAYER_OFF;
  }
  if (in.ambientOfAir && !showsAir(in)) {
    return in.sky || in.fog ? WLK_REASON_LAYER_OFF : WLK_REASON_NOTHING_TO_DRAW;
  }
  return in.ambientOfAir && in.lights.count == 0 ? WLK_REASON_NO_LIGHT : WLK_REASON_NEEDED;
}

// `layer`: the view's that it belongs to.
PlannedVolume planVolume(const PlanInput& in, const PlanLights& lights, const PlanVolume& volume,
                         uint64_t layer) {
  PlannedVolume result{};
  result.id = volume.id;
  result.index = volume.index;
  const glm::dmat4x3 box = relativeBox(in, volume);
  const std::array<glm::dvec3, 8> corners = cornersOf(box);
  result.rect =
      contains(box, glm::dvec3(0)) ? PixelRect{0, 0, in.width, in.height} : coverOf(corners, in);
  result.distance = distanceTo(box);
  for (const glm::dvec3& corner : corners) {
    result.farthest = std::max(result.farthest, glm::length(corner));
  }
  uint32_t reason = WLK_REASON_NEEDED;
  if ((in.layers & layer) == 0) {
    reason = WLK_REASON_LAYER_OFF;
  } else if (!volume.anyDensity) {
    reason = WLK_REASON_ZERO_DENSITY;
  } else if (result.rect.empty()) {
    reason = WLK_REASON_OUTSIDE_VIEW;
  }
  if (reason != WLK_REASON_NEEDED && reason != WLK_REASON_LAYER_OFF && in.quality.noSkip) {
    reason = WLK_REASON_NO_SKIP_FLAG;
    result.rect = {0, 0, in.width, in.height};
  }
  result.drawn = reason == WLK_REASON_NEEDED || reason == WLK_REASON_NO_SKIP_FLAG;
  result.eyeReason = reason;
  result.lightReason = reason;
  result.ambientReason = reason;
  if (!result.drawn) {
    return result;
  }
  result.ambientReason = ambientReasonOf(in);
  result.ambient = result.ambientReason == WLK_REASON_NEEDED;
  const glm::dvec3 middle = box * glm::dvec4(0.5, 0.5, 0.5, 1.0);
  const PlanLight& light = lights.light[0];
  result.lit = lights.count > 0 && lightReachesVolume(in, light, placeOf(in, corners));
  if (!result.lit) {
    if (in.quality.noSkip && lights.count > 0) {
      result.lit = true;
      result.lightReason = WLK_REASON_NO_SKIP_FLAG;
    } else {
      result.lightReason = WLK_REASON_NO_LIGHT;
    }
  }
  const glm::dvec3 view = glm::length(middle) > 0 ? glm::normalize(middle) : glm::dvec3(0, 0, -1);
  result.layout = layoutSlices(box, light.toLight, view, in.quality);
  glm::dmat4x3 own = box;
  own[3] = glm::dvec3(0);
  result.ownLayout = layoutSlices(own, light.toLight, view, in.quality);
  return result;
}

// 0 without perspective. What a row of the matrix shares with the view's axis shifts the picture
// and scales nothing.
double pixelsAheadOf(const PlanInput& in) {
  const glm::dmat4 rows = glm::transpose(in.clipFromEye);
  const glm::dvec3 ahead(rows[3]);
  const double length = glm::length(ahead);
  if (!(length > 0)) {
    return 0;
  }
  const glm::dvec3 forward = ahead / length;
  const auto across = [&](const glm::dvec3& axis, uint32_t pixels) {
    return glm::length(axis - forward * glm::dot(axis, forward)) / length * 0.5 * pixels;
  };
  return std::min(across(glm::dvec3(rows[0]), in.width), across(glm::dvec3(rows[1]), in.height));
}

}  // namespace

uint32_t ambientCellsOf(uint32_t transportCells) {
  // Light that comes from everywhere varies less inside a volume than the sun's.
  return (transportCells / 2 + 7) / 8 * 8;
}

// Marched in every second pixel, and where these differ, a picture of 960 x 540 costs 0.27 to 0.45
// of the time at the same error, from every fourth one on 0.14 to 0.23
// (docs/accuracy-and-performance.md). All rungs of a controlled view alike.
bool halvesVolumes(const WlkQuality& quality) {
  if (quality.volumeResolution != WLK_VOLUME_RESOLUTION_DEFAULT) {
    return quality.volumeResolution == WLK_VOLUME_RESOLUTION_HALF;
  }
  return quality.level != WLK_QUALITY_ULTRA || quality.control != WLK_CONTROL_LEVEL;
}

SliceQuality resolveQuality(const WlkQuality& quality) {
  struct Level {
    uint32_t sliceCount, batchSize, lightSize, slicing, scattering, transportCells;
  };
  // Points of the measured front of time and error (docs/accuracy-and-performance.md). Poisson
  // counts cost what the paper's whole numbers do, with less error: every level takes them.
  constexpr uint32_t ALIGNED = WLK_SLICING_LIGHT_ALIGNED;
  constexpr uint32_t ALL = WLK_SCATTERING_ALL_ORDERS;
  constexpr std::array<Level, 4> LEVELS{{{32, 32, 96, ALIGNED, ALL, 16},
                                         {64, 64, 160, ALIGNED, ALL, 24},
                                         {128, 64, 256, ALIGNED, ALL, 32},
                                         {256, 64, 448, ALIGNED, ALL, 64}}};
  const Level& level = LEVELS[quality.level];
  const auto either = [](uint32_t chosen, uint32_t usual) { return chosen != 0 ? chosen : usual; };
  const uint32_t scattering = either(quality.scattering, level.scattering);
  SliceQuality result{};
  result.sliceCount = either(quality.sliceCount, level.sliceCount);
  result.batchSize = std::min(either(quality.batchSize, level.batchSize), result.sliceCount);
  result.lightSize = either(quality.lightBufferSize, level.lightSize);
  result.halfAngle = either(quality.slicing, level.slicing) == WLK_SLICING_HALF_ANGLE;
  result.transport = scattering == WLK_SCATTERING_ALL_ORDERS;
  // Whole cells on the coarsest level.
  result.transportCells = (either(quality.volumeCells, level.transportCells) + 7) / 8 * 8;
  result.lightFrames = std::max(quality.lightFrames, 1U);
  result.forwardScattering =
      scattering == WLK_SCATTERING_FORWARD || scattering == WLK_SCATTERING_FORWARD_INTEGER;
  result.wholeOrders = scattering == WLK_SCATTERING_FORWARD_INTEGER;
  result.multipleSky = scattering != WLK_SCATTERING_SINGLE;
  result.volumeShadows = (quality.flags & WLK_QUALITY_FLAG_VOLUME_SHADOWS) != 0;
  result.lightShadows = (quality.flags & WLK_QUALITY_FLAG_LIGHT_SHADOWS) != 0;
  result.noSkip = (quality.flags & WLK_QUALITY_FLAG_NO_SKIP) != 0;
  result.halfVolumes = halvesVolumes(quality);
  result.lightRoom = result.lightSize;
  result.cellRoom = result.transportCells;
  result.sliceRoom = result.sliceCount;
  // Slabs that turn with the view have no light to share; an engine that asks for batches wants
  // their memory.
  result.stored = !result.halfAngle && quality.batchSize == 0 &&
                  fitsLightStore(result.sliceCount, result.lightSize);
  result.ambientCells = result.multipleSky ? ambientCellsOf(result.transportCells) : 0;
  result.ambientRoom = result.ambientCells;
  return result;
}

bool fitsLightStore(uint32_t slices, uint32_t lightSize) {
  constexpr uint64_t MOST_TEXELS = uint64_t{1} << 26;  // 512 MiB with two channels
  return uint64_t{lightSize} * lightSize * (slices + 1) <= MOST_TEXELS;
}

PlanetFrame planetFrameAt(const WlkPlanet& planet, const glm::dvec3& point) {
  const glm::dvec3 up = glm::normalize(glm::dvec3(planet.up[0], planet.up[1], planet.up[2]));
  const glm::dvec3 p =
      point - glm::dvec3(planet.seaLevelPoint[0], planet.seaLevelPoint[1], planet.seaLevelPoint[2]);
  const double radius = planet.radius;
  const double vertical = glm::dot(p, up);
  // |p + R up| - R without cancellation: q / (sqrt(R^2 + q) + R), q = |p|^2 + 2 R p.up.
  const double q = glm::dot(p, p) + 2.0 * radius * vertical;
  PlanetFrame frame;
  frame.altitude = q / (std::sqrt(std::max(radius * radius + q, 0.0)) + radius);
  const glm::dvec3 centreTo = p + radius * up;
  const double length = glm::length(centreTo);
  frame.up = length > 0 ? centreTo / length : up;
  return frame;
}

// Why volumes cast shadows on air, fog and ground or not: those out of view do as well.
static uint32_t shadowReasonOf(const PlanInput& in, const Plan& plan) {
  const bool dense = std::any_of(in.volumes.begin(), in.volumes.end(),
                                 [](const PlanVolume& volume) { return volume.anyDensity; });
  return !in.quality.volumeShadows || !(plan.air || plan.fog) || in.volumes.empty()
             ? WLK_REASON_NOTHING_TO_DRAW
         : (in.layers & WLK_LAYER_VOLUMES) == 0 ? WLK_REASON_LAYER_OFF
         : !dense                               ? WLK_REASON_ZERO_DENSITY
         : !plan.lightReaches                   ? WLK_REASON_NO_LIGHT
                                                : WLK_REASON_NEEDED;
}

// Boxes of one layer, drawn ones first; returns their number.
static uint32_t planAll(const PlanInput& in, std::span<const PlanVolume> boxes, uint64_t layer,
                        Plan& plan, std::pmr::vector<PlannedVolume>& planned) {
  planned.clear();
  for (const PlanVolume& box : boxes) {
    planned.push_back(planVolume(in, plan.lights, box, layer));
  }
  std::sort(planned.begin(), planned.end(), [](const PlannedVolume& a, const PlannedVolume& b) {
    if (a.drawn != b.drawn) {
      return a.drawn;
    }
    return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
  });
  uint32_t drawn = 0;
  for (const PlannedVolume& box : planned) {
    if (box.drawn) {
      ++drawn;
      plan.volumeRect = unite(plan.volumeRect, box.rect);
    }
  }
  return drawn;
}

void makePlan(const PlanInput& in, Plan& plan) {
  plan.quality = in.quality;
  plan.pixelsAhead = pixelsAheadOf(in);
  plan.ambient = in.ambient;
  plan.volumeRect = {};
  const PlanetFrame eye = planetFrameAt(in.planet, in.eye);
  bool reachesAir = false;
  plan.lights = chooseLights(in, eye, reachesAir);
  plan.drawnCount = planAll(in, in.volumes, WLK_LAYER_VOLUMES, plan, plan.volumes);
  plan.surfaceCount = planAll(in, in.surfaces, WLK_LAYER_SURFACES, plan, plan.surfaces);
  plan.air = in.sky && (in.layers & WLK_LAYER_SKY) != 0;
  plan.absorber = plan.air && in.absorber;
  plan.fog = in.fog && (in.layers & WLK_LAYER_FOG) != 0;
  // The passes of a lit volume shade the air before it as well.
  const auto shaded = [](const PlannedVolume& volume) {
    return volume.drawn && volume.lit && volume.lightReason != WLK_REASON_NO_SKIP_FLAG;
  };
  plan.lightReaches = reachesAir || std::any_of(plan.volumes.begin(), plan.volumes.end(), shaded) ||
                      std::any_of(plan.surfaces.begin(), plan.surfaces.end(), shaded);
  plan.light = plan.lightReaches || (plan.lights.count > 0 && in.quality.noSkip);
  plan.disk = false;
  plan.shapedDisk = false;
  for (uint32_t i = 0; i < plan.lights.count; ++i) {
    const PlanLight& light = plan.lights.light[i];
    const bool shown = plan.air && (in.layers & WLK_LAYER_SUN_DISK) != 0 && light.angularRadius > 0;
    plan.disk = plan.disk || shown;
    plan.shapedDisk = plan.shapedDisk || (shown && light.shaped);
  }
  plan.ground = plan.air && (in.layers & WLK_LAYER_GROUND) != 0;
  plan.multiple = in.quality.multipleSky && plan.light && (plan.air || plan.fog);
  if (plan.multiple && plan.lightReaches) {
    // Light that was scattered over the edge of night reaches the air before a volume that has no
    // light itself; the passes know only one kind of lit volume.
    for (std::pmr::vector<PlannedVolume>* all : {&plan.volumes, &plan.surfaces}) {
      for (PlannedVolume& volume : *all) {
        if (volume.drawn && !volume.lit) {
          volume.lit = true;
          volume.lightReason = WLK_REASON_NEEDED;
        }
      }
    }
  }
  for (PlannedVolume& volume : plan.volumes) {
    volume.ambientWhole = !(in.quality.transport && volume.lit && plan.lightCount() > 0);
  }
  if (!plan.multiple) {
    const bool layersOff = (in.sky || in.fog) && !plan.air && !plan.fog;
    plan.skyReason = layersOff                               ? WLK_REASON_LAYER_OFF
                     : (plan.air || plan.fog) && !plan.light ? WLK_REASON_NO_LIGHT
                                                             : WLK_REASON_NOTHING_TO_DRAW;
  }
  plan.shadowReason = shadowReasonOf(in, plan);
  plan.shadows = plan.shadowReason == WLK_REASON_NEEDED;
  plan.lightShadows = in.shadowMap && in.quality.lightShadows && (plan.air || plan.fog) &&
                      plan.lightReaches && plan.lights.light[0].index == in.shadowLight;
  const bool something = plan.air || plan.fog || plan.drawnCount > 0 || plan.surfaceCount > 0;
  plan.composite = something || in.mustWrite || in.quality.noSkip;
  plan.compositeReason =
      something || in.mustWrite
          ? WLK_REASON_NEEDED
          : (in.quality.noSkip ? WLK_REASON_NO_SKIP_FLAG : WLK_REASON_NOTHING_TO_DRAW);
}

}  // namespace welkin
