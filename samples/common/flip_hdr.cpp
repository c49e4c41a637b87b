// SPDX-License-Identifier: MIT
// HDR-FLIP: the largest LDR-FLIP over a range of exposures, and the map's picture; 0 to 1, no unit.
#include <algorithm>
#include <array>
#include <cmath>

#include "common/flip.hpp"
#include "common/metrics.hpp"
#include "common/parallel.hpp"

namespace host {
namespace {

// K. Narkowicz, "ACES filmic tone mapping curve", 2015, without its pre-exposure: the argument is
// 0.6 times the radiance, as in the HDR paper. Numerator and denominator are quadratic.
constexpr std::array<double, 3> TONE_ABOVE = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0};
constexpr std::array<double, 3> TONE_BELOW = {0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

double toneMapped(double x) {
  const double above = (TONE_ABOVE[0] * x + TONE_ABOVE[1]) * x + TONE_ABOVE[2];
  const double below = (TONE_BELOW[0] * x + TONE_BELOW[1]) * x + TONE_BELOW[2];
  return std::clamp(above / below, 0.0, 1.0);
}

// The argument for which the curve is `value`: the positive root of a quadratic.
double inverseToneMapped(double value) {
  const double a = TONE_ABOVE[0] - value * TONE_BELOW[0];
  const double b = TONE_ABOVE[1] - value * TONE_BELOW[1];
  const double c = TONE_ABOVE[2] - value * TONE_BELOW[2];
  return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

bool isFinite(const float* rgb) {
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

// The picture as the display shows it; pixels marked in `skipped` are black.
Image displayed(const Image& image, double stops, const std::vector<bool>& skipped) {
  Image shown{image.width, image.height, std::vector<float>(image.rgba.size(), 0.0f)};
  const double exposure = std::exp2(stops);
  parallelFor(image.height, [&](uint32_t row) {
    for (size_t i = size_t{row} * image.width; i < (size_t{row} + 1) * image.width; ++i) {
      for (size_t c = 0; c < 3 && !skipped[i]; ++c) {
        const double x = std::max(exposure * double{image.rgba[4 * i + c]}, 0.0);
        shown.rgba[4 * i + c] = static_cast<float>(toneMapped(x));
      }
    }
  });
  return shown;
}

}  // namespace

FlipExposures defaultFlipExposures(const Image& reference) {
  std::vector<double> luminances;
  for (size_t i = 0; i < reference.pixelCount(); ++i) {
    const float* rgb = reference.rgba.data() + 4 * i;
    // Rec. 709.
    const double luminance =
        0.2126 * double{rgb[0]} + 0.7152 * double{rgb[1]} + 0.0722 * double{rgb[2]};
    if (isFinite(rgb) && luminance > 0.0) {
      luminances.push_back(luminance);
    }
  }
  if (luminances.empty()) {
    return {};
  }
  constexpr double TARGET = 0.85;
  constexpr double BRIGHT_END = 0.999;
  constexpr double LARGEST_RANGE = 20.0;
  const double argument = inverseToneMapped(TARGET);
  FlipExposures exposures;
  exposures.start = std::log2(argument / nearestRank(luminances, BRIGHT_END));
  exposures.stop =
      std::min(std::log2(argument / nearestRank(luminances, 0.5)), exposures.start + LARGEST_RANGE);
  exposures.count = static_cast<uint32_t>(std::ceil(exposures.stop - exposures.start));
  exposures.count = std::max(exposures.count, 2u);
  return exposures;
}

FlipResult hdrFlip(const Image& picture, const Image& reference, const FlipOptions& options) {
  FlipResult result;
  result.exposures = options.exposures ? *options.exposures : defaultFlipExposures(reference);
  const size_t count = reference.pixelCount();
  result.map.assign(count, 0.0f);
  std::vector<bool> skipped(count);
  for (size_t i = 0; i < count; ++i) {
    skipped[i] = !isFinite(picture.rgba.data() + 4 * i) || !isFinite(reference.rgba.data() + 4 * i);
    result.nonFinite += skipped[i] ? 1u : 0u;
  }
  const FlipExposures& exposures = result.exposures;
  const double steps = std::max(exposures.count, 2u) - 1.0;
  for (uint32_t k = 0; k < exposures.count; ++k) {
    const double stops = exposures.start + (exposures.stop - exposures.start) * k / steps;
    const std::vector<float> map =
        ldrFlip(displayed(picture, stops, skipped), displayed(reference, stops, skipped),
                options.pixelsPerDegree);
    for (size_t i = 0; i < count; ++i) {
      result.map[i] = std::max(result.map[i], skipped[i] ? 1.0f : map[i]);
    }
  }
  std::vector<double> values(result.map.begin(), result.map.end());
  for (const double value : values) {
    result.mean += value / static_cast<double>(count);
  }
  result.p95 = nearestRank(values, 0.95);
  return result;
}

void writeFlipMap(const std::filesystem::path& file, const FlipResult& flip, uint32_t width) {
  // Magma of S. van der Walt and N. Smith (CC0) at every 32nd of its 256 entries; linear in
  // between it is off by up to 10 of 255.
  constexpr std::array<std::array<double, 3>, 9> MAGMA = {{{0, 0, 4},
                                                           {29, 17, 71},
                                                           {81, 18, 124},
                                                           {131, 38, 129},
                                                           {183, 55, 121},
                                                           {229, 80, 100},
                                                           {251, 135, 97},
                                                           {254, 194, 135},
                                                           {252, 253, 191}}};
  const auto linear = [](double encoded) {  // the inverse of what writePng does
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  };
  Image image{width, static_cast<uint32_t>(flip.map.size() / std::max(width, 1u)), {}};
  for (const float value : flip.map) {
    const double position = std::clamp(double{value}, 0.0, 1.0) * (MAGMA.size() - 1.0);
    const auto entry = std::min(static_cast<size_t>(position), MAGMA.size() - 2);
    const double t = position - static_cast<double>(entry);
    for (size_t c = 0; c < 3; ++c) {
      const double mixed = (1.0 - t) * MAGMA[entry][c] + t * MAGMA[entry + 1][c];
      image.rgba.push_back(static_cast<float>(linear(mixed / 255.0)));
    }
    image.rgba.push_back(1.0f);
  }
  writePng(file, image, 0.0, ToneMap::Linear);
}

}  // namespace host
