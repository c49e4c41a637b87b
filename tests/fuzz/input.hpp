// SPDX-License-Identifier: MIT
// What the targets of fuzzing share: a stream of values from arbitrary bytes, a file that holds
// them, and the end of a run whose claim does not hold.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

// The entry that libFuzzer and replay.cpp call.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace fuzz {

// Ends the process, which both callers report together with the input.
inline void require(bool holds, const char* claim) {
  if (!holds) {
    std::fprintf(stderr, "does not hold: %s\n", claim);
    std::abort();
  }
}

// Values from the front of the input; zeros once it is used up.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool empty() const { return size_ == 0; }

  template <typename T>
  T take() {
    T value{};
    const size_t count = std::min(sizeof value, size_);
    if (count > 0) {
      std::memcpy(&value, data_, count);
      data_ += count;
      size_ -= count;
    }
    return value;
  }
  // In [0, end).
  uint32_t below(uint32_t end) { return take<uint8_t>() % end; }
  bool oneIn(uint32_t n) { return below(n) == n - 1; }

  // Any bits, an edge of the formats, or an everyday number: most checks let only the last pass.
  template <typename T>
  T number() {
    using L = std::numeric_limits<T>;
    static constexpr std::array<T, 16> EDGES = {T(0),
                                                T(-0.0),
                                                T(1),
                                                T(-1),
                                                L::quiet_NaN(),
                                                L::infinity(),
                                                -L::infinity(),
                                                L::max(),
                                                L::denorm_min(),
                                                L::min(),
                                                L::epsilon(),
                                                T(1e-30),
                                                T(1e30),
                                                T(1) - L::epsilon() / 2,
                                                T(6371000),
                                                T(1e9)};
    switch (below(4)) {
      case 0:
        return take<T>();
      case 1:
        return EDGES[below(EDGES.size())];
      case 2:
        return static_cast<T>(take<int8_t>()) / T(127);
      default:
        return static_cast<T>(std::exp(T(0.0005) * static_cast<T>(take<int16_t>())));
    }
  }

 private:
  const uint8_t* data_;
  size_t size_;
};

// A file in memory for readers that take a path.
class File {
 public:
  File(const uint8_t* data, size_t size) : descriptor_(memfd_create("welkin_fuzz", 0)) {
    if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) {
      throw std::runtime_error("no file in memory");
    }
  }
  ~File() { close(descriptor_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace fuzz
