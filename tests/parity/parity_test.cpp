// SPDX-License-Identifier: MIT
// Every public function of shaders/model on the device against double on the CPU, same text, and
// the same in float on the CPU with products and sums fused, as compilers for devices do it.
// Tolerance per number: condition x the bounds of operations and built-ins, plus what float
// rounding makes of the same text on the CPU, plus a few roundings for the freedom of order that
// SPIR-V leaves.
#include "parity/parity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>

#include "parity_spv.h"
#include "support/compute_runner.hpp"

namespace {

using namespace parity;

constexpr uint32_t GROUP = 64;
constexpr size_t ROWS = 8192;
constexpr double EPS_FLOAT = 0x1p-24;
constexpr unsigned NOISE_SAMPLES = 6;
constexpr double NOISE_FACTOR = 2;     // the worst of 6 sign patterns against the worst of all
constexpr double ROUNDING_FACTOR = 4;  // CPU and device round in a different order
constexpr double ROUNDINGS = 24;       // where the CPU happens to round to the right number
constexpr double ABSOLUTE = 1e-18;     // tails under e^-46 are cut, at slightly different arguments

// Noise may cut a ray through air into other segments: a tolerance that allows more says little.
constexpr double VAGUE = 1e-3;
constexpr double VAGUE_LEAST = 1e-9;  // of radiances of about 1

class Parity : public testing::TestWithParam<int> {
 protected:
  static void SetUpTestSuite() { runner_ = std::make_unique<support::ComputeRunner>(); }
  static void TearDownTestSuite() { runner_.reset(); }
  static std::unique_ptr<support::ComputeRunner> runner_;
};
std::unique_ptr<support::ComputeRunner> Parity::runner_;

// Size against which rounding is measured: the result, but for a difference its operands.
double scaleOf(int which, const Row& row, size_t component, double value) {
  if (which == CASE_ALTITUDE && component == 0) {
    const double t = row[3];
    return std::max(
        {std::abs(static_cast<double>(row[0])), std::abs(t * row[1]), t * t / (2.0 * row[2])});
  }
  return std::abs(value);
}

// Rays within float rounding of the horizon may hit or miss.
bool undecided(int which, const Row& row) {
  if (which != CASE_GROUND) {
    return false;
  }
  const double h = row[0];
  const double radius = row[2];
  const double horizon = -std::sqrt(h * (2 * radius + h)) / (radius + h);
  return std::abs(row[1] - horizon) < 8 * EPS_FLOAT;
}

// `found`: result k of row i. Returns the largest error in tolerances.
double expectDouble(int which, const std::vector<Row>& rows, const char* where,
                    const std::function<double(size_t i, size_t k)>& found) {
  double worst = 0;
  size_t failures = 0;
  size_t vague = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (undecided(which, rows[i])) {
      continue;
    }
    const Result exact = evaluateDouble(which, rows[i]);
    const Result single = evaluateFloat(which, rows[i]);
    Result noise{};
    for (unsigned seed = 1; seed <= NOISE_SAMPLES; ++seed) {
      const Result noisy = evaluateNoisy(which, rows[i], seed * 7919);
      for (size_t k = 0; k < noise.size(); ++k) {
        noise[k] = std::max(noise[k], std::abs(noisy[k] - exact[k]));
      }
    }
    for (size_t k = 0; k < exact.size(); ++k) {
      const double value = found(i, k);
      const double tolerance =
          NOISE_FACTOR * noise[k] + ROUNDING_FACTOR * std::abs(single[k] - exact[k]) +
          ROUNDINGS * EPS_FLOAT * scaleOf(which, rows[i], k, exact[k]) + ABSOLUTE;
      const double error = std::abs(value - exact[k]);
      worst = std::max(worst, error / tolerance);
      vague += tolerance > VAGUE * scaleOf(which, rows[i], k, exact[k]) + VAGUE_LEAST ? 1U : 0U;
      if (!(error <= tolerance) && ++failures <= 5) {
        ADD_FAILURE() << caseName(which) << " row " << i << " output " << k << ": " << where
                      << value << ", CPU float " << single[k] << ", double " << exact[k]
                      << ", tolerance " << tolerance << "\n  inputs "
                      << testing::PrintToString(rows[i]);
      }
    }
  }
  EXPECT_EQ(failures, 0U) << "of " << rows.size();
  if (which == CASE_AIR) {
    EXPECT_LE(vague, rows.size() / 10) << "noise hides what is tested";
  }
  return worst;
}

TEST_P(Parity, DeviceMatchesDouble) {
  const int which = GetParam();
  const std::vector<Row> rows = inputs(which, ROWS);
  std::vector<float> flat(rows.size() * std::tuple_size_v<Row>);
  std::memcpy(flat.data(), rows.data(), flat.size() * sizeof(float));
  const std::vector<float> device =
      runner_->run(parity_spv, which, flat, rows.size() * 8, ROWS / GROUP);
  const double worst = expectDouble(which, rows, "device ", [&device](size_t i, size_t k) {
    return static_cast<double>(device[i * 8 + k]);
  });
  RecordProperty("worst_percent_of_tolerance", static_cast<int>(worst * 100));
  EXPECT_TRUE(runner_->messages().empty()) << runner_->messages().front();
}

// lavapipe fuses nothing, GPUs do.
TEST_P(Parity, FusedMatchesDouble) {
  if (!canFuse()) {
    GTEST_SKIP() << "this processor does not fuse";
  }
  const int which = GetParam();
  const std::vector<Row> rows = inputs(which, ROWS);
  std::vector<Result> fused;
  fused.reserve(rows.size());
  for (const Row& row : rows) {
    fused.push_back(evaluateFused(which, row));
  }
  if (which == CASE_AIR) {
    size_t others = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
      others += fused[i] != evaluateFloat(which, rows[i]) ? 1U : 0U;
    }
    EXPECT_GT(others, rows.size() / 2) << "nothing is fused";
  }
  const double worst =
      expectDouble(which, rows, "fused ", [&fused](size_t i, size_t k) { return fused[i][k]; });
  RecordProperty("worst_percent_of_tolerance", static_cast<int>(worst * 100));
}

// Passes take the floor of them to find a table's row: what a root or a logarithm of the device has
// below 0 would be another row, or none.
TEST(NodeCoordinates, AreNeverNegative) {
  struct Coordinate {
    int which;
    size_t input;
    std::vector<float> least;  // values with which the coordinate is 0
    size_t output;
  };
  for (const Coordinate& one : {Coordinate{CASE_CANONICAL, 2, {0.0f, 0.004f, 0.01f}, 2},
                                Coordinate{CASE_SCATTERING_TABLE, 1, {0.0f, 1e-9f}, 1},
                                Coordinate{CASE_SOURCE, 3, {0.0f, 0.004f, -0.01f}, 3}}) {
    Row row = inputs(one.which, 9).back();
    for (const float value : one.least) {
      row[one.input] = value;
      for (unsigned seed = 1; seed <= 1000; ++seed) {
        ASSERT_GE(evaluateNoisy(one.which, row, seed * 7919)[one.output], 0)
            << caseName(one.which) << ' ' << value;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Model, Parity, testing::Range(0, CASE_COUNT),
                         [](const testing::TestParamInfo<int>& which) {
                           return std::string(caseName(which.param));
                         });

}  // namespace
