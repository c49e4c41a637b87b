// SPDX-License-Identifier: MIT
// Rows and results as the model's types of any scalar.
#pragma once

#include "parity/parity.hpp"

namespace parity {

template <typename ParityRow, typename Vec4>
ParityRow packRow(const Row& row) {
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
Result unpackResult(const ParityResult& r) {
  const auto at = [](auto x) { return static_cast<double>(x); };
  return {at(r.first.x),  at(r.first.y),  at(r.first.z),  at(r.first.w),
          at(r.second.x), at(r.second.y), at(r.second.z), at(r.second.w)};
}

}  // namespace parity
