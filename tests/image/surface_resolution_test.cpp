// SPDX-License-Identifier: MIT
// Surfaces whose light scattered more than once is computed in every fourth, then in every second
// pixel along both axes against such light in each: how far pictures differ, what passes the cloud,
// odd and tiny views, one surface behind another, and which commands are recorded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr std::array<double, 3> MIDDLE{100, 900, -4000};
// Of second pixels, and of those of a surface with detail: surface_spread.glsl. Of fourth ones that
// others lie between it is half.
constexpr double ALIKE = 0.07;
constexpr double ALIKE_DETAIL = 0.1;

struct Scene : HeadlessScene {
  Scene(uint32_t width, uint32_t height) : HeadlessScene(sized(width, height)) { setSun(40, 60); }
  static SceneOptions sized(uint32_t width, uint32_t height) {
    SceneOptions o;
    o.composite = WLK_COMPOSITE_SEPARATE;
    o.width = width;
    o.height = height;
    return o;
  }
  WlkSurface add(const support::ClosedMesh& mesh, double size,
                 const std::array<double, 3>& middle = MIDDLE) {
    return addSurface(*this, mesh, addMedium(), 0.01f, {size, size, size}, middle);
  }
  void setDetail(WlkSurface surface) const {
    auto detail = make<WlkSurfaceDetail>();
    detail.depth = 120;
    detail.size = 500;
    check(wlkSetSurfaceDetail(context, surface, &detail));
  }
  Image at(uint32_t resolution) const {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_MEDIUM;
    quality.volumeResolution = resolution;
    check(wlkSetQuality(context, view, &quality));
    Image image = render();
    EXPECT_EQ(image.badValues(), 0u);
    EXPECT_GE(*std::min_element(image.rgba.begin(), image.rgba.end()), 0.0f);
    return image;
  }
  uint32_t commands() const {
    uint32_t sum = 0;
    for (const WlkPassStats& pass : passes()) {
      sum += pass.pass == WLK_PASS_SURFACE ? pass.commands : 0;
    }
    return sum;
  }
};

struct Difference {
  double rms = 0;      // over the mean of what differs from 0
  double largest = 0;  // over the brightest
  double bias = 0;     // of the sums
};

Difference differenceOf(const Image& image, const Image& truth) {
  Difference d;
  double squares = 0;
  double sum = 0;
  double other = 0;
  double count = 0;
  double brightest = 1e-30;
  for (size_t i = 0; i < truth.rgba.size(); ++i) {
    if (i % 4 < 3 && truth.rgba[i] > 0) {
      const double off = double{image.rgba[i]} - double{truth.rgba[i]};
      brightest = std::max(brightest, double{truth.rgba[i]});
      d.largest = std::max(d.largest, std::abs(off));
      squares += off * off;
      sum += double{truth.rgba[i]};
      other += double{image.rgba[i]};
      count += 1;
    }
  }
  d.rms = std::sqrt(squares / std::max(count, 1.0)) / std::max(sum / std::max(count, 1.0), 1e-30);
  d.largest /= brightest;
  d.bias = other / std::max(sum, 1e-30) - 1;
  return d;
}

// Of second pixels between fourth ones.
uint32_t secondsThatDiffer(const Image& image, const Image& other) {
  uint32_t count = 0;
  for (uint32_t y = 0; y < image.height; y += 2) {
    for (uint32_t x = 0; x < image.width; x += 2) {
      const bool fourth = x % 4 == 0 && y % 4 == 0;
      count += !fourth && image.at(x, y)[1] != other.at(x, y)[1] ? 1U : 0U;
    }
  }
  return count;
}

void expectAlike(Scene& scene, const char* name, uint32_t surfaces, bool detail) {
  const Image full = scene.at(WLK_VOLUME_RESOLUTION_FULL);
  const uint32_t commandsFull = scene.commands();
  const Image passesFull = scene.read(WLK_IMAGE_TRANSMITTANCE);
  const Image half = scene.at(WLK_VOLUME_RESOLUTION_HALF);
  // Shading of second pixels and of the others, and the light of those that need their own.
  EXPECT_EQ(scene.commands(), commandsFull + 4 * surfaces) << name;
  // What passes is every pixel's own.
  EXPECT_TRUE(scene.read(WLK_IMAGE_TRANSMITTANCE) == passesFull) << name;
  const Difference d = differenceOf(half, full);
  std::printf("%s: RMS %.2e, largest %.2e, bias %.1e\n", name, d.rms, d.largest, d.bias);
  // A mean of what is alike is off by half of the bound along a step, and by half of the other
  // where it is one of means; few are.
  const double bound = detail ? ALIKE_DETAIL : ALIKE;
  EXPECT_LT(d.rms, 0.5 * (bound + 0.5 * bound) * 0.25) << name;
  // Means lie under what is bright and round: the curvature over a pixel.
  EXPECT_LT(std::abs(d.bias), 2e-3) << name;
  EXPECT_LT(d.largest, 2 * bound) << name;  // bodies thinner than four pixels, edges
  EXPECT_GT(d.rms, 0) << name << ": every pixel has its own";
  EXPECT_GT(secondsThatDiffer(half, full), 0u) << name << ": every second pixel has its own";
}

TEST(SurfaceResolution, HalfIsNearlyTheSamePicture) {
  Scene scene(160, 120);
  const WlkSurface torus = scene.add(support::torusMesh(), 900);
  expectAlike(scene, "torus", 1, false);
  scene.setDetail(torus);
  expectAlike(scene, "torus with detail", 1, true);
}

// Of a ball most light changes evenly, but by more than the bound: where only what is alike was
// taken on, that was 0.3 of its pixels, and 0.6 with what changes evenly.
TEST(SurfaceResolution, WhatChangesEvenlyIsTakenOn) {
  Scene scene(160, 120);
  scene.setSun(10, 90);
  scene.add(support::sphereMesh(5), 900);
  const Image full = scene.at(WLK_VOLUME_RESOLUTION_FULL);
  const Image half = scene.at(WLK_VOLUME_RESOLUTION_HALF);
  uint32_t covered = 0;
  uint32_t taken = 0;
  for (uint32_t y = 0; y < full.height; ++y) {
    for (uint32_t x = 0; x < full.width; ++x) {
      covered += full.at(x, y)[1] > 0 ? 1U : 0U;
      taken += full.at(x, y)[1] != half.at(x, y)[1] ? 1U : 0U;
    }
  }
  std::printf("taken on: %u of %u\n", taken, covered);
  EXPECT_GT(covered, 1000u);
  EXPECT_GT(taken, 0.5 * covered);
}

TEST(SurfaceResolution, OneBehindAnother) {
  Scene scene(160, 120);
  scene.add(support::sphereMesh(3), 500, {-300, 900, -3000});
  scene.add(support::torusMesh(), 900);
  expectAlike(scene, "sphere in front of a torus", 2, false);
}

// One mesh: a wall, and in front of it a bar as wide as a pixel, between second pixels, or fourth
// ones, which see the wall alone.
support::ClosedMesh wallAndBar(const glm::dvec3& bar, double width) {
  support::ClosedMesh both;
  const auto add = [&](const glm::dvec3& middle, const glm::dvec3& half) {
    const auto first = static_cast<uint32_t>(both.position.size());
    const support::ClosedMesh box = support::boxMesh();
    for (const glm::dvec3& p : box.position) {
      both.position.push_back(middle + p * half);
    }
    for (auto triangle : box.triangle) {
      for (uint32_t& index : triangle) {
        index += first;
      }
      both.triangle.push_back(triangle);
    }
  };
  add({0, 0, -4000}, {2500, 2500, 300});
  add(bar, {width / 2, 900, 150});
  return both;
}

struct Bar : ::testing::TestWithParam<uint32_t> {};

TEST_P(Bar, IsNotTheWallBehind) {
  Scene scene(96, 72);
  scene.setCamera({0, 0, 0}, 0, 0);
  const uint32_t column = GetParam();
  constexpr double DISTANCE = 2000;
  const auto placeOf = [&](uint32_t x) {
    const glm::dvec3 ray = pixelDirection(scene, x, 36);
    return ray * (DISTANCE / -ray.z);
  };
  const double width = placeOf(column + 1).x - placeOf(column).x;
  const glm::dvec3 bar(placeOf(column).x, 0, -DISTANCE);
  addSurface(scene, wallAndBar(bar, width), scene.addMedium(), 0.02f, {1, 1, 1}, {0, 0, 0});
  const Image full = scene.at(WLK_VOLUME_RESOLUTION_FULL);
  const Image half = scene.at(WLK_VOLUME_RESOLUTION_HALF);
  double most = 0;
  double other = 0;
  for (uint32_t y = 24; y < 48; ++y) {
    const double truth = double{full.at(column, y)[1]};
    most = std::max(most, std::abs(double{half.at(column, y)[1]} - truth) / truth);
    other = std::max(other, std::abs(double{full.at(column - 1, y)[1]} - truth) / truth);
  }
  EXPECT_GT(other, 0.2) << "the bar looks like the wall";
  // Floats of the same light, added up in another order; above and below a second pixel of the bar
  // there is another one.
  EXPECT_LT(most, column % 2 == 0 ? 0.5 * ALIKE : 1e-5);
}

// Of a second pixel, and of one between second pixels.
INSTANTIATE_TEST_SUITE_P(SurfaceResolution, Bar, ::testing::Values(50u, 51u));

// Rows and columns without a second pixel behind them have their own light.
TEST(SurfaceResolution, OddAndTinyViews) {
  for (const auto& [width, height] : std::initializer_list<std::pair<uint32_t, uint32_t>>{
           {1, 1}, {2, 1}, {1, 3}, {3, 5}, {5, 4}, {17, 9}, {33, 31}}) {
    Scene scene(width, height);
    scene.add(support::boxMesh(), 2000);  // all of the view
    const Image full = scene.at(WLK_VOLUME_RESOLUTION_FULL);
    const Image half = scene.at(WLK_VOLUME_RESOLUTION_HALF);
    const Difference d = differenceOf(half, full);
    EXPECT_LT(d.largest, 0.05) << width << " x " << height;
    if (width == 1 && height == 1) {
      EXPECT_EQ(d.largest, 0);
    }
    for (const std::string& message : scene.messages()) {
      ADD_FAILURE() << message;
    }
  }
}

}  // namespace
}  // namespace welkin::test
