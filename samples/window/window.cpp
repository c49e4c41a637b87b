// SPDX-License-Identifier: MIT
#include "window.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace {

constexpr double SPEED = 60.0;  // m/s
constexpr double FAST = 20.0;   // with shift
constexpr double RADIANS_PER_PIXEL = 0.004;
constexpr double HOURS_PER_SECOND = 1.0;
constexpr double STEEPEST = 1.55;  // rad: short of straight up, where yaw loses meaning

}  // namespace

Window::Window(const Size& size) {
  if (glfwInit() != GLFW_TRUE) {
    throw std::runtime_error("GLFW finds no display");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  window_ = glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), "Welkin",
                             nullptr, nullptr);
  if (window_ == nullptr) {
    glfwTerminate();
    throw std::runtime_error("GLFW makes no window");
  }
  time_ = glfwGetTime();
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

SurfaceSource Window::surfaceSource() const {
  SurfaceSource source;
  uint32_t count = 0;
  const char** needed = glfwGetRequiredInstanceExtensions(&count);
  if (needed == nullptr) {
    throw std::runtime_error("GLFW finds no Vulkan loader or no surface extension");
  }
  source.instanceExtensions.assign(needed, needed + count);
  source.create = [window = window_](VkInstance instance) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    check(glfwCreateWindowSurface(instance, window, nullptr, &surface), "glfwCreateWindowSurface");
    return surface;
  };
  return source;
}

bool Window::closed() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

VkExtent2D Window::extent() const {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  while ((width == 0 || height == 0) && !closed()) {
    glfwWaitEvents();
    glfwGetFramebufferSize(window_, &width, &height);
  }
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

void Window::resize(const Size& size) {
  glfwSetWindowSize(window_, static_cast<int>(size.width), static_cast<int>(size.height));
}

bool Window::pressed(int key) const {
  return keys_ && glfwGetKey(window_, key) == GLFW_PRESS;
}

bool Window::panelToggled() {
  const bool before = toggleDown_;
  toggleDown_ = glfwGetKey(window_, GLFW_KEY_F1) == GLFW_PRESS;
  return toggleDown_ && !before;
}

void Window::poll(Camera& camera, double& hour, const Captured& captured) {
  glfwPollEvents();
  keys_ = !captured.keys;
  if (pressed(GLFW_KEY_ESCAPE)) {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
  }
  const double now = glfwGetTime();
  const double seconds = std::min(now - time_, 0.5);  // a stall is no journey
  time_ = now;

  double x = 0.0;
  double y = 0.0;
  glfwGetCursorPos(window_, &x, &y);
  // Not with the press itself, of which the panel has not heard yet.
  const bool dragging =
      std::exchange(mouseDown_, glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS);
  if (dragging && mouseDown_ && !captured.mouse) {
    camera.yaw -= (x - mouseX_) * RADIANS_PER_PIXEL;
    camera.pitch -= (y - mouseY_) * RADIANS_PER_PIXEL;
    camera.pitch = std::clamp(camera.pitch, -STEEPEST, STEEPEST);
  }
  mouseX_ = x;
  mouseY_ = y;

  const auto axis = [this](int positive, int negative) {
    return (pressed(positive) ? 1.0 : 0.0) - (pressed(negative) ? 1.0 : 0.0);
  };
  const double step = SPEED * seconds * (pressed(GLFW_KEY_LEFT_SHIFT) ? FAST : 1.0);
  camera.position += camera.forward() * (step * axis(GLFW_KEY_W, GLFW_KEY_S));
  camera.position += camera.right() * (step * axis(GLFW_KEY_D, GLFW_KEY_A));
  camera.position.y += step * axis(GLFW_KEY_E, GLFW_KEY_Q);
  camera.position.y = std::max(camera.position.y, 2.0);
  hour += HOURS_PER_SECOND * seconds * axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT);
  hour = std::fmod(hour + 24.0, 24.0);
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}
