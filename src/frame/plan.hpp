// SPDX-License-Identifier: MIT
// The plan of a view's frame: which passes run over what, which are skipped and why. Pure data,
// computed on the CPU from the scene; record.cpp turns it into commands, the statistics return it.
#pragma once

#include <welkin/welkin.h>

#include <array>
#include <glm/glm.hpp>
#include <memory_resource>
#include <span>
#include <vector>

#include "frame/plan_slices.hpp"

namespace welkin {

constexpr uint32_t MAX_LIGHTS = 2;

// Sizes and methods that a quality level or its overrides stand for.
struct SliceQuality {
  uint32_t sliceCount;
  uint32_t batchSize;
  uint32_t lightSize;
  bool halfAngle;
  bool forwardScattering;
  bool wholeOrders;  // ceil(n) scatterings instead of Poisson counts
  bool noSkip;
  // Light inside volumes on a grid of `transportCells` along each axis; excludes forwardScattering.
  bool transport;
  uint32_t transportCells;
  uint32_t lightFrames;  // over which that light is renewed
  // Light-buffer texels and cells along an edge that the view's images have room for.
  uint32_t lightRoom;
  uint32_t cellRoom;
  // The light of all slabs is kept for every view of the volume, which has room for so many.
  bool stored;
  uint32_t sliceRoom;
  // Of the grid for the light of sky and ground; 0 where that is not followed.
  uint32_t ambientCells;
  uint32_t ambientRoom;
  bool volumeShadows;  // on air, fog and ground
  bool lightShadows;   // likewise, by the engine's map
  bool halfVolumes;    // rays of stored volumes in some pixels, and where these differ
  bool multipleSky;    // light scattered more than once in air and fog
  // Index of the scattering tables.
  uint32_t form() const { return transport ? 2 : (forwardScattering && wholeOrders ? 1 : 0); }
};
// Of the grid for the light of sky and ground, by those for the sun's.
uint32_t ambientCellsOf(uint32_t transportCells);
SliceQuality resolveQuality(const WlkQuality& quality);
// Whether light may be kept for so many slabs and texels along an edge.
bool fitsLightStore(uint32_t slices, uint32_t lightSize);

// A frame on the planet's surface: doubles, because altitudes are small beside the radius.
struct PlanetFrame {
  glm::dvec3 up{0, 1, 0};  // away from the planet's centre at the point asked for
  double altitude = 0;     // of that point, m
};
PlanetFrame planetFrameAt(const WlkPlanet& planet, const glm::dvec3& point);

struct PixelRect {
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

// A light with irradiance.
struct PlanLight {
  uint32_t index = 0;  // in the order the engine set them
  glm::dvec3 toLight{0, 1, 0};
  double angularRadius = 0;
  double irradiance = 0;  // of the brightest colour
  bool shaped = false;    // its disk is not uniform
};
// Those that reach the air, the brightest on a volume first; all where none is to be skipped.
struct PlanLights {
  std::array<PlanLight, MAX_LIGHTS> light;
  uint32_t count = 0;
};

struct PlanVolume {
  uint64_t id = 0;
  uint32_t index = 0;  // place in the context's list
  glm::dmat4x3 worldFromBox{1.0};
  bool anyDensity = true;
};

struct PlanInput {
  uint64_t layers = 0;
  bool sky = false;
  bool absorber = false;
  bool fog = false;
  double airScaleHeight = 0;  // m, where `sky`
  double fogBaseAltitude = 0;
  double fogScaleHeight = 0;  // m, where `fog`
  PlanLights lights;
  bool ambient = false;  // light of sky and ground is asked for on volumes
  // And it is that of the scene's own air, which the view has to show.
  bool ambientOfAir = false;
  bool shadowMap = false;    // the engine gave one
  uint32_t shadowLight = 0;  // whose it is, in the order the engine set them
  bool mustWrite = false;    // the targets need a value even if nothing is drawn
  WlkPlanet planet{};
  glm::dvec3 eye{0};
  glm::dmat4 clipFromEye{1.0};  // position relative to the eye, world orientation, to clip space
  uint32_t width = 0;
  uint32_t height = 0;
  SliceQuality quality{};
  std::span<const PlanVolume> volumes;
  std::span<const PlanVolume> surfaces;  // their boxes
};

struct PlannedVolume {
  uint64_t id;
  uint32_t index;
  bool drawn;
  bool lit;
  bool ambient;  // lit by sky and ground
  uint32_t ambientReason;
  // The peak of the phase function counts as scattering, not as passing: as the eye's pass does.
  bool ambientWhole;
  uint32_t lightReason;
  uint32_t eyeReason;
  double distance;  // from the eye to the nearest point of the box and to its farthest, m
  double farthest;
  PixelRect rect;
  SliceLayout layout;
  SliceLayout ownLayout;  // relative to the box's corner: the same for every eye
};

struct Plan {
  explicit Plan(std::pmr::memory_resource* memory) : volumes(memory), surfaces(memory) {}
  std::pmr::vector<PlannedVolume> volumes;   // drawn ones first, nearest first
  std::pmr::vector<PlannedVolume> surfaces;  // likewise
  uint32_t drawnCount = 0;                   // of the volumes
  uint32_t surfaceCount = 0;                 // of the surfaces
  PixelRect volumeRect;                      // union of the drawn ones of both
  double pixelsAhead = 0;  // per metre across the view, one metre ahead, in the narrower direction
  bool air = false;
  bool absorber = false;  // in the air
  bool fog = false;
  PlanLights lights;          // volumes are lit by the first
  bool lightReaches = false;  // air, fog or ground
  bool light = false;         // and is shaded
  bool disk = false;
  bool shapedDisk = false;
  bool ground = false;
  bool multiple = false;    // its light scattered more than once is shown
  bool space = false;       // and gathered by every pixel
  bool allLight = false;    // clear air: its table holds light scattered once, too
  uint32_t skyZeniths = 0;  // of its table
  bool composite = false;
  bool ambient = false;  // light of sky and ground is asked for on volumes
  SliceQuality quality{};
  bool shadows = false;       // of volumes, on air, fog and ground
  bool lightShadows = false;  // of surfaces, by the engine's map
  uint32_t shadowReason = WLK_REASON_NEEDED;
  uint32_t skyReason = WLK_REASON_NEEDED;
  uint32_t compositeReason = WLK_REASON_NEEDED;

  // AIR_KIND of the passes.
  uint32_t airKind() const { return air ? (absorber ? 2U : 1U) : 0U; }
  // LIGHT_COUNT of the passes.
  uint32_t lightCount() const { return light ? lights.count : 0U; }
  // SHADOW_KIND of the passes.
  uint32_t shadowKind() const { return (shadows ? 1U : 0U) | (lightShadows ? 2U : 0U); }
  // DISK_KIND of the passes.
  uint32_t diskKind() const { return disk ? (shapedDisk ? 2U : 1U) : 0U; }
};

// Fills `plan`; allocates only if there are more volumes than plan.volumes has room for.
void makePlan(const PlanInput& input, Plan& plan);

}  // namespace welkin
