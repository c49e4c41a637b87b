// SPDX-License-Identifier: MIT
// A scene file as the Monte Carlo reference sees it. From the library come the picture of opaque
// geometry and, unless they are asked for otherwise, phase functions and optics of particles.
#pragma once

#include <vector>

#include "common/apply.hpp"
#include "common/scene.hpp"
#include "reference/monte_carlo.hpp"

namespace cli {

struct ReferenceScene {
  welkin::reference::Scene scene;
  /// One through the middle of each pixel, top row first.
  std::vector<welkin::reference::EyeRay> rays;
};

struct ReferenceSettings {
  /// Scattering feels the size of the lights' disks.
  bool disk = false;
  /// Droplets by droplet_phase.hpp. Refuses rain, ice, snow and user tables.
  bool mie = false;
  /// For droplets; 0: all cores.
  unsigned threads = 0;
};

/// `context` may be without Vulkan and needs host::applyWorld. Throws InputError.
ReferenceScene makeReferenceScene(WlkContext context, const host::Scene& scene,
                                  const ReferenceSettings& settings,
                                  const host::Progress& progress);

}  // namespace cli
