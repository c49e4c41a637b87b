// SPDX-License-Identifier: MIT
// Views at the edge: along and against the sun, inside a cloud, far away, far from the origin, odd
// sizes, every composite mode and slicing.
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

constexpr std::array<uint32_t, 3> SIZE{8, 8, 8};

SceneOptions odd() {
  SceneOptions options;
  options.width = 17;  // odd: the middle pixel looks exactly along the view's axis
  options.height = 13;
  options.volumeCells = 8;
  return options;
}

void expectFinite(const HeadlessScene& scene) {
  EXPECT_EQ(scene.render().badValues(), 0u);
  EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

void setLight(const HeadlessScene& scene, const std::array<float, 3>& direction, float diameter) {
  auto light = make<WlkLight>();
  std::memcpy(light.direction, direction.data(), sizeof light.direction);
  light.angularDiameter = diameter;
  check(wlkSetLights(scene.context, 1, sizeof light, &light));
}

WlkVolume denseBox(const HeadlessScene& scene, const std::array<double, 3>& lo,
                   const std::array<double, 3>& edges) {
  const WlkVolume volume =
      scene.addVolume(scene.addMedium(), SIZE, boxTransform(lo, edges), 0.005f);
  scene.upload(volume, SIZE, std::vector<float>(512, 1.0f));  // up to the faces
  return volume;
}

TEST(ViewAndSun, ExactlyAlongAndAgainstEachOtherAreFinite) {
  const HeadlessScene scene(odd());
  scene.setSky();
  scene.setFog(1e-3f, 100.0f);
  denseBox(scene, {-400, -400, -400}, {800, 800, 800});
  struct Case {
    double yaw_deg, pitch_deg;
    std::array<float, 3> axis;
  };
  const std::vector<Case> cases{{0, 0, {0, 0, -1}},
                                {90, 0, {1, 0, 0}},
                                {0, 90, {0, 1, 0}},
                                {0, -90, {0, -1, 0}},
                                {180, 0, {0, 0, 1}}};
  for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.volumeCells = 8;
    quality.slicing = slicing;
    ASSERT_EQ(wlkSetQuality(scene.context, scene.view, &quality), WLK_SUCCESS);
    for (const Case& test : cases) {
      // Along the axis, and where the sign is negative against it.
      for (const float diameter : {0.0f, -0.0f, 0.0093f, -0.0093f}) {
        const float sign = std::signbit(diameter) ? -1.0f : 1.0f;
        setLight(scene, {sign * test.axis[0], sign * test.axis[1], sign * test.axis[2]},
                 std::abs(diameter));
        // In the middle of the box, on a face, on a corner, outside.
        for (const std::array<double, 3>& eye :
             {std::array<double, 3>{0, 0, 0}, {0, 0, 400}, {400, 400, 400}, {0, 2, 3000}}) {
          SCOPED_TRACE(std::to_string(slicing) + ": " + std::to_string(test.yaw_deg) + ", " +
                       std::to_string(test.pitch_deg) + ", eye z " + std::to_string(eye[2]));
          scene.setCamera(eye, test.yaw_deg, test.pitch_deg);
          expectFinite(scene);
        }
      }
    }
  }
}

TEST(ViewAndSun, ANearlyParallelPairIsFinite) {
  const HeadlessScene scene(odd());
  scene.setSky();
  denseBox(scene, {-400, -400, -2000}, {800, 800, 800});
  scene.setCamera({0, 2, 0}, 0, 0);
  for (const float tilt : {1e-7f, 1e-6f, 1e-5f, 1e-4f, 1e-3f}) {
    for (const float z : {-1.0f, 1.0f}) {
      SCOPED_TRACE(tilt);
      setLight(scene, {tilt, tilt, z}, 1e-5f);
      expectFinite(scene);
      setLight(scene, {z, tilt, tilt}, 1e-9f);  // at a right angle, nearly
      expectFinite(scene);
    }
  }
}

TEST(FarAway, CamerasAtAnyAltitudeAreFinite) {
  const HeadlessScene scene(odd());
  scene.setSky();
  scene.setFog(0.01f, 50.0f);
  scene.setSun(20, 100);
  scene.addBall(0.01f);
  for (const double altitude :
       {-1e9, -1.3e7, -6.371e6, -1e5, -500.0, -1e-3, 0.0, 1e-3, 1e3, 1e5, 1e6, 1e9}) {
    for (const double pitch_deg : {-90.0, -10.0, 0.0, 90.0}) {
      SCOPED_TRACE(std::to_string(altitude) + " m, pitch " + std::to_string(pitch_deg));
      scene.setCamera({0, altitude, 0}, 0, pitch_deg);
      expectFinite(scene);
    }
  }
  for (const double distance : {1e4, 1e6, 1e8, 1e9}) {
    SCOPED_TRACE(distance);
    scene.setCamera({0, 1500, -5000 + distance}, 0, 0);
    expectFinite(scene);
  }
}

TEST(FarAway, AWorldOffsetOf1e7MetresLeavesThePicture) {
  const HeadlessScene scene(odd());
  scene.setSky();
  scene.setFog(2e-4f, 200.0f);
  scene.setSun(30, 40);
  const WlkVolume volume = denseBox(scene, {-300, 200, -1500}, {600, 400, 500});
  scene.setCamera({0, 2, 0}, 0, 15);
  const Image atOrigin = scene.render();
  auto planet = make<WlkPlanet>();
  const std::array<double, 3> offset{1e7, -2e7, 1e7};
  std::memcpy(planet.seaLevelPoint, offset.data(), sizeof planet.seaLevelPoint);
  ASSERT_EQ(wlkSetPlanet(scene.context, &planet), WLK_SUCCESS);
  const auto moved =
      boxTransform({offset[0] - 300, offset[1] + 200, offset[2] - 1500}, {600, 400, 500});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, moved.data()), WLK_SUCCESS);
  scene.setCamera({offset[0], offset[1] + 2, offset[2]}, 0, 15);
  const Image farAway = scene.render();
  // Positions are differences of doubles: 2e7 m have an ulp of 4e-9 m, 1e-11 of the distances here.
  // What remains is that of rounding to float, 6e-8, times a condition of some 10 steps.
  constexpr double FLOAT_EPSILON = 6e-8;
  constexpr double CONDITION = 100.0;
  const double rms = relativeRms(farAway, atOrigin);
  RecordProperty("relativeRms", std::to_string(rms));
  EXPECT_LE(rms, FLOAT_EPSILON * CONDITION);
}

TEST(ViewSize, OddSizesAreFiniteAndLeaveNoPixelOut) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 65u}, {641u, 359u}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    SceneOptions options;
    options.width = width;
    options.height = height;
    const HeadlessScene scene(options);
    scene.setSky();
    scene.setSun(30, 40);
    scene.addBall(0.01f);
    scene.setCamera({0, 2, 0}, 0, 15);
    const Image image = scene.render();
    EXPECT_EQ(image.badValues(), 0u);
    // No pixel was left out: the sky is nowhere black.
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        ASSERT_GT(image.at(x, y)[2], 0.0f) << x << ", " << y;
      }
    }
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
}

TEST(ViewModes, SeparateTargetsAndExtremeQualitiesAreFinite) {
  SceneOptions options = odd();
  options.composite = WLK_COMPOSITE_SEPARATE;
  const HeadlessScene scene(options);
  scene.setSky();
  scene.setSun(30, 40);
  scene.addBall(0.01f);
  scene.setCamera({0, 2, 0}, 0, 15);
  struct Case {
    uint32_t slices, batch, light, slicing, scattering;
  };
  for (const Case& test : {Case{8, 1, 16, 0, 0}, Case{8, 8, 16, 2, 1}, Case{9, 2, 17, 1, 2},
                           Case{2048, 2048, 16, 0, 0}, Case{63, 64 - 1, 33, 1, 1}}) {
    SCOPED_TRACE(test.slices);
    auto quality = make<WlkQuality>();
    quality.sliceCount = test.slices;
    quality.batchSize = test.batch;
    quality.lightBufferSize = test.light;
    quality.slicing = test.slicing;
    quality.scattering = test.scattering;
    ASSERT_EQ(wlkSetQuality(scene.context, scene.view, &quality), WLK_SUCCESS);
    expectFinite(scene);
    const Image transmittance = scene.read(WLK_IMAGE_TRANSMITTANCE);
    EXPECT_EQ(transmittance.badValues(), 0u);
    for (const float t : transmittance.rgba) {
      EXPECT_LE(t, 1.0f);
    }
  }
}

}  // namespace
}  // namespace welkin::test
