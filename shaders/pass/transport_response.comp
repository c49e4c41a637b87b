// SPDX-License-Identifier: MIT
// What a layer's light makes of the functions in which it is kept (LAYER_RINGS): for directions v,
// means of each over directions w with weight P'(w v) P'(w s), s being the light's and P' the phase
// function without its peak; and with P' scattered twice for the latter. For the directions of the
// grid the former times the pair of both. Last, moments of P' scattered twice times each function.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 7, std430) readonly buffer Pairs { vec4 pairs[]; };

const float PI = 3.14159265f;
// Of the sphere: Gauss-Legendre in z on each side. What is left of the errors of P' is common to
// a mean and its weight.
const int HEIGHTS = 10;
const float HEIGHT[HEIGHTS] = float[](
    0.0130467357f, 0.0674683167f, 0.1602952159f, 0.2833023029f, 0.4255628305f,
    0.5744371695f, 0.7166976971f, 0.8397047841f, 0.9325316833f, 0.9869532643f);
const float WEIGHT[HEIGHTS] = float[](
    0.0333356722f, 0.0747256746f, 0.1095431813f, 0.1346333597f, 0.1477621124f,
    0.1477621124f, 0.1346333597f, 0.1095431813f, 0.0747256746f, 0.0333356722f);
const int AZIMUTHS = 40;
// |z| of the rings.
const float RING[LAYER_RINGS] =
    float[](0.0694318442f, 0.3300094782f, 0.6699905218f, 0.9305681558f);

// Mean of the colours of P', P' scattered twice: 4 pi times.
float tableAt(int function, float cosine) {
  float x = acos(clamp(cosine, -1.0f, 1.0f)) * (float(PAIR_TABLE_NODES - 1) / PI);
  int node = min(int(x), PAIR_TABLE_NODES - 2);
  int at = function * PAIR_TABLE_NODES + node;
  return dot(mix(pairs[at].xyz, pairs[at + 1].xyz, x - float(node)), vec3(1.0f / 3.0f));
}

float harmonic(int term, vec3 v) {
  float x = v.x;
  float y = v.y;
  float z = v.z;
  float squares = x * x - y * y;
  float all[TRANSPORT_TERMS] = float[](
      1.0f, 1.7320508f * y, 1.7320508f * z, 1.7320508f * x, 3.8729833f * x * y,
      3.8729833f * y * z, 1.1180340f * (3.0f * z * z - 1.0f), 3.8729833f * x * z,
      1.9364917f * squares, 0.375f * (z * z * (35.0f * z * z - 30.0f) + 3.0f),
      2.3717082f * x * z * (7.0f * z * z - 3.0f), 1.6770510f * squares * (7.0f * z * z - 1.0f),
      1.3228757f * z * (5.0f * z * z - 3.0f),
      1.6201852f * x * (5.0f * z * z - 1.0f), 5.1234754f * z * squares,
      2.0916501f * x * (x * x - 3.0f * y * y));
  return all[term];
}

// Polynomial of |z| that is 1 on one ring and 0 on the others.
float onRing(int ring, float height) {
  float product = 1.0f;
  for (int other = 0; other < LAYER_RINGS; ++other) {
    product *= other == ring ? 1.0f : (height - RING[other]) / (RING[ring] - RING[other]);
  }
  return product;
}

void main() {
  int directions = volume.place[0].y;
  int node = threadOfStep();
  if (node >= RESPONSE_NODES + directions + TRANSPORT_TERMS) {
    return;
  }
  int direction = clamp(node - RESPONSE_NODES, 0, directions - 1);
  int term = clamp(node - RESPONSE_NODES - directions, 0, TRANSPORT_TERMS - 1);
  bool toDirection = node >= RESPONSE_NODES && node < RESPONSE_NODES + directions;
  bool moment = node >= RESPONSE_NODES + directions;
  vec3 s = volume.travel.xyz;
  float zenith = float(node / RESPONSE_AZIMUTHS) * (PI / float(RESPONSE_ZENITHS - 1));
  float azimuth = float(uint(node) % uint(RESPONSE_AZIMUTHS)) * (PI / float(RESPONSE_AZIMUTHS - 1));
  vec3 v = vec3(sin(zenith) * cos(azimuth), sin(zenith) * sin(azimuth), cos(zenith));
  if (toDirection) {  // harmonics of degree 1
    v = volume.rows[direction * 4].wyz / 1.7320508f;
  }
  float once[FIRST_TERMS];
  float twice[FIRST_TERMS];
  for (int i = 0; i < FIRST_TERMS; ++i) {
    once[i] = 0.0f;
    twice[i] = 0.0f;
  }
  vec2 all = vec2(0.0f);
  for (int level = 0; level < 2 * HEIGHTS; ++level) {
    int side = level / HEIGHTS;
    float height = HEIGHT[uint(level) % uint(HEIGHTS)];
    float sine = sqrt(1.0f - height * height);
    vec3 sumOnce = vec3(0.0f);  // times 1, x, y
    vec3 sumTwice = vec3(0.0f);
    vec2 weights = vec2(0.0f);
    for (int turn = 0; turn < AZIMUTHS; ++turn) {
      float angle = (float(turn) + 0.5f) * (2.0f * PI / float(AZIMUTHS));
      vec3 w = vec3(sine * cos(angle), sine * sin(angle), side == 0 ? height : -height);
      float passes = moment ? harmonic(term, w) : tableAt(12, dot(w, v));
      float first = tableAt(12, dot(w, s));
      float second = tableAt(0, dot(w, s));
      vec3 functions = vec3(1.0f, w.x, w.y);
      // A moment is one of light scattered twice.
      float used = moment ? second : first;
      sumOnce += passes * used * functions;
      sumTwice += passes * second * functions;
      weights += moment ? vec2(used, second) : passes * vec2(first, second);
    }
    float share = WEIGHT[uint(level) % uint(HEIGHTS)];
    for (int ring = 0; ring < LAYER_RINGS; ++ring) {
      float value = share * onRing(ring, height);
      once[side * LAYER_RINGS + ring] += value * sumOnce.x;
      twice[side * LAYER_RINGS + ring] += value * sumTwice.x;
    }
    for (int i = 0; i < 2; ++i) {
      once[2 * LAYER_RINGS + 2 * side + i] += share * sumOnce[1 + i];
      twice[2 * LAYER_RINGS + 2 * side + i] += share * sumTwice[1 + i];
    }
    all += share * weights;
  }
  vec2 scale = 1.0f / max(all, vec2(1.0e-12f));
  scale.x *= toDirection ? tableAt(0, dot(v, s)) : 1.0f;
  for (int i = 0; i < FIRST_TERMS; ++i) {
    kept[responseAt(node, 0) + i] = once[i] * scale.x;
    kept[responseAt(node, 1) + i] = twice[i] * scale.y;
  }
}
