// SPDX-License-Identifier: MIT
// What the engine's shadow map of the first light says of points on a ray. Every cascade is affine
// in the distance, so that a comparison takes three multiplications and one fetch.
layout(set = 0, binding = 12) uniform sampler2DArray lightShadowMap;

// Steps between which the map is looked up, and halvings of those in which shadow begins or ends:
// an edge is found to 1 / (4 * 16) of a step.
const int SHADOW_PARTS = 4;
const int SHADOW_HALVINGS = 4;

vec3 cascadeOf(int i, vec4 p) {
  return vec3(dot(frameBlock.cascade[3 * i], p), dot(frameBlock.cascade[3 * i + 1], p),
              dot(frameBlock.cascade[3 * i + 2], p));
}

// Whether something opaque stands between a point relative to the eye and the light: 1 or 0. By the
// first cascade that contains the point.
float mapShadow(vec3 position) {
  vec4 p = vec4(position, 1.0f);
  vec3 place = vec3(0.0f);
  vec3 depth = vec3(0.0f);
  float layer = -1.0f;
  int i = int(frame.shadowRange.y) - 1;
  do {
    vec3 at = cascadeOf(i, p);
    vec3 inner = abs(at - vec3(0.5f));
    bool inside = max(max(inner.x, inner.y), inner.z) <= 0.5f;
    place = inside ? at : place;
    depth = inside ? frameBlock.cascadeDepth[i].xyz : depth;
    layer = inside ? float(i) : layer;
    i -= 1;
  } while (i >= 0);
  float surface = textureLod(lightShadowMap, vec3(place.xy, max(layer, 0.0f)), 0.0f).x;
  return layer >= 0.0f && depth.x * surface + depth.y < place.z - depth.z ? 1.0f : 0.0f;
}

// The stretch of a ray that has parts in all cascades.
Span mapSpan(vec3 direction, float reach) {
  Span all;
  all.begin = reach;
  all.end = 0.0f;
  int i = int(frame.shadowRange.y) - 1;
  do {
    vec3 at = vec3(frameBlock.cascade[3 * i].w, frameBlock.cascade[3 * i + 1].w,
                   frameBlock.cascade[3 * i + 2].w);
    vec3 rate = cascadeOf(i, vec4(direction, 0.0f));
    Span one = rayBox(at, rate, vec3(0.0f), vec3(1.0f));
    bool meets = one.end > one.begin;
    all.begin = meets ? min(all.begin, one.begin) : all.begin;
    all.end = meets ? max(all.end, min(one.end, reach)) : all.end;
    i -= 1;
  } while (i >= 0);
  all.end = max(all.begin, all.end);
  return all;
}

// Where on the ray the map was looked up last, and what it said.
struct MapMarch {
  float at;
  float dark;
};

// Goes on to `end`; returns the share of the stretch that is in shadow. Where it says something
// else at the two ends of a part, the edge between them is found by halving: one flat loop, since
// lavapipe runs every branch.
float marchMap(inout MapMarch march, vec3 direction, float end) {
  float begin = march.at;
  float part = (end - begin) / float(SHADOW_PARTS);
  float sum = 0.0f;
  float far = end;
  int next = 1;
  int halvings = 0;
  while (march.at < end) {  // tested in front, as in eye_march.comp
    bool looksOn = halvings == 0;
    float t = looksOn ? (next < SHADOW_PARTS ? begin + float(next) * part : end)
                      : 0.5f * (march.at + far);
    float dark = mapShadow(direction * t);
    bool same = dark == march.dark;
    sum += same ? march.dark * (t - march.at) : 0.0f;
    march.at = same ? t : march.at;
    far = same ? far : t;
    bool found = !looksOn && halvings == 1;
    halvings = looksOn ? (same ? 0 : SHADOW_HALVINGS) : halvings - 1;
    next += looksOn && same ? 1 : 0;
    if (found) {
      // The edge lies in the middle of what is left; looking goes on behind it.
      float edge = 0.5f * (march.at + far);
      sum += march.dark * (edge - march.at) + (1.0f - march.dark) * (far - edge);
      march.at = far;
      march.dark = 1.0f - march.dark;
    }
  }
  return end > begin ? clamp(sum / (end - begin), 0.0f, 1.0f) : 0.0f;
}
