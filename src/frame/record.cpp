// SPDX-License-Identifier: MIT
#include "frame/record.hpp"

#include <algorithm>
#include <cstring>

#include "failure.hpp"
#include "frame/bindings.hpp"
#include "frame/composite_record.hpp"
#include "frame/resources.hpp"
#include "frame/sky_bindings.hpp"
#include "frame/transport_record.hpp"
#include "frame/view_shadow.hpp"

namespace welkin {
namespace {

using interface_::FrameUniforms;
using interface_::SliceConstants;
using interface_::VolumeUniforms;

constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags2 SHADER_ACCESS = VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                         VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                                         VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr WlkVulkanImageState GENERAL_STATE{VK_IMAGE_LAYOUT_GENERAL, 0, COMPUTE, SHADER_ACCESS};

uint32_t groups(uint32_t pixels) {
  return (pixels + 7) / 8;
}

class Recorder {
 public:
  Recorder(vk::Device& device, const vk::Pipelines& pipelines, VkCommandBuffer commands,
           ViewState& view, const RecordInput& input, const ViewTargets& targets)
      : device_(device),
        vk_(device.vk()),
        pipelines_(pipelines),
        commands_(commands),
        view_(view),
        in_(input),
        targets_(targets),
        slot_(view.resources.slots[input.slot]),
        quality_(view.plan.quality),
        bindings_(device) {}

  void run() {
    findPipelines();
    start();
    acquireTargets();
    if (anything_ && recordViewShadow(device_, pipelines_, commands_, view_, in_)) {
      timestamp(static_cast<uint32_t>(view_.record.passes.size() - 1));
    }
    recordSkyTable();
    for (const PlannedVolume& volume : view_.plan.volumes) {
      recordVolume(volume);
    }
    recordComposite();
    releaseTargets();
    slot_.passes.clear();
    for (const WlkPassStats& pass : view_.record.passes) {
      slot_.passes.push_back({pass.pass, pass.volume.id, 0});
    }
    view_.record.stats.descriptorWrites += bindings_.writes();
    slot_.frameIndex = in_.frameIndex;
    slot_.harvested = !anything_;
    view_.lastFrame = in_.frameIndex;
  }

 private:
  const RecordVolume& volumeOf(const PlannedVolume& planned) const {
    return in_.volumes[planned.index];
  }

  vk::PipelineKey eyeKeyOf(const PlannedVolume& planned) const {
    const Plan& plan = view_.plan;
    return eyeKey(
        {plan.airKind(), plan.fog, planned.lit, static_cast<bool>(targets_.depth), plan.allLight},
        volumeOf(planned).state->fieldCount, quality_);
  }

  VkPipeline find(const vk::PipelineKey& key) const {
    const VkPipeline pipeline = pipelines_.find(key);
    if (pipeline == VK_NULL_HANDLE) {
      fail(WLK_ERROR_NOT_PREPARED, 0, "",
           "the scene changed in a way that needs wlkPrepare before recording");
    }
    return pipeline;
  }

  // Looks everything up first: a failure records nothing.
  void findPipelines() {
    const Plan& plan = view_.plan;
    for (const PlannedVolume& volume : plan.volumes) {
      if (volume.drawn) {
        find(eyeKeyOf(volume));
        const uint32_t fields = volumeOf(volume).state->fieldCount;
        find(lightKey(fields, quality_.forwardScattering));
        for (const vk::Pass pass : TRANSPORT_PASSES) {
          if (quality_.transport && volume.lit) {
            find(transportKey(pass, fields));
          }
        }
      }
    }
    if (plan.multiple) {
      find(skyTableKey(plan.airKind(), plan.fog, plan.lightCount(), plan.allLight));
    }
    if (plan.composite) {
      compositePipeline_ =
          find(compositeKeyOf(pipelines_, view_, static_cast<bool>(targets_.depth)));
    }
  }

  // Mean over the volumes drawn; 0 where they have no part of the light pass.
  float diskPower() const {
    float sum = 0;
    for (uint32_t i = 0; quality_.transport && i < view_.plan.drawnCount; ++i) {
      const double peak = volumeOf(view_.plan.volumes[i]).state->transport->peak;
      sum += static_cast<float>(1 / std::max(1 - peak, 1e-3) - 1);
    }
    return sum / static_cast<float>(std::max(view_.plan.drawnCount, 1U));
  }

  void start() {
    const Plan& plan = view_.plan;
    anything_ = plan.composite || plan.drawnCount > 0;
    FrameRecord& record = view_.record;
    record.stats = {};
    record.stats.frameIndex = in_.frameIndex;
    record.passes.clear();
    slot_.passOfQuery.clear();
    if (!anything_) {
      return;
    }
    auto* memory =
        static_cast<char*>(view_.resources.uniforms.data()) + in_.slot * view_.resources.slotStride;
    FrameUniforms frame;
    fillFrame(*in_.air, *in_.sky, view_, frame);
    frame.ground.w = diskPower();
    frame.output_.w = targets_.inputIsTarget || targets_.colorInput ? 1.0f : 0.0f;
    std::memcpy(memory, &frame, sizeof frame);
    skyKey_ = skyTableKeyOf(frame);
    if (plan.fog) {
      std::memcpy(memory + view_.resources.fogOffset, in_.air->fogPhase->curve.data(),
                  FOG_CURVE_BYTES);
    }
    vk_.CmdResetQueryPool(commands_, slot_.queries, 0, view_.resources.queryCount);
    vk_.CmdFillBuffer(commands_, view_.resources.counters.handle(), counterOffset(), 16, 0);
    // Also orders this frame's first pass after the last frame's readers of the same buffers.
    barrier(VK_PIPELINE_STAGE_2_TRANSFER_BIT | COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
            VK_ACCESS_2_TRANSFER_WRITE_BIT | SHADER_ACCESS,
            COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, SHADER_ACCESS);
    vk::Image& light = view_.resources.lightBuffer;
    if (plan.drawnCount > 0 && light.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
      image(light.handle(), VK_IMAGE_ASPECT_COLOR_BIT,
            {VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
            GENERAL_STATE);
      light.layout = VK_IMAGE_LAYOUT_GENERAL;
    }
    for (vk::Image* table :
         {&view_.resources.skyTable, &view_.resources.skyPeak, &view_.resources.viewSource}) {
      if (*table && table->layout == VK_IMAGE_LAYOUT_UNDEFINED) {
        image(table->handle(), VK_IMAGE_ASPECT_COLOR_BIT,
              {VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
              GENERAL_STATE);
        table->layout = VK_IMAGE_LAYOUT_GENERAL;
      }
    }
    timestamp();
  }

  // The view's table of further orders, where something it depends on has changed.
  void recordSkyTable() {
    ViewResources& r = view_.resources;
    const Plan& plan = view_.plan;
    WlkPassStats stats = passStats("sky table", WLK_PASS_SKY_TABLE, 0);
    stats.reason = plan.skyReason;
    if (plan.multiple) {
      const bool kept = r.skyVersion == in_.sky->version && r.skyKey == skyKey_;
      stats.reason = WLK_REASON_NEEDED;
      if (kept) {
        stats.reason = quality_.noSkip ? WLK_REASON_NO_SKIP_FLAG : WLK_REASON_UNCHANGED;
      }
      if (stats.reason != WLK_REASON_UNCHANGED) {
        bindSkyTable(bindings_, pipelines_, r, slot_.skyTable, in_);
        vk_.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_.skyLayout(),
                                  0, 1, &slot_.skyTable.set, 0, nullptr);
        const uint32_t lights = plan.lightCount();
        const uint32_t width = groups(interface_::SKY_AZIMUTHS * lights) + (lights < r.lights);
        dispatch(find(skyTableKey(plan.airKind(), plan.fog, lights, plan.allLight)),
                 pipelines_.skyLayout(), nullptr, width, groups(plan.skyZeniths), stats, 0);
        orderShaders();
        r.skyKey = skyKey_;
        r.skyVersion = in_.sky->version;
      }
    }
    view_.record.passes.push_back(stats);
  }

  void acquireTargets() {
    if (!anything_) {
      return;
    }
    const WlkVulkanImageState sampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
                                      COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    const WlkVulkanImageState attachment{
        VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, 0,
        VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
        VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    work_[0] = sampled;
    work_[1] = sampled;
    work_[2] = view_.info.composite == WLK_COMPOSITE_BLEND ? attachment : GENERAL_STATE;
    work_[3] = GENERAL_STATE;
    const std::array images = imageList();
    for (size_t i = 0; i < images.size(); ++i) {
      if (*images[i]) {
        image(images[i]->image, images[i]->barrierAspect, images[i]->before, work_[i]);
      }
    }
  }

  void releaseTargets() {
    const std::array images = imageList();
    for (size_t i = 0; i < images.size(); ++i) {
      if (!*images[i]) {
        continue;
      }
      const WlkVulkanImageState& from = anything_ ? work_[i] : images[i]->before;
      if (anything_ || from.layout != images[i]->after.layout) {
        image(images[i]->image, images[i]->barrierAspect, from, images[i]->after);
      }
    }
  }

  std::array<const TargetImage*, 4> imageList() const {
    return {&targets_.depth, &targets_.colorInput, &targets_.target0, &targets_.target1};
  }

  void recordVolume(const PlannedVolume& planned) {
    WlkPassStats light = passStats("light slices", WLK_PASS_LIGHT_SLICES, planned.id);
    WlkPassStats eye = passStats("eye slices", WLK_PASS_EYE_SLICES, planned.id);
    light.reason = planned.lightReason;
    eye.reason = planned.eyeReason;
    if (quality_.transport) {
      recordVolumeLight(planned);
    }
    const auto lightIndex = static_cast<uint32_t>(view_.record.passes.size());
    if (planned.drawn) {
      const auto rank = static_cast<uint32_t>(&planned - view_.plan.volumes.data());
      const bool first = rank == 0;
      PlannedVolume covered = planned;
      if (first) {
        covered.rect = view_.plan.volumeRect;  // its first batch also clears the union
      }
      bindVolume(covered, rank);
      const VkPipeline eyePipeline = find(eyeKeyOf(planned));
      const VkPipeline lightPipeline =
          find(lightKey(volumeOf(planned).state->fieldCount, quality_.forwardScattering));
      for (uint32_t slab = 0; slab < quality_.sliceCount; slab += quality_.batchSize) {
        SliceConstants push{};
        push.firstSlab = slab;
        push.slabCount = quality_.batchSize;  // a last batch past the end finds nothing to march
        push.lightSize = quality_.lightSize;
        push.flags =
            (slab == 0 ? interface_::SLICE_FIRST_BATCH : 0) |
            (slab + quality_.batchSize >= quality_.sliceCount ? interface_::SLICE_LAST_BATCH : 0) |
            (first ? interface_::SLICE_FIRST_VOLUME : 0);
        if (planned.lit) {
          orderShaders();
          dispatch(lightPipeline, pipelines_.volumeLayout(), &push, groups(quality_.lightSize),
                   groups(quality_.lightSize), light, lightIndex);
        }
        orderShaders();
        dispatch(eyePipeline, pipelines_.volumeLayout(), &push,
                 groups(covered.rect.x1 - covered.rect.x0),
                 groups(covered.rect.y1 - covered.rect.y0), eye, lightIndex + 1);
      }
    }
    view_.record.passes.push_back(light);
    view_.record.passes.push_back(eye);
  }

  void recordVolumeLight(const PlannedVolume& planned) {
    WlkPassStats stats = passStats("volume light", WLK_PASS_VOLUME_LIGHT, planned.id);
    stats.reason = planned.lightReason;
    if (planned.drawn && planned.lit) {
      const auto rank = static_cast<uint32_t>(&planned - view_.plan.volumes.data());
      orderShaders();
      const TransportCommands made =
          recordTransport(device_, pipelines_, commands_, view_, planned, in_, bindings_,
                          volumeOffset(rank), quality_.noSkip);
      stats.reason = made.computed ? planned.lightReason : uint32_t{WLK_REASON_UNCHANGED};
      stats.recorded = 1;
      stats.commands = made.dispatches;
      stats.invocations = made.invocations;
      view_.record.stats.dispatches += made.dispatches;
      view_.record.stats.barriers += made.barriers;
      timestamp(static_cast<uint32_t>(view_.record.passes.size()));
    }
    view_.record.passes.push_back(stats);
  }

  VkDeviceSize volumeOffset(uint32_t rank) const {
    const ViewResources& r = view_.resources;
    return (in_.slot + 1) * r.slotStride - (r.volumeCapacity - rank) * r.volumeStride;
  }

  void bindVolume(const PlannedVolume& planned, uint32_t rank) {
    const RecordVolume& volume = volumeOf(planned);
    const ViewResources& r = view_.resources;
    BoundSet& set = slot_.volumes[rank];
    const VkDeviceSize base = in_.slot * r.slotStride;
    const VkDeviceSize offset = volumeOffset(rank);
    VolumeUniforms uniforms;
    const glm::dvec3 eye(view_.camera.position[0], view_.camera.position[1],
                         view_.camera.position[2]);
    fillVolume(*volume.state, planned, eye, quality_, uniforms);
    std::memcpy(static_cast<char*>(r.uniforms.data()) + offset, &uniforms, sizeof uniforms);

    bindings_.buffer(set, vk::BIND_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
                     base, sizeof(FrameUniforms));
    bindings_.buffer(set, vk::BIND_VOLUME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
                     offset, sizeof(VolumeUniforms));
    bindings_.image(set, vk::BIND_LIGHT_STORAGE, r.lightBuffer.view(), VK_NULL_HANDLE,
                    VK_IMAGE_LAYOUT_GENERAL);
    bindings_.image(set, vk::BIND_LIGHT_SAMPLED, r.lightBuffer.view(), pipelines_.linear(),
                    VK_IMAGE_LAYOUT_GENERAL);
    for (uint32_t i = 0; i < WLK_MAX_FIELDS; ++i) {
      VkImageView view = in_.dummy3d;
      if (i < volume.state->fieldCount) {
        const FieldState& field = volume.state->fields[i];
        if (field.external) {
          view = volume.externalViews[i];
        } else if (field.image) {
          view = field.image.view();
        }
      }
      bindings_.image(set, vk::BIND_FIELD0 + i, view, pipelines_.linear(),
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    bindings_.image(set, vk::BIND_TABLE, volume.state->tables[quality_.form()].image.view(),
                    pipelines_.linear(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    bindings_.buffer(set, vk::BIND_FOG_CURVE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                     r.uniforms.handle(), base + r.fogOffset, FOG_CURVE_BYTES);
    bindings_.image(set, vk::BIND_DEPTH, targets_.depth ? targets_.depth.view : in_.dummy2d,
                    pipelines_.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    bindSkyLookup(bindings_, pipelines_, r, set, {vk::BIND_SKY_TABLE, vk::BIND_SKY_PEAK}, in_);
    bindings_.image(
        set, vk::BIND_VIEW_SOURCE, r.viewSource ? r.viewSource.view() : in_.dummy3d,
        pipelines_.linear(),
        r.viewSource ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    const vk::Buffer& volumeState = r.volumeState ? r.volumeState : r.frameState;
    bindings_.buffer(set, vk::BIND_FRAME_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                     r.frameState.handle(), 0, r.frameState.size());
    bindings_.buffer(set, vk::BIND_VOLUME_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                     volumeState.handle(), 0, volumeState.size());
    vk_.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_.volumeLayout(),
                              0, 1, &set.set, 0, nullptr);
  }

  void recordComposite() {
    WlkPassStats stats = passStats("composite", WLK_PASS_COMPOSITE, 0);
    stats.reason = view_.plan.compositeReason;
    const auto index = static_cast<uint32_t>(view_.record.passes.size());
    if (view_.plan.composite) {
      bindComposite(bindings_, pipelines_, view_, targets_, in_, counterOffset());
      orderShaders();
      if (view_.info.composite == WLK_COMPOSITE_BLEND) {
        drawBlend(stats, index);
      } else {
        vk_.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE,
                                  pipelines_.compositeLayout(), 0, 1, &slot_.composite.set, 0,
                                  nullptr);
        dispatch(compositePipeline_, pipelines_.compositeLayout(), nullptr,
                 groups(view_.info.width), groups(view_.info.height), stats, index);
      }
      // The counter goes to the CPU.
      barrier(COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
              VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
              VK_ACCESS_2_HOST_READ_BIT);
    }
    view_.record.passes.push_back(stats);
  }

  void drawBlend(WlkPassStats& stats, uint32_t index) {
    vk_.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                              pipelines_.compositeLayout(), 0, 1, &slot_.composite.set, 0, nullptr);
    VkRenderingAttachmentInfo attachment{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    attachment.imageView = targets_.target0.view;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    const VkRect2D area{{0, 0}, {view_.info.width, view_.info.height}};
    VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = area;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &attachment;
    vk_.CmdBeginRendering(commands_, &rendering);
    vk_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, compositePipeline_);
    const VkViewport viewport{
        0.0f, 0.0f, static_cast<float>(view_.info.width), static_cast<float>(view_.info.height),
        0.0f, 1.0f};
    vk_.CmdSetViewport(commands_, 0, 1, &viewport);
    vk_.CmdSetScissor(commands_, 0, 1, &area);
    vk_.CmdDraw(commands_, 3, 1, 0, 0);
    vk_.CmdEndRendering(commands_);
    stats.recorded = 1;
    stats.commands += 1;
    stats.invocations += uint64_t{view_.info.width} * view_.info.height;
    view_.record.stats.draws += 1;
    timestamp(index);
  }

  void dispatch(VkPipeline pipeline, VkPipelineLayout layout, const SliceConstants* push,
                uint32_t x, uint32_t y, WlkPassStats& stats, uint32_t statsIndex) {
    vk_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    if (push != nullptr) {
      vk_.CmdPushConstants(commands_, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof *push, push);
    }
    vk_.CmdDispatch(commands_, x, y, 1);
    stats.recorded = 1;
    stats.commands += 1;
    stats.invocations += uint64_t{x} * y * 64;
    view_.record.stats.dispatches += 1;
    timestamp(statsIndex);
  }

  // Ends a command of pass `index`; without one, starts the clock.
  void timestamp(uint32_t index = ~0u) {
    const auto query = static_cast<uint32_t>(slot_.passOfQuery.size()) + (index == ~0u ? 0 : 1);
    if (index != ~0u) {
      slot_.passOfQuery.push_back(index);
    }
    vk_.CmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot_.queries, query);
  }

  void orderShaders() {
    barrier(COMPUTE, SHADER_ACCESS, COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
            SHADER_ACCESS);
  }

  void barrier(VkPipelineStageFlags2 fromStage, VkAccessFlags2 fromAccess,
               VkPipelineStageFlags2 toStage, VkAccessFlags2 toAccess) {
    memoryBarrier(vk_, commands_, {fromStage, fromAccess}, {toStage, toAccess});
    view_.record.stats.barriers += 1;
  }

  void image(VkImage handle, VkImageAspectFlags aspect, const WlkVulkanImageState& from,
             const WlkVulkanImageState& to) {
    imageBarrier(vk_, commands_, handle, aspect, from, to);
    view_.record.stats.barriers += 1;
  }

  WlkPassStats passStats(const char* name, uint32_t pass, uint64_t volume) const {
    WlkPassStats stats{};
    std::snprintf(stats.name, sizeof stats.name, "%s", name);
    stats.pass = pass;
    stats.volume.id = volume;
    return stats;
  }

  VkDeviceSize counterOffset() const {
    return view_.resources.counters.size() / view_.resources.slots.size() * in_.slot;
  }

  const vk::Device& device_;
  const vk::Dispatch& vk_;
  const vk::Pipelines& pipelines_;
  VkCommandBuffer commands_;
  ViewState& view_;
  const RecordInput& in_;
  const ViewTargets& targets_;
  ViewSlot& slot_;
  SliceQuality quality_;
  VkPipeline compositePipeline_ = VK_NULL_HANDLE;
  bool anything_ = false;
  Bindings bindings_;
  std::array<WlkVulkanImageState, 4> work_{};
  SkyTableKey skyKey_{};
};

}  // namespace

void recordView(vk::Device& device, const vk::Pipelines& pipelines, VkCommandBuffer commands,
                ViewState& view, const RecordInput& input, const ViewTargets& targets) {
  Recorder(device, pipelines, commands, view, input, targets).run();
}

}  // namespace welkin
