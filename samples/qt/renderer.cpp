// SPDX-License-Identifier: MIT
#include "renderer.hpp"

#include <algorithm>

Renderer::Renderer(const SurfaceSource& surface, VkExtent2D size, const RendererOptions& options)
    : gpu_(surface, options.validate),
      frames_(gpu_, FRAMES_IN_FLIGHT),
      scene_(gpu_),
      tone_(gpu_, displayFormat(gpu_)),
      stream_(gpu_) {
  rebuild(size);
  weather_.emplace(gpu_, half(), FRAMES_IN_FLIGHT, options.quality);
}

Renderer::~Renderer() {
  gpu_.waitIdle();
  weather_.reset();  // before the density that it reads
}

VkExtent2D Renderer::half() const {
  return {std::max(swapchain_->extent().width / VIEWS, 1u), swapchain_->extent().height};
}

void Renderer::rebuild(VkExtent2D size) {
  gpu_.waitIdle();
  swapchain_.reset();  // a surface has one swapchain at a time
  swapchain_.emplace(gpu_, size);
  for (uint32_t view = 0; view < VIEWS; ++view) {
    if (images_[view]) {
      weather_->forget(images_[view]->color);
      weather_->forget(images_[view]->depth);
    }
    images_[view] = std::make_unique<ViewImages>(gpu_, half(), scene_.renderPass());
    tone_.setPicture(view, images_[view]->color);
  }
  if (weather_) {
    weather_->resize(half());
  }
}

void Renderer::draw(VkExtent2D size, double hour, const Eye& eye, const std::string& file) {
  frames_.wait();
  if (!swapchain_->fits(size)) {
    rebuild(size);
  }
  const std::optional<uint32_t> index = swapchain_->acquire(frames_.imageReady());
  if (!index) {
    rebuild(size);
    return;
  }
  stream_.check();
  if (!cloudy_ && stream_.image() != nullptr) {
    weather_->addClouds(*stream_.image());
    cloudy_ = true;
  }
  weather_->setHour(hour);
  VkCommandBuffer commands = frames_.begin();
  std::array<Eye, VIEWS> eyes{eye, eye};
  eyes[1].yaw += 0.35;
  eyes[1].verticalFov = 0.6;
  for (uint32_t view = 0; view < VIEWS; ++view) {
    scene_.record(commands, *images_[view], eyes[view], weather_->lightAt(eye.position));
  }
  weather_->begin(commands, frames_);
  for (uint32_t view = 0; view < VIEWS; ++view) {
    weather_->record(commands, view, eyes[view], *images_[view]);
  }
  tone_.record(commands, *swapchain_, *index, half());
  finish(commands, *index, file);
}

void Renderer::finish(VkCommandBuffer commands, uint32_t index, const std::string& file) {
  constexpr ImageState presented{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 0, VK_PIPELINE_STAGE_2_NONE,
                                 VK_ACCESS_2_NONE};
  ImageState state = COLOR_ATTACHMENT;
  std::optional<Screenshot> screenshot;
  if (!file.empty()) {
    screenshot.emplace(gpu_, swapchain_->extent(), swapchain_->format());
    screenshot->record(commands, swapchain_->image(index));
    state = Screenshot::TRANSFER_SOURCE;
  }
  transition(commands, swapchain_->image(index), VK_IMAGE_ASPECT_COLOR_BIT, state, presented);
  frames_.submit(swapchain_->rendered(index));
  const VkExtent2D extent = swapchain_->extent();
  const bool fits = swapchain_->present(index);
  if (screenshot) {
    gpu_.waitIdle();
    screenshot->save(file);
  }
  if (!fits) {
    rebuild(extent);
  }
}
