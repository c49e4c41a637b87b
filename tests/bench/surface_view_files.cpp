// SPDX-License-Identifier: MIT
// The files of surface_views.hpp.
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <stdexcept>

#include "bench/surface_views.hpp"

namespace bench {
namespace {

constexpr const char* HEADER = "x,y,once,onceError,rest,restError,opacity,facing";
constexpr int DIGITS = 4;        // rounding 5e-4, noise 1e-2 and more
constexpr int ERROR_DIGITS = 2;  // also of opacity and facing, which choose regions

}  // namespace

void writeSurfaceTruth(const std::string& file, const SurfaceTruthImage& image) {
  std::ofstream stream(file);
  stream << "# paths " << image.paths << " volume_m3 " << std::setprecision(9) << image.volume_m3
         << " triangles " << image.triangles << '\n'
         << HEADER << '\n';
  for (const SurfacePixel& p : image.pixels) {
    stream << p.x << ',' << p.y << std::setprecision(DIGITS) << ',' << p.once << ','
           << std::setprecision(ERROR_DIGITS) << p.onceError << ',' << std::setprecision(DIGITS)
           << p.rest << ',' << std::setprecision(ERROR_DIGITS) << p.restError << ',' << p.opacity
           << ',' << p.facing << '\n';
  }
  stream.flush();
  if (!stream) {
    throw std::runtime_error(file + ": cannot write");
  }
}

SurfaceTruthImage readSurfaceTruth(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  SurfaceTruthImage image;
  unsigned long long paths = 0;
  unsigned long long triangles = 0;
  if (!std::getline(stream, line) ||
      std::sscanf(line.c_str(), "# paths %llu volume_m3 %lf triangles %llu", &paths,
                  &image.volume_m3, &triangles) != 3) {
    throw std::runtime_error(file + ": expected the line '# paths N volume_m3 V triangles T'");
  }
  image.paths = paths;
  image.triangles = triangles;
  if (!std::getline(stream, line) || line != HEADER) {
    throw std::runtime_error(file + ": expected the line '" + HEADER + "'");
  }
  while (std::getline(stream, line)) {
    SurfacePixel p;
    if (std::sscanf(line.c_str(), "%d,%d,%lf,%lf,%lf,%lf,%lf,%lf", &p.x, &p.y, &p.once,
                    &p.onceError, &p.rest, &p.restError, &p.opacity, &p.facing) != 8) {
      throw std::runtime_error(file + ": unexpected row '" + line + "'");
    }
    image.pixels.push_back(p);
  }
  if (image.pixels.empty()) {
    throw std::runtime_error(file + ": no pixels");
  }
  return image;
}

}  // namespace bench
