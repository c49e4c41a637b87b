// SPDX-License-Identifier: MIT
// src/model/glsl.hpp with numbers as wrong as Vulkan 1.3 allows a device's to be: arithmetic by
// Noisy, built-ins here. Included inside a namespace, once, after noisy_number.hpp.
using real = parity::Noisy;
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

inline real abs(real x) {
  return std::fabs(double(x));
}
inline real exp(real x) {
  return real::of(std::exp(double(x)), 3 + 2 * std::fabs(double(x)));
}
inline real log(real x) {
  const double exact = std::log(double(x));
  return x > 0.5 && x < 2 ? real(exact + 4 * parity::ulp()) : real::of(exact, 3);
}
// 1 / inversesqrt: 2 ulp and 2.5 of the division.
inline real sqrt(real x) {
  return real::of(std::sqrt(double(x)), 4.5);
}
inline real sin(real x) {
  return std::sin(double(x)) + 4096 * parity::ulp();
}
inline real cos(real x) {
  return std::cos(double(x)) + 4096 * parity::ulp();
}
inline real atan(real y, real x) {
  return real::of(std::atan2(double(y), double(x)), 4096);
}
inline real floor(real x) {
  return std::floor(double(x));
}
inline real ceil(real x) {
  return std::ceil(double(x));
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
inline vec3 sqrt(vec3 v) {
  return vec3(sqrt(v.x), sqrt(v.y), sqrt(v.z));
}
inline vec3 normalize(vec3 v) {
  return v / sqrt(dot(v, v));
}
inline real length(vec3 v) {
  return sqrt(dot(v, v));
}
