// SPDX-License-Identifier: MIT
// What an engine does with one context, from creation to destruction, in steps that a test lets
// fail one by one. Targets and device are shared by all lives of a test: nothing may stay in them.
#pragma once

#include <functional>
#include <vector>

#include "stress/abuse.hpp"
#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"

namespace welkin::test {

struct Engine {
  static constexpr uint32_t WIDTH = 16;
  static constexpr uint32_t HEIGHT = 12;
  static constexpr uint32_t MAP_SIZE = 16;
  static constexpr VkExtent3D FROXELS{8, 6, 4};

  Engine();
  std::vector<float> picture() const;

  SpyDevice spy;
  SpyImage aerial{spy, VK_FORMAT_R32G32B32A32_SFLOAT, FROXELS, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage through{spy, VK_FORMAT_R32G32B32A32_SFLOAT, FROXELS, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage distance{spy, VK_FORMAT_R32G32_SFLOAT, {WIDTH, HEIGHT, 1}, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage map{spy, VK_FORMAT_R32_SFLOAT, {MAP_SIZE, MAP_SIZE, 1}, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage field{spy, VK_FORMAT_R32_SFLOAT, {8, 8, 8}, VK_IMAGE_USAGE_SAMPLED_BIT};
  SpyImage target{spy,
                  VK_FORMAT_R32G32B32A32_SFLOAT,
                  {WIDTH, HEIGHT, 1},
                  VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT};
};

struct Step {
  const char* entry;
  std::function<WlkResult()> call;
  bool needsDevice;  // fails once the device is lost
};

// The first light in air, and the phase functions for all orders, cost 0.3 s of the host each: of
// lives by the hundred, each has one thing.
struct Kind {
  const char* name;
  bool air;
  bool light;
  uint32_t scattering;
  bool targets = false;    // froxels, distance, a shadow map
  bool diameters = false;  // of droplets, whose tables take longest: 0.1 s
  bool surface = false;    // a cloud of a mesh, moved between frames
  bool setters = false;    // all that changes or asks something, and an engine's own volume image
  // Of so many calls of Vulkan one fails, where not all do. No multiple of 3: codes take turns.
  uint64_t stride = 1;
  // The same of the host's allocations: of wlkPrepare, which makes nine in ten, and of all else.
  uint64_t preparing = 1;
  uint64_t other = 1;
};
constexpr Kind WHOLE{"whole", true, true, WLK_SCATTERING_ALL_ORDERS, false, false, false, false,
                     47,      121,  14};
constexpr Kind CLOUD{"cloud", false, true, WLK_SCATTERING_FORWARD, false, false, false,
                     false,   1,     4};
constexpr Kind AIR{"air", true, false, WLK_SCATTERING_FORWARD, false, false, false, false,
                   8,     61,   3};
constexpr Kind TARGETS{"targets", false, true, WLK_SCATTERING_FORWARD, true, false, false,
                       false,     4,     25};
constexpr Kind DROPLETS{"droplets", false, true, WLK_SCATTERING_FORWARD, true, true, false, false,
                        121,        607,   121};
constexpr Kind SURFACE{"surface", false, true, WLK_SCATTERING_FORWARD, false, false, true, false,
                       14,        121,   14};
constexpr Kind SETTERS{"setters", false, true, WLK_SCATTERING_FORWARD, true, false, true, true,
                       61,        201,   14};

class Life {
 public:
  // The context gets its functions of Vulkan from `get`.
  Life(Engine& engine, const Kind& kind, PFN_vkGetInstanceProcAddr get)
      : engine_(engine), kind_(kind), get_(get) {}
  ~Life() { wlkDestroyContext(context); }
  Life(const Life&) = delete;
  Life& operator=(const Life&) = delete;

  std::vector<Step> steps();
  // What the context answers, without asking Vulkan: a failed call must not have changed it.
  std::vector<double> told() const;

  CountingAllocator memory;
  WlkContext context = nullptr;
  WlkMedium medium{};
  WlkVolume volume{};
  WlkVolume second{};
  WlkView view{};
  WlkCloudShadow map{};
  WlkSurface surface{};

 private:
  using Steps = std::vector<Step>;
  WlkResult create();
  WlkResult createMedium();
  WlkResult createView();
  WlkResult addVolume(WlkVolume& made) const;
  WlkResult upload() const;
  WlkResult uploadBricks() const;
  WlkResult uploadDiameters() const;
  WlkResult setAerial() const;
  WlkResult createSurface();
  WlkResult setDetail() const;
  WlkResult moveSurface() const;
  WlkResult createMap();
  WlkResult setImage() const;
  WlkResult recordMap();
  WlkResult recorded(const std::function<WlkResult(VkCommandBuffer)>& record) const;
  WlkResult resize(uint32_t width) const;
  WlkResult record(bool ofView);
  WlkResult begin();

  void addScene(Steps& steps);
  void addSetters(Steps& steps);
  void addTargets(Steps& steps);
  void addLaterSetters(Steps& steps);
  void addQueries(Steps& steps);
  void addFrame(Steps& steps);
  void addEnd(Steps& steps);

  Engine& engine_;
  Kind kind_;
  PFN_vkGetInstanceProcAddr get_;
  uint64_t frame_ = 0;
};

}  // namespace welkin::test
