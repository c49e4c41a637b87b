// SPDX-License-Identifier: MIT
// The work of the library's light and eye passes, vectorised by hand for the CPU (AVX2, FMA, F16C;
// 8 pixels at a time), on two threads: how far the device's shaders are from the machine. Single
// scattering, slabs across the light in batches of 64.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/volume_scene.hpp"

namespace bench {

// Whether this machine has the instructions.
bool marchRuns();

class CloudMarch {
 public:
  CloudMarch(const Cloud& cloud, const Vec3& toLight, uint32_t size, uint32_t slices,
             uint32_t lightSize, uint32_t threads);
  // A frame, light and eye.
  void render();
  // RGBA of which red is radiance per unit irradiance and alpha transmittance.
  std::vector<float> picture() const;

 private:
  void lightRow(uint32_t row, uint32_t firstSlab);
  void eyeRow(uint32_t row, uint32_t firstSlab, bool first);

  std::vector<uint16_t> density_;
  Vec3 toLight_;
  CloudSlabs slabs_;
  uint32_t size_;
  uint32_t slices_;
  uint32_t batch_;
  uint32_t lightSize_;
  uint32_t threads_;
  std::vector<float> light_;     // optical depth at the planes of a batch
  std::vector<float> radiance_;  // per pixel
  std::vector<float> through_;
};

}  // namespace bench
