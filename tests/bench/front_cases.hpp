// SPDX-License-Identifier: MIT
// The scenes of the error-against-time benchmark, as front_cases.json lists them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/scene.hpp"

namespace bench {

struct Case {
  std::string name;
  /// Scene file, found from the folder of the list.
  std::string scene;
  /// Assignments over the scene: smaller data, no disk of the sun in the picture.
  std::vector<std::string> overrides;
  /// Assignments that choose the closed form of the phase functions; empty where there is none.
  std::vector<std::string> analytic;
  /// Pixels.
  uint32_t width = 128;
  uint32_t height = 72;
  /// Paths per pixel of the Monte Carlo references: all orders, and the first order only.
  uint32_t samplesAll = 256;
  uint32_t samplesSingle = 256;
  /// Quick runs too measure the methods that fill the curves.
  bool curves = false;
  /// Every test run measures level ultra too; of other cases with volumes, whose light of all
  /// orders takes two thirds of all invocations there, `welkin_front --check` does.
  bool ultraInTests = false;
  /// Width of the timed views at least, where the usual one leaves frames of few milliseconds; 0:
  /// the usual one. Pixels.
  uint32_t timedWidth = 0;
  /// First and last exposure in stops, and how many, at which FLIP looks at the picture.
  double flipStart = 0.0;
  double flipStop = 0.0;
  uint32_t flipCount = 1;
};

/// Reads the list. Throws InputError.
std::vector<Case> readCases(const std::string& file);

/// Everything over the scene file: overrides, size, and no quality of the scene's own, because the
/// methods choose it.
std::vector<std::string> assignmentsOf(const Case& one);

/// The scene, with the closed form of the phase functions if `analytic`.
host::Scene sceneOf(const Case& one, bool analytic);

bool hasVolumes(const Case& one);

}  // namespace bench
