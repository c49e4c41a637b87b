// SPDX-License-Identifier: MIT
#include "frame/shadow_map_record.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "failure.hpp"
#include "frame/record.hpp"

namespace welkin {
namespace {

using interface_::ShadowConstants;
using interface_::ShadowVolume;

constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 FILL = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 SUMS =
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr WlkVulkanImageState WRITTEN{VK_IMAGE_LAYOUT_GENERAL, 0, COMPUTE,
                                      VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

vk::PipelineKey volumeKey(uint32_t fields) {
  return ofFields({vk::Pass::ShadowMap, VK_FORMAT_UNDEFINED, {}}, fields);
}

vk::PipelineKey resolveKey() {
  return {vk::Pass::ShadowResolve, VK_FORMAT_UNDEFINED, {}};
}

VkDeviceSize alignUp(VkDeviceSize x, VkDeviceSize alignment) {
  return (x + alignment - 1) / alignment * alignment;
}

uint32_t groups(uint32_t texels) {
  return (texels + 7) / 8;
}

bool external(const VolumeState& volume) {
  return std::any_of(volume.fields.begin(), volume.fields.begin() + volume.fieldCount,
                     [](const FieldState& field) { return field.external.has_value(); });
}

void makeSets(const vk::Device& device, const vk::Pipelines& pipelines, uint32_t count,
              ShadowMapResources& r) {
  const std::array sizes{
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, count},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 5 * count}};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = count;
  info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  vk::check(device.vk().CreateDescriptorPool(device.handle(), &info, nullptr, &r.pool),
            "vkCreateDescriptorPool");
  const VkDescriptorSetLayout layout = pipelines.shadowSetLayout();
  r.sets.resize(count);
  for (BoundSet& set : r.sets) {
    VkDescriptorSetAllocateInfo one{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    one.descriptorPool = r.pool;
    one.descriptorSetCount = 1;
    one.pSetLayouts = &layout;
    vk::check(device.vk().AllocateDescriptorSets(device.handle(), &one, &set.set),
              "vkAllocateDescriptorSets");
  }
}

class ShadowRecorder {
 public:
  ShadowRecorder(const vk::Device& device, const vk::Pipelines& pipelines, VkCommandBuffer commands,
                 ShadowMapState& map, const ShadowMapInput& input, const TargetImage& target,
                 bool half)
      : vk_(device.vk()),
        timestamps_(device.timestamps()),
        pipelines_(pipelines),
        commands_(commands),
        map_(map),
        r_(map.resources),
        in_(input),
        target_(target),
        bindings_(device) {
    const uint32_t content = map.info.content;
    push_.width = map.info.width;
    push_.height = map.info.height;
    push_.flags = (content == WLK_CLOUD_SHADOW_TRANSMITTANCE ? interface_::SHADOW_COLOR : 0) |
                  (content == WLK_CLOUD_SHADOW_LAYER ? interface_::SHADOW_LAYER : 0) |
                  (half ? interface_::SHADOW_HALF : 0) |
                  (input.scattered ? interface_::SHADOW_ABSORBED : 0);
  }

  void run() {
    start();
    uint32_t reason = choose();
    if (unchanged()) {
      reason = WLK_REASON_UNCHANGED;
      if (target_.before.layout != target_.after.layout) {
        image(target_.before, target_.after);
      }
    } else {
      findPipelines();
      record();
    }
    result_.reason = reason;
    result_.descriptorWrites = bindings_.writes();
    map_.last = result_;
    map_.lastFrame = in_.frameIndex;
  }

 private:
  void start() {
    result_ = {};
    result_.frameIndex = in_.frameIndex;
    glm::dvec3 toLight = in_.up;
    if (in_.light != nullptr) {
      toLight = glm::normalize(
          glm::dvec3(in_.light->direction[0], in_.light->direction[1], in_.light->direction[2]));
    }
    layout_ = layoutShadowMap(map_.info, toLight, in_.up);
    const std::array<double, 12> m = mapFromWorld(layout_);
    std::copy(m.begin(), m.end(), result_.mapFromWorld);
  }

  // Whether the map shows the volume, and how.
  bool shows(const ShadowCaster& caster, ShadowVolume& volume, uint32_t& reason) const {
    if (!caster.state->anyDensity()) {
      if (reason == WLK_REASON_NOTHING_TO_DRAW) {
        reason = WLK_REASON_ZERO_DENSITY;
      }
      return false;
    }
    volume = shadowVolume(layout_, map_.info, *caster.state, in_.scattered);
    if (volume.rect.z <= volume.rect.x || volume.rect.w <= volume.rect.y) {
      reason = WLK_REASON_OUTSIDE_VIEW;
      return false;
    }
    return true;
  }

  // Why there is a shadow or not; `now_` becomes what it depends on.
  uint32_t choose() {
    now_.clear();
    append(push_);
    if (in_.light == nullptr) {
      return WLK_REASON_NO_LIGHT;
    }
    uint32_t reason = WLK_REASON_NOTHING_TO_DRAW;
    for (const ShadowCaster& caster : in_.volumes) {
      ShadowVolume volume;
      if (shows(caster, volume, reason)) {
        append(caster.id);
        append(caster.state->version);
        append(volume);
        external_ = external_ || external(*caster.state);
        ++result_.volumes;
      }
    }
    return result_.volumes > 0 ? uint32_t{WLK_REASON_NEEDED} : reason;
  }

  template <typename T>
  void append(const T& value) {
    const auto* bytes = reinterpret_cast<const char*>(&value);
    now_.insert(now_.end(), bytes, bytes + sizeof value);  // reserved
  }

  bool unchanged() const {
    // The engine may have written its volume's image since.
    return !external_ && map_.image == target_.image &&
           map_.mipLevel == target_.range.baseMipLevel &&
           map_.layer == target_.range.baseArrayLayer && r_.key == now_ &&
           target_.before.layout != VK_IMAGE_LAYOUT_UNDEFINED;
  }

  VkPipeline find(const vk::PipelineKey& key) const {
    const VkPipeline pipeline = pipelines_.find(key);
    if (pipeline == VK_NULL_HANDLE) {
      fail(WLK_ERROR_NOT_PREPARED, 0, "map", "call wlkPrepare before recording");
    }
    return pipeline;
  }

  void findPipelines() const {
    find(resolveKey());
    for (const ShadowCaster& caster : in_.volumes) {
      find(volumeKey(caster.state->fieldKind()));
    }
    if (in_.volumes.size() > r_.volumeCapacity) {
      fail(WLK_ERROR_NOT_PREPARED, 0, "map", "call wlkPrepare before recording");
    }
  }

  void record() {
    vk_.CmdResetQueryPool(commands_, r_.queries, 2 * in_.slot, 2);
    timestamp(2 * in_.slot);
    image(target_.before, WRITTEN);
    // The frame before may still read the sums.
    barrier(COMPUTE, SUMS, FILL, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    vk_.CmdFillBuffer(commands_, r_.sums.handle(), 0, VK_WHOLE_SIZE, 0);
    barrier(FILL, VK_ACCESS_2_TRANSFER_WRITE_BIT, COMPUTE, SUMS);
    uint32_t rank = 0;
    for (const ShadowCaster& caster : in_.volumes) {
      ShadowVolume volume;
      uint32_t reason = 0;
      if (in_.light != nullptr && shows(caster, volume, reason)) {
        std::memcpy(static_cast<char*>(r_.uniforms.data()) + uniformsOf(rank), &volume,
                    sizeof volume);
        bind(&caster, rank++);
        dispatch(find(volumeKey(caster.state->fieldKind())),
                 static_cast<uint32_t>(volume.rect.z - volume.rect.x),
                 static_cast<uint32_t>(volume.rect.w - volume.rect.y));
        barrier(COMPUTE, SUMS, COMPUTE, SUMS);
      }
    }
    bind(nullptr, rank);
    dispatch(find(resolveKey()), map_.info.width, map_.info.height);
    image(WRITTEN, target_.after);
    timestamp(2 * in_.slot + 1);
    r_.slots[in_.slot].frameIndex = in_.frameIndex;
    result_.recorded = 1;
    map_.image = target_.image;
    map_.mipLevel = target_.range.baseMipLevel;
    map_.layer = target_.range.baseArrayLayer;
    std::swap(r_.key, now_);
    if (external_) {
      r_.key.clear();  // what was uploaded may be back in the next frame
    }
  }

  void timestamp(uint32_t query) {
    if (timestamps_) {
      vk_.CmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, r_.queries, query);
    }
  }

  VkDeviceSize uniformsOf(uint32_t rank) const {
    return (in_.slot * (r_.volumeCapacity + 1) + rank) * r_.stride;
  }

  // The image and, of a volume's pass, its fields. Every binding is written: lavapipe looks at all.
  void bind(const ShadowCaster* caster, uint32_t rank) {
    BoundSet& set = r_.sets[in_.slot * (r_.volumeCapacity + 1) + rank];
    bindings_.buffer(set, vk::BIND_SHADOW_VOLUME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                     r_.uniforms.handle(), uniformsOf(rank), sizeof(ShadowVolume));
    bindings_.buffer(set, vk::BIND_SHADOW_SUMS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, r_.sums.handle(),
                     0, r_.sums.size());
    bindings_.image(set, vk::BIND_SHADOW_TARGET, target_.view, VK_NULL_HANDLE,
                    VK_IMAGE_LAYOUT_GENERAL);
    for (uint32_t i = 0; i < WLK_MAX_FIELDS; ++i) {
      VkImageView view = in_.dummy3d;
      if (caster != nullptr && i < caster->state->fieldCount) {
        const FieldState& field = caster->state->fields[i];
        if (field.external) {
          view = caster->externalViews[i];
        } else if (field.image) {
          view = field.image.view();
        }
      }
      bindings_.image(set, vk::BIND_SHADOW_FIELD0 + i, view, pipelines_.linear(),
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    const bool pages = caster != nullptr && caster->state->pages;
    bindings_.image(set, vk::BIND_SHADOW_PAGES, pages ? caster->state->pages.view() : in_.dummy3d,
                    pipelines_.nearest(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    vk_.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_.shadowLayout(),
                              0, 1, &set.set, 0, nullptr);
  }

  void dispatch(VkPipeline pipeline, uint32_t width, uint32_t height) {
    vk_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vk_.CmdPushConstants(commands_, pipelines_.shadowLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                         sizeof push_, &push_);
    vk_.CmdDispatch(commands_, groups(width), groups(height), 1);
    result_.commands += 1;
    result_.invocations += uint64_t{64} * groups(width) * groups(height);
  }

  void barrier(VkPipelineStageFlags2 fromStage, VkAccessFlags2 fromAccess,
               VkPipelineStageFlags2 toStage, VkAccessFlags2 toAccess) {
    memoryBarrier(vk_, commands_, {fromStage, fromAccess}, {toStage, toAccess});
    result_.barriers += 1;
  }

  void image(const WlkVulkanImageState& from, const WlkVulkanImageState& to) {
    imageBarrier(vk_, commands_, target_.image, target_.range, from, to);
    result_.barriers += 1;
  }

  const vk::Dispatch& vk_;
  bool timestamps_;
  const vk::Pipelines& pipelines_;
  VkCommandBuffer commands_;
  ShadowMapState& map_;
  ShadowMapResources& r_;
  const ShadowMapInput& in_;
  const TargetImage& target_;
  Bindings bindings_;
  std::pmr::vector<char>& now_ = r_.now;
  ShadowLayout layout_;
  ShadowConstants push_{};
  WlkCloudShadowState result_{};
  bool external_ = false;
};

}  // namespace

void prepareShadowMap(vk::Device& device, vk::Pipelines& pipelines, const WlkCloudShadowInfo& info,
                      uint32_t volumeCount, uint32_t framesInFlight,
                      std::span<const uint32_t> fieldKinds, ShadowMapResources& made) {
  pipelines.prepare(resolveKey());
  for (const uint32_t fields : fieldKinds) {
    pipelines.prepare(volumeKey(fields));
  }
  try {
    made.volumeCapacity = volumeCount;
    made.stride = alignUp(
        sizeof(ShadowVolume),
        std::max<VkDeviceSize>(device.properties().limits.minUniformBufferOffsetAlignment, 16));
    made.uniforms = vk::Buffer(device, made.stride * (volumeCount + 1) * framesInFlight,
                               VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, true);
    const VkDeviceSize floats = info.content == WLK_CLOUD_SHADOW_LAYER ? 4 : 1;
    const VkDeviceSize bytes = VkDeviceSize{info.width} * info.height * floats * sizeof(float);
    if (bytes > device.properties().limits.maxStorageBufferRange) {
      fail(WLK_ERROR_LIMIT_EXCEEDED, info.sType, "width",
           "%u x %u texels exceed the device's storage buffers", info.width, info.height);
    }
    made.sums =
        vk::Buffer(device, bytes,
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false);
    makeSets(device, pipelines, framesInFlight * (volumeCount + 1), made);
    made.slots.resize(framesInFlight);
    const size_t key =
        sizeof(ShadowConstants) + volumeCount * (sizeof(ShadowVolume) + 2 * sizeof(uint64_t));
    made.key.reserve(key);
    made.now.reserve(key);
    VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = 2 * framesInFlight;
    vk::check(device.vk().CreateQueryPool(device.handle(), &queries, nullptr, &made.queries),
              "vkCreateQueryPool");
  } catch (...) {
    destroyShadowMap(device, made);
    throw;
  }
}

void destroyShadowMap(vk::Device& device, ShadowMapResources& resources) {
  if (resources.queries != VK_NULL_HANDLE) {
    device.vk().DestroyQueryPool(device.handle(), resources.queries, nullptr);
    resources.queries = VK_NULL_HANDLE;
  }
  if (resources.pool != VK_NULL_HANDLE) {
    device.vk().DestroyDescriptorPool(device.handle(), resources.pool, nullptr);
    resources.pool = VK_NULL_HANDLE;
  }
}

void recordShadowMap(const vk::Device& device, const vk::Pipelines& pipelines,
                     VkCommandBuffer commands, ShadowMapState& map, const ShadowMapInput& input,
                     const TargetImage& target, bool half) {
  ShadowRecorder(device, pipelines, commands, map, input, target, half).run();
}

void harvestShadowMap(const vk::Device& device, ShadowMapState& map, uint64_t completed) {
  ShadowMapResources& r = map.resources;
  uint64_t newest = 0;
  for (size_t i = 0; i < r.slots.size(); ++i) {
    ShadowSlot& slot = r.slots[i];
    if (slot.frameIndex == 0 || slot.frameIndex > completed) {
      continue;
    }
    std::array<uint64_t, 2> times{};
    if (device.timestamps() && slot.frameIndex > newest &&
        device.vk().GetQueryPoolResults(device.handle(), r.queries, static_cast<uint32_t>(2 * i), 2,
                                        sizeof times, times.data(), sizeof times[0],
                                        VK_QUERY_RESULT_64_BIT) == VK_SUCCESS) {
      newest = slot.frameIndex;
      map.gpuTime_ns = static_cast<uint64_t>(device.nanoseconds(times[0], times[1]));
    }
    slot.frameIndex = 0;
  }
}

}  // namespace welkin
