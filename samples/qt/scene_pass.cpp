// SPDX-License-Identifier: MIT
#include "scene_pass.hpp"

#include <array>
#include <cstddef>
#include <cstring>

#include "engine/mesh.hpp"
#include "engine/pipeline.hpp"
#include "mesh_frag_spv.h"
#include "mesh_vert_spv.h"

namespace {

// The push constants of mesh.vert; directions in the mesh's axes.
struct Constants {
  glm::mat4 clipFromMesh;
  glm::vec4 toSun;
  glm::vec4 sunIrradiance;
  glm::vec4 skyIrradiance;
};
constexpr VkShaderStageFlags STAGES = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

}  // namespace

ViewImages::ViewImages(const Gpu& gpu, VkExtent2D extent, VkRenderPass renderPass)
    : color(gpu, extent, PICTURE_FORMAT,
            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            VK_IMAGE_ASPECT_COLOR_BIT),
      depth(gpu, extent, DEPTH_STENCIL_FORMAT,
            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT),
      gpu_(gpu) {
  const std::array views{color.view(), depth.view()};
  VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
  info.renderPass = renderPass;
  info.attachmentCount = static_cast<uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = extent.width;
  info.height = extent.height;
  info.layers = 1;
  check(vkCreateFramebuffer(gpu.device(), &info, nullptr, &framebuffer), "vkCreateFramebuffer");
}

ViewImages::~ViewImages() {
  vkDestroyFramebuffer(gpu_.device(), framebuffer, nullptr);
}

ScenePass::ScenePass(const Gpu& gpu) : gpu_(gpu) {
  const Mesh mesh = makeWorld();
  const size_t vertexBytes = mesh.vertices.size() * sizeof(Vertex);
  const size_t indexBytes = mesh.indices.size() * sizeof(uint32_t);
  vertices_.emplace(gpu, vertexBytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  indices_.emplace(gpu, indexBytes, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  std::memcpy(vertices_->data(), mesh.vertices.data(), vertexBytes);
  std::memcpy(indices_->data(), mesh.indices.data(), indexBytes);
  indexCount_ = static_cast<uint32_t>(mesh.indices.size());
  createRenderPass();
  createPipeline();
}

ScenePass::~ScenePass() {
  vkDestroyPipeline(gpu_.device(), pipeline_, nullptr);
  vkDestroyPipelineLayout(gpu_.device(), layout_, nullptr);
  vkDestroyRenderPass(gpu_.device(), renderPass_, nullptr);
}

void ScenePass::createRenderPass() {
  std::array<VkAttachmentDescription, 2> attachments{};
  attachments[0].format = PICTURE_FORMAT;
  attachments[1].format = DEPTH_STENCIL_FORMAT;
  for (VkAttachmentDescription& attachment : attachments) {
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  }
  attachments[0].finalLayout = COLOR_ATTACHMENT.layout;
  attachments[1].finalLayout = DEPTH_ATTACHMENT.layout;
  const VkAttachmentReference color{0, COLOR_ATTACHMENT.layout};
  const VkAttachmentReference depth{1, DEPTH_ATTACHMENT.layout};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  subpass.pDepthStencilAttachment = &depth;
  // The last frame's readers come first.
  VkSubpassDependency before{};
  before.srcSubpass = VK_SUBPASS_EXTERNAL;
  before.srcStageMask =
      VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                        VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  before.srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  info.attachmentCount = static_cast<uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &before;
  check(vkCreateRenderPass(gpu_.device(), &info, nullptr, &renderPass_), "vkCreateRenderPass");
}

void ScenePass::createPipeline() {
  const VkPushConstantRange range{STAGES, 0, sizeof(Constants)};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  check(vkCreatePipelineLayout(gpu_.device(), &layout, nullptr, &layout_),
        "vkCreatePipelineLayout");
  const VkVertexInputBindingDescription binding{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
  const std::array attributes{
      VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32B32_SFLOAT,
                                        offsetof(Vertex, position)},
      VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
      VkVertexInputAttributeDescription{2, 0, VK_FORMAT_R32G32B32_SFLOAT,
                                        offsetof(Vertex, albedo)}};
  PipelineInfo info;
  info.vertexCode = mesh_vert_spv;
  info.fragmentCode = mesh_frag_spv;
  info.vertexInput.vertexBindingDescriptionCount = 1;
  info.vertexInput.pVertexBindingDescriptions = &binding;
  info.vertexInput.vertexAttributeDescriptionCount = static_cast<uint32_t>(attributes.size());
  info.vertexInput.pVertexAttributeDescriptions = attributes.data();
  info.layout = layout_;
  info.colorFormat = PICTURE_FORMAT;
  info.depthFormat = DEPTH_STENCIL_FORMAT;
  info.renderPass = renderPass_;
  pipeline_ = makePipeline(gpu_, info);
}

void ScenePass::record(VkCommandBuffer commands, const ViewImages& images, const Eye& eye,
                       const MeshLight& light) const {
  const VkExtent2D extent = images.color.extent();
  const std::array<VkClearValue, 2> clear{};  // black; depth 0 is the far plane
  VkRenderPassBeginInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  info.renderPass = renderPass_;
  info.framebuffer = images.framebuffer;
  info.renderArea = {{0, 0}, extent};
  info.clearValueCount = static_cast<uint32_t>(clear.size());
  info.pClearValues = clear.data();
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  setViewport(commands, extent);
  const glm::dmat3 meshFromWorld = glm::transpose(worldFromMesh());
  glm::dmat4 viewFromMesh(eye.viewFromWorld() * worldFromMesh());
  viewFromMesh[3] = glm::dvec4(-(eye.viewFromWorld() * eye.position), 1.0);
  Constants constants;
  constants.clipFromMesh = glm::mat4(eye.clipFromView(extent) * viewFromMesh);
  constants.toSun = glm::vec4(glm::vec3(meshFromWorld * light.toSun), 0.0f);
  constants.sunIrradiance = glm::vec4(glm::vec3(light.sunIrradiance), 0.0f);
  constants.skyIrradiance = glm::vec4(glm::vec3(light.skyIrradiance), 0.0f);
  vkCmdPushConstants(commands, layout_, STAGES, 0, sizeof constants, &constants);
  const VkBuffer vertices = vertices_->handle();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
  vkCmdBindIndexBuffer(commands, indices_->handle(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, 0);
  vkCmdEndRenderPass(commands);
}
