// SPDX-License-Identifier: MIT
// What the passes of welkin_volume_cost's competitors share; volume_slicer.hpp fills it. Lengths in
// m, positions relative to the eye or in the volume's unit box.
layout(set = 0, binding = 0, std140) uniform Scene {
  mat4 clipFromBox;
  vec4 eyeX;  // position relative to the eye: dot(row, (box, 1))
  vec4 eyeY;
  vec4 eyeZ;
  vec4 lightU;  // light-buffer u: dot(xyz, box) + w
  vec4 lightV;
  vec4 axis;     // across the slices; thickness of a slab
  vec4 optics;   // extinction (1/m) at value 1, light path in a slab, phase's g, 1 / step
  vec4 right;    // from the picture's middle to its edge, per unit along `forward`
  vec4 up;
  vec4 forward;
  vec4 toLight;
  vec4 size;     // of the picture and their reciprocals
  vec4 boxX;     // box position: dot(row, (relative to the eye, 1))
  vec4 boxY;
  vec4 boxZ;
  vec4 plane;    // plane coordinate: dot(xyz, relative to the eye) + w
} scene;
layout(set = 0, binding = 1) uniform sampler3D density;

vec3 pixelRay(vec2 pixel) {
  vec2 at = 2.0 * (pixel + 0.5) * scene.size.zw - 1.0;
  return normalize(scene.forward.xyz + at.x * scene.right.xyz - at.y * scene.up.xyz);
}
