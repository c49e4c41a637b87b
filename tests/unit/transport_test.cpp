// SPDX-License-Identifier: MIT
// src/frame/transport: how many cells a layer has along its normal and its plane, and what share of
// the peak's turns a volume gets, from the optical depth across it.
#include "frame/transport.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory_resource>

namespace {

using namespace welkin;

class Transport : public ::testing::Test {
 protected:
  Transport() {
    volume_.size = {16, 16, 16};
    peak_ = addField(0.85, 1);
    place(40, 1);
  }

  // The medium's peak.
  double addField(double asymmetry, double albedo) {
    ParticleParams params;
    params.asymmetry = asymmetry;
    params.analytic = true;
    FieldState& field = volume_.fields[volume_.fieldCount++];
    field.medium = makeMedium(ParticleType::HenyeyGreenstein, params, {albedo, albedo, albedo});
    field.tables = std::make_shared<MediumTables>();
    return field.tables->own.transport(*field.medium.particle).peak;
  }

  // A box `width` long, wide, and `height` high, y up.
  void place(double width, double height) {
    volume_.worldFromBox[0] = {width, 0, 0};
    volume_.worldFromBox[1] = {0, height, 0};
    volume_.worldFromBox[2] = {0, 0, width};
    height_ = height;
  }

  // Optical depth of filled columns, the peak included; rows of voxels [0, rows) are filled, a part
  // `cover` of them.
  void fill(double depth, uint32_t rows = 16, double cover = 1, size_t index = 0) {
    FieldState& field = volume_.fields[index];
    const double value = depth / height_ * 16 / rows;
    field.extinctionScale = 1;
    field.mean = cover * rows / 16 * value;
    field.meanSquare = field.mean * value;
    field.filled.first = {0, 0, 0};
    field.filled.end = {16, rows, 16};
  }

  VolumeState volume_{std::pmr::get_default_resource()};
  double peak_ = 0;
  double height_ = 1;
};

TEST_F(Transport, ThinDepthIsThatOfColumnsWithoutThePeak) {
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

TEST_F(Transport, WhatIsNotKnownCountsAsThick) {
  EXPECT_EQ(thinDepth(volume_), UNKNOWN_DEPTH) << "nothing uploaded";
  EXPECT_EQ(turnedShare(volume_), 1);
  fill(0.1);
  volume_.fields[0].external.emplace();
  EXPECT_EQ(thinDepth(volume_), UNKNOWN_DEPTH) << "an engine's image";
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{32, 32, 32}));
}

TEST_F(Transport, LayersHaveTheCellsThatTheirDepthAsksFor) {
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

// Only layers: elsewhere cells are cubes, or as many along each axis.
TEST_F(Transport, OtherVolumesHaveCellsByTheirShapeAlone) {
  place(1, 1);
  fill(0.01);
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{32, 32, 32}));
  place(5, 1);
  fill(0.01);
  EXPECT_EQ(transportShape(volume_, 32).cells, (std::array<uint32_t, 3>{32, 32, 32}));
}

TEST_F(Transport, MediaStayWhereTheDepthHardlyChanges) {
  fill(1.5);
  volume_.transport = std::make_shared<const TransportMedia>(transportMedia(volume_));
  EXPECT_EQ(mediaChange(volume_), 0);
  fill(1.52);
  EXPECT_EQ(mediaChange(volume_), 0) << "within a step";
  fill(3);
  EXPECT_GT(mediaChange(volume_), 0.05);
  volume_.fields[0].mean = volume_.fields[0].meanSquare = 0;
  EXPECT_EQ(mediaChange(volume_), 0) << "nothing is there any more";
  // A thin layer's light has been turned less often.
  fill(0.1);
  const TransportMedia thin = transportMedia(volume_);
  EXPECT_LT(thin.turned, 0.1);
  EXPECT_GT(thin.fieldMoments[0][2], volume_.transport->fieldMoments[0][2]);
}

// Between two turns by the rest the peaks of all fields turn light (F / (1 - F) times in the mean,
// F being albedo times energy of the peaks in the mixture), not each field's own as often as it
// would alone.
TEST_F(Transport, AbsorptionAndFieldsWithoutAPeakLeaveFewerTurns) {
  const double own = peak_ / (1 - peak_);
  const auto shapeOf = [&](double albedo, size_t fields) {
    volume_.fieldCount = 0;
    addField(0.85, albedo);
    fill(1e3);
    if (fields > 1) {
      addField(0, 1);
      fill(1e3, 16, 1, 1);
    }
    const TransportMedia media = transportMedia(volume_);
    // The rest's moment of degree 2 over albedo, by undoing what fieldMoments does.
    const double moment = media.fieldMoments[0][2] * (1 - media.peak) + media.peak;
    return (moment / albedo - peak_) / (1 - peak_);
  };
  ParticleTables& tables = volume_.fields[0].tables->own;
  const Particle& particle = *volume_.fields[0].medium.particle;
  const double sharp = tables.transport(particle).moments[2];
  const double turned = tables.turned(particle).moments[2];
  const auto partOf = [&](double moment) { return (moment - sharp) / (turned - sharp); };
  constexpr double STEP = 0.5 / 16 + 1e-3;
  EXPECT_NEAR(partOf(shapeOf(1, 1)), 1, 1e-3);
  const double dark = 0.5 * peak_ / (1 - 0.5 * peak_);
  EXPECT_NEAR(partOf(shapeOf(0.5, 1)), dark / own, STEP);
  const double half = 0.5 * peak_ / (1 - 0.5 * peak_);
  EXPECT_NEAR(partOf(shapeOf(1, 2)), half / own, STEP);
}

}  // namespace
