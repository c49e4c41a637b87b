// SPDX-License-Identifier: MIT
// Parity: light of all orders in air and fog, as the passes draw it from the view's table (from
// space: gathered by every pixel), against wlkEvalSky, which gathers along each ray in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "support/headless_scene.hpp"
#include "support/on_gpu.hpp"

namespace welkin::test {
namespace {

struct Station {
  double altitude;
  double pitch_deg;
};

class SkyLightPicture : public ::testing::Test {
 protected:
  static SceneOptions options() {
    SceneOptions result;
    result.width = 40;
    result.height = 30;
    result.composite = WLK_COMPOSITE_SEPARATE;
    result.layers = WLK_LAYER_SKY | WLK_LAYER_FOG;
    return result;
  }

  void look(const Station& from, double yaw_deg) {
    scene.setCamera({300, from.altitude, -200}, yaw_deg, from.pitch_deg);
    position_ = {300, from.altitude, -200};
    yaw_ = yaw_deg * std::numbers::pi / 180;
    pitch_ = from.pitch_deg * std::numbers::pi / 180;
  }

  WlkRay rayOf(uint32_t x, uint32_t y) const {
    const auto camera = make<WlkCamera>();
    const SceneOptions& o = scene.options();
    const double lens = -static_cast<double>(camera.clipFromView[5]);
    const double right = (2 * (x + 0.5) / o.width - 1) / lens * o.width / o.height;
    const double up = -(2 * (y + 0.5) / o.height - 1) / lens;
    const double ahead = std::cos(pitch_) - up * std::sin(pitch_);
    double d[3] = {std::cos(yaw_) * right + std::sin(yaw_) * ahead,
                   std::sin(pitch_) + up * std::cos(pitch_),
                   std::sin(yaw_) * right - std::cos(yaw_) * ahead};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    WlkRay ray{};
    std::copy(position_.begin(), position_.end(), ray.origin);
    for (int k = 0; k < 3; ++k) {
      ray.direction[k] = d[k] / length;
    }
    ray.length = INFINITY;
    return ray;
  }

  // Of a ray that meets it. m.
  static double toTheGround(const WlkRay& ray) {
    constexpr double RADIUS = 6.371e6;
    const double x = ray.origin[0];
    const double y = RADIUS + ray.origin[1];
    const double z = ray.origin[2];
    const double along = -(x * ray.direction[0] + y * ray.direction[1] + z * ray.direction[2]);
    return along - std::sqrt(along * along - (x * x + y * y + z * z - RADIUS * RADIUS));
  }

  // The query counts light of the ground that fog turns a little as the fog's, the picture as the
  // ground's.
  void setBlackGround() const {
    auto planet = make<WlkPlanet>();
    std::fill_n(planet.groundAlbedo, 3, 0.0f);
    check(wlkSetPlanet(scene.context, &planet));
  }

  // Relative differences of all pixels and colours, in rising order; dark ones are left out.
  // surface: where the rays end, in parts of their way to sea level.
  std::vector<double> differences(double surface = INFINITY) {
    std::vector<WlkRay> rays;
    std::vector<float> depth;
    const auto camera = make<WlkCamera>();
    for (uint32_t y = 0; y < scene.options().height; ++y) {
      for (uint32_t x = 0; x < scene.options().width; ++x) {
        WlkRay ray = rayOf(x, y);
        ray.length = std::isinf(surface) ? surface : surface * toTheGround(ray);
        const double ahead = std::sin(pitch_) * ray.direction[1] +
                             std::cos(pitch_) * (std::sin(yaw_) * ray.direction[0] -
                                                 std::cos(yaw_) * ray.direction[2]);
        depth.push_back(static_cast<float>(static_cast<double>(camera.clipFromView[14]) /
                                           (ray.length * ahead)));
        rays.push_back(ray);
      }
    }
    auto targets = make<WlkHeadlessInputs>();
    targets.depth = depth.data();
    targets.depthSize = depth.size() * sizeof(float);
    const Image picture = scene.render(std::isinf(surface) ? nullptr : &targets);
    auto batch = make<WlkRayBatch>();
    batch.count = static_cast<uint32_t>(rays.size());
    batch.rays = rays.data();
    std::vector<double> expected(3 * rays.size());
    check(wlkEvalSky(scene.context, &batch, expected.data(), nullptr));
    EXPECT_EQ(picture.badValues(), 0u);
    constexpr double DARK = 1e-6;  // of the light's irradiance, per sr
    std::vector<double> result;
    for (size_t i = 0; i < rays.size(); ++i) {
      for (size_t c = 0; c < 3; ++c) {
        const double truth = expected[3 * i + c];
        if (truth > DARK) {
          const double value = static_cast<double>(picture.rgba[4 * i + c]);
          result.push_back(std::abs(value / truth - 1));
        }
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  // Over several suns and turns of the camera.
  void expectWithin(const Station& from, const std::vector<double>& suns_deg, double p95,
                    double worst) {
    for (const double sun_deg : suns_deg) {
      scene.setSun(sun_deg, 25);
      std::vector<double> all;
      for (const double yaw_deg : {20.0, 110.0, 215.0}) {
        look(from, yaw_deg);
        const std::vector<double> some = differences();
        all.insert(all.end(), some.begin(), some.end());
      }
      std::sort(all.begin(), all.end());
      ASSERT_FALSE(all.empty());
      const double high = all[static_cast<size_t>(0.95 * static_cast<double>(all.size() - 1))];
      std::printf("%8.0f m, sun %5.1f: median %.4f %%, p95 %.3f %%, worst %.3f %%\n", from.altitude,
                  sun_deg, 100 * all[all.size() / 2], 100 * high, 100 * all.back());
      EXPECT_LE(high, p95) << "sun at " << sun_deg;
      EXPECT_LE(all.back(), worst) << "sun at " << sun_deg;
    }
  }

  HeadlessScene scene{options()};

 private:
  std::array<double, 3> position_{};
  double yaw_ = 0;
  double pitch_ = 0;
};

// Exact limit: the table belongs to directions in the world, so a turn of the camera changes no
// direction's light. Odd sizes have a middle pixel.
class SkyLightTurned : public ::testing::Test {
 protected:
  static SceneOptions options() {
    SceneOptions result;
    result.width = 33;
    result.height = 25;
    return result;
  }
  HeadlessScene scene{options()};
};

TEST_F(SkyLightTurned, ADirectionsLightDoesNotDependOnTheCamera) {
  constexpr double ROUNDING = 2e-5;  // of a direction near the horizon in float
  scene.setSky();
  const double lens = -static_cast<double>(make<WlkCamera>().clipFromView[5]);
  for (const bool fog : {false, true}) {
    if (fog) {
      scene.setFog(1e-4f, 300);
    }
    for (const double altitude : {2.0, 5000.0, 4e5}) {
      scene.setSun(altitude > 1e5 ? 3 : 15, 30);
      scene.setCamera({0, altitude, 0}, 0, -2);
      check(wlkPrepare(scene.context));
      const Image first = scene.render();
      for (const uint32_t x : {0u, 9u, 27u}) {
        // Turned about the vertical towards a pixel of the middle row.
        const double pitch = -2 * std::numbers::pi / 180;
        const double right = (2 * (x + 0.5) / 33 - 1) / lens * 33 / 25;
        const double yaw = std::atan2(right, std::cos(pitch));
        const double up = std::atan2(std::sin(pitch), std::hypot(right, std::cos(pitch)));
        scene.setCamera({0, altitude, 0}, yaw * 180 / std::numbers::pi,
                        up * 180 / std::numbers::pi);
        const Image turned = scene.render();
        for (int c = 0; c < 3; ++c) {
          const double a = static_cast<double>(first.at(x, 12)[c]);
          const double b = static_cast<double>(turned.at(16, 12)[c]);
          EXPECT_NEAR(a, b, ROUNDING * a) << "pixel " << x << " from " << altitude << " m";
        }
        scene.setCamera({0, altitude, 0}, 0, -2);
      }
    }
  }
}

// Precision: the same sky where the world's numbers are large.
TEST_F(SkyLightTurned, TheSkyIsTheSameTenThousandKilometresFromTheOrigin) {
  scene.setSky();
  scene.setSun(20, 30);
  scene.setCamera({0, 1500, 0}, 10, 5);
  const Image here = scene.render();
  auto planet = make<WlkPlanet>();
  planet.seaLevelPoint[0] = 1e7;
  planet.seaLevelPoint[1] = -2e6;
  planet.seaLevelPoint[2] = 7e6;
  check(wlkSetPlanet(scene.context, &planet));
  scene.setCamera({1e7, 1500 - 2e6, 7e6}, 10, 5);
  const Image there = scene.render();
  EXPECT_GT(here.mean(), 0.0);
  EXPECT_LE(relativeRms(there, here), 1e-6);
}

TEST_F(SkyLightPicture, OfClearAirFollowsTheQuery) {
  scene.setSky();
  for (const Station& from : {Station{2, 20}, {2, 2}, {2000, 0}, {12000, -8}, {60000, -8}}) {
    expectWithin(from, {60, 20, 6, 0.5}, 0.005, 0.02);
  }
}

// Whether the table holds all light depends on how high the air is beside the planet.
TEST_F(SkyLightPicture, OfASmallPlanetFollowsTheQuery) {
  auto planet = make<WlkPlanet>();
  planet.radius = 6e5f;
  check(wlkSetPlanet(scene.context, &planet));
  auto sky = make<WlkSky>();
  sky.scaleHeight = 1500;
  for (float& one : sky.rayleighScattering) {
    one *= 5;
  }
  check(wlkSetSky(scene.context, &sky));
  for (const Station& from : {Station{2, 20}, {2500, 0}, {12000, -8}}) {
    expectWithin(from, {60, 20, 6, 3}, 0.005, 0.03);
  }
}

TEST_F(SkyLightPicture, WithOzoneFollowsTheQuery) {
  scene.setSky();
  const auto ozone = make<WlkAbsorber>();
  check(wlkSetAbsorber(scene.context, &ozone));
  for (const Station& from : {Station{2, 20}, {12000, -8}, {60000, -8}}) {
    expectWithin(from, {60, 6, -4}, 0.01, 0.05);
  }
  for (const Station& from : {Station{130000, -10}, {36e6, -87}}) {
    expectWithin(from, {60, 2}, 0.005, 0.1);
  }
}

// Sun and moon: a table each, side by side.
TEST_F(SkyLightPicture, OfTwoLightsFollowsTheQuery) {
  scene.setSky();
  setBlackGround();
  for (const double altitude : {2.0, 3e5}) {
    look({altitude, altitude > 1e5 ? -15.0 : 10.0}, 110);
    for (const bool fog : {false, true}) {
      if (fog) {
        scene.setFog(2e-5f, 300);
      } else {
        check(wlkSetFog(scene.context, nullptr));
      }
      for (const float height : {0.3f, -0.02f}) {
        WlkLight lights[2] = {make<WlkLight>(), make<WlkLight>()};
        lights[0].direction[0] = 0.8f;
        lights[0].direction[1] = height;
        lights[0].direction[2] = -std::sqrt(1 - 0.64f - height * height);
        lights[1].direction[0] = -0.6f;
        lights[1].direction[1] = 0.0f;
        lights[1].direction[2] = 0.8f;
        lights[1].irradiance[2] = 0.2f;
        check(wlkSetLights(scene.context, 2, sizeof *lights, lights));
        const std::vector<double> both = differences();
        ASSERT_FALSE(both.empty());
        const double p95 = both[static_cast<size_t>(0.95 * static_cast<double>(both.size() - 1))];
        std::printf("%.0f m, fog %d, height %.2f: p95 %.3f %%, worst %.3f %%\n", altitude,
                    fog ? 1 : 0, static_cast<double>(height), 100 * p95, 100 * both.back());
        // Fog's own table is coarser than twilight.
        EXPECT_LE(p95, fog && height < 0 ? 0.02 : 0.005);
        EXPECT_LE(both.back(), 0.1);
      }
    }
  }
}

// Exact limit: two lights in one direction are one with the sum of their irradiances, and a light
// that has set long ago is left out.
TEST_F(SkyLightTurned, LightsAddUp) {
  scene.setSky();
  scene.setCamera({0, 1500, 0}, 10, 5);
  scene.setSun(20, 30);
  const Image one = scene.render();
  WlkLight lights[2] = {make<WlkLight>(), make<WlkLight>()};
  for (WlkLight& light : lights) {
    const double elevation = 20 * std::numbers::pi / 180;
    const double azimuth = 30 * std::numbers::pi / 180;
    light.direction[0] = static_cast<float>(std::cos(elevation) * std::sin(azimuth));
    light.direction[1] = static_cast<float>(std::sin(elevation));
    light.direction[2] = static_cast<float>(-std::cos(elevation) * std::cos(azimuth));
  }
  std::fill_n(lights[0].irradiance, 3, 0.75f);
  std::fill_n(lights[1].irradiance, 3, 0.25f);
  check(wlkSetLights(scene.context, 2, sizeof *lights, lights));
  const Image sum = scene.render();
  // Floats; GPUs fuse, each pipeline in its own way, measured 2.2e-6.
  EXPECT_LE(relativeRms(sum, one), onGpu() ? 4e-6 : 1e-6);
  const auto invocations = [&] {
    uint64_t count = 0;
    for (const WlkPassStats& pass : scene.passes()) {
      count += pass.pass == WLK_PASS_SKY_TABLE ? pass.invocations : 0;
    }
    return count;
  };
  const uint64_t two = invocations();
  std::fill_n(lights[0].irradiance, 3, 1.0f);
  std::fill_n(lights[1].direction, 3, 0.0f);
  lights[1].direction[1] = -1;
  check(wlkSetLights(scene.context, 2, sizeof *lights, lights));
  const Image sunOnly = scene.render();
  EXPECT_LE(relativeRms(sunOnly, one), 1e-6);
  EXPECT_LT(invocations(), two);
}

// A set sun, which the air still shows, does not keep the moon off a cloud: the order of the lights
// does not matter, nor does the flag that nothing be skipped.
TEST_F(SkyLightTurned, TheMoonLightsACloudAtNight) {
  scene.setSky();
  scene.addBall(0.01f);
  WlkLight sun = make<WlkLight>();
  WlkLight moon = make<WlkLight>();
  std::fill_n(moon.irradiance, 3, 1e-3f);
  moon.direction[0] = 0.6f;
  moon.direction[1] = 0.8f;
  for (const double elevation_deg : {-12.0, -40.0}) {
    const double elevation = elevation_deg * std::numbers::pi / 180;
    sun.direction[0] = 0;
    sun.direction[1] = static_cast<float>(std::sin(elevation));
    sun.direction[2] = static_cast<float>(-std::cos(elevation));
    const WlkLight orders[2][2] = {{sun, moon}, {moon, sun}};
    std::vector<Image> pictures;
    for (const uint64_t flags : {uint64_t{0}, uint64_t{WLK_QUALITY_FLAG_NO_SKIP}}) {
      scene.setQuality(WLK_QUALITY_LOW, flags);
      for (const auto& lights : orders) {
        check(wlkSetLights(scene.context, 2, sizeof *lights, lights));
        check(wlkPrepare(scene.context));
        pictures.push_back(scene.render());
      }
    }
    EXPECT_GT(pictures[0].mean(), 1e-6);
    for (const Image& picture : pictures) {
      // With the set sun in it a frame integrates by pixel what it has from the table without.
      EXPECT_LE(relativeRms(picture, pictures[0]), 1e-3) << elevation_deg;
    }
  }
}

// In dusk the air in front of a cloud is the sun's still; were it the moon's, the picture would
// change by 7e-3.
TEST_F(SkyLightTurned, TheMoonDoesNotPutOutTheDusk) {
  constexpr double MOONLIGHT = 1e-3;  // ten times what the moon adds
  scene.setSky();
  scene.addBall(0.01f);
  scene.setSun(-3, 10);
  check(wlkPrepare(scene.context));
  const Image alone = scene.render();
  WlkLight lights[2] = {make<WlkLight>(), make<WlkLight>()};
  const double elevation = -3 * std::numbers::pi / 180;
  const double azimuth = 10 * std::numbers::pi / 180;
  lights[0].direction[0] = static_cast<float>(std::cos(elevation) * std::sin(azimuth));
  lights[0].direction[1] = static_cast<float>(std::sin(elevation));
  lights[0].direction[2] = static_cast<float>(-std::cos(elevation) * std::cos(azimuth));
  std::fill_n(lights[1].irradiance, 3, 2.5e-6f);
  check(wlkSetLights(scene.context, 2, sizeof *lights, lights));
  check(wlkPrepare(scene.context));
  EXPECT_GT(alone.mean(), 1e-5);
  const double change = relativeRms(scene.render(), alone);
  std::printf("the moon changes %.2e\n", change);
  EXPECT_LE(change, MOONLIGHT);
}

TEST_F(SkyLightPicture, FromSpaceFollowsTheQuery) {
  scene.setSky();
  for (const Station& from : {Station{130000, -10}, {400000, -20}, {36e6, -87}}) {
    expectWithin(from, {60, 20, 2}, 0.005, 0.1);
  }
}

TEST_F(SkyLightPicture, InTwilightFollowsTheQuery) {
  scene.setSky();
  for (const Station& from : {Station{2, 20}, {12000, 0}}) {
    expectWithin(from, {-2, -4, -6}, 0.02, 0.1);
  }
}

// Surfaces above and below sea level end rays with light of all orders from the table.
TEST_F(SkyLightPicture, OfSurfacesInTwilightFollowsTheQuery) {
  scene.setSky();
  for (const double sun_deg : {6.0, 1.0, -2.0}) {
    scene.setSun(sun_deg, 25);
    for (const double surface : {0.3, 0.9, 1.0, 1.1}) {
      look({1000, -40}, 110);
      const std::vector<double> all = differences(surface);
      ASSERT_FALSE(all.empty());
      const double p95 = all[static_cast<size_t>(0.95 * static_cast<double>(all.size() - 1))];
      std::printf("sun %4.1f, surfaces at %.1f: p95 %.3f %%, worst %.3f %%\n", sun_deg, surface,
                  100 * p95, 100 * all.back());
      // The query ends at sea level; a tenth more way adds as much light, and 1 % for denser air.
      const double beyond = surface > 1 ? 1.1 * (surface - 1) : 0.0;
      EXPECT_NEAR(p95, beyond, 0.02);
      EXPECT_LE(all.back(), beyond + 0.1);
    }
  }
}

TEST_F(SkyLightPicture, OfFogFollowsTheQuery) {
  scene.setSky();
  setBlackGround();
  // In thick fog the query's own 48 steps are long; what fog scatters of light around it lies in a
  // table of 16 azimuths.
  struct Layer {
    float extinction;
    double p95;
    double worst;
  };
  for (const Layer& layer : {Layer{2e-5f, 0.002, 0.005}, {1e-3f, 0.02, 0.06}, {2e-2f, 0.1, 0.5}}) {
    scene.setFog(layer.extinction, 300);
    std::printf("fog of %g per m\n", static_cast<double>(layer.extinction));
    for (const Station& from : {Station{2, 20}, {250, 0}, {3000, -15}}) {
      expectWithin(from, {60, 10}, layer.p95, layer.worst);
    }
  }
}

}  // namespace
}  // namespace welkin::test
