// SPDX-License-Identifier: MIT
// The cases in float, compiled so that a product may be added without being rounded first: what is
// computed twice need not be the same number then, as on GPUs (tests/parity/CMakeLists.txt).
#include "model/model.hpp"
#include "parity/evaluate_row.hpp"
#include "parity/parity.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#pragma GCC diagnostic ignored "-Wshadow"
namespace welkin::model::f32 {
namespace {
#include "parity/cases.glsl"
}
}  // namespace welkin::model::f32
#pragma GCC diagnostic pop

namespace parity {

namespace f32 = welkin::model::f32;

Result evaluateFused(int which, const Row& row) {
  return unpackResult(f32::parityCase(which, packRow<f32::ParityRow, f32::vec4>(row)));
}

}  // namespace parity
