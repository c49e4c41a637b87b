// SPDX-License-Identifier: MIT
// Draws the meshes of one view, in a render pass of the older kind, with depth and stencil.
#pragma once

#include <optional>

#include "engine/resources.hpp"
#include "world.hpp"

constexpr VkFormat PICTURE_FORMAT = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
constexpr VkFormat DEPTH_STENCIL_FORMAT = VK_FORMAT_D24_UNORM_S8_UINT;

// A view's images.
class ViewImages {
 public:
  ViewImages(const Gpu& gpu, VkExtent2D extent, VkRenderPass renderPass);
  ~ViewImages();
  ViewImages(const ViewImages&) = delete;
  ViewImages& operator=(const ViewImages&) = delete;

  Image color;
  Image depth;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;

 private:
  const Gpu& gpu_;
};

// Light on the meshes; directions as in the world.
struct MeshLight {
  glm::dvec3 toSun{0.0, 0.0, 1.0};
  glm::dvec3 sunIrradiance{0.0};
  glm::dvec3 skyIrradiance{0.0};
};

class ScenePass {
 public:
  explicit ScenePass(const Gpu& gpu);
  ~ScenePass();
  ScenePass(const ScenePass&) = delete;
  ScenePass& operator=(const ScenePass&) = delete;

  VkRenderPass renderPass() const { return renderPass_; }
  // Leaves colour in COLOR_ATTACHMENT and depth in DEPTH_ATTACHMENT; depth 0 where nothing is.
  void record(VkCommandBuffer commands, const ViewImages& images, const Eye& eye,
              const MeshLight& light) const;

 private:
  void createRenderPass();
  void createPipeline();

  const Gpu& gpu_;
  std::optional<Buffer> vertices_;
  std::optional<Buffer> indices_;
  uint32_t indexCount_ = 0;
  VkRenderPass renderPass_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};
