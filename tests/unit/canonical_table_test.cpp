// SPDX-License-Identifier: MIT
// The shipped table of canonical slab transport against the solver that made it, at its nodes and
// between them, and at the ends of its ranges.
#include "tables/canonical_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "tables/canonical_builder.hpp"
#include "tables/slab_orders.hpp"

namespace {

using namespace welkin;

constexpr double PI = std::numbers::pi;
constexpr double LEAST = 1e-18;  // the model cuts tails at 1e-20

const CanonicalTable& table() {
  static const CanonicalTable decoded = decodeCanonical(shippedCanonical());
  return decoded;
}

const std::vector<double>& moments() {
  static const std::vector<double> chi = canonicalMoments(canonicalPhase(), CANONICAL_TERMS);
  return chi;
}

double quantile(std::vector<double>& values, double part) {
  const size_t at = static_cast<size_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

TEST(CanonicalTable, IsSmallAndSurvivesItsCode) {
  const std::span<const uint32_t> words = shippedCanonical();
  std::printf("%zu bytes\n", words.size_bytes());
  EXPECT_LE(words.size_bytes(), 2U << 20);
  const std::vector<uint32_t> again = encodeCanonical(table());
  ASSERT_LE(again.size(), words.size());
  EXPECT_LT(words.size() - again.size(), 4U);
  EXPECT_TRUE(std::equal(again.begin(), again.end(), words.begin()));
}

// A thickness computed anew: what is stored is that within the rank and the 8 bits.
TEST(CanonicalTable, IsWhatTheBuilderComputes) {
  constexpr size_t THICKNESS = 8;
  CanonicalTable phase;
  canonicalPhaseCurves(moments(), phase);
  for (size_t set = 0; set < CANONICAL_SETS; ++set) {
    for (size_t i = 0; i < CANONICAL_ANGLES; ++i) {
      // 16 bits of at most 6, and the library's exponential on another machine.
      EXPECT_NEAR(phase.logPhase[set][i], table().logPhase[set][i], 3e-4F);
    }
  }
  CanonicalDraft draft = emptyCanonicalDraft();
  computeCanonical(THICKNESS, moments(), phase, draft);
  const CanonicalGrid& grid = RADIANCE_GRID;
  for (size_t set = 0; set < CANONICAL_SETS; ++set) {
    for (const bool up : {false, true}) {
      const CanonicalMatrix& matrix = table().at(CanonicalPart::Radiance, set, up);
      const size_t pair = set * 2 + (up ? 1 : 0);
      double sum = 0;
      double weights = 0;
      for (size_t d = 0; d < grid.depth; ++d) {
        for (size_t l = 0; l < grid.light; ++l) {
          const size_t column = (THICKNESS * grid.depth + d) * grid.light + l;
          const double weight = static_cast<double>(draft.weight[pair * grid.columns() + column]);
          for (size_t row = 0; row < grid.rows(); ++row) {
            double value = static_cast<double>(matrix.column[0][column]);
            for (size_t k = 0; k < matrix.row.size(); ++k) {
              value += static_cast<double>(matrix.row[k][row]) *
                       static_cast<double>(matrix.column[k + 1][column]);
            }
            const double expected = static_cast<double>(
                draft.value[0][(pair * grid.rows() + row) * grid.columns() + column]);
            sum += weight * (value - expected) * (value - expected);
            weights += weight;
          }
        }
      }
      EXPECT_LT(std::sqrt(sum / weights), 0.03) << "set " << set << (up ? " up" : " down");
    }
  }
}

struct Errors {
  std::vector<double> radiance, centre, width;
};

// Errors at random points of one thickness where the radiance exceeds 2 % of its maximum over views
// and depths for the same set and light.
void errorsAt(double thickness, std::mt19937& random, std::array<Errors, CANONICAL_SETS>& errors) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const SlabMedium medium(moments(), thickness);
  const SlabTail tail(medium);
  std::array<double, SLAB_LANES> suns{};
  for (double& sun : suns) {
    sun = 0.01 + 0.99 * uniform(random);
  }
  const SlabOrders orders(tail, suns);
  std::vector<double> mu(10);
  for (double& cosine : mu) {
    cosine = 0.01 + 0.99 * uniform(random);
  }
  std::vector<double> depths = {0, thickness};
  for (int i = 0; i < 8; ++i) {
    depths.push_back(thickness * uniform(random));
    const double near = std::min(thickness, 1.0) * uniform(random);
    depths.push_back(i % 2 == 0 ? near : thickness - near);
  }
  const SlabDirections views = medium.directions(mu, std::vector<double>(mu.size()));
  for (size_t set = 0; set < SLAB_SETS; ++set) {
    const SlabLight light = orders.light(set, views, depths);
    for (size_t lane = 0; lane < SLAB_LANES; ++lane) {
      std::vector<std::array<double, 4>> found;
      double most = 0;
      for (size_t i = 0; i < 2 * mu.size() * depths.size(); ++i) {
        const bool up = i % 2 == 1;
        const size_t d = i / 2 % depths.size();
        const size_t v = i / 2 / depths.size();
        const double phi = PI * (2 * uniform(random) - 1);
        const SlabTransport truth = light.at(lane, v, up, d, phi);
        if (truth.radiance > LEAST) {
          const CanonicalTransport here =
              table().transport(set, {thickness, depths[d], up ? -mu[v] : mu[v], phi, suns[lane]});
          most = std::max(most, truth.radiance);
          found.push_back({truth.radiance, std::abs(here.radiance / truth.radiance - 1),
                           std::hypot(here.x - truth.x, here.y - truth.y) / truth.width,
                           std::abs(here.width / truth.width - 1)});
        }
      }
      for (const auto& [radiance, error, centre, width] : found) {
        if (radiance > 0.02 * most) {
          errors[set].radiance.push_back(error);
          errors[set].centre.push_back(centre);
          errors[set].width.push_back(width);
        }
      }
    }
  }
}

TEST(CanonicalTable, IsTheSolverBetweenItsNodes) {
  constexpr int THICKNESSES = 8;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::array<Errors, CANONICAL_SETS> errors;
  for (int i = 0; i < THICKNESSES; ++i) {
    errorsAt(0.0625 * std::pow(2048.0, (i + uniform(random)) / THICKNESSES), random, errors);
  }
  Errors all;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  const auto print = [](const char* name, int order, Errors& e) {
    std::printf(
        "%s %d: %zu points, radiance median %.4f p99 %.4f; centre %.3f %.3f, width %.3f "
        "%.3f\n",
        name, order, e.radiance.size(), quantile(e.radiance, 0.5), quantile(e.radiance, 0.99),
        quantile(e.centre, 0.5), quantile(e.centre, 0.99), quantile(e.width, 0.5),
        quantile(e.width, 0.99));
  };
  for (size_t set = 0; set < CANONICAL_SETS; ++set) {
    print("orders from", SLAB_ORDERS[set], errors[set]);
    append(all.radiance, errors[set].radiance);
    append(all.centre, errors[set].centre);
    append(all.width, errors[set].width);
    EXPECT_LE(quantile(errors[set].radiance, 0.5), 0.01) << set;
    EXPECT_LE(quantile(errors[set].radiance, 0.99), 0.1) << set;
  }
  print("all orders from", 2, all);
  EXPECT_LE(quantile(all.radiance, 0.5), 0.01);
  EXPECT_LE(quantile(all.radiance, 0.99), 0.1);
  EXPECT_LE(quantile(all.centre, 0.5), 0.05);
  EXPECT_LE(quantile(all.width, 0.5), 0.02);
}

TEST(CanonicalTable, IsFiniteEverywhere) {
  for (const double thickness : {1e-3, 1e-2, 0.0625, 1.0, 40.0, 128.0, 1e3, 1e4}) {
    for (const double part : {0.0, 1e-6, 0.1, 0.5, 0.9, 1.0}) {
      for (const double muLight : {1e-3, 0.01, 0.3, 1.0}) {
        for (const double mu : {-1.0, -0.4, -1e-3, 0.0, 1e-9, 0.2, 1.0}) {
          for (const double phi : {-PI, 0.0, 0.1, PI, 7.0}) {
            for (size_t set = 0; set < CANONICAL_SETS; ++set) {
              const CanonicalTransport here =
                  table().transport(set, {thickness, part * thickness, mu, phi, muLight});
              ASSERT_TRUE(std::isfinite(here.radiance) && std::isfinite(here.x) &&
                          std::isfinite(here.y) && std::isfinite(here.width))
                  << set << " " << thickness << " " << part << " " << mu << " " << muLight;
              ASSERT_GE(here.radiance, 0);
              ASSERT_LT(here.radiance, 20);
              ASSERT_GE(here.width, 0);
            }
          }
        }
      }
    }
  }
}

TEST(CanonicalTable, FollowsTheLimitsOutsideOfItsThicknesses) {
  // A thick slab's light of all further orders; a thin one's light scattered twice.
  const SlabMedium thick(moments(), 400);
  const SlabTail tail(thick);
  const std::array<double, 2> suns = {1, 0.4};
  const SlabOrders orders(tail, suns);
  const SlabDirections views = thick.directions({0.3, 0.9}, {0, 0});
  const std::vector<double> depths = {0, 3, 200, 397, 400};
  const SlabLight light = orders.light(SLAB_SETS - 1, views, depths);
  for (size_t lane = 0; lane < suns.size(); ++lane) {
    for (size_t d = 0; d < depths.size(); ++d) {
      for (const double mu : {0.9, -0.3}) {
        if ((d == 0 && mu > 0) || (d + 1 == depths.size() && mu < 0)) {
          continue;  // nothing arrives
        }
        const double truth = light.at(lane, mu > 0 ? 1 : 0, mu < 0, d, 1).radiance;
        const double here =
            table().transport(SLAB_SETS - 1, {400, depths[d], mu, 1, suns[lane]}).radiance;
        EXPECT_NEAR(here / truth, 1, 0.05) << depths[d] << " " << mu;
      }
    }
  }
}

}  // namespace
