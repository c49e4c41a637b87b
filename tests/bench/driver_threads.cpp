// SPDX-License-Identifier: MIT
#include "bench/driver_threads.hpp"

#include <sys/types.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/cores.hpp"

namespace bench {
namespace {

struct Task {
  pid_t id = 0;
  std::string name;
};

// In the order in which they were made, as long as numbers do not begin anew.
std::vector<Task> tasksOfProcess() {
  std::vector<Task> tasks;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", none)) {
    std::ifstream file(entry.path() / "comm");
    Task task{std::stoi(entry.path().filename().string()), {}};
    if (std::getline(file, task.name)) {
      tasks.push_back(task);
    }
  }
  std::sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) { return a.id < b.id; });
  return tasks;
}

}  // namespace

size_t pinDriverThreads() {
  const std::vector<size_t>& cores = coresOfProcess();
  if (cores.empty()) {
    return 0;
  }
  // A device makes "llvmpipe-0", "llvmpipe-1" ... for triangles, then as many for dispatches, which
  // have the process' name.
  size_t drawing = 0;
  size_t dispatching = 0;
  size_t most = 0;
  for (const Task& task : tasksOfProcess()) {
    if (task.name.rfind("llvmpipe-", 0) == 0) {
      drawing = task.name == "llvmpipe-0" ? 0 : drawing;
      pinThread(task.id, {cores[drawing++ % cores.size()]});
      dispatching = 0;
      most = std::max(most, drawing);
    } else if (dispatching < drawing) {
      pinThread(task.id, {cores[dispatching++ % cores.size()]});
    }
  }
  return std::min(most, cores.size());
}

OnOneCore::OnOneCore() {
  if (coresOfProcess().empty()) {
    return;
  }
  for (const Task& task : tasksOfProcess()) {
    before_.push_back({task.id, coresOf(task.id)});
    pinThread(task.id, {coresOfProcess().front()});
  }
}

OnOneCore::~OnOneCore() {
  for (const Place& place : before_) {
    pinThread(place.thread, place.cores);
  }
}

}  // namespace bench
