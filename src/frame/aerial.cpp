// SPDX-License-Identifier: MIT
#include "frame/aerial.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "failure.hpp"
#include "frame/composite_record.hpp"
#include "frame/resources.hpp"
#include "frame/sky_bindings.hpp"

namespace welkin {
namespace {

using interface_::FrameUniforms;

// Distances in float and in double, on both sides of a comparison.
constexpr double ROUNDING = 1e-5;

double sliceDistance(const WlkAerialPerspective& info, uint32_t slice) {
  const double share = slice / (info.depth - 1.0);
  return static_cast<double>(info.distance) * std::pow(share, static_cast<double>(info.exponent));
}

// Slices between the nearest point of all volumes drawn and their farthest; that one, too, is
// behind which nothing changes. Empty if none reaches a volume.
void findSlices(const Plan& plan, const WlkAerialPerspective& info, AerialPass& pass) {
  pass.firstSlice = pass.endSlice = 0;
  if (plan.drawnCount == 0) {
    return;
  }
  pass.endSlice = info.depth;
  if (plan.quality.noSkip) {
    return;
  }
  double nearest = 1e300;
  double farthest = 0;
  for (uint32_t i = 0; i < plan.drawnCount; ++i) {
    nearest = std::min(nearest, plan.volumes[i].distance);
    farthest = std::max(farthest, plan.volumes[i].farthest);
  }
  while (pass.firstSlice < info.depth &&
         sliceDistance(info, pass.firstSlice) <= nearest * (1 - ROUNDING)) {
    ++pass.firstSlice;
  }
  while (pass.endSlice > pass.firstSlice + 1 &&
         sliceDistance(info, pass.endSlice - 2) >= farthest * (1 + ROUNDING)) {
    --pass.endSlice;
  }
}

}  // namespace

void makeAerial(vk::Device& device, const WlkAerialPerspective& info, uint32_t framesInFlight,
                bool batches, ViewResources& r) {
  const VkDeviceSize froxels = VkDeviceSize{info.width} * info.height * info.depth;
  const VkDeviceSize bytes = r.volumeCapacity > 0 ? froxels * 16 : 16;
  if (bytes > device.properties().limits.maxStorageBufferRange) {
    fail(WLK_ERROR_LIMIT_EXCEEDED, WLK_STRUCT_AERIAL_PERSPECTIVE, "width",
         "%u x %u x %u froxels with volumes exceed the device's storage buffers", info.width,
         info.height, info.depth);
  }
  const VkDeviceSize alignment =
      std::max<VkDeviceSize>(device.properties().limits.minUniformBufferOffsetAlignment, 16);
  AerialResources& a = r.aerial;
  a.volumeOffset = (sizeof(FrameUniforms) + alignment - 1) / alignment * alignment;
  a.slotStride = a.volumeOffset + r.volumeCapacity * r.volumeStride;
  a.uniforms =
      vk::Buffer(device, a.slotStride * framesInFlight, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, true);
  a.frameState = vk::Buffer(device, bytes, vk::ROWS, false);
  if (batches) {
    a.volumeState = vk::Buffer(device, bytes, vk::ROWS, false);
  }
}

void planAerial(FrameCommands& c, const ViewTargets& targets) {
  AerialPass& pass = c.aerial;
  pass.recorded = static_cast<bool>(targets.aerialRadiance);
  pass.stats = passStats("aerial perspective", WLK_PASS_AERIAL_PERSPECTIVE, 0);
  pass.stats.reason = pass.recorded ? WLK_REASON_NEEDED : WLK_REASON_LAYER_OFF;
  if (pass.recorded) {
    findSlices(c.view.plan, *c.view.aerial, pass);
  }
}

vk::PipelineKey aerialKeyOf(const vk::Pipelines& pipelines, const ViewState& view) {
  CompositeVariant v = compositeVariant(view, false);
  const vk::PipelineKey key = aerialKey(v);
  if (pipelines.find(key) != VK_NULL_HANDLE) {
    return key;
  }
  v.space = false;  // as for the composite
  return aerialKey(v);
}

PixelRect froxelRect(const PixelRect& rect, const ViewState& view) {
  const auto scaled = [](uint32_t x, uint32_t froxels, uint32_t pixels, bool up) {
    return static_cast<uint32_t>((uint64_t{x} * froxels + (up ? pixels - 1 : 0)) / pixels);
  };
  const WlkAerialPerspective& info = *view.aerial;
  return {scaled(rect.x0, info.width, view.info.width, false),
          scaled(rect.y0, info.height, view.info.height, false),
          scaled(rect.x1, info.width, view.info.width, true),
          scaled(rect.y1, info.height, view.info.height, true)};
}

VkDeviceSize aerialVolumeOffset(const ViewState& view, uint32_t slot, uint32_t rank) {
  const AerialResources& a = view.resources.aerial;
  return slot * a.slotStride + a.volumeOffset + rank * view.resources.volumeStride;
}

void writeAerialFrame(const FrameCommands& c, bool half) {
  const ViewResources& r = c.view.resources;
  const WlkAerialPerspective& info = *c.view.aerial;
  FrameUniforms frame;
  std::memcpy(&frame, static_cast<const char*>(r.uniforms.data()) + c.in.slot * r.slotStride,
              sizeof frame);
  const auto width = static_cast<float>(info.width);
  const auto height = static_cast<float>(info.height);
  frame.viewport = {width, height, 1.0f / width, 1.0f / height};
  frame.output_.z = targetLimit(half ? WLK_TARGET_RGBA16_FLOAT : WLK_TARGET_RGBA32_FLOAT);
  const PixelRect rect = froxelRect(c.view.plan.volumeRect, c.view);
  frame.volumeRect = {static_cast<float>(rect.x0), static_cast<float>(rect.y0),
                      static_cast<float>(rect.x1), static_cast<float>(rect.y1)};
  frame.froxels = {info.distance, info.exponent, 1.0f / static_cast<float>(info.depth - 1), 0.0f};
  const AerialPass& pass = c.aerial;
  const bool none = pass.firstSlice >= pass.endSlice;
  frame.froxelRange = {static_cast<float>(none ? info.depth : pass.firstSlice),
                       static_cast<float>(none ? info.depth : pass.endSlice - 1),
                       half ? 1.0f : 0.0f, 0.0f};
  std::memcpy(static_cast<char*>(r.aerial.uniforms.data()) + c.in.slot * r.aerial.slotStride,
              &frame, sizeof frame);
}

void recordAerial(FrameCommands& c, const ViewTargets& targets, VkDeviceSize counterOffset) {
  if (!c.aerial.recorded) {
    return;
  }
  const AerialResources& a = c.view.resources.aerial;
  const WlkAerialPerspective& info = *c.view.aerial;
  BoundSet& set = c.slot.aerial;
  bindLayer(c.bindings, c.pipelines, c.view, targets, set, c.in, counterOffset);
  c.bindings.buffer(set, vk::BIND_COMPOSITE_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                    a.uniforms.handle(), c.in.slot * a.slotStride, sizeof(FrameUniforms));
  c.bindings.buffer(set, vk::BIND_COMPOSITE_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                    a.frameState.handle(), 0, a.frameState.size());
  c.bindings.texels(set, vk::BIND_COMPOSITE_STATE_TEXELS, a.frameState);
  for (const uint32_t unused : {vk::BIND_COMPOSITE_DEPTH, vk::BIND_COMPOSITE_INPUT}) {
    c.bindings.image(set, unused, c.in.dummy2d, c.pipelines.nearest(),
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  c.bindings.image(set, vk::BIND_COMPOSITE_TARGET0, targets.aerialRadiance.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_GENERAL);
  c.bindings.image(set, vk::BIND_COMPOSITE_TARGET1, targets.aerialTransmittance.view,
                   VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL);
  c.orderShaders();
  c.vk.CmdBindDescriptorSets(c.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                             c.pipelines.compositeLayout(), 0, 1, &set.set, 0, nullptr);
  c.dispatch(c.find(aerialKeyOf(c.pipelines, c.view)), c.pipelines.compositeLayout(), nullptr,
             groups(info.width), groups(info.height), c.aerial.stats, c.aerial.statsIndex,
             info.depth);
  c.view.record.passes[c.aerial.statsIndex] = c.aerial.stats;
}

}  // namespace welkin
