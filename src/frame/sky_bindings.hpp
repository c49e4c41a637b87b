// SPDX-License-Identifier: MIT
// Descriptors of the light that was scattered more than once: moments and the view's tables.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"

namespace welkin {

struct SkyLookupBindings {
  uint32_t table;
  uint32_t peak;
};

// The moments, or an image in their place where there are none.
VkImageView momentsOf(const RecordInput& in);
// What fog scatters of other light, likewise.
VkImageView fogLightOf(const RecordInput& in);

// For the pass that writes the tables.
void bindSkyTable(Bindings& bindings, const vk::Pipelines& pipelines, const ViewResources& r,
                  BoundSet& set, const RecordInput& in);

// For the passes that read them.
void bindSkyLookup(Bindings& bindings, const vk::Pipelines& pipelines, const ViewResources& r,
                   BoundSet& set, const SkyLookupBindings& at, const RecordInput& in);

}  // namespace welkin
