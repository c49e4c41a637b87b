// SPDX-License-Identifier: MIT
// How far one picture is from another.
#pragma once

#include <cstdint>

#include "common/image.hpp"

namespace host {

/// All over the R, G, B samples where both pictures are finite; `reference` is the second picture.
/// Relative errors divide by max(|reference|, floor) with floor = 1 % of the mean |reference|, so
/// that black pixels don't decide the result and a common scale factor cancels.
struct ImageMetrics {
  /// mean((a - b)^2 / max(|b|, floor)^2).
  double relMse = 0.0;
  /// sqrt(mean((a - b)^2)) / mean |b|.
  double rmseOverMean = 0.0;
  /// Value that 99.9 % of the relative errors don't exceed (nearest rank).
  double p999RelativeError = 0.0;
  double maxRelativeError = 0.0;
  /// mean(a - b) / mean |b|; positive if the first picture is brighter.
  double bias = 0.0;
  /// mean |b|.
  double referenceMean = 0.0;
  /// Samples that are not finite, in either picture.
  uint64_t nonFinite = 0;
  /// Samples that took part.
  uint64_t samples = 0;
};

/// The pictures must have one size. Sums are compensated: error below 1e-15 of the sum of
/// magnitudes (HostMetrics tests).
ImageMetrics compareImages(const Image& picture, const Image& reference);

}  // namespace host
