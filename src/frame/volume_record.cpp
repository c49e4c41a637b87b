// SPDX-License-Identifier: MIT
#include "frame/volume_record.hpp"

#include <algorithm>
#include <cstring>

#include "failure.hpp"
#include "frame/aerial.hpp"
#include "frame/ambient_record.hpp"
#include "frame/light_store.hpp"
#include "frame/resources.hpp"
#include "frame/sky_bindings.hpp"
#include "frame/transport_record.hpp"

namespace welkin {
namespace {

using interface_::FrameUniforms;
using interface_::SliceConstants;
using interface_::SPREAD_CELLS;
using interface_::SPREAD_COLUMNS;
using interface_::VolumeUniforms;

static_assert(3 * SPREAD_COLUMNS * SPREAD_CELLS <= 32, "eye_spread.comp asks by bits of a word");
static_assert(interface_::TILE_SECONDS == 4 * SPREAD_COLUMNS &&
                  interface_::TILE_SECONDS == 2 * SPREAD_CELLS && interface_::TILE_PARTS == 8,
              "eye_spread.comp has 4 x 2 invocations to a tile, and groups 8 of them in a row");

vk::PipelineKey eyeKeyOf(const FrameCommands& c, const ViewTargets& targets,
                         const PlannedVolume& planned, uint32_t rays) {
  const Plan& plan = c.view.plan;
  const RecordVolume& volume = c.in.volumes[planned.index];
  const bool froxels = rays == interface_::RAYS_OF_FROXELS;
  const bool depth = targets.depth && !froxels;
  const bool distance = targets.volumeDistance && !froxels;
  return eyeKey({plan.airKind(), plan.fog, planned.lit, depth, plan.allLight,
                 volume.store != nullptr, planned.ambient, rays, distance},
                volume.state->fieldKind(), c.quality);
}

// Whether rays are marched in a grid of pixels. Batches' are not: what they leave is known only
// after the last of them, when the light of the others is gone.
bool marchesGrid(const FrameCommands& c, const PlannedVolume& planned) {
  return c.quality.halfVolumes && c.in.volumes[planned.index].store != nullptr;
}

SpreadVariant spreadOf(const FrameCommands& c, const ViewTargets& targets,
                       const PlannedVolume& planned, bool first) {
  return {static_cast<bool>(targets.depth), static_cast<bool>(targets.volumeDistance), !first,
          leapsIn(c.in.volumes[planned.index].state->fieldKind(), c.quality)};
}

// Whether voxels are wide enough for rays in every fourth pixel: a voxel's density reaches over
// twice its edge, which has to be as far as from ray to ray at the box's far end. At the box's
// sides it reaches less far: eye_spread.comp looks where rays have seen nothing.
bool fourthsServe(const FrameCommands& c, const PlannedVolume& planned) {
  constexpr double LEAST_PIXELS = 2;
  const VolumeState& volume = *c.in.volumes[planned.index].state;
  const glm::dmat3 planes = glm::transpose(glm::inverse(glm::dmat3(volume.worldFromBox)));
  double edge = planned.farthest;
  for (int i = 0; i < 3; ++i) {
    edge = std::min(edge, 1.0 / (glm::length(planes[i]) * volume.size[static_cast<size_t>(i)]));
  }
  return edge * c.view.plan.pixelsAhead >= LEAST_PIXELS * planned.farthest;
}

bool marchesFroxels(const FrameCommands& c) {
  return c.aerial.recorded && c.aerial.firstSlice < c.aerial.endSlice;
}

// Where an eye pass reads its constants and keeps what it has seen.
struct EyeTarget {
  BoundSet& set;
  const vk::Buffer& uniforms;
  VkDeviceSize frame;
  VkDeviceSize volume;
  const vk::Buffer& frameState;
  const vk::Buffer& volumeState;
};

vk::PipelineKey lightKeyOf(const FrameCommands& c, const RecordVolume& volume) {
  return lightKey({c.quality.forwardScattering, volume.store != nullptr},
                  volume.state->fieldKind());
}

// The engine may have written the image of a field since.
bool external(const VolumeState& volume) {
  return std::any_of(volume.fields.begin(), volume.fields.begin() + volume.fieldCount,
                     [](const FieldState& field) { return field.external.has_value(); });
}

class VolumeRecorder {
 public:
  VolumeRecorder(FrameCommands& commands, const ViewTargets& targets, const PlannedVolume& planned,
                 bool first)
      : c_(commands),
        targets_(targets),
        planned_(planned),
        volume_(commands.in.volumes[planned.index]),
        rank_(static_cast<uint32_t>(&planned - commands.view.plan.volumes.data())),
        first_(first),
        spread_(spreadOf(commands, targets, planned, first)) {}

  void run() {
    WlkPassStats light = passStats("light slices", WLK_PASS_LIGHT_SLICES, planned_.id);
    WlkPassStats eye = passStats("eye slices", WLK_PASS_EYE_SLICES, planned_.id);
    light.reason = planned_.lightReason;
    eye.reason = planned_.eyeReason;
    if (c_.quality.transport) {
      recordTransportLight();
    }
    if (c_.view.plan.ambient) {
      recordAmbientLight();
    }
    if (planned_.drawn) {
      covered_ = planned_;
      if (first_) {
        covered_.rect = c_.view.plan.volumeRect;  // the first one also clears the union
      }
      volume_.store != nullptr ? recordStored(light, eye) : recordBatches(light, eye);
    }
    passes().push_back(light);
    passes().push_back(eye);
  }

 private:
  std::pmr::vector<WlkPassStats>& passes() const { return c_.view.record.passes; }

  void recordTransportLight() {
    WlkPassStats stats = passStats("volume light", WLK_PASS_VOLUME_LIGHT, planned_.id);
    stats.reason = planned_.lightReason;
    if (planned_.drawn && planned_.lit) {
      c_.orderShaders();
      const TransportCommands made =
          recordTransport(c_.device, c_.pipelines, c_.commands, c_.view, planned_, c_.in,
                          c_.bindings, volumeOffset(), c_.quality.noSkip);
      stats.reason = made.reason;
      stats.recorded = 1;
      stats.commands = made.dispatches;
      stats.invocations = made.invocations;
      c_.view.record.stats.dispatches += made.dispatches;
      c_.view.record.stats.barriers += made.barriers;
      c_.timestamp(static_cast<uint32_t>(passes().size()));
    }
    passes().push_back(stats);
  }

  void recordAmbientLight() {
    WlkPassStats stats = passStats("volume ambient", WLK_PASS_VOLUME_AMBIENT, planned_.id);
    stats.reason = planned_.ambientReason;
    if (planned_.drawn && planned_.ambient) {
      c_.orderShaders();
      recordAmbient(c_, planned_, volumeOffset(), stats);
      c_.timestamp(static_cast<uint32_t>(passes().size()));
    }
    passes().push_back(stats);
  }

  void recordBatches(WlkPassStats& light, WlkPassStats& eye) {
    const auto lightIndex = static_cast<uint32_t>(passes().size());
    const SliceQuality& quality = c_.quality;
    const VkPipelineLayout layout = c_.pipelines.volumeLayout();
    c_.firstUse(c_.view.resources.lightBuffer);
    bind(c_.view.resources.lightBuffer);
    const VkPipeline lightPipeline = c_.find(lightKeyOf(c_, volume_));
    for (uint32_t slab = 0; slab < quality.sliceCount; slab += quality.batchSize) {
      SliceConstants push{};
      push.firstSlab = slab;
      push.slabCount = quality.batchSize;  // a last batch past the end finds nothing to march
      push.lightSize = quality.lightSize;
      push.flags =
          (slab == 0 ? interface_::SLICE_FIRST_BATCH : 0) |
          (slab + quality.batchSize >= quality.sliceCount ? interface_::SLICE_LAST_BATCH : 0) |
          (first_ ? interface_::SLICE_FIRST_VOLUME : 0);
      if (planned_.lit) {
        c_.orderShaders();
        c_.dispatch(lightPipeline, layout, &push, groups(quality.lightSize),
                    groups(quality.lightSize), light, lightIndex);
      }
      dispatchEye(push, eye, lightIndex + 1);
    }
  }

  // All slabs' light, unless it is there already, and one march through it.
  void recordStored(WlkPassStats& light, WlkPassStats& eye) {
    const auto lightIndex = static_cast<uint32_t>(passes().size());
    LightStore& store = *volume_.store;
    c_.firstUse(store.image);
    const VolumeUniforms uniforms = bind(store.image);
    SliceConstants push{};
    push.slabCount = c_.quality.sliceCount;
    push.lightSize = c_.quality.lightSize;
    push.flags = interface_::SLICE_FIRST_BATCH | interface_::SLICE_LAST_BATCH |
                 (first_ ? interface_::SLICE_FIRST_VOLUME : 0);
    if (planned_.lit) {
      const bool changing = external(*volume_.state);
      if (keptInStore(store, *volume_.state, c_.quality, uniforms) && !changing) {
        light.reason = c_.quality.noSkip ? WLK_REASON_NO_SKIP_FLAG : WLK_REASON_UNCHANGED;
      }
      if (changing) {
        store.key = {};  // what was uploaded may be back in the next frame
      }
      if (light.reason != WLK_REASON_UNCHANGED) {
        c_.orderShaders();
        c_.dispatch(c_.find(lightKeyOf(c_, volume_)), c_.pipelines.volumeLayout(), &push,
                    groups(push.lightSize), groups(push.lightSize), light, lightIndex);
      }
    }
    dispatchEye(push, eye, lightIndex + 1);
  }

  // Pixels, and froxels where they are asked for: neither reads what the other writes.
  void dispatchEye(const SliceConstants& push, WlkPassStats& eye, uint32_t index) {
    const VkPipelineLayout layout = c_.pipelines.volumeLayout();
    c_.orderShaders();
    if (marchesGrid(c_, planned_)) {
      dispatchGrid(push, eye, index);
    } else {
      c_.dispatch(c_.find(eyeKeyOf(c_, targets_, planned_, interface_::RAYS_OF_PIXELS)), layout,
                  &push, groups(covered_.rect.x1 - covered_.rect.x0),
                  groups(covered_.rect.y1 - covered_.rect.y0), eye, index);
    }
    if (marchesFroxels(c_)) {
      use(froxelTarget());
      const PixelRect rect = froxelRect(froxelsOf(), c_.view);
      SliceConstants froxels = push;
      froxels.flags &= ~interface_::SLICE_FIRST_VOLUME;
      froxels.flags |= rank_ == 0 ? interface_::SLICE_FIRST_VOLUME : 0;
      c_.dispatch(c_.find(eyeKeyOf(c_, targets_, planned_, interface_::RAYS_OF_FROXELS)), layout,
                  &froxels, groups(rect.x1 - rect.x0), groups(rect.y1 - rect.y0), c_.aerial.stats,
                  c_.aerial.statsIndex, c_.aerial.endSlice - c_.aerial.firstSlice);
      use(pixelTarget());
    }
  }

  // Rays of every fourth pixel and second pixels between them, or rays of every second pixel; then
  // pixels between those; each with rays where what is around will not do.
  void dispatchGrid(SliceConstants push, WlkPassStats& eye, uint32_t index) {
    const PixelRect& rect = covered_.rect;
    uint32_t& march = c_.view.resources.march;
    march = march % (~0U / interface_::SLICE_MARCH) + 1;
    push.flags |= march * interface_::SLICE_MARCH;
    const PixelRect seconds{rect.x0 / 2, rect.y0 / 2, rect.x1 / 2 + 1, rect.y1 / 2 + 1};
    const PixelRect fourths{seconds.x0 / 2, seconds.y0 / 2, seconds.x1 / 2 + 1, seconds.y1 / 2 + 1};
    const bool far = fourthsServe(c_, planned_);
    const PixelRect& rays = far ? fourths : seconds;
    SliceConstants ofSeconds = push;
    ofSeconds.flags |= interface_::SLICE_SECONDS;
    c_.dispatch(c_.find(eyeKeyOf(c_, targets_, planned_, interface_::RAYS_OF_GRID)),
                c_.pipelines.volumeLayout(), far ? &push : &ofSeconds, groups(rays.x1 - rays.x0),
                groups(rays.y1 - rays.y0), eye, index);
    if (far) {
      dispatchSpread(interface_::SPREAD_TO_SECONDS, fourths, ofSeconds, eye, index);
      dispatchListed(interface_::SPREAD_TO_SECONDS, eye, index);
    }
    if (spread_.tiles) {
      dispatchTiles(seconds, push, eye, index);
    } else {
      dispatchSpread(interface_::SPREAD_TO_PIXELS, seconds, push, eye, index);
    }
    dispatchListed(interface_::SPREAD_TO_PIXELS, eye, index);
  }

  // `rays`: the numbers of those between which the others are.
  void dispatchSpread(uint32_t to, const PixelRect& rays, const SliceConstants& push,
                      WlkPassStats& eye, uint32_t index) {
    c_.orderShaders();
    c_.dispatch(c_.find(spreadKey(to, spread_)), c_.pipelines.volumeLayout(), &push,
                groups((rays.x1 - rays.x0 + SPREAD_COLUMNS - 1) / SPREAD_COLUMNS),
                groups((rays.y1 - rays.y0 + SPREAD_CELLS - 1) / SPREAD_CELLS), eye, index);
  }

  // Pixels of tiles in which something may be seen; the first volume clears the others where anyone
  // reads them.
  void dispatchTiles(const PixelRect& seconds, const SliceConstants& push, WlkPassStats& eye,
                     uint32_t index) {
    constexpr uint32_t EDGE = interface_::TILE_SECONDS;
    constexpr uint32_t ROW = EDGE * interface_::ROW_TILES;
    c_.orderShaders();
    c_.dispatch(c_.find(tilesKey()), c_.pipelines.volumeLayout(), &push,
                groups((seconds.x1 - seconds.x0 + ROW - 1) / ROW),
                groups((seconds.y1 - seconds.y0 + EDGE - 1) / EDGE), eye, index);
    orderLists();
    if (first_ && !onlyTilesSeen(c_, targets_)) {
      c_.dispatchIndirect(c_.find(clearKey(spread_.distance)), lists(),
                          4 * VkDeviceSize{interface_::CLEAR_LIST}, eye, index);
      c_.orderShaders();  // one reads the buffer of lists, the other writes
    }
    c_.dispatchIndirect(c_.find(spreadKey(interface_::SPREAD_TO_PIXELS, spread_)), lists(),
                        4 * VkDeviceSize{interface_::TILE_LIST}, eye, index);
  }

  // Rays of what the last spread has asked for.
  void dispatchListed(uint32_t to, WlkPassStats& eye, uint32_t index) {
    const VkDeviceSize list = to == interface_::SPREAD_TO_SECONDS ? 0 : interface_::LIST_SIZE;
    orderLists();
    c_.dispatchIndirect(c_.find(eyeKeyOf(c_, targets_, planned_, interface_::RAYS_OF_LIST)),
                        lists(), 4 * list, eye, index);
  }

  void orderLists() {
    c_.barrier({COMPUTE, SHADER_ACCESS}, {COMPUTE | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                                          SHADER_ACCESS | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
  }

  VkBuffer lists() const { return c_.view.resources.volumeState.handle(); }

  // Pixels whose froxels are marched: surfaces are in none, so that the first volume clears them.
  const PixelRect& froxelsOf() const {
    return rank_ == 0 ? c_.view.plan.volumeRect : planned_.rect;
  }

  EyeTarget pixelTarget() const {
    const ViewResources& r = c_.view.resources;
    return {c_.slot.volumes[rank_], r.uniforms,   c_.in.slot * r.slotStride,
            volumeOffset(),         r.frameState, r.volumeState ? r.volumeState : r.frameState};
  }

  EyeTarget froxelTarget() const {
    const AerialResources& a = c_.view.resources.aerial;
    return {c_.slot.froxels[rank_],
            a.uniforms,
            c_.in.slot * a.slotStride,
            aerialVolumeOffset(c_.view, c_.in.slot, rank_),
            a.frameState,
            a.volumeState ? a.volumeState : a.frameState};
  }

  void use(const EyeTarget& target) {
    c_.vk.CmdBindDescriptorSets(c_.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                c_.pipelines.volumeLayout(), 0, 1, &target.set.set, 0, nullptr);
  }

  VkDeviceSize volumeOffset() const {
    const ViewResources& r = c_.view.resources;
    return (c_.in.slot + 1) * r.slotStride - (r.volumeCapacity - rank_) * r.volumeStride;
  }

  // Returns the volume's constants.
  VolumeUniforms bind(const vk::Image& light) {
    if (marchesFroxels(c_)) {
      PlannedVolume froxels = covered_;
      froxels.rect = froxelRect(froxelsOf(), c_.view);
      write(froxelTarget(), froxels, light);
    }
    const EyeTarget pixels = pixelTarget();
    const VolumeUniforms uniforms = write(pixels, covered_, light);
    use(pixels);
    return uniforms;
  }

  VolumeUniforms write(const EyeTarget& target, const PlannedVolume& covered,
                       const vk::Image& light) {
    const ViewResources& r = c_.view.resources;
    BoundSet& set = target.set;
    VolumeUniforms uniforms;
    const double* position = c_.view.camera.position;
    fillVolume(*volume_.state, covered, {position[0], position[1], position[2]}, c_.quality,
               uniforms);
    std::memcpy(static_cast<char*>(target.uniforms.data()) + target.volume, &uniforms,
                sizeof uniforms);

    Bindings& b = c_.bindings;
    b.buffer(set, vk::BIND_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, target.uniforms.handle(),
             target.frame, sizeof(FrameUniforms));
    b.buffer(set, vk::BIND_VOLUME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, target.uniforms.handle(),
             target.volume, sizeof(VolumeUniforms));
    b.image(set, vk::BIND_LIGHT_STORAGE, light.view(), VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_LIGHT_SAMPLED, light.view(), c_.pipelines.linear(),
            VK_IMAGE_LAYOUT_GENERAL);
    bindFields(set);
    b.image(set, vk::BIND_TABLE, volume_.state->tables[c_.quality.form()].image.view(),
            c_.pipelines.linear(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    b.buffer(set, vk::BIND_FOG_CURVE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, r.uniforms.handle(),
             c_.in.slot * r.slotStride + r.fogOffset, FOG_CURVE_BYTES);
    b.image(set, vk::BIND_DEPTH, targets_.depth ? targets_.depth.view : c_.in.dummy2d,
            c_.pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    bindSkyLookup(b, c_.pipelines, r, set, {vk::BIND_SKY_TABLE, vk::BIND_SKY_PEAK}, c_.in);
    b.image(set, vk::BIND_VIEW_SOURCE, r.viewSource ? r.viewSource.view() : c_.in.dummy3d,
            c_.pipelines.linear(),
            r.viewSource ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    b.image(set, vk::BIND_VIEW_AMBIENT, r.viewAmbient ? r.viewAmbient.view() : c_.in.dummy3d,
            c_.pipelines.linear(),
            r.viewAmbient ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    b.buffer(set, vk::BIND_FRAME_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
             target.frameState.handle(), 0, target.frameState.size());
    b.buffer(set, vk::BIND_VOLUME_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
             target.volumeState.handle(), 0, target.volumeState.size());
    b.texels(set, vk::BIND_SECOND_TEXELS, target.volumeState);
    const vk::Buffer& distances = r.distances ? r.distances : r.frameState;
    b.buffer(set, vk::BIND_DISTANCES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, distances.handle(), 0,
             distances.size());
    return uniforms;
  }

  void bindFields(BoundSet& set) {
    for (uint32_t i = 0; i < WLK_MAX_FIELDS; ++i) {
      VkImageView view = c_.in.dummy3d;
      if (i < volume_.state->fieldCount) {
        const FieldState& field = volume_.state->fields[i];
        if (field.external) {
          view = volume_.externalViews[i];
        } else if (field.image) {
          view = field.image.view();
        }
      }
      c_.bindings.image(set, vk::BIND_FIELD0 + i, view, c_.pipelines.linear(),
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    const vk::Image& pages = volume_.state->pages;
    c_.bindings.image(set, vk::BIND_PAGES, pages ? pages.view() : c_.in.dummy3d,
                      c_.pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    const vk::Image& leaps = volume_.state->leaps;
    c_.bindings.image(set, vk::BIND_LEAPS, leaps ? leaps.view() : c_.in.dummy3d,
                      c_.pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    const vk::Image& diameters = volume_.state->diameters;
    c_.bindings.image(set, vk::BIND_DIAMETERS, diameters ? diameters.view() : c_.in.dummy3d,
                      c_.pipelines.linear(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }

  FrameCommands& c_;
  const ViewTargets& targets_;
  const PlannedVolume& planned_;
  const RecordVolume& volume_;
  uint32_t rank_;
  bool first_;
  SpreadVariant spread_;
  PlannedVolume covered_{};  // with the pixels that the eye's pass runs over
};

}  // namespace

bool onlyTilesSeen(const FrameCommands& c, const ViewTargets& targets) {
  const Plan& plan = c.view.plan;
  return c.view.info.composite == WLK_COMPOSITE_BLEND && plan.airKind() == 0 && !plan.fog &&
         plan.drawnCount == 1 && plan.surfaceCount == 0 && !targets.volumeDistance &&
         marchesGrid(c, plan.volumes[0]) && spreadOf(c, targets, plan.volumes[0], true).tiles;
}

void findVolumePipelines(const FrameCommands& commands, const ViewTargets& targets,
                         const PlannedVolume& planned, bool first) {
  if (!planned.drawn) {
    return;
  }
  if (marchesGrid(commands, planned)) {
    commands.find(eyeKeyOf(commands, targets, planned, interface_::RAYS_OF_GRID));
    commands.find(eyeKeyOf(commands, targets, planned, interface_::RAYS_OF_LIST));
    const SpreadVariant variant = spreadOf(commands, targets, planned, first);
    for (const uint32_t to : SPREADS) {
      commands.find(spreadKey(to, variant));
    }
    if (variant.tiles) {
      commands.find(tilesKey());
      commands.find(clearKey(variant.distance));
    }
  } else {
    commands.find(eyeKeyOf(commands, targets, planned, interface_::RAYS_OF_PIXELS));
  }
  if (marchesFroxels(commands)) {
    commands.find(eyeKeyOf(commands, targets, planned, interface_::RAYS_OF_FROXELS));
  }
  const RecordVolume& volume = commands.in.volumes[planned.index];
  const uint32_t fields = volume.state->fieldKind();
  commands.find(lightKeyOf(commands, volume));
  if (volume.store == nullptr && !commands.view.resources.lightBuffer) {
    fail(WLK_ERROR_NOT_PREPARED, 0, "view", "call wlkPrepare before recording");
  }
  for (const vk::Pass pass : TRANSPORT_PASSES) {
    if (commands.quality.transport && planned.lit) {
      commands.find(transportKey(pass, fields));
    }
  }
  for (const vk::Pass pass : AMBIENT_PASSES) {
    if (planned.ambient) {
      commands.find(ambientKey(pass, fields));
    }
  }
}

void recordVolume(FrameCommands& commands, const ViewTargets& targets, const PlannedVolume& planned,
                  bool first) {
  VolumeRecorder(commands, targets, planned, first).run();
}

}  // namespace welkin
