// SPDX-License-Identifier: MIT
// A headless context's life, in steps as an engine's (engine_life.hpp): creation, uploads, frames,
// pictures read back, destruction.
#pragma once

#include <vector>

#include "stress/engine_life.hpp"

namespace welkin::test {

class HeadlessLife {
 public:
  static constexpr uint32_t WIDTH = 16;
  static constexpr uint32_t HEIGHT = 12;

  // Droplets' tables take 0.3 s.
  explicit HeadlessLife(bool droplets = false) : droplets_(droplets) { chooseDriver(); }
  ~HeadlessLife() { wlkDestroyContext(context); }
  HeadlessLife(const HeadlessLife&) = delete;
  HeadlessLife& operator=(const HeadlessLife&) = delete;

  std::vector<Step> steps();

  CountingAllocator memory;
  WlkContext context = nullptr;
  WlkMedium medium{};
  WlkVolume volume{};
  WlkView view{};
  std::vector<float> picture;  // read back last

 private:
  bool droplets_;
  WlkResult create();
  WlkResult setLights() const;
  WlkResult createMedium();
  WlkResult createVolume();
  WlkResult upload(float value) const;
  WlkResult createView();
  WlkResult setQuality() const;
  WlkResult readback();
};

}  // namespace welkin::test
