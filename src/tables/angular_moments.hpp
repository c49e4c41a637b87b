// SPDX-License-Identifier: MIT
// Legendre moments of a tabulated phase function, dimensionless, and sums of Legendre series in the
// unit of their terms. No Vulkan.
// A curve is nodes y = 1 - cos(scattering angle), strictly ascending from 0 to 2, and values p in
// 1/sr, linear in y in between; about 1024 nodes at phaseNode (multiscatter.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace welkin {

// chi_l = 2 pi * integral of P(mu) P_l(mu), l = 0 .. chi.size() - 1. Exact for the piecewise linear
// curve but for rounding: 2e-13 of chi_0 up to l = 2048 (AngularMoments.AreExactFor...).
void legendreMoments(std::span<const double> y, std::span<const double> p, std::span<double> chi);

// More than droplets of 50 um need, 2560 at 440 nm; Henyey-Greenstein's of g = 0.998 end at 7424.
constexpr size_t MAX_MOMENTS = 8192;

// As many moments as light scattered twice or more needs: until 128 in a row have sum (2 l + 1)
// chi_l^2 < 1e-7, at most `maxTerms`. Moments that have not ended by then are smoothed: convolved
// with a Gaussian of 5.3 / maxTerms rad, which is positive, so that their series does not ring.
std::vector<double> scatteringMoments(std::span<const double> y, std::span<const double> p,
                                      size_t maxTerms = MAX_MOMENTS);

// Integral over the sphere, and over the forward hemisphere; exact for the curve.
double sphereIntegral(std::span<const double> y, std::span<const double> p);
double hemisphereIntegral(std::span<const double> y, std::span<const double> p);

// The level that cuts `share` of the sphere's integral off the curve's top; 0 if there is less.
double cutLevel(std::span<const double> y, std::span<const double> p, double share);

// The curve at any y in [0, 2].
double curveValue(std::span<const double> y, std::span<const double> p, double at);

// sums[s * y.size() + j] = sum over l of series[s][l] P_l(1 - y_j), each series to its own end.
// P_l at any angle to 1e-11 up to l = 2048, 7e-11 at 8191 (measured at 1024 nodes).
void legendreSums(std::span<const double> y, std::span<const std::vector<double>> series,
                  std::span<double> sums);

}  // namespace welkin
