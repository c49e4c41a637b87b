// SPDX-License-Identifier: MIT
// Reads back what frames left on the GPU: counters and timestamps.
#include <cstring>

#include "frame/record.hpp"

namespace welkin {

void harvest(vk::Device& device, ViewState& view, uint64_t completed) {
  ViewResources& r = view.resources;
  for (size_t i = 0; i < r.slots.size(); ++i) {
    ViewSlot& slot = r.slots[i];
    if (slot.harvested || slot.frameIndex > completed) {
      continue;
    }
    slot.harvested = true;
    uint32_t count = 0;
    std::memcpy(&count,
                static_cast<char*>(r.counters.data()) + r.counters.size() / r.slots.size() * i,
                sizeof count);
    // Slots come up in any order; keep the newest frame's figures.
    if (slot.frameIndex < view.harvestedFrame) {
      continue;
    }
    view.harvestedFrame = slot.frameIndex;
    view.nonFinite = count;
    uint64_t before = 0;
    for (uint32_t query = 0; device.timestamps() && query <= slot.passOfQuery.size(); ++query) {
      uint64_t now = 0;
      if (device.vk().GetQueryPoolResults(device.handle(), slot.queries, query, 1, sizeof now, &now,
                                          sizeof now, VK_QUERY_RESULT_64_BIT) != VK_SUCCESS) {
        break;
      }
      if (query > 0) {
        slot.passes[slot.passOfQuery[query - 1]].nanoseconds +=
            static_cast<uint64_t>(device.nanoseconds(before, now));
      }
      before = now;
    }
    view.record.times.assign(slot.passes.begin(), slot.passes.end());
    if (view.quality.control == WLK_CONTROL_TIME) {
      double time = 0;
      for (const PassTime& pass : view.record.times) {
        time += 1e-6 * static_cast<double>(pass.nanoseconds);
      }
      view.governor.feedTime(slot.frameIndex, time,
                             static_cast<double>(view.quality.timeBudget_ms));
    }
  }
}

}  // namespace welkin
