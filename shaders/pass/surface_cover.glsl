// SPDX-License-Identifier: MIT
// Triangles into the pixels of a SurfaceCover buffer: one workgroup each, whose lanes share its
// pixels. Before: `surfaceVertex(i)` a mesh position, `surfaceIndex(k)`, `surfaceLimit(pixel)` the
// depth in steps of what hides the rest, and the buffer `surfaceCover[]` by rows of rect.
const uint SURFACE_LANES = 64u;

// Beside the exact box of a triangle, for the rounding of its corners.
const float SURFACE_MARGIN = 1.0f;
// Vertices nearer than this part of the farthest one's depth: the box is the whole rectangle.
const float SURFACE_NEAR = 1.0e-4f;

vec3 surfacePoint(SurfaceUniforms s, vec3 p) {
  vec4 q = vec4(p, 1.0f);
  return vec3(dot(s.pixelX, q), dot(s.pixelY, q), dot(s.pixelW, q));
}

// Pixels that the triangle may cover, x0, y0, x1, y1.
ivec4 surfaceBox(SurfaceUniforms s, vec3 a, vec3 b, vec3 c) {
  float least = min(min(a.z, b.z), c.z);
  float most = max(max(a.z, b.z), c.z);
  if (!(most > 0.0f)) {
    return ivec4(0);
  }
  if (!(least > SURFACE_NEAR * most)) {
    return s.rect;
  }
  vec2 p = a.xy / a.z;
  vec2 q = b.xy / b.z;
  vec2 r = c.xy / c.z;
  // Clamped as floats: integers of what is far outside are undefined.
  vec2 low = clamp(min(min(p, q), r) - SURFACE_MARGIN, vec2(s.rect.xy), vec2(s.rect.zw));
  vec2 high = clamp(max(max(p, q), r) + SURFACE_MARGIN, vec2(s.rect.xy), vec2(s.rect.zw));
  return ivec4(ivec2(floor(low)), ivec2(ceil(high)));
}

vec3 sharedLine(vec3 a, vec3 b, uint i, uint j) {
  return i < j ? edgeLine(a, b, false) : edgeLine(b, a, true);
}

void addCrossing(SurfaceUniforms s, ivec2 pixel, SurfaceCrossing crossing) {
  float depth = clamp((crossing.depth - s.steps.x) * s.steps.y, 0.0f, s.steps.z);
  uint step_ = min(uint(depth + 0.5f), surfaceLimit(pixel));
  uint at = uint(pixel.y - s.rect.y) * uint(s.rect.z - s.rect.x) + uint(pixel.x - s.rect.x);
  if (crossing.facing > 0.0f) {
    atomicMax(surfaceCover[at].front, ~step_);
    atomicAdd(surfaceCover[at].chord, -int(step_));
    atomicAdd(surfaceCover[at].net, -1);
  } else {
    atomicMax(surfaceCover[at].back, step_);
    atomicAdd(surfaceCover[at].chord, int(step_));
    atomicAdd(surfaceCover[at].net, 1);
  }
}

void coverTriangle(SurfaceUniforms s, uint triangle, uint lane) {
  uint i = surfaceIndex(3u * triangle);
  uint j = surfaceIndex(3u * triangle + 1u);
  uint k = surfaceIndex(3u * triangle + 2u);
  vec3 p = surfaceVertex(i);
  vec3 q = surfaceVertex(j);
  vec3 r = surfaceVertex(k);
  vec3 a = surfacePoint(s, p);
  vec3 b = surfacePoint(s, q);
  vec3 c = surfacePoint(s, r);
  vec3 depths = vec3(dot(s.depth, vec4(p, 1.0f)), dot(s.depth, vec4(q, 1.0f)),
                     dot(s.depth, vec4(r, 1.0f)));
  vec3 line0 = sharedLine(b, c, j, k);
  vec3 line1 = sharedLine(c, a, k, i);
  vec3 line2 = sharedLine(a, b, i, j);
  ivec4 box = surfaceBox(s, a, b, c);
  uint width = uint(max(box.z - box.x, 0));
  uint count = width * uint(max(box.w - box.y, 0));
  for (uint n = lane; n < count; n += SURFACE_LANES) {
    ivec2 pixel = box.xy + ivec2(int(n % width), int(n / width));
    SurfaceCrossing crossing = surfaceCrossing(line0, line1, line2, depths, vec2(pixel));
    if (crossing.facing != 0.0f && crossing.depth > s.steps.w) {
      addCrossing(s, pixel, crossing);
    }
  }
}
