// SPDX-License-Identifier: MIT
// src/particles/mie against published results, an independent long double solution, and laws that
// hold for any sphere.
#include "particles/mie.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "reference/mie_reference.hpp"

namespace {

using Complex = std::complex<double>;
using reference::Real;
using welkin::MieAngles;
using welkin::MieEfficiencies;
using welkin::MieSphere;

constexpr double PI = std::numbers::pi;
constexpr double EPS = 0x1p-53;

MieSphere solved(double x, Complex m) {
  MieSphere sphere;
  sphere.solve(x, m);
  return sphere;
}

std::vector<double> intensities(const MieSphere& sphere, const std::vector<double>& angles) {
  std::vector<double> result(angles.size());
  sphere.intensities(MieAngles(angles), result);
  return result;
}

// Half a unit of the last of `digits` printed digits.
double printed(double value, int digits) {
  const double magnitude = std::floor(std::log10(std::abs(value)));
  return 0.5 * std::pow(10.0, magnitude + 1 - digits);
}

TEST(Mie, ReproducesWiscombesTestCasesToTheLastPrintedDigit) {
  for (const reference::WiscombeCase& one : reference::WISCOMBE) {
    const MieEfficiencies q = solved(one.x, {one.n, one.k}).efficiencies();
    // MIEV0 is single precision (6e-8 per operation), and has an expansion for x |m| <= 0.1.
    const double slack = one.x < 0.11 ? 32 * 0x1p-24 : 2 * 0x1p-24;
    const auto near = [&](double value, double truth) {
      EXPECT_NEAR(value, truth, printed(truth, 7) + slack * std::abs(truth))
          << "x " << one.x << " m " << one.n << " + " << one.k << " i";
    };
    near(q.extinction, one.extinction);
    near(q.scattering, one.scattering);
    near(q.asymmetry * q.scattering, one.asymmetry);
  }
}

TEST(Mie, ReproducesWiscombesAmplitudes) {
  std::vector<double> angles;
  for (int i = 0; i < 7; ++i) {
    angles.push_back(i * PI / 6);
  }
  std::vector<Complex> s1(7);
  std::vector<Complex> s2(7);
  solved(1, {1.5, 1}).amplitudes(MieAngles(angles), s1, s2);
  constexpr double HALF_DIGIT = 0.5e-6 * 1.1;  // and 1/10 of it for single precision
  for (size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(s1[i].real(), reference::WISCOMBE_S1[i][0], HALF_DIGIT) << i;
    EXPECT_NEAR(s1[i].imag(), -reference::WISCOMBE_S1[i][1], HALF_DIGIT) << i;
    EXPECT_NEAR(s2[i].real(), reference::WISCOMBE_S2[i][0], HALF_DIGIT) << i;
    EXPECT_NEAR(s2[i].imag(), -reference::WISCOMBE_S2[i][1], HALF_DIGIT) << i;
  }
}

TEST(Mie, ReproducesTheSampleOutputOfBohrenAndHuffman) {
  const MieSphere sphere = solved(2 * PI * 0.525 / 0.6328, 1.55);
  const MieEfficiencies q = sphere.efficiencies();
  EXPECT_NEAR(q.extinction, reference::BH_EXTINCTION, 0.5e-5);
  EXPECT_NEAR(q.scattering, reference::BH_EXTINCTION, 0.5e-5);
  EXPECT_NEAR(q.backscatter, reference::BH_BACKSCATTER, 0.5e-5);
  std::vector<double> angles;
  for (int i = 0; i <= 20; ++i) {
    angles.push_back(i * PI / 20);
  }
  std::vector<Complex> s1(21);
  std::vector<Complex> s2(21);
  sphere.amplitudes(MieAngles(angles), s1, s2);
  for (size_t i = 0; i <= 20; ++i) {
    const double s11 = (std::norm(s1[i]) + std::norm(s2[i])) / 2;
    const double s12 = (std::norm(s2[i]) - std::norm(s1[i])) / 2;
    const double relative = s11 / std::norm(s1[0]);
    // Single precision there: one unit of the 6th digit, polarisation is a difference.
    EXPECT_NEAR(relative / reference::BH_S11[i], 1, 10 * 1e-6) << i;
    EXPECT_NEAR(-s12 / s11, reference::BH_POLARISATION[i], 1e-6) << i;
  }
}

struct Sphere {
  double x;
  Complex m;
};

std::vector<Sphere> spheres() {
  std::vector<Sphere> result;
  for (const double x : {0.01, 0.1, 0.7, 1.0, 3.3, 10.0, 57.3, 114.3, 1000.0, 5712.0}) {
    for (const Complex m : {Complex(1.33503), Complex(1.31, 2e-9), Complex(0.75), Complex(1.5, 0.1),
                            Complex(1.33, 1e-3), Complex(2.5)}) {
      result.push_back({x, m});
    }
  }
  result.push_back({20000, 1.335});
  result.push_back({20000, {1.335, 1e-6}});
  result.push_back({300, {10, 10}});
  return result;
}

// Errors that rounding x and m by BACKWARD causes in a_n and b_n. Near a resonance they are large:
// no method in double does better, since x itself is rounded once.
constexpr double BACKWARD = 64 * EPS;
constexpr double FLOOR = 16 * EPS;

struct Bound {
  reference::MieTruth truth, otherX, otherM;

  Bound(double x, Complex m)
      : truth(x, wide(m)),
        otherX(x * (1 + static_cast<Real>(BACKWARD)), wide(m)),
        otherM(x, wide(m) * (1 + static_cast<Real>(BACKWARD))) {}

  static reference::ComplexReal wide(Complex m) { return {m.real(), m.imag()}; }

  double a(size_t n) const {
    return FLOOR + static_cast<double>(std::abs(otherX.a[n] - truth.a[n]) +
                                       std::abs(otherM.a[n] - truth.a[n]));
  }
  double b(size_t n) const {
    return FLOOR + static_cast<double>(std::abs(otherX.b[n] - truth.b[n]) +
                                       std::abs(otherM.b[n] - truth.b[n]));
  }
};

TEST(Mie, CoefficientsMatchTheLongDoubleSolution) {
  constexpr double DROPPED = 3e-7;  // sqrt(1e-14), [W80]'s criterion, and the resonances' share
  for (const auto& [x, m] : spheres()) {
    const Bound bound(x, m);
    const MieSphere sphere = solved(x, m);
    for (size_t n = 1; n < bound.truth.a.size(); ++n) {
      const Complex a(bound.truth.a[n]);
      const Complex b(bound.truth.b[n]);
      if (n > sphere.a().size()) {
        EXPECT_LE(std::max(std::abs(a), std::abs(b)), DROPPED) << "x " << x << " n " << n;
        continue;
      }
      EXPECT_LE(std::abs(sphere.a()[n - 1] - a), bound.a(n)) << "x " << x << " m " << m << " " << n;
      EXPECT_LE(std::abs(sphere.b()[n - 1] - b), bound.b(n)) << "x " << x << " m " << m << " " << n;
    }
  }
}

// |pi_n| and |tau_n| times (2 n + 1) / (n (n + 1)) are at most (2 n + 1) / 2 at every angle.
TEST(Mie, IntensitiesMatchTheLongDoubleSolutionUpToBothPoles) {
  std::vector<double> angles;
  for (const double t : {0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.7, 1.5, PI / 2}) {
    angles.push_back(t);
    angles.push_back(PI - t);
  }
  for (const auto& [x, m] : spheres()) {
    const Bound bound(x, m);
    const MieSphere sphere = solved(x, m);
    double error = 0;  // of S1 and S2
    for (size_t n = 1; n < bound.truth.a.size(); ++n) {
      const double half = static_cast<double>(2 * n + 1) / 2;
      const auto size =
          static_cast<double>(std::abs(bound.truth.a[n]) + std::abs(bound.truth.b[n]));
      if (n > sphere.a().size()) {
        error += half * size;
        continue;
      }
      // 16 roundings per term; the reference subtracts 1 - mu in 64 bits, n^2 / 2 times.
      const double own = 16 * EPS + 0x1p-64 * static_cast<double>(n * n);
      error += half * (bound.a(n) + bound.b(n) + own * size);
    }
    const std::vector<double> values = intensities(sphere, angles);
    for (size_t i = 0; i < angles.size(); ++i) {
      const auto exact = static_cast<double>(bound.truth.amplitudes(angles[i]).intensity());
      // Of the mean square of two numbers, each wrong by `error`.
      EXPECT_NEAR(values[i], exact, 2 * std::sqrt(exact) * error + error * error)
          << "x " << x << " m " << m << " theta " << angles[i];
      EXPECT_NEAR(values[i] / exact, 1, 4e-6) << "x " << x << " m " << m << " at " << angles[i];
    }
  }
}

// Terms dropped: their share of extinction is below 1e-14, their rounding below 64 EPS each.
TEST(Mie, WithoutAbsorptionScatteringIsExtinction) {
  for (const double x : {0.01, 0.3, 1.0, 20.0, 333.3, 5000.0, 20000.0}) {
    for (const double m : {0.75, 1.31, 1.33503, 2.5}) {
      const MieEfficiencies q = solved(x, m).efficiencies();
      EXPECT_NEAR(q.scattering / q.extinction, 1, 64 * EPS) << "x " << x << " m " << m;
    }
  }
}

// Re a_1 and |a_1|^2 of a tiny sphere are 6 powers of x below |a_1|: only a quotient of reals
// keeps them.
TEST(Mie, TinySpheresScatterLikeRayleighsDipole) {
  for (const double x : {0.01, 0.02, 0.05}) {
    const double m = 1.335;
    const double polarisability = (m * m - 1) / (m * m + 2);
    const MieSphere sphere = solved(x, m);
    const double limit = 8.0 / 3 * std::pow(x, 4) * polarisability * polarisability;
    // The next order of the series, [BH83] Eq. 5.6: 1 + 6/5 x^2 (m^2 - 2) / (m^2 + 2); then x^3.
    const double next = 1 + 1.2 * x * x * (m * m - 2) / (m * m + 2);
    EXPECT_NEAR(sphere.efficiencies().scattering / (limit * next), 1, x * x * x) << x;
    const std::vector<double> angles = {0.0, 0.5, PI / 2, 2.5, PI};
    const std::vector<double> values = intensities(sphere, angles);
    for (size_t i = 0; i < angles.size(); ++i) {
      const double rayleigh = (1 + std::pow(std::cos(angles[i]), 2)) / 2;
      EXPECT_NEAR(values[i] / values[0], rayleigh, x * x) << x << " at " << angles[i];
    }
  }
}

// [BH83] Eq. 4.76: extinction is the forward amplitude.
TEST(Mie, ForwardAmplitudeGivesTheExtinction) {
  for (const auto& [x, m] : spheres()) {
    const MieSphere sphere = solved(x, m);
    const std::vector<double> ends = {0.0, PI};
    std::vector<Complex> s1(2);
    std::vector<Complex> s2(2);
    sphere.amplitudes(MieAngles(ends), s1, s2);
    const MieEfficiencies q = sphere.efficiencies();
    // Sums of the same terms in two orders; pi_n grows like n^2 over n steps.
    const double terms = static_cast<double>(sphere.a().size());
    EXPECT_NEAR(4 / (x * x) * s1[0].real() / q.extinction, 1, 4 * terms * EPS) << x << m;
    // pi_n = +-tau_n there; each of the terms is at most 2 n + 1.
    EXPECT_LE(std::abs(s1[0] - s2[0]), terms * terms * EPS) << x << m;
    EXPECT_LE(std::abs(s1[1] + s2[1]), terms * terms * EPS) << x << m;
    EXPECT_NEAR(4 / (x * x) * std::norm(s1[1]) / q.backscatter, 1, 1e-9) << x << m;
  }
}

// Large spheres block twice their area; the edge adds 1.9924 x^(-2/3) (Nussenzveig and Wiscombe
// 1980, Phys. Rev. Lett. 45, 1490, Eq. 1). Their next terms, x^(-1) and x^(-4/3), are below a
// tenth of it for x >= 1000 and strong absorption.
TEST(Mie, LargeSpheresBlockTwiceTheirAreaAndTheirEdge) {
  for (const double x : {1000.0, 5000.0, 20000.0}) {
    const double edge = 1.992386 * std::pow(x, -2.0 / 3);
    const double q = solved(x, {1.5, 1}).efficiencies().extinction;
    EXPECT_NEAR((q - 2) / edge, 1, 0.1) << x;
  }
}

TEST(Mie, AsymmetryAndScatteringAreIntegralsOfTheIntensity) {
  for (const auto& [x, m] : std::vector<Sphere>{{0.5, 1.33}, {5, {1.5, 0.1}}, {60, 1.335}}) {
    const MieSphere sphere = solved(x, m);
    const MieEfficiencies q = sphere.efficiencies();
    // The intensity has 2 x waves over 180 degrees: panels of a third of one, 8 nodes each.
    const auto points = reference::anglePoints(0, reference::PI, 1 / (Real(x) + 3));
    std::vector<double> angles;
    for (const auto& point : points) {
      angles.push_back(static_cast<double>(point.theta));
    }
    const std::vector<double> values = intensities(sphere, angles);
    double total = 0;
    double cosine = 0;
    for (size_t i = 0; i < angles.size(); ++i) {
      const double share =
          static_cast<double>(points[i].weight) * values[i] / (PI * x * x * q.scattering);
      total += share;
      cosine += share * std::cos(angles[i]);
    }
    EXPECT_NEAR(total, 1, 1e-9) << x;
    EXPECT_NEAR(cosine, q.asymmetry, 1e-9) << x;
  }
}

TEST(Mie, AnAngleGivesTheSameBitsInAnyListAndAnObjectAfterAnySphere) {
  std::vector<double> angles;
  for (int i = 0; i <= 100; ++i) {
    angles.push_back(std::fmod(i * 2.399963, PI));
  }
  MieSphere reused = solved(300, {1.4, 0.1});
  reused.solve(42, 1.33);
  const std::vector<double> together = intensities(reused, angles);
  const MieSphere fresh = solved(42, 1.33);
  for (size_t i = 0; i < angles.size(); ++i) {
    EXPECT_EQ(intensities(fresh, {angles[i]})[0], together[i]) << angles[i];
  }
}

}  // namespace
