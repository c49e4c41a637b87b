// SPDX-License-Identifier: MIT
// Numbers of the parity cases, for GLSL and C++.
const int CASE_NUMERIC = 0;
const int CASE_BOX = 1;
const int CASE_ALTITUDE = 2;
const int CASE_GROUND = 3;
const int CASE_PHASE = 4;
const int CASE_FOG_PARAMETERS = 5;
const int CASE_FOG_PHASE = 6;
const int CASE_SCATTERING_TABLE = 7;
const int CASE_SLICES = 8;
const int CASE_COMPOSITE = 9;
const int CASE_SEGMENT = 10;
const int CASE_FLAT_SEGMENT = 11;
const int CASE_LIGHT = 12;
const int CASE_AIR_DEPTH = 13;
const int CASE_AIR = 14;
const int CASE_SAMPLE = 15;
const int CASE_CURVE = 16;
const int CASE_CANONICAL = 17;
const int CASE_CHORD = 18;
const int CASE_TANGENT_SLAB = 19;
const int CASE_COLLECTOR = 20;
const int CASE_FOOTPRINT = 21;
const int CASE_SOURCE = 22;
const int CASE_COUNT = 23;
