// SPDX-License-Identifier: MIT
#include "frame/transport_record.hpp"

#include <algorithm>
#include <cstring>

#include "frame/record.hpp"
#include "frame/resources.hpp"
#include "frame/transport_steps.hpp"

namespace welkin {
namespace {

using interface_::TRANSPORT_GROUP;
using interface_::TransportPush;
using interface_::TransportUniforms;

// Light's direction between two frames beyond which what is known of it is of no use, cosine of 5
// degrees: scattered light changes by its own size within some tens.
constexpr double JUMP = 0.99619469809;

class TransportRecorder {
 public:
  TransportRecorder(const vk::Device& device, const vk::Pipelines& pipelines,
                    VkCommandBuffer commands, const TransportShape& shape, uint32_t fields)
      : vk_(device.vk()),
        pipelines_(pipelines),
        commands_(commands),
        shape_(shape),
        fields_(fields) {}

  void compute(const LightStep& part) {
    TransportSteps(shape_).visit(part.from, part.to, part.parts,
                                 [this](const TransportStep& step, uint32_t first, uint32_t units) {
                                   const bool rows = step.rows > 1;
                                   dispatch(step.pass, {step.level, step.flags, first, 1},
                                            rows ? step.groups : units, rows ? units : 1);
                                 });
  }

  void show(float weight) {
    const uint32_t cells = shape_.cells[0] * shape_.cells[1] * shape_.cells[2];
    dispatch(vk::Pass::TransportView, {0, 0, 0, weight},
             (cells + TRANSPORT_GROUP - 1) / TRANSPORT_GROUP, 1);
  }

  TransportCommands result;

 private:
  void dispatch(vk::Pass pass, const TransportPush& push, uint32_t groups, uint32_t rows) {
    vk_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE,
                        pipelines_.find(transportKey(pass, fields_)));
    vk_.CmdPushConstants(commands_, pipelines_.transportLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                         sizeof push, &push);
    vk_.CmdDispatch(commands_, groups, rows, 1);
    result.dispatches += 1;
    result.invocations += uint64_t{groups} * TRANSPORT_GROUP * rows;
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
};

// What light is computed from.
struct LightKey {
  TransportUniforms uniforms;
  std::array<uint64_t, 2 + WLK_MAX_FIELDS> ids;  // of the volume, its contents, the engine's images
};
static_assert(sizeof(LightKey) == sizeof(TransportUniforms) + TRANSPORT_IDS);

// Bit by bit: no key has padding.
bool equal(const LightKey& a, const LightKey& b) {
  const auto* x = reinterpret_cast<const char*>(&a);
  return std::equal(x, x + sizeof a, reinterpret_cast<const char*>(&b));
}

void remember(std::vector<char>& kept, const LightKey& key) {
  const auto* bytes = reinterpret_cast<const char*>(&key);
  kept.assign(bytes, bytes + sizeof key);  // reserved
}

bool isKept(const std::vector<char>& kept, const LightKey& key) {
  return std::equal(kept.begin(), kept.end(), reinterpret_cast<const char*>(&key),
                    reinterpret_cast<const char*>(&key) + sizeof key);
}

// Whether both are of one volume as it is, under whatever light.
bool sameVolume(const LightKey& a, const LightKey& b) {
  LightKey under = b;
  TransportUniforms& u = under.uniforms;
  std::memcpy(u.directions, a.uniforms.directions, sizeof u.directions);
  std::memcpy(u.rows, a.uniforms.rows, sizeof u.rows);
  std::memcpy(u.lightFrame, a.uniforms.lightFrame, sizeof u.lightFrame);
  u.light = a.uniforms.light;
  u.travel = a.uniforms.travel;
  return equal(a, under);
}

// Against the light that was complete last.
LightChange changeOf(const VolumeLight& light, const LightKey& now, const glm::dvec3& toLight) {
  const std::vector<char>& key = light.grids[light.schedule.newest()].key;
  LightKey before;
  if (key.size() != sizeof before) {
    return LightChange::Other;
  }
  std::memcpy(&before, key.data(), sizeof before);
  const bool near = glm::dot(light.toLight, toLight) >= JUMP;
  if (near && equal(before, now)) {
    // The engine may have written its images since.
    const bool external =
        std::any_of(now.ids.begin() + 2, now.ids.end(), [](uint64_t image) { return image != 0; });
    return external ? LightChange::Moved : LightChange::None;
  }
  return near && sameVolume(before, now) ? LightChange::Moved : LightChange::Other;
}

void bindFields(Bindings& bindings, BoundSet& set, VkSampler sampler, const RecordVolume& volume,
                VkImageView none) {
  const VolumeState& state = *volume.state;
  for (uint32_t i = 0; i < WLK_MAX_FIELDS; ++i) {
    VkImageView image = none;
    if (i < state.fieldCount && state.fields[i].external) {
      image = volume.externalViews[i];
    } else if (i < state.fieldCount && state.fields[i].image) {
      image = state.fields[i].image.view();
    }
    bindings.image(set, vk::BIND_TRANSPORT_FIELD0 + i, image, sampler,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
}

}  // namespace

TransportCommands recordTransport(const vk::Device& device, const vk::Pipelines& pipelines,
                                  VkCommandBuffer commands, ViewState& view,
                                  const PlannedVolume& planned, const RecordInput& in,
                                  Bindings& bindings, VkDeviceSize viewUniforms, bool always) {
  ViewResources& r = view.resources;
  const RecordVolume& volume = in.volumes[planned.index];
  const VolumeState& state = *volume.state;
  const SliceQuality& quality = view.plan.quality;
  const TransportShape shape = transportShape(state, quality.transportCells);
  VolumeLight& light = *r.volumeLights[planned.index];
  const glm::dvec3 toLight = view.plan.lights.light[0].toLight;
  LightKey now{};
  fillTransport(state, toLight, shape, now.uniforms);
  now.ids = {planned.id, state.version};
  for (uint32_t i = 0; i < state.fieldCount; ++i) {
    if (state.fields[i].external) {
      std::memcpy(&now.ids[2 + i], &volume.externalViews[i], sizeof now.ids[2 + i]);
    }
  }
  if (!always && light.frame == in.frameIndex && isKept(light.key, now)) {
    // Another view of the frame has seen to it.
    light.step.to = 0;
    light.step.begins = false;
  } else {
    light.step = light.schedule.next(always ? LightChange::Other : changeOf(light, now, toLight),
                                     quality.lightFrames);
    light.toLight = toLight;
    light.frame = in.frameIndex;
    remember(light.key, now);
  }
  const LightStep& step = light.step;
  if (step.begins) {
    remember(light.grids[step.target].key, now);
  }

  // Makes a grid that of the passes that follow.
  const auto use = [&](uint32_t index) {
    const uint32_t place = planned.index * r.transportLights + index;
    const TransportGrid& grid = light.grids[index];
    const TransportWork& work = light.work.sources ? light.work : r.transportWork;
    BoundSet& set = r.slots[in.slot].transport[place];
    const VkDeviceSize offset =
        in.slot * r.slotStride + r.transportOffset + place * r.transportStride;
    std::memcpy(static_cast<char*>(r.uniforms.data()) + offset, grid.key.data(),
                sizeof(TransportUniforms));
    bindings.buffer(set, vk::BIND_TRANSPORT_UNIFORMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                    r.uniforms.handle(), offset, sizeof(TransportUniforms));
    bindings.buffer(set, vk::BIND_TRANSPORT_WORK, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                    work.sources.handle(), 0, work.sources.size());
    bindings.buffer(set, vk::BIND_TRANSPORT_SWEPT, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                    work.swept.handle(), 0, work.swept.size());
    bindings.buffer(set, vk::BIND_TRANSPORT_KEPT, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                    grid.kept.handle(), 0, grid.kept.size());
    bindings.buffer(set, vk::BIND_TRANSPORT_PAIRS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                    state.pairTable.handle(), 0, state.pairTable.size());
    bindings.image(set, vk::BIND_TRANSPORT_TARGET, r.viewSource.view(), VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_GENERAL);
    bindings.buffer(set, vk::BIND_TRANSPORT_VIEW, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                    r.uniforms.handle(), viewUniforms, sizeof(interface_::VolumeUniforms));
    bindFields(bindings, set, pipelines.linear(), volume, in.dummy3d);
    bindings.image(set, vk::BIND_TRANSPORT_PAGES, state.pages ? state.pages.view() : in.dummy3d,
                   pipelines.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    device.vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                      pipelines.transportLayout(), 0, 1, &set.set, 0, nullptr);
  };
  TransportRecorder recorder(device, pipelines, commands, shape, state.fieldKind());
  if (step.computes()) {
    use(step.target);
    recorder.compute(step);
  }
  if (step.weight < 1) {
    use(step.before);
    recorder.show(1);
  }
  use(step.shown);
  recorder.show(step.weight);
  recorder.result.reason = step.computes() && step.parts == 1   ? planned.lightReason
                           : step.computes() || step.weight < 1 ? uint32_t{WLK_REASON_SPREAD}
                                                                : uint32_t{WLK_REASON_UNCHANGED};
  return recorder.result;
}

}  // namespace welkin
