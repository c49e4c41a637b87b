// SPDX-License-Identifier: MIT
#include "frame/composite_record.hpp"

#include "frame/resources.hpp"
#include "frame/sky_bindings.hpp"

namespace welkin {

CompositeVariant compositeVariant(const ViewState& view, bool depth) {
  CompositeVariant v{};
  v.air = view.plan.airKind();
  v.fog = view.plan.fog;
  v.lights = view.plan.lightCount();
  v.volumes = view.resources.volumeCapacity + view.resources.surfaceCapacity > 0;
  v.depth = depth;
  v.ground = view.plan.ground;
  v.multiple = view.plan.multiple;
  v.space = view.plan.space;
  v.allLight = view.plan.allLight;
  v.shadows = view.plan.shadowKind() & (view.resources.shadowImage ? 3U : 2U);
  return v;
}

vk::PipelineKey compositeKeyOf(const vk::Pipelines& pipelines, const ViewState& view, bool depth,
                               bool tiles) {
  CompositeVariant v = compositeVariant(view, depth);
  v.tiles = tiles;
  // Variants are prepared for a layer as a whole; until one for space is, the table must do.
  vk::PipelineKey key;
  bool found = false;
  for (const bool space : {v.space, false}) {
    for (const uint32_t disk : {view.plan.diskKind(), 1U, 2U}) {
      if (!found) {
        v.space = space;
        v.disk = disk;
        key = compositeKey(view.info, v);
        found = pipelines.find(key) != VK_NULL_HANDLE;
      }
    }
  }
  return key;
}

void bindLayer(Bindings& bindings, const vk::Pipelines& pipelines, const ViewState& view,
               const ViewTargets& targets, BoundSet& set, const RecordInput& in,
               VkDeviceSize counterOffset) {
  const ViewResources& r = view.resources;
  bindings.buffer(set, vk::BIND_COMPOSITE_FOG_CURVE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                  r.uniforms.handle(), in.slot * r.slotStride + r.fogOffset, FOG_CURVE_BYTES);
  bindings.buffer(set, vk::BIND_COMPOSITE_COUNTERS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                  r.counters.handle(), counterOffset, 16);
  bindSkyLookup(bindings, pipelines, r, set,
                {vk::BIND_COMPOSITE_SKY_TABLE, vk::BIND_COMPOSITE_SKY_PEAK}, in);
  bindings.image(set, vk::BIND_COMPOSITE_SKY_MOMENTS, momentsOf(in), pipelines.linear(),
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  bindings.image(set, vk::BIND_COMPOSITE_SKY_FOG, fogLightOf(in), pipelines.linear(),
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  const bool shadow = r.shadowImage && r.shadowImage.layout != VK_IMAGE_LAYOUT_UNDEFINED;
  bindings.image(set, vk::BIND_COMPOSITE_SHADOW, shadow ? r.shadowImage.view() : in.dummy2d,
                 pipelines.linear(),
                 shadow ? r.shadowImage.layout : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  bindings.image(set, vk::BIND_COMPOSITE_LIGHT_SHADOW,
                 view.plan.lightShadows ? targets.shadowMap.view : in.dummyArray,
                 pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void bindComposite(Bindings& bindings, const vk::Pipelines& pipelines, ViewState& view,
                   const ViewTargets& targets, const RecordInput& in, VkDeviceSize counterOffset) {
  ViewResources& r = view.resources;
  BoundSet& set = r.slots[in.slot].composite;
  bindLayer(bindings, pipelines, view, targets, set, in, counterOffset);
  bindings.buffer(set, vk::BIND_COMPOSITE_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                  r.uniforms.handle(), in.slot * r.slotStride, sizeof(interface_::FrameUniforms));
  bindings.buffer(set, vk::BIND_COMPOSITE_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                  r.frameState.handle(), 0, r.frameState.size());
  bindings.texels(set, vk::BIND_COMPOSITE_STATE_TEXELS, r.frameState);
  bindings.image(set, vk::BIND_COMPOSITE_DEPTH, targets.depth ? targets.depth.view : in.dummy2d,
                 pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  const bool blend = view.info.composite == WLK_COMPOSITE_BLEND;
  if (targets.inputIsTarget && !blend) {
    bindings.image(set, vk::BIND_COMPOSITE_INPUT, targets.target0.view, pipelines.nearest(),
                   VK_IMAGE_LAYOUT_GENERAL);
  } else {
    bindings.image(set, vk::BIND_COMPOSITE_INPUT,
                   targets.colorInput ? targets.colorInput.view : in.dummy2d, pipelines.nearest(),
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  if (!blend) {
    const TargetImage& second = targets.target1 ? targets.target1 : targets.target0;
    bindings.image(set, vk::BIND_COMPOSITE_TARGET0, targets.target0.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_GENERAL);
    bindings.image(set, vk::BIND_COMPOSITE_TARGET1, second.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_GENERAL);
  }
}

}  // namespace welkin
