// SPDX-License-Identifier: MIT
// Makes the GPU objects of views and volumes: everything recording will need.
#pragma once

#include <span>

#include "frame/scene.hpp"
#include "frame/shared_lights.hpp"
#include "frame/uniforms.hpp"

namespace welkin {

// Which air models the scene has; decides the pipelines of a view.
struct SceneFeatures {
  bool sky = false;
  bool absorber = false;
  bool fog = false;
  uint32_t lights = 1;
  bool shapedDisk = false;
  bool space = false;  // a view's eye is, or may soon be, far above the air
  // Of the view's volumes, some or all.
  bool stores = false;   // keep light for all views
  bool batches = false;  // do not
  bool ambient = false;  // volumes may be lit by sky and ground
  uint32_t surfaces = 0;
  bool several = false;  // more than one volume or surface
};

// What views share.
struct ViewLights {
  SharedLights<VolumeLight> sun;
  SharedLights<AmbientGrid> ambient;
};

VkFormat targetFormat(uint32_t welkinFormat);

// Lines that a view's statistics have at most.
constexpr size_t passRoom(size_t volumes, size_t surfaces) {
  return 5 + 4 * volumes + 2 * surfaces;
}

// (Re)makes what the view needs for up to `volumeCount` volumes. Strong guarantee: on failure the
// view keeps what it had.
void prepareView(vk::Device& device, vk::Pipelines& pipelines, ViewState& view,
                 uint32_t volumeCount, uint32_t framesInFlight, const SceneFeatures& features,
                 std::span<const uint32_t> fieldKinds, ViewLights& lights,
                 std::pmr::memory_resource* memory);
void destroyView(vk::Device& device, ViewState& view);

// Builds the volume's scattering tables of a form (SliceQuality::form) and the staging copy of
// them.
void prepareVolume(vk::Device& device, VolumeState& volume, uint32_t form);
// What the light of the grids of cells depends on.
void prepareMedia(vk::Device& device, VolumeState& volume);
// The same anew; returns the table that frames in flight may read. Strong guarantee.
vk::Buffer replaceMedia(vk::Device& device, VolumeState& volume);

constexpr VkDeviceSize FOG_CURVE_BYTES = sizeof(FogPhaseState::curve);

// The key of a pass in the state a plan asks for.
struct LightVariant {
  bool forward;
  bool stored;  // all slabs at once
};
vk::PipelineKey lightKey(const LightVariant& variant, uint32_t fields);
struct EyeVariant {
  uint32_t air;  // Plan::airKind
  bool fog, light, depth, allLight;
  bool stored;  // marches through a store
  bool ambient;
  uint32_t rays = interface_::RAYS_OF_PIXELS;  // of what: RAYS_OF_*
  bool distance = false;
};
struct SurfaceVariant {
  uint32_t air;  // Plan::airKind
  bool fog, light, allLight, distance, ambient, detail;
};
vk::PipelineKey surfaceEndsKey(bool depth);
vk::PipelineKey surfaceCoverKey(bool ends, bool large);
vk::PipelineKey surfaceFacesKey(bool large);
vk::PipelineKey surfaceCellsKey(bool large);
vk::PipelineKey surfaceShellKey(bool means);
vk::PipelineKey surfaceMapKey(bool fromLevel, bool detail);
vk::PipelineKey surfaceListKey(bool distance, bool half);
vk::PipelineKey surfaceScatterKey(bool half);
vk::PipelineKey surfaceShadeKey(const SurfaceVariant& variant, const SliceQuality& quality);
vk::PipelineKey distanceKey();
// What pixels between rays take on.
inline constexpr std::array SPREADS{interface_::SPREAD_TO_SECONDS, interface_::SPREAD_TO_PIXELS};
struct SpreadVariant {
  bool depth, distance, behind;
  bool tiles;  // only where something was seen
};
vk::PipelineKey spreadKey(uint32_t to, const SpreadVariant& variant);
// Where that is, and what an empty ray leaves in all other tiles.
vk::PipelineKey tilesKey();
vk::PipelineKey clearKey(bool distance);
// Whether rays leap over empty bricks of volumes with this field kind.
bool leapsIn(uint32_t fields, const SliceQuality& quality);
vk::PipelineKey eyeKey(const EyeVariant& variant, uint32_t fields, const SliceQuality& quality);
inline constexpr std::array TRANSPORT_PASSES{
    vk::Pass::TransportDepth,  vk::Pass::TransportCells,       vk::Pass::TransportSweep,
    vk::Pass::TransportGather, vk::Pass::TransportExtrapolate, vk::Pass::TransportRestrict,
    vk::Pass::TransportSource, vk::Pass::TransportResponse,    vk::Pass::TransportView};
vk::PipelineKey transportKey(vk::Pass pass, uint32_t fields);
inline constexpr std::array AMBIENT_PASSES{vk::Pass::AmbientCells,  vk::Pass::AmbientSweep,
                                           vk::Pass::AmbientGather, vk::Pass::AmbientRestrict,
                                           vk::Pass::AmbientSource, vk::Pass::AmbientView};
vk::PipelineKey ambientKey(vk::Pass pass, uint32_t fields);
vk::PipelineKey skyTableKey(uint32_t air, bool fog, uint32_t lights, bool allLight);
struct CompositeVariant {
  uint32_t air;
  bool fog;
  uint32_t lights;  // Plan::lightCount
  bool volumes, depth;
  uint32_t disk;  // Plan::diskKind
  bool ground, multiple, space, allLight;
  uint32_t shadows;  // Plan::shadowKind
  bool tiles;        // blends tiles in which something is seen, see onlyTilesSeen
};
vk::PipelineKey compositeKey(const WlkViewInfo& info, const CompositeVariant& variant);
vk::PipelineKey aerialKey(CompositeVariant variant);

// Makes every pipeline that a view's frames may ask for without another wlkPrepare.
void preparePipelines(vk::Pipelines& pipelines, const ViewState& view,
                      const SceneFeatures& features, std::span<const uint32_t> fieldKinds);

}  // namespace welkin
