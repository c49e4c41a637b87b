// SPDX-License-Identifier: MIT
// wlkEvalIrradiance and wlkEvalSkyMap against each other, the table of the sky and exact limits.
#include <gtest/gtest.h>

#include <cstddef>

#include "tables/sky_field.hpp"
#include "unit/sky_scene.hpp"

namespace {

using namespace welkin::test;
using welkin::check;
using welkin::make;

// Direction and solid angle of a texel, by the words of welkin/query.h.
struct Texel {
  Point direction;
  double solidAngle;
};

Texel texelOf(size_t i, size_t j, size_t size) {
  const auto n = static_cast<double>(size);
  const double u = (2 * static_cast<double>(i) + 1) / n - 1;
  const double v = (2 * static_cast<double>(j) + 1) / n - 1;
  Point p{u, 1 - std::abs(u) - std::abs(v), v};
  if (p[1] < 0) {
    p = {std::copysign(1 - std::abs(v), u), p[1], std::copysign(1 - std::abs(u), v)};
  }
  const double r = std::hypot(p[0], p[1], p[2]);
  return {{p[0] / r, p[1] / r, p[2] / r}, 4 / (n * n * r * r * r)};
}

Rgb irradianceOfMap(const std::vector<float>& rgb, size_t size, const Point& normal) {
  Rgb sum{};
  for (size_t j = 0; j < size; ++j) {
    for (size_t i = 0; i < size; ++i) {
      const Texel texel = texelOf(i, j, size);
      const double cosine = texel.direction[0] * normal[0] + texel.direction[1] * normal[1] +
                            texel.direction[2] * normal[2];
      for (size_t c = 0; c < 3; ++c) {
        sum[c] += texel.solidAngle * std::max(cosine, 0.0) *
                  static_cast<double>(rgb[3 * (j * size + i) + c]);
      }
    }
  }
  return sum;
}

TEST(QueryIrradiance, DirectLightIsTheLightTimesTheCosine) {
  const SkyScene scene;
  const Point sun = towards(25, 40);
  scene.setSun(sun);
  const Point normal{0.6, 0.8, 0};
  const double cosine = 0.6 * sun[0] + 0.8 * sun[1];
  // Direction and irradiance are floats.
  for (const double one : scene.direct({0, 2, 0}, normal)) {
    EXPECT_NEAR(one, cosine, 1e-7);
  }
  scene.setSky();
  const Point position{0, 2, 0};
  Rgb light{};
  check(wlkEvalLight(scene.context, 0, position.data(), light.data()));
  const Rgb value = scene.direct(position, normal);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(value[c], light[c] * cosine, 1e-7);
  }
  EXPECT_EQ(scene.direct(position, {-0.6, -0.8, 0}), Rgb{});
  EXPECT_NEAR(scene.direct({0, 3.6e7, 0}, sun)[0], 1, 1e-7);
  EXPECT_EQ(scene.direct({0, -1.3e7, 0}, sun), Rgb{});  // in the planet's shadow
}

TEST(QueryIrradiance, WithoutAirOnlyTheGroundShines) {
  const SkyScene scene;
  const Point sun = towards(25, 40);
  scene.setSun(sun);
  const double ground = ALBEDO * sun[1];  // pi times its radiance
  const Point position{0, 2, 0};
  // A flat plain of even radiance: three terms are exact. Within the dip of the horizon, 8e-4, the
  // coarseness of the moments' own directions, and the curvature's change of the sun.
  constexpr double PLAIN = 0.01;
  EXPECT_NEAR(scene.diffuse(position, {0, -1, 0})[1], ground, PLAIN * ground);
  EXPECT_NEAR(scene.diffuse(position, {1, 0, 0})[1], ground / 2, PLAIN * ground);
  EXPECT_NEAR(scene.diffuse(position, {0, 1, 0})[1], 0, PLAIN * ground);
  const std::vector<float> map = scene.map(2, 16);
  for (size_t i = 0; i < 256; ++i) {
    const double y = texelOf(i % 16, i / 16, 16).direction[1];
    const double value = static_cast<double>(map[3 * i]);
    if (y > 0.01) {
      EXPECT_EQ(value, 0.0);
    } else if (y < -0.01) {
      // 2 m above the ground it ends within 200 m: the sun moves by 3e-5 there.
      EXPECT_NEAR(value, ground / PI, 1e-4 * ground);
    }
  }
}

TEST(QueryIrradiance, HorizontalGroundGetsWhatTheTableSays) {
  const SkyScene scene;
  scene.setSky();
  welkin::SkyFieldInput input;
  input.air.planetRadius = static_cast<double>(scene.planet.radius);
  input.air.airScaleHeight = static_cast<double>(scene.sky.scaleHeight);
  for (size_t c = 0; c < 3; ++c) {
    input.air.airScattering[c] = static_cast<double>(scene.sky.rayleighScattering[c]);
  }
  input.groundAlbedo.fill(ALBEDO);
  input.lightAngularRadius = 0.5 * static_cast<double>(make<WlkLight>().angularDiameter);
  const welkin::SkyField field = welkin::solveSkyField(input);
  for (const double elevation : {80.0, 30.0, 5.0, -4.0}) {
    const Point sun = towards(elevation, 130);
    scene.setSun(sun);
    const Rgb value = scene.diffuse({0, 0, 0}, {0, 1, 0});
    const welkin::SkyColor expected = field.irradianceAt(sun[1]);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(value[c], expected[c], 1e-3 * expected[c]) << elevation << ", colour " << c;
    }
  }
}

TEST(QuerySkyMap, HasTheIrradianceOfTheHarmonics) {
  const SkyScene scene;
  scene.setSky();
  constexpr size_t SIZE = 32;
  constexpr double MAP = 0.02;  // of welkin/query.h, size 32
  const auto compare = [&](double altitude, double harmonics) {
    const std::vector<float> map = scene.map(altitude, SIZE);
    for (const Point& normal : {Point{0, 1, 0}, Point{0, -1, 0}, Point{1, 0, 0}, Point{-1, 0, 0},
                                Point{0, 0, 1}, Point{0.6, 0.8, 0}, Point{0, -0.8, 0.6}}) {
      const Rgb truth = irradianceOfMap(map, SIZE, normal);
      const Rgb value = scene.diffuse({0, altitude, 0}, normal);
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(value[c], truth[c], (MAP + harmonics) * truth[c])
            << altitude << " m, normal " << normal[0] << " " << normal[1] << ", colour " << c;
      }
    }
  };
  for (const double elevation : {60.0, 20.0, 3.0}) {
    SCOPED_TRACE(elevation);
    scene.setSun(towards(elevation, 35));
    compare(0, 0.02);
    compare(3000, 0.10);
  }
  scene.setHaze();
  for (const double elevation : {60.0, 2.0}) {
    SCOPED_TRACE(elevation);
    scene.setSun(towards(elevation, 35));
    compare(0, 0.10);
  }
}

TEST(QuerySkyMap, LooksWhereItSays) {
  constexpr uint32_t SIZE = 8;
  const SkyScene scene;
  scene.setSky();
  scene.setSun(towards(30, 70));
  for (const uint32_t maxOrder : {0u, 1u}) {
    const std::vector<float> map = scene.map(2, SIZE, maxOrder);
    double sum = 0;
    for (size_t i = 0; i < size_t{SIZE} * SIZE; ++i) {
      const Texel texel = texelOf(i % SIZE, i / SIZE, SIZE);
      sum += texel.solidAngle;
      if (texel.direction[1] > 0.01) {
        const Rgb ray = scene.radiance({0, 2, 0}, texel.direction, INF, maxOrder);
        for (size_t c = 0; c < 3; ++c) {
          // A float, and orders above the first in float steps from a direction 1e-16 off.
          EXPECT_NEAR(static_cast<double>(map[3 * i + c]), ray[c], 1e-6 * ray[c]) << i;
        }
      }
    }
    EXPECT_NEAR(sum, 4 * PI, 1e-3 * 4 * PI);
  }
}

TEST(QuerySkyMap, FineFogIsNoBrighterThanItsMap) {
  // 10 um droplets scatter half of the light within 5 degrees, a texel of size 32.
  constexpr double TOLERANCE = 0.06;  // of welkin/query.h
  const SkyScene scene;
  scene.setSky();
  scene.setSun(towards(30, 35));
  auto fog = make<WlkFog>();
  fog.extinction = 1e-3F;
  fog.scaleHeight = 200;
  check(wlkSetFog(scene.context, &fog));
  const Point normal{0, 1, 0};
  const Rgb coarse = irradianceOfMap(scene.map(0, 32), 32, normal);
  const Rgb fine = irradianceOfMap(scene.map(0, 80), 80, normal);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(coarse[c], fine[c], TOLERANCE * fine[c]);
  }
}

TEST(QueryIrradiance, FadesThroughTwilight) {
  const SkyScene scene;
  scene.setSky();
  Rgb before{1, 1, 1};
  for (const double elevation : {0.0, -3.0, -6.0, -9.0, -12.0, -18.0}) {
    scene.setSun(towards(elevation, 10));
    const Rgb diffuse = scene.diffuse({0, 2, 0}, {0, 1, 0});
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_GE(diffuse[c], 0.0);
      EXPECT_LT(diffuse[c], 0.7 * before[c]) << elevation;
    }
    EXPECT_GT(diffuse[2], elevation > -7 ? 1e-5 : 0.0);
    before = diffuse;
    if (elevation < -1) {
      EXPECT_EQ(scene.direct({0, 2, 0}, {0, 1, 0}), Rgb{});
    }
  }
  scene.setSun({0, -1, 0});
  for (const double one : scene.diffuse({0, 2, 0}, {0, 1, 0})) {
    EXPECT_LT(one, 1e-9);
  }
}

// The map that volumes take the light of sky and ground from.
TEST(QuerySkyMap, OfTwelveTexelsLightsABoxAsAFineOneDoes) {
  constexpr size_t COARSE = 12;
  constexpr size_t FINE = 32;
  const SkyScene scene;
  scene.setSky();
  for (const double elevation : {5.0, 30.0, 70.0}) {
    double most = 0;
    scene.setSun(towards(elevation, 40));
    for (const double altitude : {10.0, 1500.0, 9000.0}) {
      const auto irradiances = [&](size_t size) {
        auto query = make<WlkSkyMapQuery>();
        query.position[1] = altitude;
        query.size = static_cast<uint32_t>(size);
        std::vector<float> rgb(3 * size * size);
        check(wlkEvalSkyMap(scene.context, &query, rgb.data(), rgb.size() * sizeof(float)));
        std::vector<Rgb> sides;
        for (size_t axis = 0; axis < 3; ++axis) {
          for (const double sign : {-1.0, 1.0}) {
            Point normal{};
            normal[axis] = sign;
            sides.push_back(irradianceOfMap(rgb, size, normal));
          }
        }
        return sides;
      };
      const std::vector<Rgb> coarse = irradiances(COARSE);
      const std::vector<Rgb> fine = irradiances(FINE);
      for (size_t side = 0; side < coarse.size(); ++side) {
        for (size_t c = 0; c < 3; ++c) {
          most = std::max(most, std::abs(coarse[side][c] / fine[side][c] - 1));
        }
      }
    }
    // Twilight's red is a narrow band.
    EXPECT_LT(most, elevation < 10 ? 0.13 : 0.06) << elevation;
  }
}

}  // namespace
