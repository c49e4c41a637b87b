// SPDX-License-Identifier: MIT
// A frame of this engine: two views side by side, the right one turned and narrower.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "cloud_stream.hpp"
#include "engine/screenshot.hpp"
#include "weather.hpp"

struct RendererOptions {
  uint32_t quality = WLK_QUALITY_MEDIUM;
  bool validate = false;
};

class Renderer {
 public:
  static constexpr uint32_t FRAMES_IN_FLIGHT = 3;

  Renderer(const SurfaceSource& surface, VkExtent2D size, const RendererOptions& options);
  ~Renderer();

  // `file`: where this frame's picture goes, or empty.
  void draw(VkExtent2D size, double hour, const Eye& eye, const std::string& file);
  // Whether the density has arrived and is drawn.
  bool cloudy() const { return cloudy_; }
  // Messages of the validation layer so far.
  uint32_t messages() const { return gpu_.messages(); }

 private:
  void rebuild(VkExtent2D size);
  void finish(VkCommandBuffer commands, uint32_t index, const std::string& file);
  VkExtent2D half() const;

  Gpu gpu_;
  Frames frames_;
  ScenePass scene_;
  TonePass tone_;
  std::optional<Swapchain> swapchain_;
  std::array<std::unique_ptr<ViewImages>, VIEWS> images_;
  CloudStream stream_;
  std::optional<Weather> weather_;
  bool cloudy_ = false;
};
