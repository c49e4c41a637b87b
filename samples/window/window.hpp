// SPDX-License-Identifier: MIT
// The window, and what the user does in it.
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>

#include "camera.hpp"
#include "engine/gpu.hpp"
#include "settings.hpp"

struct GLFWwindow;

class Window {
 public:
  explicit Window(const Size& size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  SurfaceSource surfaceSource() const;
  bool closed() const;
  // Pixels; waits while the window is minimised.
  VkExtent2D extent() const;
  // As if the user had dragged its frame.
  void resize(const Size& size);
  // Whose the input is: the panel's where it has the pointer or a text field.
  struct Captured {
    bool mouse = false;
    bool keys = false;
  };
  // Moves the camera and the clock (hours) by the input since the last call.
  void poll(Camera& camera, double& hour, const Captured& captured);
  // Whether F1 went down since the last call.
  bool panelToggled();
  void setTitle(const std::string& title);

 private:
  bool pressed(int key) const;
  GLFWwindow* window_ = nullptr;
  double time_ = 0.0;
  double mouseX_ = 0.0;
  double mouseY_ = 0.0;
  bool keys_ = true;  // the world has the keyboard
  bool mouseDown_ = false;
  bool toggleDown_ = false;
};
