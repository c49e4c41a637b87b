// SPDX-License-Identifier: MIT
// Head of every pass: the model text in float, and what is compiled in. A false constant removes
// its code when the pipeline is made; lavapipe would otherwise run every branch.
#define real float
layout(constant_id = 0) const bool AIR_ENABLED = true;
layout(constant_id = 1) const bool FOG_ENABLED = true;
layout(constant_id = 2) const bool LIGHT_ENABLED = true;
#include "../model/model.glsl"
#include "../interface/frame.glsl"
