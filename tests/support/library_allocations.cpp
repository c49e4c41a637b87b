// SPDX-License-Identifier: MIT
// Replaces operator new of the whole process, and counts the calls that return into libwelkin.
#include "support/library_allocations.hpp"

#include <link.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

struct Text {
  uintptr_t begin = 0;
  uintptr_t end = 0;
};

Text findLibrary() {
  Text text;
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void* result) {
        if (std::strstr(info->dlpi_name, "libwelkin.so") == nullptr) {
          return 0;
        }
        auto& found = *static_cast<Text*>(result);
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const auto& part = info->dlpi_phdr[i];
          if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0) {
            found.begin = info->dlpi_addr + part.p_vaddr;
            found.end = found.begin + part.p_memsz;
          }
        }
        return 1;
      },
      &text);
  return text;
}

std::atomic<uint64_t> count{0};
// Set by the first question: counting begins there.
std::atomic<uintptr_t> textBegin{0};
std::atomic<uintptr_t> textEnd{0};

void* allocate(size_t size, size_t alignment, void* caller) {
  const auto from = reinterpret_cast<uintptr_t>(caller);
  if (from >= textBegin && from < textEnd) {
    ++count;
  }
  const size_t whole = (std::max<size_t>(size, 1) + alignment - 1) / alignment * alignment;
  return alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, whole)
                                               : std::malloc(whole);
}

void* allocateOrThrow(size_t size, size_t alignment, void* caller) {
  void* memory = allocate(size, alignment, caller);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

}  // namespace

void* operator new(size_t size) {
  return allocateOrThrow(size, 1, __builtin_return_address(0));
}
void* operator new[](size_t size) {
  return allocateOrThrow(size, 1, __builtin_return_address(0));
}
void* operator new(size_t size, const std::nothrow_t& /*unused*/) noexcept {
  return allocate(size, 1, __builtin_return_address(0));
}
void* operator new[](size_t size, const std::nothrow_t& /*unused*/) noexcept {
  return allocate(size, 1, __builtin_return_address(0));
}
void* operator new(size_t size, std::align_val_t alignment) {
  return allocateOrThrow(size, static_cast<size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](size_t size, std::align_val_t alignment) {
  return allocateOrThrow(size, static_cast<size_t>(alignment), __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t /*unused*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t /*unused*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t /*unused*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t /*unused*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t /*unused*/, std::align_val_t /*unused*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t /*unused*/, std::align_val_t /*unused*/) noexcept {
  std::free(memory);
}

namespace welkin::test {

uint64_t libraryAllocations() {
  static const Text text = findLibrary();
  textBegin = text.begin;
  textEnd = text.end;
  return count;
}

}  // namespace welkin::test
