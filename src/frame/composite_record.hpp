// SPDX-License-Identifier: MIT
// The composite of a view: which pipeline draws it and what it reads.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"

namespace welkin {

// Of the pipelines that were prepared the one that shows the plan best.
vk::PipelineKey compositeKeyOf(const vk::Pipelines& pipelines, const ViewState& view, bool depth);

void bindComposite(Bindings& bindings, const vk::Pipelines& pipelines, ViewState& view,
                   const ViewTargets& targets, const RecordInput& in, VkDeviceSize counterOffset);

}  // namespace welkin
