// SPDX-License-Identifier: MIT
// A small Vulkan engine that shows Welkin's atmosphere in a window. Its frame:
//   OpaquePass   the engine's meshes into colour and depth
//   Atmosphere   Welkin on top of both, recorded into the same command buffer
//   PresentPass  tone mapping into the window
#include <cstdio>
#include <exception>
#include <optional>

#include "atmosphere.hpp"
#include "frames.hpp"
#include "opaque_pass.hpp"
#include "options.hpp"
#include "present_pass.hpp"
#include "screenshot.hpp"
#include "swapchain.hpp"
#include "window.hpp"

namespace {

class Engine {
 public:
  explicit Engine(const Options& options)
      : options_(options),
        window_(options.width, options.height),
        gpu_(window_.handle(), options.validate),
        frames_(gpu_),
        opaque_(gpu_),
        present_(gpu_, displayFormat(gpu_), options.composite),
        hour_(options.hour) {
    swapchain_.emplace(gpu_, window_.extent());
    targets_.emplace(gpu_, swapchain_->extent(), options.composite);
    present_.setTargets(*targets_);
    atmosphere_.emplace(gpu_, swapchain_->extent(), options.composite, options.quality,
                        Frames::IN_FLIGHT);
  }

  // 0, or 1 if the validation layer reported something.
  int run() {
    while (!window_.closed() && (options_.frames == 0 || frames_.index() < options_.frames)) {
      window_.poll(camera_, hour_);
      drawFrame();
    }
    gpu_.waitIdle();
    if (screenshot_) {
      screenshot_->save(options_.screenshot);
    }
    atmosphere_.reset();
    return gpu_.messages() == 0 ? 0 : 1;
  }

 private:
  void drawFrame() {
    frames_.wait();
    const std::optional<uint32_t> index = swapchain_->acquire(frames_.imageReady());
    if (!index) {
      resize();
      return;
    }
    atmosphere_->setHour(hour_);
    VkCommandBuffer commands = frames_.begin();
    opaque_.record(commands, *targets_, camera_, atmosphere_->lightingAt(camera_.position));
    atmosphere_->record(commands, frames_, camera_, *targets_);
    present_.record(commands, swapchain_->image(*index), swapchain_->view(*index),
                    swapchain_->extent());
    finishImage(commands, swapchain_->image(*index));
    frames_.submit(swapchain_->rendered(*index));
    if (!swapchain_->present(*index)) {
      resize();
    }
    showTitle();
  }

  // Copies the last frame if asked to, and hands the image to the presentation engine.
  void finishImage(VkCommandBuffer commands, VkImage image) {
    constexpr ImageState presented{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 0, VK_PIPELINE_STAGE_2_NONE,
                                   VK_ACCESS_2_NONE};
    ImageState state = COLOR_ATTACHMENT;
    if (!options_.screenshot.empty() && frames_.index() == options_.frames) {
      screenshot_.emplace(gpu_, swapchain_->extent(), swapchain_->format());
      screenshot_->record(commands, image);
      state = Screenshot::TRANSFER_SOURCE;
    }
    transition(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, state, presented);
  }

  void resize() {
    gpu_.waitIdle();
    swapchain_.reset();  // a surface has one swapchain at a time
    swapchain_.emplace(gpu_, window_.extent());
    atmosphere_->forget(*targets_);
    targets_.emplace(gpu_, swapchain_->extent(), options_.composite);
    present_.setTargets(*targets_);
    atmosphere_->resize(swapchain_->extent());
  }

  void showTitle() {
    char title[64];
    std::snprintf(title, sizeof title, "Welkin %02d:%02d", static_cast<int>(hour_),
                  static_cast<int>(hour_ * 60.0) % 60);
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
  std::optional<Atmosphere> atmosphere_;
  std::optional<Screenshot> screenshot_;
  Camera camera_;
  double hour_;
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
