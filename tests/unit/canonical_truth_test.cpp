// SPDX-License-Identifier: MIT
// The solver of canonical slab transport against Monte Carlo (canonical_truth.csv, made by
// tests/bench/slab_truth.cpp), set by set: radiance, collector centre and width.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tables/canonical_phase.hpp"
#include "tables/slab_orders.hpp"

namespace {

using namespace welkin;

struct Row {
  double thickness, depth, mu, phi, muLight;
  size_t set;
  double radiance, error, x, y, shiftError, width, widthError;
};

std::vector<Row> truth() {
  std::ifstream file(WELKIN_UNIT_FOLDER "/canonical_truth.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    Row row{};
    const int found = std::sscanf(
        line.c_str(), "%lf,%lf,%lf,%lf,%lf,%zu,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &row.thickness,
        &row.depth, &row.mu, &row.phi, &row.muLight, &row.set, &row.radiance, &row.error, &row.x,
        &row.y, &row.shiftError, &row.width, &row.widthError);
    EXPECT_EQ(found, 13) << line;
    rows.push_back(row);
  }
  return rows;
}

struct Rms {
  double sum = 0;
  size_t count = 0;
  void add(double value) {
    sum += value * value;
    ++count;
  }
  double value() const { return std::sqrt(sum / static_cast<double>(count)); }
};

TEST(CanonicalTruth, SolverAgreesWithMonteCarloInEverySet) {
  const std::vector<double> chi = canonicalMoments(canonicalPhase(), 64);
  const std::vector<Row> rows = truth();
  constexpr double ENOUGH = 0.015;  // a value as noisy as this still counts
  std::array<Rms, SLAB_SETS> bySet;
  Rms radiance;
  Rms noise;
  Rms shift;
  Rms width;
  double thickness = 0;
  std::vector<double> suns;
  std::unique_ptr<SlabMedium> medium;
  std::unique_ptr<SlabTail> tail;
  std::vector<SlabOrders> orders;
  for (size_t i = 0; i < rows.size();) {
    size_t end = i;  // of the rows of one view
    while (end < rows.size() && rows[end].thickness == rows[i].thickness &&
           rows[end].depth == rows[i].depth && rows[end].mu == rows[i].mu) {
      ++end;
    }
    if (rows[i].thickness != thickness) {
      thickness = rows[i].thickness;
      suns.clear();
      for (size_t k = i; k < end; k += SLAB_SETS) {
        suns.push_back(rows[k].muLight);
      }
      orders.clear();
      medium = std::make_unique<SlabMedium>(chi, thickness);
      tail = std::make_unique<SlabTail>(*medium);
      for (size_t k = 0; k < suns.size(); k += SLAB_LANES) {
        orders.emplace_back(*tail,
                            std::span(suns).subspan(k, std::min(SLAB_LANES, suns.size() - k)));
      }
    }
    const SlabDirections view = medium->directions({std::abs(rows[i].mu)}, {0});
    const double depth[] = {rows[i].depth};
    std::vector<SlabLight> light;
    for (const SlabOrders& batch : orders) {
      for (size_t set = 0; set < SLAB_SETS; ++set) {
        light.push_back(batch.light(set, view, depth));
      }
    }
    for (; i < end; ++i) {
      const Row& row = rows[i];
      const size_t sun =
          static_cast<size_t>(std::find(suns.begin(), suns.end(), row.muLight) - suns.begin());
      const SlabTransport here = light[sun / SLAB_LANES * SLAB_SETS + row.set].at(
          sun % SLAB_LANES, 0, row.mu < 0, 0, row.phi);
      if (row.error < ENOUGH * row.radiance) {
        radiance.add(here.radiance / row.radiance - 1);
        bySet[row.set].add(here.radiance / row.radiance - 1);
        noise.add((here.radiance - row.radiance) / row.error);
      }
      if (std::max(row.shiftError, row.widthError) < ENOUGH * row.width) {
        shift.add(std::hypot(here.x - row.x, here.y - row.y) / row.width);
        width.add(here.width / row.width - 1);
      }
    }
  }
  for (size_t set = 0; set < SLAB_SETS; ++set) {
    std::printf("orders from %d: %zu values, %.2f %% rms\n", SLAB_ORDERS[set], bySet[set].count,
                100 * bySet[set].value());
    EXPECT_GE(bySet[set].count, 30U);
    EXPECT_LT(bySet[set].value(), 0.01);
  }
  std::printf(
      "%zu radiances: %.2f %% rms, %.2f standard errors rms; %zu collectors: centre %.2f "
      "%%, width %.2f %% of the width rms\n",
      radiance.count, 100 * radiance.value(), noise.value(), shift.count, 100 * shift.value(),
      100 * width.value());
  EXPECT_GE(radiance.count, 400U);
  EXPECT_LT(radiance.value(), 0.01);
  EXPECT_LT(noise.value(), 1.15);  // of 32 batches and 400 values: 1 +- 0.05
  EXPECT_GE(shift.count, 400U);
  EXPECT_LT(shift.value(), 0.01);
  EXPECT_LT(width.value(), 0.01);
}

TEST(CanonicalPhase, LosesThePartOfThePeakThatItsOwnFunctionHas) {
  const CanonicalPhase phase = canonicalPhase();
  const std::vector<double> chi = canonicalMoments(phase, 64);
  EXPECT_NEAR(chi[0], 1, 1e-12);
  std::printf("peak %.4f, mean cosine %.4f, without the peak %.4f, chi_63 %.2g\n", phase.removed,
              phase.asymmetry, chi[1], chi[63]);
  // An independent Mie program has 0.39, 0.850 and 0.753 for these droplets with index 1.333.
  EXPECT_NEAR(phase.removed, 0.39, 0.01);
  EXPECT_NEAR(phase.asymmetry, 0.850, 0.002);
  EXPECT_NEAR(chi[1], 0.753, 0.005);
  // Similarity: the transport depth (1 - g) tau stays.
  EXPECT_NEAR((1 - phase.removed) * (1 - chi[1]) / (1 - phase.asymmetry), 1, 0.015);
}

}  // namespace
