// SPDX-License-Identifier: MIT
// The solver of canonical slab transport: conservation, reciprocity, an independent solver, limits.
// Monte Carlo per set of orders: canonical_truth_test.cpp.
#include "tables/slab_orders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/slab_solver.hpp"
#include "tables/canonical_builder.hpp"
#include "tables/canonical_phase.hpp"
#include "tables/gauss_rule.hpp"

namespace {

using namespace welkin;

constexpr double PI = std::numbers::pi;
constexpr double G = 0.6;
constexpr size_t TERMS = 32;  // 0.6^32 = 8e-8: the series is the phase function
constexpr size_t NODES = 16;
constexpr std::array<double, 4> SUNS = {1, 0.7, 0.3, 0.05};

std::vector<double> henyeyGreenstein() {
  std::vector<double> chi(TERMS);
  for (size_t l = 0; l < chi.size(); ++l) {
    chi[l] = std::pow(G, static_cast<double>(l));
  }
  return chi;
}

struct Slab {
  explicit Slab(double thickness, double fineness = 1)
      : medium(henyeyGreenstein(), thickness, NODES, fineness), tail(medium), orders(tail, SUNS) {}
  // With the solver's own directions, as the shipped table has them.
  Slab(double thickness, const std::vector<double>& moments)
      : medium(moments, thickness), tail(medium), orders(tail, SUNS) {}
  SlabMedium medium;
  SlabTail tail;
  SlabOrders orders;
};

// Power that leaves through both faces, over that of the sun's beam on the top.
double leaves(const Slab& slab, size_t set, size_t lane, const SlabDirections& views) {
  const double depths[] = {0, slab.medium.thickness()};
  const SlabLight light = set < SLAB_SETS ? slab.orders.light(set, views, depths) : SlabLight();
  double sum = 0;
  for (size_t i = 0; i < views.mu.size(); ++i) {
    const double out = set < SLAB_SETS
                           ? light.mean(lane, i, true, 0) + light.mean(lane, i, false, 1)
                           : slab.orders.firstOrderMean(lane, views.mu[i], true, 0) +
                                 slab.orders.firstOrderMean(lane, views.mu[i], false, depths[1]);
    sum += 2 * PI * views.mu[i] * views.weight[i] * out / SUNS[lane];
  }
  return sum;
}

// The directions, not the solver's own ones, in which what leaves is added up: `nodes` of them.
void expectEnergy(const Slab& slab, size_t nodes) {
  GaussRule rule = gaussRule(nodes);
  const SlabDirections views = slab.medium.directions(std::move(rule.node), std::move(rule.weight));
  const double thickness = slab.medium.thickness();
  for (size_t lane = 0; lane < SUNS.size(); ++lane) {
    double sum = std::exp(-thickness / SUNS[lane]);
    for (size_t set = 0; set <= SLAB_SETS; ++set) {
      sum += leaves(slab, set, lane, views);
    }
    EXPECT_NEAR(sum, 1, 2e-4) << thickness << " " << SUNS[lane];
  }
  EXPECT_LT(slab.orders.residual(), 1e-7);
  EXPECT_LT(slab.orders.steps(), 20) << "thick slabs take no more steps than thin ones";
}

// I(mu; mu0) / mu0 = I(mu0; mu) / mu at the lit face, order by order.
void expectReciprocity(const Slab& slab) {
  const SlabDirections views =
      slab.medium.directions({SUNS.begin(), SUNS.end()}, std::vector<double>(SUNS.size()));
  const double top[] = {0};
  for (size_t set = 0; set < SLAB_SETS; ++set) {
    const SlabLight light = slab.orders.light(set, views, top);
    double largest = 0;
    double worst = 0;
    for (size_t a = 0; a < SUNS.size(); ++a) {
      for (size_t b = 0; b < a; ++b) {
        for (const double phi : {0.0, 1.0, 3.0}) {
          const double there = light.at(a, b, true, 0, phi).radiance / SUNS[a];
          const double back = light.at(b, a, true, 0, phi).radiance / SUNS[b];
          largest = std::max(largest, there);
          worst = std::max(worst, std::abs(there - back));
        }
      }
    }
    EXPECT_LT(worst, 1e-4 * largest) << slab.medium.thickness() << " set " << set;
  }
}

TEST(SlabOrders, EnergyIsConserved) {
  for (const double thickness : {1e-3, 0.2, 2.0, 12.0, 200.0}) {
    expectEnergy(Slab(thickness), NODES + 8);
  }
}

TEST(SlabOrders, EachSetIsReciprocal) {
  for (const double thickness : {0.5, 8.0, 40.0}) {
    expectReciprocity(Slab(thickness));
  }
}

// The cloud of the shipped table, solved as for that.
TEST(SlabOrders, LightOfTheShippedCloudIsConservedAndReciprocal) {
  const std::vector<double> moments = canonicalMoments(canonicalPhase(), CANONICAL_TERMS);
  for (const double thickness : {0.0625, 2.0, 12.0, 128.0}) {
    const Slab slab(thickness, moments);
    expectEnergy(slab, 40);
    expectReciprocity(slab);
  }
}

TEST(SlabOrders, AllSetsTogetherAreTheIndependentSolver) {
  const reference::SlabSolver truth(reference::henyeyGreensteinSlabPhase(G), 1, 48);
  for (const double thickness : {0.3, 4.0, 25.0}) {
    const Slab slab(thickness);
    const std::vector<double> mu = {0.1, 0.45, 0.8, 1};
    const SlabDirections views = slab.medium.directions(mu, std::vector<double>(mu.size()));
    const std::vector<double> depths = {0, 0.013 * thickness, 0.4 * thickness, thickness};
    std::vector<SlabLight> light;
    for (size_t set = 0; set < SLAB_SETS; ++set) {
      light.push_back(slab.orders.light(set, views, depths));
    }
    for (size_t lane = 0; lane < SUNS.size(); ++lane) {
      double largest = 0;
      double worst = 0;
      for (size_t d = 0; d < depths.size(); ++d) {
        for (size_t i = 0; i < mu.size(); ++i) {
          for (const bool up : {false, true}) {
            for (const double phi : {0.0, 2.0}) {
              double sum = 0;
              for (const SlabLight& set : light) {
                sum += set.at(lane, i, up, d, phi).radiance;
              }
              const reference::SlabRadiance expected =
                  truth.radiance(thickness, SUNS[lane], {up ? mu[i] : -mu[i], phi, depths[d]});
              const double further = expected.total - expected.single;
              largest = std::max(largest, further);
              worst = std::max(worst, std::abs(sum - further));
            }
          }
        }
      }
      // Quadrature of 16 nodes against 62, parabolas against exponentials.
      EXPECT_LT(worst, 1e-3 * largest) << thickness << " " << SUNS[lane];
    }
  }
}

TEST(SlabOrders, AnOrderIsThePowerOfTheAlbedoThatItStandsFor) {
  // Light of order n of a thin slab goes with thickness^n, but for what grazes it.
  const Slab thin(1e-3);
  const Slab thinner(5e-4);
  const SlabDirections views = thin.medium.directions({0.5, 1}, {0, 0});
  const SlabDirections again = thinner.medium.directions({0.5, 1}, {0, 0});
  for (size_t set = 0; set + 1 < SLAB_SETS; ++set) {
    const double top[] = {0};
    const double ratio = thin.orders.light(set, views, top).at(0, 1, true, 0, 1).radiance /
                         thinner.orders.light(set, again, top).at(0, 1, true, 0, 1).radiance;
    // Rays along the slab are longer than it is thick: each further order loses less than half.
    EXPECT_LT(ratio, std::pow(2.0, SLAB_ORDERS[set])) << set;
    EXPECT_GT(ratio, std::pow(1.7, SLAB_ORDERS[set])) << set;
  }
}

TEST(SlabOrders, CollectorsAreSymmetricAndLieTowardsTheSun) {
  const Slab slab(5);
  const SlabDirections views = slab.medium.directions({0.4, 1}, {0, 0});
  const double depths[] = {0, 2};
  for (size_t set = 0; set < SLAB_SETS; ++set) {
    const SlabLight light = slab.orders.light(set, views, depths);
    for (const double phi : {0.0, 0.7, 2.5, PI}) {
      for (size_t lane = 0; lane < SUNS.size(); ++lane) {
        const SlabTransport here = light.at(lane, 0, false, 1, phi);
        const SlabTransport mirror = light.at(lane, 0, false, 1, -phi);
        EXPECT_NEAR(here.radiance, mirror.radiance, 1e-9 * here.radiance);
        EXPECT_NEAR(here.x, mirror.x, 1e-9 * here.width);
        EXPECT_NEAR(here.y, -mirror.y, 1e-9 * here.width);
      }
      // Sun and view in the zenith: the collector is around the point.
      const SlabTransport zenith = light.at(0, 1, true, 0, phi);
      EXPECT_NEAR(std::hypot(zenith.x, zenith.y), 0, 1e-9 * zenith.width);
      // Along the light's own way the collector lies where it came from.
      EXPECT_LT(light.at(2, 0, false, 1, 0).x, 0);
    }
  }
}

TEST(SlabOrders, FinerDepthsChangeNothing) {
  const Slab coarse(10);
  const Slab fine(10, 2);
  const std::vector<double> mu = {0.02, 0.3, 0.9};
  const std::vector<double> depths = {0, 0.5, 5, 10};
  const SlabDirections a = coarse.medium.directions(mu, {0, 0, 0});
  const SlabDirections b = fine.medium.directions(mu, {0, 0, 0});
  for (size_t set = 0; set < SLAB_SETS; ++set) {
    const SlabLight one = coarse.orders.light(set, a, depths);
    const SlabLight two = fine.orders.light(set, b, depths);
    for (size_t lane = 0; lane < SUNS.size(); ++lane) {
      for (size_t i = 0; i < mu.size(); ++i) {
        for (size_t d = 1; d < depths.size(); ++d) {
          const SlabTransport here = one.at(lane, i, false, d, 0.4);
          const SlabTransport there = two.at(lane, i, false, d, 0.4);
          // Of the brightest depth: e^-5 of light of low orders is left in the middle.
          EXPECT_NEAR(here.radiance, there.radiance,
                      5e-4 * two.at(lane, i, false, 1, 0.4).radiance + 1e-3 * there.radiance)
              << set << " " << mu[i] << " " << d;
          EXPECT_NEAR(here.x, there.x, 2e-3 * there.width);
          EXPECT_NEAR(here.width / there.width, 1, 2e-3);
        }
      }
    }
  }
}

}  // namespace
