// SPDX-License-Identifier: MIT
// A Welkin context on the engine's device, and views recorded into the engine's command buffers.
#pragma once

#include <optional>
#include <vector>

#include "device.hpp"
#include "scene.hpp"

namespace engine {

// A view to record: what the engine puts in and in which formats.
struct Request {
  WlkView view{};
  VkExtent2D extent{};
  uint32_t composite = WLK_COMPOSITE_COMPUTE;
  VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
  VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;
  bool inPlace = true;       // COMPUTE: colorInput == color
  std::vector<float> color;  // RGBA
  std::vector<float> depth;  // device depth; empty: no depth image
  // A shadow map, layer after layer; empty: none.
  WlkLightShadow lightShadow{};
  std::vector<float> shadowMap;
  VkExtent2D shadowExtent{};
  VkFormat shadowFormat = VK_FORMAT_D32_SFLOAT;
};

// What the images hold afterwards, decoded.
struct Result {
  std::vector<float> color;  // of the input, if it is an image of its own: unchanged
  std::vector<float> output;
  std::vector<float> depth;
  std::vector<float> radiance;
  std::vector<float> transmittance;
};

// Images and buffers of one recorded view. No barrier stands between the engine's own copies and
// Welkin's commands: the states handed over are all the synchronisation there is.
class Shot {
 public:
  Shot(const Device& device, const Request& request);
  void record(VkCommandBuffer commands, WlkContext context) const;
  // After the device is done.
  Result result() const;
  // Before the images are destroyed.
  void forget(WlkContext context) const;

 private:
  struct Attachment {
    Image image;
    Buffer input;
    Buffer output;
    Attachment(const Device& device, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
               const std::vector<float>& values, uint32_t layers = 1);
    void read(VkCommandBuffer commands) const { image.read(commands, output); }
    std::vector<float> values() const;
  };
  void renderSeparate(VkCommandBuffer commands, WlkContext context, WlkVulkanViewTargets& t) const;

  Request request_;
  std::optional<Attachment> depth_;
  std::optional<Attachment> shadow_;
  std::optional<Attachment> color_;   // the engine's picture
  std::optional<Attachment> target_;  // COMPUTE that is not in place
  std::optional<Attachment> radiance_;
  std::optional<Attachment> transmittance_;
};

class Engine {
 public:
  explicit Engine(uint32_t framesInFlight = 3, bool uploadCloud = true);
  ~Engine();

  WlkContext context() const { return context_; }
  WlkVolume cloud() const { return scene_.cloud; }
  Device& device() { return device_; }
  // Prepared.
  welkin::View makeView(VkExtent2D extent, uint32_t composite, VkFormat format);
  // Frame `index`, with all frames up to `completed` complete.
  WlkResult beginFrame(uint64_t index, uint64_t completed) const;
  // Records, submits, waits and reads one view in a frame of its own.
  Result render(const Request& request, const WlkCamera& camera);

 private:
  Device device_;
  welkin::Context context_;
  Scene scene_;
  uint64_t frame_ = 0;
};

uint32_t targetFormatOf(VkFormat format);

}  // namespace engine
