// SPDX-License-Identifier: MIT
// A box of density in [0, 1] with soft faces and optional noise: rain shafts, cirrus, cloud decks.
#pragma once

#include <algorithm>

#include "common/noise.hpp"
#include "common/parallel.hpp"
#include "common/volume.hpp"

namespace host {

/// Rises smoothly from 0 on both faces of [0, extent] to 1 at `edge` from them; 1 if edge is 0.
inline double softFaces(double x, double extent, double edge) {
  const double depth = std::min(x, extent - x);
  const double t = edge > 0.0 ? std::clamp(depth / edge, 0.0, 1.0) : 1.0;
  return t * t * (3.0 - 2.0 * t);
}

/// The same input gives the same slab on every machine, up to rounding in libm.
inline Grid makeSlab(const SlabInfo& info) {
  Grid grid;
  grid.size = info.size;
  grid.values.resize(checkedVoxelCount("slab", {info.size[0], info.size[1], info.size[2]}));
  grid.worldFromVolume = affineFromEdges({}, {info.extent.x, 0.0, 0.0}, {0.0, info.extent.y, 0.0},
                                         {0.0, 0.0, info.extent.z});
  const Vec3 voxel{info.extent.x / info.size[0], info.extent.y / info.size[1],
                   info.extent.z / info.size[2]};
  parallelFor(info.size[2], [&](uint32_t z) {
    for (uint32_t y = 0; y < info.size[1]; ++y) {
      for (uint32_t x = 0; x < info.size[0]; ++x) {
        const Vec3 p = Vec3{x + 0.5, y + 0.5, z + 0.5} * voxel;
        double density = softFaces(p.x, info.extent.x, info.edge.x) *
                         softFaces(p.y, info.extent.y, info.edge.y) *
                         softFaces(p.z, info.extent.z, info.edge.z);
        if (info.noise > 0.0) {
          // fbm is in about [-1, 1] but rarely beyond a half of that.
          const double wisp = fbm(p * (1.0 / info.noiseSize), 4, info.seed);
          density *= 1.0 - info.noise * std::clamp(0.5 - wisp, 0.0, 1.0);
        }
        grid.values[x + size_t{info.size[0]} * (y + size_t{info.size[1]} * z)] =
            static_cast<float>(density);
      }
    }
  });
  return grid;
}

}  // namespace host
