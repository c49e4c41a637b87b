// SPDX-License-Identifier: MIT
// src/frame/transport: how the media of a volume follow its optical depth, absorption and mixture.
#include "frame/transport.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "transport_volume.hpp"

namespace {

using namespace welkin;

using Transport = transport_test::TransportVolume;

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
