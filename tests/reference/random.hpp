// SPDX-License-Identifier: MIT
// Random numbers that are a function of (seed, pixel, sample, channel, dimension) and of nothing
// else, so that no result depends on the number of threads. [S14] G. Steele, D. Lea, C. Flood 2014,
// Fast splittable pseudorandom number generators: the mixing function of its Fig. 16.
#pragma once

#include <cmath>
#include <cstdint>

namespace welkin::reference {

class Random {
 public:
  Random(uint64_t seed, uint64_t pixel, uint64_t sample, uint64_t channel)
      : state_(mix(mix(mix(mix(seed + STEP) + pixel * STEP) + sample * STEP) + channel * STEP)) {}

  // Uniform in (0, 1): 53 bits, centred, so that neither end occurs.
  double uniform() {
    state_ += STEP;
    return (static_cast<double>(mix(state_) >> 11) + 0.5) * 0x1p-53;
  }

  // Exponential with mean 1.
  double exponential() { return -std::log(uniform()); }

 private:
  static constexpr uint64_t STEP = 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio

  static uint64_t mix(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

}  // namespace welkin::reference
