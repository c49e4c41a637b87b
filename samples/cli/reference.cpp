// SPDX-License-Identifier: MIT
// welkin reference: a scene file to the picture that Welkin aims at, by Monte Carlo on the CPU.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.hpp"
#include "cli/reference_scene.hpp"
#include "cli/scene_options.hpp"
#include "common/error.hpp"

namespace cli {
namespace {

namespace mc = welkin::reference;

struct ReferenceOptions {
  std::string scene;
  std::string exr;
  std::string variance;
  std::string png;
  std::string stats;
  std::string size;
  std::vector<std::string> assignments;
  uint64_t samples = 64;
  uint64_t seed = 1;
  std::optional<uint32_t> maxOrder;
  std::optional<uint32_t> order;
  unsigned threads = 0;
  bool disk = false;
  bool mie = false;
  bool ratioTracking = false;
};

constexpr const char* REFERENCE_HELP = R"(
Light scattered and reflected any number of times by air, fog, volumes and the planet's ground,
which also light and shadow each other; opaque geometry hides what is behind it but neither scatters
light nor throws shadows. Phase functions are the library's tables, also where the scene asks for
the closed form, or exactly Rayleigh's and Henyey-Greenstein's; voxels are interpolated linearly.

Unbiased: --variance writes the squared standard error of each value. --order 1 is single scattering
together with the sunlit ground; order 0 are the sun's disk and the opaque picture. --max-order 1
compares with pictures of the quality setting scattering=single. The picture gets the layer
transmittance.R, .G, .B.

Scattering uses the middle of the sun's disk, as the library does: its phase functions of rain and
ice contain the disk already. --disk samples the disk instead.

--mie computes the phase functions of cloud, fog and haze from the diameter by Mie theory of the
tests' own, so that nothing but opaque geometry is the library's; other particles but air and
henyey-greenstein are refused. On two cores it takes 3 s for haze, 40 s for 50 um, twice that for
the widest spread; noise of single angles 0.7 %, 0.15 % rms.)";

// One colour of each estimate as a picture; alpha 1.
template <class Value>
host::Image imageOf(const host::Scene& scene, const mc::RenderResult& result, double factor,
                    Value value) {
  host::Image image{scene.view.width, scene.view.height, {}};
  image.rgba.reserve(image.pixelCount() * 4);
  for (const mc::Estimate& estimate : result.pixels) {
    for (const double v : value(estimate)) {
      image.rgba.push_back(static_cast<float>(v * factor));
    }
    image.rgba.push_back(1.0f);
  }
  return image;
}

struct Noise {
  double mean = 0.0;
  double relativeStandardError = 0.0;
  double relMse = 0.0;
  double rmseOverMean = 0.0;
};

// As compareImages: relative to the value or to 1 % of the mean, whichever is larger.
Noise noiseOf(const mc::RenderResult& result) {
  Noise noise;
  const double count = static_cast<double>(result.pixels.size()) * 3.0;
  for (const mc::Estimate& estimate : result.pixels) {
    for (const double value : estimate.radiance) {
      noise.mean += std::abs(value) / count;
    }
  }
  double variance = 0.0;
  for (const mc::Estimate& estimate : result.pixels) {
    for (size_t c = 0; c < 3; ++c) {
      const double size = std::max(std::abs(estimate.radiance[c]), 0.01 * noise.mean);
      variance += estimate.variance[c] / count;
      if (size > 0.0) {
        noise.relativeStandardError += std::sqrt(estimate.variance[c]) / size / count;
        noise.relMse += estimate.variance[c] / (size * size) / count;
      }
    }
  }
  noise.rmseOverMean = noise.mean > 0.0 ? std::sqrt(variance) / noise.mean : 0.0;
  return noise;
}

void writeReferenceStatistics(const ReferenceOptions& options, const host::Scene& scene,
                              const mc::RenderResult& result, double wall_s, double cpu_s) {
  const Noise noise = noiseOf(result);
  const nlohmann::ordered_json json = {
      {"scene", scene.file},
      {"width", scene.view.width},
      {"height", scene.view.height},
      {"samples", options.samples},
      {"seed", options.seed},
      {"firstOrder", options.order.value_or(0)},
      {"lastOrder", options.order      ? nlohmann::ordered_json(*options.order)
                    : options.maxOrder ? nlohmann::ordered_json(*options.maxOrder)
                                       : nlohmann::ordered_json(nullptr)},
      {"disk", options.disk},
      {"mie", options.mie},
      {"time_s", wall_s},
      {"cpu_s", cpu_s},
      {"paths", result.paths},
      {"pathsPerCpuSecond", static_cast<double>(result.paths) / cpu_s},
      {"eventsPerPath", static_cast<double>(result.events) / static_cast<double>(result.paths)},
      {"mean", noise.mean * scene.camera.preExposure},
      {"meanRelativeStandardError", noise.relativeStandardError},
      {"relMSE", noise.relMse},
      {"rmseOverMean", noise.rmseOverMean}};
  std::ofstream stream(options.stats);
  stream << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  stream.flush();
  if (!stream) {
    throw host::HostError(options.stats + ": cannot write");
  }
}

void run(const ReferenceOptions& options) {
  if (options.order && options.maxOrder) {
    throw host::InputError("command line", "--order", "expected --order or --max-order, not both");
  }
  const host::Scene scene = readSizedScene(options.scene, options.assignments, options.size);
  checkFolders({options.exr, options.variance, options.png, options.stats});
  ProgressLine line;
  const host::ContextPtr context = host::makeCpuContext();
  host::applyWorld(context.get(), scene);
  const ReferenceScene reference =
      makeReferenceScene(context.get(), scene, {options.disk, options.mie, options.threads},
                         [&](const std::string& text) { line.show(text); });

  mc::RenderOptions how;
  how.samples = options.samples;
  how.seed = options.seed;
  how.firstOrder = options.order.value_or(0);
  how.lastOrder = options.order.value_or(options.maxOrder.value_or(mc::ALL_ORDERS));
  how.shadow = options.ratioTracking ? mc::Shadow::RATIO_TRACKING : mc::Shadow::EXACT;
  how.threads = options.threads;
  how.progress = [&](double part) { line.show(part); };
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpuStart = std::clock();
  const mc::RenderResult result = mc::render(reference.scene, reference.rays, how);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const double cpu_s = static_cast<double>(std::clock() - cpuStart) / CLOCKS_PER_SEC;

  const double exposure = scene.camera.preExposure;
  const host::Image picture =
      imageOf(scene, result, exposure, [](const mc::Estimate& e) { return e.radiance; });
  const host::Image through =
      imageOf(scene, result, 1.0, [](const mc::Estimate& e) { return e.transmittance; });
  host::writeExr(options.exr, picture, &through);
  if (!options.variance.empty()) {
    host::writeExr(options.variance, imageOf(scene, result, exposure * exposure,
                                             [](const mc::Estimate& e) { return e.variance; }));
  }
  if (!options.png.empty()) {
    host::writePng(options.png, picture, pngStops(scene), scene.png.toneMap);
  }
  if (!options.stats.empty()) {
    writeReferenceStatistics(options, scene, result, wall.count(), cpu_s);
  }
}

}  // namespace

void addReference(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("reference", "The true picture of a scene file, by Monte Carlo");
  const auto options = std::make_shared<ReferenceOptions>();
  command->footer(REFERENCE_HELP);
  command->add_option("SCENE", options->scene, "Scene (JSON), see docs/scene-format.md")
      ->required();
  command->add_option("-o,--output", options->exr, "Picture (EXR, linear)")->required();
  command->add_option("--variance", options->variance, "Squared standard errors (EXR)");
  command->add_option("--png", options->png, "The picture, tone mapped");
  command->add_option("--size", options->size, "WxH in pixels, over the scene's");
  command->add_option("--spp", options->samples, "Paths per pixel and colour, default 64")
      ->check(CLI::Range(uint64_t{2}, uint64_t{1} << 32));
  command->add_option("--seed", options->seed, "Of the random numbers, default 1")
      ->check(CLI::Range(uint64_t{0}, uint64_t{1} << 63));
  command->add_option("--max-order", options->maxOrder, "Scatterings and reflections, at most");
  command->add_option("--order", options->order, "Scatterings and reflections, exactly");
  command->add_flag("--disk", options->disk, "Scattering feels the size of the sun's disk");
  command->add_flag("--mie", options->mie, "Droplets by Mie theory apart from the library's");
  command->add_flag("--ratio-tracking", options->ratioTracking,
                    "Shadows in volumes by ratio tracking, as a check");
  command->add_option("--threads", options->threads, "Default: all cores; no influence on results")
      ->check(CLI::Range(1u, 1024u));
  command->add_option("--set", options->assignments, "key.path=value, over the scene")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--stats", options->stats, "Write times and errors to this file (JSON)");
  command->callback([options] { run(*options); });
}

}  // namespace cli
