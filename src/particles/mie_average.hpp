// SPDX-License-Identifier: MIT
// Mie scattering averaged over droplet sizes and a band of wavelengths: phase function in 1/sr,
// cross-sections in um^2. No Vulkan.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "particles/size_distribution.hpp"

namespace welkin {

struct SpectralSample {
  double wavelength_um = 0.55;          // in the medium around the particles (air)
  std::complex<double> index = {1, 0};  // relative to that medium, n + i k
  double weight = 1;                    // share of the light's energy
};

// `count` equal bands of [begin, end] by their middles, equal weights, water at temperature_C.
std::vector<SpectralSample> waterSamples(double begin_um, double end_um, int count,
                                         double temperature_C);

// One wavelength in water.
std::vector<SpectralSample> waterSample(double wavelength_um, double temperature_C);

// The red, green and blue of the project: single wavelengths.
constexpr double RGB_WAVELENGTH_UM[3] = {0.68, 0.55, 0.44};

struct MieSettings {
  // Nodes per standard deviation of ln r, all wavelengths together: Mie resonances are spikes in
  // size, so the error falls like 1 / nodes. 4096: one wavelength, spread 0.25, against twice as
  // many nodes: < 0.4 % at 180 degrees, < 0.2 % elsewhere, 0.1 % rms.
  double nodesPerSpread = 4096;
  // Convolve the phase function and the asymmetry with the sun's disk (solar_disk.hpp).
  bool solarDisk = false;
  // Larger spheres scatter like the one of this size parameter, times their area: geometric optics.
  double largestSizeParameter = 1e9;
  // The result does not depend on the number of threads.
  unsigned threads = 1;
};

struct MieAverage {
  std::vector<double> phase;   // at each angle, 1/sr, integral over the sphere 1
  double scattering_um2 = 0;   // mean cross-section of one particle
  double extinction_um2 = 0;   // the same
  double efficiency = 0;       // scattering / mean geometric cross-section
  double asymmetry = 0;        // mean cosine
  double forwardFraction = 0;  // energy below 90 degrees, without the disk; to 1e-4
};

// Averages for every distribution at once, from the same spheres: 16 overlapping distributions
// cost little more than the widest alone. Angles in rad, any order. Cross-sections weigh sizes and
// wavelengths: phase = sum of weight dC/dOmega / sum of weight C.
std::vector<MieAverage> averageMie(std::span<const SizeDistribution> sizes,
                                   std::span<const SpectralSample> spectrum,
                                   std::span<const double> angles, const MieSettings& settings);

MieAverage averageMie(const SizeDistribution& sizes, std::span<const SpectralSample> spectrum,
                      std::span<const double> angles, const MieSettings& settings);

}  // namespace welkin
