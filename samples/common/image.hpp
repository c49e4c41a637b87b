// SPDX-License-Identifier: MIT
// Pictures in memory, and their files: OpenEXR both ways, PNG out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace host {

/// Longest edge of a picture that is read; the API's largest view has the same size.
constexpr uint32_t MAX_IMAGE_EDGE = 16384;

/// Linear RGBA floats, top row first.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> rgba;

  [[nodiscard]] size_t pixelCount() const { return size_t{width} * height; }
};

/// One float per pixel, top row first.
struct DepthImage {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> values;
};

/// Reads channels R, G, B and, if there, A (else 1) of a single-part scan-line file, uncompressed,
/// RLE, ZIPS or ZIP. Throws InputError: no such file, not OpenEXR, of another kind, cut off, too
/// large, other channels.
Image readExr(const std::filesystem::path& file);

/// Reads the channel Z, or R where there is no Z, of such a file.
DepthImage readExrDepth(const std::filesystem::path& file);

/// Writes float channels R, G, B, A, lossless; `transmittance`, if given, adds the layer
/// `transmittance.R, .G, .B`. Throws HostError.
void writeExr(const std::filesystem::path& file, const Image& image,
              const Image* transmittance = nullptr);

enum class ToneMap { Linear, Filmic };

/// Writes 8-bit sRGB: value * 2^exposureStops, tone mapped. Throws HostError.
void writePng(const std::filesystem::path& file, const Image& image, double exposureStops,
              ToneMap toneMap);

/// One channel of writePng: scene-linear in, display value in [0, 1] out; NaN gives 0.
double displayValue(double linear, double exposureStops, ToneMap toneMap);

}  // namespace host
