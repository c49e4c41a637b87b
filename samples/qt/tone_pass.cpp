// SPDX-License-Identifier: MIT
#include "tone_pass.hpp"

#include "engine/pipeline.hpp"
#include "present_vert_spv.h"
#include "tone_frag_spv.h"

namespace {

struct Constants {
  int32_t origin[2];
  float exposure = 10.0f;  // shows daylight of a sun of irradiance 1
};

}  // namespace

TonePass::TonePass(const Gpu& gpu, VkFormat displayFormat) : gpu_(gpu) {
  const VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  check(vkCreateSampler(gpu.device(), &sampler, nullptr, &sampler_), "vkCreateSampler");
  const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                             VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo setLayout{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  setLayout.bindingCount = 1;
  setLayout.pBindings = &binding;
  check(vkCreateDescriptorSetLayout(gpu.device(), &setLayout, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout");
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VIEWS};
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = VIEWS;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  check(vkCreateDescriptorPool(gpu.device(), &pool, nullptr, &pool_), "vkCreateDescriptorPool");
  const std::array layouts{setLayout_, setLayout_};
  VkDescriptorSetAllocateInfo sets{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  sets.descriptorPool = pool_;
  sets.descriptorSetCount = VIEWS;
  sets.pSetLayouts = layouts.data();
  check(vkAllocateDescriptorSets(gpu.device(), &sets, sets_.data()), "vkAllocateDescriptorSets");

  const VkPushConstantRange range{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(Constants)};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  check(vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &layout_), "vkCreatePipelineLayout");
  PipelineInfo info;
  info.vertexCode = present_vert_spv;
  info.fragmentCode = tone_frag_spv;
  info.layout = layout_;
  info.colorFormat = displayFormat;
  pipeline_ = makePipeline(gpu, info);
}

TonePass::~TonePass() {
  vkDestroyPipeline(gpu_.device(), pipeline_, nullptr);
  vkDestroyPipelineLayout(gpu_.device(), layout_, nullptr);
  vkDestroyDescriptorPool(gpu_.device(), pool_, nullptr);
  vkDestroyDescriptorSetLayout(gpu_.device(), setLayout_, nullptr);
  vkDestroySampler(gpu_.device(), sampler_, nullptr);
}

void TonePass::setPicture(uint32_t view, const Image& picture) const {
  const VkDescriptorImageInfo image{sampler_, picture.view(), SAMPLED.layout};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = sets_[view];
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &image;
  vkUpdateDescriptorSets(gpu_.device(), 1, &write, 0, nullptr);
}

void TonePass::record(VkCommandBuffer commands, const Swapchain& swapchain, uint32_t index,
                      VkExtent2D half) const {
  transition(commands, swapchain.image(index), VK_IMAGE_ASPECT_COLOR_BIT,
             discarded(COLOR_ATTACHMENT), COLOR_ATTACHMENT);
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = swapchain.view(index);
  color.imageLayout = COLOR_ATTACHMENT.layout;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // an odd width leaves a column over
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, swapchain.extent()};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  vkCmdBeginRendering(commands, &rendering);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  for (uint32_t view = 0; view < VIEWS; ++view) {
    const auto x = static_cast<int32_t>(view * half.width);
    const VkViewport viewport{static_cast<float>(x),           0.0f, static_cast<float>(half.width),
                              static_cast<float>(half.height), 0.0f, 1.0f};
    const VkRect2D scissor{{x, 0}, half};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    const Constants constants{{x, 0}};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &sets_[view],
                            0, nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                       &constants);
    vkCmdDraw(commands, 3, 1, 0, 0);
  }
  vkCmdEndRendering(commands);
}
