// SPDX-License-Identifier: MIT
// A host allocator that counts, checks every release against its allocation, and fails on demand.
#pragma once

#include <gtest/gtest.h>
#include <welkin/welkin.h>

#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <unordered_map>

namespace welkin::test {

class CountingAllocator {
 public:
  static constexpr uint64_t NEVER = ~uint64_t{0};

  WlkAllocator callbacks() { return {this, allocate, release}; }
  // Fails the n-th allocation from now on, counted from 0, and every one after it.
  void failFrom(uint64_t n) {
    failAt_ = n == NEVER ? NEVER : calls_ + n;
    once_ = false;
  }
  // Fails the n-th alone.
  void failOnce(uint64_t n) {
    failFrom(n);
    once_ = true;
  }
  uint64_t calls() const { return calls_; }
  size_t live() const { return blocks_.size(); }

 private:
  struct Block {
    uint64_t size;
    uint64_t alignment;
  };

  static void* allocate(void* user, uint64_t size, uint64_t alignment) {
    auto& self = *static_cast<CountingAllocator*>(user);
    const std::lock_guard lock(self.mutex_);
    EXPECT_GT(size, 0u);
    EXPECT_EQ(alignment & (alignment - 1), 0u) << "alignment " << alignment;
    const uint64_t n = self.calls_++;
    if (self.once_ ? n == self.failAt_ : n >= self.failAt_) {
      return nullptr;
    }
    // Exactly the alignment asked for, and not the next: what needs more shows.
    auto* place = static_cast<unsigned char*>(std::malloc(size + 4 * alignment));
    const auto address = reinterpret_cast<uintptr_t>(place);
    const uintptr_t even = (address + 2 * alignment - 1) / (2 * alignment) * (2 * alignment);
    auto* memory = reinterpret_cast<unsigned char*>(even + alignment);
    self.blocks_.emplace(memory, Block{size, alignment});
    self.places_.emplace(memory, place);
    return memory;
  }

  static void release(void* user, void* memory, uint64_t size, uint64_t alignment) {
    auto& self = *static_cast<CountingAllocator*>(user);
    const std::lock_guard lock(self.mutex_);
    const auto found = self.blocks_.find(memory);
    ASSERT_NE(found, self.blocks_.end()) << "released what was never allocated, or twice";
    EXPECT_EQ(found->second.size, size);
    EXPECT_EQ(found->second.alignment, alignment);
    self.blocks_.erase(found);
    std::free(self.places_.at(memory));
    self.places_.erase(memory);
  }

  std::mutex mutex_;
  std::unordered_map<void*, Block> blocks_;
  std::unordered_map<void*, unsigned char*> places_;
  uint64_t calls_ = 0;
  uint64_t failAt_ = NEVER;
  bool once_ = false;
};

}  // namespace welkin::test
