// SPDX-License-Identifier: MIT
// Light buffer with optical depth alone, all slabs at once.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LIGHT_FORMAT r32f
#include "light_march.glsl"
