// SPDX-License-Identifier: MIT
// src/model/glsl.hpp in double, with built-ins as wrong as Vulkan 1.3 allows them to be ("Precision
// and Operation of SPIR-V Instructions"); ulp = 2^-23. Included inside a namespace, once.
using real = double;
using vec2 = glm::vec<2, real>;
using vec3 = glm::vec<3, real>;
using vec4 = glm::vec<4, real>;
using ivec2 = glm::ivec2;
using ivec3 = glm::ivec3;
using bvec3 = glm::bvec3;
using uint = unsigned int;

constexpr bool AIR_ENABLED = true;
constexpr bool FOG_ENABLED = true;
constexpr bool ABSORBER_ENABLED = true;

unsigned noiseState = 1;

// +-1 ulp at random: a linear congruential generator is enough to mix signs.
inline real ulp() {
  noiseState = noiseState * 1664525U + 1013904223U;
  return (noiseState & 0x80000000U) != 0 ? 0x1p-23 : -0x1p-23;
}

inline real abs(real x) {
  return std::fabs(x);
}
inline real exp(real x) {
  return std::exp(x) * (1 + (3 + 2 * std::fabs(x)) * ulp());
}
inline real log(real x) {
  const real exact = std::log(x);
  return x > 0.5 && x < 2 ? exact + 4 * ulp() : exact * (1 + 3 * ulp());
}
// 1 / inversesqrt: 2 ulp and 2.5 of the division.
inline real sqrt(real x) {
  return std::sqrt(x) * (1 + 4.5 * ulp());
}
inline real sin(real x) {
  return std::sin(x) + 4096 * ulp();
}
inline real cos(real x) {
  return std::cos(x) + 4096 * ulp();
}
inline real atan(real y, real x) {
  return std::atan2(y, x) * (1 + 4096 * ulp());
}
inline real floor(real x) {
  return std::floor(x);
}
inline real ceil(real x) {
  return std::ceil(x);
}
inline real min(real a, real b) {
  return b < a ? b : a;
}
inline real max(real a, real b) {
  return a < b ? b : a;
}
inline real clamp(real x, real lo, real hi) {
  return min(max(x, lo), hi);
}
inline real mix(real a, real b, real t) {
  return a * (1 - t) + b * t;
}
inline real sign(real x) {
  return x > 0 ? 1.0 : (x < 0 ? -1.0 : 0.0);
}
inline vec3 exp(vec3 v) {
  return vec3(exp(v.x), exp(v.y), exp(v.z));
}
