// SPDX-License-Identifier: MIT
// Draws the engine's meshes into colour and depth.
#pragma once

#include <optional>

#include "camera.hpp"
#include "lighting.hpp"
#include "targets.hpp"

class OpaquePass {
 public:
  explicit OpaquePass(const Gpu& gpu);
  ~OpaquePass();
  OpaquePass(const OpaquePass&) = delete;
  OpaquePass& operator=(const OpaquePass&) = delete;

  // Leaves colour in COLOR_ATTACHMENT and depth in DEPTH_ATTACHMENT; depth 0 where nothing is.
  void record(VkCommandBuffer commands, const Targets& targets, const Camera& camera,
              const Lighting& lighting) const;

 private:
  const Gpu& gpu_;
  std::optional<Buffer> vertices_;
  std::optional<Buffer> indices_;
  uint32_t indexCount_ = 0;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};
