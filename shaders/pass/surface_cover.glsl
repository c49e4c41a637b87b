// SPDX-License-Identifier: MIT
// Triangles into the pixels of a SurfaceCover buffer: a workgroup has a triangle for each lane;
// those that cover many pixels are shared by some lanes, or by all. The largest have workgroups of
// their own, coverLarge, since drivers such as lavapipe end one without a word after 65535 rounds
// of its loops.
//
// Before: `surfaceVertex(i)` a mesh position, `surfaceCorners(triangle)`,
// `surfaceCross(uniforms, pixel, index in the buffer, crossing, triangle)`, and
// `surfaceLater(triangle, pixels of its box, strips)`: whether coverLarge will be called for it.

// Beside the exact box of a triangle, in pixels, for the rounding of its corners: in pictures of
// 16384 they are known to 4e-3 (2.5 units in the last place of a division, and those of what is
// divided).
const float SURFACE_MARGIN = 1.0f / 16.0f;
// Vertices nearer than this part of the farthest one's depth count as behind the eye.
const float SURFACE_NEAR = 1.0e-4f;
const float SURFACE_FAR = 1.0e30f;  // outside any picture

shared uint surfaceLarge[SURFACE_LANES];
shared uint surfaceLargeCount;
shared uint surfaceMiddle[SURFACE_LANES];
shared uint surfaceMiddleCount;

struct SurfaceTriangle {
  vec3 a;
  vec3 b;
  vec3 c;
  vec3 depths;
  ivec4 box;
};

// The same for every triangle at a vertex.
vec3 surfacePoint(SurfaceUniforms s, vec3 p) {
  precise vec3 at = vec3(s.pixelX.w, s.pixelY.w, s.pixelW.w) +
                    p.x * vec3(s.pixelX.x, s.pixelY.x, s.pixelW.x) +
                    p.y * vec3(s.pixelX.y, s.pixelY.y, s.pixelW.y) +
                    p.z * vec3(s.pixelX.z, s.pixelY.z, s.pixelW.z);
  return at;
}

// Pixels between a vertex before the eye and one that is not: from the former's on, the edge runs
// off to infinity. Where rounding hides to which side, to both.
vec4 surfaceBeyond(vec4 box, vec3 from, vec3 to) {
  vec2 a = to.xy * from.z;
  vec2 b = from.xy * to.z;
  vec2 slack = 1.0e-5f * (abs(a) + abs(b));
  return vec4(mix(box.xy, vec2(-SURFACE_FAR), lessThanEqual(a - b, slack)),
              mix(box.zw, vec2(SURFACE_FAR), greaterThanEqual(a - b, -slack)));
}

// Pixels that are seen of a corner and of the edges from it to the others; `near`: depths from
// which on they are before the eye.
vec4 surfaceCorner(vec4 box, float near, vec3 from, vec3 next, vec3 last) {
  if (from.z > near) {
    vec2 p = from.xy / from.z;
    box = vec4(min(box.xy, p), max(box.zw, p));
    box = next.z > near ? box : surfaceBeyond(box, from, next);
    box = last.z > near ? box : surfaceBeyond(box, from, last);
  }
  return box;
}

// Pixels of the picture that the triangle may cover, x0, y0, x1, y1.
ivec4 surfaceBox(SurfaceUniforms s, vec3 a, vec3 b, vec3 c) {
  float most = max(max(a.z, b.z), c.z);
  if (!(most > 0.0f)) {
    return ivec4(0);
  }
  float near = SURFACE_NEAR * most;
  vec4 box = vec4(vec2(SURFACE_FAR), vec2(-SURFACE_FAR));
  box = surfaceCorner(box, near, a, b, c);
  box = surfaceCorner(box, near, b, c, a);
  box = surfaceCorner(box, near, c, a, b);
  // Clamped as floats: integers of what is far outside are undefined.
  vec4 rect = vec4(s.rect);
  vec2 low = clamp(ceil(box.xy - SURFACE_MARGIN), rect.xy, rect.zw);
  vec2 high = clamp(floor(box.zw + SURFACE_MARGIN) + 1.0f, rect.xy, rect.zw);
  return ivec4(ivec2(low), ivec2(high));
}

SurfaceTriangle surfaceTriangle(SurfaceUniforms s, uint triangle) {
  uvec3 at = surfaceCorners(triangle);
  vec3 p = surfaceVertex(at.x);
  vec3 q = surfaceVertex(at.y);
  vec3 r = surfaceVertex(at.z);
  SurfaceTriangle t;
  t.a = surfacePoint(s, p);
  t.b = surfacePoint(s, q);
  t.c = surfacePoint(s, r);
  t.depths = vec3(dot(s.depth, vec4(p, 1.0f)), dot(s.depth, vec4(q, 1.0f)),
                  dot(s.depth, vec4(r, 1.0f)));
  t.box = surfaceBox(s, t.a, t.b, t.c);
  return t;
}

uint surfaceBoxSize(ivec4 box) {
  return uint(max(box.z - box.x, 0)) * uint(max(box.w - box.y, 0));
}

// Log2 of the rows of a large triangle's strips. All such triangles have as many strips as the one
// with the most, so there are few. Shifts: lavapipe divides integers lane by lane.
int surfaceStripRows(ivec4 box) {
  int width = findMSB(max(box.z - box.x - 1, 0)) + 1;  // log2, up to the next whole number
  int height = findMSB(max(box.w - box.y - 1, 0)) + 1;
  int rows = max(SURFACE_STRIP - width, height - SURFACE_STRIPS);
  return clamp(rows, 0, SURFACE_STRIP_MOST - width);
}

uint surfaceStrips(ivec4 box) {
  int rows = surfaceStripRows(box);
  return uint(max(box.w - box.y, 0) + (1 << rows) - 1) >> rows;
}

// The depth in steps.
uint surfaceStep(SurfaceUniforms s, float depth) {
  return uint(clamp((depth - s.steps.x) * s.steps.y, 0.0f, s.steps.z) + 0.5f);
}

// n / d for n up to SURFACE_LANES, exactly: lavapipe divides integers lane by lane.
uint surfaceQuotient(uint n, uint d) {
  return uint((float(n) + 0.5f) / float(d));
}

// Every `stride`th pixel of the triangle's box.
void coverBox(SurfaceUniforms s, SurfaceTriangle t, uint triangle, uint first, uint stride) {
  uint width = max(uint(max(t.box.z - t.box.x, 0)), 1u);
  uint count = surfaceBoxSize(t.box);
  // Rows and columns ahead, once.
  uint down = surfaceQuotient(stride, width);
  uint right = stride - down * width;
  uint y = surfaceQuotient(first, width);
  uint x = first - y * width;
  for (uint n = first; n < count; n += stride) {
    ivec2 pixel = t.box.xy + ivec2(int(x), int(y));
    SurfaceCrossing crossing = surfaceCrossing(t.a, t.b, t.c, t.depths, vec2(pixel));
    if (crossing.facing != 0.0f && crossing.depth > s.steps.w) {
      crossing.facing = s.triangle.y != 0u ? -crossing.facing : crossing.facing;
      uint at = uint(pixel.y - s.rect.y) * uint(s.rect.z - s.rect.x) + uint(pixel.x - s.rect.x);
      surfaceCross(s, pixel, at, crossing, triangle);
    }
    x += right;
    y += down;
    if (x >= width) {
      x -= width;
      y += 1u;
    }
  }
}

// Workgroup x + SURFACE_ROW y takes its triangles.
void coverTriangles(SurfaceUniforms s, uvec2 group, uint lane) {
  if (lane == 0u) {
    surfaceLargeCount = 0u;
    surfaceMiddleCount = 0u;
  }
  memoryBarrierShared();
  barrier();
  uint triangle = (group.y * SURFACE_ROW + group.x) * SURFACE_LANES + lane;
  if (triangle < s.triangle.x) {
    SurfaceTriangle t = surfaceTriangle(s, triangle);
    uint pixels = surfaceBoxSize(t.box);
    if (pixels <= SURFACE_SMALL) {
      coverBox(s, t, triangle, 0u, 1u);
    } else if (pixels <= SURFACE_MIDDLE) {
      surfaceMiddle[atomicAdd(surfaceMiddleCount, 1u)] = triangle;
    } else if (!surfaceLater(triangle, pixels, surfaceStrips(t.box))) {
      surfaceLarge[atomicAdd(surfaceLargeCount, 1u)] = triangle;
    }
  }
  memoryBarrierShared();
  barrier();
  uint middle = surfaceMiddleCount;
  for (uint i = lane / SURFACE_TEAM; i < middle; i += SURFACE_LANES / SURFACE_TEAM) {
    SurfaceTriangle t = surfaceTriangle(s, surfaceMiddle[i]);
    coverBox(s, t, surfaceMiddle[i], lane & (SURFACE_TEAM - 1u), SURFACE_TEAM);
  }
  uint large = surfaceLargeCount;
  for (uint i = 0u; i < large; ++i) {
    SurfaceTriangle t = surfaceTriangle(s, surfaceLarge[i]);
    coverBox(s, t, surfaceLarge[i], lane, SURFACE_LANES);
  }
}

// A triangle of many pixels, in one strip of their rows.
void coverLarge(SurfaceUniforms s, uint triangle, uint strip, uint lane) {
  SurfaceTriangle t = surfaceTriangle(s, triangle);
  int rows = surfaceStripRows(t.box);
  t.box.y += int(strip) << rows;
  t.box.w = min(t.box.y + (1 << rows), t.box.w);
  coverBox(s, t, triangle, lane, SURFACE_LANES);
}
