// SPDX-License-Identifier: MIT
#include "codec.hpp"

#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <stdexcept>

namespace engine {
namespace {

constexpr double MAX_24 = 16777215.0;

template <typename T>
void put(unsigned char* to, T value) {
  std::memcpy(to, &value, sizeof value);
}

template <typename T>
T get(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

void encodeTexel(VkFormat format, const float* v, unsigned char* to) {
  switch (format) {
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      for (int i = 0; i < 4; ++i) {
        put(to + 2 * i, glm::packHalf1x16(v[i]));
      }
      return;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      std::memcpy(to, v, 16);
      return;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
      put(to, glm::packF2x11_1x10(glm::vec3(v[0], v[1], v[2])));
      return;
    case VK_FORMAT_R16_SFLOAT:
      put(to, glm::packHalf1x16(v[0]));
      return;
    case VK_FORMAT_R8_UNORM:
      put(to, static_cast<uint8_t>(std::lround(v[0] * 255.0f)));
      return;
    case VK_FORMAT_R16_UNORM:
    case VK_FORMAT_D16_UNORM:
      put(to, static_cast<uint16_t>(std::lround(v[0] * 65535.0f)));
      return;
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
      put(to, static_cast<uint32_t>(std::lround(static_cast<double>(v[0]) * MAX_24)));
      return;
    default:
      put(to, v[0]);
  }
}

void decodeTexel(VkFormat format, const unsigned char* from, float* v) {
  switch (format) {
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      for (int i = 0; i < 4; ++i) {
        v[i] = glm::unpackHalf1x16(get<uint16_t>(from + 2 * i));
      }
      return;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      std::memcpy(v, from, 16);
      return;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32: {
      const glm::vec3 rgb = glm::unpackF2x11_1x10(get<uint32_t>(from));
      v[0] = rgb.x;
      v[1] = rgb.y;
      v[2] = rgb.z;
      v[3] = 1.0f;
      return;
    }
    case VK_FORMAT_R16_SFLOAT:
      v[0] = glm::unpackHalf1x16(get<uint16_t>(from));
      return;
    case VK_FORMAT_R8_UNORM:
      v[0] = static_cast<float>(get<uint8_t>(from)) / 255.0f;
      return;
    case VK_FORMAT_R16_UNORM:
    case VK_FORMAT_D16_UNORM:
      v[0] = static_cast<float>(get<uint16_t>(from)) / 65535.0f;
      return;
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
      v[0] = static_cast<float>((get<uint32_t>(from) & 0xffffffu) / MAX_24);
      return;
    default:
      v[0] = get<float>(from);
  }
}

}  // namespace

uint32_t texelBytes(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return 16;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 8;
    case VK_FORMAT_R16_SFLOAT:
    case VK_FORMAT_R16_UNORM:
    case VK_FORMAT_D16_UNORM:
      return 2;
    case VK_FORMAT_R8_UNORM:
      return 1;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:  // its depth aspect
    case VK_FORMAT_R32_SFLOAT:
      return 4;
    default:
      throw std::invalid_argument("a format these tests do not use");
  }
}

uint32_t channels(VkFormat format) {
  return format == VK_FORMAT_R16G16B16A16_SFLOAT || format == VK_FORMAT_R32G32B32A32_SFLOAT ||
                 format == VK_FORMAT_B10G11R11_UFLOAT_PACK32
             ? 4
             : 1;
}

std::vector<unsigned char> encode(VkFormat format, std::span<const float> values) {
  const size_t texels = values.size() / channels(format);
  std::vector<unsigned char> bytes(texels * texelBytes(format));
  for (size_t i = 0; i < texels; ++i) {
    encodeTexel(format, &values[i * channels(format)], &bytes[i * texelBytes(format)]);
  }
  return bytes;
}

std::vector<float> decode(VkFormat format, std::span<const unsigned char> bytes) {
  const size_t texels = bytes.size() / texelBytes(format);
  std::vector<float> values(texels * channels(format));
  for (size_t i = 0; i < texels; ++i) {
    decodeTexel(format, &bytes[i * texelBytes(format)], &values[i * channels(format)]);
  }
  return values;
}

}  // namespace engine
