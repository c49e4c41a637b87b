// SPDX-License-Identifier: MIT
// Light buffer with optical depth and what forward scattering gives back.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LIGHT_FORMAT rg32f
#include "light_march.glsl"
