// SPDX-License-Identifier: MIT
// Light scattered more than once of a pixel between fourth or second pixels (surface_scatter.comp):
// the mean of those around where they are alike, or change evenly, and the pixel's own point lies
// among theirs. Before: surface_list.glsl, DETAIL.

// What second pixels around may differ by, in parts of the most, or a step among them that is not
// in what lies further off; of fourth ones half of it. The mean then misses a step by half of it,
// by three quarters where one of four differs, and by an eighth more where it follows a curve.
// Detail, whose march is 1.2 % off itself, hides more.
const float ALIKE = DETAIL ? 0.1f : 0.07f;
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

// At one of the pixels around; 0 where there is none. `own`: the row of the pixel itself, which no
// other invocation writes.
vec4 lightOf(ivec2 pixel, uint own) {
  bool inside = inRect(pixel);
  vec4 light = uintBitsToFloat(coverRow(inside ? coverIndex(pixel) : own));
  return inside ? light : vec4(0.0f);
}

void look(inout Around around, vec4 light) {
  around.there = around.there && light.w > 0.0f;
  around.sum += light;
  around.least = min(around.least, light);
  around.most = max(around.most, light);
}

// How much what changes between two differs from what changes before them and after: of a step
// between them, all of it. Without limit where that isn't known.
vec3 unevenness(vec4 before, vec4 low, vec4 high, vec4 after) {
  vec3 change = high.xyz - low.xyz;
  vec3 most = max(abs(change - (low.xyz - before.xyz)), abs(change - (after.xyz - high.xyz)));
  return min(before.w, after.w) > 0.0f ? most : vec3(3.0e38f);
}

// At a pixel with the row `own` whose point is at `range`, between those that are `apart` pixels
// apart, a power of 2: w is 0 where it has to have its own.
vec4 lightBetween(ivec2 pixel, uint own, float range, int apart) {
  // Of 2 or, between two rows, 4; in the other case some are the same. Masks: lavapipe divides
  // integers lane by lane, which took 2 % of a surface's frame.
  ivec2 low = pixel & ~(apart - 1);
  ivec2 high = (pixel + apart - 1) & ~(apart - 1);
  ivec2 ahead = high - low;
  vec4 a = lightOf(low, own);
  vec4 b = lightOf(ivec2(high.x, low.y), own);
  vec4 c = lightOf(ivec2(low.x, high.y), own);
  vec4 d = lightOf(high, own);
  Around around = Around(vec4(0.0f), vec4(3.0e38f), vec4(0.0f), true);
  look(around, a);
  look(around, b);
  look(around, c);
  look(around, d);
  // Along both diagonals, or along the row or column twice; and of one diagonal to the other.
  vec4 beforeA = lightOf(low - ahead, own);
  vec4 afterD = lightOf(high + ahead, own);
  vec4 beforeC = lightOf(ivec2(low.x - ahead.x, high.y + ahead.y), own);
  vec4 afterB = lightOf(ivec2(high.x + ahead.x, low.y - ahead.y), own);
  vec3 uneven = max(max(unevenness(beforeA, a, d, afterD), unevenness(beforeC, c, b, afterB)),
                    abs(a.xyz + d.xyz - b.xyz - c.xyz));
  float reach = SAME_RANGE / max(surface.optics.z, 1.0e-20f);
  float off = abs(range - 0.25f * around.sum.w);
  // Further apart, what they miss between them is larger: half of the bounds.
  float part = 2.0f / float(apart);
  vec3 most = part * ALIKE * around.most.xyz;
  bool even = all(lessThanEqual(uneven, most));
  bool alike = even || all(lessThanEqual(around.most.xyz - around.least.xyz, most));
  bool near = off <= part * (reach + SAME_PART * (around.most.w - around.least.w));
  // Means lie under what is round: of cubics, a 32nd of what those further off have less.
  vec3 outer = beforeA.xyz + afterD.xyz + beforeC.xyz + afterB.xyz;
  vec3 rise = even ? 0.03125f * (around.sum.xyz - outer) : vec3(0.0f);
  return vec4(0.25f * around.sum.xyz + rise, around.there && near && alike ? 1.0f : 0.0f);
}
