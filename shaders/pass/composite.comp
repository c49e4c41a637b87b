// SPDX-License-Identifier: MIT
// Composites a view by compute: colour * transmittance + radiance into one image, or radiance and
// transmittance into two.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 7) const bool SEPARATE = false;
layout(constant_id = 8) const bool ROUND_TO_HALF = false;

layout(set = 0, binding = 3) uniform sampler2D colorInput;
layout(set = 0, binding = 4) uniform writeonly image2D target0;
layout(set = 0, binding = 5) uniform writeonly image2D target1;

#include "composite_pixel.glsl"
#include "half_float.glsl"

vec3 rounded(vec3 v) {
  return ROUND_TO_HALF ? roundedToHalf(v) : v;
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= uint(frame.viewport.x) || pixel.y >= uint(frame.viewport.y)) {
    return;
  }
  PixelLayer layer = pixelLayer(pixel);
  float exposure = frame.output_.y;
  vec3 radiance = layer.radiance * exposure;
  if (SEPARATE) {
    countNonFinite(radiance, layer.transmittance);
    imageStore(target0, ivec2(pixel), vec4(rounded(guarded(radiance)), 1.0f));
    imageStore(target1, ivec2(pixel), vec4(rounded(guarded(layer.transmittance)), 1.0f));
  } else {
    // A constant would double the pipelines: without an input one texel of nothing is read. The
    // input may be the target itself.
    float given = frame.output_.w;
    vec4 input_ = texelFetch(colorInput, ivec2(vec2(pixel) * given), 0);
    vec4 color = vec4(input_.xyz * given, given > 0.0f ? input_.w : 1.0f);
    vec3 sum = color.xyz * layer.transmittance + radiance;
    countNonFinite(sum, layer.transmittance);
    imageStore(target0, ivec2(pixel), vec4(rounded(guarded(sum)), color.w));
  }
}
