// SPDX-License-Identifier: MIT
// The files of volume_truth.hpp.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <stdexcept>

#include "bench/volume_truth.hpp"

namespace bench {
namespace {

constexpr double RADIANS = std::numbers::pi / 180;
constexpr const char* IMAGE_HEADER = "x,y,radiance,error";
constexpr const char* PHASE_HEADER = "angle_deg,phase";
constexpr const char* SLAB_HEADER =
    "phase,tau,sunZenith_deg,side,viewZenith_deg,azimuth_deg,radiance,single,monteCarlo,error";

void expectLine(std::ifstream& stream, const std::string& file, const std::string& expected) {
  std::string line;
  if (!std::getline(stream, line) || line != expected) {
    throw std::runtime_error(file + ": expected the line '" + expected + "'");
  }
}

void expectRow(bool read, const std::string& file, const std::string& line) {
  if (!read) {
    throw std::runtime_error(file + ": unexpected row '" + line + "'");
  }
}

}  // namespace

void writeTruthImage(const std::string& file, const TruthImage& image, int digits) {
  std::ofstream stream(file);
  stream << "# paths " << image.paths << '\n' << IMAGE_HEADER << '\n';
  for (size_t i = 0; i < image.radiance.size(); ++i) {
    const auto width = static_cast<size_t>(image.width);
    stream << i % width << ',' << i / width << ',' << std::setprecision(digits) << image.radiance[i]
           << ',' << std::setprecision(std::max(digits - 2, 2)) << image.error[i] << '\n';
  }
  stream.flush();
  if (!stream) {
    throw std::runtime_error(file + ": cannot write");
  }
}

TruthImage readTruthImage(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  TruthImage image;
  unsigned long long paths = 0;
  if (!std::getline(stream, line) || std::sscanf(line.c_str(), "# paths %llu", &paths) != 1) {
    throw std::runtime_error(file + ": expected the line '# paths N'");
  }
  image.paths = paths;
  expectLine(stream, file, IMAGE_HEADER);
  while (std::getline(stream, line)) {
    int x = 0;
    int y = 0;
    double radiance = 0;
    double error = 0;
    expectRow(std::sscanf(line.c_str(), "%d,%d,%lf,%lf", &x, &y, &radiance, &error) == 4, file,
              line);
    image.width = y == 0 ? x + 1 : image.width;
    image.height = y + 1;
    image.radiance.push_back(radiance);
    image.error.push_back(error);
    const auto expected =
        static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x) + 1;
    expectRow(image.radiance.size() == expected && x < image.width, file, line);
  }
  if (image.radiance.empty() || image.radiance.size() != static_cast<size_t>(image.width) *
                                                             static_cast<size_t>(image.height)) {
    throw std::runtime_error(file + ": pixels are missing");
  }
  return image;
}

PhaseCurve readPhaseCurve(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  PhaseCurve curve;
  expectLine(stream, file, PHASE_HEADER);
  while (std::getline(stream, line)) {
    double angle = 0;
    double value = 0;
    expectRow(std::sscanf(line.c_str(), "%lf,%lf", &angle, &value) == 2, file, line);
    curve.angle.push_back(angle * RADIANS);
    curve.value.push_back(value);
  }
  if (curve.angle.empty()) {
    throw std::runtime_error(file + ": no angles");
  }
  curve.angle.back() = std::numbers::pi;
  return curve;
}

std::vector<SlabTruth> readSlabTruth(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::vector<SlabTruth> rows;
  expectLine(stream, file, SLAB_HEADER);
  while (std::getline(stream, line)) {
    SlabTruth row;
    char phase[32] = {};
    char side[16] = {};
    const int read =
        std::sscanf(line.c_str(), "%31[^,],%lf,%lf,%15[^,],%lf,%lf,%lf,%lf,%lf,%lf", phase,
                    &row.tau, &row.sunZenith_deg, side, &row.viewZenith_deg, &row.azimuth_deg,
                    &row.radiance, &row.single, &row.monteCarlo, &row.error);
    row.droplets = phase == std::string("droplets");
    row.reflected = side == std::string("reflected");
    expectRow(read == 10 && (row.droplets || phase == std::string("hg")) &&
                  (row.reflected || side == std::string("transmitted")),
              file, line);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace bench
