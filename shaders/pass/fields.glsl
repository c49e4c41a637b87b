// SPDX-License-Identifier: MIT
// The density fields of a volume. Values of an engine's image may be anything: negative, NaN and
// infinite count as 0, in comparison form.
float cleanDensity(float x) {
  return x > 0.0f ? (x < 65505.0f ? x : 0.0f) : 0.0f;
}

// Extinction (1/m) of each field at a position in the unit box; 0 outside.
vec4 fieldExtinction(vec3 box) {
  vec3 inside = step(vec3(0.0f), box) * step(box, vec3(1.0f));
  float weight = inside.x * inside.y * inside.z;
  vec4 d = vec4(0.0f);
  d.x = cleanDensity(textureLod(field0, box, 0.0f).x);
  if (FIELD_COUNT > 1u) {
    d.y = cleanDensity(textureLod(field1, box, 0.0f).x);
  }
  if (FIELD_COUNT > 2u) {
    d.z = cleanDensity(textureLod(field2, box, 0.0f).x);
  }
  if (FIELD_COUNT > 3u) {
    d.w = cleanDensity(textureLod(field3, box, 0.0f).x);
  }
  return d * volume.extinctionScale * weight;
}

// Permutes tiles so that neighbours in launch order lie far apart: lavapipe gives the first half of
// the groups to one core and the second half to the other (research: speed-up 1.04 to 2.00).
uvec2 tileOf(uvec2 group, uvec2 groups) {
  uint index = group.y * groups.x + group.x;
  uint count = groups.x * groups.y;
  uint half_ = (count + 1u) / 2u;
  uint permuted = index < half_ ? index * 2u : (index - half_) * 2u + 1u;
  return uvec2(permuted % groups.x, permuted / groups.x);
}
