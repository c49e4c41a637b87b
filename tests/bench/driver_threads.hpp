// SPDX-License-Identifier: MIT
// Where the worker threads of the CPU driver run.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace bench {

/// Gives each worker of lavapipe's pools a core of those this process may use; how many cores have
/// one. Left to themselves both workers may wake up on one of two cores: the least CPU times of
/// frames of a few milliseconds differed by up to 16 % between processes, by 3 % with this. Knows
/// lavapipe's workers by their names and the order in which they are made; does nothing with other
/// drivers. Call it when all devices are there; threads made later are left alone.
size_t pinDriverThreads();

/// As long as it lives all threads of the process that are there share its first core: what they do
/// then does not depend on how near cores are to each other. After that each may run where it might
/// before. Threads made meanwhile inherit the one core, and keep it.
class OnOneCore {
 public:
  OnOneCore();
  ~OnOneCore();
  OnOneCore(const OnOneCore&) = delete;
  OnOneCore& operator=(const OnOneCore&) = delete;

 private:
  struct Place {
    pid_t thread = 0;
    std::vector<size_t> cores;
  };
  std::vector<Place> before_;
};

}  // namespace bench
