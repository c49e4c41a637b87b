// SPDX-License-Identifier: MIT
// A case measured: pictures, errors, counts and interleaved times (ms) of every method.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/front_errors.hpp"
#include "bench/front_methods.hpp"
#include "bench/front_timing.hpp"
#include "bench/front_world.hpp"

namespace bench {

struct StudyOptions {
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

/// What a study of the case measures.
std::vector<Method> methodsOf(const Case& one, const StudyOptions& options);

/// Told before each slow step.
using Tell = std::function<void(const std::string&)>;

/// Holds the case's contexts, so that several cases can be timed in turn.
class FrontStudy {
 public:
  /// Pictures, errors and counts; the timed frames' warm-ups.
  FrontStudy(const Case& one, const StudyOptions& options, const Tell& tell);
  ~FrontStudy();
  FrontStudy(const FrontStudy&) = delete;
  FrontStudy& operator=(const FrontStudy&) = delete;

  /// Times every method, Sampler::takeBlock.
  void takeBlock(bool onOneCore);
  /// After a block at least.
  [[nodiscard]] std::vector<Row> rows() const;
  [[nodiscard]] Ordered device() const;
  /// On how many cores the driver works in this process, in memory of the host; 0: it does not.
  [[nodiscard]] size_t cores() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Whether at least half of its rounds were on quiet cores, quiet as far as the process knows by
/// now.
bool isQuiet(const Row& row);

}  // namespace bench
