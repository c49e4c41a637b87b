// SPDX-License-Identifier: MIT
#include "model/model.hpp"
#include "parity/parity.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#pragma GCC diagnostic ignored "-Wshadow"
namespace welkin::model::f64 {
namespace {
#include "parity/cases.glsl"
}
}  // namespace welkin::model::f64

namespace welkin::model::f32 {
namespace {
#include "parity/cases.glsl"
}
}  // namespace welkin::model::f32

// The order is the order of dependence.
// clang-format off
namespace welkin::model::noisy {
namespace {
#include "parity/noisy_glsl.hpp"
#define precise  // of GLSL; here nothing is contracted
#include "model/model.glsl"
#undef precise
#include "parity/cases.glsl"
}  // namespace
}  // namespace welkin::model::noisy
// clang-format on
#pragma GCC diagnostic pop

namespace parity {
namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
namespace noisy = welkin::model::noisy;

template <typename ParityRow, typename Vec4>
ParityRow pack(const Row& row) {
  using Scalar = typename Vec4::value_type;
  const auto take = [&row](size_t i) {
    return Vec4(static_cast<Scalar>(row[i]), static_cast<Scalar>(row[i + 1]),
                static_cast<Scalar>(row[i + 2]), static_cast<Scalar>(row[i + 3]));
  };
  ParityRow result;
  result.a = take(0);
  result.b = take(4);
  result.c = take(8);
  result.d = take(12);
  result.e = take(16);
  return result;
}

template <typename ParityResult>
Result unpack(const ParityResult& r) {
  const auto at = [](auto x) { return static_cast<double>(x); };
  return {at(r.first.x),  at(r.first.y),  at(r.first.z),  at(r.first.w),
          at(r.second.x), at(r.second.y), at(r.second.z), at(r.second.w)};
}

}  // namespace

Result evaluateFloat(int which, const Row& row) {
  return unpack(f32::parityCase(which, pack<f32::ParityRow, f32::vec4>(row)));
}

Result evaluateDouble(int which, const Row& row) {
  return unpack(f64::parityCase(which, pack<f64::ParityRow, f64::vec4>(row)));
}

Result evaluateNoisy(int which, const Row& row, unsigned seed) {
  noisy::noiseState = seed;
  return unpack(noisy::parityCase(which, pack<noisy::ParityRow, noisy::vec4>(row)));
}

}  // namespace parity
