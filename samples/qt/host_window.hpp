// SPDX-License-Identifier: MIT
// A QWindow on which Qt makes the Vulkan surface; Qt's event loop asks for the frames.
#pragma once

// Vulkan's functions before Qt, which includes Vulkan's header without them.
#include <vulkan/vulkan.h>
// Keeps the order.
#include <QVulkanInstance>
#include <QWindow>
#include <memory>

#include "renderer.hpp"

struct HostOptions {
  RendererOptions renderer;
  int frames = 0;  // with clouds in them, then quit; 0: until the window is closed
  double hour = 10.0;
  QString screenshot;
};

class HostWindow : public QWindow {
 public:
  explicit HostWindow(const HostOptions& options);
  ~HostWindow() override;

  // 0; 1 if the validation layer reported something; 2 after a failure.
  int result() const { return result_; }

 protected:
  void exposeEvent(QExposeEvent* event) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  void start();
  void draw();
  void stop();
  VkExtent2D pixels() const;

  HostOptions options_;
  VkInstance vulkan_ = VK_NULL_HANDLE;
  QVulkanInstance instance_;
  std::unique_ptr<Renderer> renderer_;
  Eye eye_;
  QPointF mouse_;
  int drawn_ = 0;
  int result_ = 0;
};
