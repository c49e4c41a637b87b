// SPDX-License-Identifier: MIT
#include "frame/transport_record.hpp"

#include <algorithm>
#include <cstring>

#include "frame/record.hpp"
#include "frame/resources.hpp"

namespace welkin {
namespace {

using interface_::TransportPush;
using interface_::TransportUniforms;

// Rounds over the level that is solved, the one below it in each of those, and over the coarsest.
// On a cumulus of 32^3 cells 4, 5, 6 and 16 rounds give means of 0.989, 0.98, 0.978 and 0.97.
struct Rounds {
  uint32_t begun, solved, middle, coarsest;
};
constexpr Rounds ROUNDS{5, 5, 2, 10};
// Cells of a layer's coarsest level are optically thick, and hold light for long: at optical depth
// 64 the rounds above let a fifth too little through (32 cells). The level that begins from no
// light takes the most: extrapolation would multiply what is missing there.
constexpr Rounds LAYER_ROUNDS{14, 5, 2, 20};
constexpr uint32_t GROUP = 64;

class TransportRecorder {
 public:
  TransportRecorder(const vk::Device& device, const vk::Pipelines& pipelines,
                    VkCommandBuffer commands, const TransportShape& shape, uint32_t fields)
      : vk_(device.vk()),
        pipelines_(pipelines),
        commands_(commands),
        shape_(shape),
        fields_(fields),
        sizes_(transportSizes(shape.cells)),
        rounds_(shape.layer ? LAYER_ROUNDS : ROUNDS) {}

  void compute() {
    if (shape_.layer) {
      const uint32_t directions = transportDirections(0, shape_);
      dispatch(vk::Pass::TransportResponse, 0, 0,
               interface_::RESPONSE_ZENITHS * interface_::RESPONSE_AZIMUTHS + directions +
                   interface_::TRANSPORT_TERMS,
               1);
    }
    dispatch(vk::Pass::TransportDepth, 0, 0, 4 * rays(0), 1);
    for (uint32_t level = 0; level < interface_::TRANSPORT_LEVELS; ++level) {
      dispatch(vk::Pass::TransportCells, level, 0, sizes_.cells[level], 1);
    }
    solve(1, 0);
    dispatch(vk::Pass::TransportExtrapolate, 1, 0, sizes_.cells[1], 1);
    solve(0, interface_::TRANSPORT_COARSER);
    dispatch(vk::Pass::TransportExtrapolate, 0, 0, sizes_.cells[0], 1);
    result.computed = true;
  }

  void show() { dispatch(vk::Pass::TransportView, 0, 0, sizes_.cells[0], 1); }

  TransportCommands result;

 private:
  // Light of a level by itself, from what the coarser one has found or from none.
  void solve(uint32_t level, uint32_t from) {
    sweep(level, interface_::TRANSPORT_FIRST_SWEEP);
    dispatch(vk::Pass::TransportSource, level, interface_::TRANSPORT_SECOND_SWEEP,
             sizes_.cells[level], 1);
    sweep(level, interface_::TRANSPORT_SECOND_SWEEP);
    dispatch(vk::Pass::TransportSource, level, from, sizes_.cells[level], 1);
    const uint32_t rounds = level == 0 ? rounds_.solved : rounds_.begun;
    for (uint32_t round = 0; round < rounds; ++round) {
      cycle(level);
    }
  }

  // At most, of a direction.
  uint32_t rays(uint32_t level) const {
    const uint32_t x = shape_.cells[0] >> level;
    const uint32_t y = shape_.cells[1] >> level;
    const uint32_t z = shape_.cells[2] >> level;
    return std::max({x * y, y * z, z * x});
  }

  void sweep(uint32_t level, uint32_t flags) {
    dispatch(vk::Pass::TransportSweep, level, flags, rays(level),
             transportDirections(level, shape_));
    dispatch(vk::Pass::TransportGather, level, flags, sizes_.cells[level], 1);
  }

  // One round of scattering, then what the coarser levels know about all that follow.
  void cycle(uint32_t level) {
    sweep(level, 0);
    const uint32_t below = level + 1;
    uint32_t flags = 0;
    if (below < interface_::TRANSPORT_LEVELS) {
      dispatch(vk::Pass::TransportRestrict, below, 0, sizes_.cells[below],
               interface_::TRANSPORT_TERMS);
      dispatch(vk::Pass::TransportSource, below, 0, sizes_.cells[below], 1);
      const bool last = below + 1 == interface_::TRANSPORT_LEVELS;
      for (uint32_t round = 0; round < (last ? rounds_.coarsest : rounds_.middle); ++round) {
        cycle(below);
      }
      flags = interface_::TRANSPORT_COARSER;
    }
    dispatch(vk::Pass::TransportSource, level, flags, sizes_.cells[level], 1);
  }

  void dispatch(vk::Pass pass, uint32_t level, uint32_t flags, uint32_t threads, uint32_t rows) {
    vk_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE,
                        pipelines_.find(transportKey(pass, fields_)));
    const TransportPush push{level, flags, 0, 0};
    vk_.CmdPushConstants(commands_, pipelines_.transportLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                         sizeof push, &push);
    const uint32_t groups = (threads + GROUP - 1) / GROUP;
    vk_.CmdDispatch(commands_, groups, rows, 1);
    result.dispatches += 1;
    result.invocations += uint64_t{groups} * GROUP * rows;
    constexpr VkAccessFlags2 WRITE = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    constexpr VkAccessFlags2 READ =
        VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    memoryBarrier(vk_, commands_, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, WRITE},
                  {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, READ | WRITE});
    result.barriers += 1;
  }

  const vk::Dispatch& vk_;
  const vk::Pipelines& pipelines_;
  VkCommandBuffer commands_;
  TransportShape shape_;
  uint32_t fields_;
  TransportSizes sizes_;
  Rounds rounds_;
};

// Whether the grid holds what it would be computed from now; remembers it.
bool remembered(TransportGrid& grid, const TransportUniforms& uniforms, uint64_t volume,
                uint64_t version) {
  const std::array<uint64_t, 2> ids{volume, version};
  const size_t size = sizeof uniforms + sizeof ids;
  std::array<char, sizeof uniforms + sizeof ids> now;
  std::memcpy(now.data(), &uniforms, sizeof uniforms);
  std::memcpy(now.data() + sizeof uniforms, ids.data(), sizeof ids);
  const bool same = grid.key.size() == size && std::memcmp(grid.key.data(), now.data(), size) == 0;
  grid.key.assign(now.begin(), now.end());  // reserved
  return same;
}

}  // namespace

TransportCommands recordTransport(const vk::Device& device, const vk::Pipelines& pipelines,
                                  VkCommandBuffer commands, ViewState& view,
                                  const PlannedVolume& planned, const RecordInput& in,
                                  Bindings& bindings, VkDeviceSize viewUniforms, bool always) {
  ViewResources& r = view.resources;
  const RecordVolume& volume = in.volumes[planned.index];
  const VolumeState& state = *volume.state;
  const TransportShape shape = transportShape(state, view.plan.quality.transportCells);
  TransportGrid& grid = r.grids[planned.index];
  BoundSet& set = r.slots[in.slot].transport[planned.index];
  const VkDeviceSize offset =
      in.slot * r.slotStride + r.transportOffset + planned.index * r.transportStride;
  TransportUniforms uniforms;
  fillTransport(state, view.plan.lights.light[0].toLight, shape, uniforms);
  std::memcpy(static_cast<char*>(r.uniforms.data()) + offset, &uniforms, sizeof uniforms);

  bindings.buffer(set, vk::BIND_TRANSPORT_UNIFORMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                  r.uniforms.handle(), offset, sizeof uniforms);
  bindings.buffer(set, vk::BIND_TRANSPORT_WORK, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                  r.transportWork.handle(), 0, r.transportWork.size());
  bindings.buffer(set, vk::BIND_TRANSPORT_KEPT, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                  grid.kept.handle(), 0, grid.kept.size());
  bindings.buffer(set, vk::BIND_TRANSPORT_PAIRS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                  state.pairTable.handle(), 0, state.pairTable.size());
  bindings.image(set, vk::BIND_TRANSPORT_TARGET, r.viewSource.view(), VK_NULL_HANDLE,
                 VK_IMAGE_LAYOUT_GENERAL);
  bindings.buffer(set, vk::BIND_TRANSPORT_VIEW, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                  r.uniforms.handle(), viewUniforms, sizeof(interface_::VolumeUniforms));
  bool external = false;
  for (uint32_t i = 0; i < WLK_MAX_FIELDS; ++i) {
    VkImageView image = in.dummy3d;
    if (i < state.fieldCount && state.fields[i].external) {
      image = volume.externalViews[i];
      external = true;  // the engine may have written it since
    } else if (i < state.fieldCount && state.fields[i].image) {
      image = state.fields[i].image.view();
    }
    bindings.image(set, vk::BIND_TRANSPORT_FIELD0 + i, image, pipelines.linear(),
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  bindings.image(set, vk::BIND_TRANSPORT_PAGES, state.pages ? state.pages.view() : in.dummy3d,
                 pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  device.vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                    pipelines.transportLayout(), 0, 1, &set.set, 0, nullptr);
  TransportRecorder recorder(device, pipelines, commands, shape, state.fieldKind());
  if (!remembered(grid, uniforms, planned.id, state.version) || always || external) {
    recorder.compute();
  }
  if (external) {
    grid.key.clear();  // what was uploaded may be back in the next frame
  }
  recorder.show();
  return recorder.result;
}

}  // namespace welkin
