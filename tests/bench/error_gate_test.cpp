// SPDX-License-Identifier: MIT
// The quality levels keep their contract (docs/results/contract.json): errors (no unit) against the
// committed references, and the counts of a frame. `welkin_front --write-contract` renews it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "bench/error_gate_cases.hpp"

namespace bench {

// For the test runner's messages.
void PrintTo(const Case& one, std::ostream* stream) {
  *stream << one.name;
}

namespace {

Case caseOf(const std::string& name) {
  for (const Case& one : gateCases()) {
    if (one.name == name) {
      return one;
    }
  }
  ADD_FAILURE() << "no case " << name;
  return {};
}

class ErrorGate : public testing::TestWithParam<Case> {};

TEST_P(ErrorGate, LevelsKeepTheContract) {
  const Ordered contract = readContract(WELKIN_CONTRACT);
  const GateCase& gate = gateCase(GetParam());
  const bool hasVolumes = gate.references.converged.picture.has_value();
  const size_t left = hasVolumes && !GetParam().ultraInTests ? 1 : 0;
  ASSERT_EQ(gate.levels.size(), (hasVolumes ? 2 : 1) * LEVEL_COUNT - left);
  for (const Measured& measured : gate.levels) {
    for (const std::string& text : violations(measured.row, findRow(contract, measured.row))) {
      ADD_FAILURE() << text;
    }
  }
}

std::string testName(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ErrorGate, testing::ValuesIn(gateCases()), testName);

Ordered exampleRow(double error, double dispatches) {
  return {{"case", "cumulus-side"},
          {"level", "low"},
          {"counts", {{"dispatches", dispatches}}},
          {"errors", {{"converged", {{"rmseOverMean", error}}}}}};
}

TEST(ErrorGateRules, ErrorMayGrowByTenPerCent) {
  EXPECT_TRUE(violations(exampleRow(0.0109, 5), exampleRow(0.01, 5)).empty());
  const auto found = violations(exampleRow(0.0112, 5), exampleRow(0.01, 5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "cumulus-side, level low: error converged.rmseOverMean is 0.0112, the contract says "
            "0.01: 12 % more, 10 % allowed");
}

// A thick cloud, one among others, one of drops that show a glory, and a slab, at every level.
TEST(ErrorGateRules, SomeVolumesAreMeasuredAtUltraInEveryRun) {
  const std::vector<Case> all = gateCases();
  EXPECT_GE(std::count_if(all.begin(), all.end(),
                          [](const Case& one) { return one.ultraInTests && hasVolumes(one); }),
            4);
}

TEST(ErrorGateRules, ErrorThatIsNotANumberFails) {
  EXPECT_EQ(violations(exampleRow(NAN, 5), exampleRow(0.01, 5)).size(), 1u);
}

TEST(ErrorGateRules, CountsMayGrowByTwoPerCent) {
  EXPECT_TRUE(violations(exampleRow(0.01, 101), exampleRow(0.01, 100)).empty());
  const auto found = violations(exampleRow(0.01, 103), exampleRow(0.01, 100));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "cumulus-side, level low: dispatches is 103, the contract says 100: 3 % more, 2 % "
            "allowed");
}

TEST(ErrorGateRules, RowsAndReferencesMayNotGoMissing) {
  EXPECT_EQ(violations(exampleRow(0.01, 5), nullptr).size(), 1u);
  Ordered bare = exampleRow(0.01, 5);
  bare["errors"] = Ordered::object();
  EXPECT_EQ(violations(bare, exampleRow(0.01, 5)).size(), 1u);
}

// The results name the settings behind each level: the copy in front_methods.cpp is the library's.
TEST(FrontMethods, LevelSettingsAreTheLibrarys) {
  for (const Method& method : levelMethods()) {
    std::vector<host::Image> pictures;
    std::vector<uint64_t> invocations;
    for (WlkQuality quality : {qualityOf(method), explicitQuality(method.settings)}) {
      quality.volumeCells = 8;  // neither says how many: the light inside takes most of the time
      // A world of its own: views share the light of the volumes.
      World world(caseOf("slab-1"), false);
      const host::RasterResult opaque = world.makeOpaque();
      const WlkView view = world.addView(quality);
      world.prepare();
      world.render(view, opaque);
      pictures.push_back(world.read(view));
      invocations.push_back(world.counts(view).invocations);
      world.removeView(view);
    }
    EXPECT_EQ(invocations[0], invocations[1]) << method.name;
    EXPECT_TRUE(pictures[0].rgba == pictures[1].rgba) << method.name;
  }
}

}  // namespace
}  // namespace bench
