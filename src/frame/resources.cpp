// SPDX-License-Identifier: MIT
#include "frame/resources.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "failure.hpp"
#include "frame/aerial.hpp"
#include "frame/ambient.hpp"
#include "frame/ladder.hpp"
#include "frame/shadow_map_record.hpp"
#include "frame/surface_buffers.hpp"
#include "frame/surface_record.hpp"
#include "frame/transport_record.hpp"
#include "frame/uniforms.hpp"
#include "frame/view_shadow.hpp"

namespace welkin {
namespace {

using interface_::FrameUniforms;
using interface_::VolumeUniforms;

VkDeviceSize alignUp(VkDeviceSize x, VkDeviceSize alignment) {
  return (x + alignment - 1) / alignment * alignment;
}

// Owns a half-made ViewResources' Vulkan objects until it is complete.
class Draft {
 public:
  Draft(vk::Device& device, std::pmr::memory_resource* memory)
      : device_(device), resources(memory) {}
  ~Draft() { destroyObjects(device_, resources); }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  static void destroyObjects(vk::Device& device, ViewResources& r) {
    const vk::Dispatch& vk = device.vk();
    for (ViewSlot& slot : r.slots) {
      if (slot.queries != VK_NULL_HANDLE) {
        vk.DestroyQueryPool(device.handle(), slot.queries, nullptr);
        slot.queries = VK_NULL_HANDLE;
      }
    }
    if (r.pool != VK_NULL_HANDLE) {
      vk.DestroyDescriptorPool(device.handle(), r.pool, nullptr);
      r.pool = VK_NULL_HANDLE;
    }
    destroyShadowMap(device, r.shadow.resources);
  }

 private:
  vk::Device& device_;

 public:
  ViewResources resources;
};

// Of each volume sets of its light inside, of that of the sky there and of what pixels see, of the
// view those of the sky table and of the composite; the last of both kinds again for froxels. Of
// each surface SURFACE_PICTURES.
VkDescriptorPool makePool(const vk::Device& device, uint32_t slots, uint32_t volumes,
                          uint32_t surfaces, uint32_t lights, bool froxels) {
  // Of a surface's set: what is neither uniform nor image nor texels is a storage buffer.
  constexpr uint32_t SURFACE_IMAGES = 13;
  constexpr uint32_t SURFACE_STORES = 3;
  constexpr uint32_t SURFACE_TEXELS = 3;
  static_assert(SURFACE_IMAGES + SURFACE_TEXELS <= vk::MOST_SAMPLED);
  constexpr uint32_t SURFACE_BUFFERS =
      vk::SURFACE_BINDING_COUNT - 2 - SURFACE_IMAGES - SURFACE_STORES - SURFACE_TEXELS;
  const uint32_t more = froxels ? 1 : 0;
  const uint32_t spread = (lights - 1) * volumes;  // sets of further grids
  const uint32_t sets =
      slots * ((3 + more) * volumes + spread + SURFACE_PICTURES * surfaces + 3 + more);
  const std::array sizes{
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                           slots * ((6 + 2 * more) * volumes + 2 * spread +
                                    2 * SURFACE_PICTURES * surfaces + 3 + more)},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                           slots * ((10 + 4 * more) * volumes + 4 * spread +
                                    SURFACE_BUFFERS * SURFACE_PICTURES * surfaces + 5 + 4 * more)},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                           slots * ((3 + more) * volumes + spread +
                                    SURFACE_STORES * SURFACE_PICTURES * surfaces + 5 + 2 * more)},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           slots * ((24 + 14 * more) * volumes + 5 * spread +
                                    SURFACE_IMAGES * SURFACE_PICTURES * surfaces + 10 + 8 * more)},
      VkDescriptorPoolSize{
          VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
          slots * ((1 + more) * (volumes + 1) + SURFACE_TEXELS * SURFACE_PICTURES * surfaces)}};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = sets;
  info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  vk::check(device.vk().CreateDescriptorPool(device.handle(), &info, nullptr, &pool),
            "vkCreateDescriptorPool");
  return pool;
}

VkDescriptorSet makeSet(const vk::Device& device, VkDescriptorPool pool,
                        VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  vk::check(device.vk().AllocateDescriptorSets(device.handle(), &info, &set),
            "vkAllocateDescriptorSets");
  return set;
}

void makeSlots(vk::Device& device, const vk::Pipelines& pipelines, ViewResources& r,
               uint32_t framesInFlight, std::pmr::memory_resource* memory) {
  const bool froxels = static_cast<bool>(r.aerial.uniforms);
  r.pool = makePool(device, framesInFlight, r.volumeCapacity, r.surfaceCapacity, r.transportLights,
                    froxels);
  r.slots.reserve(framesInFlight);
  for (uint32_t i = 0; i < framesInFlight; ++i) {
    ViewSlot& slot = r.slots.emplace_back(memory);
    slot.composite.set = makeSet(device, r.pool, pipelines.compositeSetLayout());
    slot.distance.set = makeSet(device, r.pool, pipelines.distanceSetLayout());
    slot.skyTable.set = makeSet(device, r.pool, pipelines.skySetLayout());
    slot.volumes.resize(r.volumeCapacity);
    for (BoundSet& set : slot.volumes) {
      set.set = makeSet(device, r.pool, pipelines.volumeSetLayout());
    }
    if (froxels) {
      slot.aerial.set = makeSet(device, r.pool, pipelines.compositeSetLayout());
      slot.froxels.resize(r.volumeCapacity);
    }
    for (BoundSet& set : slot.froxels) {
      set.set = makeSet(device, r.pool, pipelines.volumeSetLayout());
    }
    slot.transport.resize(r.volumeLights.size() * r.transportLights);
    for (BoundSet& set : slot.transport) {
      set.set = makeSet(device, r.pool, pipelines.transportSetLayout());
    }
    slot.ambient.resize(r.ambientGrids.size());
    for (BoundSet& set : slot.ambient) {
      set.set = makeSet(device, r.pool, pipelines.ambientSetLayout());
    }
    slot.surfaces.resize(size_t{SURFACE_PICTURES} * r.surfaceCapacity);
    for (BoundSet& set : slot.surfaces) {
      set.set = makeSet(device, r.pool, pipelines.surfaceSetLayout());
    }
    slot.passOfQuery.reserve(r.queryCount);
    slot.passes.reserve(passRoom(r.volumeCapacity, r.surfaceCapacity));
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = r.queryCount;
    vk::check(device.vk().CreateQueryPool(device.handle(), &info, nullptr, &slot.queries),
              "vkCreateQueryPool");
  }
}

vk::Image makeTarget(vk::Device& device, uint32_t width, uint32_t height, VkFormat format) {
  vk::ImageInfo info;
  info.format = format;
  info.extent = {width, height, 1};
  info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
               VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return vk::Image(device, info);
}

void makeSkyTables(vk::Device& device, const SceneFeatures& features, ViewResources& r) {
  vk::ImageInfo info;
  info.type = VK_IMAGE_TYPE_3D;
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  info.extent = {interface_::SKY_AZIMUTHS * features.lights, interface_::SKY_ZENITHS,
                 interface_::SKY_SHARES};
  info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  r.skyTable = vk::Image(device, info);
  if (features.fog) {
    info.extent.depth = 2 * interface_::SKY_SHARES;  // see sky_lookup.glsl
    r.skyPeak = vk::Image(device, info);
  }
}

void checkCells(const vk::Device& device, VkDeviceSize bytes, uint32_t cells) {
  if (bytes > device.properties().limits.maxStorageBufferRange) {
    fail(WLK_ERROR_LIMIT_EXCEEDED, WLK_STRUCT_QUALITY, "volumeCells",
         "%u^3 cells of light exceed the device's storage buffers", cells);
  }
}

void makeTransport(vk::Device& device, const SliceQuality& quality, uint32_t volumes,
                   SharedLights<VolumeLight>& lights, ViewResources& r) {
  const TransportSizes sizes =
      transportSizes({quality.transportCells, quality.transportCells, quality.transportCells});
  checkCells(device, std::max({sizes.workBytes, sizes.sweptBytes, sizes.keptBytes}),
             quality.transportCells);
  const auto list = [&](VkDeviceSize bytes) {
    return vk::Buffer(device, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, false);
  };
  const auto work = [&] { return TransportWork{list(sizes.workBytes), list(sizes.sweptBytes)}; };
  const bool spread = r.transportLights > 1;
  if (!spread) {
    r.transportWork = work();
  }
  constexpr size_t KEY = sizeof(interface_::TransportUniforms) + TRANSPORT_IDS;
  for (uint32_t v = 0; v < volumes; ++v) {
    const LightShape shape{v, quality.transportCells, quality.lightFrames};
    r.volumeLights.push_back(lights.of(shape, [&] {
      VolumeLight light;
      if (spread) {
        light.work = work();
      }
      for (uint32_t i = 0; i < r.transportLights; ++i) {
        light.grids[i].kept = list(sizes.keptBytes);
        light.grids[i].key.reserve(KEY);
      }
      light.key.reserve(KEY);
      return light;
    }));
  }
  vk::ImageInfo info;
  info.type = VK_IMAGE_TYPE_3D;
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  const uint32_t edge = transportImageEdge(quality.transportCells);
  info.extent = {edge, edge, 2 * edge};  // light that goes with pairShape, and the rest
  info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  r.viewSource = vk::Image(device, info);
}

void makeAmbient(vk::Device& device, const SliceQuality& quality, uint32_t volumes,
                 SharedLights<AmbientGrid>& lights, ViewResources& r) {
  const uint32_t cells = quality.ambientCells;
  const AmbientSizes sizes = ambientSizes({cells, cells, cells});
  checkCells(device, std::max(sizes.workBytes, sizes.keptBytes), cells);
  r.ambientWork = vk::Buffer(device, sizes.workBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, false);
  for (uint32_t v = 0; v < volumes; ++v) {
    // Beside the sun's light of all orders it holds other orders than alone.
    r.ambientGrids.push_back(lights.of({v, cells, quality.transport ? 1U : 0U}, [&] {
      AmbientGrid light;
      light.grid.kept =
          vk::Buffer(device, sizes.keptBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, false);
      light.grid.key.reserve(sizeof(interface_::AmbientUniforms) + AMBIENT_IDS * sizeof(uint64_t));
      return light;
    }));
  }
  vk::ImageInfo info;
  info.type = VK_IMAGE_TYPE_3D;
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  const uint32_t edge = transportImageEdge(cells);
  info.extent = {edge, edge, edge};
  info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  r.viewAmbient = vk::Image(device, info);
}

// Of the buffer of every second pixel and of the lists (shaders/interface/slices.glsl), on which
// three pixels of four may be, and every tile.
VkDeviceSize secondsBytes(const WlkViewInfo& info) {
  constexpr uint32_t EDGE = interface_::TILE_SECONDS;
  const uint32_t columns = info.width / 2 + 2;
  const uint32_t rows = info.height / 2 + 2;
  const VkDeviceSize tiles = VkDeviceSize{(columns + EDGE - 1) / EDGE} * ((rows + EDGE - 1) / EDGE);
  return 4 * (interface_::LIST_HEAD + interface_::TILE_WORDS * tiles +
              VkDeviceSize{interface_::SECOND_SIZE + interface_::LIST_MOST} * columns * rows);
}

void makeHeadlessTargets(vk::Device& device, const WlkViewInfo& info, ViewResources& r) {
  const VkFormat format = targetFormat(info.targetFormat);
  r.depth = makeTarget(device, info.width, info.height, VK_FORMAT_R32_SFLOAT);
  r.color = makeTarget(device, info.width, info.height, VK_FORMAT_R32G32B32A32_SFLOAT);
  r.target0 = makeTarget(device, info.width, info.height, format);
  if (info.composite == WLK_COMPOSITE_SEPARATE) {
    r.target1 = makeTarget(device, info.width, info.height, format);
  }
  const VkDeviceSize pixels = VkDeviceSize{info.width} * info.height;
  r.upload = vk::Buffer(device, pixels * 20, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
  r.readback = vk::Buffer(device, pixels * 32, VK_BUFFER_USAGE_TRANSFER_DST_BIT, true);
}

constexpr uint32_t CURVE_POINTS = kCurveNodes;
constexpr VkDeviceSize LAYER_BYTES = sizeof(float) * 4 * CURVE_POINTS * DEPTH_NODES;

// A field's layer: RGBA float, depth along x, angle along y.
void fillLayer(const SourceRows& rows, char* layer,
               std::array<float, DEPTH_NODES>& forwardFraction) {
  constexpr size_t DEPTHS = DEPTH_NODES;
  for (size_t depth = 0; depth < DEPTHS; ++depth) {
    for (size_t i = 0; i < CURVE_POINTS; ++i) {
      float texel[4] = {};
      for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
        texel[c] = rows.logSource[(c * DEPTHS + depth) * rows.angles + i];
      }
      std::memcpy(layer + (i * DEPTHS + depth) * sizeof texel, texel, sizeof texel);
    }
    forwardFraction[depth] = (rows.forwardFraction[0][depth] + rows.forwardFraction[1][depth] +
                              rows.forwardFraction[2][depth]) /
                             3.0f;
  }
}

}  // namespace

VkFormat targetFormat(uint32_t welkinFormat) {
  switch (welkinFormat) {
    case WLK_TARGET_RGBA32_FLOAT:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case WLK_TARGET_B10G11R11_FLOAT:
      return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    default:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
  }
}

void prepareView(vk::Device& device, vk::Pipelines& pipelines, ViewState& view,
                 uint32_t volumeCount, uint32_t framesInFlight, const SceneFeatures& features,
                 std::span<const uint32_t> fieldKinds, ViewLights& lights,
                 std::pmr::memory_resource* memory) {
  const SliceQuality quality = roomFor(view.quality);
  const WlkViewInfo& info = view.info;
  preparePipelines(pipelines, view, features, fieldKinds);

  Draft draft(device, memory);
  ViewResources& r = draft.resources;
  r.volumeCapacity = volumeCount;
  r.space = features.space;
  r.lights = features.lights;
  const VkDeviceSize alignment =
      std::max<VkDeviceSize>(device.properties().limits.minUniformBufferOffsetAlignment, 16);
  r.volumeStride = alignUp(sizeof(VolumeUniforms), alignment);
  const VkDeviceSize counterStride =
      std::max<VkDeviceSize>(device.properties().limits.minStorageBufferOffsetAlignment, 16);
  const VkDeviceSize both = std::max(alignment, counterStride);  // powers of two
  r.fogOffset = alignUp(sizeof(FrameUniforms), both);
  r.transportStride =
      quality.transport ? alignUp(sizeof(interface_::TransportUniforms), alignment) : 0;
  r.transportOffset = alignUp(r.fogOffset + FOG_CURVE_BYTES, both);
  const bool ambient = features.ambient && quality.ambientCells > 0;
  r.ambientStride = ambient ? alignUp(sizeof(interface_::AmbientUniforms), alignment) : 0;
  r.surfaceStride = alignUp(sizeof(interface_::SurfaceUniforms), alignment);
  r.transportLights = quality.transport && quality.lightFrames > 1 ? SPREAD_LIGHTS : 1;
  const uint32_t grids = volumeCount * r.transportLights;
  r.surfaceOffset = alignUp(r.transportOffset + grids * r.transportStride, both);
  r.ambientOffset = alignUp(
      r.surfaceOffset + VkDeviceSize{SURFACE_PICTURES} * features.surfaces * r.surfaceStride, both);
  r.slotStride = r.ambientOffset + alignUp(volumeCount * (r.ambientStride + r.volumeStride), both);
  r.uniforms =
      vk::Buffer(device, r.slotStride * framesInFlight,
                 VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, true);
  r.counters =
      vk::Buffer(device, counterStride * framesInFlight,
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, true);
  const uint32_t batches = (quality.sliceCount + quality.batchSize - 1) / quality.batchSize;
  // Volumes not in every pixel take seven commands instead of one.
  r.queryCount =
      6 + SURFACE_DISPATCHES * features.surfaces +
      volumeCount * ((view.aerial ? 3 : 2) * batches + 3 + (quality.halfVolumes ? 6 : 0));
  const VkDeviceSize pixels = VkDeviceSize{info.width} * info.height;
  const uint32_t layers = volumeCount + features.surfaces;
  const VkDeviceSize stateBytes = layers > 0 ? pixels * 16 : 16;
  constexpr VkDeviceSize NO_PIXELS_ROW = 16;  // surface_shade.comp
  r.frameState = vk::Buffer(device, stateBytes + NO_PIXELS_ROW, vk::ROWS, false);
  if (view.volumeDistance) {
    r.distances = vk::Buffer(device, stateBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, false);
  }
  r.stores = features.stores;
  r.batches = features.batches;
  const bool seconds = quality.halfVolumes && features.stores && volumeCount > 0;
  if ((layers > 1 && volumeCount > 0 && batches > 1 && features.batches) || seconds) {
    const VkDeviceSize bytes = seconds ? std::max(secondsBytes(info), stateBytes) : stateBytes;
    r.volumeState =
        vk::Buffer(device, bytes, vk::ROWS | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, false);
  }
  makeSurfaces(device, info, quality, features.surfaces, r);
  if (volumeCount > 0) {
    if (pixels * 16 > device.properties().limits.maxStorageBufferRange) {
      fail(WLK_ERROR_LIMIT_EXCEEDED, WLK_STRUCT_VIEW_INFO, "width",
           "%u x %u pixels with volumes exceed the device's storage buffers", info.width,
           info.height);
    }
    if (features.batches) {
      const uint32_t most = device.properties().limits.maxImageDimension3D;
      if (std::max(quality.lightSize, quality.batchSize + 1) > most) {
        fail(WLK_ERROR_LIMIT_EXCEEDED, WLK_STRUCT_QUALITY, "batchSize",
             "%u texels and batches of %u slabs exceed the device's largest 3-D image, %u",
             quality.lightSize, quality.batchSize, most);
      }
      vk::ImageInfo light;
      light.type = VK_IMAGE_TYPE_3D;
      light.format = VK_FORMAT_R32G32_SFLOAT;
      light.extent = {quality.lightSize, quality.lightSize, quality.batchSize + 1};
      light.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
      r.lightBuffer = vk::Image(device, light);
    }
    if (quality.transport) {
      makeTransport(device, quality, volumeCount, lights.sun, r);
    }
    if (ambient) {
      makeAmbient(device, quality, volumeCount, lights.ambient, r);
    }
    if (quality.volumeShadows) {
      makeViewShadow(device, pipelines, volumeCount, framesInFlight, fieldKinds, r);
    }
  }
  if (quality.multipleSky && (features.sky || features.fog)) {
    makeSkyTables(device, features, r);
  }
  if (view.aerial) {
    makeAerial(device, *view.aerial, framesInFlight,
               volumeCount > 1 && batches > 1 && features.batches, r);
  }
  if (device.info().headless) {
    makeHeadlessTargets(device, info, r);
  }
  makeSlots(device, pipelines, r, framesInFlight, memory);
  std::swap(view.resources, r);
  view.prepared = true;
}

void destroyView(vk::Device& device, ViewState& view) {
  Draft::destroyObjects(device, view.resources);
}

vk::Buffer replaceMedia(vk::Device& device, VolumeState& volume) {
  auto media = std::make_shared<const TransportMedia>(transportMedia(volume));
  vk::Buffer table(device, media->response.size() * sizeof(float),
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, true);
  std::memcpy(table.data(), media->response.data(), media->response.size() * sizeof(float));
  std::swap(volume.pairTable, table);
  volume.transport = std::move(media);
  return table;
}

void prepareMedia(vk::Device& device, VolumeState& volume) {
  if (!volume.transport) {
    replaceMedia(device, volume);
  }
}

void prepareVolume(vk::Device& device, VolumeState& volume, uint32_t form) {
  if (form == 2) {
    prepareMedia(device, volume);
  }
  ScatteringTable& table = volume.tables[form];
  if (table.image) {
    return;
  }
  vk::ImageInfo info;
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  info.extent = {static_cast<uint32_t>(DEPTH_NODES), CURVE_POINTS, 1};
  info.layers = volume.tableLayers();
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.arrayView = true;
  ScatteringTable made;
  made.image = vk::Image(device, info);
  made.staging =
      vk::Buffer(device, LAYER_BYTES * info.layers, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
  auto* layers = static_cast<char*>(made.staging.data());
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    uint32_t twin = 0;
    while (volume.fields[twin].tables != volume.fields[i].tables) {
      ++twin;
    }
    if (twin < i) {
      std::memcpy(layers + i * LAYER_BYTES, layers + twin * LAYER_BYTES, LAYER_BYTES);
      made.forwardFraction[i] = made.forwardFraction[twin];
    } else {
      const FieldState& field = volume.fields[i];
      fillLayer(field.tables->own.rows(*field.medium.particle, form), layers + i * LAYER_BYTES,
                made.forwardFraction[i]);
    }
  }
  // Light marches by the medium's own forward part.
  std::array<float, DEPTH_NODES> unused{};
  for (uint32_t i = volume.fieldCount; i < info.layers; ++i) {
    const size_t node = i - volume.fieldCount;
    ParticleTables& tables = volume.fields[volume.diameterField].tables->nodes[node];
    fillLayer(tables.rows(volume.diameterNodes->particles[node], form), layers + i * LAYER_BYTES,
              unused);
  }
  table = std::move(made);
}

}  // namespace welkin
