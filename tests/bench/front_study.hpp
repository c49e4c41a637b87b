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
  /// At least.
  size_t rounds = 15;
  /// Rounds go on for so long. Asked when all pictures are made; the timed frames' warm-ups are
  /// still to come.
  std::function<double()> timing_s = [] { return 0.0; };
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
  /// Of all visits, in the order taken.
  std::vector<FrameTime> samples;
  Ordered device;
};

/// What a study of the case measures.
std::vector<Method> methodsOf(const Case& one, const StudyOptions& options);

/// Told before each slow step.
using Tell = std::function<void(const std::string&)>;

/// `before`: an earlier study of the case, whose errors and counts are taken over, and whose times
/// count with the new ones.
Study studyCase(const Case& one, const StudyOptions& options, const Tell& tell,
                const Study* before = nullptr);

/// Whether at least half of its rounds were on quiet cores, quiet as far as the process knows by
/// now.
bool isQuiet(const Row& row);

}  // namespace bench
