// SPDX-License-Identifier: MIT
// Of a slab of optical depth t, e = e^-t:
// (1 - e^-t) / t, and what a source that grows by 1 along the slab adds to what leaves it:
// (1 + e^-t) / 2 less the former.
vec2 slabWeights(float t, float e) {
  float mean = t > 1.0e-2f ? (1.0f - e) / t : 1.0f - t * (0.5f - t * (1.0f / 6.0f));
  float slope = t > 0.1f ? 0.5f * (1.0f + e) - mean
                         : t * t * (1.0f / 12.0f - t * (1.0f / 24.0f - t * (1.0f / 80.0f)));
  return vec2(mean, slope);
}
