// SPDX-License-Identifier: MIT
// Harmonics of the radiance in each cell, and the source they scatter into. After the first two
// sweeps: of the light scattered once and twice, each over its phase function in an endless medium,
// which leaves what the place makes of it; the latter drives the rest.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;

int degreeOf(int term) {
  return term >= 9 ? 3 : (term >= 4 ? 2 : (term >= 1 ? 1 : 0));
}

bool isFourth(int term, int last) {
  return term >= LAYER_FOURTH && term <= last;
}

void main() {
  int level = int(push.level);
  int cell = threadOfStep();
  ivec3 size = volume.size[level].xyz;
  if (cell >= volume.size[level].w) {
    return;
  }
  bool second = late((push.flags & TRANSPORT_SECOND_SWEEP) != 0u);
  bool first = second || late((push.flags & TRANSPORT_FIRST_SWEEP) != 0u);
  ivec3 place = cellOf(size, cell);
  float sum[TRANSPORT_TERMS];
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    sum[term] = 0.0f;
  }
  bool layer = first && isLayer();
  int fourths = isLayer() ? LAYER_FOURTH + 2 : -1;  // the last term of degree 4
  int base = layer ? (second ? SECOND_ROWS : FIRST_ROWS) : 0;
  int stride = layer ? 3 : 4;  // a layer's terms of the last row are not used
  bool shaped = second && !layer;
  int directions = volume.place[level].y;
  int direction = 0;
  do {
    TransportDirection d = directionAt(level, direction);
    Rays rays = raysAround(d, size, place);
    float radiance = dot(rays.weight, vec4(swept[radianceAt(level, direction, rays.index.x)],
                                           swept[radianceAt(level, direction, rays.index.y)],
                                           swept[radianceAt(level, direction, rays.index.z)],
                                           swept[radianceAt(level, direction, rays.index.w)]));
    radiance *= shaped ? d.step_.w * volume.rows[FIRST_ROWS + direction * 3 + 2].w : d.step_.w;
    for (int row = 0; row < 4; ++row) {
      vec4 y = volume.rows[base + direction * stride + row];
      sum[row * 4 + 0] += y.x * radiance;
      sum[row * 4 + 1] += y.y * radiance;
      sum[row * 4 + 2] += y.z * radiance;
      sum[row * 4 + 3] += y.w * radiance;
    }
    direction += 1;
  } while (direction < directions);

  vec4 moments = vec4(kept[momentAt(level, 0, cell)], kept[momentAt(level, 1, cell)],
                      kept[momentAt(level, 2, cell)], kept[momentAt(level, 3, cell)]);
  float fourth = kept[momentAt(level, 4, cell)];
  if (first) {
    for (int term = 0; term < FIRST_TERMS; ++term) {
      kept[firstAt(second ? FIRST_TERMS + term : term, cell)] = sum[term];
    }
    for (int l = 0; l < 4; ++l) {
      for (int m = -l; m <= l; ++m) {
        float drive = 0.0f;
        int from = responseAt(RESPONSE_NODES + directions + l * l + l + m, 0);
        for (int k = 0; k < (layer ? FIRST_TERMS : 0); ++k) {
          drive += kept[from + k] * sum[k];
        }
        for (int k = 0; k < (layer ? 0 : 3); ++k) {
          if (abs(m) <= k) {
            drive += volume.products[(second ? 12 : 0) + l * 3 + k][abs(m)] * sum[k * k + k + m];
          }
        }
        int term = l * l + l + m;
        work[driveAt(level, term, cell)] = (isFourth(term, fourths) ? fourth : moments[l]) * drive;
        kept[sourceAt(level, term, cell)] = 0.0f;
      }
    }
    return;
  }
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    float now = (isFourth(term, fourths) ? fourth : moments[degreeOf(term)]) * sum[term];
    int at = sourceAt(level, term, cell);
    work[changeAt(level, term, cell)] = now - kept[at];
    kept[at] = now;
  }
}
