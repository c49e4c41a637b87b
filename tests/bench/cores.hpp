// SPDX-License-Identifier: MIT
// The cores that a process runs on: how near they are to each other, and what others leave of them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace bench {

/// Where the thread may run; none if it has ended.
std::vector<size_t> coresOf(pid_t thread);

/// Those this process might use when first asked: threads may be pinned later.
const std::vector<size_t>& coresOfProcess();

/// Where it may run from now on. Nothing happens to a thread that has ended.
void pinThread(pid_t thread, const std::vector<size_t>& cores);

/// What one core waits for a word that another one writes, ns: the process' first two cores, 20 to
/// 60 if they share a cache, else 100 and more; 0 with a single one.
double coreHandover_ns();

/// What a fixed piece of arithmetic and of reading from the shared cache takes while all cores are
/// at it, ns: the slowest core's; 0 if none is known. Others' work on the same cores or caches
/// makes it longer, and frames with it, each by another factor.
double coreWork_ns();

/// From so many times the least work on, cores are not quiet: of 120 looks on a virtual machine of
/// two cores undisturbed ones were up to 1.12 times the least, most 1.02, others 1.17 to 1.9.
constexpr double QUIET_WORK = 1.15;

struct CoreState {
  double handover_ns = 0.0;
  double work_ns = 0.0;
};

/// The least that currentCores has found in this process.
CoreState bestCores();

CoreState currentCores();

/// Whether cores in that state were as near each other and as much this process' own as they have
/// ever been found.
bool areQuiet(const CoreState& state);

/// Waits until the cores are quiet, no longer than that, ms, and returns what they were like at
/// last. Hosts of virtual machines move cores between caches every few seconds to minutes (26 and
/// 160 ns on one and the same machine, where frames that share much took 5 to 30 % longer), and let
/// others work on them for minutes (frames took 20 to 60 % longer). No topology tells.
CoreState awaitQuietCores(double patience_ms);

}  // namespace bench
