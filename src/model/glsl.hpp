// SPDX-License-Identifier: MIT
// The GLSL subset of shaders/model as C++ for one scalar type. Included twice by model.hpp, inside
// namespace welkin::model::f32 and ::f64, with WELKIN_REAL defined; therefore no include guard.
//
// Not `using namespace glm`: `0.5 * vec3` would then not deduce, and a float function could become
// double unnoticed. Vector built-ins come from GLM by argument-dependent lookup.
using real = WELKIN_REAL;
using vec2 = glm::vec<2, real>;
using vec3 = glm::vec<3, real>;
using vec4 = glm::vec<4, real>;
using ivec2 = glm::ivec2;
using ivec3 = glm::ivec3;
using uint = unsigned int;
using bvec3 = glm::bvec3;

// The specialisation constants of the passes; on the CPU everything is compiled in.
constexpr bool AIR_ENABLED = true;
constexpr bool FOG_ENABLED = true;
constexpr bool ABSORBER_ENABLED = true;

inline real exp(real x) {
  return std::exp(x);
}
inline real log(real x) {
  return std::log(x);
}
inline real sqrt(real x) {
  return std::sqrt(x);
}
inline real sin(real x) {
  return std::sin(x);
}
inline real cos(real x) {
  return std::cos(x);
}
inline real atan(real y, real x) {
  return std::atan2(y, x);
}
inline real abs(real x) {
  return std::fabs(x);
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
  return a * (real(1) - t) + b * t;
}
inline real sign(real x) {
  return x > real(0) ? real(1) : (x < real(0) ? real(-1) : real(0));
}
inline vec3 exp(vec3 v) {
  return vec3(std::exp(v.x), std::exp(v.y), std::exp(v.z));
}
