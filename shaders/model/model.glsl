// SPDX-License-Identifier: MIT
// Every model file, once, in dependency order. GLSL passes define `real` as float, declare the
// constants AIR_ENABLED, FOG_ENABLED and ABSORBER_ENABLED, and include this; C++ includes it
// through src/model/model.hpp in float and in double.
#include "numeric.glsl"
#include "geometry.glsl"
#include "phase/rayleigh.glsl"
#include "phase/fog.glsl"
#include "phase/sample.glsl"
#include "phase/curve.glsl"
#include "sky/segment.glsl"
#include "sky/absorber.glsl"
#include "sky/air.glsl"
#include "sky/riley2004.glsl"
#include "sky/disk.glsl"
#include "volume/slices.glsl"
#include "volume/forward_scattering.glsl"
#include "volume/canonical_slab.glsl"
#include "surface/triangle.glsl"
#include "surface/chord.glsl"
#include "surface/tangent_slab.glsl"
#include "surface/collector.glsl"
#include "composite.glsl"
