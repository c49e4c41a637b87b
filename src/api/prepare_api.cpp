// SPDX-License-Identifier: MIT
// wlkPrepare: pipelines, buffers and tables of what is there.
#include <chrono>
#include <utility>

#include "api/context.hpp"
#include "api/leap_maps.hpp"
#include "api/light_stores.hpp"
#include "api/plan_input.hpp"
#include "api/sky_light.hpp"
#include "api/surface_data.hpp"
#include "api/volume_media.hpp"
#include "frame/light_store.hpp"

using namespace welkin;

// Whether the eye is so high that it may soon look down on the edge of night: a tenth of where
// pixels gather their light themselves, some 12 km on Earth.
static bool nearSpace(const WlkContext_T& c, const ViewState& view) {
  const glm::dvec3 eye(view.camera.position[0], view.camera.position[1], view.camera.position[2]);
  return seenFromSpace(c.skyLight.latest(), 10 * planetFrameAt(c.air.planet, eye).altitude);
}

// The tables of the forms that views ask for.
static void prepareTables(WlkContext_T& c, VolumeState& volume) {
  for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
    if (const ViewState* view = c.views.at(i)) {
      const SliceQuality quality = resolveQuality(view->quality);
      prepareVolume(*c.device, volume, quality.form());
      if (quality.ambientCells > 0 && c.ambientActive()) {
        prepareMedia(*c.device, volume);
      }
    }
  }
}

// What views and maps had before they had to be prepared anew: nothing can use it any more, and it
// takes the room of what shall replace it. Tells whether that room is there now; else it will be
// once the frames in flight are complete.
static bool giveUpOld(WlkContext_T& c) {
  c.retired.reserve(c.retired.size() + c.views.count() + c.shadowMaps.count());
  bool any = false;
  for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
    ViewState* view = c.views.at(i);
    if (view != nullptr && !view->prepared && !view->resources.slots.empty()) {
      c.retireView(*view);
      any = true;
    }
  }
  for (uint32_t i = 0; i < c.shadowMaps.slotCount(); ++i) {
    ShadowMapState* map = c.shadowMaps.at(i);
    if (map != nullptr && !map->prepared && !map->resources.slots.empty()) {
      retireShadowMap(c, *map);
      any = true;
    }
  }
  c.collect();
  return any && c.completedFrame >= c.frameIndex;
}

// Tells how many views were made new.
static uint32_t prepareAll(WlkContext_T& c) {
  vk::Device& device = *c.device;
  uint32_t prepared = 0;
  prepareLeaps(c);
  renewMedia(c, 0);
  std::array<bool, FIELD_KINDS> used{};
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    if (VolumeState* volume = c.volumes.at(i)) {
      prepareTables(c, *volume);
      used[volume->fieldKind()] = true;
    }
  }
  std::array<uint32_t, FIELD_KINDS> fieldKinds{};
  size_t kinds = 0;
  for (uint32_t kind = 0; kind < FIELD_KINDS; ++kind) {
    if (used[kind]) {
      fieldKinds[kinds++] = kind;
    }
  }
  SceneFeatures features;
  features.sky = c.air.sky.has_value();
  features.absorber = features.sky && c.absorbs();
  features.fog = c.fogActive();
  features.lights = std::max(c.air.lightCount, 1U);
  features.shapedDisk = c.shapedDisk();
  features.ambient = c.ambientActive();
  prepareSkyLight(c);
  prepareLightStores(c);
  prepareSurfaceLights(c);
  features.surfaces = c.surfaces.count();
  features.several = c.volumes.count() + c.surfaces.count() > 1;
  c.recordVolumes.reserve(c.volumes.count());
  c.errorVolumes.reserve(c.volumes.count());
  c.recordSurfaces.reserve(c.surfaces.count());
  c.shadowCasters.reserve(c.volumes.count());
  for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
    ViewState* view = c.views.at(i);
    // Where there is no room for it, the view goes on as it is.
    const bool sharper = view != nullptr && nearSpace(c, *view) && !view->resources.space;
    if (view != nullptr && view->prepared) {
      // Another view's light may have made room for this one's since.
      chooseStores(c, *view, features);
      const ViewResources& r = view->resources;
      view->prepared = !(features.stores && !r.stores) && !(features.batches && !r.batches);
    }
    if (view == nullptr || (view->prepared && !sharper)) {
      continue;
    }
    c.retired.reserve(c.retired.size() + 1);
    view->plan.volumes.reserve(c.volumes.count());
    view->planVolumes.reserve(c.volumes.count());
    view->plan.surfaces.reserve(c.surfaces.count());
    view->planSurfaces.reserve(c.surfaces.count());
    view->record.passes.reserve(passRoom(c.volumes.count(), c.surfaces.count()));
    view->record.times.reserve(passRoom(c.volumes.count(), c.surfaces.count()));
    // prepareView swaps new resources in; the old ones wait for their frames. From there on
    // nothing may throw: nobody else owns what the carrier has.
    ViewState carrier(&c.memory);
    carrier.info = view->info;
    carrier.quality = view->quality;
    carrier.aerial = view->aerial;
    carrier.volumeDistance = view->volumeDistance;
    features.space = nearSpace(c, *view);
    chooseStores(c, *view, features);
    prepareView(device, *c.pipelines, carrier, c.volumes.count(), c.maxFramesInFlight, features,
                {fieldKinds.data(), kinds}, c.viewLights, &c.memory);
    c.retireView(*view);
    std::swap(view->resources, carrier.resources);
    view->prepared = true;
    ++prepared;
  }
  prepareShadowMaps(c, {fieldKinds.data(), kinds});
  c.collect();
  return prepared;
}

WlkResult wlkPrepare(WlkContext context) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    c.requireDevice("wlkPrepare");
    const auto start = std::chrono::steady_clock::now();
    uint32_t prepared = 0;
    try {
      prepared = prepareAll(c);
    } catch (const Failure& failure) {
      if (failure.result != WLK_ERROR_OUT_OF_DEVICE_MEMORY || !giveUpOld(c)) {
        throw;
      }
      prepared = prepareAll(c);
    }
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    c.emit(WLK_LOG_INFO, WLK_LOG_ID_PREPARED, "wlkPrepare: %u views made new, %.1f ms", prepared,
           time.count());
    return WLK_SUCCESS;
  });
}
