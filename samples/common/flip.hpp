// SPDX-License-Identifier: MIT
// FLIP: how large a difference a viewer sees who alternates between two pictures, 0 to 1 per pixel.
// P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020 (LDR) and
// "Visualizing Errors in Rendered High Dynamic Range Images", 2021 (HDR).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/image.hpp"

namespace host {

/// Exposures of HDR-FLIP in stops, evenly spaced from `start` to `stop`, both included, in
/// [-300, 300].
struct FlipExposures {
  double start = 0.0;
  double stop = 0.0;
  uint32_t count = 1;
};

/// Largest FlipExposures::count.
constexpr uint32_t MAX_FLIP_EXPOSURES = 64;

/// A display 0.7 m wide of 3840 pixels at 0.7 m: 3840 pi / 180.
constexpr double DEFAULT_PIXELS_PER_DEGREE = 67.020643276582255;

struct FlipOptions {
  /// Of visual angle, in [1, 1000].
  double pixelsPerDegree = DEFAULT_PIXELS_PER_DEGREE;
  /// If empty, defaultFlipExposures of the reference.
  std::optional<FlipExposures> exposures;
};

struct FlipResult {
  FlipExposures exposures;
  double mean = 0.0;
  /// The value that 95 % of the pixels don't exceed (nearest rank).
  double p95 = 0.0;
  /// Pixels that are not finite in one of the pictures: 1 in the map, black for their neighbours.
  uint64_t nonFinite = 0;
  /// One value per pixel, top row first.
  std::vector<float> map;
};

/// From the exposure that brings the bright end of the reference's luminance to 0.85 on the
/// display to the one that brings its median there, one per stop and at least 2. Differs from
/// the paper in three ways: the bright end is the 99.9th percentile and not the maximum, which
/// leaves the sun's disk out; black pixels don't count, or a dark surround would ask for infinite
/// exposure; and the range is at most 20 stops, more than a viewer adapts to in one picture.
FlipExposures defaultFlipExposures(const Image& reference);

/// LDR-FLIP of two pictures of one size in linear sRGB, finite and in [0, 1]; symmetric, exactly 0
/// where the pictures agree all around. Within 5e-4 of the papers' formulas in double (HostFlip).
std::vector<float> ldrFlip(const Image& picture, const Image& reference, double pixelsPerDegree);

/// HDR-FLIP of two pictures of one size in linear sRGB, any unit: per pixel the largest LDR-FLIP
/// over the exposures, tone mapped by Narkowicz's ACES curve. Negative values count as 0.
FlipResult hdrFlip(const Image& picture, const Image& reference, const FlipOptions& options = {});

/// Writes a map as PNG in the colours of matplotlib's magma: 0 black, 1 pale yellow. Throws
/// HostError.
void writeFlipMap(const std::filesystem::path& file, const FlipResult& flip, uint32_t width);

}  // namespace host
