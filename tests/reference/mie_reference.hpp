// SPDX-License-Identifier: MIT
// Independent truth for Mie scattering: [BH83] Eq. 4.53 as printed, from Riccati-Bessel functions
// by Miller's downward recurrence (upward for the second kind) in long double, and the angular
// functions by their textbook recurrence in cos(theta). Slow and simple on purpose; published
// results at the end.
// [BH83] Bohren and Huffman 1983, Absorption and Scattering of Light by Small Particles.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "reference/phase_reference.hpp"

namespace reference {

using ComplexReal = std::complex<Real>;

// psi_n(z) = z j_n(z), n = 0..count.
inline std::vector<ComplexReal> riccatiPsi(ComplexReal z, int count) {
  const Real size = std::abs(z);
  const int start =
      std::max(count, static_cast<int>(size)) + 60 + static_cast<int>(12 * std::cbrt(size));
  std::vector<ComplexReal> psi(static_cast<size_t>(start) + 2);
  psi[static_cast<size_t>(start)] = 1e-4000L;
  for (int n = start; n > 0; --n) {
    const auto i = static_cast<size_t>(n);
    psi[i - 1] = Real(2 * n + 1) / z * psi[i] - psi[i + 1];
  }
  // Normalised where the known value is not near a zero.
  const ComplexReal psi0 = std::sin(z);
  const ComplexReal psi1 = std::sin(z) / z - std::cos(z);
  const bool first = std::abs(psi[0]) > std::abs(psi[1]);
  const ComplexReal scale = first ? psi0 / psi[0] : psi1 / psi[1];
  psi.resize(static_cast<size_t>(count) + 1);
  for (ComplexReal& value : psi) {
    value *= scale;
  }
  return psi;
}

struct MieTruth {
  Real x;
  std::vector<ComplexReal> a, b;  // [0] unused

  // m = n + i k, 10 (x + 1)^(1/3) + 8 terms above x.
  MieTruth(Real sizeParameter, ComplexReal m) : x(sizeParameter) {
    const int count = static_cast<int>(x + 8 + 10 * std::cbrt(x + 1));
    const std::vector<ComplexReal> outside = riccatiPsi(x, count);
    const std::vector<ComplexReal> inside = riccatiPsi(m * x, count);
    a.resize(outside.size());
    b.resize(outside.size());
    Real chiBefore = std::cos(x);  // chi_0 = -x y_0, chi_1
    Real chi = std::cos(x) / x + std::sin(x);
    for (int n = 1; n <= count; ++n) {
      const auto i = static_cast<size_t>(n);
      const ComplexReal xi(outside[i].real(), -chi);
      const ComplexReal xiBefore(outside[i - 1].real(), -chiBefore);
      const ComplexReal slopeOut = outside[i - 1] - Real(n) / x * outside[i];
      const ComplexReal slopeXi = xiBefore - Real(n) / x * xi;
      const ComplexReal slopeIn = inside[i - 1] - Real(n) / (m * x) * inside[i];
      a[i] = (m * inside[i] * slopeOut - outside[i] * slopeIn) /
             (m * inside[i] * slopeXi - xi * slopeIn);
      b[i] = (inside[i] * slopeOut - m * outside[i] * slopeIn) /
             (inside[i] * slopeXi - m * xi * slopeIn);
      const Real next = (2 * n + 1) / x * chi - chiBefore;
      chiBefore = chi;
      chi = next;
    }
  }

  Real extinction() const {
    Real sum = 0;
    for (size_t n = 1; n < a.size(); ++n) {
      sum += static_cast<Real>(2 * n + 1) * (a[n] + b[n]).real();
    }
    return 2 / (x * x) * sum;
  }

  Real scattering() const {
    Real sum = 0;
    for (size_t n = 1; n < a.size(); ++n) {
      sum += static_cast<Real>(2 * n + 1) * (std::norm(a[n]) + std::norm(b[n]));
    }
    return 2 / (x * x) * sum;
  }

  struct Amplitudes {
    ComplexReal s1, s2;
    Real intensity() const { return (std::norm(s1) + std::norm(s2)) / 2; }
  };
  // [BH83] Eq. 4.74 with 4.47.
  Amplitudes amplitudes(Real theta) const {
    const Real mu = std::cos(theta);
    Amplitudes sum = {};
    Real before = 0;
    Real pi = 1;
    for (size_t i = 1; i < a.size(); ++i) {
      const auto n = static_cast<Real>(i);
      const Real tau = n * mu * pi - (n + 1) * before;
      const Real factor = (2 * n + 1) / (n * (n + 1));
      sum.s1 += factor * (a[i] * pi + b[i] * tau);
      sum.s2 += factor * (a[i] * tau + b[i] * pi);
      const Real next = ((2 * n + 1) * mu * pi - (n + 1) * before) / n;
      before = pi;
      pi = next;
    }
    return sum;
  }
};

// Test cases of MIEV0 as printed: W. J. Wiscombe 1979, NCAR/TN-140+STR, table of test results
// (single precision; m = n - i k there). asymmetry is g Qsca.
struct WiscombeCase {
  double x, n, k, extinction, scattering, asymmetry;
};
constexpr WiscombeCase WISCOMBE[] = {
    {0.099, 0.75, 0, 7.417859e-06, 7.417859e-06, 1.074279e-08},
    {0.101, 0.75, 0, 8.033542e-06, 8.033542e-06, 1.211000e-08},
    {10, 0.75, 0, 2.232265, 2.232265, 2.001164},
    {1000, 0.75, 0, 1.997908, 1.997908, 1.688121},
    {1, 1.33, 1e-5, 9.395198e-02, 9.392330e-02, 1.733048e-02},
    {100, 1.33, 1e-5, 2.101321, 2.096594, 1.821854},
    {10000, 1.33, 1e-5, 2.004089, 1.723857, 1.564987},
    {0.055, 1.5, 1, 1.014910e-01, 1.131687e-05, 5.558541e-09},
    {0.056, 1.5, 1, 1.033467e-01, 1.216311e-05, 6.193255e-09},
    {1, 1.5, 1, 2.336321, 0.6634538, 0.1274736},
    {100, 1.5, 1, 2.097502, 1.283697, 1.091466},
    {10000, 1.5, 1, 2.004368, 1.236574, 1.046525},
    {1, 10, 10, 2.532993, 2.049405, -0.2267961},
    {100, 10, 10, 2.071124, 1.836785, 1.021648},
    {10000, 10, 10, 2.005914, 1.795393, 0.9842238},
};

// The same report: amplitudes for x = 1, m = 1.5 - i at 0, 30, ..., 180 degrees, of which the
// convention n + i k has the conjugates.
constexpr double WISCOMBE_S1[7][2] = {
    {0.584080, 0.190515}, {0.565702, 0.187200}, {0.517525, 0.178443}, {0.456340, 0.167167},
    {0.400212, 0.156643}, {0.362157, 0.149391}, {0.348844, 0.146829}};
constexpr double WISCOMBE_S2[7][2] = {
    {0.584080, 0.190515},   {0.500161, 0.145611},   {0.287964, 0.041054},  {0.036228, -0.061826},
    {-0.174875, -0.122959}, {-0.305682, -0.143846}, {-0.348844, -0.146829}};

// [BH83] appendix A, sample output: sphere of 0.525 um, m = 1.55, 0.6328 um. S11 over its forward
// value and polarisation -S12 / S11 at 0, 9, ..., 180 degrees.
constexpr double BH_EXTINCTION = 3.10543;
constexpr double BH_BACKSCATTER = 2.92534;
constexpr double BH_S11[21] = {1.0,        .785390,    .356897,    .0766119,   .0355355, .0701845,
                               .0574313,   .0219660,   .0125959,   .0173750,   .0124601, .679093e-2,
                               .954239e-2, .863419e-2, .227421e-2, .543998e-2, .0160243, .0188852,
                               .0195254,   .0301676,   .0383189};
constexpr double BH_POLARISATION[21] = {
    0,        -.459811e-2, -.0458541, -.364744, -.534997, .00959953, .0477927,
    -.440604, -.831996,    .0341670,  .230462,  -.713472, -.756255,  -.281215,
    -.239612, -.850804,    -.706334,  -.891081, -.783319, -.196194,  0};

}  // namespace reference
