// SPDX-License-Identifier: MIT
// Composites a view by blending: target = radiance + target * transmittance, per colour, with
// dual-source blending.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(location = 0, index = 0) out vec4 radianceOut;
layout(location = 0, index = 1) out vec4 transmittanceOut;

#include "composite_pixel.glsl"

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  PixelLayer layer = pixelLayer(pixel);
  vec3 radiance = layer.radiance * frame.output_.y;
  countNonFinite(radiance, layer.transmittance);
  radianceOut = vec4(guarded(radiance), 0.0f);
  transmittanceOut = vec4(guarded(layer.transmittance), 1.0f);
}
