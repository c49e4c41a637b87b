// SPDX-License-Identifier: MIT
// Light of the two finest levels, each solved by itself, extrapolated to cells of no size: errors
// go with the edge of the cells (docs/models.md). On level 1: keeps what it found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;

const int TERMS = 2 * FIRST_TERMS + TRANSPORT_TERMS;
// Errors of first order would ask for a step of 1, of second order for 1/3.
// Step beyond the finest level, in steps from the coarser to it; at most this part of the light.
const float STEP = 0.5f;
// A layer's sources are linear along its rays, so its errors are of second order. That holds for
// levels that are both solved to the end (LAYER_ROUNDS), else the difference is that of rounds.
const float LAYER_STEP = 1.0f / 3.0f;
const float MOST = 0.9f;

int termAt(int term, int level, int cell) {
  return term < 2 * FIRST_TERMS ? firstAt(term, cell)
                                : sourceAt(level, term - 2 * FIRST_TERMS, cell);
}

void main() {
  int level = int(push.level);
  int cell = threadOfStep();
  if (cell >= volume.size[level].w) {
    return;
  }
  if (level > 0) {
    for (int term = 0; term < TERMS; ++term) {
      kept[coarseAt(term, cell)] = kept[termAt(term, level, cell)];
    }
    return;
  }
  ivec3 coarse = volume.size[1].xyz;
  ivec3 stride = strideOf(coarse);
  vec3 at = 0.5f * (vec3(cellOf(volume.size[0].xyz, cell)) + 0.5f) - 0.5f;
  vec3 f = at - floor(at);
  ivec3 low = max(ivec3(floor(at)), ivec3(0));
  ivec3 high = min(ivec3(floor(at)) + 1, coarse - 1);
  bool layer = isLayer();
  float part = 0.0f;
  for (int term = 0; term < TERMS; ++term) {
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
      ivec3 side = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
      ivec3 c = low + side * (high - low);
      vec3 w = mix(1.0f - f, f, vec3(side));
      int index = c.x * stride.x + c.y * stride.y + c.z * stride.z;
      sum += w.x * w.y * w.z * kept[coarseAt(term, index)];
    }
    int own = termAt(term, 0, cell);
    float change = (layer ? LAYER_STEP : STEP) * (kept[own] - sum);
    int ofOrder = term < FIRST_TERMS ? term : term - FIRST_TERMS;
    bool value = layer && ofOrder < FIRST_TERMS && ofOrder < 2 * LAYER_RINGS;
    if (value || term == 0 || term == FIRST_TERMS || term == 2 * FIRST_TERMS) {
      // Means over all directions, which bound the rest, or over those of a ring.
      float most = MOST * max(kept[own], 0.0f);
      part = abs(change) > most ? most / abs(change) : 1.0f;
    }
    kept[own] += part * change;
  }
}
