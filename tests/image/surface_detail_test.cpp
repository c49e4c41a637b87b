// SPDX-License-Identifier: MIT
// Detail of cloud surfaces: what it takes is what the noise says, within the mesh; pictures repeat,
// go with the mesh, and lose nothing of the light.
#include <gtest/gtest.h>

#include <cmath>

#include "support/engine_scene.hpp"
#include "support/surface_scene.hpp"
#include "tables/detail_noise.hpp"

namespace welkin::test {
namespace {

constexpr float EXTINCTION = 8e-4f;
constexpr std::array<double, 3> MIDDLE{100, 900, -4000};
constexpr std::array<double, 3> HALF{700, 500, 900};
constexpr float DEPTH = 120;
constexpr float SIZE = 500;
constexpr float SOFTNESS = 0.4f;

SceneOptions separate() {
  SceneOptions options;
  options.composite = WLK_COMPOSITE_SEPARATE;
  options.width = 96;
  options.height = 72;
  return options;
}

class SurfaceDetailImage : public ::testing::Test {
 protected:
  ~SurfaceDetailImage() override {
    for (const std::string& message : scene.messages()) {
      ADD_FAILURE() << message;
    }
  }

  WlkSurface addBox() const {
    return addSurface(scene, support::boxMesh(), scene.addHenyeyGreenstein(0), EXTINCTION, HALF,
                      MIDDLE);
  }

  WlkSurface addTorus() const {
    return addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f, {900, 900, 900},
                      MIDDLE);
  }

  WlkResult setDetail(WlkSurface surface, float depth) const {
    auto detail = make<WlkSurfaceDetail>();
    detail.depth = depth;
    detail.size = SIZE;
    detail.softness = SOFTNESS;
    detail.offset[1] = 77;
    return wlkSetSurfaceDetail(scene.context, surface, &detail);
  }

  HeadlessScene scene{separate()};
};

// Density along a ray of the box, with the distance to the nearest face.
struct BoxRay {
  double filled = 0;        // m, of the core's density
  double sideways = 1e300;  // least distance to the box's sides
  double chord = 0;
};

BoxRay alongBox(const std::vector<uint8_t>& noise, const glm::dvec3& eye, const glm::dvec3& ray) {
  constexpr double STEP = 1;  // m
  const glm::dvec3 middle(MIDDLE[0], MIDDLE[1], MIDDLE[2]);
  const glm::dvec3 half(HALF[0], HALF[1], HALF[2]);
  const double begin = (middle.z + half.z - eye.z) / ray.z;
  const double end = (middle.z - half.z - eye.z) / ray.z;
  BoxRay result;
  result.chord = end - begin;
  for (double t = begin + STEP / 2; t < end; t += STEP) {
    const glm::dvec3 p = eye + t * ray - middle;
    const glm::dvec3 inside = half - glm::abs(p);
    result.sideways = std::min({result.sideways, inside.x, inside.y});
    const double period = double{SIZE} * DETAIL_LUMPS;
    const double n = detailNoiseAt(noise, {p.x / period, (p.y - 77) / period, p.z / period});
    const double softness = static_cast<double>(SOFTNESS);
    const double density = (inside.z / double{DEPTH} - (1 - softness) * n) / softness;
    result.filled += std::clamp(density, 0.0, 1.0) * STEP;
  }
  return result;
}

TEST_F(SurfaceDetailImage, TakesWhatTheNoiseSays) {
  const std::vector<uint8_t> noise = detailNoise();
  check(setDetail(addBox(), DEPTH));
  const glm::dvec3 eye(MIDDLE[0], MIDDLE[1], MIDDLE[2] + HALF[2] + 1200);
  scene.setCamera({eye.x, eye.y, eye.z}, 0, 0);
  scene.render();
  const Image image = scene.read(WLK_IMAGE_TRANSMITTANCE);
  int seen = 0;
  double worst = 0;
  double bias = 0;
  double taken = 0;
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const BoxRay truth = alongBox(noise, eye, pixelDirection(scene, x, y));
      if (truth.sideways > 2 * double{DEPTH}) {
        ++seen;
        const double filled =
            -std::log(static_cast<double>(image.at(x, y)[0])) / static_cast<double>(EXTINCTION);
        worst = std::max(worst, std::abs(filled - truth.filled));
        bias += filled - truth.filled;
        taken += truth.chord - truth.filled;
      }
    }
  }
  ASSERT_GT(seen, 150);
  RecordProperty("worst_m", std::to_string(worst));
  std::printf("%d rays: taken %.1f m in the mean, bias %.2f m, worst %.2f m\n", seen, taken / seen,
              bias / seen, worst);
  EXPECT_LT(worst, 20);
  EXPECT_LT(std::abs(bias / seen), 5);
}

TEST_F(SurfaceDetailImage, StaysWithinTheMesh) {
  const WlkSurface surface = addTorus();
  scene.setSun(40, 60);
  const Image plain = scene.render();
  const Image plainPasses = scene.read(WLK_IMAGE_TRANSMITTANCE);
  check(setDetail(surface, DEPTH));
  const Image eaten = scene.render();
  const Image eatenPasses = scene.read(WLK_IMAGE_TRANSMITTANCE);
  EXPECT_EQ(eaten.badValues(), 0u);
  int thinner = 0;
  for (size_t i = 0; i < plainPasses.rgba.size(); ++i) {
    EXPECT_GE(eatenPasses.rgba[i], plainPasses.rgba[i] - 1e-6f) << i;
    thinner += eatenPasses.rgba[i] > plainPasses.rgba[i] + 0.1f ? 1 : 0;
  }
  EXPECT_GT(thinner, 30);
  EXPECT_GT(relativeRms(eaten, plain), 0.05);
  // Taken away it leaves nothing behind.
  check(wlkSetSurfaceDetail(scene.context, surface, nullptr));
  EXPECT_TRUE(scene.render() == plain);
  check(setDetail(surface, 0));
  EXPECT_TRUE(scene.render() == plain);
  EXPECT_EQ(surfaceLightPass(scene).commands, 0u);
}

TEST_F(SurfaceDetailImage, FramesRepeatAndKeepTheCells) {
  const WlkSurface surface = addTorus();
  scene.setSun(40, 60);
  check(setDetail(surface, DEPTH));
  const Image first = scene.render();
  const uint32_t all = surfaceLightPass(scene).commands;
  EXPECT_TRUE(scene.render() == first);
  EXPECT_EQ(surfaceLightPass(scene).commands, 0u);
  scene.setSun(40, 61);
  EXPECT_FALSE(scene.render() == first);
  const uint32_t light = surfaceLightPass(scene).commands;
  EXPECT_EQ(all, light + 4);  // the cells stay
  scene.setSun(40, 60);
  EXPECT_TRUE(scene.render() == first);
  scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  EXPECT_TRUE(scene.render() == first);
  EXPECT_EQ(surfaceLightPass(scene).commands, all);
}

// A mesh that changes shows in the next frame as if it had always been so.
TEST_F(SurfaceDetailImage, FollowsTheMesh) {
  const WlkSurface surface =
      addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f, {1, 1, 1}, {0, 0, -4000});
  scene.setSun(40, 60);
  const auto scaled = [&](float scale) {
    setScaledPositions(scene, surface, support::torusMesh(), scale);
  };
  scaled(900);
  scene.render();
  check(setDetail(surface, DEPTH));
  const Image first = scene.render();
  scaled(500);
  EXPECT_FALSE(scene.render() == first);
  scaled(900);
  EXPECT_TRUE(scene.render() == first);
}

// Until they are uploaded, new positions change nothing: neither faces nor the cells under them.
TEST(SurfaceDetailEngine, PositionsWaitForTheUpdate) {
  EngineScene scene;
  scene.setCamera({0, 2, 0}, 0, 0);
  const WlkSurface surface =
      addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f, {1, 1, 1}, {0, 0, -4000});
  scene.setSun(40, 60);
  setScaledPositions(scene, surface, support::torusMesh(), 900);
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = DEPTH;
  detail.size = SIZE;
  check(wlkSetSurfaceDetail(scene.context, surface, &detail));
  check(wlkPrepare(scene.context));
  scene.renderFrame();
  const Image first = scene.read();
  EXPECT_GT(first.mean(), 0);
  setScaledPositions(scene, surface, support::torusMesh(), 500);
  scene.update = false;
  scene.renderFrame();
  EXPECT_TRUE(scene.read() == first);
  scene.update = true;
  scene.renderFrame();
  EXPECT_FALSE(scene.read() == first);
  setScaledPositions(scene, surface, support::torusMesh(), 900);
  scene.renderFrame();
  EXPECT_TRUE(scene.read() == first);
}

// Far from the world's origin, and turned with the camera, the same is seen.
TEST_F(SurfaceDetailImage, GoesWithTheMesh) {
  const WlkSurface surface = addTorus();
  check(setDetail(surface, DEPTH));
  scene.setCamera({0, 2, 0}, 0, 0);
  scene.render();
  const Image here = scene.read(WLK_IMAGE_TRANSMITTANCE);
  constexpr double AWAY = 1e6;
  const double moved[12] = {900, 0, 0,   MIDDLE[0] + AWAY, 0, 900, 0, MIDDLE[1],
                            0,   0, 900, MIDDLE[2] - AWAY};
  check(wlkSetSurfaceTransform(scene.context, surface, moved));
  scene.setCamera({AWAY, 2, -AWAY}, 0, 0);
  scene.render();
  EXPECT_LT(relativeRms(scene.read(WLK_IMAGE_TRANSMITTANCE), here), 1e-4);
  // A quarter turn to the right: x to z, z to -x.
  const double turned[12] = {0, 0, -900, -MIDDLE[2], 0, 900, 0, MIDDLE[1], 900, 0, 0, MIDDLE[0]};
  check(wlkSetSurfaceTransform(scene.context, surface, turned));
  scene.setCamera({0, 2, 0}, 90, 0);
  scene.render();
  EXPECT_LT(relativeRms(scene.read(WLK_IMAGE_TRANSMITTANCE), here), 1e-3);
}

// In light that is equal from everywhere a cloud that absorbs nothing is not seen.
TEST_F(SurfaceDetailImage, VanishesInAFurnace) {
  auto ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_GIVEN;
  for (size_t c = 0; c < 3; ++c) {
    ambient.sky[c] = ambient.ground[c] = 1;
  }
  check(wlkSetAmbient(scene.context, &ambient));
  check(setDetail(addTorus(), DEPTH));
  const Image light = scene.render();
  const Image passes = scene.read(WLK_IMAGE_TRANSMITTANCE);
  int covered = 0;
  for (size_t i = 0; i < light.rgba.size(); ++i) {
    if (i % 4 < 3) {
      covered += passes.rgba[i] < 0.5f ? 1 : 0;
      EXPECT_NEAR(light.rgba[i] + passes.rgba[i], 1, 1e-5) << i;
    }
  }
  EXPECT_GT(covered, 100);
}

}  // namespace
}  // namespace welkin::test
