// SPDX-License-Identifier: MIT
// src/frame/transport_shape: how many cells a layer has along its normal and its plane, and what
// share of the peak's turns a volume gets, from the optical depth across it.
#include "frame/transport_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "transport_volume.hpp"

namespace {

using namespace welkin;

using TransportShapeOf = transport_test::TransportVolume;

TEST_F(TransportShapeOf, ThinDepthIsThatOfColumnsWithoutThePeak) {
  fill(3);
  EXPECT_NEAR(thinDepth(volume_), 3 * (1 - peak_), 1e-6);
  EXPECT_NEAR(turnedShare(volume_), 1 - std::exp(-3 * (1 - peak_)), 1e-6);
  // The same columns in the lower quarter of the box; of a broken field those of its clouds.
  fill(3, 4);
  volume_.fields[0].filled.end[1] = 4;
  EXPECT_NEAR(thinDepth(volume_), 3 * (1 - peak_) * 4.5 / 4, 1e-6) << "and half a voxel's filter";
  fill(3, 16, 0.05);
  EXPECT_NEAR(thinDepth(volume_), 3 * (1 - peak_), 1e-6);
  // The shortest edge counts, whichever it is.
  place(1, 40);
  fill(3);
  EXPECT_NEAR(thinDepth(volume_), 3 * (1 - peak_) / 40, 1e-6);
}

TEST_F(TransportShapeOf, WhatIsNotKnownCountsAsThick) {
  EXPECT_EQ(thinDepth(volume_), UNKNOWN_DEPTH) << "nothing uploaded";
  EXPECT_EQ(turnedShare(volume_), 1);
  fill(0.1);
  volume_.fields[0].external.emplace();
  EXPECT_EQ(thinDepth(volume_), UNKNOWN_DEPTH) << "an engine's image";
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{32, 32, 32}));
}

TEST_F(TransportShapeOf, LayersHaveTheCellsThatTheirDepthAsksFor) {
  for (const uint32_t edge : {8u, 16u, 24u, 32u, 40u, 64u, 128u}) {
    uint32_t before = 0;
    for (const double depth : {1e-3, 1.0, 4.0, 16.0, 40.0, 100.0, 1e4}) {
      fill(depth);
      const TransportShape shape = transportShape(volume_, edge);
      ASSERT_TRUE(shape.layer);
      ASSERT_EQ(shape.thinAxis, 1);
      const auto [x, y, z] = shape.cells;
      EXPECT_EQ(x, z);
      EXPECT_GE(x, edge);
      EXPECT_LE(x, transportImageEdge(edge));
      EXPECT_LE(uint64_t{x} * y * z, uint64_t{edge} * edge * edge) << edge << " " << depth;
      EXPECT_EQ((x | y) % 8, 0u);
      EXPECT_GE(y, before) << "deeper layers have no fewer cells along their normal";
      // No cell is deeper than one of `edge` would be, or than 0.6.
      EXPECT_LE(depth * (1 - peak_) / y, std::max(0.6 * (1 + 1e-6), depth * (1 - peak_) / edge));
      before = y;
    }
    EXPECT_EQ(before, edge) << "of a deep one all as they were";
  }
  fill(1);
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{48, 8, 48}));
  // Half a cell has no more voxels than are read of it.
  volume_.size = {16, 200, 16};
  volume_.fields[0].filled.end[1] = 200;
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{40, 16, 40}));
}

TEST_F(TransportShapeOf, RaysInFlatVolumesHaveStretchesEnough) {
  constexpr uint32_t FEW = 16;
  for (const uint32_t edge : {8u, 16u, 24u, 32u, 64u, 128u}) {
    for (const uint32_t slices : {FEW, 512u}) {
      fill(1);
      const double across = flatStretchesAcross(slices);
      const TransportShape shape = transportShape(volume_, edge);
      EXPECT_EQ(flatStretches(shape, slices, false), glm::dvec3(0, across, 0));
      const glm::dvec3 stretches = flatStretches(shape, slices, true);
      EXPECT_EQ(stretches.y, std::max<double>(across, shape.cells[1])) << edge << " " << slices;
      EXPECT_EQ(stretches.x, stretches.z);
    }
  }
  // Cells of 48 x 8 x 48: two to a cell; of 128^3 one.
  EXPECT_EQ(flatStretches(transportShape(volume_, 32), FEW, true), glm::dvec3(96, 16, 96));
  fill(1e4);
  EXPECT_EQ(flatStretches(transportShape(volume_, 128), FEW, true), glm::dvec3(128));
  fill(1);
  EXPECT_EQ(flatStretchesAcross(FEW), flatStretchesAcross(256));
  EXPECT_EQ(flatStretchesAcross(2048), 2 * flatStretchesAcross(1024)) << "up to any limit";
  // Across what is filled, not across the box around it.
  fill(1, 4);
  volume_.fields[0].filled.end[1] = 4;
  const double stretches = flatStretches(transportShape(volume_, 32), FEW, false).y;
  EXPECT_NEAR(stretches * 4.5 / 16, flatStretchesAcross(FEW), 1e-9);
  place(5, 1);
  fill(1);
  for (const bool transport : {false, true}) {
    EXPECT_EQ(flatStretches(transportShape(volume_, 32), FEW, transport),
              glm::dvec3(0, flatStretchesAcross(FEW), 0))
        << "flat, no layer: cells are cubes";
  }
  place(1, 1);
  fill(1);
  EXPECT_EQ(flatStretches(transportShape(volume_, 32), FEW, true), glm::dvec3(0)) << "not flat";
}

// Only layers: elsewhere cells are cubes, or as many along each axis.
TEST_F(TransportShapeOf, OtherVolumesHaveCellsByTheirShapeAlone) {
  place(1, 1);
  fill(0.01);
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{32, 32, 32}));
  place(5, 1);
  fill(0.01);
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{32, 32, 32}));
}

}  // namespace
