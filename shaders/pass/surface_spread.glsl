// SPDX-License-Identifier: MIT
// Light scattered more than once of a pixel between fourth or second pixels (surface_scatter.comp):
// the mean of those around where they are alike and the pixel's own point lies among theirs.
// Before: surface_list.glsl.

// Of what second pixels around have, in parts of the most, and twice of fourth ones: the mean then
// misses a step among them by half of it, and by three quarters where one of four differs.
const float ALIKE = 0.05f;
// The pixel's own point may lie so far from the mean of theirs: in free paths of the canonical
// cloud, and in parts of what lies between theirs. At an edge in front of something it is either's.
const float SAME_RANGE = 0.1f;
const float SAME_PART = 0.15f;

struct Around {
  vec4 sum;
  vec4 least;
  vec4 most;
  bool there;
};

void look(inout Around around, ivec2 pixel, int apart) {
  bool inside = all(greaterThanEqual(pixel, surface.rect.xy)) &&
                all(lessThan(pixel, surface.rect.zw));
  // Never one that a second pixel's invocation may be writing.
  ivec2 at = inside ? pixel : surface.rect.xy & ~(apart - 1);
  vec4 light = imageLoad(secondLight, at >> 1);
  around.there = around.there && inside && light.w > 0.0f;
  around.sum += light;
  around.least = min(around.least, light);
  around.most = max(around.most, light);
}

// At a pixel whose point is at `range`, between those that are `apart` pixels apart, a power of 2:
// w is 0 where it has to have its own.
vec4 lightBetween(ivec2 pixel, float range, int apart) {
  // Of 2 or, between two rows, 4; in the other case some are the same. Masks: lavapipe divides
  // integers lane by lane, which took 2 % of a surface's frame.
  ivec2 low = pixel & ~(apart - 1);
  ivec2 high = (pixel + apart - 1) & ~(apart - 1);
  Around around = Around(vec4(0.0f), vec4(3.0e38f), vec4(0.0f), true);
  look(around, low, apart);
  look(around, ivec2(high.x, low.y), apart);
  look(around, ivec2(low.x, high.y), apart);
  look(around, high, apart);
  float reach = SAME_RANGE / max(surface.optics.z, 1.0e-20f);
  float off = abs(range - 0.25f * around.sum.w);
  // Further apart, what they miss between them is larger: half of the bounds.
  float part = 2.0f / float(apart);
  vec3 differ = around.most.xyz - around.least.xyz;
  bool alike = all(lessThanEqual(differ, part * ALIKE * around.most.xyz)) &&
               off <= part * (reach + SAME_PART * (around.most.w - around.least.w));
  return vec4(0.25f * around.sum.xyz, around.there && alike ? 1.0f : 0.0f);
}
