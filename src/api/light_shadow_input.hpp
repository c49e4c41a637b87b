// SPDX-License-Identifier: MIT
// The engine's shadow map as a frame wants it.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Throws WRONG_STATE if the view's quality has no shadows by maps, INVALID_ARGUMENT.
LightShadow lightShadowOf(const WlkContext_T& context, const ViewState& view,
                          const WlkLightShadow* shadow);

// Depth values as `shadow` describes them, on their way to the GPU: makes image and buffer of their
// size in the view, headless. Throws INVALID_ARGUMENT, OUT_OF_*; then the view is as before.
void stageShadowDepth(WlkContext_T& context, ViewState& view, const WlkHeadlessInputs& targets,
                      uint32_t cascades);

}  // namespace welkin
