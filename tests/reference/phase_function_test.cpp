// SPDX-License-Identifier: MIT
#include "reference/phase_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "reference/phase_reference.hpp"
#include "reference/quadrature.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;

// Diffraction-like: 2e4 forward, features and a rise to the back, coloured.
PhaseFunction sharpTable() {
  std::vector<double> angles{0};
  std::vector<Rgb> values;
  for (int i = 1; i < 400; ++i) {
    angles.push_back(PI * std::pow(i / 400.0, 3));
  }
  angles.push_back(PI);
  for (const double t : angles) {
    Rgb value{};
    for (size_t c = 0; c < 3; ++c) {
      const double width = 0.003 * (1 + static_cast<double>(c));
      value[c] = 1 / (t * t / (width * width) + 1) + 1e-4 * (1.1 + std::cos(9 * t)) +
                 3e-4 * std::exp(-(PI - t) / 0.05);
    }
    values.push_back(value);
  }
  return PhaseFunction::table(angles, values);
}

std::vector<std::pair<std::string, PhaseFunction>> functions() {
  return {{"isotropic", PhaseFunction::isotropic()},
          {"Rayleigh", PhaseFunction::rayleigh()},
          {"HG 0.85", PhaseFunction::henyeyGreenstein(0.85)},
          {"HG 0.99", PhaseFunction::henyeyGreenstein(0.99)},
          {"HG -0.6", PhaseFunction::henyeyGreenstein(-0.6)},
          {"table", sharpTable()}};
}

double yOf(double angle) {
  return 2 * std::sin(angle / 2) * std::sin(angle / 2);
}

// Energy within [0, y] by Gauss-Legendre panels that shrink towards both ends.
double energyWithin(const PhaseFunction& phase, size_t channel, double y) {
  static const GaussRule rule = gaussLegendre(8);
  const double limit = 2 * std::asin(std::sqrt(y / 2));
  double sum = 0;
  double from = 0;
  while (from < limit) {
    const double to = std::min({limit, from * 1.005 + 1e-6, from + 0.002});
    for (size_t i = 0; i < rule.node.size(); ++i) {
      const double t = from + (to - from) * static_cast<double>(rule.node[i]);
      sum += static_cast<double>(rule.weight[i]) * (to - from) * 2 * PI * std::sin(t) *
             phase.value(channel, yOf(t));
    }
    from = to;
  }
  return sum;
}

TEST(PhaseFunctionReference, SamplesInvertTheEnergyOfTheValue) {
  // Panels do not end at the table's nodes: a kink in one of some 20 panels per decade costs 2e-6.
  constexpr double QUADRATURE = 4e-6;
  for (const auto& [name, phase] : functions()) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(energyWithin(phase, c, 2), 1, QUADRATURE) << name;
      for (const double u : {1e-6, 0.01, 0.2, 0.5, 0.77, 0.95, 0.999}) {
        EXPECT_NEAR(energyWithin(phase, c, phase.sample(c, u)), u, QUADRATURE) << name << " " << u;
      }
    }
  }
}

TEST(PhaseFunctionReference, ClosedFormsAreThoseOfThePapers) {
  constexpr double ROUNDING = 1e-13;  // cos(theta) near 1 and g near 1, in double
  for (const double g : {-0.6, 0.0, 0.5, 0.85}) {
    for (double angle = 0; angle <= 3.14; angle += 0.1) {
      const auto expected = static_cast<double>(::reference::henyeyGreenstein(
          static_cast<long double>(g), std::cos(static_cast<long double>(angle))));
      EXPECT_NEAR(PhaseFunction::henyeyGreenstein(g).value(1, yOf(angle)) / expected, 1, ROUNDING);
    }
  }
  for (double angle = 0; angle <= 3.14; angle += 0.1) {
    const auto expected =
        static_cast<double>(::reference::rayleigh(std::cos(static_cast<long double>(angle))));
    EXPECT_NEAR(PhaseFunction::rayleigh().value(2, yOf(angle)) / expected, 1, ROUNDING);
  }
}

TEST(PhaseFunctionReference, TableKeepsTheRatiosOfItsNodesAndItsChords) {
  const std::vector<double> angles{0, 0.5, 2, PI};
  const PhaseFunction phase =
      PhaseFunction::table(angles, {{8, 1, 1}, {2, 1, 3}, {1, 1, 0}, {4, 1, 0}});
  EXPECT_FALSE(phase.grey());
  constexpr double ROUNDING = 1e-14;
  const double unit = phase.value(0, yOf(2));
  EXPECT_NEAR(phase.value(0, 0), 8 * unit, 8 * ROUNDING);
  EXPECT_NEAR(phase.value(0, yOf(0.5)), 2 * unit, ROUNDING);
  EXPECT_NEAR(phase.value(0, 2), 4 * unit, ROUNDING);
  EXPECT_NEAR(phase.value(0, 0.5 * (yOf(0.5) + yOf(2))), 1.5 * unit, ROUNDING);
  EXPECT_NEAR(phase.value(1, 0.3), 1 / (4 * PI), ROUNDING);
  EXPECT_EQ(phase.value(2, 1.9), 0);
  EXPECT_LE(phase.sample(2, 1 - 1e-12), yOf(2));
}

TEST(PhaseFunctionReference, RefusesTablesThatAreNone) {
  EXPECT_THROW(PhaseFunction::table({0, 1}, {{1, 1, 1}, {1, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(PhaseFunction::table({0, PI}, {{1, 1, 0}, {1, 1, 0}}), std::invalid_argument);
  EXPECT_THROW(PhaseFunction::table({0, 2, 1, PI}, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace welkin::reference
