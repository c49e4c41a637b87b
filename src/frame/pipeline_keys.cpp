// SPDX-License-Identifier: MIT
// Which pipelines the passes of a view need: by the state that a plan asks for, and all of them
// that frames may ask for.
#include "frame/resources.hpp"

namespace welkin {

vk::PipelineKey lightKey(const LightVariant& v, uint32_t fields) {
  return ofFields({v.stored && !v.forward ? vk::Pass::LightDepth : vk::Pass::LightSlices,
                   VK_FORMAT_UNDEFINED,
                   {0, 0, 1, 0, v.forward}},
                  fields);
}

bool leapsIn(uint32_t fields, const SliceQuality& quality) {
  return (fields & VolumeState::LEAPING) != 0 && !quality.noSkip;
}

vk::PipelineKey eyeKey(const EyeVariant& v, uint32_t fields, const SliceQuality& quality) {
  vk::PipelineKey key =
      ofFields({v.stored ? vk::Pass::EyeMarch : vk::Pass::EyeSlices,
                VK_FORMAT_UNDEFINED,
                {v.air, v.fog, v.light, 0, quality.forwardScattering, v.depth, v.allLight,
                 quality.transport && v.light, quality.multipleSky, v.ambient}},
               fields);
  key.constants[10] = v.stored && (fields & VolumeState::GREY) != 0 ? 1 : 0;
  key.constants[12] = v.stored && leapsIn(fields, quality) ? 1 : 0;
  key.constants[13] = v.rays;
  key.constants[14] = v.distance;
  key.constants[15] = fields / VolumeState::VARYING;
  return key;
}

vk::PipelineKey spreadKey(uint32_t to, const SpreadVariant& v) {
  vk::PipelineKey key{vk::Pass::EyeSpread, VK_FORMAT_UNDEFINED, {}};
  key.constants[5] = v.depth;
  // Second pixels are of one volume.
  key.constants[9] = v.behind && to == interface_::SPREAD_TO_PIXELS;
  key.constants[12] = v.tiles;
  key.constants[13] = to;
  key.constants[14] = v.distance;
  return key;
}

vk::PipelineKey tilesKey() {
  return {vk::Pass::EyeTiles, VK_FORMAT_UNDEFINED, {}};
}

vk::PipelineKey clearKey(bool distance) {
  vk::PipelineKey key{vk::Pass::EyeClear, VK_FORMAT_UNDEFINED, {}};
  key.constants[14] = distance;
  return key;
}

vk::PipelineKey surfaceEndsKey(bool depth) {
  vk::PipelineKey key{vk::Pass::SurfaceEnds, VK_FORMAT_UNDEFINED, {}};
  key.constants[5] = depth;
  return key;
}

static vk::PipelineKey trianglesKey(vk::Pass pass, bool large) {
  vk::PipelineKey key{pass, VK_FORMAT_UNDEFINED, {}};
  key.constants[6] = large;
  return key;
}

vk::PipelineKey surfaceCoverKey(bool ends, bool large) {
  vk::PipelineKey key = trianglesKey(vk::Pass::SurfaceCover, large);
  key.constants[5] = ends;
  return key;
}

vk::PipelineKey surfaceFacesKey(bool large) {
  return trianglesKey(vk::Pass::SurfaceFaces, large);
}

vk::PipelineKey surfaceCellsKey(bool large) {
  return trianglesKey(vk::Pass::SurfaceCells, large);
}

vk::PipelineKey surfaceShellKey(bool means) {
  vk::PipelineKey key{vk::Pass::SurfaceShell, VK_FORMAT_UNDEFINED, {}};
  key.constants[3] = means;
  return key;
}

vk::PipelineKey surfaceMapKey(bool fromLevel, bool detail) {
  vk::PipelineKey key{vk::Pass::SurfaceMap, VK_FORMAT_UNDEFINED, {}};
  key.constants[3] = fromLevel;
  key.constants[7] = detail;
  return key;
}

vk::PipelineKey surfaceListKey(bool distance, bool half) {
  vk::PipelineKey key{vk::Pass::SurfaceList, VK_FORMAT_UNDEFINED, {}};
  key.constants[13] = half;
  key.constants[14] = distance;
  return key;
}

vk::PipelineKey surfaceScatterKey(bool half) {
  vk::PipelineKey key{vk::Pass::SurfaceScatter, VK_FORMAT_UNDEFINED, {}};
  key.constants[13] = half;
  return key;
}

vk::PipelineKey surfaceShadeKey(const SurfaceVariant& v, const SliceQuality& quality) {
  vk::PipelineKey key{vk::Pass::SurfaceShade, VK_FORMAT_UNDEFINED, {v.air, v.fog, v.light}};
  key.constants[6] = v.allLight;
  key.constants[7] = v.detail;
  key.constants[8] = quality.multipleSky;
  key.constants[9] = v.ambient;
  key.constants[13] = quality.halfVolumes;
  key.constants[14] = v.distance;
  return key;
}

vk::PipelineKey distanceKey() {
  return {vk::Pass::VolumeDistance, VK_FORMAT_UNDEFINED, {}};
}

vk::PipelineKey transportKey(vk::Pass pass, uint32_t fields) {
  const bool reads = pass == vk::Pass::TransportDepth || pass == vk::Pass::TransportCells;
  const vk::PipelineKey key{pass, VK_FORMAT_UNDEFINED, {}};
  return reads ? ofFields(key, fields) : key;
}

vk::PipelineKey ambientKey(vk::Pass pass, uint32_t fields) {
  const vk::PipelineKey key{pass, VK_FORMAT_UNDEFINED, {}};
  return pass == vk::Pass::AmbientCells ? ofFields(key, fields) : key;
}

vk::PipelineKey skyTableKey(uint32_t air, bool fog, uint32_t lights, bool allLight) {
  return {vk::Pass::SkyTable, VK_FORMAT_UNDEFINED, {air, fog, lights, allLight}};
}

// What the composite and the froxels share.
static vk::PipelineKey layerKey(const CompositeVariant& v) {
  vk::PipelineKey key;
  key.constants = {v.air, v.fog, v.lights, v.volumes, v.depth, v.lights > 0 ? v.disk : 0, v.ground};
  key.constants[9] = v.multiple && v.lights > 0 && (v.air > 0 || v.fog);
  key.constants[10] = v.space && key.constants[9] != 0;
  key.constants[11] = v.allLight && key.constants[9] != 0;
  key.constants[12] = v.lights > 0 && (v.air > 0 || v.fog) ? v.shadows : 0;
  return key;
}

vk::PipelineKey aerialKey(CompositeVariant v) {
  // Every ray ends at its froxel: nothing of the sky behind is seen.
  v.depth = v.ground = false;
  v.disk = 0;
  vk::PipelineKey key = layerKey(v);
  key.pass = vk::Pass::Aerial;
  return key;
}

vk::PipelineKey compositeKey(const WlkViewInfo& info, const CompositeVariant& v) {
  vk::PipelineKey key = layerKey(v);
  if (info.composite == WLK_COMPOSITE_BLEND) {
    key.pass = vk::Pass::CompositeBlend;
    key.format = targetFormat(info.targetFormat);
    key.constants[vk::BLEND_TILES] = v.tiles;
  } else {
    key.pass = vk::Pass::Composite;
    key.constants[7] = info.composite == WLK_COMPOSITE_SEPARATE;
    key.constants[8] = info.targetFormat == WLK_TARGET_RGBA16_FLOAT;
  }
  return key;
}

static void prepareSurfaces(vk::Pipelines& pipelines, const ViewState& view,
                            const SliceQuality& quality, const SurfaceVariant& usual) {
  pipelines.prepare(surfaceScatterKey(quality.halfVolumes));
  pipelines.prepare(surfaceMapKey(true, false));
  for (const bool either : {false, true}) {
    pipelines.prepare(surfaceEndsKey(either));
    for (const bool large : {false, true}) {
      pipelines.prepare(surfaceCoverKey(either, large));
    }
    pipelines.prepare(surfaceFacesKey(either));
    pipelines.prepare(surfaceCellsKey(either));
    pipelines.prepare(surfaceMapKey(false, either));
    pipelines.prepare(surfaceShellKey(either));
  }
  for (const bool distance : {false, view.volumeDistance}) {
    pipelines.prepare(surfaceListKey(distance, quality.halfVolumes));
    for (const bool light : {false, usual.light}) {
      for (const bool all : {false, light && usual.air > 0 && !usual.fog && quality.multipleSky}) {
        for (const bool ambient : {false, usual.ambient}) {
          // Detail comes and goes without another wlkPrepare.
          for (const bool detail : {false, true}) {
            pipelines.prepare(surfaceShadeKey(
                {usual.air, usual.fog, light, all, distance, ambient, detail}, quality));
          }
        }
      }
    }
  }
}

static void prepareSpreads(vk::Pipelines& pipelines, const SpreadVariant& v) {
  for (const uint32_t to : SPREADS) {
    pipelines.prepare(spreadKey(to, v));
  }
  if (v.tiles) {
    pipelines.prepare(tilesKey());
    pipelines.prepare(clearKey(v.distance));
  }
}

void preparePipelines(vk::Pipelines& pipelines, const ViewState& view,
                      const SceneFeatures& features, std::span<const uint32_t> fieldKinds) {
  // Every state the frame may find the scene in without another wlkPrepare: light above or below
  // the horizon, something opaque or not, volumes in view or not.
  const SliceQuality quality = resolveQuality(view.quality);
  const bool sky = features.sky && (view.info.layers & WLK_LAYER_SKY) != 0;
  const uint32_t air = sky ? (features.absorber ? 2 : 1) : 0;
  const bool fog = features.fog && (view.info.layers & WLK_LAYER_FOG) != 0;
  const bool tiles = features.stores && quality.halfVolumes &&
                     view.info.composite == WLK_COMPOSITE_BLEND &&
                     std::any_of(fieldKinds.begin(), fieldKinds.end(),
                                 [&](uint32_t fields) { return leapsIn(fields, quality); });
  if (features.surfaces > 0) {
    const bool ambient = features.ambient && quality.ambientCells > 0;
    prepareSurfaces(pipelines, view, quality,
                    {air, fog, features.lights > 0, false, false, ambient, false});
  }
  for (uint32_t lights = 0; lights <= features.lights; ++lights) {
    for (const bool depth : {false, true}) {
      for (const uint32_t fields : fieldKinds) {
        for (const bool stored : {false, true}) {
          if (!(stored ? features.stores : features.batches)) {
            continue;
          }
          const bool open = lights > 0 && sky && !fog && quality.multipleSky;
          // Light of sky and ground may be found to be dark with every other state.
          for (const bool ambient : {false, features.ambient && quality.ambientCells > 0}) {
            for (const bool all : {false, open}) {
              EyeVariant v{air, fog, lights > 0, depth, all, stored, ambient};
              for (const bool distance : {false, view.volumeDistance}) {
                v.distance = distance;
                if (stored && quality.halfVolumes) {
                  v.rays = interface_::RAYS_OF_GRID;
                  pipelines.prepare(eyeKey(v, fields, quality));
                  v.rays = interface_::RAYS_OF_LIST;
                  pipelines.prepare(eyeKey(v, fields, quality));
                  for (const bool behind : {false, features.several}) {
                    prepareSpreads(pipelines, {depth, distance, behind, leapsIn(fields, quality)});
                  }
                } else {
                  v.rays = interface_::RAYS_OF_PIXELS;
                  pipelines.prepare(eyeKey(v, fields, quality));
                }
              }
              v.distance = false;
              v.rays = interface_::RAYS_OF_FROXELS;
              if (view.aerial && !depth) {
                pipelines.prepare(eyeKey(v, fields, quality));
              }
            }
          }
        }
      }
      CompositeVariant v{};
      v.air = air;
      v.fog = fog;
      v.lights = lights;
      v.volumes = !fieldKinds.empty() || features.surfaces > 0;
      v.depth = depth;
      if (sky && (view.info.layers & WLK_LAYER_SUN_DISK) != 0) {
        v.disk = features.shapedDisk ? 2 : 1;
      }
      v.ground = sky && (view.info.layers & WLK_LAYER_GROUND) != 0;
      v.multiple = quality.multipleSky && lights > 0;
      const bool open = v.multiple && sky && !fog;
      const auto prepare = [&] {
        for (const bool some : {false, tiles && !sky && !fog}) {
          v.tiles = some;
          pipelines.prepare(compositeKey(view.info, v));
        }
        v.tiles = false;
        if (view.aerial) {
          pipelines.prepare(aerialKey(v));
        }
      };
      const uint32_t kinds = (quality.volumeShadows && v.volumes && lights > 0 ? 1U : 0U) |
                             (quality.lightShadows && lights > 0 ? 2U : 0U);
      for (uint32_t shadows = 0; shadows <= kinds; ++shadows) {
        v.shadows = shadows & kinds;
        v.space = v.allLight = false;
        prepare();
        v.space = v.multiple && features.space;
        prepare();
        v.space = false;
        v.allLight = open;
        prepare();
      }
    }
  }
  if (view.volumeDistance) {
    pipelines.prepare(distanceKey());
  }
  for (uint32_t lights = 1; lights <= features.lights; ++lights) {
    if (quality.multipleSky && (sky || fog)) {
      pipelines.prepare(skyTableKey(air, fog, lights, false));
      if (!fog) {
        pipelines.prepare(skyTableKey(air, fog, lights, true));
      }
    }
  }
  for (const uint32_t fields : fieldKinds) {
    for (const bool stored : {false, true}) {
      if (stored ? features.stores : features.batches) {
        pipelines.prepare(lightKey({quality.forwardScattering, stored}, fields));
      }
    }
    if (quality.transport) {
      for (const vk::Pass pass : TRANSPORT_PASSES) {
        pipelines.prepare(transportKey(pass, fields));
      }
    }
    for (const vk::Pass pass : AMBIENT_PASSES) {
      if (features.ambient && quality.ambientCells > 0) {
        pipelines.prepare(ambientKey(pass, fields));
      }
    }
  }
}

}  // namespace welkin
