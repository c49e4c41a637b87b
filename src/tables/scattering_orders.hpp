// SPDX-License-Identifier: MIT
// Angular distributions, in 1/sr, of light scattered many times by a tabulated phase function (a
// curve of angular_moments.hpp: y = 1 - cos, p normalised to 1 over the sphere). No Vulkan.
// Closed forms for Henyey-Greenstein and Draine, and the physics, are in multiscatter.hpp.
// [R04] 4.2 Eq. 20-25; its integer count of scatterings, and the Poisson counts that replace it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tables/multiscatter.hpp"

namespace welkin {

// [R04] as printed: Ams_n (Eq. 20) after exactly n >= 1 scatterings, at each y of `at`. n = 1 is
// the curve itself; others never negative, and divided by what that has added to their integral.
void scatteredInteger(std::span<const double> y, std::span<const double> p, int n,
                      std::span<const double> at, std::span<double> result);

// F_n (Eq. 23): the part of it in the forward hemisphere.
double forwardFractionInteger(std::span<const double> y, std::span<const double> p, int n);

// Scattered light, at least once, at optical depth tau of a medium that does not absorb: moments
// (e^(-tau (1 - chi_l)) - e^-tau) / (1 - e^-tau), tau in [0, 1e6]. tau = 0 is the curve itself.
void scatteredPoisson(std::span<const double> y, std::span<const double> p, double tau,
                      std::span<const double> at, std::span<double> result);
double forwardFractionPoisson(std::span<const double> y, std::span<const double> p, double tau);

// How many scatterings light that has come to depth n has had: a Poisson count of mean n, or
// ceil(n) ([R04] as printed, for comparison).
enum class SourceForm { Poisson, Integer };

constexpr size_t SOURCE_CHANNELS = 3;

// Light that has come to depth n = albedo * optical depth and was scattered once more, for n =
// depthNode(row / 31). Row 0 is the phase function.
struct SourceRows {
  size_t angles = 0;
  // ln of 1/sr at [(channel * kPhaseDepths + row) * angles + node of y]; at least ln 1e-20.
  std::vector<float> logSource;
  // Part of the source in the forward hemisphere.
  std::array<std::array<float, kPhaseDepths>, SOURCE_CHANNELS> forwardFraction{};
};

// All rows of three curves over the same nodes. Series to 4e-9 / sr; then each row, with lines
// between its nodes, has integral 1 as the curve has (SourceRows.HaveTheEnergy...: 1e-6). 1024
// nodes: 25 ms for droplets of 20 um, 60 ms for 50 um, one core.
SourceRows sourceRows(std::span<const double> y,
                      const std::array<std::span<const double>, SOURCE_CHANNELS>& p,
                      SourceForm form);

// The same for a phase function in closed form, without a series' end; Poisson counts, and one
// curve for all channels.
SourceRows closedSourceRows(std::span<const double> y, const FogPhaseParams& phase);

}  // namespace welkin
