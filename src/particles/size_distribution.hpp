// SPDX-License-Identifier: MIT
// Distributions of particle radius in um, normalised to one particle, and nodes for averages.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace welkin {

enum class SizeKind { Monodisperse, LogNormal, Gamma };

// Monodisperse: radius. LogNormal: median radius and the standard deviation of ln r ([J23], whose
// "mean diameter" is the median, spread 0.25; [R04]). Gamma: [B08] Eq. 3, characteristic radius
// r_n and shape gamma >= 1: n(r) = (r / r_n)^(gamma - 1) exp(-r / r_n) / (Gamma(gamma) r_n).
struct SizeDistribution {
  SizeKind kind = SizeKind::LogNormal;
  double radius_um = 10;  // > 0
  double spread = 0.25;   // LogNormal: (0, 1]; Gamma: gamma, [1, 100]
};

// Particles per um of radius.
double sizeDensity(const SizeDistribution& sizes, double radius_um);

// Mean of r^power in um^power, closed form.
double meanPower(const SizeDistribution& sizes, double power);

// <r^3> / <r^2> in um; Gamma: (gamma + 2) r_n.
double effectiveRadius(const SizeDistribution& sizes);

// Radii outside of which r^2 n(r) (below) and r^4 n(r) (above: the forward peak) hold less than
// 1e-5 of their integrals.
struct SizeRange {
  double low_um;
  double high_um;
};
SizeRange sizeRange(const SizeDistribution& sizes);

// Nodes of the trapezoidal rule in ln r over all ranges: the mean of f(r) over distribution d is
// the sum over i of weight[i * distributions + d] f(radius_um[i]); for a smooth f it converges
// faster than any power. Every monodisperse distribution adds one node of weight 1, before the
// others. ln r of the other nodes is (integer + offset) logStep.
struct SizeNodes {
  std::vector<double> radius_um;
  std::vector<double> weight;
};
SizeNodes sizeNodes(std::span<const SizeDistribution> sizes, double logStep, double offset);

// Standard deviation of ln r weighted by r^2 (Gamma: to leading order); 0 for Monodisperse.
double logSpread(const SizeDistribution& sizes);

}  // namespace welkin
