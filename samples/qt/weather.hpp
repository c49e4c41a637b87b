// SPDX-License-Identifier: MIT
// What this engine does with Welkin. Other than samples/window: z is up, two views share one scene
// and its light, the layer is blended onto an image without alpha, and the density comes from the
// engine's own 3-D image.
#pragma once

#include <welkin/welkin_vulkan.h>

#include <array>
#include <welkin/welkin.hpp>

#include "engine/frames.hpp"
#include "tone_pass.hpp"

class Weather {
 public:
  Weather(const Gpu& gpu, VkExtent2D half, uint32_t framesInFlight, uint32_t quality);

  // For images of another size, and before images are destroyed. No frame may be in flight.
  void resize(VkExtent2D half);
  void forget(const Image& image);
  // Once the density is there.
  void addClouds(const Image& density);

  // Local solar time, 40 degrees north at an equinox; the camera's +x is south.
  void setHour(double hour);
  MeshLight lightAt(const glm::dvec3& position);

  // Once per frame, before its views.
  void begin(VkCommandBuffer commands, const Frames& frames);
  // Takes the images as ScenePass leaves them; afterwards colour is in SAMPLED.
  void record(VkCommandBuffer commands, uint32_t view, const Eye& eye, const ViewImages& images);

 private:
  void setCamera(uint32_t view, const Eye& eye, VkExtent2D extent);

  WlkViewInfo viewInfo_;
  glm::dvec3 toSun_{0.0, 0.0, 1.0};
  // The context first: it outlives what is made from it.
  welkin::Context context_;
  welkin::Medium droplets_;
  welkin::Volume clouds_;
  std::array<welkin::View, VIEWS> views_;
};
