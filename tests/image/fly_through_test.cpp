// SPDX-License-Identifier: MIT
// Exact limit: light changes without jumps. A camera that rises from the ground to space and a sun
// that sinks from day into night pass every place where the library changes its method (tables of
// all light, of further orders, gathering by pixel), and no frame may stand out from its
// neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

// Mean of the colours over an upper and a lower half and of the middle pixel of the top row.
struct Frame {
  std::array<double, 3> parts{};
};

Frame frameOf(const Image& picture) {
  Frame frame;
  const uint32_t half = picture.height / 2;
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        frame.parts[y < half ? 0 : 1] += static_cast<double>(picture.at(x, y)[c]);
      }
    }
  }
  for (int c = 0; c < 3; ++c) {
    frame.parts[2] += static_cast<double>(picture.at(picture.width / 2, 0)[c]);
  }
  return frame;
}

// Twice how far a frame lies from the cubic through its two neighbours on either side, relative:
// what is smooth does not show in that, and a step shows at its full size.
double worstStep(const std::vector<Frame>& frames, size_t part, double darkest, size_t* where) {
  double worst = 0;
  for (size_t i = 2; i + 2 < frames.size(); ++i) {
    const auto at = [&](size_t k) { return frames[k].parts[part]; };
    if (!(at(i) > darkest)) {
      continue;
    }
    const double smooth = (4 * (at(i - 1) + at(i + 1)) - at(i - 2) - at(i + 2)) / 6;
    const double step = 2 * std::abs(at(i) - smooth) / at(i);
    if (step > worst) {
      worst = step;
      *where = i;
    }
  }
  return worst;
}

class FlyThrough : public ::testing::Test {
 protected:
  static SceneOptions options() {
    SceneOptions result;
    result.width = 16;
    result.height = 12;
    result.layers = WLK_LAYER_SKY | WLK_LAYER_GROUND;
    result.validation = false;
    return result;
  }
  static constexpr double STEP = 0.005;  // what may not be seen between neighbours

  void expectSmooth(const std::vector<Frame>& frames, double darkest) {
    const char* names[3] = {"upper half", "lower half", "one pixel"};
    for (size_t part = 0; part < 3; ++part) {
      size_t where = 0;
      const double step = worstStep(frames, part, darkest, &where);
      std::printf("%s: largest step %.3f %% at frame %zu of %zu\n", names[part], 100 * step, where,
                  frames.size());
      EXPECT_LE(step, STEP) << names[part] << " at frame " << where;
    }
  }

  HeadlessScene scene{options()};
};

TEST_F(FlyThrough, FromTheGroundToSpaceNothingJumps) {
  scene.setSky();
  for (const double sun_deg : {50.0, 10.0}) {
    scene.setSun(sun_deg, 40);
    // Off the horizon, which jumps from one row of pixels to the next.
    for (const double pitch_deg : {35.0, -60.0}) {
      std::vector<Frame> frames;
      for (int i = 0; i <= 500; ++i) {
        const double x = i / 500.0;
        scene.setCamera({0, 2 + 4e5 * x * x * x, 0}, 0, pitch_deg);
        frames.push_back(frameOf(scene.render()));
      }
      expectSmooth(frames, 1e-4);
    }
  }
}

// Where the table ceases to hold all light while a light is low.
TEST_F(FlyThrough, InTwilightNothingJumps) {
  scene.setSky();
  for (const double sun_deg : {2.0, -2.0, -4.0}) {
    scene.setSun(sun_deg, 40);
    for (const double pitch_deg : {35.0, -60.0}) {
      std::vector<Frame> frames;
      for (int i = 0; i <= 100; ++i) {
        scene.setCamera({0, 1200 + 8.0 * i, 0}, 0, pitch_deg);
        frames.push_back(frameOf(scene.render()));
      }
      expectSmooth(frames, 1e-7);
    }
  }
}

TEST_F(FlyThrough, FromDayIntoNightNothingJumps) {
  scene.setSky();
  for (const double altitude : {2.0, 9000.0}) {
    scene.setCamera({0, altitude, 0}, 0, 35);
    std::vector<Frame> frames;
    for (int i = 0; i <= 780; ++i) {
      scene.setSun(60 - 0.1 * i, 40);
      frames.push_back(frameOf(scene.render()));
    }
    expectSmooth(frames, 1e-7);
    // The zenith side of the picture only darkens once the sun is down.
    for (size_t i = 600; i + 1 < frames.size(); ++i) {
      EXPECT_LT(frames[i + 1].parts[2], frames[i].parts[2]) << "frame " << i;
    }
  }
}

}  // namespace
}  // namespace welkin::test
