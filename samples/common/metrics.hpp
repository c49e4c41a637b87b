// SPDX-License-Identifier: MIT
// How far one picture is from another, relative to the other's radiance (no unit).
#pragma once

#include <cstdint>
#include <vector>

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
  /// Values that 50, 90, 95 and 99.9 % of the relative errors don't exceed (nearest rank).
  double medianRelativeError = 0.0;
  double p90RelativeError = 0.0;
  double p95RelativeError = 0.0;
  double p999RelativeError = 0.0;
  double maxRelativeError = 0.0;
  /// mean(a - b) / mean |b|; positive if the first picture is brighter.
  double bias = 0.0;
  /// mean |b|.
  double referenceMean = 0.0;
  /// Samples that are not finite, in either picture.
  uint64_t nonFinite = 0;
  /// Samples below 0 in the first picture; they take part.
  uint64_t negative = 0;
  /// Samples that took part.
  uint64_t samples = 0;

  /// Without the noise of the reference, 0 unless its variance was given. As the noise does not
  /// depend on the picture, mean((a - b)^2) is on average mean((a - truth)^2) + mean(variance); the
  /// difference is therefore unbiased, except that it is cut at 0, and for relMse that the divisor
  /// is the noisy |b|.
  double relMseDenoised = 0.0;
  double rmseOverMeanDenoised = 0.0;
  /// Relative standard error of the reference, root mean square: sqrt(mean(variance / max(|b|,
  /// floor)^2)). Its square is the relMse of a perfect picture.
  double standardError = 0.0;
};

/// The pictures must have one size. `variance`, if given, is the variance of the mean of each of
/// the reference's samples: finite and at least 0. Sums are compensated: error below 1e-15 of the
/// sum of magnitudes (HostMetrics tests).
ImageMetrics compareImages(const Image& picture, const Image& reference,
                           const Image* variance = nullptr);

/// The smallest value that `fraction` of the values don't exceed (nearest rank); 0 if there are
/// none. Reorders them.
double nearestRank(std::vector<double>& values, double fraction);

}  // namespace host
