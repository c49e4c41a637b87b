// SPDX-License-Identifier: MIT
// A loop with the fetches of the library's eye pass and next to nothing else: what the device's
// sample rate is. As many steps as there are eye samples, at the same distance from each other; the
// number it makes means nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 4) uniform sampler3D lightVolume;
layout(set = 0, binding = 5) writeonly uniform image2D target;

// Neighbours in launch order far apart: the driver gives each core one half of the groups.
uvec2 tileOf(uvec2 group, uvec2 groups) {
  uint index = group.y * groups.x + group.x;
  uint count = groups.x * groups.y;
  uint half_ = (count + 1u) / 2u;
  uint permuted = index < half_ ? index * 2u : (index - half_) * 2u + 1u;
  return uvec2(permuted % groups.x, permuted / groups.x);
}

void main() {
  uvec2 pixel = tileOf(gl_WorkGroupID.xy, gl_NumWorkGroups.xy) * 8u + gl_LocalInvocationID.xy;
  vec3 direction = pixelRay(vec2(pixel));
  vec3 origin = vec3(scene.boxX.w, scene.boxY.w, scene.boxZ.w);
  vec3 step_ = vec3(dot(scene.boxX.xyz, direction), dot(scene.boxY.xyz, direction),
                    dot(scene.boxZ.xyz, direction));
  vec3 a = -origin / step_;
  vec3 b = (1.0 - origin) / step_;
  vec3 low = min(a, b);
  vec3 high = max(a, b);
  float begin = max(max(low.x, low.y), low.z);
  float end = min(min(high.x, high.y), high.z);
  float dt = 1.0 / scene.optics.w;
  float left = ceil((end - begin) / dt);
  float t = begin + 0.5 * dt;
  float layers = float(textureSize(lightVolume, 0).z);
  vec3 box = origin + t * step_;
  vec3 boxMove = dt * step_;
  vec3 light = vec3(dot(scene.lightU.xyz, box) + scene.lightU.w,
                    dot(scene.lightV.xyz, box) + scene.lightV.w,
                    (dot(scene.plane.xyz, t * direction) + scene.plane.w + 0.5) / layers);
  vec3 lightMove = vec3(dot(scene.lightU.xyz, boxMove), dot(scene.lightV.xyz, boxMove),
                        dt * dot(scene.plane.xyz, direction) / layers);
  float sum = 0.0;
  while (left > 0.0) {
    sum += textureLod(density, box, 0.0).x * textureLod(lightVolume, light, 0.0).x;
    box += boxMove;
    light += lightMove;
    left -= 1.0;
  }
  imageStore(target, ivec2(pixel), vec4(sum));
}
