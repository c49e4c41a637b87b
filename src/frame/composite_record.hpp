// SPDX-License-Identifier: MIT
// The composite of a view: which pipeline draws it and what it reads.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"
#include "frame/resources.hpp"

namespace welkin {

// What the plan asks of the passes that draw a layer.
CompositeVariant compositeVariant(const ViewState& view, bool depth);

// Of the pipelines that were prepared the one that shows the plan best.
// `tiles`: by tiles, see onlyTilesSeen.
vk::PipelineKey compositeKeyOf(const vk::Pipelines& pipelines, const ViewState& view, bool depth,
                               bool tiles);

// What passes that draw a layer read, the frame's constants and the volumes' state excepted.
void bindLayer(Bindings& bindings, const vk::Pipelines& pipelines, const ViewState& view,
               const ViewTargets& targets, BoundSet& set, const RecordInput& in,
               VkDeviceSize counterOffset);

void bindComposite(Bindings& bindings, const vk::Pipelines& pipelines, ViewState& view,
                   const ViewTargets& targets, const RecordInput& in, VkDeviceSize counterOffset);

}  // namespace welkin
