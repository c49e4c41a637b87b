// SPDX-License-Identifier: MIT
// welkin_surface_view_errors ROUNDS [NAME...]: errors of pictures of cloud surfaces, region by
// region, and CPU times of their frames, beside those of volumes of the same bodies, as CSV on
// standard output: docs/results/surface-images.csv. Times are medians of all threads' in ms, of 256
// x 192 pixels or so: of a frame in which nothing changed, and of one in which the light moved.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "bench/front_timing.hpp"
#include "bench/surface_view_scene.hpp"

namespace {

using namespace bench;

constexpr uint32_t VOXELS = 128;
constexpr uint32_t ERROR_RAYS = 8;
constexpr uint32_t TIMED_RAYS = 4;

struct Named {
  const char* name;
  SurfaceMethod method;
};
constexpr Named METHODS[] = {
    {"surface", {false, 0, 0, WLK_QUALITY_HIGH}},
    {"volume-forward-low", {true, VOXELS, WLK_SCATTERING_FORWARD, WLK_QUALITY_LOW}},
    {"volume-forward-high", {true, VOXELS, WLK_SCATTERING_FORWARD, WLK_QUALITY_HIGH}},
    {"volume-all-low", {true, VOXELS, WLK_SCATTERING_ALL_ORDERS, WLK_QUALITY_LOW}},
    {"volume-all-high", {true, VOXELS, WLK_SCATTERING_ALL_ORDERS, WLK_QUALITY_HIGH}},
};

void measure(SurfaceWorld& world, const SurfaceView& view, const Named& named, int rounds) {
  const BodyMesh mesh = bodyMesh(view.body);
  const SurfaceTruthImage truth = readSurfaceTruth(
      std::string(WELKIN_BENCH_FOLDER "/reference/surfaces/") + view.name + ".csv");
  world.show(view, mesh, named.method, TIMED_RAYS);
  world.render();
  std::vector<double> still;
  std::vector<double> moving;
  for (int i = 1; i <= rounds; ++i) {
    still.push_back(world.render());
    world.turnLight(i);
    moving.push_back(world.render());
  }
  world.show(view, mesh, named.method, ERROR_RAYS);
  world.render();
  const std::vector<double> picture = world.picture();
  std::printf("%s,%s,%.0f,%.0f", view.name.c_str(), named.name, medianOf(still), medianOf(moving));
  constexpr SurfaceRegion REGIONS[] = {SurfaceRegion::LIT, SurfaceRegion::SHADOW,
                                       SurfaceRegion::SILHOUETTE};
  const auto print = [&](const SurfaceRegion* region) {
    const SurfaceErrors errors = surfaceErrorsIn(picture, view, truth, region);
    std::printf(",%zu,%.3f,%.3f", errors.pixels, errors.total, errors.rms);
  };
  print(nullptr);
  for (const SurfaceRegion& region : REGIONS) {
    print(&region);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 3;
  try {
    SurfaceWorld world(canonicalCurve());
    std::printf("view,method,still_ms,moving_ms");
    for (const char* region : {"all", "lit", "shadow", "silhouette"}) {
      std::printf(",%sPixels,%sTotal,%sRms", region, region, region);
    }
    std::printf("\n");
    for (const SurfaceView& view : surfaceViews()) {
      bool chosen = argc < 3;
      for (int i = 2; i < argc; ++i) {
        chosen |= view.name.rfind(argv[i], 0) == 0;
      }
      for (const Named& named : METHODS) {
        if (chosen) {
          measure(world, view, named, rounds);
        }
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
