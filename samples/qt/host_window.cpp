// SPDX-License-Identifier: MIT
#include "host_window.hpp"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string_view>

namespace {

constexpr double RADIANS_PER_PIXEL = 0.004;
constexpr double STEP_m = 30.0;
constexpr double STEEPEST = 1.5;  // rad

// Surface extensions that Qt's platforms use; those that the loader offers are enabled.
std::vector<const char*> surfaceExtensions() {
  constexpr std::array known{"VK_KHR_surface", "VK_KHR_xcb_surface", "VK_KHR_wayland_surface",
                             "VK_KHR_win32_surface"};
  uint32_t count = 0;
  check(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr),
        "vkEnumerateInstanceExtensionProperties");
  std::vector<VkExtensionProperties> offered(count);
  check(vkEnumerateInstanceExtensionProperties(nullptr, &count, offered.data()),
        "vkEnumerateInstanceExtensionProperties");
  std::vector<const char*> names;
  std::copy_if(known.begin(), known.end(), std::back_inserter(names), [&](std::string_view name) {
    return std::any_of(offered.begin(), offered.end(), [&](const VkExtensionProperties& extension) {
      return name == extension.extensionName;
    });
  });
  return names;
}

}  // namespace

HostWindow::HostWindow(const HostOptions& options) : options_(options) {
  setSurfaceType(QSurface::VulkanSurface);
  setTitle("Welkin in Qt");
}

HostWindow::~HostWindow() {
  stop();
  destroy();  // and with it the surface
  instance_.destroy();
  if (vulkan_ != VK_NULL_HANDLE) {
    vkDestroyInstance(vulkan_, nullptr);
  }
}

// Before Qt destroys the surface.
void HostWindow::stop() {
  if (renderer_) {
    result_ = std::max(result_, renderer_->messages() == 0 ? 0 : 1);
    renderer_.reset();
  }
}

VkExtent2D HostWindow::pixels() const {
  const QSize size = this->size() * devicePixelRatio();
  return {static_cast<uint32_t>(std::max(size.width(), 1)),
          static_cast<uint32_t>(std::max(size.height(), 1))};
}

// The engine's instance, adopted by Qt for the surface, which Qt destroys with the window.
void HostWindow::start() {
  SurfaceSource source;
  source.instanceExtensions = surfaceExtensions();
  source.toolkitDestroys = true;
  source.create = [this](VkInstance instance) {
    vulkan_ = instance;
    instance_.setVkInstance(instance);
    if (!instance_.create()) {
      throw std::runtime_error("Qt does not take the Vulkan instance");
    }
    setVulkanInstance(&instance_);
    VkSurfaceKHR surface = QVulkanInstance::surfaceForWindow(this);
    if (surface == VK_NULL_HANDLE) {
      throw std::runtime_error("Qt makes no Vulkan surface on this platform");
    }
    return surface;
  };
  renderer_ = std::make_unique<Renderer>(source, pixels(), options_.renderer);
}

void HostWindow::draw() {
  try {
    if (!renderer_) {
      start();
    }
    // The last of the frames, which are counted from the first one with clouds.
    const bool last = options_.frames > 0 && drawn_ + 1 == options_.frames && renderer_->cloudy();
    renderer_->draw(pixels(), options_.hour, eye_,
                    last ? options_.screenshot.toStdString() : std::string());
    drawn_ += renderer_->cloudy() ? 1 : 0;
    if (options_.frames == 0 || drawn_ < options_.frames) {
      requestUpdate();
      return;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "welkin_qt: %s\n", error.what());
    result_ = 2;
  }
  QGuiApplication::quit();
}

void HostWindow::exposeEvent(QExposeEvent*) {
  if (isExposed()) {
    requestUpdate();
  }
}

bool HostWindow::event(QEvent* event) {
  if (event->type() == QEvent::UpdateRequest) {
    draw();
  }
  if (event->type() == QEvent::PlatformSurface &&
      static_cast<QPlatformSurfaceEvent*>(event)->surfaceEventType() ==
          QPlatformSurfaceEvent::SurfaceAboutToBeDestroyed) {
    stop();
  }
  return QWindow::event(event);
}

void HostWindow::keyPressEvent(QKeyEvent* event) {
  const glm::dmat3 axes = glm::transpose(eye_.viewFromWorld());
  switch (event->key()) {
    case Qt::Key_Escape:
      close();
      break;
    case Qt::Key_W:
      eye_.position += axes[2] * STEP_m;
      break;
    case Qt::Key_S:
      eye_.position -= axes[2] * STEP_m;
      break;
    case Qt::Key_D:
      eye_.position += axes[0] * STEP_m;
      break;
    case Qt::Key_A:
      eye_.position -= axes[0] * STEP_m;
      break;
    case Qt::Key_Right:
      options_.hour = std::fmod(options_.hour + 0.1, 24.0);
      break;
    case Qt::Key_Left:
      options_.hour = std::fmod(options_.hour + 23.9, 24.0);
      break;
    default:
      break;
  }
  eye_.position.z = std::max(eye_.position.z, 2.0);
}

void HostWindow::mousePressEvent(QMouseEvent* event) {
  mouse_ = event->position();
}

void HostWindow::mouseMoveEvent(QMouseEvent* event) {
  const QPointF moved = event->position() - mouse_;
  mouse_ = event->position();
  eye_.yaw -= moved.x() * RADIANS_PER_PIXEL;
  eye_.pitch = std::clamp(eye_.pitch + moved.y() * RADIANS_PER_PIXEL, -STEEPEST, STEEPEST);
}
