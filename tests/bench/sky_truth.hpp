// SPDX-License-Identifier: MIT
// The true radiance of pixels of welkin_sky_cost, and relative errors of pictures against it.
// Radiance per unit irradiance of the light, 1/sr.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/sky_cost_scene.hpp"

namespace bench {

struct SkyTruth {
  SkyRgb radiance{};
  SkyRgb error{};  // standard error of the radiance
  SkyRgb transmittance{};
};

// Light scattered once by quadrature, the rest by Monte Carlo with `paths` paths per pixel and
// channel.
std::vector<SkyTruth> skyTruth(const SkyCase& one, const std::vector<SkyPixel>& pixels,
                               uint64_t paths, uint64_t seed);

// Truth in CSV, so that it need not be made anew: appends a case; reads one, whose pixels must be
// these. Both throw std::runtime_error.
void appendTruth(const std::string& file, const SkyCase& one, const std::vector<SkyPixel>& pixels,
                 const std::vector<SkyTruth>& truths);
std::vector<SkyTruth> readTruth(const std::string& file, const SkyCase& one,
                                const std::vector<SkyPixel>& pixels);

// Median of the standard errors over the radiances.
double noiseOf(const std::vector<SkyTruth>& truths);

// Relative errors, one value per pixel and colour.
struct SkyErrors {
  std::vector<double> sky;
  std::vector<double> aerial;         // air before surfaces nearer than `far`
  std::vector<double> aerialFar;      // and before the others
  std::vector<double> transmittance;  // to all surfaces

  void add(const SkyErrors& other);
};

// From RGBA pictures over black and over white surfaces.
SkyErrors errorsOf(const std::vector<float>& black, const std::vector<float>& white, uint32_t width,
                   double far, const std::vector<SkyPixel>& pixels,
                   const std::vector<SkyTruth>& truths);

// 0 of none.
double quantile(std::vector<double> values, double share);

}  // namespace bench
