// SPDX-License-Identifier: MIT
// welkin_surface_truth PATHS NAME...: Monte Carlo pictures of homogeneous bodies of the canonical
// cloud, or with --hg of Henyey-Greenstein 0.85, on standard output. Rows of the upper half, as
// bodies and light are symmetric. tests/unit/surface_truth.csv is
//   welkin_surface_truth 4000 sphere-2 sphere-10 sphere-30 ellipsoid-10 box-10 pair-10
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>

#include "reference/body.hpp"
#include "tables/canonical_phase.hpp"

namespace {

using namespace welkin;

constexpr int PIXELS = 20;
constexpr int ANGLES[] = {180, 120, 90, 60, 20};

reference::PhaseFunction canonical() {
  const CanonicalPhase cloud = canonicalPhase();
  std::vector<double> angle;
  std::vector<reference::Rgb> value;
  for (size_t i = 0; i < cloud.y.size(); ++i) {
    angle.push_back(2 * std::asin(std::sqrt(cloud.y[i] / 2)));
    value.push_back({cloud.value[i], cloud.value[i], cloud.value[i]});
  }
  return reference::PhaseFunction::table(angle, value);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: welkin_surface_truth PATHS [--hg] NAME...\n");
    return 2;
  }
  const bool hg = std::strcmp(argv[2], "--hg") == 0;
  const auto phase = hg ? reference::PhaseFunction::henyeyGreenstein(0.85) : canonical();
  const uint64_t paths = std::strtoull(argv[1], nullptr, 10);
  std::printf("body,angle,x,y,radiance,error\n");
  uint64_t seed = 1;
  for (int i = hg ? 3 : 2; i < argc; ++i) {
    const reference::Body body = reference::makeBody(argv[i]);
    for (const int angle : ANGLES) {
      for (int pixel = 0; pixel < PIXELS * PIXELS / 2; ++pixel) {
        const int x = pixel % PIXELS;
        const int y = PIXELS / 2 + pixel / PIXELS;
        const reference::BodyEstimate e =
            reference::traceBody(body, phase, angle * std::numbers::pi / 180, 2.0 * x / PIXELS - 1,
                                 2.0 * y / PIXELS - 1, 2.0 / PIXELS, paths, seed++);
        if (e.radiance > 0) {
          std::printf("%s,%d,%d,%d,%.4g,%.1g\n", argv[i], angle, x, y, e.radiance,
                      std::sqrt(e.variance / static_cast<double>(paths)));
        }
      }
      std::fflush(stdout);
    }
  }
  return 0;
}
