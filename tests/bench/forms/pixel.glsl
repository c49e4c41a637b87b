// SPDX-License-Identifier: MIT
// Shared by the forms of the sky that every pixel computes for itself: the pixel's ray, and the
// picture of what its air adds. Clear air, the eye above the planet's sea-level point. Lengths in
// m, radiance in irradiance of the light per sr.
#define real float
const bool AIR_ENABLED = true;
const bool FOG_ENABLED = false;
const bool ABSORBER_ENABLED = false;
#include "model/model.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// LutScene of bench/lut_sky.hpp.
layout(set = 0, binding = 0, std140) uniform Scene {
  vec4 right;       // the camera's axes, right and up times half the picture at distance 1
  vec4 up;
  vec4 forward;     // w: near plane
  vec4 size;        // width, height, 1/width, 1/height
  vec4 light;       // unit vector towards it
  vec4 irradiance;  // w: planet radius
  vec4 scattering;  // at sea level, 1/m; w: scale height
  vec4 ground;      // w: altitude of the eye
} scene;
layout(set = 0, binding = 1) uniform sampler2D depthImage;
layout(set = 0, binding = 2) uniform sampler2D colorInput;
layout(set = 0, binding = 3) uniform writeonly image2D target;

const float OPEN = 1e30f;  // distance of the sky

struct PixelRay {
  vec3 direction;
  float distance;
};

struct PixelAir {
  vec3 radiance;
  vec3 transmittance;
};

// What tells the forms apart.
PixelAir airAlong(PixelRay ray);

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= uint(scene.size.x) || pixel.y >= uint(scene.size.y)) {
    return;
  }
  vec2 ndc = 2.0f * (vec2(pixel) + 0.5f) * scene.size.zw - 1.0f;
  vec3 way = scene.forward.xyz + scene.right.xyz * ndc.x - scene.up.xyz * ndc.y;
  float scale = length(way);
  float depth = texelFetch(depthImage, ivec2(pixel), 0).x;
  PixelRay ray;
  ray.direction = way / scale;
  ray.distance = depth > 0.0f ? scale * scene.forward.w / depth : OPEN;
  PixelAir air = airAlong(ray);
  // The sky has nothing behind it, as the competitor of lut/ has it.
  vec3 behind = depth > 0.0f ? texelFetch(colorInput, ivec2(pixel), 0).xyz : vec3(0.0f);
  vec3 color = behind * air.transmittance + air.radiance * scene.irradiance.xyz;
  imageStore(target, ivec2(pixel), vec4(color, 1.0f));
}
