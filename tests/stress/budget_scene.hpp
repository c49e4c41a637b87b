// SPDX-License-Identifier: MIT
// A scene that fills an engine's context with device memory, step by step: volumes, a cloud
// surface, a view, a map of the clouds' shadow. Pipelines are hollow and frames recorded, not run:
// it is for tests of what is asked for, and of no picture.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stress/abuse.hpp"
#include "support/engine_scene.hpp"
#include "support/fault_layer.hpp"

namespace welkin::test {

// Lives as long as the scenes on it; its own memory does not count.
struct BudgetEngine {
  static constexpr uint32_t MAP_SIZE = 512;

  SpyDevice spy;
  SpyImage map{spy, VK_FORMAT_R32_SFLOAT, {MAP_SIZE, MAP_SIZE, 1}, VK_IMAGE_USAGE_STORAGE_BIT};
  // By size: those of the view, and of one that has shrunk or grown.
  std::vector<std::unique_ptr<SpyImage>> targets;
  const SpyImage& target(uint32_t width, uint32_t height);  // makes what is not there
};

class BudgetScene {
 public:
  // What needs more memory, and more than a block has left: another volume, the first surface,
  // another view, a larger one, another map.
  enum class Needing { VOLUME, SURFACE, VIEW, SIZE, MAP };
  static const char* nameOf(Needing needing);

  struct Step {
    const char* entry;
    std::function<WlkResult()> call;
    bool ballast = false;
  };

  explicit BudgetScene(BudgetEngine& engine) : engine_(engine) {}
  ~BudgetScene() { wlkDestroyContext(context); }
  BudgetScene(const BudgetScene&) = delete;
  BudgetScene& operator=(const BudgetScene&) = delete;

  // The context, with a sun and a medium.
  WlkResult create(uint64_t limit);
  // The air, and an eye above most of it.
  void addSky() const;
  void rise() const;
  // All else, to the second frame. What one of them failed to do is done when it is called again.
  std::vector<Step> steps(bool ballast, bool surface = true);

  // A volume of so many voxels along each edge, and one voxel of it: memory is taken when there is
  // something to keep.
  WlkResult addVolume(uint32_t edge);
  WlkResult destroyVolume();  // the last
  WlkResult prepare() const { return wlkPrepare(context); }
  // Records one frame; those before it are complete.
  WlkResult frame();
  // Tells that those recorded so far are complete, and begins the next.
  WlkResult completeAll();
  WlkFrameStats stats() const;

  // Frees more than half of what the scene uses, and the frames that used it.
  WlkResult dropBallast();
  // An upload that waits for a frame, in a block of memory of its own: as much as what else was
  // staged had.
  WlkResult stageBlock() const;
  // Leaves a view of a few pixels, and neither a surface nor a map.
  WlkResult shrink();
  WlkResult add(Needing needing);
  // After a refused one: the sizes that were.
  void goBack(Needing needing);

  WlkContext context = nullptr;

 private:
  WlkResult upload(WlkVolume volume, const std::array<uint32_t, 3>& extent) const;
  WlkResult create(const std::array<uint32_t, 3>& size, WlkVolume& volume) const;
  WlkResult addSurface(WlkSurface& surface) const;
  WlkResult addView(uint32_t width, uint32_t height, WlkView& view) const;
  WlkResult addMap(uint32_t size, WlkCloudShadow& map) const;
  WlkResult resize(uint32_t width, uint32_t height);
  WlkResult record(VkCommandBuffer commands);

  BudgetEngine& engine_;
  WlkMedium medium_{};
  WlkVolume ballast_{};
  WlkVolume volume_{};
  WlkVolume last_{};
  WlkSurface surface_{};
  WlkView view_{};
  WlkView secondView_{};
  WlkCloudShadow map_{};
  WlkCloudShadow secondMap_{};
  uint32_t width_ = 0;
  uint32_t height_ = 0;
  uint64_t frame_ = 0;
};

}  // namespace welkin::test
