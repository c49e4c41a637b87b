// SPDX-License-Identifier: MIT
// Everything the engine does with Welkin. Read this class first.
#pragma once

#include <welkin/welkin_vulkan.h>

#include <welkin/welkin.hpp>

#include "camera.hpp"
#include "common/scene.hpp"
#include "engine/frames.hpp"
#include "lighting.hpp"
#include "panel.hpp"
#include "targets.hpp"

class Atmosphere {
 public:
  // `framesInFlight`: frames the engine records before it waits for the first of them. `scene`: a
  // file's air, lights, media and volumes instead of the sample's own; null: these.
  Atmosphere(const Gpu& gpu, VkExtent2D extent, uint32_t composite, const Settings& settings,
             uint32_t framesInFlight, const host::Scene* scene);

  // For targets of another size. No frame may be in flight.
  void resize(VkExtent2D extent);
  // Call before targets are destroyed. No frame may be in flight.
  void forget(const Targets& targets);

  // After the settings have changed. The old clouds' memory lives until their last frame is over.
  void setClouds(const Settings& settings);
  void setQuality(const Settings& settings);
  bool ownClouds() const { return clouds_.get().id != 0; }
  FrameReport report() const;

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
  void createClouds(const Settings& settings);
  void applyQuality(const Settings& settings) const;
  void setCamera(const Camera& camera, VkExtent2D extent);

  WlkViewInfo viewInfo_;
  WlkQuality quality_;  // what the settings do not name
  double hour_ = -1.0;  // none yet
  bool lit_ = true;     // a scene may have no light
  glm::dvec3 toSun_{0.0, 1.0, 0.0};
  // The context first: it outlives what is made from it.
  welkin::Context context_;
  welkin::Medium droplets_;
  welkin::Volume clouds_;
  welkin::View view_;
};
