// SPDX-License-Identifier: MIT
#include "bench/color_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

using rt::Rgb;

// Colours are compared at this share of the white's luminance, L* = 76.
constexpr double EQUAL_LUMINANCE = 0.5;

rt::Lab labOf(const Rgb& rgb) {
  rt::Xyz xyz = rt::xyzOfLinearSrgb(rgb);
  const double scale = EQUAL_LUMINANCE / xyz[1];
  for (double& value : xyz) {
    value *= scale;
  }
  return rt::labOf(xyz, rt::xyzOfLinearSrgb({1, 1, 1}));
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0
                        : values[static_cast<size_t>(
                              std::lround(share * static_cast<double>(values.size() - 1)))];
}

}  // namespace

double luminanceOf(const Rgb& rgb) {
  return rt::xyzOfLinearSrgb(rgb)[1];
}

void addError(const Rgb& color, const Rgb& truth, ColorErrors& errors) {
  const double luminance = luminanceOf(truth);
  errors.luminance.push_back(std::abs(luminanceOf(color) - luminance) / luminance);
  const auto uv = rt::uniformChromaticityOf(rt::xyzOfLinearSrgb(color));
  const auto other = rt::uniformChromaticityOf(rt::xyzOfLinearSrgb(truth));
  errors.chromaticity.push_back(std::hypot(uv[0] - other[0], uv[1] - other[1]));
  errors.difference.push_back(rt::colorDifference(labOf(color), labOf(truth)));
}

nlohmann::ordered_json jsonOf(const std::vector<double>& values) {
  return {{"median", quantile(values, 0.5)},
          {"p90", quantile(values, 0.9)},
          {"max", quantile(values, 1)}};
}

nlohmann::ordered_json jsonOf(const ColorErrors& errors) {
  return {{"values", errors.luminance.size()},
          {"luminance", jsonOf(errors.luminance)},
          {"chromaticity", jsonOf(errors.chromaticity)},
          {"ciede2000", jsonOf(errors.difference)}};
}

void printErrors(const ColorErrors& errors) {
  const auto print = [](const std::vector<double>& v, double scale, int digits) {
    std::printf(" %.*f / %.*f / %.*f |", digits, scale * quantile(v, 0.5), digits,
                scale * quantile(v, 0.9), digits, scale * quantile(v, 1));
  };
  print(errors.luminance, 100, 1);
  print(errors.chromaticity, 1, 4);
  print(errors.difference, 1, 1);
}

}  // namespace bench
