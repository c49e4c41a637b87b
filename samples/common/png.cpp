// SPDX-License-Identifier: MIT
// From scene-linear radiance to an 8-bit sRGB picture.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/error.hpp"
#include "common/image.hpp"
#include "common/parallel.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace host {
namespace {

// sRGB transfer function, IEC 61966-2-1.
double encodeSrgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// Filmic curve: K. Narkowicz, "ACES filmic tone mapping curve", 2015; 1.03 at infinity, so clamped.
double filmic(double x) {
  return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
}

}  // namespace

double displayValue(double linear, double exposureStops, ToneMap toneMap) {
  // 1e6 is far above white in either curve and keeps their squares finite.
  const double exposed = std::min(linear * std::exp2(exposureStops), 1e6);
  if (!(exposed > 0.0)) {
    return 0.0;
  }
  const double mapped = toneMap == ToneMap::Filmic ? filmic(exposed) : std::min(exposed, 1.0);
  return std::clamp(encodeSrgb(mapped), 0.0, 1.0);
}

void writePng(const std::filesystem::path& file, const Image& image, double exposureStops,
              ToneMap toneMap) {
  std::vector<uint8_t> bytes(image.pixelCount() * 3);
  parallelFor(image.height, [&](uint32_t y) {
    for (size_t pixel = size_t{y} * image.width; pixel < (size_t{y} + 1) * image.width; ++pixel) {
      for (size_t c = 0; c < 3; ++c) {
        const double value =
            displayValue(double{image.rgba[pixel * 4 + c]}, exposureStops, toneMap);
        bytes[pixel * 3 + c] = static_cast<uint8_t>(std::lround(value * 255.0));
      }
    }
  });
  const int width = static_cast<int>(image.width);
  if (stbi_write_png(file.string().c_str(), width, static_cast<int>(image.height), 3, bytes.data(),
                     width * 3) == 0) {
    throw HostError(file.string() + ": cannot write");
  }
}

}  // namespace host
