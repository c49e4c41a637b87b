// SPDX-License-Identifier: MIT
// Copies a picture of the window into a PNG file.
#pragma once

#include <string>

#include "engine/resources.hpp"

class Screenshot {
 public:
  Screenshot(const Gpu& gpu, VkExtent2D extent, VkFormat format);

  // Copies an image that is in COLOR_ATTACHMENT and leaves it in TRANSFER_SOURCE.
  void record(VkCommandBuffer commands, VkImage image) const;
  // Writes the file once the copy is complete.
  void save(const std::string& path) const;

  static constexpr ImageState TRANSFER_SOURCE{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0,
                                              VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                              VK_ACCESS_2_TRANSFER_READ_BIT};

 private:
  VkExtent2D extent_;
  VkFormat format_;
  Buffer pixels_;
};
