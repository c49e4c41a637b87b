// SPDX-License-Identifier: MIT
// Maps of the volumes' shadow against optical depths that are known: of boxes and balls in closed
// form, of a noise cloud by a quadrature that is exact between voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloud_scene.hpp"
#include "reference/raymarch.hpp"
#include "support/shadow_map_scene.hpp"
#include "support/tolerance.hpp"

namespace welkin::test {
namespace {

using reference::Point;

constexpr uint32_t SIZE = 64;
constexpr double EXTENT = 6000;  // m
constexpr std::array SUNS{std::array{90.0, 0.0}, std::array{52.0, 30.0}, std::array{17.0, 200.0},
                          std::array{3.0, 131.0}};
// A box that is turned and sheared, m: columns x, y, z and corner.
constexpr std::array<double, 12> TURNED{1700, -500, 250, 9000, 150,  900,
                                        -200, 1200, 400, 300,  1500, -4000};

WlkCloudShadowInfo info(uint32_t content) {
  auto value = make<WlkCloudShadowInfo>();
  value.width = SIZE;
  value.height = SIZE;
  value.content = content;
  value.extent[0] = EXTENT;
  value.extent[1] = EXTENT;
  value.center[0] = 9700;
  value.center[1] = 20;
  value.center[2] = -3000;
  return value;
}

// Towards the sun of EngineScene::setSun.
Point towardsSun(double elevation_deg, double azimuth_deg) {
  const double degree = 3.14159265358979323846 / 180;
  const double level = std::cos(elevation_deg * degree);
  return {level * std::sin(azimuth_deg * degree), std::sin(elevation_deg * degree),
          -level * std::cos(azimuth_deg * degree)};
}

// The texel's light ray: a point far up, and its direction.
struct LightRay {
  Point origin;
  Point direction;
};
LightRay rayOf(const WlkCloudShadowState& state, size_t texel, const Point& toSun) {
  const double u = (static_cast<double>(texel % SIZE) + 0.5) / SIZE;
  const size_t row = texel / SIZE;
  const double v = (static_cast<double>(row) + 0.5) / SIZE;
  LightRay ray;
  ray.origin = worldFromMap(state.mapFromWorld, {u, v, -30000});
  for (size_t i = 0; i < 3; ++i) {
    ray.direction[i] = -toSun[i];
  }
  return ray;
}

// Stretch of a line inside a box, by Cramer's rule for its box coordinates.
std::array<double, 2> stretch(const std::array<double, 12>& m, const LightRay& ray) {
  const auto column = [&](size_t i) { return Point{m[i], m[4 + i], m[8 + i]}; };
  const auto determinant = [](const Point& a, const Point& b, const Point& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
  };
  const Point x = column(0);
  const Point y = column(1);
  const Point z = column(2);
  const double whole = determinant(x, y, z);
  const Point from{ray.origin[0] - m[3], ray.origin[1] - m[7], ray.origin[2] - m[11]};
  const auto inBox = [&](const Point& p) {
    return Point{determinant(p, y, z) / whole, determinant(x, p, z) / whole,
                 determinant(x, y, p) / whole};
  };
  const Point at = inBox(from);
  const Point step = inBox(ray.direction);
  double begin = -1e30;
  double end = 1e30;
  for (size_t i = 0; i < 3; ++i) {
    const double a = (0 - at[i]) / step[i];
    const double b = (1 - at[i]) / step[i];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return {begin, std::max(begin, end)};
}

class ShadowMapTruth : public ::testing::Test {
 protected:
  static void expectQuiet(const ShadowMapScene& s) {
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }
};

// Of a grey medium no light goes straight on: extinction is what the engine set.
WlkVolume addBox(const ShadowMapScene& s, const std::array<double, 12>& transform,
                 float extinction) {
  const WlkVolume volume =
      s.scene.addVolume(s.scene.addHenyeyGreenstein(0.5f), {2, 2, 2}, transform, extinction);
  s.scene.upload(volume, {2, 2, 2}, std::vector<float>(8, 1.0f));
  return volume;
}

// A light ray meets the box's faces where floats of box coordinates say: within 8 roundings of the
// largest coordinate on the way (3 boxes), of a box 2.5 km deep.
constexpr double FACE = 8 * 3 * EPS_FLOAT * 2500;

TEST_F(ShadowMapTruth, OfATurnedBoxIsItsChordAtAnySun) {
  constexpr float EXTINCTION = 0.002f;
  ShadowMapScene s(info(WLK_CLOUD_SHADOW_OPTICAL_DEPTH));
  addBox(s, TURNED, EXTINCTION);
  check(wlkPrepare(s.scene.context));
  for (const auto& [elevation, azimuth] : SUNS) {
    s.scene.setSun(elevation, azimuth);
    const WlkCloudShadowState state = s.record().state;
    EXPECT_STREQ(wlkReasonName(state.reason), "WLK_REASON_NEEDED");
    const std::vector<float> map = s.read();
    const Point toSun = towardsSun(elevation, azimuth);
    size_t shaded = 0;
    for (size_t i = 0; i < size_t{SIZE} * SIZE; ++i) {
      const auto [begin, end] = stretch(TURNED, rayOf(state, i, toSun));
      const double truth = (end - begin) * static_cast<double>(EXTINCTION);
      shaded += truth > 0 ? 1 : 0;
      // The chord's ends move along the light by up to 8 times what the faces do at grazing rays.
      ASSERT_NEAR(map[4 * i], truth, 1e-5 * truth + 8 * FACE * static_cast<double>(EXTINCTION))
          << "sun at " << elevation << ", texel " << i;
    }
    EXPECT_GT(shaded, 200u) << elevation;
    EXPECT_LT(shaded, size_t{SIZE} * SIZE) << elevation;
  }
  expectQuiet(s);
}

// Density (1 - (r/R)^2)^2: the line at distance b from the middle holds 16/15 (R^2 - b^2)^2.5 /
// R^4.
TEST_F(ShadowMapTruth, OfASoftBallIsItsClosedForm) {
  constexpr uint32_t N = 64;
  constexpr double R = 1000;
  constexpr double EXTINCTION = 0.004;
  ShadowMapScene s(info(WLK_CLOUD_SHADOW_OPTICAL_DEPTH));
  const Point middle{9000, 2500, -3300};
  const auto box =
      boxTransform({middle[0] - 1100, middle[1] - 1100, middle[2] - 1100}, {2200, 2200, 2200});
  std::vector<float> values;
  for (uint32_t i = 0; i < N * N * N; ++i) {
    double square = 0;
    for (const uint32_t k : {i % N, i / N % N, i / N / N}) {
      const double x = ((k + 0.5) / N - 0.5) * 2200 / R;
      square += x * x;
    }
    values.push_back(static_cast<float>(std::pow(std::max(1 - square, 0.0), 2)));
  }
  const WlkVolume volume = s.scene.addVolume(s.scene.addHenyeyGreenstein(0.5f), {N, N, N}, box,
                                             static_cast<float>(EXTINCTION));
  s.scene.upload(volume, {N, N, N}, values);
  check(wlkPrepare(s.scene.context));
  // Second derivatives are at most 8 / R^2 along the radius and 4 / R^2 across it: trilinear
  // interpolation with voxels of h misses (8 + 4 + 4) / 8 (h/R)^2, one sample per voxel 8/24
  // (h/R)^2.
  const double h = 2200.0 / N;
  const double bound = (2 + 1.0 / 3) * (h / R) * (h / R) * 2 * R * EXTINCTION;
  for (const auto& [elevation, azimuth] : SUNS) {
    s.scene.setSun(elevation, azimuth);
    const WlkCloudShadowState state = s.record().state;
    const std::vector<float> map = s.read();
    const Point toSun = towardsSun(elevation, azimuth);
    double largest = 0;
    for (size_t i = 0; i < size_t{SIZE} * SIZE; ++i) {
      const LightRay ray = rayOf(state, i, toSun);
      double along = 0;
      double square = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double x = middle[k] - ray.origin[k];
        along += x * ray.direction[k];
        square += x * x;
      }
      const double b2 = std::max(square - along * along, 0.0);
      const double truth =
          b2 < R * R ? EXTINCTION * 16 / 15 * std::pow(R * R - b2, 2.5) / std::pow(R, 4) : 0.0;
      largest = std::max(largest, std::abs(map[4 * i] - truth));
      ASSERT_NEAR(map[4 * i], truth, bound) << "sun at " << elevation << ", texel " << i;
    }
    std::printf("ball, sun at %g: largest error %.5f of at most %.5f\n", elevation, largest, bound);
  }
  expectQuiet(s);
}

TEST_F(ShadowMapTruth, OfANoiseCloudFollowsTheExactQuadrature) {
  const reference::VoxelField cloud = image_test::noiseCloudField();
  const reference::RayMarch march(cloud);
  auto value = info(WLK_CLOUD_SHADOW_OPTICAL_DEPTH);
  const auto& m = cloud.worldFromBox;
  double reach = 0;
  for (size_t row = 0; row < 3; ++row) {
    value.center[row] = m[4 * row + 3] + 0.5 * (m[4 * row] + m[4 * row + 1] + m[4 * row + 2]);
    reach = std::max(reach, m[4 * row + row]);
  }
  value.extent[0] = value.extent[1] = 1.5 * reach;
  ShadowMapScene s(value);
  std::array<uint32_t, 3> size{};
  std::copy(cloud.size.begin(), cloud.size.end(), size.begin());
  const double scale = *std::max_element(cloud.extinction.begin(), cloud.extinction.end());
  std::vector<float> values;
  for (const double x : cloud.extinction) {
    values.push_back(static_cast<float>(x / scale));
  }
  const WlkVolume volume =
      s.scene.addVolume(s.scene.addHenyeyGreenstein(0.5f), size, m, static_cast<float>(scale));
  s.scene.upload(volume, size, values);
  check(wlkPrepare(s.scene.context));
  for (const auto& [elevation, azimuth] : SUNS) {
    s.scene.setSun(elevation, azimuth);
    const WlkCloudShadowState state = s.record().state;
    const std::vector<float> map = s.read();
    const Point toSun = towardsSun(elevation, azimuth);
    double errors = 0;
    double transmitted = 0;
    double truths = 0;
    double worst = 0;
    for (size_t i = 0; i < size_t{SIZE} * SIZE; ++i) {
      const LightRay ray = rayOf(state, i, toSun);
      const double truth = march.opticalDepth(ray.origin, ray.direction);
      const double error = map[4 * i] - truth;
      errors += error * error;
      truths += truth;
      transmitted += std::pow(std::exp(-map[4 * i]) - std::exp(-truth), 2);
      worst = std::max(worst, std::abs(error));
    }
    const double texels = double{SIZE} * SIZE;
    const double relative = std::sqrt(errors / texels) / (truths / texels);
    std::printf(
        "noise cloud, sun at %g: rms %.4f of the mean depth %.3f, worst %.4f; rms of the "
        "transmittance %.5f\n",
        elevation, relative, truths / texels, worst, std::sqrt(transmitted / texels));
    EXPECT_LT(relative, 0.01) << elevation;
    EXPECT_LT(std::sqrt(transmitted / texels), 0.002) << elevation;
  }
  expectQuiet(s);
}

TEST_F(ShadowMapTruth, OfSeveralVolumesIsTheirSumInAnyFormat) {
  constexpr std::array<double, 12> SECOND{2500, 0, 0, 9500, 0, 300, 0, 4000, 0, 0, 2000, -5700};
  for (const uint32_t content : {WLK_CLOUD_SHADOW_OPTICAL_DEPTH, WLK_CLOUD_SHADOW_TRANSMITTANCE}) {
    for (const bool half : {false, true}) {
      ShadowMapScene s(info(content), half);
      addBox(s, TURNED, 0.0004f);
      addBox(s, SECOND, 0.001f);
      s.scene.setSun(52, 30);
      check(wlkPrepare(s.scene.context));
      const WlkCloudShadowState state = s.record().state;
      EXPECT_EQ(state.volumes, 2u);
      const std::vector<float> map = s.read();
      const Point toSun = towardsSun(52, 30);
      // Half floats round to nearest: 2^-11 of the value, or half a step of 2^-24.
      const double rounding = half ? 0x1p-11 : 0;
      size_t both = 0;
      for (size_t i = 0; i < size_t{SIZE} * SIZE; ++i) {
        const LightRay ray = rayOf(state, i, toSun);
        const auto [a, b] = stretch(TURNED, ray);
        const auto [c, d] = stretch(SECOND, ray);
        both += b > a && d > c ? 1 : 0;
        const double depth = 0.0004f * (b - a) + 0.001f * (d - c);
        const bool color = content == WLK_CLOUD_SHADOW_TRANSMITTANCE;
        const double truth = color ? std::exp(-depth) : depth;
        const double bound = (1e-5 + rounding) * truth + 1e-5 + 8 * FACE * 0.0014;
        for (size_t channel = 0; channel < (color ? 3U : 1U); ++channel) {
          ASSERT_NEAR(map[4 * i + channel], truth, bound) << content << half << " texel " << i;
        }
        if (color) {
          ASSERT_EQ(map[4 * i + 3], 1.0f);
        }
      }
      EXPECT_GT(both, 100u);
      expectQuiet(s);
    }
  }
}

// What the header says of G and B, at receivers before, inside and behind the volumes.
TEST_F(ShadowMapTruth, LayersShadeWhatStandsInsideThem) {
  constexpr float EXTINCTION = 0.003f;
  ShadowMapScene s(info(WLK_CLOUD_SHADOW_LAYER));
  addBox(s, TURNED, EXTINCTION);
  check(wlkPrepare(s.scene.context));
  for (const auto& [elevation, azimuth] : SUNS) {
    s.scene.setSun(elevation, azimuth);
    const WlkCloudShadowState state = s.record().state;
    const std::vector<float> map = s.read();
    const Point toSun = towardsSun(elevation, azimuth);
    for (size_t i = 0; i < size_t{SIZE} * SIZE; ++i) {
      const auto [begin, end] = stretch(TURNED, rayOf(state, i, toSun));
      const double length = end - begin;
      const bool besideShadow = i + 1 < map.size() / 4 && map[4 * i + 4] > 0 && (i + 1) % SIZE > 0;
      if (length == 0 && besideShadow) {
        EXPECT_GT(map[4 * i + 2], map[4 * i + 1]) << "a filter would find no ends here";
      }
      if (length < 100) {
        continue;  // ends of short chords lie within what is left of them
      }
      const float* texel = &map[4 * i];
      ASSERT_NEAR(texel[0], length * EXTINCTION, 1e-5 * length + 0.001);
      for (const double part : {-0.3, 0.0, 0.25, 0.5, 0.9, 1.0, 1.7}) {
        const double d = begin - 30000 + part * length;
        const double truth = std::clamp(part, 0.0, 1.0) * length * EXTINCTION;
        const double rise = std::clamp((d - texel[1]) / (texel[2] - texel[1]), 0.0, 1.0);
        // Variances of the ends lose 1e-7 of the squared distance to the plane where d starts.
        ASSERT_NEAR(texel[0] * rise, truth, 2e-3 * length * EXTINCTION + 0.001)
            << "sun at " << elevation << ", texel " << i << ", part " << part;
      }
    }
  }
  expectQuiet(s);
}

// Two layers of depths 1 and 3, from 5000 to 5200 m and from 2000 to 2400 m: mean and spread.
TEST_F(ShadowMapTruth, LayersOfTwoVolumesKeepMeanAndSpread) {
  ShadowMapScene s(info(WLK_CLOUD_SHADOW_LAYER));
  addBox(s, {9000, 0, 0, 5000, 0, 200, 0, 5000, 0, 0, 9000, -7500}, 1.0f / 200);
  addBox(s, {9000, 0, 0, 5000, 0, 400, 0, 2000, 0, 0, 9000, -7500}, 3.0f / 400);
  check(wlkPrepare(s.scene.context));
  const WlkCloudShadowState state = s.record().state;
  // The sun stands at the zenith: d is a height above, downwards.
  const double plane = worldFromMap(state.mapFromWorld, {0.5, 0.5, 0})[1];
  const double mean = plane - (1 * 5100 + 3 * 2200) / 4.0;
  const double variance =
      (1 * 200.0 * 200 / 12 + 3 * 400.0 * 400 / 12) / 4 + 1.0 / 4 * 3 / 4 * 2900 * 2900;
  const std::vector<float> map = s.read();
  for (size_t i = 0; i < size_t{SIZE} * SIZE; i += 97) {
    EXPECT_NEAR(map[4 * i], 4, 1e-5 * 4);
    EXPECT_NEAR(0.5 * (map[4 * i + 1] + map[4 * i + 2]), mean, 1);
    EXPECT_NEAR(map[4 * i + 2] - map[4 * i + 1], 2 * std::sqrt(3 * variance), 2);
    EXPECT_EQ(map[4 * i + 3], 0.0f);
  }
  expectQuiet(s);
}

TEST_F(ShadowMapTruth, TexelsKeepTheirPlacesWhileTheMiddleMoves) {
  ShadowMapScene s(info(WLK_CLOUD_SHADOW_OPTICAL_DEPTH));
  addBox(s, TURNED, 0.002f);
  s.scene.setSun(52, 30);
  check(wlkPrepare(s.scene.context));
  auto value = info(WLK_CLOUD_SHADOW_OPTICAL_DEPTH);
  const auto cornerOf = [&] { return worldFromMap(s.record().state.mapFromWorld, {0, 0, 0}); };
  const WlkCloudShadowState first = s.record().state;
  const std::array<double, 3> corner = worldFromMap(first.mapFromWorld, {0, 0, 0});
  for (int step = 1; step < 40; ++step) {
    value.center[0] = 9700 + 37.0 * step;
    value.center[2] = -3000 + 61.0 * step;
    check(wlkSetCloudShadow(s.scene.context, s.map, &value));
    const std::array<double, 3> now = cornerOf();
    for (size_t row = 0; row < 2; ++row) {
      const double* r = first.mapFromWorld + 4 * row;
      double moved = 0;
      double asked = 0;
      for (size_t i = 0; i < 3; ++i) {
        moved += r[i] * (now[i] - corner[i]) * SIZE;
        asked += r[i] * (value.center[i] - info(0).center[i]) * SIZE;
      }
      EXPECT_NEAR(moved, std::round(moved), 1e-6) << step;
      EXPECT_LE(std::abs(moved - asked), 1.0 + 1e-6) << step;
    }
  }
}

}  // namespace
}  // namespace welkin::test
