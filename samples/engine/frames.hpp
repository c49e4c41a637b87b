// SPDX-License-Identifier: MIT
// Frames in flight: the CPU records one while the GPU draws the one before.
#pragma once

#include <vector>

#include "engine/gpu.hpp"

class Frames {
 public:
  Frames(const Gpu& gpu, uint32_t inFlight);
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  // Waits until the frame that used this slot is complete; its command buffer is free then.
  void wait();
  // Starts recording frame index() + 1.
  VkCommandBuffer begin();
  // Ends recording and submits; drawing waits for imageReady().
  void submit(VkSemaphore rendered);

  // Number of the frame that is being recorded or was submitted last; the first is 1.
  uint64_t index() const { return index_; }
  // All frames up to this one are complete.
  uint64_t completed() const { return index_ > slots_.size() ? index_ - slots_.size() : 0; }
  VkSemaphore imageReady() const { return next().imageReady; }

 private:
  struct Slot {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence done = VK_NULL_HANDLE;
    VkSemaphore imageReady = VK_NULL_HANDLE;
  };
  // The slot of the frame after the last one that was submitted.
  const Slot& next() const { return slots_[submitted_ % slots_.size()]; }

  const Gpu& gpu_;
  std::vector<Slot> slots_;
  uint64_t index_ = 0;
  uint64_t submitted_ = 0;
};
