// SPDX-License-Identifier: MIT
// welkin_surface_detail: times of frames of cloud surfaces with detail and without, as CSV:
// docs/results/surface-detail.csv. Medians of interleaved rounds in ms: CPU times of all threads,
// of a frame in which nothing changed and of one in which the light moved; and of the latter's
// passes the time that they took.
//
// With --count, under `valgrind --tool=callgrind --instr-atstart=no --smc-check=all-non-file`: one
// dump of instructions for each of these frames, named as they are; no CSV.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <vector>
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

#include "bench/front_timing.hpp"
#include "bench/surface_view_scene.hpp"

namespace {

using namespace bench;

double heightOf(const BodyMesh& mesh) {
  float low = mesh.positions[1];
  float high = low;
  for (size_t i = 1; i < mesh.positions.size(); i += 3) {
    low = std::min(low, mesh.positions[i]);
    high = std::max(high, mesh.positions[i]);
  }
  return static_cast<double>(high - low);
}

// As [B08] 9 has its cumulus: 5000 triangles, 800 x 600 pixels.
std::vector<SurfaceView> coarseViews() {
  std::vector<SurfaceView> views;
  for (SurfaceView view : surfaceViews()) {
    if (view.body == "cumulus") {
      view.body = "cumulus-coarse";
      view.name = view.body + view.name.substr(view.name.find('-'));
      view.width = 800;
      view.height = 600;
      views.push_back(view);
    }
  }
  return views;
}

struct Times {
  std::vector<double> still, moving, light, eye;
  void add(SurfaceWorld& world, int turns) {
    world.render();  // what a change itself asks for
    still.push_back(world.render());
    world.turnLight(turns);
    moving.push_back(world.render());
    light.push_back(world.passTime(WLK_PASS_SURFACE_LIGHT));
    eye.push_back(world.passTime(WLK_PASS_SURFACE));
  }
};

double ratio(const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> ratios;
  for (size_t i = 0; i < with.size(); ++i) {
    ratios.push_back(with[i] / without[i]);
  }
  return medianOf(ratios);
}

struct Job {
  std::string noise;
  int rounds = 5;
  uint32_t rays = 1;
  double part = 0.05;
  bool count = false;
};

// What a frame takes, for callgrind.
void dump([[maybe_unused]] SurfaceWorld& world, [[maybe_unused]] const char* name) {
#ifdef CALLGRIND_START_INSTRUMENTATION
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  world.render();
  CALLGRIND_DUMP_STATS_AT(name);
  CALLGRIND_STOP_INSTRUMENTATION;
#else
  throw std::runtime_error("--count: built without valgrind/callgrind.h");
#endif
}

void count(SurfaceWorld& world, double depth) {
  int turns = 0;
  for (const bool with : {false, true}) {
    world.detail(with ? depth : 0);
    for (int warmUp = 0; warmUp < 2; ++warmUp) {
      world.turnLight(++turns);
      world.render();
      world.render();
    }
    dump(world, with ? "still with detail" : "still");
    world.turnLight(++turns);
    dump(world, with ? "moved with detail" : "moved");
  }
}

void measure(SurfaceWorld& world, const SurfaceView& view, const Job& job) {
  const BodyMesh mesh = bodyMesh(view.body);
  world.show(view, mesh, {false, 0, 0, WLK_QUALITY_HIGH}, job.rays);
  const double depth = job.part * heightOf(mesh);
  if (job.count) {
    count(world, depth);
    return;
  }
  Times plain;
  Times detailed;
  Times warmUp;  // makes pipelines
  int turns = 0;
  for (int i = 0; i <= job.rounds; ++i) {
    for (const bool with : {false, true}) {
      world.detail(with ? depth : 0);
      (i == 0 ? warmUp : with ? detailed : plain).add(world, ++turns);
    }
  }
  std::printf("%s,%s,%zu,%u,%u,%g", job.noise.c_str(), view.name.c_str(), mesh.indices.size() / 3,
              static_cast<uint32_t>(view.width) * job.rays,
              static_cast<uint32_t>(view.height) * job.rays, job.part);
  const auto print = [&](std::vector<double> Times::*of, bool withRatio) {
    std::printf(",%.0f,%.0f", medianOf(plain.*of), medianOf(detailed.*of));
    if (withRatio) {
      std::printf(",%.2f", ratio(detailed.*of, plain.*of));
    }
  };
  print(&Times::still, true);
  print(&Times::moving, true);
  print(&Times::light, false);
  print(&Times::eye, false);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times of frames of cloud surfaces with detail and without");
  Job job;
  std::string scene = "coarse";
  std::vector<double> parts = {0.05, 0.1};
  bool header = true;
  std::vector<std::string> names;
  job.noise = "texture";
  app.add_option("--noise", job.noise, "first column: how the library was built");
  app.add_option("--rounds", job.rounds, "of each view")->check(CLI::Range(1, 1000));
  app.add_option("--scene", scene, "5000 triangles at 800 x 600, or the pictures of the truth")
      ->check(CLI::IsMember({"coarse", "truth"}));
  app.add_option("--rays", job.rays, "along the edge of a pixel")->check(CLI::Range(1, 64));
  app.add_option("--depth", parts, "of the detail, parts of the body's height");
  app.add_option("--view", names, "these only");
  app.add_flag("--count", job.count, "dumps of callgrind in place of times");
  app.add_flag("!--no-header", header, "rows only");
  CLI11_PARSE(app, argc, argv);
  try {
    SurfaceWorld world(canonicalCurve());
    if (header) {
      std::printf(
          "noise,view,triangles,width,height,depth,still_ms,still_detail_ms,still_ratio,"
          "moving_ms,moving_detail_ms,moving_ratio,light_ms,light_detail_ms,eye_ms,"
          "eye_detail_ms\n");
    }
    for (const SurfaceView& view : scene == "coarse" ? coarseViews() : surfaceViews()) {
      if (!names.empty() && std::find(names.begin(), names.end(), view.name) == names.end()) {
        continue;
      }
      for (const double part : parts) {
        job.part = part;
        measure(world, view, job);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
