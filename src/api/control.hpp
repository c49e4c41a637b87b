// SPDX-License-Identifier: MIT
// Governed views between frames: what recording tells the governor, and takes from it.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Before the plan: reads the times of finished frames and settles on this frame's rung.
void beginControl(WlkContext_T& context, ViewState& view);

// With the plan, made from `input`, and context.recordVolumes: looks at the error, and plans once
// more where that asks for another rung. Allocates nothing after wlkPrepare.
void controlPlan(WlkContext_T& context, ViewState& view, PlanInput& input);

}  // namespace welkin
