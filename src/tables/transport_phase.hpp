// SPDX-License-Identifier: MIT
// Phase functions, in 1/sr, as the transport of light in thick volumes sees them: the forward peak
// goes straight on, light scattered once is exact, twice has the product of two phase functions,
// more often four Legendre moments. No Vulkan.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "particles/phase_curve.hpp"
#include "tables/scattering_orders.hpp"

namespace welkin {

constexpr int TRANSPORT_MOMENTS = 4;  // Legendre orders of the source
constexpr int TRANSPORT_FIRST = 3;    // of the light scattered once
constexpr size_t PAIR_NODES = 128;    // polar angles i / 127 pi
constexpr size_t PAIR_FUNCTIONS = 6;  // (0,0) (1,0) (1,1) (2,0) (2,1) (2,2)

// P = peak + rest: within 20 degrees the peak is what lies above P(20 degrees). P' = rest divided
// by its integral, isotropic where that is below 1e-9. A P that does not rise towards 0 has no
// peak; Rayleigh's is 0.0013.
struct TransportPhase {
  double peak = 0;                                        // its integral f, mean over the channels
  std::array<double, TRANSPORT_MOMENTS> moments{};        // chi'_l of the mean over channels of P'
  double fourth = 0;                                      // chi'_4
  std::vector<double> y;                                  // nodes of the curve
  std::array<std::vector<double>, SOURCE_CHANNELS> rest;  // P' of a channel in 1/sr at y
};

// P' is linear between the curve's nodes: a cell with a kink of min(P, P(20 degrees)) inside holds
// a chord. f and moments to 1e-5 (TransportPhase.HasThePeakAndTheMomentsOfItsDefinition); 0.1 ms.
TransportPhase transportPhase(const PhaseCurve& curve);

// P' of `phase`, that curve's, and all the turns that the peak adds in an endless white medium
// until the rest turns light next, k with probability (1 - f) f^k. Moments, p_l being those of the
// peak, p_0 = f: chi'_l (1 - f) / (1 - p_l). 2048 nodes: 0.3 to 40 ms (ice).
TransportPhase turnedPhase(const PhaseCurve& curve, const TransportPhase& phase);

// Light that is scattered once by P and was turned by the peak on its way to and from there, x =
// albedo * optical depth of the whole way, attenuated by tau' = (1 - f albedo) tau elsewhere: the
// rest has moments (chi_l - p_l) e^(-x (f - p_l)), p_l those of the peak, p_0 = f. Light that only
// the peak has turned, k + 1 times, is met at each of its turns: moments p_l^(k + 1) e^(-x f) x^k /
// (k + 1)!. In the layout of sourceRows; row 0 is P. Integral 1 - f + (1 - e^(-x f)) / x. Each
// channel has its own f. No forward fractions. 2048 nodes: 10 to 500 ms, as sourceRows.
SourceRows peakRows(const PhaseCurve& curve);

// Real spherical harmonics Y_lm about s, the direction in which the light travels: m > 0
// with cos(m azimuth), mean of Y^2 over the sphere 1, no Condon-Shortley sign: Y_11 = sqrt(3) x.
struct TransportPairs {
  using Products = std::array<std::array<std::array<float, TRANSPORT_FIRST>, TRANSPORT_FIRST>,
                              TRANSPORT_MOMENTS>;
  // Integral over directions w of 4 pi P'(w v) P'(w s) Y_lm(w), RGB and a 0, for v at azimuth 0:
  // [function][node][4]; then as many with P' scattered twice instead of P'(w s).
  std::vector<float> response;
  // 4 pi P' around each node, mean over the distance of two, in the same layout.
  std::vector<float> once;
  // Integral of P'(w s) Y_lm(w) Y_l'm(w), mean over the channels: [l][l'][m], m <= min(l, l'); and
  // with P' scattered twice.
  Products first{};
  Products second{};
};

// Of the mixture sum w_i P'_i: one or more media over the same nodes, weights of sum 1. Response to
// 1e-3 of each function's largest value, measured 5e-4 (TransportPairs.AreTheDoubleIntegral...); a
// backward peak narrower than 0.2 degrees is smoothed to that. First moments to 1e-5. 14 ms at
// most.
TransportPairs transportPairs(std::span<const TransportPhase* const> media,
                              std::span<const double> weights);

}  // namespace welkin
