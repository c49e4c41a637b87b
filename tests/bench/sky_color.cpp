// SPDX-License-Identifier: MIT
// welkin_sky_color OUT.json: colour of skylight from three wavelengths beside that of its spectrum
// in bins of 10 nm. Fits the matrix that takes radiance at 680, 550 and 440 nm, each per unit
// irradiance of the Sun at that wavelength, to linear sRGB, and measures its error on other skies.
// Prints tables in Markdown.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/color_errors.hpp"
#include "bench/sky_spectra.hpp"

namespace {

using namespace bench;
using Json = nlohmann::ordered_json;
using rt::Rgb;
using rt::SPECTRUM;
using Matrix = std::array<Rgb, 3>;

constexpr double INF = std::numeric_limits<double>::infinity();

Rgb sunColor() {
  rt::Spectrum whole;
  whole.fill(1);
  return rt::linearSrgbOf(rt::sunlightOf(whole));
}

// Three values of a sample: the library's, or those of three bins.
struct Triple {
  enum class From { Stated, Banded, Bins } from = From::Banded;
  std::array<size_t, 3> bins{};

  Rgb of(const Sample& sample) const {
    if (from != From::Bins) {
      return from == From::Stated ? sample.stated : sample.banded;
    }
    return {sample.share[bins[0]], sample.share[bins[1]], sample.share[bins[2]]};
  }
};
constexpr Triple STATED{Triple::From::Stated, {}};
constexpr Triple BANDED{Triple::From::Banded, {}};

Rgb times(const Matrix& m, const Rgb& v) {
  return {rt::dot(m[0], v), rt::dot(m[1], v), rt::dot(m[2], v)};
}

// Channels as they come, but for the Sun's own colour.
Matrix plainMatrix() {
  const Rgb sun = sunColor();
  return {Rgb{sun[0], 0, 0}, Rgb{0, sun[1], 0}, Rgb{0, 0, sun[2]}};
}

// Least squares of linear sRGB over luminance, under the condition that light of the Sun's own
// spectrum keeps its colour; `residual` is the root of the mean square.
Matrix fitMatrix(const std::vector<Sample>& samples, const Triple& triple, double* residual) {
  const Rgb sun = sunColor();
  Matrix result{};
  double squares = 0;
  for (size_t row = 0; row < 3; ++row) {
    double aa = 0;
    double ab = 0;
    double bb = 0;
    double ay = 0;
    double by = 0;
    double yy = 0;
    for (const Sample& sample : samples) {
      const Rgb v = triple.of(sample);
      const double weight = 1 / luminanceOf(sample.truth);
      const double a = weight * (v[0] - v[1]);
      const double b = weight * (v[2] - v[1]);
      const double y = weight * (sample.truth[row] - sun[row] * v[1]);
      aa += a * a;
      ab += a * b;
      bb += b * b;
      ay += a * y;
      by += b * y;
      yy += y * y;
    }
    const double determinant = aa * bb - ab * ab;
    const double first = (ay * bb - by * ab) / determinant;
    const double last = (by * aa - ay * ab) / determinant;
    result[row] = {first, sun[row] - first - last, last};
    squares += yy - first * ay - last * by;
  }
  *residual = std::sqrt(std::max(squares, 0.0) / static_cast<double>(samples.size()));
  return result;
}

bool isScattered(const Sample& sample) {
  const Kind kind = groups()[sample.group].kind;
  return kind == Kind::Sky || kind == Kind::Aerial;
}

// ColorErrors of a method by the groups of rays; the last is all scattered light.
std::vector<ColorErrors> errorsOf(const std::vector<Sample>& samples, const Matrix& matrix,
                                  const Triple& triple) {
  std::vector<ColorErrors> result(groups().size() + 1);
  for (const Sample& sample : samples) {
    const Rgb color = times(matrix, triple.of(sample));
    addError(color, sample.truth, result[sample.group]);
    if (isScattered(sample)) {
      addError(color, sample.truth, result.back());
    }
  }
  return result;
}

const char* groupName(size_t group) {
  return group < groups().size() ? groups()[group].name : "all scattered light";
}

Json compare(const std::vector<Sample>& samples, const Matrix& matrix) {
  struct Method {
    const char* name;
    const char* key;
    Matrix matrix;
    Triple triple;
    std::vector<ColorErrors> errors;
  };
  Method methods[] = {{"plain", "plain", plainMatrix(), STATED, {}},
                      {"plain, ozone of the bands", "plainBanded", plainMatrix(), BANDED, {}},
                      {"matrix", "matrix", matrix, STATED, {}},
                      {"matrix, ozone of the bands", "matrixBanded", matrix, BANDED, {}}};
  for (Method& method : methods) {
    method.errors = errorsOf(samples, method.matrix, method.triple);
  }
  Json rows = Json::array();
  for (size_t g = 0; g <= groups().size(); ++g) {
    Json row{{"rays", groupName(g)}};
    for (const Method& method : methods) {
      row[method.key] = jsonOf(method.errors[g]);
      std::printf("| %s | %s |", groupName(g), method.name);
      printErrors(method.errors[g]);
      std::printf("\n");
    }
    rows.push_back(row);
  }
  return rows;
}

Rgb clamped(Rgb color) {
  for (double& value : color) {
    value = std::max(value, 0.0);
  }
  return color;
}

bool isNegative(const Rgb& color) {
  return *std::min_element(color.begin(), color.end()) < 0;
}

// How often the matrix gives negative components, which are colours beyond sRGB, and what setting
// them to 0 costs: to luminance, to the colour, and beside the true colour treated in the same way.
Json negatives(const std::vector<Sample>& samples, const Matrix& matrix) {
  std::array<size_t, 3> counts{};  // of scattered light, of all light, of the truth
  double least = 0;
  std::vector<double> luminance;
  ColorErrors before;
  ColorErrors after;
  ColorErrors both;
  for (const Sample& sample : samples) {
    counts[2] += isNegative(sample.truth) ? 1u : 0u;
    const Rgb color = times(matrix, sample.banded);
    if (!isNegative(color)) {
      continue;
    }
    counts[0] += isScattered(sample) ? 1u : 0u;
    ++counts[1];
    least = std::min(least, *std::min_element(color.begin(), color.end()) / luminanceOf(color));
    luminance.push_back(luminanceOf(clamped(color)) / luminanceOf(color) - 1);
    addError(color, sample.truth, before);
    addError(clamped(color), sample.truth, after);
    addError(clamped(color), clamped(sample.truth), both);
  }
  std::printf(
      "\nNegative: %zu of %zu colours (%zu of scattered light), %zu of the true ones; least "
      "component %.3f of the luminance.\n| | luminance, %% | u'v' | CIEDE2000 |\n"
      "|---|---|---|---|\n",
      counts[1], samples.size(), counts[0], counts[2], least);
  struct Row {
    const char* name;
    const char* key;
    const ColorErrors& errors;
  };
  const Row rows[] = {{"as they are", "unclamped", before},
                      {"clamped", "clamped", after},
                      {"clamped, beside the truth clamped", "bothClamped", both}};
  Json result{{"colors", samples.size()},       {"negative", counts[1]},
              {"negativeScattered", counts[0]}, {"negativeTruth", counts[2]},
              {"leastOfLuminance", least},      {"luminanceByClamping", jsonOf(luminance)}};
  for (const Row& row : rows) {
    std::printf("| %s |", row.name);
    printErrors(row.errors);
    std::printf("\n");
    result[row.key] = jsonOf(row.errors);
  }
  return result;
}

Json jsonOf(const Matrix& m) {
  Json rows = Json::array();
  for (const Rgb& row : m) {
    rows.push_back(row);
  }
  return rows;
}

// Other wavelengths, each with a matrix of its own fitted to the same samples.
Json otherWavelengths(const std::vector<Sample>& fitting, const std::vector<Sample>& validation) {
  const auto binAt = [](double nm) {
    return static_cast<size_t>((nm - SPECTRUM[0].wavelength_nm) / rt::SPECTRUM_STEP_nm + 0.5);
  };
  std::vector<Triple> triples{
      BANDED, STATED, {Triple::From::Bins, {binAt(615), binAt(535), binAt(445)}}};
  Triple best = triples.back();
  double least = INF;
  for (size_t r = binAt(555); r <= binAt(705); ++r) {
    for (size_t g = binAt(475); g < r; ++g) {
      for (size_t b = binAt(395); b < g; ++b) {
        const Triple one{Triple::From::Bins, {r, g, b}};
        double residual = 0;
        fitMatrix(fitting, one, &residual);
        if (residual < least) {
          least = residual;
          best = one;
        }
      }
    }
  }
  if (best.bins != triples.back().bins) {
    triples.push_back(best);
  }
  Json rows = Json::array();
  std::printf(
      "\n| wavelengths, nm | method | luminance, %% | u'v' | CIEDE2000 |\n"
      "|---|---|---|---|---|\n");
  for (const Triple& triple : triples) {
    Rgb nm = WELKIN_nm;
    for (size_t c = 0; c < 3 && triple.from == Triple::From::Bins; ++c) {
      nm[c] = SPECTRUM[triple.bins[c]].wavelength_nm;
    }
    double residual = 0;
    const Matrix matrix = fitMatrix(fitting, triple, &residual);
    const ColorErrors plain = errorsOf(validation, plainMatrix(), triple).back();
    const ColorErrors fitted = errorsOf(validation, matrix, triple).back();
    rows.push_back({{"wavelengths_nm", nm},
                    {"ozoneOfBands", triple.from == Triple::From::Banded},
                    {"best", triple.from == Triple::From::Bins && triple.bins == best.bins},
                    {"matrix", jsonOf(matrix)},
                    {"plain", jsonOf(plain)},
                    {"fitted", jsonOf(fitted)}});
    std::printf("| %.0f, %.0f, %.0f%s | plain |", nm[0], nm[1], nm[2],
                triple.from == Triple::From::Banded ? ", ozone of the bands"
                : triple.from == Triple::From::Bins && triple.bins == best.bins ? ", best of all"
                                                                                : "");
    printErrors(plain);
    std::printf("\n| | matrix |");
    printErrors(fitted);
    std::printf("\n");
  }
  return rows;
}

Json conditions() {
  Json airs = Json::array();
  for (const Atmosphere& a : atmospheres()) {
    airs.push_back({{"name", a.name},
                    {"ozone_DU", a.ozone_DU},
                    {"hazeExtinction", a.hazeExtinction},
                    {"hazeScaleHeight", a.hazeHeight},
                    {"groundAlbedo", a.groundAlbedo},
                    {"fitted", a.fitted}});
  }
  Rgb rayleigh{};
  for (size_t c = 0; c < 3; ++c) {
    rayleigh[c] = referenceScattering(WELKIN_nm[c]);
  }
  return {{"atmospheres", airs},
          {"hazeAsymmetry", HAZE_G},
          {"hazeAlbedo", HAZE_ALBEDO},
          {"ozone", WELKIN_OZONE},
          {"ozoneOfBands", BAND_OZONE},
          {"scattering", WELKIN_AIR},
          {"scatteringOfReference", rayleigh}};
}

int run(const std::string& path, uint64_t seed) {
  std::vector<Sample> fitting;
  std::vector<Sample> validation;
  for (const Atmosphere& atmosphere : atmospheres()) {
    addSamples(atmosphere, seed + static_cast<uint64_t>(&atmosphere - atmospheres().data()),
               atmosphere.fitted ? fitting : validation);
  }
  double residual = 0;
  const Matrix matrix = fitMatrix(fitting, BANDED, &residual);
  std::printf("Sun, linear sRGB: %.5f %.5f %.5f\n", sunColor()[0], sunColor()[1], sunColor()[2]);
  for (const Rgb& row : matrix) {
    std::printf("%9.5f %9.5f %9.5f\n", row[0], row[1], row[2]);
  }
  std::printf("\n| rays | method | luminance, %% | u'v' | CIEDE2000 |\n|---|---|---|---|---|\n");
  Json result{{"schema", 1},
              {"seed", seed},
              {"conditions", conditions()},
              {"wavelengths_nm", WELKIN_nm},
              {"sun", sunColor()},
              {"matrix", jsonOf(matrix)}};
  result["rows"] = compare(validation, matrix);
  Json by = Json::object();
  for (const Atmosphere& atmosphere : atmospheres()) {
    std::vector<Sample> own;
    for (const Sample& sample : atmosphere.fitted ? fitting : validation) {
      if (sample.atmosphere == &atmosphere) {
        own.push_back(sample);
      }
    }
    const ColorErrors errors = errorsOf(own, matrix, BANDED).back();
    by.push_back(
        {std::string(atmosphere.name) + (atmosphere.fitted ? " (fitted)" : ""), jsonOf(errors)});
    std::printf("| %s%s | matrix |", atmosphere.name, atmosphere.fitted ? ", fitted" : "");
    printErrors(errors);
    std::printf("\n");
  }
  result["matrixByAtmosphere"] = by;
  result["negative"] = negatives(validation, matrix);
  result["otherWavelengths"] = otherWavelengths(fitting, validation);
  std::ofstream file(path);
  file << result.dump(1) << "\n";
  file.flush();
  if (!file) {
    std::fprintf(stderr, "%s: cannot write\n", path.c_str());
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Colour of skylight from three wavelengths"};
  std::string path;
  uint64_t seed = 1;
  app.add_option("out", path, "JSON file to write")->required();
  app.add_option("--seed", seed, "of the rays, default 1");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(path, seed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
