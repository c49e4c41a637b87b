// SPDX-License-Identifier: MIT
// A small Vulkan engine that shows Welkin's atmosphere in a window. Its frame:
//   OpaquePass   the engine's meshes into colour and depth
//   Atmosphere   Welkin on top of both, recorded into the same command buffer
//   PresentPass  tone mapping into the window
//   PanelPass    the control panel, if it is shown
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "atmosphere.hpp"
#include "engine/frames.hpp"
#include "engine/screenshot.hpp"
#include "engine/swapchain.hpp"
#include "opaque_pass.hpp"
#include "options.hpp"
#include "panel_pass.hpp"
#include "present_pass.hpp"
#include "scene_file.hpp"
#include "window.hpp"

namespace {

constexpr uint32_t FRAMES_IN_FLIGHT = 2;

class Engine {
 public:
  explicit Engine(const Options& options)
      : options_(options),
        window_(options.size),
        gpu_(window_.surfaceSource(), options.validate),
        frames_(gpu_, FRAMES_IN_FLIGHT),
        opaque_(gpu_),
        present_(gpu_, displayFormat(gpu_), options.composite),
        settings_(options.settings),
        script_(options.script),
        panelShown_(options.panel || options.frames == 0) {
    swapchain_.emplace(gpu_, window_.extent());
    targets_.emplace(gpu_, swapchain_->extent(), options.composite);
    present_.setTargets(*targets_);
    panelPass_.emplace(gpu_, window_.handle(), *swapchain_);
    if (options.scene.empty()) {
      makeAtmosphere(nullptr);
    } else {
      loadScene(options.scene);
    }
  }

  // 0, or 1 if the validation layer reported something.
  int run() {
    while (!window_.closed() && (options_.frames == 0 || frames_.index() < options_.frames)) {
      window_.poll(
          camera_, settings_.hour,
          {panelShown_ && panelPass_->wantsMouse(), panelShown_ && panelPass_->wantsKeys()});
      panelShown_ = panelShown_ != window_.panelToggled();
      while (const Action* action = script_.next(frames_.index() + 1)) {
        PanelRequest request;
        action->perform(settings_, request);
        serve(request);
      }
      serve(drawPanel());
      drawFrame();
    }
    gpu_.waitIdle();
    atmosphere_.reset();
    return gpu_.messages() == 0 ? 0 : 1;
  }

 private:
  void makeAtmosphere(const host::Scene* scene) {
    // The new one first: if it fails the old one stays.
    std::unique_ptr<Atmosphere> made = std::make_unique<Atmosphere>(
        gpu_, swapchain_->extent(), options_.composite, settings_, FRAMES_IN_FLIGHT, scene);
    gpu_.waitIdle();
    atmosphere_ = std::move(made);
  }

  // Throws what parseScene and Welkin throw.
  void loadScene(const std::string& file) {
    const host::Scene scene = readScene(file);
    const uint32_t before = std::exchange(settings_.quality, scene.quality.level);
    try {
      makeAtmosphere(&scene);
    } catch (...) {
      settings_.quality = before;
      throw;
    }
    const host::Vec3& eye = scene.camera.position;
    const host::Vec3& forward = scene.camera.forward;
    camera_.position = {eye.x, eye.y, eye.z};
    camera_.yaw = std::atan2(-forward.x, -forward.z);
    camera_.pitch = std::asin(std::clamp(forward.y, -1.0, 1.0));
  }

  PanelRequest drawPanel() {
    const auto now = std::chrono::steady_clock::now();
    panel_.addFrame(std::chrono::duration<float, std::milli>(now - last_).count());
    last_ = now;
    if (!panelShown_) {
      return {};
    }
    panelPass_->begin();
    return panel_.draw(settings_, atmosphere_->report(), atmosphere_->ownClouds());
  }

  void serve(const PanelRequest& request) {
    if (!request.screenshot.empty()) {
      wanted_.push_back(request.screenshot);
    }
    if (request.size) {
      window_.resize(*request.size);
    }
    if (request.report) {
      std::printf("%s\n", describe(atmosphere_->report()).c_str());
    }
    try {
      if (request.clouds && !atmosphere_->ownClouds()) {  // the panel does not offer it either
        throw std::runtime_error("the scene has clouds of its own");
      }
      if (request.clouds) {
        atmosphere_->setClouds(settings_);
      }
      if (request.quality) {
        atmosphere_->setQuality(settings_);
      }
      if (!request.scene.empty()) {
        loadScene(request.scene);
        panel_.setMessage(request.scene);
      }
    } catch (const std::exception& error) {  // the user may have mistyped
      std::fprintf(stderr, "welkin_window: %s\n", error.what());
      panel_.setMessage(error.what());
    }
  }

  void drawFrame() {
    frames_.wait();
    if (!swapchain_->fits(window_.extent())) {
      resize();
    }
    const std::optional<uint32_t> index = swapchain_->acquire(frames_.imageReady());
    if (!index) {
      if (panelShown_) {
        panelPass_->skip();
      }
      resize();
      return;
    }
    atmosphere_->setHour(settings_.hour);
    VkCommandBuffer commands = frames_.begin();
    opaque_.record(commands, *targets_, camera_, atmosphere_->lightingAt(camera_.position));
    atmosphere_->record(commands, frames_, camera_, *targets_);
    present_.record(commands, swapchain_->image(*index), swapchain_->view(*index),
                    swapchain_->extent());
    if (panelShown_) {
      panelPass_->record(commands, *index);
    }
    finishImage(commands, swapchain_->image(*index));
    frames_.submit(swapchain_->rendered(*index));
    if (!swapchain_->present(*index)) {
      resize();
    }
    if (screenshot_) {
      gpu_.waitIdle();
      saveScreenshot();
    }
    showTitle();
  }

  // Copies the frame if asked to, and hands the image to the presentation engine.
  void finishImage(VkCommandBuffer commands, VkImage image) {
    constexpr ImageState presented{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 0, VK_PIPELINE_STAGE_2_NONE,
                                   VK_ACCESS_2_NONE};
    ImageState state = COLOR_ATTACHMENT;
    if (!wanted_.empty()) {
      screenshot_.emplace(gpu_, swapchain_->extent(), swapchain_->format());
      screenshot_->record(commands, image);
      state = Screenshot::TRANSFER_SOURCE;
    }
    transition(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, state, presented);
  }

  // Call when the GPU is done with the frame.
  void saveScreenshot() {
    for (const std::string& file : std::exchange(wanted_, {})) {
      screenshot_->save(file);
      panel_.setMessage(file);
    }
    screenshot_.reset();
  }

  void resize() {
    gpu_.waitIdle();
    swapchain_.reset();  // a surface has one swapchain at a time
    swapchain_.emplace(gpu_, window_.extent());
    atmosphere_->forget(*targets_);
    targets_.emplace(gpu_, swapchain_->extent(), options_.composite);
    present_.setTargets(*targets_);
    panelPass_->setSwapchain(*swapchain_);
    atmosphere_->resize(swapchain_->extent());
  }

  void showTitle() {
    char title[64];
    std::snprintf(title, sizeof title, "Welkin %02d:%02d", static_cast<int>(settings_.hour),
                  static_cast<int>(settings_.hour * 60.0) % 60);
    window_.setTitle(title);
  }

  Options options_;
  Window window_;
  Gpu gpu_;
  Frames frames_;
  OpaquePass opaque_;
  PresentPass present_;
  std::optional<Swapchain> swapchain_;
  std::optional<Targets> targets_;
  std::optional<PanelPass> panelPass_;
  std::unique_ptr<Atmosphere> atmosphere_;
  std::optional<Screenshot> screenshot_;
  Panel panel_;
  Camera camera_;
  Settings settings_;
  Script script_;
  bool panelShown_;
  std::vector<std::string> wanted_;  // files for a picture of this frame
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

int main(int count, char** arguments) {
  try {
    return Engine(parseOptions(count, arguments)).run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "welkin_window: %s\n", error.what());
    return 2;
  }
}
