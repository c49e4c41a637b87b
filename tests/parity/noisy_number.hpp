// SPDX-License-Identifier: MIT
// A number of double precision whose every operation is as wrong as Vulkan 1.3 allows that of a
// float to be ("Precision and Operation of SPIR-V Instructions"), signs at random: sums and
// products by half an ulp, quotients by 2.5 ulp; ulp = 2^-23 of the result. A product that the
// device adds without rounding it first (fused) lies between.
#pragma once

#include <cmath>
#include <limits>

namespace parity {

inline unsigned noiseState = 1;

// +-1 ulp at random: a linear congruential generator is enough to mix signs.
inline double ulp() {
  noiseState = noiseState * 1664525U + 1013904223U;
  return (noiseState & 0x80000000U) != 0 ? 0x1p-23 : -0x1p-23;
}

class Noisy {
 public:
  Noisy() = default;
  // Implicit, as of all numbers.
  constexpr Noisy(double value) : value_(value) {}
  constexpr explicit operator double() const { return value_; }
  constexpr explicit operator float() const { return static_cast<float>(value_); }
  constexpr explicit operator int() const { return static_cast<int>(value_); }
  constexpr explicit operator unsigned() const { return static_cast<unsigned>(value_); }

  // The result of an operation of that many ulp.
  static Noisy of(double exact, double ulps) { return exact * (1 + ulps * ulp()); }

  Noisy operator-() const { return -value_; }
  Noisy& operator+=(Noisy b) { return *this = of(value_ + b.value_, 0.5); }
  Noisy& operator-=(Noisy b) { return *this = of(value_ - b.value_, 0.5); }
  Noisy& operator*=(Noisy b) { return *this = of(value_ * b.value_, 0.5); }
  Noisy& operator/=(Noisy b) { return *this = of(value_ / b.value_, 2.5); }
  friend Noisy operator+(Noisy a, Noisy b) { return a += b; }
  friend Noisy operator-(Noisy a, Noisy b) { return a -= b; }
  friend Noisy operator*(Noisy a, Noisy b) { return a *= b; }
  friend Noisy operator/(Noisy a, Noisy b) { return a /= b; }
  friend bool operator==(Noisy a, Noisy b) { return a.value_ == b.value_; }
  friend bool operator!=(Noisy a, Noisy b) { return a.value_ != b.value_; }
  friend bool operator<(Noisy a, Noisy b) { return a.value_ < b.value_; }
  friend bool operator>(Noisy a, Noisy b) { return a.value_ > b.value_; }
  friend bool operator<=(Noisy a, Noisy b) { return a.value_ <= b.value_; }
  friend bool operator>=(Noisy a, Noisy b) { return a.value_ >= b.value_; }

 private:
  double value_ = 0;
};

}  // namespace parity

// GLM's vector functions ask for it.
template <>
class std::numeric_limits<parity::Noisy> : public std::numeric_limits<double> {};
