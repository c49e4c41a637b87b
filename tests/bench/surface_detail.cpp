// SPDX-License-Identifier: MIT
// welkin_surface_detail ROUNDS [RAYS]: CPU times of frames of cloud surfaces with detail and
// without, as CSV on standard output: docs/results/surface-detail.csv. Medians of interleaved
// rounds, all threads, ms: of a frame in which nothing changed, and of one in which the light
// moved. RAYS: along the edge of a pixel of the truth's pictures.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "bench/front_timing.hpp"
#include "bench/surface_view_scene.hpp"

namespace {

using namespace bench;

constexpr double PART = 0.05;  // depth of the detail, of the body's height

double heightOf(const BodyMesh& mesh) {
  float low = mesh.positions[1];
  float high = low;
  for (size_t i = 1; i < mesh.positions.size(); i += 3) {
    low = std::min(low, mesh.positions[i]);
    high = std::max(high, mesh.positions[i]);
  }
  return static_cast<double>(high - low);
}

struct Times {
  std::vector<double> still, moving;
};

void measure(SurfaceWorld& world, const SurfaceView& view, int rounds, uint32_t rays) {
  const BodyMesh mesh = bodyMesh(view.body);
  world.show(view, mesh, {false, 0, 0, WLK_QUALITY_HIGH}, rays);
  const double depth = PART * heightOf(mesh);
  Times plain;
  Times detailed;
  std::vector<double> still;
  std::vector<double> moving;
  int turns = 0;
  for (int i = 0; i <= rounds; ++i) {
    for (const bool with : {false, true}) {
      Times& times = with ? detailed : plain;
      world.detail(with ? depth : 0);
      world.render();  // what the change itself asks for
      const double unchanged = world.render();
      world.turnLight(++turns);
      const double turned = world.render();
      if (i > 0) {  // the first round makes pipelines
        times.still.push_back(unchanged);
        times.moving.push_back(turned);
      }
    }
    if (i > 0) {
      still.push_back(detailed.still.back() / plain.still.back());
      moving.push_back(detailed.moving.back() / plain.moving.back());
    }
  }
  std::printf("%s,%.0f,%.0f,%.2f,%.0f,%.0f,%.2f\n", view.name.c_str(), medianOf(plain.still),
              medianOf(detailed.still), medianOf(still), medianOf(plain.moving),
              medianOf(detailed.moving), medianOf(moving));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  const uint32_t rays = argc > 2 ? static_cast<uint32_t>(std::max(std::atoi(argv[2]), 1)) : 4;
  try {
    SurfaceWorld world(canonicalCurve());
    std::printf(
        "view,still_ms,still_detail_ms,still_ratio,moving_ms,moving_detail_ms,moving_ratio\n");
    for (const SurfaceView& view : surfaceViews()) {
      if (view.body == "cumulus" || view.body == "stratocumulus") {
        measure(world, view, rounds, rays);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
