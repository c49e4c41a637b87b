// SPDX-License-Identifier: MIT
// Light scattered more than once, made ready for the GPU when the air changes.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Solves for the present air if a view shows its multiple scattering and the moments are of another
// one; takes 0.1 to 0.4 s then. They wait in context.skyLight.staging for recordUpdate.
void prepareSkyLight(WlkContext_T& context);

// The same a few rows at a time, some 4 ms of CPU time per call, while frames show the light of the
// air before; the first air is solved at once. An air that changes again waits until the work at
// hand is done: 24 calls in clear air, 42 to 124 with fog.
void advanceSkyLight(WlkContext_T& context);

}  // namespace welkin
