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

/// Handovers of cores that share a cache are below this (20 to 60), of others above (100 and more).
constexpr double NEAR_CORES_ns = 80.0;

/// What one core waits for a word that another one writes, ns: the process' first two cores; 0 with
/// a single one.
double coreHandover_ns();

/// Waits until those cores share a cache and hand over nearly as fast as they ever have, for all
/// calls of a process a minute at most; returns their handover, ns. Hosts of virtual machines
/// move cores between caches every few seconds to minutes: 26 and 160 ns on one and the same
/// machine, where frames that share much took 5 to 30 % longer, each by another factor. No topology
/// tells; machines whose cores never share a cache wait in vain.
double awaitNearCores();

}  // namespace bench
