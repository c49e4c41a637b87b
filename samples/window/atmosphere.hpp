// SPDX-License-Identifier: MIT
// Everything the engine does with Welkin. Read this class first.
#pragma once

#include <welkin/welkin_vulkan.h>

#include <welkin/welkin.hpp>

#include "camera.hpp"
#include "frames.hpp"
#include "lighting.hpp"
#include "targets.hpp"

class Atmosphere {
 public:
  // `framesInFlight`: frames the engine records before it waits for the first of them.
  Atmosphere(const Gpu& gpu, VkExtent2D extent, uint32_t composite, uint32_t quality,
             uint32_t framesInFlight);

  // For targets of another size. No frame may be in flight.
  void resize(VkExtent2D extent);
  // Call before targets are destroyed. No frame may be in flight.
  void forget(const Targets& targets);

  // Places the sun for a local solar time; hours, 40 degrees south at an equinox, -z is north.
  void setHour(double hour);
  // What reaches a surface at a point through air and fog; the clouds' shadows are not in it.
  Lighting lightingAt(const glm::dvec3& position);

  // Records Welkin's work on a frame. Takes the targets as OpaquePass leaves them; afterwards
  // those that the present pass reads are in SAMPLED, depth is in DEPTH_ATTACHMENT.
  void record(VkCommandBuffer commands, const Frames& frames, const Camera& camera,
              const Targets& targets);

 private:
  void createScene();
  void createClouds();
  void setCamera(const Camera& camera, VkExtent2D extent);

  WlkViewInfo viewInfo_;
  glm::dvec3 toSun_{0.0, 1.0, 0.0};
  // The context first: it outlives what is made from it.
  welkin::Context context_;
  welkin::Medium droplets_;
  welkin::Volume clouds_;
  welkin::View view_;
};
