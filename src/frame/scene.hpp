// SPDX-License-Identifier: MIT
// What a context holds between frames: the scene as the engine set it, and the GPU objects that
// belong to it.
#pragma once

#include <welkin/welkin.h>
#include <welkin/welkin_vulkan.h>

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

#include "frame/bricks.hpp"
#include "frame/governor.hpp"
#include "frame/light_schedule.hpp"
#include "frame/plan.hpp"
#include "frame/surface.hpp"
#include "particles/diameter_nodes.hpp"
#include "particles/medium.hpp"
#include "tables/particle_tables.hpp"
#include "vk/device.hpp"
#include "vk/pipelines.hpp"

namespace welkin {

constexpr int DEPTH_NODES = 32;  // of a scattering table, see tables/multiscatter.hpp
constexpr uint32_t FIELD_KINDS = 512 * (1 + WLK_MAX_FIELDS);  // values of VolumeState::fieldKind

// Made where they are asked for first.
struct LateNodes {
  std::shared_ptr<const DiameterNodes> made;
};

// Fields have a copy and share what is dear: they outlive the medium's handle.
struct MediumState {
  Medium medium;
  std::shared_ptr<LateNodes> nodes;
  std::shared_ptr<MediumTables> tables;
};

// Voxels [first, end) along each axis; empty if none.
struct VoxelRange {
  Edges first{~0U, ~0U, ~0U};
  Edges end{};
};

// A field's image: Welkin's own, made by the first upload, of voxels or an atlas of bricks, or the
// engine's.
struct FieldState {
  Medium medium;
  std::shared_ptr<LateNodes> nodes;
  std::shared_ptr<MediumTables> tables;
  float extinctionScale = 0;
  // Of what extinction takes from light: what is turned, by the mean of 1 - cosine, or absorbed,
  // and what is absorbed alone.
  float transportShare = 1;
  float absorbedShare = 1;
  float largest = 0;  // bound of the values in `image`
  // Means of the values and their squares; of an upload by parts as if the rest kept its mean.
  double mean = 0;
  double meanSquare = 0;
  VoxelRange filled;  // holds all values above 0 in `image`
  vk::Image image;
  Edges atlas{};       // slots of `image`, 0 where it holds voxels
  uint64_t slots = 0;  // of them used
  std::optional<WlkVulkanImage> external;

  bool bricks() const { return atlas[0] > 0 && !external; }
};

// Source distributions of a volume's fields, one layer each, then of its diameters' nodes, and the
// fields' forward parts.
struct ScatteringTable {
  vk::Image image;
  vk::Buffer staging;  // until the table is uploaded
  std::array<std::array<float, DEPTH_NODES>, WLK_MAX_FIELDS> forwardFraction{};
};

// Data on its way to a field's image, or to the pages.
struct PendingUpload {
  uint64_t volumeId = 0;
  uint32_t field = 0;
  vk::Buffer staging;
  VkBufferImageCopy region{};
};

struct TransportMedia;

// PendingUpload::field of what is no field.
constexpr uint32_t PAGES = WLK_MAX_FIELDS;
constexpr uint32_t LEAPS = WLK_MAX_FIELDS + 1;
constexpr uint32_t DIAMETERS = WLK_MAX_FIELDS + 2;

// Texels along a store's edges, and what it holds: 0 optical depth, else also what forward
// scattering gives back, of the scattering tables form - 1.
struct LightStoreShape {
  uint32_t size = 0;
  uint32_t layers = 0;
  uint32_t form = 0;
  bool operator==(const LightStoreShape&) const = default;
};

// What a store's light was computed from.
struct LightStoreKey {
  std::array<float, 4 * (6 + size_t{DEPTH_NODES})> rows{};
  uint32_t slices = 0;
  uint32_t size = 0;
  uint64_t version = 0;
  uint64_t filled = 0;  // 0: nothing was computed yet
  bool operator==(const LightStoreKey&) const = default;
};

// A volume's light at all slabs, for views of one shape.
struct LightStore {
  LightStoreShape shape;
  vk::Image image;
  LightStoreKey key;
};

// Radiance, RGB, of the light outside along each direction of a volume's ambient grid.
constexpr size_t AMBIENT_LIGHT_DIRECTIONS = 26;
using AmbientLight = std::array<glm::vec4, AMBIENT_LIGHT_DIRECTIONS>;
// What it scatters by high degrees, see AmbientUniforms::fine.
using AmbientFine = std::array<glm::vec4, 256>;

// The light of sky and ground on a volume, and what it was made of.
struct VolumeAmbient {
  AmbientLight light{};
  AmbientFine fine{};
  std::vector<char> key;  // empty: nothing yet
};

struct VolumeState {
  explicit VolumeState(std::pmr::memory_resource* memory)
      : faces{BrickFaces(memory), BrickFaces(memory), BrickFaces(memory), BrickFaces(memory)},
        pageTexels(memory),
        leapTexels(memory) {}
  Edges size{};
  uint32_t fieldCount = 0;
  std::array<FieldState, WLK_MAX_FIELDS> fields;
  glm::dmat4x3 worldFromBox{1.0};
  std::array<ScatteringTable, SCATTERING_FORMS> tables;  // those that views ask for
  std::shared_ptr<const TransportMedia> transport;       // likewise
  vk::Buffer pairTable;                                  // of `transport`, as its passes read it
  uint64_t version = 1;                                  // of the fields' contents
  std::vector<LightStore> lightStores;                   // one per shape that views ask for
  std::array<VolumeAmbient, 2> ambient;          // second: with the peak of the phase function
  std::array<BrickFaces, WLK_MAX_FIELDS> faces;  // of Welkin's own images; empty: of none
  // Where fields are kept as bricks: the slot of each, a channel per field (pageChannels).
  vk::Image pages;
  std::pmr::vector<float> pageTexels;
  // How far each brick is from anything, where wlkPrepare found the volume empty enough.
  vk::Image leaps;
  std::pmr::vector<BrickLeap> leapTexels;  // room for them
  uint64_t uploads = 0;                    // to any field
  uint64_t leapsAt = ~uint64_t{0};         // the same when wlkPrepare looked last

  // Diameters of one field's droplets per voxel, in nodes; empty without.
  vk::Image diameters;
  uint32_t diameterField = 0;
  std::shared_ptr<const DiameterNodes> diameterNodes;

  uint32_t tableLayers() const {
    return fieldCount + (diameters ? static_cast<uint32_t>(DIAMETER_NODES) : 0u);
  }
  static constexpr uint32_t LEAPING = 1u << 7;
  uint32_t pageChannels() const { return fieldCount == 1 ? 1 : 4; }
  static constexpr uint32_t GREY = 1u << 8;
  bool grey = false;  // all colours scatter alike
  static constexpr uint32_t VARYING = 1u << 9;
  // How passes read the fields: their number, from bit 3 on which are kept as bricks, in bit 7
  // whether rays leap, in bit 8 `grey` and from bit 9 on 1 + `diameterField`, 0 without diameters.
  uint32_t fieldKind() const {
    uint32_t kind = fieldCount | (grey ? GREY : 0u);
    kind |= diameters ? VARYING * (1 + diameterField) : 0u;
    bool known = true;
    for (uint32_t i = 0; i < fieldCount; ++i) {
      kind |= (fields[i].bricks() ? 1u : 0u) << (3 + i);
      known = known && !fields[i].external;
    }
    return kind | (leaps && known ? LEAPING : 0u);
  }

  bool anyDensity() const {
    for (uint32_t i = 0; i < fieldCount; ++i) {
      const FieldState& f = fields[i];
      if (f.extinctionScale > 0 && (f.largest > 0 || f.external)) {
        return true;
      }
    }
    return false;
  }
};

// The key of a pass that reads fields of a kind (VolumeState::fieldKind).
inline vk::PipelineKey ofFields(vk::PipelineKey key, uint32_t kind) {
  key.constants[3] = kind & 7u;
  key.constants[11] = kind >> 3 & 15u;
  return key;
}

// A descriptor set and what it points to; written only where that changes.
struct BoundSet {
  VkDescriptorSet set = VK_NULL_HANDLE;
  std::array<uint64_t, vk::MOST_BINDINGS> bound{};
};

// GPU time of a pass over a volume or a surface.
struct PassTime {
  uint32_t pass = 0;
  uint64_t objectId = 0;
  uint64_t nanoseconds = 0;
};

// What recording reported about a frame, and the times of the newest frame that is complete.
struct FrameRecord {
  explicit FrameRecord(std::pmr::memory_resource* memory) : passes(memory), times(memory) {}
  WlkFrameStats stats{};
  std::pmr::vector<WlkPassStats> passes;
  std::pmr::vector<PassTime> times;
};

// Numbers that belong to moments.
struct SkyLightConstants {
  double top = 1;  // highest altitude of the moments, m
  double fogShare = 0;
  // Of the fog they were solved for: the scene's may have changed since.
  double fogExtinction = 0;
  double fogScaleHeight = 1;
  glm::vec4 eyeFog{0};
  glm::vec4 fogTable{0};
  float groundFog = 1;  // of the fog's extinction, what keeps the light's peak from the ground
  glm::vec4 fogBound{0};
};

// Light scattered more than once, as the passes read it.
struct SkyLightState {
  vk::Image moments;   // blocks of altitudes by suns, one below the other; last row: the ground's
  vk::Image fog;       // see src/tables/fog_light.hpp; nothing until there is fog
  vk::Buffer staging;  // until they are uploaded; the fog's table behind the moments
  bool fogStaged = false;
  SkyLightConstants staged;
  SkyLightConstants now;  // of what is in `moments`
  uint64_t version = 0;

  const SkyLightConstants& latest() const { return staging ? staged : now; }
};

// What a view's sky table was made for: it changes with these numbers only.
using SkyTableKey = std::array<float, 56>;

// The light inside a volume that views show, and what it was computed from.
struct TransportGrid {
  vk::Buffer kept;
  std::vector<char> key;  // uniforms, volume and its version; empty: nothing yet
};

// The light of sky and ground there.
struct AmbientGrid {
  TransportGrid grid;
  uint64_t frame = 0;     // that last showed it
  bool external = false;  // from images that the engine may have written since
};

// Lists that the light inside a volume is computed in.
struct TransportWork {
  vk::Buffer sources;  // empty: none of its own
  vk::Buffer swept;
};

// The sun's light inside a volume, where it is computed over several frames in several grids.
struct VolumeLight {
  std::array<TransportGrid, SPREAD_LIGHTS> grids;  // the first alone where it is computed at once
  TransportWork work;                              // empty: the view's
  LightSchedule schedule;
  // Of the frame that was recorded last, by whichever view came first.
  glm::dvec3 toLight{0};
  uint64_t frame = 0;
  LightStep step;
  std::vector<char> key;  // as of a grid
};

struct ViewSlot {
  BoundSet composite;
  BoundSet aerial;
  BoundSet distance;
  BoundSet skyTable;
  std::pmr::vector<BoundSet> volumes;
  std::pmr::vector<BoundSet> froxels;    // of the volumes, where the view has aerial perspective
  std::pmr::vector<BoundSet> transport;  // of the volumes' grids by PlannedVolume::index
  std::pmr::vector<BoundSet> ambient;    // likewise
  std::pmr::vector<BoundSet> surfaces;   // three of each: of its lights, of the view
  VkQueryPool queries = VK_NULL_HANDLE;
  uint64_t frameIndex = 0;                 // last frame recorded into this slot, 0 if none
  bool harvested = true;                   // its counters and timestamps were read
  std::pmr::vector<uint32_t> passOfQuery;  // query i + 1 ends a command of this pass
  std::pmr::vector<PassTime> passes;       // of that frame, in the plan's order
  explicit ViewSlot(std::pmr::memory_resource* memory)
      : volumes(memory),
        froxels(memory),
        transport(memory),
        ambient(memory),
        surfaces(memory),
        passOfQuery(memory),
        passes(memory) {}
};

struct ShadowSlot {
  uint64_t frameIndex = 0;  // that wrote the queries, 0 if none waits to be read
};

// Remade by wlkPrepare when sizes change. Nothing in here is destroyed by its destructor except
// buffers: destroyShadowMap.
struct ShadowMapResources {
  explicit ShadowMapResources(std::pmr::memory_resource* memory)
      : sets(memory), slots(memory), key(memory), now(memory) {}
  vk::Buffer uniforms;  // per slot: volumes
  VkDeviceSize stride = 0;
  vk::Buffer sums;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkQueryPool queries = VK_NULL_HANDLE;
  std::pmr::vector<BoundSet> sets;  // per slot: one of each volume
  std::pmr::vector<ShadowSlot> slots;
  uint32_t volumeCapacity = 0;
  std::pmr::vector<char> key;  // what the image was made from; empty: it holds nothing
  std::pmr::vector<char> now;  // room for the next key
};

struct ShadowMapState {
  explicit ShadowMapState(std::pmr::memory_resource* memory) : resources(memory) {}
  WlkCloudShadowInfo info{};
  ShadowMapResources resources;
  bool prepared = false;
  VkImage image = VK_NULL_HANDLE;  // that holds it, in this level and layer
  uint32_t mipLevel = 0;
  uint32_t layer = 0;
  uint64_t lastFrame = 0;  // 0: none recorded yet
  uint64_t gpuTime_ns = 0;
  WlkCloudShadowState last{};
};

// A volume of the context that the map may show.
struct ShadowCaster {
  uint64_t id = 0;
  const VolumeState* state = nullptr;
  std::array<VkImageView, WLK_MAX_FIELDS> externalViews{};
};

// What the froxels of a view's aerial perspective are computed with.
struct AerialResources {
  vk::Buffer uniforms;  // per slot: frame, volumes
  VkDeviceSize slotStride = 0;
  VkDeviceSize volumeOffset = 0;
  vk::Buffer frameState;  // slice by slice
  vk::Buffer volumeState;
};

// Images and buffers of a view; remade by wlkPrepare when their sizes change.
struct ViewResources {
  explicit ViewResources(std::pmr::memory_resource* memory)
      : volumeLights(memory),
        ambientGrids(memory),
        shadow(memory),
        shadowCasters(memory),
        slots(memory) {}
  // Whether pipelines and buffers are there for light kept for all views, and for light in batches.
  bool stores = false;
  bool batches = false;
  vk::Image lightBuffer;
  vk::Image viewSource;          // what cells of the volume in turn scatter towards the eye
  TransportWork transportWork;   // where light is computed at once: one volume at a time
  uint32_t transportLights = 1;  // grids of each volume
  VkDeviceSize transportStride = 0;
  VkDeviceSize transportOffset = 0;
  // By PlannedVolume::index; views of like quality share them.
  std::pmr::vector<std::shared_ptr<VolumeLight>> volumeLights;
  vk::Image viewAmbient;  // as viewSource, of the light of sky and ground
  vk::Buffer ambientWork;
  VkDeviceSize ambientStride = 0;
  VkDeviceSize ambientOffset = 0;
  std::pmr::vector<std::shared_ptr<AmbientGrid>> ambientGrids;  // likewise
  ShadowMapState shadow;
  vk::Image shadowImage;  // where the quality asks for shadows on the air
  std::pmr::vector<ShadowCaster> shadowCasters;
  AerialResources aerial;
  // Of surfaces, in turn: what triangles cover, which of them texels of a light map show, and its
  // levels.
  vk::Buffer surfaceCover;
  vk::Buffer surfaceFaces;
  vk::Buffer surfaceLevels;
  vk::Buffer surfaceList;  // pixels that it covers
  VkDeviceSize surfaceStride = 0;
  VkDeviceSize surfaceOffset = 0;
  uint32_t surfaceCapacity = 0;
  vk::Buffer distances;  // of the volumes, where the view tells them
  vk::Buffer frameState;
  vk::Buffer volumeState;
  uint32_t march = 0;   // number of the last one in a grid of pixels, see SLICE_MARCH
  vk::Buffer uniforms;  // per slot: frame, fog curve, volumes
  VkDeviceSize slotStride = 0;
  VkDeviceSize fogOffset = 0;
  VkDeviceSize volumeStride = 0;
  vk::Image skyTable;
  vk::Image skyPeak;    // where there is fog
  bool space = false;   // pixels may gather their own light
  uint32_t lights = 1;  // that the sky table has room for
  SkyTableKey skyKey{};
  uint64_t skyVersion = 0;  // SkyLightState::version of what is in the table, 0 if nothing is
  vk::Buffer counters;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  std::pmr::vector<ViewSlot> slots;
  uint32_t volumeCapacity = 0;
  uint32_t queryCount = 0;
  // Headless only.
  bool rendered = false;  // `readback` holds a picture
  vk::Image depth;
  vk::Image color;
  vk::Image shadowDepth;  // layers of a shadow map, made when one is given
  vk::Buffer shadowUpload;
  vk::Image target0;
  vk::Image target1;
  vk::Buffer upload;
  vk::Buffer readback;
};

struct ViewState {
  explicit ViewState(std::pmr::memory_resource* memory)
      : resources(memory),
        plan(memory),
        planVolumes(memory),
        planSurfaces(memory),
        record(memory) {}
  WlkViewInfo info{};
  WlkCamera camera{};
  glm::dmat4 clipFromView{1.0};
  glm::dmat4 eyeFromNdc{1.0};  // world orientation, relative to the eye
  glm::dmat4 clipFromEye{1.0};
  double skyDepth = 0;
  WlkQuality quality{};
  std::optional<WlkAerialPerspective> aerial;
  bool volumeDistance = false;
  bool shadowUnused = false;  // an engine's map, in the last frame that got one
  Governor governor;          // where the quality is governed
  ViewResources resources;
  Plan plan;
  std::pmr::vector<PlanVolume> planVolumes;
  std::pmr::vector<PlanVolume> planSurfaces;
  FrameRecord record;
  bool prepared = false;
  uint64_t lastFrame = 0;       // 0: none recorded yet
  uint64_t harvestedFrame = 0;  // newest frame whose counters were read
  uint64_t nonFinite = 0;       // of that frame
};

}  // namespace welkin
