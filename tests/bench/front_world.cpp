// SPDX-License-Identifier: MIT
#include "bench/front_world.hpp"

#include <mutex>

namespace bench {
namespace {

host::Scene scaled(host::Scene scene, uint32_t scale) {
  scene.view.width *= scale;
  scene.view.height *= scale;
  return scene;
}

}  // namespace

World::World(const Case& one, bool analytic, bool ambient) : scene_(sceneOf(one, analytic)) {
  if (!ambient) {
    scene_.ambient.mode = WLK_AMBIENT_OFF;
  }
  {
    // Contexts of a case are made side by side, but their driver's threads are told apart by the
    // order in which they are made (driver_threads.hpp).
    static std::mutex oneByOne;
    const std::lock_guard<std::mutex> lock(oneByOne);
    context_ = host::makeHeadlessContext(false, "", log_);
  }
  host::applyWorld(context_.get(), scene_);
  host::applyBodies(context_.get(), scene_, [](const std::string&) {});
}

WlkView World::addView(const WlkQuality& quality, uint32_t scale) {
  host::Scene scene = scaled(scene_, scale);
  scene.quality = quality;
  return host::applyView(context_.get(), scene);
}

void World::removeView(WlkView view) {
  host::check(wlkDestroyView(context_.get(), view), "wlkDestroyView");
}

void World::prepare() {
  host::check(wlkPrepare(context_.get()), scene_.file, "");
}

void World::render(WlkView view, const host::RasterResult& opaque) {
  auto targets = host::make<WlkHeadlessInputs>();
  targets.color = opaque.color.rgba.empty() ? nullptr : opaque.color.rgba.data();
  targets.colorSize = opaque.color.rgba.size() * sizeof(float);
  targets.depth = opaque.depth.values.empty() ? nullptr : opaque.depth.values.data();
  targets.depthSize = opaque.depth.values.size() * sizeof(float);
  host::check(wlkRenderHeadless(context_.get(), view, &targets), scene_.file, "");
}

host::Image World::read(WlkView view) const {
  host::Image image{scene_.view.width, scene_.view.height, {}};
  image.rgba.resize(image.pixelCount() * 4);
  auto data = host::make<WlkImageData>();
  data.data = image.rgba.data();
  data.dataSize = image.rgba.size() * sizeof(float);
  host::check(wlkReadback(context_.get(), view, &data), "wlkReadback");
  return image;
}

FrameCounts World::counts(WlkView view) const {
  auto stats = host::make<WlkFrameStats>();
  uint32_t count = 0;
  host::check(wlkGetFrameStats(context_.get(), view, &stats, &count, sizeof(WlkPassStats), nullptr),
              "wlkGetFrameStats");
  std::vector<WlkPassStats> passes(count);
  host::check(
      wlkGetFrameStats(context_.get(), view, &stats, &count, sizeof(WlkPassStats), passes.data()),
      "wlkGetFrameStats");
  FrameCounts counts;
  counts.dispatches = stats.dispatches;
  counts.draws = stats.draws;
  counts.barriers = stats.barriers;
  counts.deviceMemory = stats.deviceMemory;
  counts.hostMemory = stats.hostMemory;
  counts.nonFinite = stats.nonFinitePixels;
  for (const WlkPassStats& pass : passes) {
    counts.invocations += pass.invocations;
    counts.gpuTime_ns += pass.gpuTime_ns;
    if (pass.pass == WLK_PASS_LIGHT_SLICES || pass.pass == WLK_PASS_EYE_SLICES) {
      counts.volumeInvocations += pass.invocations;
    }
  }
  return counts;
}

host::RasterResult World::makeOpaque(uint32_t scale) const {
  return host::makeOpaque(context_.get(), scaled(scene_, scale), [](const std::string&) {});
}

WlkCapabilities World::capabilities() const {
  auto capabilities = host::make<WlkCapabilities>();
  host::check(wlkGetCapabilities(context_.get(), &capabilities), "wlkGetCapabilities");
  return capabilities;
}

WlkErrorEstimate World::estimate(WlkView view) const {
  auto estimate = host::make<WlkErrorEstimate>();
  host::check(wlkGetErrorEstimate(context_.get(), view, &estimate), "wlkGetErrorEstimate");
  return estimate;
}

}  // namespace bench
