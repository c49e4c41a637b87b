// SPDX-License-Identifier: MIT
// What an engine's two graphics pipelines have in common.
#pragma once

#include <span>

#include "engine/gpu.hpp"

struct PipelineInfo {
  std::span<const uint32_t> vertexCode;
  std::span<const uint32_t> fragmentCode;
  const VkSpecializationInfo* fragmentConstants = nullptr;
  VkPipelineVertexInputStateCreateInfo vertexInput{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;  // UNDEFINED: no depth buffer
  VkRenderPass renderPass = VK_NULL_HANDLE;    // its first subpass; null: dynamic rendering
};

// Triangles, viewport and scissor dynamic, reversed depth test.
VkPipeline makePipeline(const Gpu& gpu, const PipelineInfo& info);

// Sets viewport and scissor to the whole target.
void setViewport(VkCommandBuffer commands, VkExtent2D extent);
