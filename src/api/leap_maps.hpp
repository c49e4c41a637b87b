// SPDX-License-Identifier: MIT
// Which volumes tell rays how far they may leap through empty bricks.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Makes the maps of volumes that are empty enough, and lets go of others; views whose passes change
// need preparing again.
void prepareLeaps(WlkContext_T& context);

// The field's bricks have changed: has the next update write the map anew. Strong guarantee.
void renewLeaps(WlkContext_T& context, uint64_t volume, const VolumeState& state);

// Writes the map to be copied.
void fillLeaps(VolumeState& volume, const vk::Buffer& staging);

// A copy on its way to all of an image, its staging buffer not written yet.
PendingUpload makePending(vk::Device& device, uint64_t volume, uint32_t field, const Edges& texels,
                          uint64_t texelBytes);

}  // namespace welkin
