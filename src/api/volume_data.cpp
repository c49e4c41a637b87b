// SPDX-License-Identifier: MIT
#include "api/volume_data.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace welkin {
namespace {

constexpr float LARGEST_VALUE = 65504.0f;

float clean(float x) {
  return x > 0.0f ? (std::isinf(x) ? 0.0f : (x < LARGEST_VALUE ? x : LARGEST_VALUE)) : 0.0f;
}

// a * b + c, or fails: pitches come from outside.
uint64_t checkedSum(uint64_t a, uint64_t b, uint64_t c) {
  uint64_t product = 0;
  uint64_t sum = 0;
  if (__builtin_mul_overflow(a, b, &product) || __builtin_add_overflow(product, c, &sum)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VOLUME_UPLOAD, "slicePitch",
         "WlkVolumeUpload: the pitches overflow");
  }
  return sum;
}

void include(VoxelRange& range, const Edges& voxel) {
  for (size_t i = 0; i < voxel.size(); ++i) {
    range.first[i] = std::min(range.first[i], voxel[i]);
    range.end[i] = std::max(range.end[i], voxel[i] + 1);
  }
}

}  // namespace

uint64_t bytesPerVoxel(uint32_t format) {
  return format == WLK_FORMAT_R32_FLOAT ? 4 : (format == WLK_FORMAT_R16_FLOAT ? 2 : 1);
}

void checkFormat(uint32_t sType, uint32_t format) {
  if (format < WLK_FORMAT_R32_FLOAT || format > WLK_FORMAT_R8_UNORM) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, sType, "format", "%s::format is %u", structName(sType),
         format);
  }
}

float rawVoxel(const unsigned char* p, uint32_t format) {
  if (format == WLK_FORMAT_R32_FLOAT) {
    float x = 0;
    std::memcpy(&x, p, sizeof x);
    return x;
  }
  if (format == WLK_FORMAT_R16_FLOAT) {
    uint16_t x = 0;
    std::memcpy(&x, p, sizeof x);
    return floatFromHalf(x);
  }
  return static_cast<float>(*p) / 255.0f;
}

float readVoxel(const unsigned char* p, uint32_t format) {
  return clean(rawVoxel(p, format));
}

void addVoxel(VoxelSums& sums, float value, const Edges& voxel) {
  if (value > 0.0f) {
    sums.largest = std::max(sums.largest, value);
    include(sums.filled, voxel);
    const double wide{value};
    sums.sum += wide;
    sums.squares += wide * wide;
  }
}

void checkUpload(const VolumeState& volume, const WlkVolumeUpload& u) {
  checkRange(u.sType, "field", u.field, 0, volume.fieldCount - 1);
  checkFormat(u.sType, u.format);
  for (uint32_t i = 0; i < 3; ++i) {
    if (u.extent[i] < 1 || u.offset[i] > volume.size[i] ||
        u.extent[i] > volume.size[i] - u.offset[i]) {
      fail(WLK_ERROR_INVALID_ARGUMENT, u.sType, "extent",
           "WlkVolumeUpload: voxels [%u, %u + %u) of axis %u lie outside the volume's %u",
           u.offset[i], u.offset[i], u.extent[i], i, volume.size[i]);
    }
  }
  checkPointer(u.data, "data");
  const uint64_t row = bytesPerVoxel(u.format) * u.extent[0];
  const uint64_t rowPitch = u.rowPitch == 0 ? row : u.rowPitch;
  if (rowPitch < row) {
    fail(WLK_ERROR_INVALID_ARGUMENT, u.sType, "rowPitch",
         "WlkVolumeUpload::rowPitch is %llu, a row has %llu bytes",
         static_cast<unsigned long long>(rowPitch), static_cast<unsigned long long>(row));
  }
  const uint64_t plane = checkedSum(rowPitch, u.extent[1] - 1, row);
  const uint64_t slicePitch =
      u.slicePitch == 0 ? checkedSum(rowPitch, u.extent[1], 0) : u.slicePitch;
  if (slicePitch < plane) {
    fail(WLK_ERROR_INVALID_ARGUMENT, u.sType, "slicePitch",
         "WlkVolumeUpload::slicePitch is %llu, a slice has %llu bytes",
         static_cast<unsigned long long>(slicePitch), static_cast<unsigned long long>(plane));
  }
  const uint64_t needed = checkedSum(slicePitch, u.extent[2] - 1, plane);
  if (u.dataSize < needed) {
    fail(WLK_ERROR_INVALID_ARGUMENT, u.sType, "dataSize",
         "WlkVolumeUpload::dataSize is %llu, the voxels need %llu",
         static_cast<unsigned long long>(u.dataSize), static_cast<unsigned long long>(needed));
  }
}

uint16_t halfFromFloat(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const int exponent = static_cast<int>(bits >> 23) - 127;
  if (exponent < -25) {
    return 0;
  }
  const uint32_t mantissa = (bits & 0x7fffffu) | 0x800000u;
  // Normal: keep 11 bits; subnormal: fewer. Round to nearest, ties to even.
  const int shift = exponent >= -14 ? 13 : 13 + (-14 - exponent);
  const uint32_t kept = mantissa >> shift;
  const uint32_t rest = mantissa & ((1u << shift) - 1);
  const uint32_t middle = 1u << (shift - 1);
  const uint32_t rounded = kept + (rest > middle || (rest == middle && (kept & 1u) != 0) ? 1 : 0);
  const uint32_t base = exponent >= -14 ? static_cast<uint32_t>(exponent + 14) << 10 : 0;
  return static_cast<uint16_t>(base + rounded);
}

float floatFromHalf(uint16_t bits) {
  const uint32_t exponent = bits >> 10 & 0x1fu;
  const uint32_t mantissa = bits & 0x3ffu;
  float value = 0;
  if (exponent == 31) {
    value = mantissa == 0 ? INFINITY : NAN;
  } else if (exponent == 0) {
    value = std::ldexp(static_cast<float>(mantissa), -24);
  } else {
    value = std::ldexp(static_cast<float>(mantissa | 0x400u), static_cast<int>(exponent) - 25);
  }
  return (bits & 0x8000u) != 0 ? -value : value;
}

// Forgets the bricks that the upload covers with all of their voxels.
static void clearFaces(const WlkVolumeUpload& u, const Edges& size, const BrickGrid& grid,
                       BrickFaces& faces) {
  Edges first{};
  Edges end{};
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t last = u.offset[i] + u.extent[i];
    first[i] = (u.offset[i] + BRICK_EDGE - 1) / BRICK_EDGE;
    end[i] = last == size[i] ? grid.count[i] : last / BRICK_EDGE;
  }
  for (uint32_t z = first[2]; z < end[2]; ++z) {
    for (uint32_t y = first[1]; y < end[1]; ++y) {
      for (uint32_t x = first[0]; x < end[0]; ++x) {
        faces[grid.at({x, y, z})] = 0;
      }
    }
  }
}

VoxelSums convertVoxels(const WlkVolumeUpload& u, bool toFloat, void* out, const Edges& size,
                        BrickFaces& faces) {
  const BrickGrid grid = brickGrid(size);
  clearFaces(u, size, grid, faces);
  const uint64_t voxel = bytesPerVoxel(u.format);
  const uint64_t rowPitch = u.rowPitch == 0 ? voxel * u.extent[0] : u.rowPitch;
  const uint64_t slicePitch = u.slicePitch == 0 ? rowPitch * u.extent[1] : u.slicePitch;
  VoxelSums sums;
  auto* to = static_cast<unsigned char*>(out);
  for (uint32_t z = 0; z < u.extent[2]; ++z) {
    for (uint32_t y = 0; y < u.extent[1]; ++y) {
      const auto* from = static_cast<const unsigned char*>(u.data) + z * slicePitch + y * rowPitch;
      for (uint32_t x = 0; x < u.extent[0]; ++x, from += voxel) {
        const float raw = rawVoxel(from, u.format);
        const float value = clean(raw);
        sums.replaced += value != raw ? 1U : 0U;
        if (value > 0.0f) {
          const Edges at{u.offset[0] + x, u.offset[1] + y, u.offset[2] + z};
          addVoxel(sums, value, at);
          faces[grid.at({at[0] / BRICK_EDGE, at[1] / BRICK_EDGE, at[2] / BRICK_EDGE})] |=
              facesOf(at);
        }
        if (toFloat) {
          std::memcpy(to, &value, sizeof value);
          to += sizeof value;
        } else {
          const uint16_t half = halfFromFloat(value);
          std::memcpy(to, &half, sizeof half);
          to += sizeof half;
        }
      }
    }
  }
  return sums;
}

}  // namespace welkin
