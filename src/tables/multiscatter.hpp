// SPDX-License-Identifier: MIT
// Forward multiple scattering: angular distribution of light that has come to a scattering depth
// n = albedo * optical depth, and was scattered once more; and the part of it that goes forward.
// [R04] 4.2 Eq. 20-25, corrected: scattering counts are Poisson, not the integer ceil(n).
#pragma once

#include <array>
#include <span>

#include "particles/medium.hpp"

namespace welkin {

constexpr int kPhaseAngles = 128;
constexpr int kPhaseDepths = 32;

// Nodes at texel centres: node i of N stands at coordinate i / (N - 1), see phaseCoordinate and
// depthCoordinate in shaders/model/volume/forward_scattering.glsl.
struct ForwardScatteringTable {
  // ln(source distribution / phase function); row = depth node, column = angle node. Row 0 is 0.
  std::array<float, static_cast<size_t>(kPhaseAngles) * kPhaseDepths> logRatio;
  // F(n): part of the source distribution in the forward hemisphere.
  std::array<float, kPhaseDepths> forwardFraction;
};

// Inverses of the table coordinates: 1 - cos(angle), and scattering depth.
double phaseNode(double s);
double depthNode(double s);

// chi_l = 2 pi * integral of P(mu) P_l(mu), l = 0 .. chi.size() - 1, closed form.
void legendreMoments(const FogPhaseParams& phase, std::span<double> chi);

// The table of one medium, 2 to 5 ms. Never negative, and without truncation error for any g: 2e-13
// relative to direct Legendre sums for 5..50 um (the test holds 1e-9).
void buildForwardScattering(const FogPhaseParams& phase, ForwardScatteringTable& table);

// One entry: source distribution in 1/sr at y = 1 - cos, and F(n).
double sourceDistribution(const FogPhaseParams& phase, double n, double y);
double forwardFraction(const FogPhaseParams& phase, double n);

// [R04] as printed, for comparison: F_n (Eq. 23) and Ams_n (Eq. 20) of exactly n scatterings, by
// Legendre sums over the moments given. Truncated: chi must have decayed at its end.
double forwardFractionInteger(std::span<const double> chi, int n);
double scatteredInteger(std::span<const double> chi, int n, double mu);

}  // namespace welkin
