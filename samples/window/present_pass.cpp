// SPDX-License-Identifier: MIT
#include "present_pass.hpp"

#include <array>

#include "engine/pipeline.hpp"
#include "present_frag_spv.h"
#include "present_vert_spv.h"

namespace {

constexpr uint32_t IMAGES = 3;     // scene, layer radiance, layer transmittance
constexpr float EXPOSURE = 10.0f;  // shows daylight of a sun of irradiance 1

}  // namespace

PresentPass::PresentPass(const Gpu& gpu, VkFormat displayFormat, uint32_t composite) : gpu_(gpu) {
  createSet();
  const VkPushConstantRange range{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof EXPOSURE};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  check(vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &layout_), "vkCreatePipelineLayout");

  const VkBool32 separate = composite == WLK_COMPOSITE_SEPARATE;
  const VkSpecializationMapEntry entry{0, 0, sizeof separate};
  const VkSpecializationInfo constants{1, &entry, sizeof separate, &separate};
  PipelineInfo info;
  info.vertexCode = present_vert_spv;
  info.fragmentCode = present_frag_spv;
  info.fragmentConstants = &constants;
  info.layout = layout_;
  info.colorFormat = displayFormat;
  pipeline_ = makePipeline(gpu, info);
}

PresentPass::~PresentPass() {
  vkDestroyPipeline(gpu_.device(), pipeline_, nullptr);
  vkDestroyPipelineLayout(gpu_.device(), layout_, nullptr);
  vkDestroyDescriptorPool(gpu_.device(), pool_, nullptr);
  vkDestroyDescriptorSetLayout(gpu_.device(), setLayout_, nullptr);
  vkDestroySampler(gpu_.device(), sampler_, nullptr);
}

void PresentPass::createSet() {
  const VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  check(vkCreateSampler(gpu_.device(), &sampler, nullptr, &sampler_), "vkCreateSampler");
  std::array<VkDescriptorSetLayoutBinding, IMAGES> bindings{};
  for (uint32_t i = 0; i < IMAGES; ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT,
                   nullptr};
  }
  VkDescriptorSetLayoutCreateInfo layout{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  layout.bindingCount = IMAGES;
  layout.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(gpu_.device(), &layout, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout");
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, IMAGES};
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = 1;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  check(vkCreateDescriptorPool(gpu_.device(), &pool, nullptr, &pool_), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  set.descriptorPool = pool_;
  set.descriptorSetCount = 1;
  set.pSetLayouts = &setLayout_;
  check(vkAllocateDescriptorSets(gpu_.device(), &set, &set_), "vkAllocateDescriptorSets");
}

void PresentPass::setTargets(const Targets& targets) const {
  // Without a layer of its own the shader reads the first image only.
  const std::array views{
      targets.color.view(), targets.radiance ? targets.radiance->view() : targets.color.view(),
      targets.transmittance ? targets.transmittance->view() : targets.color.view()};
  std::array<VkDescriptorImageInfo, IMAGES> images{};
  std::array<VkWriteDescriptorSet, IMAGES> writes{};
  for (uint32_t i = 0; i < IMAGES; ++i) {
    images[i] = {sampler_, views[i], SAMPLED.layout};
    writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes[i].dstSet = set_;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[i].pImageInfo = &images[i];
  }
  vkUpdateDescriptorSets(gpu_.device(), IMAGES, writes.data(), 0, nullptr);
}

void PresentPass::record(VkCommandBuffer commands, VkImage image, VkImageView view,
                         VkExtent2D extent) const {
  transition(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, discarded(COLOR_ATTACHMENT),
             COLOR_ATTACHMENT);
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = view;
  color.imageLayout = COLOR_ATTACHMENT.layout;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, extent};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  vkCmdBeginRendering(commands, &rendering);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0,
                          nullptr);
  setViewport(commands, extent);
  vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof EXPOSURE,
                     &EXPOSURE);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
}
