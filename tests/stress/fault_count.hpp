// SPDX-License-Identifier: MIT
// How many faults each function met, by what failed: printed, and appended to the file that
// WELKIN_FAULT_RESULTS names, as docs/results/faults.csv has them. A crash ends the process before:
// its life has no lines.
#pragma once

#include <vulkan/vulkan_core.h>
#include <welkin/welkin.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace welkin::test {

// What calls of Vulkan fail with, and what Welkin makes of it.
inline constexpr std::array CODES{VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                                  VK_ERROR_DEVICE_LOST};
constexpr WlkResult codeOf(VkResult code) {
  return code == VK_ERROR_OUT_OF_HOST_MEMORY     ? WLK_ERROR_OUT_OF_HOST_MEMORY
         : code == VK_ERROR_OUT_OF_DEVICE_MEMORY ? WLK_ERROR_OUT_OF_DEVICE_MEMORY
                                                 : WLK_ERROR_DEVICE_LOST;
}

// Lives between two with a fault are so many times more where each is instrumented, and slow. No
// multiple of 3: codes take turns.
inline constexpr uint64_t SPARSER = WELKIN_SPARSER;
static_assert(SPARSER % CODES.size() != 0);

// 0, or the stride that WELKIN_ALL_FAULTS asks for, with each code at each place: 1 for all.
inline uint64_t strideOfAll() {
  const char* text = std::getenv("WELKIN_ALL_FAULTS");
  return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

// How many faults of one life and code docs/results/faults.csv has of each function.
inline std::map<std::string, uint64_t> recordedFaults(const std::string& source,
                                                      const std::string& life,
                                                      const std::string& code) {
  std::map<std::string, uint64_t> faults;
  std::ifstream file(WELKIN_RECORDED_FAULTS);
  std::string line;
  while (std::getline(file, line)) {
    std::array<std::string, 6> columns;
    std::istringstream row(line);
    for (std::string& column : columns) {
      std::getline(row, column, ',');
    }
    if (columns[0] == source && columns[1] == life && columns[3] == code) {
      faults[columns[2]] += std::stoull(columns[4]);
    }
  }
  return faults;
}

class FaultCounts {
 public:
  void add(const char* entry, const char* code, bool clean) {
    Count& count = counts_[{entry, code}];
    ++count.faults;
    count.leaks += clean ? 0 : 1;
  }
  uint64_t of(const std::string& entry) const {
    uint64_t sum = 0;
    for (const auto& [key, count] : counts_) {
      sum += key.first == entry ? count.faults : 0;
    }
    return sum;
  }
  std::set<std::string> entries() const {
    std::set<std::string> names;
    for (const auto& [key, count] : counts_) {
      names.insert(key.first);
    }
    return names;
  }
  void report(const char* source, const char* life) const {
    const char* path = std::getenv("WELKIN_FAULT_RESULTS");
    std::FILE* file = path == nullptr ? nullptr : std::fopen(path, "a");
    uint64_t sum = 0;
    for (const auto& [key, count] : counts_) {
      sum += count.faults;
      std::printf("  %-30s %-30s %llu\n", key.first.c_str(), key.second.c_str(),
                  static_cast<unsigned long long>(count.faults));
      if (file != nullptr) {
        std::fprintf(file, "%s,%s,%s,%s,%llu,%llu\n", source, life, key.first.c_str(),
                     key.second.c_str(), static_cast<unsigned long long>(count.faults),
                     static_cast<unsigned long long>(count.leaks));
      }
    }
    std::printf("%llu faults of %s in the life '%s'\n", static_cast<unsigned long long>(sum),
                source, life);
    if (file != nullptr) {
      std::fclose(file);
    }
  }

 private:
  struct Count {
    uint64_t faults = 0;
    uint64_t leaks = 0;
  };
  std::map<std::pair<std::string, std::string>, Count> counts_;
};

}  // namespace welkin::test
