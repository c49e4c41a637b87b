// SPDX-License-Identifier: MIT
// Head of every pass: the model text in float, and what is compiled in. A false constant removes
// its code when the pipeline is made; lavapipe would otherwise run every branch.
//
// Most passes copy their uniforms into globals, `frame` from `frameBlock`, which are filled where
// main begins: behind a branch, and so behind an early return, and in a loop lavapipe gathers each
// word for every lane, which took a tenth of a frame of cloud surfaces. What is asked for by an
// index that varies is read from the block, as compilers may keep a copy of that in memory, but
// for short loops over fields, which they unroll.
#define real float
// 0: none; 2: with a gas that absorbs.
layout(constant_id = 0) const uint AIR_KIND = 2u;
layout(constant_id = 1) const bool FOG_ENABLED = true;
layout(constant_id = 2) const uint LIGHT_COUNT = 1u;
const bool AIR_ENABLED = AIR_KIND > 0u;
const bool ABSORBER_ENABLED = AIR_KIND > 1u;
const bool LIGHT_ENABLED = LIGHT_COUNT > 0u;
#include "../model/model.glsl"
#include "../interface/frame.glsl"
