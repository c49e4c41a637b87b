// SPDX-License-Identifier: MIT
#include "particles/mie.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#if defined(__GNUC__) && defined(__x86_64__)
#define WELKIN_X86
#define WELKIN_INLINE [[gnu::always_inline]] inline
#else
#define WELKIN_INLINE inline
#endif

namespace welkin {
namespace {

using Complex = std::complex<double>;

// [W80] keeps x + 4 x^(1/3) + 1 (x < 8), + 4.05 x^(1/3) + 2 (x < 4200) or + 4 x^(1/3) + 2 terms;
// the largest of them for every x leaves |a_n|^2 < 1e-14.
size_t termCount(double x) {
  return static_cast<size_t>(std::ceil(x + 4.05 * std::cbrt(x) + 2));
}

// D_n(z) = psi_n'(z) / psi_n(z) for n = 1..count by downward recurrence from 0 ([BH83] Eq. 4.89).
// From n above |z| the error of the start shrinks like exp(-(8/3) (2^(1/3) (n - |z|) /
// |z|^(1/3) / 2)^(3/2)): 8 |z|^(1/3) + 16 steps take it below 1e-17.
template <typename T>
void logDerivatives(T z, size_t count, T* result) {
  const double size = std::abs(z);
  const double above = std::max(static_cast<double>(count), size);
  const auto start = static_cast<size_t>(std::ceil(above + 8 * std::cbrt(size) + 16));
  const T inverse = 1.0 / z;
  T d = 0;
  for (size_t n = start; n > 0; --n) {
    if (n <= count) {
      result[n - 1] = d;
    }
    const T step = static_cast<double>(n) * inverse;
    T ratio = d + step;   // psi_(n-1) / psi_n
    if (ratio == T(0)) {  // psi_(n-1) vanishes: the next D is infinite; take it as huge
      ratio = T(0x1p-60) * step;
    }
    d = step - 1.0 / ratio;
  }
}

// Sum of P_n p_n and Q_n q_n over n for LANES angles: result = Re and Im of the first, then of the
// second. With y: mu pi_n - pi_(n-1) = (pi_n - pi_(n-1)) - y pi_n has no cancellation near y = 0.
WELKIN_INLINE void sumTermsBody(const double* y, const MieTerm* terms, size_t count,
                                double* result) {
  constexpr size_t LANES = MieAngles::LANES;
  double pi[LANES];
  double step[LANES];  // pi_n - pi_(n-1)
  double total[4][LANES] = {};
  std::fill_n(pi, LANES, 1.0);
  std::fill_n(step, LANES, 1.0);
  for (size_t i = 0; i < count; ++i) {
    const MieTerm& term = terms[i];
    for (size_t j = 0; j < LANES; ++j) {
      const double bend = y[j] * pi[j];
      const double t = step[j] - bend;  // mu pi_n - pi_(n-1)
      const double nt = term[4] * t;
      const double p = nt + step[j];
      const double q = 2 * pi[j] - p;
      total[0][j] += term[0] * p;
      total[1][j] += term[1] * p;
      total[2][j] += term[2] * q;
      total[3][j] += term[3] * q;
      step[j] = term[5] * t - bend;
      pi[j] += step[j];
    }
  }
  std::copy_n(&total[0][0], 4 * LANES, result);
}

#ifdef WELKIN_X86
// Twice as fast with 4 doubles per instruction; without fused operations the bits are the same.
[[gnu::target("avx2")]] void sumTermsWide(const double* y, const MieTerm* terms, size_t count,
                                          double* result) {
  sumTermsBody(y, terms, count, result);
}
#endif

void sumTerms(const double* y, const MieTerm* terms, size_t count, double* result) {
#ifdef WELKIN_X86
  if (__builtin_cpu_supports("avx2") != 0) {
    sumTermsWide(y, terms, count, result);
    return;
  }
#endif
  sumTermsBody(y, terms, count, result);
}

}  // namespace

void MieAngles::assign(std::span<const double> angles) {
  const auto isBackward = [](double angle) { return angle > std::numbers::pi / 2; };
  const auto padded = [](size_t count) { return (count + LANES - 1) / LANES * LANES; };
  const auto back = static_cast<size_t>(std::count_if(angles.begin(), angles.end(), isBackward));
  backward_ = padded(angles.size() - back);
  folded_.assign(backward_ + padded(back), 0.0);
  order_.resize(angles.size());
  size_t nextForward = 0;
  size_t nextBackward = backward_;
  for (size_t i = 0; i < angles.size(); ++i) {
    const bool backward = isBackward(angles[i]);
    const double half = backward ? std::cos(angles[i] / 2) : std::sin(angles[i] / 2);
    order_[i] = backward ? nextBackward++ : nextForward++;
    folded_[order_[i]] = 2 * half * half;
  }
}

// a_n and b_n, [BH83] Eq. 4.88, as p / (p - i q). Without absorption p and q are real, so that
// Re a_n = |a_n|^2 keeps its relative precision when it is tiny.
void MieSphere::coefficients(Complex m) {
  const size_t count = termCount(x_);
  a_.resize(count);
  b_.resize(count);
  outside_.resize(count);
  inside_.resize(count);
  logDerivatives(m * x_, count, inside_.data());
  logDerivatives(x_, count, outside_.data());
  double psi = std::sin(x_);  // psi_0, chi_0, and psi_(-1), chi_(-1)
  double chi = std::cos(x_);
  double psiBefore = chi;
  double chiBefore = -psi;
  for (size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i + 1);
    const double step = n / x_;
    const double back = (2 * n - 1) / x_;
    const double chiNext = back * chi - chiBefore;
    const double psiNext =  // upward is stable only below n = x; above, by the ratio
        n < x_ ? back * psi - psiBefore : psi / (outside_[i] + step);
    chiBefore = std::exchange(chi, chiNext);
    psiBefore = std::exchange(psi, psiNext);
    const double psiSlope = psiBefore - step * psi;
    const double chiSlope = chiBefore - step * chi;
    const auto ratio = [&](Complex u) {
      const Complex p = u * psi - psiSlope;
      const Complex q = u * chi - chiSlope;
      return p / (p - Complex(0, 1) * q);
    };
    a_[i] = ratio(inside_[i] / m);
    b_[i] = ratio(inside_[i] * m);
  }
}

void MieSphere::solve(double x, Complex m) {
  assert(x > 0 && m.real() > 0 && m.imag() >= 0);
  x_ = x;
  coefficients(m);
  forward_.resize(a_.size());
  backward_.resize(a_.size());
  for (size_t i = 0; i < a_.size(); ++i) {
    const auto n = static_cast<double>(i + 1);
    const double weight = (2 * n + 1) / (n * (n + 1));
    const Complex sum = weight * (a_[i] + b_[i]);
    const Complex difference = weight * (a_[i] - b_[i]);
    const double next = (n + 1) / n;
    // pi_n(-mu) = (-1)^(n+1) pi_n(mu), tau_n(-mu) = (-1)^n tau_n(mu): p and q change places.
    const double sign = i % 2 == 0 ? 1 : -1;
    forward_[i] = {sum.real(), sum.imag(), difference.real(), difference.imag(), n, next};
    backward_[i] = {sign * difference.real(),
                    sign * difference.imag(),
                    sign * sum.real(),
                    sign * sum.imag(),
                    n,
                    next};
  }
}

MieEfficiencies MieSphere::efficiencies() const {
  double extinction = 0;
  double scattering = 0;
  double cosine = 0;
  Complex back = 0;
  for (size_t i = 0; i < a_.size(); ++i) {  // [BH83] Eq. 4.61, 4.62, p. 120, p. 122
    const auto n = static_cast<double>(i + 1);
    extinction += (2 * n + 1) * (a_[i] + b_[i]).real();
    scattering += (2 * n + 1) * (std::norm(a_[i]) + std::norm(b_[i]));
    cosine += (2 * n + 1) / (n * (n + 1)) * (a_[i] * std::conj(b_[i])).real();
    if (i + 1 < a_.size()) {
      const Complex pair = a_[i] * std::conj(a_[i + 1]) + b_[i] * std::conj(b_[i + 1]);
      cosine += n * (n + 2) / (n + 1) * pair.real();
    }
    back += (i % 2 == 0 ? -1 : 1) * (2 * n + 1) * (a_[i] - b_[i]);
  }
  const double area = x_ * x_;
  return {2 / area * extinction, 2 / area * scattering, std::norm(back) / area,
          scattering > 0 ? 2 * cosine / scattering : 0};
}

void MieSphere::sums(const MieAngles& angles, size_t block, double* result) const {
  const std::vector<MieTerm>& terms = block < angles.backward_ ? forward_ : backward_;
  sumTerms(angles.folded_.data() + block, terms.data(), terms.size(), result);
}

void MieSphere::intensities(const MieAngles& angles, std::span<double> result) const {
  constexpr size_t LANES = MieAngles::LANES;
  std::vector<double> folded(angles.folded_.size());
  double s[4 * LANES];
  for (size_t block = 0; block < folded.size(); block += LANES) {
    sums(angles, block, s);
    for (size_t j = 0; j < LANES; ++j) {  // |S1|^2 + |S2|^2 = (|S1 + S2|^2 + |S1 - S2|^2) / 2
      double square = 0;
      for (size_t k = 0; k < 4; ++k) {
        square += s[k * LANES + j] * s[k * LANES + j];
      }
      folded[block + j] = square / 4;
    }
  }
  for (size_t i = 0; i < angles.size(); ++i) {
    result[i] = folded[angles.order_[i]];
  }
}

void MieSphere::amplitudes(const MieAngles& angles, std::span<Complex> s1,
                           std::span<Complex> s2) const {
  constexpr size_t LANES = MieAngles::LANES;
  std::vector<Complex> p(angles.folded_.size());
  std::vector<Complex> q(angles.folded_.size());
  double s[4 * LANES];
  for (size_t block = 0; block < p.size(); block += LANES) {
    sums(angles, block, s);
    for (size_t j = 0; j < LANES; ++j) {
      p[block + j] = {s[j], s[LANES + j]};
      q[block + j] = {s[2 * LANES + j], s[3 * LANES + j]};
    }
  }
  for (size_t i = 0; i < angles.size(); ++i) {
    const size_t j = angles.order_[i];
    const Complex difference = j < angles.backward_ ? q[j] : p[j];
    const Complex sum = j < angles.backward_ ? p[j] : q[j];
    s1[i] = (sum + difference) / 2.0;
    s2[i] = (sum - difference) / 2.0;
  }
}

}  // namespace welkin
