// SPDX-License-Identifier: MIT
// Frames: begin, uploads, headless rendering and read-back.
#include <cstring>
#include <utility>

#include "api/ambient_light.hpp"
#include "api/context.hpp"
#include "api/control.hpp"
#include "api/engine_image.hpp"
#include "api/leap_maps.hpp"
#include "api/light_shadow_input.hpp"
#include "api/light_stores.hpp"
#include "api/plan_input.hpp"
#include "api/sky_light.hpp"
#include "api/surface_data.hpp"
#include "api/volume_media.hpp"
#include "frame/light_store.hpp"

namespace {

using namespace welkin;

// Of a field's share in its volume's extinction, or of the turns that its depth leaves, beyond
// which an update does not wait for wlkPrepare: contents that flow must not have every frame make
// tables.
constexpr double SHARE_CHANGE = 0.05;

constexpr WlkVulkanImageState NOTHING{VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_2_NONE,
                                      VK_ACCESS_2_NONE};
constexpr WlkVulkanImageState TRANSFER_TARGET{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
                                              VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                              VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr WlkVulkanImageState TRANSFER_SOURCE{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0,
                                              VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                              VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr WlkVulkanImageState SAMPLED{
    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

void clearOnce(const vk::Dispatch& vk, VkCommandBuffer commands, vk::Image& image) {
  if (image.layout != VK_IMAGE_LAYOUT_UNDEFINED) {
    return;
  }
  imageBarrier(vk, commands, image.handle(), WHOLE_IMAGE, NOTHING, TRANSFER_TARGET);
  const VkClearColorValue zero{};
  const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vk.CmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &zero, 1,
                        &range);
  imageBarrier(vk, commands, image.handle(), WHOLE_IMAGE, TRANSFER_TARGET, SAMPLED);
  image.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}

bool partial(const VkBufferImageCopy& region, const vk::Image& image) {
  const VkExtent3D& a = region.imageExtent;
  const VkExtent3D& b = image.info().extent;
  return a.width != b.width || a.height != b.height || a.depth != b.depth;
}

void uploadTable(WlkContext_T& c, VkCommandBuffer commands, uint32_t layers,
                 ScatteringTable& table) {
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers};
  region.imageExtent = table.image.info().extent;
  copyInto(c.device->vk(), commands, table.staging, table.image, region, false);
  c.bytesUploaded += table.staging.size();
  ++c.updateCopies;
  Retired& entry = c.retired.emplace_back(&c.memory);
  entry.frame = c.frameIndex;
  entry.buffers[0] = std::move(table.staging);
}

void uploadSkyLight(WlkContext_T& c, VkCommandBuffer commands) {
  SkyLightState& light = c.skyLight;
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = light.moments.info().extent;
  copyInto(c.device->vk(), commands, light.staging, light.moments, region, false);
  if (light.fogStaged) {
    const VkExtent3D& size = region.imageExtent;
    region.bufferOffset = VkDeviceSize{4} * sizeof(float) * size.width * size.height;
    region.imageExtent = light.fog.info().extent;
    copyInto(c.device->vk(), commands, light.staging, light.fog, region, false);
    light.fogStaged = false;
    ++c.updateCopies;
  } else if (light.fog) {
    // The fog went before its table was ever written; descriptors name the image all the same.
    clearOnce(c.device->vk(), commands, light.fog);
  }
  light.now = light.staged;
  ++light.version;
  c.bytesUploaded += light.staging.size();
  ++c.updateCopies;
  Retired& entry = c.retired.emplace_back(&c.memory);
  entry.frame = c.frameIndex;
  entry.buffers[0] = std::move(light.staging);
}

TargetImage ownTarget(const vk::Image& image, const WlkVulkanImageState& before,
                      const WlkVulkanImageState& after) {
  TargetImage target;
  target.image = image.handle();
  target.view = image.view();
  target.before = before;
  target.after = after;
  return target;
}

// Copies host pixels into one of the view's own images; `offset` is its place in the upload buffer.
void uploadPixels(const vk::Dispatch& vk, VkCommandBuffer commands, ViewState& view,
                  const float* pixels, VkDeviceSize offset, VkDeviceSize bytes, vk::Image& image) {
  std::memcpy(static_cast<char*>(view.resources.upload.data()) + offset, pixels, bytes);
  VkBufferImageCopy region{};
  region.bufferOffset = offset;
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {view.info.width, view.info.height, 1};
  copyInto(vk, commands, view.resources.upload, image, region, false);
}

void readTarget(const vk::Dispatch& vk, VkCommandBuffer commands, const ViewState& view,
                const vk::Image& image, VkDeviceSize offset) {
  VkBufferImageCopy region{};
  region.bufferOffset = offset;
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {view.info.width, view.info.height, 1};
  vk.CmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          view.resources.readback.handle(), 1, &region);
}

void checkInputs(const ViewState& view, const WlkHeadlessInputs& inputs) {
  const uint64_t pixels = uint64_t{view.info.width} * view.info.height;
  if (inputs.color != nullptr) {
    checkRoom(inputs.sType, "colorSize", inputs.colorSize, 16 * pixels);
  }
  if (inputs.depth != nullptr) {
    checkRoom(inputs.sType, "depthSize", inputs.depthSize, 4 * pixels);
  }
}

void renderHeadless(WlkContext_T& c, ViewState& view, const WlkHeadlessInputs& inputs) {
  const vk::Dispatch& vk = c.device->vk();
  ViewTargets images;
  if (inputs.lightShadow != nullptr) {
    images.lightShadow = lightShadowOf(c, view, inputs.lightShadow);
    stageShadowDepth(c, view, inputs, inputs.lightShadow->cascadeCount);
  }
  VkCommandBuffer commands = c.headless->begin();
  ++c.frameIndex;  // what was refused is no frame
  recordUpdate(c, commands);
  ViewResources& r = view.resources;
  const VkDeviceSize pixels = VkDeviceSize{view.info.width} * view.info.height;
  if (inputs.lightShadow != nullptr) {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, r.shadowDepth.info().layers};
    region.imageExtent = r.shadowDepth.info().extent;
    copyInto(vk, commands, r.shadowUpload, r.shadowDepth, region, false);
    images.shadowMap = ownTarget(r.shadowDepth, SAMPLED, SAMPLED);
  }
  if (inputs.color != nullptr) {
    uploadPixels(vk, commands, view, inputs.color, 0, pixels * 16, r.color);
    images.colorInput = ownTarget(r.color, SAMPLED, SAMPLED);
  }
  if (inputs.depth != nullptr) {
    uploadPixels(vk, commands, view, inputs.depth, pixels * 16, pixels * 4, r.depth);
    images.depth = ownTarget(r.depth, SAMPLED, SAMPLED);
  }
  images.target0 = ownTarget(r.target0, NOTHING, TRANSFER_SOURCE);
  if (view.info.composite == WLK_COMPOSITE_SEPARATE) {
    images.target1 = ownTarget(r.target1, NOTHING, TRANSFER_SOURCE);
  }
  try {
    recordFrame(c, commands, view, images);
  } catch (...) {
    // The uploads are recorded and no longer pending: run them, so that nothing is lost.
    c.headless->submitAndWait();
    c.completedFrame = c.frameIndex;
    c.collect();
    throw;
  }
  readTarget(vk, commands, view, r.target0, 0);
  if (images.target1) {
    readTarget(vk, commands, view, r.target1, pixels * 16);
  }
  memoryBarrier(vk, commands, {VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
  r.rendered = false;
  c.headless->submitAndWait();
  r.rendered = true;
  c.completedFrame = c.frameIndex;
  c.collect();
}

// Once, until the map is of use.
void tellShadow(const WlkContext_T& c, ViewState& view, const ViewTargets& targets) {
  if (!targets.shadowMap) {
    return;
  }
  const bool unused = !view.plan.lightShadows;
  if (unused && !view.shadowUnused) {
    c.emit(
        WLK_LOG_WARNING, WLK_LOG_ID_SHADOW_MAP_UNUSED,
        "the shadow map of light %u shades nothing: no air or fog is drawn that this light is the "
        "one to light",
        targets.lightShadow.light);
  }
  view.shadowUnused = unused;
}

}  // namespace

namespace welkin {

void copyInto(const vk::Dispatch& vk, VkCommandBuffer commands, const vk::Buffer& from,
              vk::Image& image, const VkBufferImageCopy& region, bool clearFirst) {
  WlkVulkanImageState before = SAMPLED;
  before.layout = image.layout;
  if (image.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
    before = NOTHING;
  }
  imageBarrier(vk, commands, image.handle(), WHOLE_IMAGE, before, TRANSFER_TARGET);
  if (clearFirst && image.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
    const VkClearColorValue zero{};
    const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vk.CmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &zero, 1,
                          &range);
    imageBarrier(vk, commands, image.handle(), WHOLE_IMAGE, TRANSFER_TARGET, TRANSFER_TARGET);
  }
  vk.CmdCopyBufferToImage(commands, from.handle(), image.handle(),
                          VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  imageBarrier(vk, commands, image.handle(), WHOLE_IMAGE, TRANSFER_TARGET, SAMPLED);
  image.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}

void recordUpdate(WlkContext_T& c, VkCommandBuffer commands) {
  const vk::Dispatch& vk = c.device->vk();
  if (c.headless) {
    c.bytesUploaded = 0;
    c.updateCopies = 0;
    prepareSkyLight(c);
  } else {
    advanceSkyLight(c);
  }
  renewMedia(c, SHARE_CHANGE);
  // Room first: from the first command on nothing may throw.
  c.retired.reserve(c.retired.size() + c.pending.size() + 1 +
                    size_t{SCATTERING_FORMS} * c.volumes.count() + c.surfaces.count() + 2);
  clearOnce(vk, commands, c.dummy2d);
  clearOnce(vk, commands, c.dummy3d);
  clearOnce(vk, commands, c.dummyArray);
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    VolumeState* volume = c.volumes.at(i);
    if (volume == nullptr) {
      continue;
    }
    for (ScatteringTable& table : volume->tables) {
      if (table.staging) {
        uploadTable(c, commands, volume->tableLayers(), table);
      }
    }
  }
  if (c.skyLight.staging) {
    uploadSkyLight(c, commands);
  }
  for (PendingUpload& upload : c.pending) {
    VolumeState& volume = *c.volumes.find(upload.volumeId);
    ++volume.version;
    if (upload.field == LEAPS) {
      fillLeaps(volume, upload.staging);
    }
    vk::Image& image = upload.field == PAGES       ? volume.pages
                       : upload.field == LEAPS     ? volume.leaps
                       : upload.field == DIAMETERS ? volume.diameters
                                                   : volume.fields[upload.field].image;
    copyInto(vk, commands, upload.staging, image, upload.region, partial(upload.region, image));
    c.bytesUploaded += upload.staging.size();
    ++c.updateCopies;
    Retired& entry = c.retired.emplace_back(&c.memory);
    entry.frame = c.frameIndex;
    entry.buffers[0] = std::move(upload.staging);
  }
  c.pending.clear();
  uploadSurfaces(c, commands);
}

void recordFrame(WlkContext_T& c, VkCommandBuffer commands, ViewState& view,
                 const ViewTargets& targets) {
  beginControl(c, view);
  PlanInput input = planInput(c, view);
  input.shadowMap = targets.shadowMap && targets.lightShadow.cascades > 0;
  input.shadowLight = targets.lightShadow.light;
  // Headless and separate targets hold a result even when nothing is drawn; an engine's image that
  // is composited in place does not need one.
  input.mustWrite = view.info.composite == WLK_COMPOSITE_SEPARATE ||
                    (view.info.composite == WLK_COMPOSITE_COMPUTE && !targets.inputIsTarget);
  view.planVolumes.clear();
  c.recordVolumes.clear();
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    VolumeState* volume = c.volumes.at(i);
    if (volume == nullptr) {
      continue;
    }
    view.planVolumes.push_back(
        planVolume(c, i, static_cast<uint32_t>(c.recordVolumes.size()), *volume));
    RecordVolume record;
    record.state = volume;
    for (uint32_t f = 0; f < volume->fieldCount; ++f) {
      if (volume->fields[f].external) {
        record.externalViews[f] = importView(c, *volume->fields[f].external, VK_IMAGE_VIEW_TYPE_3D);
      }
    }
    record.store = findLightStore(*volume, input.quality);
    c.recordVolumes.push_back(record);
  }
  input.volumes = view.planVolumes;
  gatherSurfaces(c, view, input);
  makePlan(input, view.plan);
  controlPlan(c, view, input);
  planAmbient(c, view);
  tellShadow(c, view, targets);
  const PlanetFrame eye = planetFrameAt(input.planet, input.eye);
  chooseSkyTable(c.skyLight.now, input.planet.radius, eye, view.plan);

  RecordInput record;
  record.air = &c.air;
  record.sky = &c.skyLight;
  record.volumes = c.recordVolumes;
  record.surfaces = c.recordSurfaces;
  record.surfaceTables = &c.surfaceTables;
  record.dummy2d = c.dummy2d.view();
  record.dummy3d = c.dummy3d.view();
  record.dummyArray = c.dummyArray.view();
  record.frameIndex = c.frameIndex;
  record.slot = static_cast<uint32_t>(c.frameIndex % c.maxFramesInFlight);
  recordView(*c.device, *c.pipelines, commands, view, record, targets);
}

}  // namespace welkin

WlkResult wlkBeginFrame(WlkContext context, const WlkFrameInfo* frame) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const WlkFrameInfo f = copyStruct(frame, WLK_STRUCT_FRAME_INFO);
    checkNoChain(frame);
    c.requireDevice("wlkBeginFrame");
    if (c.mode != WLK_MODE_ENGINE_DEVICE) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context", "headless contexts begin their frames themselves");
    }
    if (f.frameIndex <= c.frameIndex) {
      fail(WLK_ERROR_INVALID_ARGUMENT, f.sType, "frameIndex",
           "WlkFrameInfo::frameIndex is %llu, the last frame was %llu",
           static_cast<unsigned long long>(f.frameIndex),
           static_cast<unsigned long long>(c.frameIndex));
    }
    if (f.completedFrameIndex < c.completedFrame || f.completedFrameIndex >= f.frameIndex) {
      fail(WLK_ERROR_INVALID_ARGUMENT, f.sType, "completedFrameIndex",
           "WlkFrameInfo::completedFrameIndex is %llu, expected [%llu, %llu)",
           static_cast<unsigned long long>(f.completedFrameIndex),
           static_cast<unsigned long long>(c.completedFrame),
           static_cast<unsigned long long>(f.frameIndex));
    }
    if (f.frameIndex - f.completedFrameIndex > c.maxFramesInFlight) {
      fail(WLK_ERROR_FRAMES_IN_FLIGHT, f.sType, "completedFrameIndex",
           "%llu frames would be in flight, maxFramesInFlight is %u",
           static_cast<unsigned long long>(f.frameIndex - f.completedFrameIndex),
           c.maxFramesInFlight);
    }
    c.frameIndex = f.frameIndex;
    c.completedFrame = f.completedFrameIndex;
    c.bytesUploaded = 0;
    c.updateCopies = 0;
    for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
      if (ViewState* view = c.views.at(i)) {
        c.harvest(*view);
      }
    }
    c.collect();
    return WLK_SUCCESS;
  });
}

WlkResult wlkRenderHeadless(WlkContext context, WlkView view, const WlkHeadlessInputs* inputs) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ViewState& state = c.view(view);
    WlkHeadlessInputs value{};
    if (inputs != nullptr) {
      value = copyStruct(inputs, WLK_STRUCT_HEADLESS_INPUTS);
      checkNoChain(inputs);
    }
    c.requireDevice("wlkRenderHeadless");
    if (!c.headless) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context", "wlkRenderHeadless needs a headless context");
    }
    if (!state.prepared) {
      fail(WLK_ERROR_NOT_PREPARED, 0, "view", "call wlkPrepare before rendering");
    }
    checkInputs(state, value);
    renderHeadless(c, state, value);
    return WLK_SUCCESS;
  });
}

WlkResult wlkReadback(WlkContext context, WlkView view, const WlkImageData* image) {
  return guarded([&]() -> WlkResult {
    WlkContext_T& c = checkContext(context);
    ViewState& state = c.view(view);
    const WlkImageData value = copyStruct(image, WLK_STRUCT_IMAGE_DATA);
    checkNoChain(image);
    c.requireDevice("wlkReadback");
    if (!c.headless) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context", "wlkReadback needs a headless context");
    }
    checkPointer(value.data, "data");
    const uint64_t bytes = uint64_t{state.info.width} * state.info.height * 16;
    if (value.dataSize < bytes) {
      fail(WLK_ERROR_INVALID_ARGUMENT, value.sType, "dataSize",
           "WlkImageData::dataSize is %llu, the image has %llu bytes",
           static_cast<unsigned long long>(value.dataSize), static_cast<unsigned long long>(bytes));
    }
    const bool separate = state.info.composite == WLK_COMPOSITE_SEPARATE;
    const bool fits =
        separate ? value.image == WLK_IMAGE_RADIANCE || value.image == WLK_IMAGE_TRANSMITTANCE
                 : value.image == WLK_IMAGE_COLOR;
    if (!fits) {
      fail(WLK_ERROR_INVALID_ARGUMENT, value.sType, "image",
           "WlkImageData::image is %u, which the view's composite mode does not write",
           value.image);
    }
    if (!state.resources.rendered || !state.prepared) {
      return WLK_NOT_READY;
    }
    const uint64_t offset = value.image == WLK_IMAGE_TRANSMITTANCE ? bytes : 0;
    std::memcpy(value.data, static_cast<const char*>(state.resources.readback.data()) + offset,
                bytes);
    return WLK_SUCCESS;
  });
}
