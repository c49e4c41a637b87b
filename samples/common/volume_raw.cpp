// SPDX-License-Identifier: MIT
// Headerless volumes, and the checks that all volume sources share.
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "common/error.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

static_assert(std::endian::native == std::endian::little, "raw volumes are little-endian");

// IEEE 754 binary16; exact.
float floatFromHalf(uint16_t half) {
  const int exponent = (half >> 10) & 31;
  const auto mantissa = static_cast<float>(half & 1023);
  float magnitude = 0.0f;
  if (exponent == 0) {
    magnitude = std::ldexp(mantissa, -24);
  } else if (exponent == 31) {
    magnitude = mantissa == 0.0f ? INFINITY : NAN;
  } else {
    magnitude = std::ldexp(mantissa + 1024.0f, exponent - 25);
  }
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

uint64_t bytesPerVoxel(RawFormat format) {
  switch (format) {
    case RawFormat::R16Float:
      return 2;
    case RawFormat::R8Unorm:
      return 1;
    case RawFormat::R32Float:
      break;
  }
  return 4;
}

float decode(const char* bytes, RawFormat format) {
  if (format == RawFormat::R8Unorm) {
    return static_cast<float>(static_cast<unsigned char>(*bytes)) / 255.0f;
  }
  if (format == RawFormat::R16Float) {
    uint16_t half = 0;
    std::memcpy(&half, bytes, sizeof half);
    return floatFromHalf(half);
  }
  float value = 0.0f;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

uint64_t checkedVoxelCount(const std::string& file, const std::array<uint64_t, 3>& size) {
  uint64_t count = 1;
  for (const uint64_t edge : size) {
    // Dividing instead of multiplying: no overflow for any edge.
    if (edge == 0 || edge > MAX_VOXELS / count) {
      throw InputError(file, "size",
                       "expected 1 to " + std::to_string(MAX_VOXELS) + " voxels, got " +
                           std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                           std::to_string(size[2]));
    }
    count *= edge;
  }
  return count;
}

Vec3 worldAxes(Vec3 data, UpAxis up) {
  return up == UpAxis::Y ? data : Vec3{data.x, data.z, -data.y};
}

Grid loadRaw(const std::filesystem::path& file, const RawInfo& info) {
  const std::string name = file.string();
  const uint64_t count = checkedVoxelCount(name, {info.size[0], info.size[1], info.size[2]});
  const uint64_t width = bytesPerVoxel(info.format);
  std::error_code error;
  const uint64_t length = std::filesystem::file_size(file, error);
  if (error) {
    throw InputError(name, "", "no such file; expected a raw volume");
  }
  if (length != count * width) {
    throw InputError(name, "",
                     "expected " + std::to_string(count * width) + " bytes for this size and " +
                         "format, got " + std::to_string(length));
  }
  std::vector<char> bytes(length);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(length))) {
    throw InputError(name, "", "cannot read");
  }
  Grid grid;
  grid.size = info.size;
  grid.values.resize(count);
  for (uint64_t i = 0; i < count; ++i) {
    grid.values[i] = decode(bytes.data() + i * width, info.format);
    if (!std::isfinite(grid.values[i])) {
      throw InputError(name, "voxel " + std::to_string(i), "expected a finite value");
    }
  }
  const Vec3 edge =
      info.voxelSize * Vec3{static_cast<double>(info.size[0]), static_cast<double>(info.size[1]),
                            static_cast<double>(info.size[2])};
  grid.worldFromVolume = affineFromEdges({}, worldAxes({edge.x, 0.0, 0.0}, info.up),
                                         worldAxes({0.0, edge.y, 0.0}, info.up),
                                         worldAxes({0.0, 0.0, edge.z}, info.up));
  return grid;
}

}  // namespace host
