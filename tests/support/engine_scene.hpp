// SPDX-License-Identifier: MIT
// A scene in an engine-device context on a spied device: renders a frame of one view and tells what
// the library recorded.
#pragma once

#include <welkin/welkin_vulkan.h>

#include <functional>
#include <optional>
#include <span>

#include "support/headless_scene.hpp"
#include "support/spy_device.hpp"

namespace welkin::test {

struct FrameCounts {
  VulkanCounts update;      // by wlkVulkanCmdUpdate
  VulkanCounts view;        // by wlkVulkanCmdRenderView
  double cpuSeconds = 0.0;  // of the calling thread in both
};

// What a context is made from on a spied device.
WlkVulkanDeviceInfo describeDevice(const SpyDevice& spy);

// The spied device comes first in construction and last in destruction.
struct SpiedEngine {
  explicit SpiedEngine(bool validation) : spy(validation) {}
  SpyDevice spy;
};

class EngineScene : private SpiedEngine, public SceneBuilder {
 public:
  // The target has the view's size and RGBA32F.
  explicit EngineScene(const SceneOptions& options = {});
  ~EngineScene();

  const SpyDevice& device() const { return spy; }
  const SpyImage& target() const { return *target_; }
  uint64_t frame() const { return frame_; }
  // Composites onto the target itself, which keeps what it has where nothing is drawn.
  bool inPlace = false;
  // Frames record wlkVulkanCmdUpdate.
  bool update = true;
  // Else frames are recorded and thrown away: their pictures take minutes where counts take none.
  bool submit = true;
  // A shadow map of the engine; both or none.
  const WlkLightShadow* lightShadow = nullptr;
  const WlkVulkanImage* shadowMap = nullptr;
  // More targets for the frames to come.
  std::function<void(WlkVulkanViewTargets&)> addTargets;
  // Called between the views of one frame.
  std::function<void()> betweenViews;

  static WlkVulkanImage describe(const SpyImage& image, VkImageLayout layout);
  // What the frame's wlkVulkanCmdRenderView gets; `color` must live for the call.
  WlkVulkanViewTargets targets(const WlkVulkanImage& color) const;
  // wlkBeginFrame, update and view in one command buffer, submitted and waited for.
  FrameCounts renderFrame();
  // The same of several views, one after the other on the same target.
  FrameCounts renderFrames(std::span<const WlkView> views);
  Image read() const;

 private:
  std::optional<SpyImage> target_;
  uint64_t frame_ = 0;
};

}  // namespace welkin::test
