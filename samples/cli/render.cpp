// SPDX-License-Identifier: MIT
// welkin render: a scene file to a picture.
#include <chrono>
#include <memory>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "cli/statistics.hpp"
#include "common/apply.hpp"
#include "common/error.hpp"

namespace cli {
namespace {

struct RenderOptions {
  std::string scene;
  std::string exr;
  std::string png;
  std::string size;
  std::string quality;
  std::string stats;
  std::string device;
  std::vector<std::string> assignments;
  uint32_t frames = 1;
  bool validate = false;
};

class Stopwatch {
 public:
  [[nodiscard]] double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> lap = now - last_;
    last_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// --quality is short for an assignment.
std::vector<std::string> assignmentsOf(const RenderOptions& options) {
  std::vector<std::string> assignments = options.assignments;
  if (!options.quality.empty()) {
    assignments.push_back("quality.level=" + options.quality);
  }
  return assignments;
}

host::Image readback(WlkContext context, WlkView view, const host::Scene& scene, uint32_t which) {
  host::Image image{scene.view.width, scene.view.height, {}};
  image.rgba.resize(image.pixelCount() * 4);
  auto data = host::make<WlkImageData>();
  data.image = which;
  data.data = image.rgba.data();
  data.dataSize = image.rgba.size() * sizeof(float);
  host::check(wlkReadback(context, view, &data), "wlkReadback");
  return image;
}

// What a host does with separate images: colour * transmittance + radiance.
host::Image composite(const host::Image& radiance, const host::Image& transmittance,
                      const host::Image& color) {
  host::Image image = radiance;
  for (size_t i = 0; i < image.rgba.size() && !color.rgba.empty(); ++i) {
    if (i % 4 != 3) {
      image.rgba[i] += color.rgba[i] * transmittance.rgba[i];
    }
  }
  return image;
}

void writePictures(const RenderOptions& options, WlkContext context, WlkView view,
                   const host::Scene& scene, const host::Image& opaque) {
  host::Image picture;
  if (scene.view.composite == WLK_COMPOSITE_SEPARATE) {
    const host::Image radiance = readback(context, view, scene, WLK_IMAGE_RADIANCE);
    const host::Image transmittance = readback(context, view, scene, WLK_IMAGE_TRANSMITTANCE);
    host::writeExr(options.exr, radiance, &transmittance);
    picture = composite(radiance, transmittance, opaque);
  } else {
    picture = readback(context, view, scene, WLK_IMAGE_COLOR);
    host::writeExr(options.exr, picture);
  }
  if (!options.png.empty()) {
    host::writePng(options.png, picture, pngStops(scene), scene.png.toneMap);
  }
}

void run(const RenderOptions& options) {
  const host::Scene scene = readSizedScene(options.scene, assignmentsOf(options), options.size);
  checkFolders({options.exr, options.png, options.stats});
  const ProgressLine line;
  const host::Progress progress = [&](const std::string& text) { line.show(text); };
  RenderTimes times;
  Stopwatch total;
  Stopwatch watch;

  host::LogCounter log;
  progress("device");
  const host::ContextPtr owner = host::makeHeadlessContext(options.validate, options.device, log);
  WlkContext context = owner.get();
  host::applyWorld(context, scene);
  host::applyBodies(context, scene, progress);
  const WlkView view = host::applyView(context, scene);
  const host::RasterResult opaque = host::makeOpaque(context, scene, progress);
  const host::ShadowMap shadow = host::makeShadowMap(scene, progress);
  times.load_ms = watch.lap_ms();

  progress("pipelines and tables");
  host::check(wlkPrepare(context), options.scene, "");
  times.prepare_ms = watch.lap_ms();

  auto targets = host::make<WlkHeadlessInputs>();
  targets.color = opaque.color.rgba.empty() ? nullptr : opaque.color.rgba.data();
  targets.colorSize = opaque.color.rgba.size() * sizeof(float);
  targets.depth = opaque.depth.values.empty() ? nullptr : opaque.depth.values.data();
  targets.depthSize = opaque.depth.values.size() * sizeof(float);
  if (!shadow.depth.empty()) {
    targets.lightShadow = &shadow.place;
    targets.shadowDepth = shadow.depth.data();
    targets.shadowDepthSize = shadow.depth.size() * sizeof(float);
    targets.shadowWidth = targets.shadowHeight = shadow.size;
  }
  for (uint32_t frame = 0; frame < options.frames; ++frame) {
    progress("frame " + std::to_string(frame + 1) + " of " + std::to_string(options.frames));
    host::check(wlkRenderHeadless(context, view, &targets), options.scene, "");
    times.frames_ms.push_back(watch.lap_ms());
  }
  progress("writing");
  writePictures(options, context, view, scene, opaque.color);
  times.total_ms = total.lap_ms();
  if (!options.stats.empty()) {
    writeStatistics(options.stats, context, view, scene, times);
  }
  if (options.validate && log.problems > 0) {
    throw host::HostError(std::to_string(log.problems) + " validation messages");
  }
}

}  // namespace

void addRender(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Render a scene file to an EXR picture");
  const auto options = std::make_shared<RenderOptions>();
  command->add_option("SCENE", options->scene, "Scene (JSON), see docs/scene-format.md")
      ->required();
  command->add_option("-o,--output", options->exr, "Picture (EXR, linear)")->required();
  command->add_option("--png", options->png, "The same, tone mapped");
  command->add_option("--size", options->size, "WxH in pixels, over the scene's");
  command->add_option("--quality", options->quality, "low, medium, high or ultra");
  command->add_option("--set", options->assignments, "key.path=value, over the scene")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--stats", options->stats, "Write times and passes to this file (JSON)");
  command->add_option("--frames", options->frames, "Render this often; the last one is kept")
      ->check(CLI::Range(1u, 1000000u));
  command->add_option("--device", options->device, "First device whose name contains this");
  command->add_flag("--validate", options->validate,
                    "Run under the Vulkan validation layer; any message is a failure");
  command->callback([options] { run(*options); });
}

}  // namespace cli
