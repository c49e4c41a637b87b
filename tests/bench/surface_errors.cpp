// SPDX-License-Identifier: MIT
// welkin_surface_errors TRUTH.csv [--hg]: what the rule of surface clouds makes of bodies, as CSV
// on standard output. docs/results/surface-bodies.csv is
//   welkin_surface_errors tests/unit/surface_truth.csv
// With --hg the truth scatters as Henyey-Greenstein 0.85, light scattered once does so too, and
// other light as the canonical cloud of equal (1 - g) depth.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "tables/canonical_phase.hpp"
#include "unit/surface_picture.hpp"

namespace {

using namespace welkin;

constexpr double G = 0.85;

double canonical(double y) {
  static const CanonicalPhase cloud = canonicalPhase();
  const auto next = std::upper_bound(cloud.y.begin() + 1, cloud.y.end() - 1, y);
  const auto k = static_cast<size_t>(next - cloud.y.begin());
  const double part = (y - cloud.y[k - 1]) / (cloud.y[k] - cloud.y[k - 1]);
  return cloud.value[k - 1] + part * (cloud.value[k] - cloud.value[k - 1]);
}

double henyeyGreenstein(double y) {
  const double q = (1 - G) * (1 - G) + 2 * G * y;
  return (1 - G * G) / (4 * std::numbers::pi * q * std::sqrt(q));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: welkin_surface_errors TRUTH.csv [--hg]\n");
    return 2;
  }
  const bool hg = argc > 2 && std::strcmp(argv[2], "--hg") == 0;
  const double asymmetry = decodeCanonical(shippedCanonical()).asymmetry;
  const test::SurfaceCloud cloud = {hg ? henyeyGreenstein : canonical,
                                    hg ? (1 - G) / (1 - asymmetry) : 1};
  std::printf("body,angle,total,rms\n");
  for (const test::SurfaceError& e : test::surfaceErrors(test::readSurfaceTruth(argv[1]), cloud)) {
    std::printf("%s,%d,%.3f,%.3f\n", e.body.c_str(), e.angle, e.total, e.rms);
  }
  return 0;
}
