// SPDX-License-Identifier: MIT
// A million arguments for each function of the model text, over all of its documented domain with
// the edges of float among them: no invalid operation, division by zero or overflow, results in
// range, and float as close to double as the text promises. Here: elementary functions, and that no
// function is left out; the others by their folder, model_sweep_*_test.cpp.
#include "model_sweep.hpp"

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace welkin::test {
namespace {

namespace files = std::filesystem;

TEST(ModelSweep, NumericFunctionsHoldForEveryArgument) {
  // Their own bounds, and what |x| times the argument's rounding adds below zero: at most 80.
  SWEEP(1, "oneMinusExp", (Claim{-1e35, 1.0, 3e-7}), ({a.signedMagnitude(1e-38f, 79.0f)}),
        m::oneMinusExp(x[0]));
  SWEEP(1, "phi1", (Claim{0.0, 1e35, 3e-7}), ({a.signedMagnitude(1e-38f, 79.0f)}), m::phi1(x[0]));
  SWEEP(1, "phi1, far", (Claim{0.0, 1.0, 3e-7}), ({a.magnitude(1.0f, 3e38f)}), m::phi1(x[0]));
  SWEEP(1, "phi1Small", (Claim{0.78, 1.3, 3e-7}), ({a.signedMagnitude(1e-38f, 0.5f)}),
        m::phi1Small(x[0]));
  // Four products and sums, each magnified by the ratio of neighbouring terms, 1/60: not at all.
  SWEEP(1, "cothSeries", (Claim{0.08, 0.0834, roundings(2)}), ({a.magnitude(1e-38f, 0.26f)}),
        m::cothSeries(x[0]));
  SWEEP(1, "safeExp", (Claim{0.0, 6e34, 3e-7}), ({a.signedMagnitude(1e-38f, 3e38f)}),
        m::safeExp(x[0]));
  SWEEP(3, "safeExp3", (Claim{0.0, 6e34, 3e-7}),
        ({a.signedMagnitude(1e-38f, 3e38f), a.uniform(-50.0f, 50.0f), a.uniform(-1.0f, 1.0f)}),
        m::safeExp3(m::vec3(x[0], x[1], x[2])));
  // Of e^d and 1, which is exact; the other has the rounding that counts four times.
  SWEEP(1, "meanExp", (Claim{0.0, 1e33, 1e-6}), ({a.signedMagnitude(1e-38f, 79.0f)}),
        m::meanExp(m::exp(x[0]), real(1), x[0]));
  SWEEP(1, "erfcxPositive", (Claim{0.0, 1.000001, 4.1e-7}), ({a.magnitude(1e-38f, 1e30f)}),
        m::erfcxPositive(x[0]));
}

TEST(ModelSweep, CompositingIsFiniteForAnyBits) {
  sweep<1>(
      "finiteValue", Claim{0.0, 65504.0, 0.0, 1.0, 1, TRAPPED_BUT_NAN},
      [](Arguments& a) { return std::array<float, 1>{a.anyBits()}; },
      [](const std::array<float, 1>& x) { return f32::finiteValue(x[0], 65504.0f); },
      [](const std::array<float, 1>& x) { return f64::finiteValue(double{x[0]}, 65504.0); });
  // A product and a sum of two positive numbers.
  SWEEP(3, "compositeOver", (Claim{0.0, 2e30, roundings(2.1)}),
        ({a.magnitude(1e-20f, 1e30f), a.uniform(0.0f, 1.0f), a.magnitude(1e-20f, 1e30f)}),
        m::compositeOver(m::vec3(x[0]), x[1], m::vec3(x[2])));
}

// Functions that a text defines: their names stand in the first column after their type.
std::set<std::string> functionsOf(const std::string& text) {
  static const std::regex DEFINITION(R"(\n(?:real|int|bool|vec[234]|[A-Z]\w+) (\w+)\()");
  std::set<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), DEFINITION), end; at != end; ++at) {
    names.insert((*at)[1]);
  }
  return names;
}

std::string contentOf(const files::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(ModelSweep, LeavesNoFunctionOut) {
  const files::path folder = WELKIN_UNIT_FOLDER;
  std::set<std::string> functions;
  for (const auto& file : files::recursive_directory_iterator(folder / "../../shaders/model")) {
    if (file.path().extension() == ".glsl") {
      functions.merge(functionsOf(contentOf(file.path())));
    }
  }
  static const std::regex SWEPT(R"X((?:SWEEP\(\s*\d+,|sweep<\d+>\()\s*"(\w+))X");
  std::set<std::string> swept;
  for (const auto& file : files::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    if (name.starts_with("model_sweep")) {
      const std::string text = contentOf(file.path());
      for (std::sregex_iterator at(text.begin(), text.end(), SWEPT), end; at != end; ++at) {
        swept.insert((*at)[1]);
      }
    }
  }
  // They put numbers into structures, as they are.
  for (const char* name :
       {"fogPhaseOf", "henyeyGreensteinOnly", "rayleighAsDraine", "columnsOf", "emptyChord"}) {
    swept.insert(name);
  }
  EXPECT_GT(functions.size(), 100u);
  for (const std::string& name : functions) {
    EXPECT_TRUE(swept.contains(name)) << name << " has no sweep";
  }
}

}  // namespace
}  // namespace welkin::test
