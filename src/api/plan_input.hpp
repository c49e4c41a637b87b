// SPDX-License-Identifier: MIT
// What a plan needs to know of a context and a view.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Without volumes, and with mustWrite left to the caller.
PlanInput planInput(const WlkContext_T& context, const ViewState& view);

// The volume of a slot of the pool; `index` is its place in the caller's list.
PlanVolume planVolume(const WlkContext_T& context, uint32_t slot, uint32_t index,
                      const VolumeState& volume);

}  // namespace welkin
