// SPDX-License-Identifier: MIT
#include "frame/record.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "frame/aerial.hpp"
#include "frame/composite_record.hpp"
#include "frame/distance_record.hpp"
#include "frame/frame_commands.hpp"
#include "frame/resources.hpp"
#include "frame/sky_bindings.hpp"
#include "frame/surface_record.hpp"
#include "frame/transport.hpp"
#include "frame/view_shadow.hpp"
#include "frame/volume_record.hpp"

namespace welkin {
namespace {

using interface_::FrameUniforms;

constexpr size_t IMAGES = 8;  // of the engine, at most

glm::dvec3 eyeOf(const ViewState& view) {
  return {view.camera.position[0], view.camera.position[1], view.camera.position[2]};
}

bool differ(const WlkVulkanImageState& a, const WlkVulkanImageState& b) {
  return a.layout != b.layout || a.stages != b.stages || a.access != b.access;
}

class Recorder {
 public:
  Recorder(vk::Device& device, const vk::Pipelines& pipelines, VkCommandBuffer commands,
           ViewState& view, const RecordInput& input, const ViewTargets& targets)
      : c_(device, pipelines, commands, view, input),
        view_(view),
        in_(input),
        targets_(targets),
        slot_(c_.slot) {}

  void run() {
    planAerial(c_, targets_);
    findPipelines();
    start();
    acquireTargets();
    if (anything_ && recordViewShadow(c_.device, c_.pipelines, c_.commands, view_, in_)) {
      c_.timestamp(static_cast<uint32_t>(view_.record.passes.size() - 1));
    }
    recordSkyTable();
    if (view_.aerial) {
      c_.aerial.statsIndex = static_cast<uint32_t>(view_.record.passes.size());
      view_.record.passes.push_back(c_.aerial.stats);
    }
    if (c_.aerial.recorded) {
      writeAerialFrame(c_, targets_.aerialHalf);
    }
    recordLayers();
    recordVolumeDistance(c_, targets_);
    recordComposite();
    recordAerial(c_, targets_, counterOffset());
    if (anything_) {
      // The counter goes to the CPU.
      c_.barrier(
          {COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
          {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    }
    releaseTargets();
    slot_.passes.clear();
    for (const WlkPassStats& pass : view_.record.passes) {
      slot_.passes.push_back({pass.pass, pass.volume.id | pass.surface.id, 0});
    }
    view_.record.stats.descriptorWrites += c_.bindings.writes();
    slot_.frameIndex = in_.frameIndex;
    slot_.harvested = !anything_;
    view_.lastFrame = in_.frameIndex;
  }

 private:
  static bool before(const PlannedVolume& volume, const PlannedVolume& surface) {
    return volume.drawn >= surface.drawn &&
           (volume.drawn > surface.drawn || volume.distance <= surface.distance);
  }

  // Whether a volume is the first of all layers.
  bool leads(const PlannedVolume& volume) const {
    const Plan& plan = view_.plan;
    return &volume == plan.volumes.data() &&
           (plan.surfaces.empty() || before(volume, plan.surfaces.front()));
  }

  // Volumes and surfaces, front to back; those that are not drawn come last in both lists.
  void recordLayers() {
    const Plan& plan = view_.plan;
    auto volume = plan.volumes.begin();
    auto surface = plan.surfaces.begin();
    while (volume != plan.volumes.end() || surface != plan.surfaces.end()) {
      const bool first = volume == plan.volumes.begin() && surface == plan.surfaces.begin();
      if (surface == plan.surfaces.end() ||
          (volume != plan.volumes.end() && before(*volume, *surface))) {
        recordVolume(c_, targets_, *volume, first);
        ++volume;
      } else {
        recordSurface(c_, targets_, *surface, first);
        ++surface;
      }
    }
  }

  // Looks everything up first: a failure records nothing.
  void findPipelines() {
    const Plan& plan = view_.plan;
    for (const PlannedVolume& volume : plan.volumes) {
      findVolumePipelines(c_, targets_, volume, leads(volume));
    }
    for (const PlannedVolume& surface : plan.surfaces) {
      findSurfacePipelines(c_, targets_, surface);
    }
    if (plan.multiple) {
      c_.find(skyTableKey(plan.airKind(), plan.fog, plan.lightCount(), plan.allLight));
    }
    if (plan.composite) {
      onlyTiles_ = onlyTilesSeen(c_, targets_);
      compositePipeline_ = c_.find(
          compositeKeyOf(c_.pipelines, view_, static_cast<bool>(targets_.depth), onlyTiles_));
    }
    if (targets_.volumeDistance) {
      c_.find(distanceKey());
    }
    if (c_.aerial.recorded) {
      c_.find(aerialKeyOf(c_.pipelines, view_));
    }
  }

  // Mean over the volumes drawn; 0 where they have no part of the light pass.
  float diskPower() const {
    float sum = 0;
    for (uint32_t i = 0; c_.quality.transport && i < view_.plan.drawnCount; ++i) {
      const double peak = in_.volumes[view_.plan.volumes[i].index].state->transport->peak;
      sum += static_cast<float>(1 / std::max(1 - peak, 1e-3) - 1);
    }
    for (uint32_t i = 0; i < view_.plan.surfaceCount; ++i) {
      const SurfaceOptics& optics = in_.surfaces[view_.plan.surfaces[i].index].state->optics;
      sum += static_cast<float>(optics.whole / optics.smooth - 1);
    }
    const uint32_t count = view_.plan.drawnCount + view_.plan.surfaceCount;
    return sum / static_cast<float>(std::max(count, 1U));
  }

  // m; the drawn ones come first, nearest first.
  double nearestVolume() const {
    const Plan& plan = view_.plan;
    const double volume = plan.drawnCount > 0 ? plan.volumes[0].distance : 1e30;
    return plan.surfaceCount > 0 ? std::min(volume, plan.surfaces[0].distance) : volume;
  }

  void start() {
    const Plan& plan = view_.plan;
    anything_ = plan.composite || plan.drawnCount > 0 || plan.surfaceCount > 0 ||
                c_.aerial.recorded || static_cast<bool>(targets_.volumeDistance);
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
    if (plan.lightShadows) {
      fillLightShadow(targets_.lightShadow, eyeOf(view_), nearestVolume(), frame);
    }
    frame.froxelRange.z = targets_.distanceHalf ? 1.0f : 0.0f;
    std::memcpy(memory, &frame, sizeof frame);
    skyKey_ = skyTableKeyOf(frame);
    if (plan.fog) {
      std::memcpy(memory + view_.resources.fogOffset, in_.air->fogPhase->curve.data(),
                  FOG_CURVE_BYTES);
    }
    c_.vk.CmdResetQueryPool(c_.commands, slot_.queries, 0, view_.resources.queryCount);
    c_.vk.CmdFillBuffer(c_.commands, view_.resources.counters.handle(), counterOffset(), 16, 0);
    // Also orders this frame's first pass after the last frame's readers of the same buffers.
    c_.barrier(
        {VK_PIPELINE_STAGE_2_TRANSFER_BIT | COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
         VK_ACCESS_2_TRANSFER_WRITE_BIT | SHADER_ACCESS},
        {COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, SHADER_ACCESS});
    for (vk::Image* table : {&view_.resources.skyTable, &view_.resources.skyPeak,
                             &view_.resources.viewSource, &view_.resources.viewAmbient}) {
      c_.firstUse(*table);
    }
    c_.timestamp();
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
        stats.reason = c_.quality.noSkip ? WLK_REASON_NO_SKIP_FLAG : WLK_REASON_UNCHANGED;
      }
      if (stats.reason != WLK_REASON_UNCHANGED) {
        bindSkyTable(c_.bindings, c_.pipelines, r, slot_.skyTable, in_);
        c_.vk.CmdBindDescriptorSets(c_.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                    c_.pipelines.skyLayout(), 0, 1, &slot_.skyTable.set, 0,
                                    nullptr);
        const uint32_t lights = plan.lightCount();
        const uint32_t width = groups(interface_::SKY_AZIMUTHS * lights) + (lights < r.lights);
        c_.dispatch(c_.find(skyTableKey(plan.airKind(), plan.fog, lights, plan.allLight)),
                    c_.pipelines.skyLayout(), nullptr, width, groups(plan.skyZeniths), stats, 0);
        c_.orderShaders();
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
    work_.fill(GENERAL_STATE);
    work_[0] = sampled;
    work_[1] = sampled;
    if (view_.info.composite == WLK_COMPOSITE_BLEND) {
      work_[2] = attachment;
    }
    work_[4] = sampled;
    const std::array images = imageList();
    for (size_t i = 0; i < images.size(); ++i) {
      if (*images[i] && used(i)) {
        c_.image(images[i]->image, images[i]->range, images[i]->before, work_[i]);
      }
    }
  }

  void releaseTargets() {
    const std::array images = imageList();
    for (size_t i = 0; i < images.size(); ++i) {
      if (!*images[i]) {
        continue;
      }
      // Of an image that nothing was drawn on, too: the engine waits for `after` alone.
      const WlkVulkanImageState& from = used(i) ? work_[i] : images[i]->before;
      if (used(i) || differ(from, images[i]->after)) {
        c_.image(images[i]->image, images[i]->range, from, images[i]->after);
      }
    }
  }

  std::array<const TargetImage*, IMAGES> imageList() const {
    return {&targets_.depth,
            &targets_.colorInput,
            &targets_.target0,
            &targets_.target1,
            &targets_.shadowMap,
            &targets_.aerialRadiance,
            &targets_.aerialTransmittance,
            &targets_.volumeDistance};
  }
  // Whether the commands use image `i` of the list, if there is one.
  bool used(size_t i) const { return anything_ && (i != 4 || view_.plan.lightShadows); }

  void recordComposite() {
    WlkPassStats stats = passStats("composite", WLK_PASS_COMPOSITE, 0);
    stats.reason = view_.plan.compositeReason;
    const auto index = static_cast<uint32_t>(view_.record.passes.size());
    if (view_.plan.composite) {
      bindComposite(c_.bindings, c_.pipelines, view_, targets_, in_, counterOffset());
      if (onlyTiles_) {
        c_.bindings.buffer(slot_.composite, vk::BIND_COMPOSITE_TILES,
                           VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, view_.resources.volumeState.handle(),
                           0, view_.resources.volumeState.size());
        c_.barrier({COMPUTE, SHADER_ACCESS},
                   {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                    SHADER_ACCESS | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
      }
      c_.orderShaders();
      if (view_.info.composite == WLK_COMPOSITE_BLEND) {
        drawBlend(stats, index);
      } else {
        c_.vk.CmdBindDescriptorSets(c_.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                    c_.pipelines.compositeLayout(), 0, 1, &slot_.composite.set, 0,
                                    nullptr);
        c_.dispatch(compositePipeline_, c_.pipelines.compositeLayout(), nullptr,
                    groups(view_.info.width), groups(view_.info.height), stats, index);
      }
    }
    view_.record.passes.push_back(stats);
  }

  void drawBlend(WlkPassStats& stats, uint32_t index) {
    c_.vk.CmdBindDescriptorSets(c_.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                c_.pipelines.compositeLayout(), 0, 1, &slot_.composite.set, 0,
                                nullptr);
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
    c_.vk.CmdBeginRendering(c_.commands, &rendering);
    c_.vk.CmdBindPipeline(c_.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, compositePipeline_);
    const VkViewport viewport{
        0.0f, 0.0f, static_cast<float>(view_.info.width), static_cast<float>(view_.info.height),
        0.0f, 1.0f};
    c_.vk.CmdSetViewport(c_.commands, 0, 1, &viewport);
    // Without air and fog nothing is seen in front of what volumes and surfaces do not cover.
    const PixelRect& rect = view_.plan.volumeRect;
    const bool all = view_.plan.airKind() > 0 || view_.plan.fog || c_.quality.noSkip;
    const VkRect2D drawn =
        all ? area
            : VkRect2D{{static_cast<int32_t>(rect.x0), static_cast<int32_t>(rect.y0)},
                       {rect.x1 - rect.x0, rect.y1 - rect.y0}};
    c_.vk.CmdSetScissor(c_.commands, 0, 1, &drawn);
    if (onlyTiles_) {
      c_.vk.CmdDrawIndirect(c_.commands, view_.resources.volumeState.handle(),
                            4 * VkDeviceSize{interface_::TILE_DRAW}, 1, 0);
    } else {
      c_.vk.CmdDraw(c_.commands, 3, 1, 0, 0);
      stats.invocations += uint64_t{drawn.extent.width} * drawn.extent.height;
    }
    c_.vk.CmdEndRendering(c_.commands);
    stats.recorded = 1;
    stats.commands += 1;
    view_.record.stats.draws += 1;
    c_.timestamp(index);
  }

  VkDeviceSize counterOffset() const {
    return view_.resources.counters.size() / view_.resources.slots.size() * in_.slot;
  }

  FrameCommands c_;
  ViewState& view_;
  const RecordInput& in_;
  const ViewTargets& targets_;
  ViewSlot& slot_;
  VkPipeline compositePipeline_ = VK_NULL_HANDLE;
  bool onlyTiles_ = false;  // are what the composite draws, see onlyTilesSeen
  bool anything_ = false;
  std::array<WlkVulkanImageState, IMAGES> work_{};
  SkyTableKey skyKey_{};
};

}  // namespace

void recordView(vk::Device& device, const vk::Pipelines& pipelines, VkCommandBuffer commands,
                ViewState& view, const RecordInput& input, const ViewTargets& targets) {
  Recorder(device, pipelines, commands, view, input, targets).run();
}

}  // namespace welkin
