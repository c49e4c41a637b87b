// SPDX-License-Identifier: MIT
// welkin_sky_cost OUT.json: time of a frame of sky and aerial perspective, and its error against
// Monte Carlo, of the library, of the tables that game engines have in common, and of forms that
// every pixel computes for itself. All draw on one device, over the same depth image, and are timed
// from recording to the end of the wait. Prints a table in Markdown.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/front_report.hpp"
#include "bench/front_timing.hpp"
#include "bench/lut_sky.hpp"
#include "bench/sky_forms.hpp"
#include "bench/sky_truth.hpp"
#include "bench/welkin_sky.hpp"

namespace {

using namespace bench;

constexpr float SURFACE_COLOR = 0.02f;
constexpr float FROXEL_RANGE = 32e3f;
constexpr float SAMPLE_PUBLISHED = 0.3f;
constexpr float SAMPLE_BETTER = 0.5f;
constexpr size_t WARM_UPS = 2;
constexpr size_t COPIES = 2;

struct Options {
  std::string out;
  std::string commit;
  std::string only;
  std::string truth;
  std::string newTruth;
  uint32_t width = 1280;
  uint32_t height = 720;
  uint32_t pixels = 50;
  uint64_t paths = 5000;
  uint64_t seed = 1;
  uint32_t rounds = 9;
  bool validation = false;
  bool singlePrecision = false;
  std::vector<std::string> methods;
};

LutScene lutScene(const SkyCase& one, const Options& options) {
  const host::CameraDesc camera = skyCamera(one);
  const host::CameraAxes axes = host::cameraAxes(camera);
  const double tangent = std::tan(0.5 * camera.verticalFovDeg * host::RADIANS_PER_DEGREE);
  const auto row = [](host::Vec3 v, double w) {
    return std::array<float, 4>{static_cast<float>(v.x), static_cast<float>(v.y),
                                static_cast<float>(v.z), static_cast<float>(w)};
  };
  LutScene scene;
  scene.right = row(axes.right * (tangent * options.width / options.height), 0);
  scene.up = row(axes.up * tangent, 0);
  scene.forward = row(axes.forward, camera.nearPlane);
  scene.light = row(sunDirection(one), double{FROXEL_RANGE});
  scene.irradiance = row({1, 1, 1}, SKY_PLANET_RADIUS);
  scene.scattering =
      row({SKY_SCATTERING[0], SKY_SCATTERING[1], SKY_SCATTERING[2]}, SKY_SCALE_HEIGHT);
  scene.ground = row(host::Vec3{1, 1, 1} * SKY_GROUND_ALBEDO, one.altitude);
  return scene;
}

/// Light that a method draws.
enum class Orders { NONE, ONE, ALL };

/// A way to draw the picture, as often as there are copies of it in memory.
struct Method {
  std::string name;
  Orders orders;
  std::vector<std::function<void(VkCommandBuffer)>> record;
  std::function<GpuCounts()> counts;  // of the first copy's last frame
};

Ordered summary(const std::vector<double>& errors) {
  if (errors.empty()) {
    return nullptr;
  }
  return {{"values", errors.size()},
          {"median", quantile(errors, 0.5)},
          {"p90", quantile(errors, 0.9)},
          {"max", quantile(errors, 1)}};
}

Ordered errorsJson(const SkyErrors& errors) {
  return {{"sky", summary(errors.sky)},
          {"aerial", summary(errors.aerial)},
          {"aerialBeyondFroxels", summary(errors.aerialFar)},
          {"transmittance", summary(errors.transmittance)}};
}

/// Against light of all orders and, of methods that draw the first alone, against that.
struct Errors {
  SkyErrors all;
  SkyErrors single;
};

/// One case: its methods timed in turn, and the error of each.
class Study {
 public:
  Study(Gpu& gpu, const SkyCase& one, const Options& options)
      : gpu_(gpu),
        one_(one),
        options_(options),
        depth_(skyDepth(one, options.width, options.height)) {
    for (size_t i = 0; i < COPIES; ++i) {
      addCopy();
    }
  }

  /// Rows for the report; adds the errors of each method to `all`.
  Ordered run(std::vector<SkyErrors>& all) {
    const std::vector<SkyPixel> pixels =
        drawPixels(one_, depth_, options_.width, options_.height, options_.pixels, options_.seed);
    const std::vector<SkyTruth> truths = options_.truth.empty()
                                             ? skyTruth(one_, pixels, options_.paths, options_.seed)
                                             : readTruth(options_.truth, one_, pixels);
    const SingleTruth single = singleTruth(one_, pixels, truths);
    paint(SURFACE_COLOR);
    const std::vector<Timing> timings = time();
    Ordered rows = Ordered::array();
    all.resize(methods_.size());
    for (size_t i = 0; i < methods_.size(); ++i) {
      const std::vector<float> black = picture(i, 0);
      const std::vector<float> white = picture(i, 1);
      const auto against = [&](const std::vector<SkyPixel>& seen,
                               const std::vector<SkyTruth>& truth) {
        return errorsOf(black, white, options_.width, double{FROXEL_RANGE}, seen, truth);
      };
      Errors errors;
      if (methods_[i].orders != Orders::NONE) {
        errors.all = against(pixels, truths);
      }
      if (methods_[i].orders == Orders::ONE) {
        errors.single = against(single.pixels, single.truths);
      }
      all[i].add(errors.all);
      rows.push_back(row(methods_[i], timings[i], errors));
      printRow(methods_[i].name, timings[i], errors);
    }
    return {{"name", one_.name},
            {"sun_deg", one_.sun_deg},
            {"azimuth_deg", one_.azimuth_deg},
            {"altitude_m", one_.altitude},
            {"noise", noiseOf(truths)},
            {"rows", rows}};
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Method& method : methods_) {
      names.push_back(method.name);
    }
    return names;
  }

 private:
  void addCopy() {
    const VkExtent3D extent{options_.width, options_.height, 1};
    GpuTargets targets;
    targets.depth = gpu_.makeImage(VK_FORMAT_R32_SFLOAT, extent);
    targets.color = gpu_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, extent);
    targets.target = gpu_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, extent);
    gpu_.upload(targets.depth, depth_);
    targets_.push_back(targets);
    LutSky* published = addLut(targets, SAMPLE_PUBLISHED, "lut");
    // The same tables, two of which the frames before left.
    if (wanted("lut-kept")) {
      addMethod(
          "lut-kept", Orders::ALL,
          [published](VkCommandBuffer c) { published->record(c, LutSky::SKY_VIEW); },
          [published] { return published->counts(); });
    }
    if (wanted("lut-midpoint")) {
      addLut(targets, SAMPLE_BETTER, "lut-midpoint");
    }
    addWelkin(targets, WLK_SCATTERING_DEFAULT, true, "welkin");
    addWelkin(targets, WLK_SCATTERING_DEFAULT, false, "welkin-kept");
    addWelkin(targets, WLK_SCATTERING_SINGLE, false, "welkin-single");
    addForm(targets, SkyForm::NONE, Orders::NONE, "none");
    addForm(targets, SkyForm::FLAT, Orders::ONE, "flat");
    addForm(targets, SkyForm::SEGMENTS, Orders::ONE, "segments");
  }

  bool wanted(const char* name) const {
    const std::vector<std::string>& names = options_.methods;
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  }

  LutSky* addLut(const GpuTargets& targets, float sampleAt, const char* name) {
    const LutOptions options{sampleAt, options_.singlePrecision};
    luts_.push_back(std::make_unique<LutSky>(gpu_, targets, options));
    LutSky* lut = luts_.back().get();
    lut->setScene(lutScene(one_, options_));
    addMethod(
        name, Orders::ALL, [lut](VkCommandBuffer c) { lut->record(c); },
        [lut] { return lut->counts(); });
    return lut;
  }

  void addWelkin(const GpuTargets& targets, uint32_t scattering, bool moving, const char* name) {
    if (!wanted(name)) {
      return;
    }
    welkins_.push_back(std::make_unique<WelkinSky>(gpu_, targets, one_, scattering, moving));
    WelkinSky* sky = welkins_.back().get();
    addMethod(
        name, scattering == WLK_SCATTERING_SINGLE ? Orders::ONE : Orders::ALL,
        [sky](VkCommandBuffer c) { sky->record(c); }, [sky] { return sky->counts(); });
  }

  void addForm(const GpuTargets& targets, SkyForm::Kind kind, Orders orders, const char* name) {
    if (!wanted(name)) {
      return;
    }
    forms_.push_back(std::make_unique<SkyForm>(gpu_, targets, kind));
    SkyForm* form = forms_.back().get();
    form->setScene(lutScene(one_, options_));
    addMethod(
        name, orders, [form](VkCommandBuffer c) { form->record(c); },
        [form] { return form->counts(); });
  }

  void addMethod(const char* name, Orders orders, std::function<void(VkCommandBuffer)> record,
                 std::function<GpuCounts()> counts) {
    const auto known = std::find_if(methods_.begin(), methods_.end(),
                                    [&](const Method& method) { return method.name == name; });
    if (known == methods_.end()) {
      methods_.push_back({name, orders, {std::move(record)}, std::move(counts)});
    } else {
      known->record.push_back(std::move(record));
    }
  }

  std::vector<Timing> time() {
    std::vector<Copies> frames;
    for (const Method& method : methods_) {
      Copies copies;
      for (const auto& record : method.record) {
        copies.push_back([this, &record] { return gpu_.run(record); });
      }
      frames.push_back(copies);
    }
    return interleave(frames, 0, WARM_UPS, options_.rounds);
  }

  double pixelCount() const { return double{1} * options_.width * options_.height; }

  void paint(float color) {
    const std::vector<float> texels(size_t{4} * options_.width * options_.height, color);
    for (const GpuTargets& targets : targets_) {
      gpu_.upload(targets.color, texels);
    }
  }

  std::vector<float> picture(size_t method, float color) {
    paint(color);
    gpu_.run(methods_[method].record[0]);
    return gpu_.download(targets_[0].target);
  }

  Ordered row(const Method& method, const Timing& timing, const Errors& errors) {
    gpu_.run(method.record[0]);
    gpu_.run(method.record[0]);  // the library tells a frame's times once the next one began
    const GpuCounts counts = method.counts();
    Ordered passes = Ordered::object();
    for (const auto& [name, time] : counts.passes_ms) {
      passes[name] = time;
    }
    return {{"name", method.name},
            {"time_ms", timing.wall},
            {"timeMad_ms", timing.wallDeviation},
            {"cpu_ms", timing.cpu},
            {"gpu_ms", timing.gpu},
            {"nsPerPixel", 1e6 * timing.wall / pixelCount()},
            {"cpuNsPerPixel", 1e6 * timing.cpu / pixelCount()},
            {"ratio", timing.ratio},
            {"cpuRatio", timing.cpuRatio},
            {"medianRatio", timing.medianRatio},
            {"medianRatioLow", timing.medianRatioLow},
            {"medianRatioHigh", timing.medianRatioHigh},
            {"dispatches", counts.dispatches},
            {"invocations", counts.invocations},
            {"bytes", counts.bytes},
            {"passes_ms", passes},
            {"error", errorsJson(errors.all)},
            {"errorOfFirstOrder", errorsJson(errors.single)}};
  }

  void printRow(const std::string& name, const Timing& timing, const Errors& errors) const {
    std::printf("| %s | %s | %.1f | %.1f | %.2f (%.2f..%.2f) | %.2f |", one_.name.c_str(),
                name.c_str(), timing.wall, timing.cpu, timing.medianRatio, timing.medianRatioLow,
                timing.medianRatioHigh, timing.cpuRatio);
    for (const std::vector<double>* part :
         {&errors.all.sky, &errors.all.aerial, &errors.all.aerialFar, &errors.all.transmittance,
          &errors.single.sky, &errors.single.aerial, &errors.single.aerialFar}) {
      if (part->empty()) {
        std::printf(" - |");
      } else {
        std::printf(" %.2f / %.2f / %.2f |", 100 * quantile(*part, 0.5), 100 * quantile(*part, 0.9),
                    100 * quantile(*part, 1));
      }
    }
    std::printf("\n");
    std::fflush(stdout);
  }

  Gpu& gpu_;
  SkyCase one_;
  Options options_;
  std::vector<float> depth_;
  std::vector<GpuTargets> targets_;
  std::vector<std::unique_ptr<LutSky>> luts_;
  std::vector<std::unique_ptr<WelkinSky>> welkins_;
  std::vector<std::unique_ptr<SkyForm>> forms_;
  std::vector<Method> methods_;
};

std::vector<SkyCase> chosenCases(const Options& options) {
  std::vector<SkyCase> cases = skyCases();
  std::erase_if(
      cases, [&](const SkyCase& one) { return !options.only.empty() && one.name != options.only; });
  return cases;
}

void renewTruth(const Options& options) {
  for (const SkyCase& one : chosenCases(options)) {
    const std::vector<SkyPixel> pixels =
        drawPixels(one, skyDepth(one, options.width, options.height), options.width, options.height,
                   options.pixels, options.seed);
    appendTruth(options.newTruth, one, pixels, skyTruth(one, pixels, options.paths, options.seed));
  }
}

int run(const Options& options) {
  if (!options.newTruth.empty()) {
    renewTruth(options);
    return 0;
  }
  Ordered report = reportHead(options.commit, false);
  report.erase("rows");
  report["rounds"] = options.rounds;
  std::printf(
      "| case | method | ms | CPU ms | time of lut's | CPU time of lut's | sky, %% | "
      "aerial, %% | beyond froxels, %% | transmittance, %% | first order: sky, %% | aerial, %% | "
      "beyond froxels, %% |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<SkyErrors> all;
  std::vector<std::string> names;
  Ordered cases = Ordered::array();
  size_t messages = 0;
  for (const SkyCase& one : chosenCases(options)) {
    Gpu gpu(options.validation);
    report["device"] = {{"name", gpu.properties().deviceName}, {"driver", gpu.driver()}};
    {
      Study study(gpu, one, options);
      cases.push_back(study.run(all));
      names = study.names();
    }
    for (const std::string& message : gpu.messages()) {
      std::fprintf(stderr, "%s\n", message.c_str());
      ++messages;
    }
  }
  report["size"] = {options.width, options.height};
  report["cases"] = cases;
  Ordered errors = Ordered::object();
  for (size_t i = 0; i < names.size(); ++i) {
    errors[names[i]] = errorsJson(all[i]);
  }
  report["errors"] = errors;
  writeJson(options.out, report);
  return messages == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Time and error of sky and aerial perspective beside those of the usual tables"};
  Options options;
  app.add_option("out", options.out, "JSON file to write")->required();
  app.add_option("--commit", options.commit, "what the report says was built");
  app.add_option("--case", options.only, "the only one to run");
  app.add_option("--method", options.methods, "the only ones beside lut");
  app.add_option("--truth", options.truth, "CSV file with the true radiance; else it is made anew");
  app.add_option("--new-truth", options.newTruth, "append to such a file, measure nothing");
  app.add_option("--width", options.width)->check(CLI::Range(8, 16384));
  app.add_option("--height", options.height)->check(CLI::Range(8, 16384));
  app.add_option("--pixels", options.pixels, "compared per case, of sky and of surfaces each")
      ->check(CLI::Range(1, 100000));
  app.add_option("--paths", options.paths, "Monte Carlo paths per pixel and channel")
      ->check(CLI::Range(2, 100000000));
  app.add_option("--seed", options.seed, "of pixels and paths, default 1");
  app.add_option("--rounds", options.rounds, "of timing, at least")->check(CLI::Range(1, 1000));
  app.add_flag("--validation", options.validation, "under the Vulkan validation layer");
  app.add_flag("--single-precision", options.singlePrecision,
               "tables of the other side; half as published else");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
