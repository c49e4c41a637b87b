// SPDX-License-Identifier: MIT
// A scene file as the Monte Carlo reference sees it. Only phase functions, optics and the picture
// of opaque geometry come from the library.
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

/// `context` may be without Vulkan and needs host::applyWorld. `disk`: scattering feels the size of
/// the lights' disks. Throws InputError.
ReferenceScene makeReferenceScene(WlkContext context, const host::Scene& scene, bool disk,
                                  const host::Progress& progress);

}  // namespace cli
