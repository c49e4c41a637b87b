// SPDX-License-Identifier: MIT
// Forward-scattering tables against independent quadrature, Legendre sums and random walks.
#include "tables/multiscatter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "particles/phase_curve.hpp"
#include "reference/phase_reference.hpp"
#include "tables/scattering_orders.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
using namespace welkin;
using reference::Real;

constexpr double EPS_FLOAT = 0x1p-24;
constexpr double EPS_DOUBLE = 0x1p-53;

struct Case {
  std::string name;
  FogPhaseParams phase;
};

Case fog(double d) {
  return {"fog " + std::to_string(d), phaseParameters(PhaseKind::HgDraine, d, 0)};
}
Case hg(double g) {
  return {"HG " + std::to_string(g), phaseParameters(PhaseKind::HenyeyGreenstein, 0, g)};
}
Case rayleigh() {
  return {"Rayleigh", phaseParameters(PhaseKind::Rayleigh, 0, 0)};
}

std::vector<Case> media() {
  return {fog(5), fog(12), fog(20),  fog(50),  hg(-0.6),
          hg(0),  hg(0.3), hg(0.85), hg(0.95), rayleigh()};
}

double yOf(double theta) {
  const double s = std::sin(theta / 2);
  return 2 * s * s;
}

// Moments from the reference phase functions: HG's are g^l, Draine's by quadrature up to where they
// have vanished, g^l < 1e-20.
std::vector<Real> referenceMoments(const FogPhaseParams& p, int count) {
  const Real w = p.weightD;
  const std::vector<Real> draine = reference::moments(
      [&](Real c) { return reference::draine(p.alpha, p.gD, c); }, std::min(count, 180));
  std::vector<Real> chi(static_cast<size_t>(count));
  for (size_t l = 0; l < chi.size(); ++l) {
    chi[l] = (1 - w) * std::pow(Real(1) - p.gapHg, static_cast<Real>(l));
    if (l < draine.size()) {
      chi[l] += w * draine[l];
    }
  }
  return chi;
}

constexpr int ANGLES = kCurveNodes;

// The rows as the volume passes read them.
struct Rows {
  FogPhaseParams phase;
  SourceRows rows;
  float log(size_t depth, size_t angle) const { return rows.logSource[depth * ANGLES + angle]; }
  float forward(size_t depth) const { return rows.forwardFraction[0][depth]; }
};

Rows build(const FogPhaseParams& phase) {
  std::vector<double> y;
  for (int i = 0; i < ANGLES; ++i) {
    y.push_back(phaseNode(i / (ANGLES - 1.0)));
  }
  return {phase, closedSourceRows(y, phase)};
}

// The source over the phase function, from the table: linear in both coordinates.
double lookUp(const Rows& t, double n, double y) {
  const double u = f64::phaseCoordinate(y) * (ANGLES - 1);
  const double v = f64::depthCoordinate(n) * (kPhaseDepths - 1);
  const size_t i = static_cast<size_t>(std::min(u, ANGLES - 2.0));
  const size_t j = static_cast<size_t>(std::min(v, kPhaseDepths - 2.0));
  const auto row = [&](size_t r) {
    const double a = static_cast<double>(t.log(r, i));
    const double b = static_cast<double>(t.log(r, i + 1));
    return a + (b - a) * (u - static_cast<double>(i));
  };
  return std::exp(row(j) + (row(j + 1) - row(j)) * (v - static_cast<double>(j))) /
         evalPhase(t.phase, y);
}

TEST(ScatteringCoordinates, NodesAreTheInverse) {
  for (int i = 0; i < 128; ++i) {
    const double s = i / 127.0;
    // Near y = 2 the coordinate is the fourth root of 2 - y, which turns eps into eps^(1/4).
    EXPECT_NEAR(f64::phaseCoordinate(phaseNode(s)), s, i > 125 ? 4e-4 : 1e-10) << i;
  }
  EXPECT_EQ(phaseNode(0), 0.0);
  EXPECT_EQ(phaseNode(1), 2.0);
  for (int j = 0; j < kPhaseDepths; ++j) {
    const double s = j / (kPhaseDepths - 1.0);
    EXPECT_NEAR(f64::depthCoordinate(depthNode(s)), s, 10 * EPS_DOUBLE) << j;
    EXPECT_NEAR(f32::depthCoordinate(static_cast<float>(depthNode(s))), s, 6 * EPS_FLOAT) << j;
  }
  EXPECT_EQ(f32::depthCoordinate(1e30f), 1.0f);
  EXPECT_EQ(f32::depthCoordinate(-2.0f), 0.0f);
  EXPECT_EQ(f32::phaseCoordinate(2.0000005f), 1.0f);
}

TEST(LegendreMoments, MatchQuadrature) {
  for (const Case& c : media()) {
    std::vector<double> chi(300);
    legendreMoments(c.phase, chi);
    const FogPhaseParams& p = c.phase;
    const std::vector<Real> truth = reference::moments(
        [&](Real mu) {
          return (1 - static_cast<Real>(p.weightD)) * reference::henyeyGreenstein(p.gHg, mu) +
                 p.weightD * reference::draine(p.alpha, p.gD, mu);
        },
        300);
    for (size_t l = 0; l < chi.size(); ++l) {
      EXPECT_NEAR(chi[l], static_cast<double>(truth[l]), 1e-9) << c.name << " l " << l;
    }
    EXPECT_NEAR(chi[1], meanCosine(p), 4 * EPS_DOUBLE) << c.name;
  }
}

TEST(IntegerScattering, ForwardPartsOfHg085AreThePublishedOnes) {
  std::vector<double> chi(400);  // 0.85^400 = 6e-29
  legendreMoments(hg(0.85).phase, chi);
  const double digits = 0.5e-3;  // the values are given to 3 digits
  EXPECT_NEAR(forwardFractionInteger(chi, 1), 0.964, digits);
  EXPECT_NEAR(forwardFractionInteger(chi, 2), 0.924, digits);
  EXPECT_NEAR(forwardFractionInteger(chi, 3), 0.882, digits);
  EXPECT_NEAR(forwardFractionInteger(chi, 4), 0.840, digits);
  EXPECT_NEAR(forwardFractionInteger(chi, 12), 0.605, digits);
  EXPECT_NEAR(forwardFractionInteger(chi, 26), 0.511, digits);
}

TEST(IntegerScattering, HgScatteredTwiceIsHgOfTheSquare) {
  std::vector<double> chi(400);
  legendreMoments(hg(0.85).phase, chi);
  for (const int n : {1, 2, 3, 7}) {
    for (const double mu : {-1.0, -0.3, 0.4, 0.95, 1.0}) {
      const double truth = static_cast<double>(reference::henyeyGreenstein(std::pow(0.85L, n), mu));
      EXPECT_NEAR(scatteredInteger(chi, n, mu) / truth, 1, 1e-11) << n << " " << mu;
    }
  }
}

TEST(Multiscatter, SourceMatchesLongLegendreSums) {
  for (const Case& c : media()) {
    const int terms = c.phase.gHg > 0.99 ? 24000 : 4000;  // g^l < 1e-20
    const std::vector<Real> chi = referenceMoments(c.phase, terms);
    for (const double n : {0.03, 0.9, 4.7, 21.0}) {
      const std::vector<Real> source = reference::poissonMoments(chi, n);
      for (const double theta : {0.0, 0.004, 0.1, 0.8, 2.0, 3.14159}) {
        const Real truth = reference::legendreSum(source, std::cos(static_cast<Real>(theta)));
        const double value = sourceDistribution(c.phase, n, yOf(theta));
        // Long double rounding times the sum of 2 l + 1, over values of at least 1e-4.
        EXPECT_NEAR(value / static_cast<double>(truth), 1, 1e-9)
            << c.name << " n " << n << " theta " << theta;
      }
    }
  }
}

TEST(Multiscatter, SourceMatchesRandomWalks) {
  constexpr int SAMPLES = 100000;
  for (const double n : {0.5, 3.0, 10.0}) {
    const FogPhaseParams phase = hg(0.85).phase;
    double forward = 0;
    double cosine = 0;
    double square = 0;
    for (const double c : reference::randomWalks(0.85, n, SAMPLES, 3)) {
      forward += c > 0 ? 1 : 0;
      cosine += c;
      square += c * c;
    }
    const double sigma = 0.5 / std::sqrt(SAMPLES);  // largest for a fraction; 4 of them
    EXPECT_NEAR(forward / SAMPLES, forwardFraction(phase, n), 4 * sigma) << n;
    // Moments of the source: chi_l exp(-n (1 - chi_l)); the spread of a cosine is below 0.6.
    const double mean = 0.85 * std::exp(-n * 0.15);
    const double second = 0.7225 * std::exp(-n * (1 - 0.7225));
    EXPECT_NEAR(cosine / SAMPLES, mean, 4 * 1.2 * sigma) << n;
    EXPECT_NEAR(square / SAMPLES, (2 * second + 1) / 3, 4 * 1.2 * sigma) << n;
  }
}

TEST(Multiscatter, ForwardFractionIsTheHemisphereOfTheSource) {
  for (const Case& c : media()) {
    for (const double n : {0.0, 0.4, 6.0}) {
      const Real truth = reference::integrateSphere(
          [&](Real t) {
            return static_cast<Real>(sourceDistribution(c.phase, n, yOf(static_cast<double>(t))));
          },
          0, reference::PI / 2, 0.1L);
      EXPECT_NEAR(forwardFraction(c.phase, n), static_cast<double>(truth), 1e-9) << c.name << n;
    }
  }
}

TEST(Multiscatter, ForwardFractionFallsMonotonicallyToOneHalf) {
  for (const Case& c : {fog(5), fog(20), fog(50), hg(0.3), hg(0.85)}) {
    const Rows t = build(c.phase);
    EXPECT_FLOAT_EQ(t.forward(0), static_cast<float>(forwardFraction(c.phase, 0)));
    for (size_t j = 1; j < kPhaseDepths; ++j) {
      EXPECT_LE(t.forward(j), t.forward(j - 1)) << c.name << j;
    }
    EXPECT_LT(t.forward(8), t.forward(0));
    // At n = 64 what is left of chi_1, 3/4 of which goes into the hemisphere.
    const double g = meanCosine(c.phase);
    EXPECT_NEAR(t.forward(31), 0.5, 0.75 * g * std::exp(-64 * (1 - g)) + 2 * EPS_FLOAT);
  }
}

TEST(Multiscatter, FirstRowIsSingleScattering) {
  for (const Case& c : media()) {
    const Rows t = build(c.phase);
    for (size_t i = 0; i < ANGLES; ++i) {
      const double truth =
          std::log(evalPhase(c.phase, phaseNode(static_cast<double>(i) / (ANGLES - 1.0))));
      // One rounding to float.
      EXPECT_NEAR(t.log(0, i), truth, EPS_FLOAT * std::max(std::abs(truth), 1.0)) << c.name << i;
    }
  }
}

TEST(Multiscatter, TableStaysFiniteForExtremeAsymmetry) {
  for (const Case& c : {hg(-0.999), hg(-0.9), hg(0.999), fog(50)}) {
    const Rows t = build(c.phase);
    for (const float value : t.rows.logSource) {
      ASSERT_TRUE(std::isfinite(value)) << c.name;
      // At least exp(-n) of the least value of P; at most its peak.
      ASSERT_GE(value, -64.001f - 24.0f) << c.name;
      ASSERT_LE(value, 24.0f) << c.name;
    }
    for (size_t i = 0; i < kPhaseDepths; ++i) {
      ASSERT_TRUE(t.forward(i) >= 0 && t.forward(i) <= 1) << c.name;
    }
  }
}

TEST(Multiscatter, TableNormalisesToOne) {
  for (const Case& c : media()) {
    const Rows t = build(c.phase);
    for (int j = 0; j < 2 * kPhaseDepths - 1; ++j) {
      const double n = depthNode(j / (2 * kPhaseDepths - 2.0));
      const Real sum = reference::integrateSphere(
          [&](Real theta) {
            const double y = yOf(static_cast<double>(theta));
            return static_cast<Real>(evalPhase(c.phase, y) * lookUp(t, n, y));
          },
          0, reference::PI, 0.02L);
      // At the nodes of depth only interpolation in angle errs: 1e-3. Between them linear
      // interpolation adds spacing^2 / 8 times the second derivative in ln(1 + n): that is near 1
      // (measured 2.1e-3 in all), and near 3 where a backward peak turns forward with the second
      // scattering (measured 8.4e-3).
      const double spacing = std::log(65.0) / (kPhaseDepths - 1);
      const double curvature = c.phase.gHg < 0 ? 4 : 1;
      const double between = 1e-3 + curvature * spacing * spacing / 8;
      EXPECT_NEAR(static_cast<double>(sum), 1, j % 2 == 0 ? 1e-3 : between) << c.name << " n " << n;
    }
  }
}

TEST(Multiscatter, TableMatchesTheSourceBetweenItsNodes) {
  for (const Case& c : media()) {
    const Rows t = build(c.phase);
    double worst = 0;
    double worstForward = 0;
    for (int j = 0; j + 1 < kPhaseDepths; ++j) {
      const double n = depthNode((j + 0.5) / (kPhaseDepths - 1.0));
      for (int i = 0; i + 1 < ANGLES; i += 8) {
        const double y = phaseNode((i + 0.5) / (ANGLES - 1.0));
        const double truth = sourceDistribution(c.phase, n, y) / evalPhase(c.phase, y);
        const double error = std::abs(lookUp(t, n, y) / truth - 1);
        double& place = y < 4e-4 ? worstForward : worst;  // 1.6 degrees
        place = std::max(place, error);
      }
    }
    // Measured at the middle of every cell, the worst place. Within 1.6 degrees of the light and
    // beyond n = 10 the ratio of 50 um droplets falls by e^-12; a backward peak turns forward
    // within the first cell of depth.
    const bool backward = c.phase.gHg < 0;
    EXPECT_LE(worst, backward ? 0.2 : 0.03) << c.name;
    EXPECT_LE(worstForward, backward ? 0.2 : 0.25) << c.name;
  }
}

// The source's logarithm changes fastest at n = 0, by the second order over the first less one.
// Whole orders step by ln 3.8 at once, forwards from the first to the second.
TEST(Multiscatter, TableHasNoStepBetweenOrders) {
  constexpr double STEP = 0.02;
  constexpr double SECOND = 5.0 - 1.0;  // of 50 um, to the side, where the first order is least
  constexpr double CHORDS = 1.25;       // of a table that is linear between nodes of ln(1 + n)
  for (const Case& c : {fog(5), fog(20), fog(50), hg(0.85)}) {
    const Rows t = build(c.phase);
    double worst = 0;
    for (const double y : {0.0, 1e-4, 0.01, 0.2, 1.0, 2.0}) {
      for (double n = 0; n < 20; n += STEP) {
        const double change = std::log(lookUp(t, n + STEP, y) / lookUp(t, n, y));
        worst = std::max(worst, std::abs(change) / STEP);
      }
    }
    EXPECT_LE(worst, SECOND * CHORDS) << c.name;
  }
}

TEST(Multiscatter, BuildTakesLessThanThreeTenthsOfASecond) {
  const std::clock_t start = std::clock();
  build(fog(50).phase);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.3);  // measured 0.005
}

// Light at optical depth `depth` with `slabs` slabs, as the light pass steps it: F(n) from the
// table at the middle of each slab.
double marchedLight(const Rows& t, double albedo, double depth, int slabs) {
  double logLight = 0;
  const double step = depth / slabs;
  for (int k = 0; k < slabs; ++k) {
    const double n = albedo * (k + 0.5) * step;
    const double x = f64::depthCoordinate(n) * (kPhaseDepths - 1);
    const size_t i = static_cast<size_t>(std::min(x, kPhaseDepths - 2.0));
    const double f =
        t.forward(i) + (t.forward(i + 1) - t.forward(i)) * (x - static_cast<double>(i));
    logLight -= f64::forwardLoss(albedo, f) * step;
  }
  return std::exp(logLight);
}

TEST(LightBuffer, AttenuationDoesNotDependOnTheSlabCount) {
  for (const Case& c : {fog(5), fog(50), hg(0.85)}) {
    const Rows t = build(c.phase);
    for (const double albedo : {1.0, 0.9}) {
      const double depth = 16;
      // Truth: the rate integrated with exact F(n).
      double integral = 0;
      constexpr int FINE = 2000;
      for (int k = 0; k < FINE; ++k) {
        const double n = albedo * depth * (k + 0.5) / FINE;
        integral += (1 - albedo * forwardFraction(c.phase, n)) * depth / FINE;
      }
      const double truth = std::exp(-integral);
      double previous = marchedLight(t, albedo, depth, 8);
      for (const int slabs : {16, 64, 256, 1024}) {
        const double light = marchedLight(t, albedo, depth, slabs);
        EXPECT_NEAR(light / previous, 1, 0.01) << c.name << " slabs " << slabs;
        previous = light;
      }
      EXPECT_NEAR(previous / truth, 1, 0.002) << c.name;  // what the 32 nodes of F cost
    }
  }
}

}  // namespace
