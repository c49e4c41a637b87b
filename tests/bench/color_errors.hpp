// SPDX-License-Identifier: MIT
// How far colours in linear sRGB are from true ones, and how that is written.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "reference/spectrum.hpp"

namespace bench {

namespace rt = welkin::reference;

struct ColorErrors {
  std::vector<double> luminance;     // relative
  std::vector<double> chromaticity;  // distance in u'v'
  std::vector<double> difference;    // CIEDE2000 at equal luminance
};

double luminanceOf(const rt::Rgb& rgb);
void addError(const rt::Rgb& color, const rt::Rgb& truth, ColorErrors& errors);

// Median, 90th percentile and largest.
nlohmann::ordered_json jsonOf(const std::vector<double>& values);
nlohmann::ordered_json jsonOf(const ColorErrors& errors);
// Three cells of a table in Markdown.
void printErrors(const ColorErrors& errors);

}  // namespace bench
