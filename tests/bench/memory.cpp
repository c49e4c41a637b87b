// SPDX-License-Identifier: MIT
#include "bench/memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace bench {

Memory memoryNow() {
  Memory memory;
  std::ifstream info("/proc/meminfo");
  std::string key;
  uint64_t kib = 0;
  std::string unit;
  while (info >> key >> kib && std::getline(info, unit)) {
    memory.total = key == "MemTotal:" ? kib << 10 : memory.total;
    memory.available = key == "MemAvailable:" ? kib << 10 : memory.available;
  }
  uint64_t most = 0;
  uint64_t current = 0;
  // "max", which is no number: there is no limit.
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> most &&
      std::ifstream("/sys/fs/cgroup/memory.current") >> current) {
    std::ifstream stat("/sys/fs/cgroup/memory.stat");
    uint64_t bytes = 0;
    while (stat >> key >> bytes) {
      current -= key == "inactive_file" ? std::min(bytes, current) : 0;
    }
    memory.total = std::min(memory.total, most);
    memory.available = std::min(memory.available, most - std::min(current, most));
  }
  return memory;
}

}  // namespace bench
