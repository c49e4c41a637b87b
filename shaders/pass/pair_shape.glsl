// SPDX-License-Identifier: MIT
// By what the light that a volume has scattered a few times depends on the direction to the eye,
// roughly: a cell of its grid keeps this light over it, so that rays which pass a cell in other
// directions than through its middle take it for their own. Any function would do that is positive.
float pairShape(float cosine) {
  float x = acos(clamp(cosine, -1.0f, 1.0f)) * (31.0f / 3.14159265f);
  int node = min(int(x), 30);
  float low = PAIR_SHAPE[node >> 2][node & 3];
  float high = PAIR_SHAPE[(node + 1) >> 2][(node + 1) & 3];
  return max(mix(low, high, x - float(node)), 1.0e-4f);
}
