// SPDX-License-Identifier: MIT
#include "frame/ambient_record.hpp"

#include <algorithm>
#include <cstring>

#include "frame/ambient.hpp"
#include "frame/resources.hpp"

namespace welkin {
namespace {

using interface_::AmbientPush;
using interface_::AmbientUniforms;

// Rounds over the finest level, the one below it in each of those, and over the coarsest.
constexpr uint32_t ROUNDS = 3;
constexpr uint32_t MIDDLE_ROUNDS = 2;
constexpr uint32_t COARSE_ROUNDS = 6;
constexpr uint32_t GROUP = 64;

class AmbientRecorder {
 public:
  AmbientRecorder(FrameCommands& commands, const std::array<uint32_t, 3>& cells, uint32_t fields,
                  bool whole, WlkPassStats& stats)
      : c_(commands),
        cells_(cells),
        fields_(fields),
        whole_(whole),
        sizes_(transportSizes(cells)),
        stats_(stats) {}

  void compute() {
    for (uint32_t level = 0; level < interface_::TRANSPORT_LEVELS; ++level) {
      dispatch(vk::Pass::AmbientCells, level, 0, sizes_.cells[level], 1);
    }
    dispatch(vk::Pass::AmbientSource, 0, 0, sizes_.cells[0], 1);
    sweep(0, interface_::AMBIENT_ALONE);
    for (uint32_t round = 0; round < ROUNDS; ++round) {
      cycle(0);
    }
    sweep(0, whole_ ? interface_::AMBIENT_WHOLE : 0);
  }

  void show() { dispatch(vk::Pass::AmbientView, 0, 0, sizes_.cells[0], 1); }

 private:
  void sweep(uint32_t level, uint32_t flags) {
    const uint32_t x = cells_[0] >> level;
    const uint32_t y = cells_[1] >> level;
    const uint32_t z = cells_[2] >> level;
    const uint32_t from = level == 0 ? interface_::AMBIENT_INCOMING : 0;
    dispatch(vk::Pass::AmbientSweep, level, from | (flags & interface_::AMBIENT_ALONE),
             std::max({x * y, y * z, z * x}), interface_::AMBIENT_DIRECTIONS);
    dispatch(vk::Pass::AmbientGather, level, flags, sizes_.cells[level], 1);
  }

  // One round of scattering, then what the coarser levels know about all that follow.
  void cycle(uint32_t level) {
    sweep(level, 0);
    const uint32_t below = level + 1;
    uint32_t flags = 0;
    if (below < interface_::TRANSPORT_LEVELS) {
      dispatch(vk::Pass::AmbientRestrict, below, 0, sizes_.cells[below],
               interface_::TRANSPORT_TERMS);
      dispatch(vk::Pass::AmbientSource, below, 0, sizes_.cells[below], 1);
      const bool last = below + 1 == interface_::TRANSPORT_LEVELS;
      for (uint32_t round = 0; round < (last ? COARSE_ROUNDS : MIDDLE_ROUNDS); ++round) {
        cycle(below);
      }
      flags = interface_::AMBIENT_COARSER;
    }
    dispatch(vk::Pass::AmbientSource, level, flags, sizes_.cells[level], 1);
  }

  void dispatch(vk::Pass pass, uint32_t level, uint32_t flags, uint32_t threads, uint32_t rows) {
    c_.vk.CmdBindPipeline(c_.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                          c_.find(ambientKey(pass, fields_)));
    const AmbientPush push{level, flags, 0, 0};
    c_.vk.CmdPushConstants(c_.commands, c_.pipelines.ambientLayout(), VK_SHADER_STAGE_COMPUTE_BIT,
                           0, sizeof push, &push);
    const uint32_t count = (threads + GROUP - 1) / GROUP;
    c_.vk.CmdDispatch(c_.commands, count, rows, 1);
    stats_.recorded = 1;
    stats_.commands += 1;
    stats_.invocations += uint64_t{count} * GROUP * rows;
    c_.view.record.stats.dispatches += 1;
    c_.orderShaders();
  }

  FrameCommands& c_;
  std::array<uint32_t, 3> cells_;
  uint32_t fields_;
  bool whole_;
  TransportSizes sizes_;
  WlkPassStats& stats_;
};

// Whether the grid holds what it would be computed from now; remembers it.
bool remembered(TransportGrid& grid, const AmbientUniforms& uniforms,
                const std::array<uint64_t, AMBIENT_IDS>& ids) {
  constexpr size_t SIZE = sizeof uniforms + sizeof ids;
  std::array<char, SIZE> now;
  std::memcpy(now.data(), &uniforms, sizeof uniforms);
  std::memcpy(now.data() + sizeof uniforms, ids.data(), sizeof ids);
  const bool same = grid.key.size() == SIZE && std::memcmp(grid.key.data(), now.data(), SIZE) == 0;
  grid.key.assign(now.begin(), now.end());  // reserved
  return same;
}

// True if a field is an image that the engine may have written since.
bool bindFields(Bindings& bindings, BoundSet& set, const FrameCommands& c,
                const RecordVolume& volume) {
  bool external = false;
  for (uint32_t i = 0; i < WLK_MAX_FIELDS; ++i) {
    VkImageView image = c.in.dummy3d;
    if (i < volume.state->fieldCount && volume.state->fields[i].external) {
      image = volume.externalViews[i];
      external = true;
    } else if (i < volume.state->fieldCount && volume.state->fields[i].image) {
      image = volume.state->fields[i].image.view();
    }
    bindings.image(set, vk::BIND_AMBIENT_FIELD0 + i, image, c.pipelines.linear(),
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  bindings.image(set, vk::BIND_AMBIENT_PAGES,
                 volume.state->pages ? volume.state->pages.view() : c.in.dummy3d,
                 c.pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  return external;
}

}  // namespace

void recordAmbient(FrameCommands& c, const PlannedVolume& planned, VkDeviceSize viewUniforms,
                   WlkPassStats& stats) {
  ViewResources& r = c.view.resources;
  const RecordVolume& volume = c.in.volumes[planned.index];
  const VolumeState& state = *volume.state;
  const TransportShape shape = transportShape(state, c.quality.ambientCells);
  AmbientGrid& light = *r.ambientGrids[planned.index];
  TransportGrid& grid = light.grid;
  BoundSet& set = c.slot.ambient[planned.index];
  const VkDeviceSize offset =
      c.in.slot * r.slotStride + r.ambientOffset + planned.index * r.ambientStride;
  AmbientUniforms uniforms;
  fillAmbient(state, shape, state.ambient[planned.ambientWhole ? 1 : 0], uniforms);
  std::memcpy(static_cast<char*>(r.uniforms.data()) + offset, &uniforms, sizeof uniforms);

  Bindings& b = c.bindings;
  b.buffer(set, vk::BIND_AMBIENT_UNIFORMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
           offset, sizeof uniforms);
  b.buffer(set, vk::BIND_AMBIENT_WORK, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, r.ambientWork.handle(), 0,
           r.ambientWork.size());
  b.buffer(set, vk::BIND_AMBIENT_KEPT, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, grid.kept.handle(), 0,
           grid.kept.size());
  b.image(set, vk::BIND_AMBIENT_TARGET, r.viewAmbient.view(), VK_NULL_HANDLE,
          VK_IMAGE_LAYOUT_GENERAL);
  b.buffer(set, vk::BIND_AMBIENT_VIEW, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
           viewUniforms, sizeof(interface_::VolumeUniforms));
  const bool external = bindFields(b, set, c, volume);
  c.vk.CmdBindDescriptorSets(c.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                             c.pipelines.ambientLayout(), 0, 1, &set.set, 0, nullptr);
  AmbientRecorder recorder(c, shape.cells, state.fieldKind(), planned.ambientWhole, stats);
  std::array<uint64_t, AMBIENT_IDS> ids{planned.id, state.version, planned.ambientWhole ? 1U : 0U};
  for (uint32_t i = 0; i < state.fieldCount; ++i) {
    if (state.fields[i].external) {
      std::memcpy(&ids[3 + i], &volume.externalViews[i], sizeof ids[3 + i]);
    }
  }
  const bool same = remembered(grid, uniforms, ids);
  // Once a frame, by whichever view comes first.
  const bool written = (external || light.external) && light.frame != c.in.frameIndex;
  stats.reason = c.quality.noSkip ? uint32_t{WLK_REASON_NO_SKIP_FLAG} : planned.ambientReason;
  if (!same || c.quality.noSkip || written) {
    if (!same || written) {
      stats.reason = planned.ambientReason;
    }
    recorder.compute();
  } else {
    stats.reason = WLK_REASON_UNCHANGED;
  }
  light.external = external;
  light.frame = c.in.frameIndex;
  recorder.show();
}

}  // namespace welkin
