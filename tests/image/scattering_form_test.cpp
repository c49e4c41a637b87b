// SPDX-License-Identifier: MIT
// Poisson counts of scatterings against the paper's whole numbers: both selectable, per view.
#include <gtest/gtest.h>

#include "support/headless_scene.hpp"

namespace {

using namespace welkin::test;

class Forms : public ::testing::Test {
 protected:
  Forms() {
    scene_.setSun(40, 60);
    scene_.addBall(0.004f);
  }
  Image render(uint32_t scattering) const {
    auto quality = welkin::make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = scattering;
    welkin::check(wlkSetQuality(scene_.context, scene_.view, &quality));
    const Image image = scene_.render();
    EXPECT_EQ(image.badValues(), 0u);
    return image;
  }
  HeadlessScene scene_;
};

TEST_F(Forms, WholeNumbersAreAnotherPictureAndPoissonComesBack) {
  const Image poisson = render(WLK_SCATTERING_FORWARD);
  const Image whole = render(WLK_SCATTERING_FORWARD_INTEGER);
  // Counts rounded up scatter the light more than it is: the pictures differ, but not wildly.
  const double difference = relativeRms(whole, poisson);
  EXPECT_GT(difference, 0.01);
  EXPECT_LT(difference, 2);
  EXPECT_TRUE(render(WLK_SCATTERING_FORWARD) == poisson);
  EXPECT_TRUE(render(WLK_SCATTERING_DEFAULT) == render(WLK_SCATTERING_ALL_ORDERS));
  EXPECT_TRUE(scene_.messages().empty()) << scene_.messages().front();
}

// Two views of one volume, each with its own form: neither sees the other's table.
TEST_F(Forms, ViewsKeepTheirOwn) {
  const Image poisson = render(WLK_SCATTERING_FORWARD);
  auto quality = welkin::make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = WLK_SCATTERING_FORWARD_INTEGER;
  const WlkView other = scene_.addView(scene_.options());
  welkin::check(wlkSetQuality(scene_.context, other, &quality));
  EXPECT_TRUE(scene_.render() == poisson);
  EXPECT_TRUE(scene_.messages().empty()) << scene_.messages().front();
}

}  // namespace
