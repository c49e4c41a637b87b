// SPDX-License-Identifier: MIT
// welkin_surface_detail: times of frames of cloud surfaces with detail and without, as CSV:
// docs/results/surface-detail.csv. Medians of interleaved rounds in ms, of those on quiet cores
// where there are enough: CPU times of all threads, of a frame in which nothing changed and of one
// in which the light moved; of the latter's passes the time that they took, of all frames; and
// what the cores were like (cores.hpp). Ratios are medians over the rounds, all of them: what
// others do on a machine for seconds is in both frames of one.
//
// With --count, under `valgrind --tool=callgrind --instr-atstart=no --smc-check=all-non-file`: one
// dump of instructions for each of these frames, named as they are; no CSV.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
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

// A world of its own for each kind of frame, so that a frame holds nothing that the one before
// asked for.
struct Frames {
  SurfaceWorld& world;
  bool turns = false;
  int turn = 0;
  std::vector<double> light{};
  std::vector<double> eye{};

  double render() {
    if (turns) {
      world.turnLight(++turn);
    }
    world.render();
    light.push_back(world.passTime(WLK_PASS_SURFACE_LIGHT));
    eye.push_back(world.passTime(WLK_PASS_SURFACE));
    return light.back() + eye.back();
  }
};

struct Job {
  std::string noise;
  size_t rounds = 5;
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

// Still, still with detail, moving, moving with detail.
constexpr size_t KINDS = 4;
using Worlds = std::array<SurfaceWorld, KINDS>;

void measure(Worlds& worlds, const SurfaceView& view, const Job& job) {
  const BodyMesh mesh = bodyMesh(view.body);
  const double depth = job.part * heightOf(mesh);
  const auto show = [&](SurfaceWorld& world) {
    world.show(view, mesh, {false, 0, 0, WLK_QUALITY_HIGH}, job.rays);
  };
  if (job.count) {
    show(worlds[0]);
    count(worlds[0], depth);
    return;
  }
  std::vector<Frames> frames;
  for (size_t i = 0; i < KINDS; ++i) {
    show(worlds[i]);
    worlds[i].detail(i % 2 == 0 ? 0 : depth);
    frames.push_back({worlds[i], i >= 2});
  }
  std::vector<Timing> times;
  for (size_t i = 0; i < KINDS; i += 2) {
    std::vector<Copies> methods;
    for (Frames* kind : {&frames[i], &frames[i + 1]}) {
      methods.push_back({[kind] { return kind->render(); }});
    }
    constexpr size_t WARM_UPS = 2;  // makes pipelines
    const std::vector<Timing> both = interleave(methods, 0, WARM_UPS, job.rounds);
    times.insert(times.end(), both.begin(), both.end());
  }
  std::printf("%s,%s,%zu,%u,%u,%g", job.noise.c_str(), view.name.c_str(), mesh.indices.size() / 3,
              static_cast<uint32_t>(view.width) * job.rays,
              static_cast<uint32_t>(view.height) * job.rays, job.part);
  for (size_t i = 0; i < KINDS; i += 2) {
    std::printf(",%.0f,%.0f,%.2f", times[i].cpu, times[i + 1].cpu, times[i + 1].medianCpuRatio);
  }
  std::printf(",%.0f,%.0f,%.0f,%.0f", medianOf(frames[2].light), medianOf(frames[3].light),
              medianOf(frames[2].eye), medianOf(frames[3].eye));
  size_t rounds = times[0].rounds;
  size_t quiet = times[0].quietRounds;
  double work_ns = 0;
  for (const Timing& one : times) {
    rounds = std::min(rounds, one.rounds);
    quiet = std::min(quiet, one.quietRounds);
    work_ns = std::max(work_ns, one.cores.work_ns);
  }
  std::printf(",%zu,%zu,%.0f\n", rounds, quiet, work_ns);
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
    const CanonicalCurve curve = canonicalCurve();
    Worlds worlds{SurfaceWorld(curve), SurfaceWorld(curve), SurfaceWorld(curve),
                  SurfaceWorld(curve)};
    if (header) {
      std::printf(
          "noise,view,triangles,width,height,depth,still_ms,still_detail_ms,still_ratio,"
          "moving_ms,moving_detail_ms,moving_ratio,light_ms,light_detail_ms,eye_ms,"
          "eye_detail_ms,rounds,quiet_rounds,core_work_ns\n");
    }
    for (const SurfaceView& view : scene == "coarse" ? coarseViews() : surfaceViews()) {
      if (!names.empty() && std::find(names.begin(), names.end(), view.name) == names.end()) {
        continue;
      }
      for (const double part : parts) {
        job.part = part;
        measure(worlds, view, job);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
