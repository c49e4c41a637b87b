// SPDX-License-Identifier: MIT
#include "frame/distance_record.hpp"

#include "frame/resources.hpp"

namespace welkin {

void recordVolumeDistance(FrameCommands& c, const ViewTargets& targets) {
  if (!c.view.volumeDistance) {
    return;
  }
  WlkPassStats stats = passStats("volume distance", WLK_PASS_VOLUME_DISTANCE, 0);
  stats.reason = WLK_REASON_LAYER_OFF;
  if (targets.volumeDistance) {
    stats.reason = WLK_REASON_NEEDED;
    const ViewResources& r = c.view.resources;
    BoundSet& set = c.slot.distance;
    c.bindings.buffer(set, vk::BIND_DISTANCE_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                      r.uniforms.handle(), c.in.slot * r.slotStride,
                      sizeof(interface_::FrameUniforms));
    c.bindings.buffer(set, vk::BIND_DISTANCE_SUMS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                      r.distances.handle(), 0, r.distances.size());
    c.bindings.image(set, vk::BIND_DISTANCE_TARGET, targets.volumeDistance.view, VK_NULL_HANDLE,
                     VK_IMAGE_LAYOUT_GENERAL);
    c.orderShaders();
    c.vk.CmdBindDescriptorSets(c.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                               c.pipelines.distanceLayout(), 0, 1, &set.set, 0, nullptr);
    c.dispatch(c.find(distanceKey()), c.pipelines.distanceLayout(), nullptr,
               groups(c.view.info.width), groups(c.view.info.height), stats,
               static_cast<uint32_t>(c.view.record.passes.size()));
  }
  c.view.record.passes.push_back(stats);
}

}  // namespace welkin
