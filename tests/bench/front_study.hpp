// SPDX-License-Identifier: MIT
// One case measured: pictures, errors, counts and interleaved times (ms) of every method.
#pragma once

#include <functional>
#include <vector>

#include "bench/front_errors.hpp"
#include "bench/front_methods.hpp"
#include "bench/front_timing.hpp"
#include "bench/front_world.hpp"

namespace bench {

struct StudyOptions {
  size_t rounds = 15;
  /// Fewer methods, and only the converged pictures that lie in the folder.
  bool quick = false;
  bool levelsOnly = false;
  std::string referenceFolder;
};

struct Row {
  Method method;
  FrameCounts counts;
  Timing timing;
  Ordered truth;
  Ordered single;
  Ordered converged;
  /// Edges of the timed views over the case's.
  uint32_t timedScale = 1;
};

struct Study {
  std::vector<Row> rows;
  Ordered device;
  /// What timing it once more takes, as far as this time tells.
  double again_s = 0.0;
};

/// Told before each slow step.
using Tell = std::function<void(const std::string&)>;

/// `before`: an earlier study of the case, whose errors and counts are taken over.
Study studyCase(const Case& one, const StudyOptions& options, const Tell& tell,
                const Study* before = nullptr);

/// Whether it was timed on cores that were quiet, as far as the process knows by now.
bool isQuiet(const Row& row);

/// How many were.
size_t quietRows(const Study& study);

}  // namespace bench
