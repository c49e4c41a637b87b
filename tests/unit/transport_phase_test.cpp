// SPDX-License-Identifier: MIT
// src/tables/transport_phase: the forward peak against quadrature of closed forms, blurred light
// against random walks, pairs of phase functions against double integrals over directions.
#include "tables/transport_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "particles/catalogue.hpp"
#include "reference/phase_reference.hpp"
#include "tables/angular_moments.hpp"

namespace {

using namespace welkin;
using ::reference::Real;

constexpr double PI = std::numbers::pi;
constexpr double EPS_FLOAT = 0x1p-24;
constexpr Real EDGE = ::reference::PI / 9;
// The chord across the kink at 20 degrees: (cell of 1.5e-3 rad)^2 / 8 times the slope there, and
// the fit of the curve. Measured 5e-6.
constexpr double CHORD = 1e-5;

// 1/sr at y = 1 - cos.
using Phase = std::function<double(double y)>;

double yOf(Real theta) {
  const Real s = std::sin(theta / 2);
  return static_cast<double>(2 * s * s);
}

Phase henyeyGreenstein(double g) {
  return [g](double y) {
    const double square = (1 - g) * (1 - g) + 2 * g * y;
    return (1 - g * g) / (4 * PI * square * std::sqrt(square));
  };
}

PhaseCurve henyeyGreensteinCurve(double g) {
  return makePhaseCurve([&](size_t, double y) {
    return static_cast<double>(::reference::henyeyGreenstein(g, 1 - static_cast<Real>(y)));
  });
}

Phase curveAt(const PhaseCurve& curve, size_t channel) {
  return [&curve, channel](double y) { return evalPhaseCurve(curve, channel, y); };
}

struct Named {
  std::string name;
  PhaseCurve curve;
};

Named particle(const std::string& name, ParticleType type, double diameter_um, double g = 0) {
  const ParticleKind& kind = particleKind(type);
  ParticleParams params;
  params.diameter_um = diameter_um;
  params.spread = kind.spread.initial;
  params.roughness = kind.roughness.initial;
  params.asymmetry = g;
  return {name, kind.make(params).curve};
}

std::vector<Named> media() {
  return {particle("5 um", ParticleType::Cloud, 5),
          particle("12 um", ParticleType::Cloud, 12),
          particle("50 um", ParticleType::Cloud, 50),
          particle("rain", ParticleType::Rain, 1000),
          particle("columns", ParticleType::IceColumn, 0),
          particle("plates", ParticleType::IcePlate, 0),
          particle("HG -0.9", ParticleType::HenyeyGreenstein, 0, -0.9),
          particle("HG 0", ParticleType::HenyeyGreenstein, 0, 0),
          particle("HG 0.85", ParticleType::HenyeyGreenstein, 0, 0.85),
          particle("HG 0.998", ParticleType::HenyeyGreenstein, 0, 0.998)};
}

// Peak and rest from the definition.
struct Truth {
  Phase p;
  double edge = yOf(EDGE);
  double level = p(edge);
  // Of the rest.
  double share = static_cast<double>(integral([this](Real t) { return kept(yOf(t)); }));

  double kept(double y) const { return y < edge ? std::min(p(y), level) : p(y); }
  double rest(double y) const { return kept(y) / share; }
  // Panels of 0.2 degrees, which resolve bows and halos.
  template <typename F>
  static Real integral(F f) {
    return ::reference::integrateSphere(f, 0, EDGE, 0.004L) +
           ::reference::integrateSphere(f, EDGE, ::reference::PI, 0.004L);
  }
};

Real legendre(int l, Real mu) {
  return l == 0 ? 1 : l == 1 ? mu : l == 2 ? (3 * mu * mu - 1) / 2 : (5 * mu * mu - 3) * mu / 2;
}

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

// The double integral: polar angle about s, azimuth by midpoints of half a circle (v at azimuth 0).
Response pairTruth(const Phase& rest, double view, int azimuths) {
  Response result{};
  const double vx = std::sin(view);
  const double vz = std::cos(view);
  for (const auto& [begin, end] : {std::pair<Real, Real>{0, EDGE}, {EDGE, ::reference::PI}}) {
    for (const auto& point : ::reference::anglePoints(begin, end, 0.02L)) {
      const double weight = static_cast<double>(point.weight) * rest(yOf(point.theta)) / azimuths;
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
    for (int l = 0; l < TRANSPORT_MOMENTS; ++l) {
      const Real chi =
          Truth::integral([&](Real t) { return truth.rest(yOf(t)) * legendre(l, std::cos(t)); });
      EXPECT_NEAR(phase.moments[static_cast<size_t>(l)], static_cast<double>(chi), CHORD)
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

std::vector<double> rowOf(const SourceRows& rows, size_t channel, size_t row) {
  std::vector<double> values;
  for (size_t j = 0; j < rows.angles; ++j) {
    values.push_back(std::exp(
        static_cast<double>(rows.logSource[(channel * kPhaseDepths + row) * rows.angles + j])));
  }
  return values;
}

TEST(PeakRows, ArePAtZeroAndHaveItsEnergyEverywhere) {
  for (const Named& medium : media()) {
    const SourceRows rows = peakRows(medium.curve);
    ASSERT_EQ(rows.logSource.size(), SOURCE_CHANNELS * kPhaseDepths * medium.curve.y.size());
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      const std::vector<double>& p = medium.curve.value[c];
      for (size_t j = 0; j < p.size(); ++j) {
        const size_t at = c * kPhaseDepths * rows.angles + j;
        ASSERT_EQ(rows.logSource[at], static_cast<float>(std::log(p[j]))) << medium.name;
      }
      // A convolution with a positive peak keeps the least value of P, but for what the series
      // drops and the lines between its nodes, 2e-4 at 50 um.
      const double least = *std::min_element(p.begin(), p.end());
      for (size_t row = 0; row < kPhaseDepths; ++row) {
        const std::vector<double> values = rowOf(rows, c, row);
        EXPECT_NEAR(sphereIntegral(medium.curve.y, values), 1, 16 * EPS_FLOAT)
            << medium.name << row;
        EXPECT_GT(*std::min_element(values.begin(), values.end()), (1 - 1e-3) * least - 1e-7)
            << medium.name << " row " << row;
      }
    }
  }
}

// Funk-Hecke: each turn multiplies moment l by that of the peak, p_l / f.
TEST(PeakRows, HaveTheMomentsOfAPoissonCountOfTurns) {
  for (const double g : {0.0, 0.5, 0.85, 0.95}) {
    const PhaseCurve curve = henyeyGreensteinCurve(g);
    const SourceRows rows = peakRows(curve);
    const Truth truth{henyeyGreenstein(g)};
    for (int l = 1; l <= 3; ++l) {
      const Real f = 1 - truth.share;
      const Real peak = Truth::integral([&](Real t) {
        return (truth.p(yOf(t)) - truth.kept(yOf(t))) * legendre(l, std::cos(t));
      });
      for (size_t row = 0; row < kPhaseDepths; row += 3) {
        const double x = depthNode(static_cast<double>(row) / (kPhaseDepths - 1));
        const double chi =
            static_cast<double>(std::pow(static_cast<Real>(g), l) * std::exp(-x * (f - peak)));
        std::vector<double> moments(4);
        legendreMoments(curve.y, rowOf(rows, 1, row), moments);
        EXPECT_NEAR(moments[static_cast<size_t>(l)], chi, CHORD) << g << " row " << row;
      }
    }
  }
}

// Light that is turned by the peak a Poisson number of times and scattered by P once, walked turn
// by turn: knows no moments. Parts of the energy in cones.
TEST(PeakRows, AreTheDistributionsOfRandomWalks) {
  constexpr int WALKS = 200000;
  constexpr Real CONES[] = {0.01L, 0.03L, 0.1L, 0.2L, 0.4L, 0.8L, 1.5L, 2.5L};
  const double g = 0.95;
  const PhaseCurve curve = henyeyGreensteinCurve(g);
  const SourceRows rows = peakRows(curve);
  const Truth truth{henyeyGreenstein(g)};
  const double f = 1 - static_cast<double>(truth.share);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto scatter = [&] {  // cosine of one scattering by P
    const double root = (1 - g * g) / (1 - g + 2 * g * uniform(generator));
    return std::clamp((1 + g * g - root * root) / (2 * g), -1.0, 1.0);
  };
  const auto turn = [&] {  // of one by the peak, by rejection
    for (;;) {
      const double c = scatter();
      const double p = truth.p(1 - c);
      if (c > std::cos(PI / 9) && uniform(generator) * p < p - truth.level) {
        return c;
      }
    }
  };
  for (const size_t row : {6u, 14u, 22u}) {
    std::poisson_distribution<int> turns(f * depthNode(static_cast<double>(row) / 31));
    std::array<int, std::size(CONES)> inside{};
    for (int walk = 0; walk < WALKS; ++walk) {
      double c = scatter();
      for (int k = turns(generator); k > 0; --k) {
        const double t = turn();
        const double side = std::sqrt(std::max((1 - c * c) * (1 - t * t), 0.0));
        c = std::clamp(c * t + side * std::cos(2 * PI * uniform(generator)), -1.0, 1.0);
      }
      for (size_t i = 0; i < inside.size(); ++i) {
        inside[i] += c > static_cast<double>(std::cos(CONES[i])) ? 1 : 0;
      }
    }
    const std::vector<double> p = rowOf(rows, 0, row);
    for (size_t i = 0; i < inside.size(); ++i) {
      const double part = static_cast<double>(::reference::integrateSphere(
          [&](Real t) { return curveValue(curve.y, p, yOf(t)); }, 0, CONES[i]));
      const double sigma = std::sqrt(part * (1 - part) / WALKS);
      EXPECT_NEAR(inside[i] / static_cast<double>(WALKS), part, 4.5 * sigma)
          << row << " cone " << static_cast<double>(CONES[i]);
    }
  }
}

TEST(TransportPairs, OfIsotropicScatteringAreOneAndTheIdentity) {
  const TransportPairs pairs = pairsOf(phaseOf([](double) { return 1; }));
  ASSERT_EQ(pairs.response.size(), PAIR_FUNCTIONS * PAIR_NODES * 4);
  for (size_t f = 0; f < PAIR_FUNCTIONS; ++f) {
    for (size_t i = 0; i < PAIR_NODES; ++i) {
      ASSERT_NEAR(responseAt(pairs, f, i, 0), f == 0 ? 1 : 0, 4 * EPS_FLOAT) << f;
      ASSERT_EQ(responseAt(pairs, f, i, 3), 0);
    }
  }
  for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
    for (size_t k = 0; k < TRANSPORT_FIRST; ++k) {
      for (size_t m = 0; m < TRANSPORT_FIRST; ++m) {
        const double one = l == k && m <= l ? 1 : 0;
        EXPECT_NEAR(pairs.first[l][k][m], one, 4 * EPS_FLOAT) << l << k << m;
      }
    }
  }
}

// 1 + 3 g cos: only L = 0 and 1 pass the second scattering.
TEST(TransportPairs, OfALinearPhaseFunctionAreTheClosedForms) {
  const double g = 0.3;
  const TransportPairs pairs = pairsOf(phaseOf([&](double mu) { return 1 + 3 * g * mu; }));
  for (size_t i = 0; i < PAIR_NODES; ++i) {
    const double mu = std::cos(nodeAngle(i));
    const double sine = std::sin(nodeAngle(i));
    const double truth[] = {1 + 3 * g * g * mu,
                            std::sqrt(3.0) * g * (1 + mu),
                            std::sqrt(3.0) * g * sine,
                            1.2 * std::sqrt(5.0) * g * g * mu,
                            0.6 * std::sqrt(15.0) * g * g * sine,
                            0};
    for (size_t f = 0; f < PAIR_FUNCTIONS; ++f) {
      ASSERT_NEAR(responseAt(pairs, f, i, 1), truth[f], 4 * EPS_FLOAT) << f << " node " << i;
    }
  }
  EXPECT_NEAR(pairs.first[1][0][0], std::sqrt(3.0) * g, 4 * EPS_FLOAT);
  EXPECT_NEAR(pairs.first[2][1][1], 0.6 * std::sqrt(5.0) * g, 4 * EPS_FLOAT);
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
                 size_t channel, int azimuths) {
  for (const size_t node : {0u, 9u, 40u, 64u, 101u, 127u}) {
    const Response truth = pairTruth(rest, nodeAngle(node), azimuths);
    for (size_t f = 0; f < PAIR_FUNCTIONS; ++f) {
      const double most = std::max(largest(pairs, f, channel), 0.1);
      EXPECT_NEAR(responseAt(pairs, f, node, channel), truth[f], PAIR_ERROR * most)
          << name << " function " << f << " node " << node;
    }
  }
}

TEST(TransportPairs, AreTheDoubleIntegralOverDirections) {
  for (const Named& medium : media()) {
    const TransportPairs pairs = pairsOf(transportPhase(medium.curve));
    const size_t channel = 1;
    const Truth truth{curveAt(medium.curve, channel)};
    expectPairs(
        medium.name, pairs, [&](double y) { return truth.rest(y); }, channel, 240);
    // Mean over all v of what isotropic light gives: all of it.
    double mean = 0;
    for (size_t i = 0; i < PAIR_NODES; ++i) {
      mean += responseAt(pairs, 0, i, channel) * std::sin(nodeAngle(i)) * PI / (2.0 * 127);
    }
    EXPECT_NEAR(mean, 1, 0.003) << medium.name;  // trapezia 1.4 degrees wide
  }
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
  expectPairs(
      "mixture", transportPairs(both, weights),
      [&](double y) { return 0.25 * first.rest(y) + 0.75 * second.rest(y); }, 2, 240);
  const TransportPairs one = pairsOf(phases[0]);
  const TransportPairs twice = transportPairs(same, weights);
  for (size_t i = 0; i < one.response.size(); ++i) {
    ASSERT_NEAR(one.response[i], twice.response[i], 1e-5) << i;
  }
}

// Averages of P' Y_lm Y_l'm over polar angle and azimuth, P' the mean of the channels.
TEST(TransportPairs, HaveTheFirstMomentsOfTheirDefinition) {
  for (const Named& medium : media()) {
    const TransportPairs pairs = pairsOf(transportPhase(medium.curve));
    std::vector<Truth> truth;
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      truth.push_back({curveAt(medium.curve, c)});
    }
    constexpr int AZIMUTHS = 5;  // exact for cos^2 of order 2
    for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
      for (size_t k = 0; k < TRANSPORT_FIRST; ++k) {
        for (size_t m = 0; m <= std::min(l, k); ++m) {
          const Real expected = Truth::integral([&](Real t) {
            double sum = 0;
            for (int i = 0; i < AZIMUTHS; ++i) {
              const double phi = 2 * PI * (i + 0.25) / AZIMUTHS;
              const auto x = static_cast<double>(std::sin(t)) * std::cos(phi);
              const auto y = static_cast<double>(std::sin(t)) * std::sin(phi);
              const auto z = static_cast<double>(std::cos(t));
              sum += harmonic(l, m, x, y, z) * harmonic(k, m, x, y, z) / AZIMUTHS;
            }
            const double y = yOf(t);
            return sum * (truth[0].rest(y) + truth[1].rest(y) + truth[2].rest(y)) / 3;
          });
          EXPECT_NEAR(pairs.first[l][k][m], static_cast<double>(expected), CHORD)
              << medium.name << " " << l << k << m;
        }
      }
    }
  }
}

}  // namespace
