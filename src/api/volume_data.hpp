// SPDX-License-Identifier: MIT
// Checks of voxel data, and the conversion of voxels on their way to the GPU.
#pragma once

#include "api/validate.hpp"
#include "frame/scene.hpp"

namespace welkin {

uint64_t bytesPerVoxel(uint32_t format);
void checkFormat(uint32_t sType, uint32_t format);
// A voxel's value, as it is and cleaned as below; any alignment.
float rawVoxel(const unsigned char* p, uint32_t format);
float readVoxel(const unsigned char* p, uint32_t format);

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
  VoxelRange filled;  // of the volume's voxels
  uint64_t replaced = 0;
};
void addVoxel(VoxelSums& sums, float value, const Edges& voxel);
// Also brings up to date the `faces` of the bricks of a volume of `size`.
VoxelSums convertVoxels(const WlkVolumeUpload& upload, bool toFloat, void* out, const Edges& size,
                        BrickFaces& faces);

}  // namespace welkin
