// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace welkin::test {

// An IEEE half as a float.
inline float decodedHalf(uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const float fraction = static_cast<float>(bits & 1023) / 1024.0f;
  const float magnitude =
      exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1.0f + fraction, exponent - 15);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

}  // namespace welkin::test
