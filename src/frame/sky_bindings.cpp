// SPDX-License-Identifier: MIT
#include "frame/sky_bindings.hpp"

namespace welkin {

VkImageView momentsOf(const RecordInput& in) {
  return in.sky->version > 0 ? in.sky->moments.view() : in.dummy2d;
}

VkImageView fogLightOf(const RecordInput& in) {
  return in.sky->version > 0 && in.sky->fog ? in.sky->fog.view() : in.dummy3d;
}

void bindSkyTable(Bindings& bindings, const vk::Pipelines& pipelines, const ViewResources& r,
                  BoundSet& set, const RecordInput& in) {
  bindings.buffer(set, vk::BIND_SKY_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
                  in.slot * r.slotStride, sizeof(interface_::FrameUniforms));
  bindings.image(set, vk::BIND_SKY_MOMENTS, momentsOf(in), pipelines.linear(),
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  const vk::Image& peak = r.skyPeak ? r.skyPeak : r.skyTable;
  bindings.image(set, vk::BIND_SKY_TABLE_STORAGE, r.skyTable.view(), VK_NULL_HANDLE,
                 VK_IMAGE_LAYOUT_GENERAL);
  bindings.image(set, vk::BIND_SKY_PEAK_STORAGE, peak.view(), VK_NULL_HANDLE,
                 VK_IMAGE_LAYOUT_GENERAL);
  bindings.image(set, vk::BIND_SKY_FOG, fogLightOf(in), pipelines.linear(),
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void bindSkyLookup(Bindings& bindings, const vk::Pipelines& pipelines, const ViewResources& r,
                   BoundSet& set, const SkyLookupBindings& at, const RecordInput& in) {
  const auto bind = [&](uint32_t binding, const vk::Image& table) {
    bindings.image(set, binding, table ? table.view() : in.dummy3d, pipelines.linear(),
                   table ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  };
  bind(at.table, r.skyTable);
  bind(at.peak, r.skyPeak);
}

}  // namespace welkin
