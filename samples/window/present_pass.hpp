// SPDX-License-Identifier: MIT
// Tone-maps the finished picture into the window.
#pragma once

#include "targets.hpp"

class PresentPass {
 public:
  PresentPass(const Gpu& gpu, VkFormat displayFormat, uint32_t composite);
  ~PresentPass();
  PresentPass(const PresentPass&) = delete;
  PresentPass& operator=(const PresentPass&) = delete;

  // Points the pass at new targets. No frame may be in flight.
  void setTargets(const Targets& targets) const;
  // Expects the targets in SAMPLED, leaves the display's image in COLOR_ATTACHMENT.
  void record(VkCommandBuffer commands, VkImage image, VkImageView view, VkExtent2D extent) const;

 private:
  void createSet();

  const Gpu& gpu_;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};
