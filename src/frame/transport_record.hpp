// SPDX-License-Identifier: MIT
// Turns the light inside one volume into commands: computed where it is not known yet, and shown to
// a view's eye.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"
#include "frame/transport.hpp"

namespace welkin {

// Bytes of a grid's key beside its uniforms.
constexpr size_t TRANSPORT_IDS = (2 + size_t{WLK_MAX_FIELDS}) * sizeof(uint64_t);

struct TransportCommands {
  uint32_t dispatches = 0;
  uint32_t barriers = 0;
  uint64_t invocations = 0;
  uint32_t reason = WLK_REASON_NEEDED;
};

// `viewUniforms`: range of the volume's constants in this view. Leaves its own descriptor set
// bound, and ends with a barrier for shaders.
TransportCommands recordTransport(const vk::Device& device, const vk::Pipelines& pipelines,
                                  VkCommandBuffer commands, ViewState& view,
                                  const PlannedVolume& planned, const RecordInput& in,
                                  Bindings& bindings, VkDeviceSize viewUniforms, bool always);

}  // namespace welkin
