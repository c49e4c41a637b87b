// SPDX-License-Identifier: MIT
#include "api/volume_media.hpp"

#include <utility>

#include "frame/resources.hpp"
#include "frame/transport.hpp"

namespace welkin {

void renewMedia(WlkContext_T& c, double most) {
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    VolumeState* volume = c.volumes.at(i);
    if (volume == nullptr || !volume->transport || !(mediaChange(*volume) > most)) {
      continue;
    }
    c.retired.reserve(c.retired.size() + 1);
    vk::Buffer old = replaceMedia(*c.device, *volume);
    Retired& entry = c.retired.emplace_back(&c.memory);
    entry.frame = c.frameIndex;
    entry.buffers[0] = std::move(old);
    c.forgetBindings();
    // Light that was kept is of the old mixture.
    ++volume->version;
    for (VolumeAmbient& ambient : volume->ambient) {
      ambient.key.clear();
    }
  }
}

}  // namespace welkin
