// SPDX-License-Identifier: MIT
// A thread that makes the clouds' density and copies it to the engine's own 3-D image, on the queue
// on which the frames are drawn. The window shows frames meanwhile.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "engine/resources.hpp"

class CloudStream {
 public:
  explicit CloudStream(const Gpu& gpu);
  ~CloudStream();
  CloudStream(const CloudStream&) = delete;
  CloudStream& operator=(const CloudStream&) = delete;

  // Null until the copy is done; then in SAMPLED_BY_SHADERS.
  const Image* image() const { return done_.load() ? image_.get() : nullptr; }
  // Throws what the thread threw.
  void check() const;

  static constexpr uint32_t WIDTH = 96;
  static constexpr uint32_t HEIGHT = 40;
  static constexpr uint32_t DEPTH = 96;
  static constexpr ImageState SAMPLED_BY_SHADERS{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
                                                 VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                                 VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

 private:
  void run();
  void copy(const Buffer& from) const;

  const Gpu& gpu_;
  std::unique_ptr<Image> image_;
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false};
  std::atomic<bool> done_{false};
  std::thread thread_;  // last: it uses the others
};
