// SPDX-License-Identifier: MIT
// welkin_surface_view_truth FOLDER PATHS NAME...: makes the files that surface_views.hpp reads, of
// the views whose names begin so. tests/bench/reference/surfaces is, on two cores (12 minutes),
//   welkin_surface_view_truth tests/bench/reference/surfaces 2000 stratocumulus cumulus
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <thread>

#include "bench/surface_views.hpp"

namespace {

void make(const std::string& folder, const bench::SurfaceView& view, uint64_t paths) {
  constexpr uint64_t SEED = 1;
  const std::clock_t begin = std::clock();
  const bench::SurfaceTruthImage image = bench::traceView(
      view, bench::bodyMesh(view.body), paths, SEED, std::thread::hardware_concurrency());
  bench::writeSurfaceTruth(folder + "/" + view.name + ".csv", image);
  double sum = 0;
  double squares = 0;
  for (const bench::SurfacePixel& p : image.pixels) {
    sum += p.once + p.rest;
    squares += p.onceError * p.onceError + p.restError * p.restError;
  }
  const auto n = static_cast<double>(image.pixels.size());
  std::printf("%-22s %zu pixels, mean %.4f, rms of the errors %.1f %% of it, %.0f CPU s\n",
              view.name.c_str(), image.pixels.size(), sum / n,
              100 * std::sqrt(squares / n) / (sum / n),
              static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: welkin_surface_view_truth FOLDER PATHS NAME...\n");
    return 2;
  }
  try {
    for (const bench::SurfaceView& view : bench::surfaceViews()) {
      bool chosen = false;
      for (int i = 3; i < argc; ++i) {
        chosen |= view.name.rfind(argv[i], 0) == 0;
      }
      if (chosen) {
        make(argv[1], view, std::strtoull(argv[2], nullptr, 10));
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
