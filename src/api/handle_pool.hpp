// SPDX-License-Identifier: MIT
// Objects behind by-value handles: index + 1 in bits 0-23, generation in 24-47, the pool's tag in
// 48-63. A handle that is null, stale or of another pool or context is not found.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

namespace welkin {

template <typename T>
class HandlePool {
 public:
  HandlePool(std::pmr::memory_resource* memory, uint16_t tag)
      : memory_(memory), slots_(memory), tag_(tag) {}
  ~HandlePool() {
    for (Slot& slot : slots_) {
      release(slot);
    }
  }
  HandlePool(const HandlePool&) = delete;
  HandlePool& operator=(const HandlePool&) = delete;

  template <typename... Arguments>
  uint64_t create(Arguments&&... arguments) {
    uint32_t index = 0;
    while (index < slots_.size() && slots_[index].object != nullptr) {
      ++index;
    }
    if (index == slots_.size()) {
      slots_.push_back({});
    }
    std::pmr::polymorphic_allocator<> allocator(memory_);
    slots_[index].object = allocator.new_object<T>(std::forward<Arguments>(arguments)...);
    ++count_;
    return idOf(index);
  }

  T* find(uint64_t id) const {
    const uint64_t index = (id & 0xffffffu) - 1;
    if (index >= slots_.size() || idOf(static_cast<uint32_t>(index)) != id) {
      return nullptr;
    }
    return slots_[index].object;
  }

  // The object must exist.
  void destroy(uint64_t id) {
    Slot& slot = slots_[(id & 0xffffffu) - 1];
    release(slot);
    slot.generation = (slot.generation + 1) & 0xffffffu;
    --count_;
  }

  uint32_t count() const { return count_; }
  uint32_t slotCount() const { return static_cast<uint32_t>(slots_.size()); }
  // Null for an empty slot.
  T* at(uint32_t index) const { return slots_[index].object; }
  uint64_t idOf(uint32_t index) const {
    return uint64_t{tag_} << 48 | uint64_t{slots_[index].generation} << 24 | (index + 1);
  }

 private:
  struct Slot {
    T* object = nullptr;
    uint32_t generation = 0;
  };
  void release(Slot& slot) {
    if (slot.object != nullptr) {
      std::pmr::polymorphic_allocator<> allocator(memory_);
      allocator.delete_object(slot.object);
      slot.object = nullptr;
    }
  }
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Slot> slots_;
  uint32_t count_ = 0;
  uint16_t tag_;
};

}  // namespace welkin
