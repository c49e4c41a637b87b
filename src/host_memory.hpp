// SPDX-License-Identifier: MIT
// The engine's host allocator as a memory resource; counts what it holds.
#pragma once

#include <welkin/welkin.h>

#include <cstdlib>
#include <memory_resource>
#include <new>

namespace welkin {

class HostMemory final : public std::pmr::memory_resource {
 public:
  explicit HostMemory(const WlkAllocator& allocator) : allocator_(allocator) {}
  uint64_t bytes() const { return bytes_; }
  const WlkAllocator& allocator() const { return allocator_; }

 private:
  void* do_allocate(size_t size, size_t alignment) override {
    void* memory = allocator_.allocate
                       ? allocator_.allocate(allocator_.user, size, alignment)
                       : std::aligned_alloc(alignment < sizeof(void*) ? sizeof(void*) : alignment,
                                            rounded(size, alignment));
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    bytes_ += size;
    return memory;
  }
  void do_deallocate(void* memory, size_t size, size_t alignment) override {
    bytes_ -= size;
    if (allocator_.allocate) {
      allocator_.release(allocator_.user, memory, size, alignment);
    } else {
      std::free(memory);
    }
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
  // aligned_alloc wants a multiple of the alignment.
  static size_t rounded(size_t size, size_t alignment) {
    size_t a = alignment < sizeof(void*) ? sizeof(void*) : alignment;
    return (size + a - 1) / a * a;
  }

  WlkAllocator allocator_;
  uint64_t bytes_ = 0;
};

}  // namespace welkin
