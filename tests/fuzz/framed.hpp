// SPDX-License-Identifier: MIT
// Structures of the API from arbitrary bytes: a valid one whose fields were overwritten, now and
// then behind a wrong header; and what must hold of every result.
#pragma once

#include <welkin/welkin.h>

#include <vector>
#include <welkin/welkin.hpp>

#include "input.hpp"

namespace fuzz {

// Any result but a defect, and the last error is that of the call.
inline bool checkResult(WlkResult result) {
  require(result >= WLK_ERROR_INTERNAL && result != WLK_ERROR_INTERNAL, "no defect is reported");
  require(std::strcmp(wlkResultName(result), "WLK_UNKNOWN_RESULT") != 0, "results have names");
  if (result < 0) {
    auto info = welkin::make<WlkErrorInfo>();
    require(wlkGetLastError(&info) == WLK_SUCCESS && info.result == result && info.message[0] != 0,
            "a failed call leaves its message");
  }
  return result == WLK_SUCCESS;
}

template <typename T>
class Framed {
 public:
  explicit Framed(Input& input) : value(welkin::make<T>()), input_(input) {
    constexpr uint32_t HEADER = 16;
    auto* bytes = reinterpret_cast<unsigned char*>(&value);
    for (uint32_t edits = input.below(8); edits > 0; --edits) {
      const uint32_t offset =
          HEADER + 4 * (input.take<uint16_t>() % static_cast<uint32_t>((sizeof(T) - HEADER) / 4));
      const uint32_t kind = input.below(3);
      if (kind == 0) {
        write(bytes + offset, input.below(16));
      } else if (kind == 1 && offset % 8 == 0 && offset + 8 <= sizeof(T)) {
        write(bytes + offset, input.number<double>());
      } else {
        write(bytes + offset, input.number<float>());
      }
    }
  }

  // A structure that is right but for its header, now and then.
  Framed(Input& input, const T& right) : value(right), input_(input) {}

  // To call once the pointers in `value` are set: what was overwritten is no pointer.
  T* get() {
    if (!input_.oneIn(24)) {
      return &value;
    }
    switch (input_.below(5)) {
      case 0:
        return nullptr;
      case 1:
        value.sType = input_.take<uint32_t>();
        break;
      case 2:
        // As far as there is memory to read.
        value.structSize =
            static_cast<uint32_t>(input_.take<uint32_t>() % (sizeof(T) + sizeof tail_ + 1));
        break;
      case 3:
        value.structSize = sizeof(T) + sizeof tail_;
        tail_[input_.below(sizeof tail_)] = input_.take<unsigned char>();
        break;
      default:
        chained_[0] = input_.take<uint32_t>() % 2000;
        value.next = chained_;
    }
    return &value;
  }

  T value;

 private:
  unsigned char tail_[32] = {};
  uint32_t chained_[8] = {0, 16};
  Input& input_;

  template <typename V>
  static void write(unsigned char* place, V number) {
    std::memcpy(place, &number, sizeof number);
  }
};

// Objects that were made: handles of live ones, dead ones, and numbers that never were one.
template <typename Handle>
class Handles {
 public:
  Handle pick(Input& input) const {
    if (known_.empty() || input.oneIn(16)) {
      return Handle{input.take<uint64_t>()};
    }
    return known_[input.below(static_cast<uint32_t>(known_.size()))];
  }
  void add(Handle handle) { known_.push_back(handle); }
  [[nodiscard]] const std::vector<Handle>& all() const { return known_; }

 private:
  std::vector<Handle> known_;
};

// A Run's calls until the input is used up, or `most` of them; then `last` of it, if there is one.
template <typename Run>
int run(const uint8_t* data, size_t size, uint32_t most, void (Run::*last)() = nullptr) {
  Input input(data, size);
  Run calls(input);
  for (uint32_t n = 0; n < most && !input.empty(); ++n) {
    calls.call();
  }
  if (last != nullptr) {
    (calls.*last)();
  }
  return 0;
}

template <typename T>
void requireLight(const T* values, size_t count, T highest, const char* claim) {
  for (size_t i = 0; i < count; ++i) {
    require(std::isfinite(values[i]) && values[i] >= 0 && values[i] <= highest, claim);
  }
}

}  // namespace fuzz
