// SPDX-License-Identifier: MIT
// welkin_volume_truth: makes the files that volume_truth.hpp reads, radiance in 1/sr per unit
// irradiance normal to the beam, by the solvers of tests/reference. Clouds come from the sample
// host. With F = tests/bench/reference/volumes, on one core (the times):
//   --dir F --only sphere-2- --paths 50000                     2 minutes
//   --dir F --only sphere-10 --only sphere-30 --paths 20000    9 minutes
//   --dir F --only cumulus --paths 10000 --seed 1              7 minutes
//   --dir F --only cumulus-back-hg --paths 100000 --seed 11    9 minutes, in place of the former
//   --dir F --slabs                                            1 minute
//   --dir F --les DATA --only les-single
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "bench/volume_clouds.hpp"
#include "bench/volume_truth.hpp"
#include "common/error.hpp"
#include "common/volume.hpp"
#include "reference/raymarch.hpp"
#include "reference/slab_monte_carlo.hpp"
#include "reference/slab_solver.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr double RADIANS = std::numbers::pi / 180;
constexpr int DIGITS = 5;  // rounding 5e-5, noise 5e-3 and more

struct Options {
  std::string folder;
  std::string les;
  std::vector<std::string> names;
  uint64_t paths = 0;
  uint64_t seed = 1;
  bool slabs = false;
  std::string voxels;
};

bool chosen(const Options& options, const std::string& name) {
  return std::any_of(options.names.begin(), options.names.end(),
                     [&](const std::string& start) { return name.rfind(start, 0) == 0; });
}

void make(const Options& options, const std::string& name,
          const std::function<TruthImage(uint64_t paths, uint64_t seed)>& trace) {
  if (!chosen(options, name)) {
    return;
  }
  const std::clock_t begin = std::clock();
  const TruthImage image = trace(options.paths, options.seed);
  writeTruthImage((std::filesystem::path(options.folder) / (name + ".csv")).string(), image,
                  DIGITS);
  double square = 0;  // of the standard errors
  for (const double error : image.error) {
    square += error * error;
  }
  const double noise = std::sqrt(square / static_cast<double>(image.error.size())) / image.mean();
  std::printf("%-24s mean %.5f, rms of the errors %.2f %% of it, %.0f s\n", name.c_str(),
              image.mean(), 100 * noise,
              static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  std::fflush(stdout);
}

rt::PhaseFunction phaseOf(const PhaseCurve& curve) {
  std::vector<rt::Rgb> values;
  for (const double value : curve.value) {
    values.push_back({value, value, value});
  }
  return rt::PhaseFunction::table(curve.angle, values);
}

void makeClouds(const Options& options, const std::vector<CloudCase>& cases,
                const std::function<std::vector<float>()>& load) {
  const PhaseCurve curve =
      readPhaseCurve((std::filesystem::path(options.folder) / DROPLET_FILE).string());
  for (const CloudCase& one : cases) {
    make(options, one.name, [&](uint64_t paths, uint64_t seed) {
      const rt::PhaseFunction phase =
          one.droplets ? phaseOf(curve) : rt::PhaseFunction::henyeyGreenstein(TRUTH_G);
      return traceCloud(one, load(), phase, paths, seed);
    });
  }
}

// Light scattered once, along the very rays that welkin_volume_errors draws: no noise.
TruthImage marchCloud(const CloudCase& one, const std::vector<float>& extinction) {
  rt::VoxelField field;
  field.size = one.voxels;
  field.extinction.assign(extinction.begin(), extinction.end());
  field.worldFromBox = {one.extent[0], 0, 0, one.min[0],    0,         one.extent[1], 0,
                        one.min[1],    0, 0, one.extent[2], one.min[2]};
  const rt::RayMarch march(field);
  const rt::PhaseFunction phase = rt::PhaseFunction::henyeyGreenstein(TRUTH_G);
  const rt::Point forward = rt::normalized(rt::minus(one.target, one.eye));
  const rt::Point right = rt::normalized(rt::cross(forward, {0, 1, 0}));
  const rt::Point up = rt::cross(right, forward);
  const double half = std::tan(0.5 * one.verticalFov_deg * RADIANS);
  constexpr int N = LES_SINGLE_RAYS;
  TruthImage image;
  image.paths = N * N;
  image.width = one.width;
  image.height = one.height;
  image.radiance.resize(static_cast<size_t>(one.width * one.height));
  image.error.resize(image.radiance.size());
  for (int y = 0; y < N * one.height; ++y) {
    for (int x = 0; x < N * one.width; ++x) {
      const double u = ((x + 0.5) / N - 0.5 * one.width) * 2 * half / one.height;
      const double v = (0.5 * one.height - (y + 0.5) / N) * 2 * half / one.height;
      rt::Point d{};
      for (size_t k = 0; k < 3; ++k) {
        d[k] = forward[k] + u * right[k] + v * up[k];
      }
      d = rt::normalized(d);
      image.radiance[static_cast<size_t>(y / N * one.width + x / N)] +=
          phase.value(1, 1 - rt::dot(d, one.sun)) *
          march.march(one.eye, d, 1e30, one.sun).scattered / (N * N);
    }
  }
  return image;
}

// Three directions on each side, for each thickness and sun; every fifth by Monte Carlo too.
void makeSlabs(const Options& options) {
  constexpr int NODES = 192;  // against 128: 2e-4
  constexpr int MOMENTS = 1500;
  constexpr int EVERY = 5;
  constexpr double PATHS = 40000;  // fewer for thick slabs, whose paths are long
  const PhaseCurve curve =
      readPhaseCurve((std::filesystem::path(options.folder) / DROPLET_FILE).string());
  std::FILE* file =
      std::fopen((std::filesystem::path(options.folder) / "slabs.csv").string().c_str(), "w");
  if (file == nullptr) {
    throw std::runtime_error(options.folder + ": cannot write");
  }
  std::fprintf(file,
               "phase,tau,sunZenith_deg,side,viewZenith_deg,azimuth_deg,radiance,single,"
               "monteCarlo,error\n");
  uint64_t row = 0;
  for (const bool droplets : {false, true}) {
    const rt::SlabSolver solver(droplets ? rt::tabulatedSlabPhase(curve.angle, curve.value, MOMENTS)
                                         : rt::henyeyGreensteinSlabPhase(TRUTH_G),
                                1, NODES);
    const rt::PhaseFunction phase =
        droplets ? phaseOf(curve) : rt::PhaseFunction::henyeyGreenstein(TRUTH_G);
    for (const double tau : {0.5, 1.0, 4.0, 16.0, 64.0}) {
      for (const int sun : {0, 50, 75}) {
        for (const bool reflected : {true, false}) {
          for (const auto& [zenith, azimuth] :
               {std::pair{0, 0}, std::pair{30, 90}, std::pair{60, 150}}) {
            const double mu0 = std::cos(sun * RADIANS);
            const double mu = std::cos(zenith * RADIANS) * (reflected ? 1 : -1);
            const double phi = azimuth * RADIANS;
            const rt::SlabRadiance truth = solver.radiance(tau, mu0, {mu, phi});
            rt::SlabEstimate check{0, 0};
            if (row % EVERY == 0) {
              check =
                  rt::slabRadianceMonteCarlo(tau, 1, phase, mu0, mu, phi,
                                             static_cast<uint64_t>(PATHS / (1 + tau / 4)), 7 + row);
            }
            std::fprintf(file, "%s,%g,%d,%s,%d,%d,%.6g,%.6g,%.5g,%.2g\n",
                         droplets ? "droplets" : "hg", tau, sun,
                         reflected ? "reflected" : "transmitted", zenith, azimuth, truth.total,
                         truth.single, check.value, check.standardError);
            ++row;
          }
        }
      }
    }
  }
  std::fclose(file);
}

void writeVoxels(const std::string& path) {
  const std::vector<float> values = sphereVoxels();
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr ||
      std::fwrite(values.data(), sizeof(float), values.size(), file) != values.size()) {
    throw std::runtime_error(path + ": cannot write");
  }
  std::fclose(file);
}

void run(const Options& options) {
  if (!options.voxels.empty()) {
    writeVoxels(options.voxels);
  }
  if (options.slabs) {
    makeSlabs(options);
  }
  for (const int radius : SPHERE_RADII) {
    for (const int angle : SPHERE_ANGLES) {
      make(options, sphereName(radius, angle),
           [&](uint64_t paths, uint64_t seed) { return traceSphere(radius, angle, paths, seed); });
    }
  }
  makeClouds(options, cumulusCases(), cumulusExtinction);
  if (!options.les.empty()) {
    makeClouds(options, lesCases(), [&] { return lesExtinction(options.les); });
    for (const CloudCase& one : lesSingleCases()) {
      make(options, one.name,
           [&](uint64_t, uint64_t) { return marchCloud(one, lesExtinction(options.les)); });
    }
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  CLI::App app("True radiance of thick volumes");
  bench::Options options;
  app.add_option("--dir", options.folder, "Folder of the files")->required();
  app.add_option("--only", options.names, "Pictures whose names begin with this; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--paths", options.paths, "Per pixel")->default_val(20000);
  app.add_option("--seed", options.seed, "Of the random numbers")->default_val(2);
  app.add_flag("--slabs", options.slabs, "Make slabs.csv too");
  app.add_option("--les", options.les, "File of the cloud of les-cloud.json, for --only les");
  app.add_option("--sphere-voxels", options.voxels, "Write the sphere's voxels, raw float");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
