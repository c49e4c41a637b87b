// SPDX-License-Identifier: MIT
// Rings around the point opposite the sun, on a bumpy sheet bounded by a mesh: the radiance at an
// angle from there, in the mean over the ring, has its maxima where the phase function has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr double DEGREE = std::numbers::pi / 180;
constexpr double BIN = 0.25;  // degrees
constexpr double MOST = 43;
constexpr double SUN = 40;  // degrees over the horizon, behind the eye

// Heights of the unit sheet's upper face over its lower one, some bumps wide.
double heightAt(double x, double z) {
  return 1 + 0.12 * std::sin(31 * x + 2 * std::sin(9 * z)) * std::sin(27 * z + 1);
}

support::ClosedMesh bumpySheet() {
  constexpr uint32_t N = 160;
  support::ClosedMesh mesh;
  for (uint32_t i = 0; i < 2 * (N + 1) * (N + 1); ++i) {
    const double x = 2.0 * (i / 2 % (N + 1)) / N - 1;
    const double z = 2.0 * (i / 2 / (N + 1)) / N - 1;
    mesh.position.push_back({x, i % 2 == 0 ? 0 : heightAt(x, z), z});
  }
  const auto at = [](uint32_t x, uint32_t z, uint32_t top) { return 2 * (z * (N + 1) + x) + top; };
  const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    mesh.triangle.push_back({a, b, c});
    mesh.triangle.push_back({a, c, d});
  };
  for (uint32_t j = 0; j < N; ++j) {
    for (uint32_t i = 0; i < N; ++i) {
      quad(at(i, j, 1), at(i, j + 1, 1), at(i + 1, j + 1, 1), at(i + 1, j, 1));
      quad(at(i, j, 0), at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0));
    }
    quad(at(j, 0, 0), at(j, 0, 1), at(j + 1, 0, 1), at(j + 1, 0, 0));
    quad(at(j, N, 0), at(j + 1, N, 0), at(j + 1, N, 1), at(j, N, 1));
    quad(at(0, j, 0), at(0, j + 1, 0), at(0, j + 1, 1), at(0, j, 1));
    quad(at(N, j, 0), at(N, j, 1), at(N, j + 1, 1), at(N, j + 1, 0));
  }
  return mesh;
}

// Angle in degrees of the largest value with `from` to `to` degrees; parabola through three bins.
double peakOf(const std::vector<double>& profile, double from, double to) {
  const auto first = profile.begin() + static_cast<std::ptrdiff_t>(from / BIN);
  const auto last = profile.begin() + static_cast<std::ptrdiff_t>(to / BIN);
  const auto most = std::max_element(first, last);
  EXPECT_NE(most, first) << "no maximum inside";
  EXPECT_NE(most, last - 1) << "no maximum inside";
  const double low = *(most - 1);
  const double high = *(most + 1);
  const double part = 0.5 * (low - high) / std::min(low - 2 * *most + high, -1e-30);
  return (static_cast<double>(most - profile.begin()) + 0.5 + part) * BIN;
}

TEST(SurfaceGlory, RingsLieWhereThePhaseFunctionHasThem) {
  SceneOptions options;
  options.width = 640;
  options.height = 480;
  options.composite = WLK_COMPOSITE_SEPARATE;
  options.validation = false;
  const HeadlessScene scene(options);
  scene.setSun(SUN, 180);
  auto info = make<WlkMediumInfo>();
  info.diameter_um = 10;
  WlkMedium droplets{};
  check(wlkCreateMedium(scene.context, &info, &droplets));
  constexpr double HALF = 20e3;  // m
  addSurface(scene, bumpySheet(), droplets, 0.03f, {HALF, 300, HALF}, {0, 0, 0});
  scene.setCamera({0, 2000, 0}, 0, -SUN);
  const Image light = scene.render();

  constexpr auto BINS = static_cast<size_t>(MOST / BIN);
  std::array<std::vector<double>, 3> profile;
  std::vector<double> count(BINS);
  profile.fill(std::vector<double>(BINS));
  for (uint32_t y = 0; y < light.height; ++y) {
    for (uint32_t x = 0; x < light.width; ++x) {
      // The camera looks there.
      const glm::dvec3 ray = pixelDirection(scene, x, y);
      const auto bin =
          static_cast<size_t>(std::atan2(std::hypot(ray.x, ray.y), -ray.z) / DEGREE / BIN);
      if (bin < BINS) {
        count[bin] += 1;
        for (size_t c = 0; c < 3; ++c) {
          profile[c][bin] += static_cast<double>(light.at(x, y)[c]);
        }
      }
    }
  }
  std::vector<double> angles;
  for (size_t bin = 0; bin < BINS; ++bin) {
    ASSERT_GT(count[bin], 0);
    angles.push_back(std::numbers::pi - (static_cast<double>(bin) + 0.5) * BIN * DEGREE);
    for (std::vector<double>& channel : profile) {
      channel[bin] /= count[bin];
    }
  }
  std::vector<double> phase(3 * BINS);
  auto query = make<WlkPhaseQuery>();
  query.medium = droplets;
  query.count = BINS;
  query.scatteringAngle = angles.data();
  check(wlkEvalPhase(scene.context, &query, phase.data()));

  std::array<double, 3> glory{};
  for (size_t c = 0; c < 3; ++c) {
    std::vector<double> curve;
    for (size_t bin = 0; bin < BINS; ++bin) {
      curve.push_back(phase[3 * bin + c]);
    }
    // The glory's first ring; the fogbow, on light that changes by more than it over its width.
    glory[c] = peakOf(profile[c], 1, 6);
    const double expected = peakOf(curve, 1, 6);
    const double bow = peakOf(profile[c], 28, 42);
    const double expectedBow = peakOf(curve, 28, 42);
    std::printf("channel %zu: glory at %.2f, phase function %.2f; fogbow at %.2f, %.2f degrees\n",
                c, glory[c], expected, bow, expectedBow);
    EXPECT_NEAR(glory[c], expected, BIN);
    EXPECT_NEAR(bow, expectedBow, 1);
  }
  EXPECT_GT(glory[0], glory[1]) << "red outside";
  EXPECT_GT(glory[1], glory[2]);
}

}  // namespace
}  // namespace welkin::test
