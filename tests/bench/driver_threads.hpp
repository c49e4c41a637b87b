// SPDX-License-Identifier: MIT
// Where the worker threads of the CPU driver run.
#pragma once

#include <cstddef>

namespace bench {

/// Gives each worker of lavapipe's pools a core of those this process may use; how many cores have
/// one. Left to themselves both workers may wake up on one of two cores: the least CPU times of
/// frames of a few milliseconds differed by up to 16 % between processes, by 3 % with this. Knows
/// lavapipe's workers by their names and the order in which they are made; does nothing with other
/// drivers. Call it when all devices are there; threads made later are left alone.
size_t pinDriverThreads();

}  // namespace bench
