// SPDX-License-Identifier: MIT
// Checks of voxel data, and the conversion of voxels on their way to the GPU.
#pragma once

#include "api/validate.hpp"
#include "frame/scene.hpp"

namespace welkin {

void checkUpload(const VolumeState& volume, const WlkVolumeUpload& upload);

// Nearest half float of a finite value in [0, 65504], as bits.
uint16_t halfFromFloat(float value);
float floatFromHalf(uint16_t bits);

// Writes the voxels tightly packed as float or half; what is negative or not finite becomes 0, what
// is over 65504 becomes that.
struct VoxelSums {
  float largest = 0;
  double sum = 0;
  double squares = 0;
  VoxelRange filled;  // within the upload
};
VoxelSums convertVoxels(const WlkVolumeUpload& upload, bool toFloat, void* out);

}  // namespace welkin
