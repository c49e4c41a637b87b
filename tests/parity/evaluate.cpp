// SPDX-License-Identifier: MIT
#include "model/model.hpp"
#include "parity/evaluate_row.hpp"
#include "parity/noisy_number.hpp"
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

}  // namespace

Result evaluateFloat(int which, const Row& row) {
  return unpackResult(f32::parityCase(which, packRow<f32::ParityRow, f32::vec4>(row)));
}

Result evaluateDouble(int which, const Row& row) {
  return unpackResult(f64::parityCase(which, packRow<f64::ParityRow, f64::vec4>(row)));
}

bool canFuse() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") != 0;
#else
  return true;
#endif
}

Result evaluateNoisy(int which, const Row& row, unsigned seed) {
  noiseState = seed;
  return unpackResult(noisy::parityCase(which, packRow<noisy::ParityRow, noisy::vec4>(row)));
}

}  // namespace parity
