// SPDX-License-Identifier: MIT
// Aerial perspective: froxels against opaque pixels at their distance, against closed forms and a
// quadrature written anew here, and what an engine reads between froxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "support/aerial_scene.hpp"
#include "support/on_gpu.hpp"

namespace welkin::test {
namespace {

WlkAerialPerspective froxels(uint32_t width, uint32_t height, uint32_t depth) {
  auto info = make<WlkAerialPerspective>();
  info.width = width;
  info.height = height;
  info.depth = depth;
  return info;
}

SceneOptions sized(uint32_t width, uint32_t height) {
  SceneOptions options;
  options.width = width;
  options.height = height;
  return options;
}

struct Scenery {
  const char* name;
  std::function<void(const SceneBuilder&)> make;
  uint64_t qualityFlags = 0;
};

void addSky(const SceneBuilder& s) {
  s.setSky();
  s.setSun(35, 50);
}

// Largest difference between a slice and the picture: transmittance, and radiance in parts of the
// picture's largest.
double worstDifference(const AerialScene& s, uint32_t slice) {
  const uint32_t width = s.info.width;
  double scale = 0;
  for (uint32_t i = 0; i < width * s.info.height; ++i) {
    scale = std::max(scale, s.pixel(i % width, i / width).radiance[2]);
  }
  double worst = 0;
  for (uint32_t i = 0; i < width * s.info.height; ++i) {
    const RayLayer froxel = s.froxel(i % width, i / width, slice);
    const RayLayer pixel = s.pixel(i % width, i / width);
    for (size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, std::abs(froxel.radiance[c] - pixel.radiance[c]) / scale);
      worst = std::max(worst, std::abs(froxel.transmittance[c] - pixel.transmittance[c]));
    }
  }
  return worst;
}

// A second box, nearer, that overlaps the ball's.
void addSlab(const SceneBuilder& s) {
  const WlkVolume slab = s.addVolume(s.addHenyeyGreenstein(0.3f), {2, 2, 2},
                                     boxTransform({-800, 300, -5200}, {3000, 1500, 900}), 4e-4f);
  s.upload(slab, {2, 2, 2}, std::vector<float>(8, 1.0f));
}

const std::vector<Scenery> SCENERIES{
    {"clear air", addSky},
    {"air and fog",
     [](const SceneBuilder& s) {
       addSky(s);
       s.setFog(1e-4f, 1200);
     }},
    {"a ball without air",
     [](const SceneBuilder& s) {
       s.setSun(35, 50);
       s.addBall(0.004f);
     }},
    {"two volumes in clear air, light from behind them",
     [](const SceneBuilder& s) {
       addSky(s);
       s.addBall(0.002f);
       addSlab(s);
     }},
    {"two volumes in air and fog, light from behind the eye, shadows",
     [](const SceneBuilder& s) {
       addSky(s);
       s.setSun(25, 170);
       s.setFog(5e-5f, 1200);
       s.addBall(0.002f);
       addSlab(s);
     },
     WLK_QUALITY_FLAG_VOLUME_SHADOWS}};

// Every froxel is what the composite has for an opaque pixel there. Distances come through a depth
// buffer of floats on one side and a power of floats on the other. Light stored for all slabs (a
// batch size of 0) and in batches.
TEST(AerialFroxels, AreOpaquePixelsAtTheirDistance) {
  constexpr uint32_t W = 16;
  constexpr uint32_t H = 12;
  const double distanceError = 3e-7 + 3e-6;  // of the depth value and of lavapipe's power
  const double condition = 3;  // d ln L / d ln d and dT / d ln d, at most: inside the ball
  // A segment through fog is refined or not by a rounding, for 1.5e-3 of its light; where a fused
  // product makes that differ, measured 2.8e-5.
  const double refined = onGpu() ? 1e-4 : 0;
  for (const Scenery& scenery : SCENERIES) {
    WlkAerialPerspective info = froxels(W, H, 9);
    info.distance = 16000;
    info.exponent = 1.3f;
    AerialScene s(info, sized(W, H));
    scenery.make(s.scene);
    s.scene.setCamera({0, 400, 0}, 0, 8);
    for (const uint32_t batchSize : {0u, 8u}) {
      auto quality = make<WlkQuality>();
      quality.volumeResolution = WLK_VOLUME_RESOLUTION_FULL;
      quality.level = WLK_QUALITY_LOW;
      quality.batchSize = batchSize;
      quality.flags = scenery.qualityFlags;
      check(wlkSetQuality(s.scene.context, s.scene.view, &quality));
      check(wlkPrepare(s.scene.context));
      double worst = 0;
      for (uint32_t slice = 1; slice < info.depth; ++slice) {
        s.surface = s.sliceDistance(slice);
        s.render();
        worst = std::max(worst, worstDifference(s, slice));
      }
      std::printf("%s, slabs in batches of %u: worst %.2g\n", scenery.name, batchSize, worst);
      EXPECT_LT(worst, distanceError * condition + refined) << scenery.name << ", " << batchSize;
    }
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }
}

// Without skipping, slices before and behind all volumes are marched, too.
TEST(AerialFroxels, AreTheSameWhereSlicesAreSkipped) {
  WlkAerialPerspective info = froxels(12, 9, 16);
  info.distance = 30000;
  AerialScene s(info, sized(24, 18));
  addSky(s.scene);
  s.scene.addBall(0.002f);
  addSlab(s.scene);
  std::vector<std::vector<float>> pictures;
  for (const uint64_t flags : {uint64_t{0}, uint64_t{WLK_QUALITY_FLAG_NO_SKIP}}) {
    s.scene.setQuality(WLK_QUALITY_LOW, flags);
    check(wlkPrepare(s.scene.context));
    s.render();
    pictures.push_back(s.texels(0));
    pictures.push_back(s.texels(1));
  }
  const double rounding = 1e-6;  // batches merge in another order where a ray ends early
  for (size_t image = 0; image < 2; ++image) {
    for (size_t i = 0; i < pictures[image].size(); ++i) {
      EXPECT_NEAR(pictures[image][i], pictures[image + 2][i], rounding) << image << ", " << i;
    }
  }
}

// Of a homogeneous box e^(-extinction length), of air and gas what the queries say in double.
TEST(AerialFroxels, HaveTheTransmittanceOfClosedForms) {
  constexpr double EXTINCTION = 7e-4;
  constexpr std::array<double, 3> LO{-3000, -2000, -9000};
  constexpr std::array<double, 3> EDGES{6000, 5000, 6000};
  WlkAerialPerspective info = froxels(5, 4, 24);
  info.distance = 12000;
  AerialScene s(info, sized(20, 16));
  s.scene.setSky();
  const auto gas = make<WlkAbsorber>();
  check(wlkSetAbsorber(s.scene.context, &gas));
  s.scene.setSun(60, 30);
  const WlkVolume box = s.scene.addVolume(s.scene.addHenyeyGreenstein(0), {3, 3, 3},
                                          boxTransform(LO, EDGES), static_cast<float>(EXTINCTION));
  s.scene.upload(box, {3, 3, 3}, std::vector<float>(27, 1.0f));
  constexpr double EYE_HEIGHT = 2;
  s.scene.setCamera({0, EYE_HEIGHT, 0}, 0, 0);
  check(wlkPrepare(s.scene.context));
  s.render();
  double worst = 0;
  for (uint32_t i = 0; i < info.width * info.height * info.depth; ++i) {
    const uint32_t x = i % info.width;
    const uint32_t y = i / info.width % info.height;
    const uint32_t slice = i / (info.width * info.height);
    const std::array<double, 3> d = s.columnDirection(x, y);
    const double reach = s.sliceDistance(slice);
    double begin = 0;
    double end = reach;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double origin = axis == 1 ? EYE_HEIGHT : 0;
      const double a = (LO[axis] - origin) / d[axis];
      const double b = (LO[axis] + EDGES[axis] - origin) / d[axis];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    const double inBox = std::exp(-EXTINCTION * std::max(end - begin, 0.0));
    const std::array<double, 3> from{0, EYE_HEIGHT, 0};
    const std::array<double, 3> to{d[0] * reach, EYE_HEIGHT + d[1] * reach, d[2] * reach};
    std::array<double, 3> air{};
    check(wlkEvalTransmittance(s.scene.context, from.data(), to.data(), air.data()));
    if (to[1] > 0) {  // the planet stops the query
      for (size_t c = 0; c < 3; ++c) {
        const double truth = inBox * air[c];
        worst = std::max(worst, std::abs(s.froxel(x, y, slice).transmittance[c] - truth));
      }
    }
  }
  std::printf("transmittance: worst %.2g\n", worst);
  const double steps = 128;      // of a ray in the box, whose optical depths are summed in float
  const double rounding = 6e-8;  // of each
  const double geometry = 1e-5;  // the box's faces and slices in float, times the optical depth
  EXPECT_LT(worst, steps * rounding + geometry);
}

// Radiance that air scatters once over a distance, per unit irradiance: midpoint rule along the ray
// and towards the light, on a sphere.
std::array<double, 3> scatteredOnce(const std::array<double, 3>& eye,
                                    const std::array<double, 3>& view,
                                    const std::array<double, 3>& toSun, double reach) {
  constexpr double RADIUS = 6.371e6;
  constexpr double SCALE_HEIGHT = 8000;
  constexpr std::array<double, 3> SCATTERING{5.8e-6, 1.35e-5, 3.31e-5};
  const auto density = [&](const std::array<double, 3>& from, const std::array<double, 3>& along,
                           double t) {
    double squares = 0;
    for (size_t i = 0; i < 3; ++i) {
      const double x = from[i] + along[i] * t + (i == 1 ? RADIUS : 0);
      squares += x * x;
    }
    return std::exp((RADIUS - std::sqrt(squares)) / SCALE_HEIGHT);
  };
  constexpr int STEPS = 400;
  const double cosine = view[0] * toSun[0] + view[1] * toSun[1] + view[2] * toSun[2];
  const double phase = 3 / (16 * std::acos(-1.0)) * (1 + cosine * cosine);
  std::array<double, 3> sum{};
  double column = 0;
  const double dt = reach / STEPS;
  for (int i = 0; i < STEPS; ++i) {
    const double t = (i + 0.5) * dt;
    const std::array<double, 3> p{eye[0] + view[0] * t, eye[1] + view[1] * t, eye[2] + view[2] * t};
    double toLight = 0;
    for (int k = 0; k < STEPS; ++k) {
      const double ds = 3e5 / STEPS;
      toLight += ds * density(p, toSun, (k + 0.5) * ds);
    }
    const double part = dt * density(eye, view, t);
    for (size_t c = 0; c < 3; ++c) {
      sum[c] +=
          SCATTERING[c] * part * phase * std::exp(-SCATTERING[c] * (column + 0.5 * part + toLight));
    }
    column += part;
  }
  return sum;
}

TEST(AerialFroxels, HaveTheRadianceOfAQuadrature) {
  WlkAerialPerspective info = froxels(3, 3, 6);
  info.distance = 40000;
  AerialScene s(info, sized(24, 24));
  s.scene.setSky();
  s.scene.setSun(30, 60);
  auto quality = make<WlkQuality>();
  quality.volumeResolution = WLK_VOLUME_RESOLUTION_FULL;
  quality.scattering = WLK_SCATTERING_SINGLE;
  check(wlkSetQuality(s.scene.context, s.scene.view, &quality));
  const std::array<double, 3> eye{0, 1500, 0};
  s.scene.setCamera(eye, 0, 0);
  check(wlkPrepare(s.scene.context));
  s.render();
  const double degree = std::acos(-1.0) / 180;
  const std::array<double, 3> toSun{std::cos(30 * degree) * std::sin(60 * degree),
                                    std::sin(30 * degree),
                                    -std::cos(30 * degree) * std::cos(60 * degree)};
  double worst = 0;
  for (uint32_t slice = 1; slice < info.depth; ++slice) {
    for (uint32_t i = 0; i < 6; ++i) {  // columns above and at the horizon
      const std::array<double, 3> truth =
          scatteredOnce(eye, s.columnDirection(i % 3, i / 3), toSun, s.sliceDistance(slice));
      for (size_t c = 0; c < 3; ++c) {
        const double value = s.froxel(i % 3, i / 3, slice).radiance[c];
        worst = std::max(worst, std::abs(value / truth[c] - 1));
      }
    }
  }
  std::printf("radiance scattered once: worst %.2g\n", worst);
  const double model = 0.004;  // worst of the air's text for suns up to 80 degrees from the zenith
  EXPECT_LT(worst, model);
}

// Between slices an engine reads a straight line, whose error for e^(-s d) is at most s^2 h^2 / 8
// with slices h apart; between columns what the sky turns by is small.
TEST(AerialFroxels, AreReadBetweenThemByLinearFilters) {
  WlkAerialPerspective info = froxels(16, 9, 24);
  info.distance = 20000;
  constexpr uint32_t W = 48;
  constexpr uint32_t H = 27;
  AerialScene s(info, sized(W, H));
  addSky(s.scene);
  constexpr float FOG = 1.2e-4f;
  s.scene.setFog(FOG, 20000);
  // Above the horizon, where columns beside each other part, and away from the fog's aureole, which
  // is narrower than a column.
  s.scene.setSun(35, 190);
  s.scene.setCamera({0, 2, 0}, 0, 34);
  check(wlkPrepare(s.scene.context));
  double worstTransmittance = 0;
  double worstRadiance = 0;
  for (const double distance : {150.0, 900.0, 2500.0, 7000.0, 18500.0}) {
    s.surface = distance;
    s.render();
    const double w =
        std::pow(distance / static_cast<double>(info.distance), 0.5) * (info.depth - 1);
    const auto slice = static_cast<uint32_t>(w);
    for (uint32_t i = 0; i < W * H; ++i) {
      const double u = std::clamp((i % W + 0.5) / W * info.width - 0.5, 0.0, info.width - 1.0);
      const double v = std::clamp((i / W + 0.5) / H * info.height - 0.5, 0.0, info.height - 1.0);
      const auto x = std::min(static_cast<uint32_t>(u), info.width - 2);
      const auto y = std::min(static_cast<uint32_t>(v), info.height - 2);
      const RayLayer truth = s.pixel(i % W, i / W);
      for (size_t c = 0; c < 3; ++c) {
        double radiance = 0;
        double transmittance = 0;
        for (uint32_t corner = 0; corner < 8; ++corner) {
          const uint32_t dx = corner & 1;
          const uint32_t dy = corner >> 1 & 1;
          const uint32_t dz = corner >> 2;
          const auto weight = [](double at, uint32_t low, uint32_t side) {
            return side == 1 ? at - low : 1 - (at - low);
          };
          const double part = weight(u, x, dx) * weight(v, y, dy) * weight(w, slice, dz);
          const RayLayer froxel = s.froxel(x + dx, y + dy, slice + dz);
          radiance += part * froxel.radiance[c];
          transmittance += part * froxel.transmittance[c];
        }
        worstTransmittance =
            std::max(worstTransmittance, std::abs(transmittance - truth.transmittance[c]));
        worstRadiance = std::max(worstRadiance, std::abs(radiance / truth.radiance[c] - 1));
      }
    }
  }
  std::printf("between froxels: transmittance %.4f, radiance %.2f %%\n", worstTransmittance,
              100 * worstRadiance);
  const double extinction = static_cast<double>(FOG) + 3.31e-5;  // with blue light's air
  const double spacing = 2 * static_cast<double>(info.distance) / (info.depth - 1);  // the largest
  const double columns = 0.002;  // transmittance across half a column, 2 degrees
  EXPECT_LT(worstTransmittance, extinction * extinction * spacing * spacing / 8 + columns);
  EXPECT_LT(worstRadiance, 0.05);
}

TEST(AerialFroxels, HalfFloatsAreRounded) {
  const WlkAerialPerspective info = froxels(8, 6, 6);
  std::vector<std::vector<float>> pictures;
  for (const bool half : {false, true}) {
    AerialScene s(info, {}, half);
    addSky(s.scene);
    check(wlkPrepare(s.scene.context));
    s.render();
    pictures.push_back(s.texels(0));
    pictures.push_back(s.texels(1));
  }
  const float step = 1.0f / 2048;  // half an ulp of a half float, relative
  const float least = 3.0e-8f;     // half the smallest
  for (size_t image = 0; image < 2; ++image) {
    for (size_t i = 0; i < pictures[image].size(); ++i) {
      const float truth = pictures[image][i];
      EXPECT_NEAR(pictures[image + 2][i], truth, step * truth + least) << image << ", " << i;
    }
  }
}

TEST(AerialFroxels, BeginAtTheEyeAndFollowExposureAndColour) {
  const WlkAerialPerspective info = froxels(8, 6, 6);
  AerialScene s(info);
  addSky(s.scene);
  check(wlkPrepare(s.scene.context));
  s.render();
  const RayLayer before = s.froxel(3, 1, 5);
  EXPECT_EQ(s.froxel(3, 1, 0).radiance, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(s.froxel(3, 1, 0).transmittance, (std::array<double, 3>{1, 1, 1}));
  auto camera = make<WlkCamera>();
  camera.preExposure = 4;
  check(wlkSetCamera(s.scene.context, s.scene.view, &camera));
  s.render();
  camera.preExposure = 1;
  check(wlkSetCamera(s.scene.context, s.scene.view, &camera));
  const RayLayer exposed = s.froxel(3, 1, 5);
  s.render();
  const RayLayer plain = s.froxel(3, 1, 5);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(exposed.radiance[c] / plain.radiance[c], 4, 4e-6);
    EXPECT_EQ(exposed.transmittance[c], plain.transmittance[c]);
  }
  EXPECT_GT(before.radiance[2], before.radiance[0]);  // of air alone
}

}  // namespace
}  // namespace welkin::test
