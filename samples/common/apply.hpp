// SPDX-License-Identifier: MIT
// From a scene to the library's objects, and the opaque picture behind them.
#pragma once

#include <functional>
#include <vector>

#include "common/api.hpp"
#include "common/scene.hpp"

namespace host {

/// Of the geometry: three cascades, one after the other.
struct ShadowMap {
  WlkLightShadow place;
  std::vector<float> depth;
  uint32_t size = 0;
};

/// Told before each slow step.
using Progress = std::function<void(const std::string&)>;

/// Sets planet, air, lights and fog. Enough for the CPU queries.
void applyWorld(WlkContext context, const Scene& scene);

/// Creates media, volumes with their voxels, and surfaces.
void applyBodies(WlkContext context, const Scene& scene, const Progress& progress);

/// Creates the view with its camera and quality.
WlkView applyView(WlkContext context, const Scene& scene);

/// Light on the ground as the library's CPU model sees it, for rasterise.
Illumination sampleIllumination(WlkContext context, const Scene& scene, double lowest,
                                double highest);

/// The opaque picture: drawn, read, or empty images where the scene has none. Needs applyWorld.
RasterResult makeOpaque(WlkContext context, const Scene& scene, const Progress& progress);

/// The geometry's shadow map of the first light, or an empty one if it casts no shadows.
ShadowMap makeShadowMap(const Scene& scene, const Progress& progress);

}  // namespace host
