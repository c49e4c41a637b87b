// SPDX-License-Identifier: MIT
#include "frame/transport_shape.hpp"

#include <algorithm>
#include <cmath>

#include "tables/transport_phase.hpp"

namespace welkin {
namespace {

// What holds all density, in the unit box; all of it where there is none.
struct FilledBox {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};

FilledBox filledBox(const VolumeState& volume) {
  glm::dvec3 low(1);
  glm::dvec3 high(0);
  for (uint32_t f = 0; f < volume.fieldCount; ++f) {
    const FieldState& field = volume.fields[f];
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<size_t>(i);
      const double voxels = volume.size[axis];
      if (field.external) {
        low[i] = 0;
        high[i] = 1;
      } else if (field.filled.end[axis] > 0) {
        // Filtering spreads a voxel's value by half a voxel on either side.
        low[i] = std::min(low[i], (field.filled.first[axis] - 0.5) / voxels);
        high[i] = std::max(high[i], (field.filled.end[axis] + 0.5) / voxels);
      }
    }
  }
  FilledBox result;
  for (int i = 0; i < 3; ++i) {
    if (high[i] > low[i]) {
      result.low[i] = std::max(low[i], 0.0);
      result.high[i] = std::min(high[i], 1.0);
    }
  }
  return result;
}

// m.
glm::dvec3 extentOf(const VolumeState& volume, const FilledBox& filled) {
  glm::dvec3 extent(0);
  for (int i = 0; i < 3; ++i) {
    extent[i] = glm::length(glm::dvec3(volume.worldFromBox[i])) * (filled.high[i] - filled.low[i]);
  }
  return extent;
}

// Of a layer of optical depth `depth`, without the peak, and of so many voxels along its normal: as
// many cells along its plane, where an eye sees other sides of them than their middles do, as leave
// it enough along its normal.
std::array<uint32_t, 3> layerCells(uint32_t edge, int thinAxis, double depth, uint32_t voxels) {
  constexpr double MOST = 0.6;          // optical depth of a cell
  constexpr uint32_t MOST_VOXELS = 16;  // of a cell: those that transportTaps sees
  for (uint32_t wide = transportImageEdge(edge) / 8 * 8; wide > edge; wide -= 8) {
    const uint32_t thin = edge * edge / wide * edge / wide / 8 * 8;
    if (thin > 0 && depth <= MOST * thin && voxels <= MOST_VOXELS * thin) {
      std::array<uint32_t, 3> cells = {wide, wide, wide};
      cells[static_cast<size_t>(thinAxis)] = thin;
      return cells;
    }
  }
  return {edge, edge, edge};
}

}  // namespace

double meanAlbedo(const FieldState& field) {
  const std::array<double, RGB> albedo = field.medium.scaledAlbedo();
  return (albedo[0] + albedo[1] + albedo[2]) / 3;
}

uint32_t transportImageEdge(uint32_t edge) {
  return edge + edge / 2;
}

glm::dvec3 flatStretches(const TransportShape& shape, uint32_t slices, bool grid) {
  glm::dvec3 stretches(0);
  if (shape.thinAxis < 0) {
    return stretches;
  }
  const auto thin = static_cast<size_t>(shape.thinAxis);
  const double across = flatStretchesAcross(slices);
  if (grid && shape.layer) {
    // Two in each cell, or one where that is many.
    const double perCell = std::clamp(across / shape.cells[thin], 1.0, 2.0);
    for (int i = 0; i < 3; ++i) {
      stretches[i] = perCell * shape.cells[static_cast<size_t>(i)];
    }
  }
  stretches[shape.thinAxis] = std::max(stretches[shape.thinAxis], across);
  return stretches / shape.size;
}

TransportShape flatShape(const VolumeState& volume) {
  constexpr double LAYER = 0.1;
  const FilledBox filled = filledBox(volume);
  TransportShape shape;
  shape.origin = filled.low;
  shape.size = filled.high - filled.low;
  const glm::dvec3 extent = extentOf(volume, filled);
  const double longest = std::max({extent.x, extent.y, extent.z});
  for (int i = 0; i < 3; ++i) {
    if (extent[i] < FLAT * longest && (shape.thinAxis < 0 || extent[i] < extent[shape.thinAxis])) {
      shape.thinAxis = i;
    }
  }
  shape.layer = shape.thinAxis >= 0 && extent[shape.thinAxis] < LAYER * longest;
  return shape;
}

TransportShape transportShape(const VolumeState& volume, uint32_t edge) {
  TransportShape shape = flatShape(volume);
  shape.cells = {edge, edge, edge};
  if (shape.layer) {
    const uint32_t voxels = volume.size[static_cast<size_t>(shape.thinAxis)];
    shape.cells = layerCells(edge, shape.thinAxis, thinDepth(volume), voxels);
  }
  if (shape.thinAxis >= 0) {
    return shape;
  }
  // The finest cubes whose count fits.
  const glm::dvec3 extent = extentOf(volume, filledBox(volume));
  const double longest = std::max({extent.x, extent.y, extent.z});
  double cube = longest / edge;
  for (uint32_t along = edge; along <= transportImageEdge(edge); along += 8) {
    std::array<uint32_t, 3> cells{};
    for (int i = 0; i < 3; ++i) {
      const double count = std::ceil(extent[i] / longest * along / 8 - 1e-9);
      cells[static_cast<size_t>(i)] = 8 * static_cast<uint32_t>(std::max(count, 1.0));
    }
    if (uint64_t{cells[0]} * cells[1] * cells[2] <= uint64_t{edge} * edge * edge) {
      shape.cells = cells;
      cube = longest / along;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double grown = cube * shape.cells[static_cast<size_t>(i)] / extent[i] * shape.size[i];
    shape.origin[i] -= 0.5 * (grown - shape.size[i]);
    shape.size[i] = grown;
  }
  return shape;
}

double thinDepth(const VolumeState& volume) {
  double extinction = 0;  // where light meets it, without the peak, 1/m
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    if (field.external) {
      return UNKNOWN_DEPTH;
    }
    if (field.mean > 0) {
      const Particle& particle = *field.medium.particle;
      const double peak = meanAlbedo(field) * field.tables->own.transport(particle).peak;
      extinction += field.extinctionScale * field.medium.extinctionFactor() * (1 - peak) *
                    field.meanSquare / field.mean;
    }
  }
  if (!(extinction > 0)) {
    return UNKNOWN_DEPTH;
  }
  const glm::dvec3 extent = extentOf(volume, filledBox(volume));
  return std::min(extinction * std::min({extent.x, extent.y, extent.z}), UNKNOWN_DEPTH);
}

double turnedShare(const VolumeState& volume) {
  return -std::expm1(-thinDepth(volume));
}

}  // namespace welkin
