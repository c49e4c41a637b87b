// SPDX-License-Identifier: MIT
// Radiance that leaves a homogeneous plane-parallel slab in a parallel beam, by Monte Carlo: a
// check for deterministic solvers. 1/sr, per unit irradiance on a surface facing the beam.
#pragma once

#include <cstdint>

#include "reference/monte_carlo.hpp"

namespace welkin::reference {

struct SlabEstimate {
  double value;
  double standardError;
};

// `tau`: vertical optical depth. The beam comes down on the top at a zenith angle with cosine
// mu0 > 0. mu: cosine between the direction in which the light leaves and the upward vertical, > 0
// at the top (reflected), < 0 at the bottom (transmitted, without the beam itself). phi: azimuth
// (rad) of that direction against the beam's direction of travel: mu = -mu0, phi = 0 goes straight
// on.
SlabEstimate slabRadianceMonteCarlo(double tau, double albedo, const PhaseFunction& phase,
                                    double mu0, double mu, double phi, uint64_t samples,
                                    uint64_t seed, uint32_t firstOrder = 1,
                                    uint32_t lastOrder = ALL_ORDERS);

// Part of the beam's power that is reflected (mu > 0) or transmitted, `mu` being +1 or -1. The
// beam itself is not counted.
SlabEstimate slabFluxMonteCarlo(double tau, double albedo, const PhaseFunction& phase, double mu0,
                                double mu, uint64_t samples, uint64_t seed);

}  // namespace welkin::reference
