// SPDX-License-Identifier: MIT
#include "opaque_pass.hpp"

#include <array>
#include <cstddef>
#include <cstring>

#include "engine/mesh.hpp"
#include "engine/pipeline.hpp"
#include "mesh_frag_spv.h"
#include "mesh_vert_spv.h"

namespace {

// The push constants of shaders/mesh.vert.
struct Constants {
  glm::mat4 clipFromWorld;
  glm::vec4 toSun;
  glm::vec4 sunIrradiance;
  glm::vec4 skyIrradiance;
};
constexpr VkShaderStageFlags STAGES = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

glm::mat4 clipFromWorld(const Camera& camera, VkExtent2D extent) {
  glm::dmat4 view(camera.viewFromWorld());
  view[3] = glm::dvec4(-(camera.viewFromWorld() * camera.position), 1.0);
  return glm::mat4(projection(static_cast<double>(extent.width) / extent.height) * view);
}

}  // namespace

OpaquePass::OpaquePass(const Gpu& gpu) : gpu_(gpu) {
  const Mesh mesh = makeWorld();
  const size_t vertexBytes = mesh.vertices.size() * sizeof(Vertex);
  const size_t indexBytes = mesh.indices.size() * sizeof(uint32_t);
  vertices_.emplace(gpu, vertexBytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  indices_.emplace(gpu, indexBytes, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  std::memcpy(vertices_->data(), mesh.vertices.data(), vertexBytes);
  std::memcpy(indices_->data(), mesh.indices.data(), indexBytes);
  indexCount_ = static_cast<uint32_t>(mesh.indices.size());

  const VkPushConstantRange range{STAGES, 0, sizeof(Constants)};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  check(vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &layout_), "vkCreatePipelineLayout");

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
  info.colorFormat = COLOR_FORMAT;
  info.depthFormat = DEPTH_FORMAT;
  pipeline_ = makePipeline(gpu, info);
}

OpaquePass::~OpaquePass() {
  vkDestroyPipeline(gpu_.device(), pipeline_, nullptr);
  vkDestroyPipelineLayout(gpu_.device(), layout_, nullptr);
}

void OpaquePass::record(VkCommandBuffer commands, const Targets& targets, const Camera& camera,
                        const Lighting& lighting) const {
  const VkExtent2D extent = targets.color.extent();
  transition(commands, targets.color, discarded(SAMPLED), COLOR_ATTACHMENT);
  transition(commands, targets.depth, discarded(DEPTH_ATTACHMENT), DEPTH_ATTACHMENT);

  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = targets.color.view();
  color.imageLayout = COLOR_ATTACHMENT.layout;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // black: Welkin draws the sky
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = targets.depth.view();
  depth.imageLayout = DEPTH_ATTACHMENT.layout;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // 0: infinitely far
  depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, extent};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(commands, &rendering);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  setViewport(commands, extent);
  Constants constants;
  constants.clipFromWorld = clipFromWorld(camera, extent);
  constants.toSun = glm::vec4(glm::vec3(lighting.toSun), 0.0f);
  constants.sunIrradiance = glm::vec4(glm::vec3(lighting.sunIrradiance), 0.0f);
  constants.skyIrradiance = glm::vec4(glm::vec3(lighting.skyIrradiance), 0.0f);
  vkCmdPushConstants(commands, layout_, STAGES, 0, sizeof constants, &constants);
  const VkBuffer vertices = vertices_->handle();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
  vkCmdBindIndexBuffer(commands, indices_->handle(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, 0);
  vkCmdEndRendering(commands);
}
