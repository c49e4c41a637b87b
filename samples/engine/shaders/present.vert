// SPDX-License-Identifier: MIT
// One triangle over the whole target.
#version 460

void main() {
  vec2 corner = vec2(float((gl_VertexIndex & 1) << 2), float((gl_VertexIndex & 2) << 1));
  gl_Position = vec4(corner - 1.0, 0.0, 1.0);
}
