// SPDX-License-Identifier: MIT
// src/tables/transport_phase: the forward peak against quadrature of closed forms, pairs of phase
// functions against double integrals over directions.
#include "tables/transport_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tables/angular_moments.hpp"
#include "transport_truth.hpp"

namespace {

using namespace transport_test;

// Y_lm about z by Cartesian polynomials, l < 4, m >= 0.
double harmonic(size_t l, size_t m, double x, double y, double z) {
  switch (l * 4 + m) {
    case 0:
      return 1;
    case 4:
      return std::sqrt(3.0) * z;
    case 5:
      return std::sqrt(3.0) * x;
    case 8:
      return std::sqrt(5.0) / 2 * (3 * z * z - 1);
    case 9:
      return std::sqrt(15.0) * x * z;
    case 10:
      return std::sqrt(15.0) / 2 * (x * x - y * y);
    case 12:
      return std::sqrt(7.0) / 2 * (5 * z * z - 3) * z;
    case 13:
      return std::sqrt(42.0) / 4 * x * (5 * z * z - 1);
    case 14:
      return std::sqrt(105.0) / 2 * z * (x * x - y * y);
    default:
      return 0;
  }
}

constexpr size_t DEGREE[PAIR_FUNCTIONS] = {0, 1, 1, 2, 2, 2};
constexpr size_t ORDER[PAIR_FUNCTIONS] = {0, 0, 1, 0, 1, 2};
using Response = std::array<double, PAIR_FUNCTIONS>;

// The double integral of rest(w v) before(w s): polar angle about s, azimuth by midpoints of half a
// circle (v at azimuth 0).
Response pairTruth(const Phase& rest, const Phase& before, double view, int azimuths) {
  Response result{};
  const double vx = std::sin(view);
  const double vz = std::cos(view);
  for (const auto& [begin, end] : {std::pair<Real, Real>{0, EDGE}, {EDGE, ::reference::PI}}) {
    for (const auto& point : ::reference::anglePoints(begin, end, 0.02L)) {
      const double weight = static_cast<double>(point.weight) * before(yOf(point.theta)) / azimuths;
      const auto z = static_cast<double>(std::cos(point.theta));
      const auto s = static_cast<double>(std::sin(point.theta));
      for (int k = 0; k < azimuths; ++k) {
        const double phi = PI * (k + 0.5) / azimuths;
        const double x = s * std::cos(phi);
        const double y = s * std::sin(phi);
        const double apart = ((x - vx) * (x - vx) + y * y + (z - vz) * (z - vz)) / 2;
        const double pair = 4 * PI * weight * rest(std::min(apart, 2.0));
        for (size_t f = 0; f < PAIR_FUNCTIONS; ++f) {
          result[f] += pair * harmonic(DEGREE[f], ORDER[f], x, y, z);
        }
      }
    }
  }
  return result;
}

// P' after P': the same integral at angles 0.5 degrees apart, and lines between them, 2e-4 of the
// value.
Phase twiceOf(const Phase& rest) {
  constexpr int NODES = 361;
  std::vector<double> values;
  for (int i = 0; i < NODES; ++i) {
    values.push_back(pairTruth(rest, rest, PI * i / (NODES - 1), 60)[0] / (4 * PI));
  }
  return [values](double y) {
    const double at = 2 * std::asin(std::sqrt(std::min(y / 2, 1.0))) / PI * (NODES - 1);
    const auto node = std::min(static_cast<size_t>(at), size_t{NODES - 2});
    return std::lerp(values[node], values[node + 1], at - static_cast<double>(node));
  };
}

TransportPairs pairsOf(const TransportPhase& phase) {
  const TransportPhase* const one[] = {&phase};
  const double weight[] = {1};
  return transportPairs(one, weight);
}

double responseAt(const TransportPairs& pairs, size_t function, size_t node, size_t channel) {
  return pairs.response[(function * PAIR_NODES + node) * 4 + channel];
}

double largest(const TransportPairs& pairs, size_t function, size_t channel) {
  double result = 0;
  for (size_t i = 0; i < PAIR_NODES; ++i) {
    result = std::max(result, std::abs(responseAt(pairs, function, i, channel)));
  }
  return result;
}

double nodeAngle(size_t node) {
  return PI * static_cast<double>(node) / (PAIR_NODES - 1);
}

// Without a peak, P' given.
TransportPhase phaseOf(const std::function<double(double mu)>& rest) {
  TransportPhase phase;
  phase.y = henyeyGreensteinCurve(0).y;
  for (auto& channel : phase.rest) {
    for (const double y : phase.y) {
      channel.push_back(rest(1 - y) / (4 * PI));
    }
  }
  return phase;
}

TEST(TransportPhase, HasThePeakAndTheMomentsOfItsDefinition) {
  for (const double g : {-0.9, -0.3, 0.0, 0.3, 0.85, 0.95, 0.998}) {
    const TransportPhase phase = transportPhase(henyeyGreensteinCurve(g));
    const Truth truth{henyeyGreenstein(g)};
    EXPECT_NEAR(phase.peak, 1 - truth.share, CHORD) << g;
    if (g <= 0) {
      EXPECT_NEAR(phase.peak, 0, 1e-15) << g;
    }
    for (int l = 0; l <= TRANSPORT_MOMENTS; ++l) {
      const Real chi =
          Truth::integral([&](Real t) { return truth.rest(yOf(t)) * legendre(l, std::cos(t)); });
      EXPECT_NEAR(l < TRANSPORT_MOMENTS ? phase.moments[static_cast<size_t>(l)] : phase.fourth,
                  static_cast<double>(chi), CHORD)
          << g << " l " << l;
    }
  }
}

TEST(TransportPhase, OfRayleighHasNearlyNoPeak) {
  const PhaseCurve curve = makePhaseCurve([](size_t, double y) {
    return static_cast<double>(::reference::rayleigh(1 - static_cast<Real>(y)));
  });
  // 3 / 8 times the integral of mu^2 - e^2 from e = cos(20 degrees) to 1.
  const double e = std::cos(PI / 9);
  const double peak = 0.375 * ((1 - e * e * e) / 3 - e * e * (1 - e));
  EXPECT_NEAR(transportPhase(curve).peak, peak, CHORD);
  EXPECT_NEAR(peak, 0.0013, 5e-5);
}

TEST(TransportPhase, KeepsWhatLiesBeyondItsEdgeAndIsNormalised) {
  for (const Named& medium : media()) {
    const TransportPhase phase = transportPhase(medium.curve);
    double peak = 0;
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      EXPECT_NEAR(sphereIntegral(phase.y, phase.rest[c]), 1, 1e-12) << medium.name;
      const Truth truth{curveAt(medium.curve, c)};
      peak += (1 - truth.share) / SOURCE_CHANNELS;
      const double scale = phase.rest[c].back() / medium.curve.value[c].back();
      const double top = scale * truth.level;
      for (size_t i = 0; i < phase.y.size(); ++i) {
        const double p = scale * medium.curve.value[c][i];
        const double expected = phase.y[i] < yOf(EDGE) ? std::min(p, top) : p;
        ASSERT_NEAR(phase.rest[c][i] / expected, 1, 1e-12) << medium.name << " node " << i;
      }
    }
    EXPECT_NEAR(phase.peak, peak, CHORD) << medium.name;
  }
}

TEST(TransportPhase, WhoseLightIsAllInThePeakIsIsotropic) {
  const PhaseCurve curve = makePhaseCurve([](size_t, double y) { return std::max(0.01 - y, 0.0); });
  const TransportPhase phase = transportPhase(curve);
  EXPECT_NEAR(phase.peak, 1, 1e-12);
  EXPECT_NEAR(phase.moments[0], 1, 1e-12);
  EXPECT_NEAR(phase.moments[1], 0, 1e-12);
}

// Of each channel: the peak turns light k times with probability (1 - f) f^k, sums of its powers
// taken one by one, f and its moments by quadrature of the definition.
TEST(TransportPhase, TurnedHasTheMomentsOfAllNumbersOfTurns) {
  for (const double g : {-0.3, 0.3, 0.85, 0.95}) {
    const PhaseCurve curve = henyeyGreensteinCurve(g);
    const TransportPhase turned = turnedPhase(curve, transportPhase(curve));
    const Truth truth{henyeyGreenstein(g)};
    const Phase all = henyeyGreenstein(g);
    const double f = 1 - truth.share;
    for (int l = 0; l <= TRANSPORT_MOMENTS; ++l) {
      const auto moment = [&](const std::function<double(Real)>& of) {
        return static_cast<double>(
            Truth::integral([&](Real t) { return of(t) * legendre(l, std::cos(t)); }));
      };
      const double rest = moment([&](Real t) { return truth.rest(yOf(t)); });
      const double peak =
          moment([&](Real t) { return all(yOf(t)) - truth.share * truth.rest(yOf(t)); });
      double expected = 0;
      double power = 1 - f;  // of k turns, times their moments
      for (int k = 0; k < 400; ++k) {
        expected += power * rest;
        power *= peak;
      }
      EXPECT_NEAR(l < TRANSPORT_MOMENTS ? turned.moments[static_cast<size_t>(l)] : turned.fourth,
                  expected, 3 * CHORD)
          << g << " l " << l;
    }
    EXPECT_NEAR(turned.peak, f, CHORD) << g;
  }
}

TEST(TransportPhase, TurnedIsNormalisedAndNeverSharper) {
  for (const Named& medium : media()) {
    const TransportPhase sharp = transportPhase(medium.curve);
    const TransportPhase turned = turnedPhase(medium.curve, sharp);
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      EXPECT_NEAR(sphereIntegral(turned.y, turned.rest[c]), 1, 1e-6) << medium.name;
      const double most = *std::max_element(turned.rest[c].begin(), turned.rest[c].end());
      EXPECT_LE(most, 1.001 * *std::max_element(sharp.rest[c].begin(), sharp.rest[c].end()))
          << medium.name;
    }
    EXPECT_LE(turned.moments[1], sharp.moments[1] + CHORD) << medium.name;
  }
}

TEST(TransportPairs, OfIsotropicScatteringAreOneAndTheIdentity) {
  const TransportPairs pairs = pairsOf(phaseOf([](double) { return 1; }));
  ASSERT_EQ(pairs.response.size(), 2 * PAIR_FUNCTIONS * PAIR_NODES * 4);
  for (size_t f = 0; f < 2 * PAIR_FUNCTIONS; ++f) {
    for (size_t i = 0; i < PAIR_NODES; ++i) {
      ASSERT_NEAR(responseAt(pairs, f, i, 0), f % PAIR_FUNCTIONS == 0 ? 1 : 0, 4 * EPS_FLOAT) << f;
      ASSERT_EQ(responseAt(pairs, f, i, 3), 0);
    }
  }
  for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
    for (size_t k = 0; k < TRANSPORT_FIRST; ++k) {
      for (size_t m = 0; m < TRANSPORT_FIRST; ++m) {
        const double one = l == k && m <= l ? 1 : 0;
        EXPECT_NEAR(pairs.first[l][k][m], one, 4 * EPS_FLOAT) << l << k << m;
        EXPECT_NEAR(pairs.second[l][k][m], one, 4 * EPS_FLOAT) << l << k << m;
      }
    }
  }
}

// 1 + 3 g cos: only L = 0 and 1 pass the last scattering; light scattered twice before has g^2.
TEST(TransportPairs, OfALinearPhaseFunctionAreTheClosedForms) {
  const double g = 0.3;
  const TransportPairs pairs = pairsOf(phaseOf([&](double mu) { return 1 + 3 * g * mu; }));
  for (const size_t times : {1u, 2u}) {
    const double before = times == 1 ? g : g * g;
    for (size_t i = 0; i < PAIR_NODES; ++i) {
      const double mu = std::cos(nodeAngle(i));
      const double sine = std::sin(nodeAngle(i));
      const double truth[] = {1 + 3 * g * before * mu,
                              std::sqrt(3.0) * (before + g * mu),
                              std::sqrt(3.0) * g * sine,
                              1.2 * std::sqrt(5.0) * g * before * mu,
                              0.6 * std::sqrt(15.0) * g * before * sine,
                              0};
      for (size_t f = 0; f < PAIR_FUNCTIONS; ++f) {
        ASSERT_NEAR(responseAt(pairs, (times - 1) * PAIR_FUNCTIONS + f, i, 1), truth[f],
                    4 * EPS_FLOAT)
            << times << " function " << f << " node " << i;
      }
    }
    const TransportPairs::Products& products = times == 1 ? pairs.first : pairs.second;
    EXPECT_NEAR(products[1][0][0], std::sqrt(3.0) * before, 4 * EPS_FLOAT);
    EXPECT_NEAR(products[2][1][1], 0.6 * std::sqrt(5.0) * before, 4 * EPS_FLOAT);
  }
}

TEST(TransportPairs, OfRayleighScatteringAreTheClosedForm) {
  const TransportPairs pairs = pairsOf(phaseOf([](double mu) { return 0.75 * (1 + mu * mu); }));
  for (size_t i = 0; i < PAIR_NODES; ++i) {
    const double mu = std::cos(nodeAngle(i));
    // chi_2 = 1 / 10; the lines between the nodes hold 2e-6 more (their excess).
    ASSERT_NEAR(responseAt(pairs, 0, i, 2), 1 + 0.05 * (1.5 * mu * mu - 0.5), 4e-6) << i;
  }
}

// Smoothing of moments that have not ended, lines between the curve's nodes, and the midpoints of
// the quadrature.
constexpr double PAIR_ERROR = 1e-3;

void expectPairs(const std::string& name, const TransportPairs& pairs, const Phase& rest,
                 const Phase& before, size_t half, size_t channel, int azimuths) {
  for (const size_t node : {0u, 9u, 40u, 64u, 101u, 127u}) {
    const Response truth = pairTruth(rest, before, nodeAngle(node), azimuths);
    for (size_t f = 0; f < PAIR_FUNCTIONS; ++f) {
      const size_t function = half * PAIR_FUNCTIONS + f;
      const double most = std::max(largest(pairs, function, channel), 0.1);
      EXPECT_NEAR(responseAt(pairs, function, node, channel), truth[f], PAIR_ERROR * most)
          << name << " function " << f << " node " << node;
    }
  }
}

TEST(TransportPairs, AreTheDoubleIntegralOverDirections) {
  for (const Named& medium : media()) {
    const TransportPairs pairs = pairsOf(transportPhase(medium.curve));
    const size_t channel = 1;
    const Truth truth{curveAt(medium.curve, channel)};
    const Phase rest = [&](double y) { return truth.rest(y); };
    expectPairs(medium.name, pairs, rest, rest, 0, channel, 240);
    // Mean over all v of what isotropic light gives: all of it.
    double mean = 0;
    for (size_t i = 0; i < PAIR_NODES; ++i) {
      mean += responseAt(pairs, 0, i, channel) * std::sin(nodeAngle(i)) * PI / (2.0 * 127);
    }
    EXPECT_NEAR(mean, 1, 0.003) << medium.name;  // trapezia 1.4 degrees wide
  }
}

// Averages of P' Y_lm Y_l'm over polar angle and azimuth.
double productTruth(const Phase& p, size_t l, size_t k, size_t m) {
  constexpr int AZIMUTHS = 5;  // exact for cos^2 of order 2
  return static_cast<double>(Truth::integral([&](Real t) {
    double sum = 0;
    for (int i = 0; i < AZIMUTHS; ++i) {
      const double phi = 2 * PI * (i + 0.25) / AZIMUTHS;
      const auto x = static_cast<double>(std::sin(t)) * std::cos(phi);
      const auto y = static_cast<double>(std::sin(t)) * std::sin(phi);
      const auto z = static_cast<double>(std::cos(t));
      sum += harmonic(l, m, x, y, z) * harmonic(k, m, x, y, z) / AZIMUTHS;
    }
    return sum * p(yOf(t));
  }));
}

void expectProducts(const std::string& name, const TransportPairs::Products& products,
                    const Phase& p, double error) {
  for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
    for (size_t k = 0; k < TRANSPORT_FIRST; ++k) {
      for (size_t m = 0; m <= std::min(l, k); ++m) {
        EXPECT_NEAR(products[l][k][m], productTruth(p, l, k, m), error)
            << name << " " << l << k << m;
      }
    }
  }
}

// P' scattered twice before: g^2 where Henyey-Greenstein has no peak, else by quadrature.
TEST(TransportPairs, OfLightScatteredTwiceAreTheTripleIntegral) {
  for (const double g : {-0.9, -0.3}) {
    const TransportPairs pairs = pairsOf(transportPhase(henyeyGreensteinCurve(g)));
    expectPairs("HG", pairs, henyeyGreenstein(g), henyeyGreenstein(g * g), 1, 1, 240);
  }
  const Truth truth{henyeyGreenstein(0.85)};
  const Phase rest = [&](double y) { return truth.rest(y); };
  const Phase twice = twiceOf(rest);
  const TransportPairs pairs = pairsOf(transportPhase(henyeyGreensteinCurve(0.85)));
  expectPairs("HG with a peak", pairs, rest, twice, 1, 2, 240);
  expectProducts("HG with a peak", pairs.second, twice, PAIR_ERROR);
}

TEST(TransportPairs, OfAMixtureAreThoseOfTheMixedPhaseFunction) {
  const PhaseCurve a = henyeyGreensteinCurve(0.7);
  const PhaseCurve b = henyeyGreensteinCurve(-0.5);
  const TransportPhase phases[] = {transportPhase(a), transportPhase(b)};
  const TransportPhase* const both[] = {&phases[0], &phases[1]};
  const TransportPhase* const same[] = {&phases[0], &phases[0]};
  const double weights[] = {0.25, 0.75};
  const Truth first{henyeyGreenstein(0.7)};
  const Truth second{henyeyGreenstein(-0.5)};
  const Phase mixed = [&](double y) { return 0.25 * first.rest(y) + 0.75 * second.rest(y); };
  expectPairs("mixture", transportPairs(both, weights), mixed, mixed, 0, 2, 240);
  const TransportPairs one = pairsOf(phases[0]);
  const TransportPairs twice = transportPairs(same, weights);
  for (size_t i = 0; i < one.response.size(); ++i) {
    ASSERT_NEAR(one.response[i], twice.response[i], 1e-5) << i;
  }
}

// P' the mean of the channels.
TEST(TransportPairs, HaveTheFirstMomentsOfTheirDefinition) {
  for (const Named& medium : media()) {
    std::vector<Truth> truth;
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      truth.push_back({curveAt(medium.curve, c)});
    }
    expectProducts(
        medium.name, pairsOf(transportPhase(medium.curve)).first,
        [&](double y) { return (truth[0].rest(y) + truth[1].rest(y) + truth[2].rest(y)) / 3; },
        CHORD);
  }
}

TEST(TransportPairs, HaveTheSecondMomentsOfTheirDefinition) {
  for (const double g : {-0.9, -0.3, 0.0}) {
    expectProducts("HG", pairsOf(transportPhase(henyeyGreensteinCurve(g))).second,
                   henyeyGreenstein(g * g), CHORD);
  }
}

}  // namespace
