// SPDX-License-Identifier: MIT
// The hosts with a window in a virtual display: no validation message, a picture in the file, and
// the same picture from every composite mode.
#include <gtest/gtest.h>

#include <string>

#include "host_program.hpp"

namespace {

using namespace host_program;

// A screenshot after a few frames, under validation.
Picture screenshot(const std::string& mode, const std::string& more = "") {
  const std::string file = temporary(mode + ".png");
  EXPECT_EQ(runWindow("--validate --quality low --frames 4 --composite " + mode + " --size " +
                      size(WIDTH, HEIGHT) + " --screenshot " + file + " " + more),
            0)
      << mode;
  Picture picture = readPicture(file);
  EXPECT_EQ(picture.width, WIDTH);
  EXPECT_EQ(picture.height, HEIGHT);
  return picture;
}

TEST(WindowSample, EveryCompositeModeShowsTheSamePictureWithoutAMessage) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  const Picture compute = screenshot("compute");
  ASSERT_FALSE(compute.empty());
  // Daylight: sky above, a darker meadow below, neither black nor white.
  const double top = mean(compute, {0, 0, WIDTH, HEIGHT / 2});
  const double bottom = mean(compute, {0, HEIGHT / 2, WIDTH, HEIGHT});
  EXPECT_GT(top, 80.0);
  EXPECT_LT(top, 240.0);
  EXPECT_GT(bottom, 30.0);
  EXPECT_LT(bottom, top);
  for (const char* mode : {"blend", "separate"}) {
    const Picture picture = screenshot(mode);
    EXPECT_LE(largestDifference(picture, compute), ROUNDING) << mode;
  }
}

TEST(WindowSample, ThePanelLiesOverThePictureAndChangesNothingBesides) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  // The panel is 380 pixels wide.
  const auto wide = [](const std::string& more) {
    const std::string file = temporary("wide.png");
    EXPECT_EQ(runWindow("--validate --quality low --frames 4 --size 640x360 --screenshot " + file +
                        " " + more),
              0);
    return readPicture(file);
  };
  const Picture without = wide("");
  const Picture with = wide("--panel");
  ASSERT_EQ(without.width, 640);
  ASSERT_EQ(with.width, 640);
  const Region beside{390, 0, 640, 360};
  EXPECT_EQ(cut(with, beside), cut(without, beside));
  size_t covered = 0;
  for (int i = 0; i < 380 * 360; ++i) {
    covered += with.at(i % 380, i / 380, GREEN) != without.at(i % 380, i / 380, GREEN) ? 1u : 0u;
  }
  EXPECT_GT(covered, 300u * 200u) << "most of the panel's area";
}

// A mesh with detail in the engine's frames: white in the middle of a blue sky.
TEST(WindowSample, ShowsACloudBoundedByAMesh) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  const Picture picture =
      screenshot("compute", std::string("--scene ") + WELKIN_SCENES + "/surface-cumulus.json");
  ASSERT_FALSE(picture.empty());
  EXPECT_GT(picture.at(WIDTH / 2, HEIGHT / 2, RED), 180);
  EXPECT_LT(picture.at(WIDTH / 8, HEIGHT / 8, RED), 120);
}

TEST(WindowSample, BadOptionsAreErrors) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  EXPECT_NE(runWindow("--composite sideways 2>/dev/null"), 0);
  EXPECT_NE(runWindow("--size 12 2>/dev/null"), 0);
  EXPECT_NE(runWindow("--scene missing.json 2>/dev/null"), 0);
  EXPECT_NE(runWindow("--screenshot a.png 2>/dev/null"), 0) << "a screenshot needs --frames";
}

// z up, left-handed, 24-bit depth, two views, three frames in flight, a shared queue.
TEST(QtSample, ShowsACloudInASkyAboveMeadowWithoutAMessage) {
  SKIP_WITHOUT(WELKIN_QT);
  const std::string file = temporary("qt.png");
  ASSERT_EQ(runProgram(WELKIN_QT, "--validate --quality low --frames 5 --size " +
                                      size(WIDTH, HEIGHT) + " --screenshot " + file),
            0);
  const Picture picture = readPicture(file);
  ASSERT_EQ(picture.width, WIDTH);
  ASSERT_EQ(picture.height, HEIGHT);
  // A blue sky at the top; grass, green before blue, at the bottom; neither black nor white.
  const Region top{0, 0, WIDTH, 8};
  const Region bottom{0, HEIGHT - 20, WIDTH, HEIGHT};
  EXPECT_GT(mean(picture, top, BLUE), mean(picture, top, RED) + 20.0);
  EXPECT_LT(mean(picture, top, BLUE), 250.0);
  EXPECT_GT(mean(picture, bottom, GREEN), mean(picture, bottom, BLUE) + 20.0);
  // Each view has a cloud, and sky beside it: above it in the left one, below in the right one.
  const struct {
    const char* view;
    Region cloud, sky;
  } views[]{{"left", {10, 40, 60, 50}, {10, 5, 60, 20}},
            {"right", {240, 20, 310, 50}, {290, 72, 318, 82}}};
  for (const auto& [view, cloud, sky] : views) {
    // Sunlit and white; red is what a sky has least of, so that it tells them apart best.
    EXPECT_GT(mean(picture, cloud, RED), mean(picture, sky, RED) + 50.0) << view;
    EXPECT_GT(mean(picture, cloud), mean(picture, sky) + 20.0) << view;
    EXPECT_NEAR(mean(picture, cloud, RED), mean(picture, cloud, BLUE), 15.0) << view;
    EXPECT_GT(mean(picture, sky, BLUE), mean(picture, sky, RED) + 50.0) << view;
  }
}

TEST(QtSample, BadOptionsAreErrors) {
  SKIP_WITHOUT(WELKIN_QT);
  EXPECT_NE(runProgram(WELKIN_QT, "--quality best >/dev/null 2>&1"), 0);
  EXPECT_NE(runProgram(WELKIN_QT, "--screenshot a.png >/dev/null 2>&1"), 0);
}

}  // namespace
