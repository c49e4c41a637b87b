// SPDX-License-Identifier: MIT
// src/frame/ambient: light along the directions of a volume's grid has the moments of the light
// around it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "frame/ambient.hpp"
#include "frame/transport_rays.hpp"

namespace {

using welkin::AmbientLight;
using welkin::AmbientSample;
using welkin::TransportShape;

constexpr double EPS_FLOAT = 0x1p-24;
// A box that lies askew.
const glm::dmat3 BOX(glm::dvec3{300, 100, 0}, glm::dvec3{-100, 300, 40}, glm::dvec3{0, -40, 300});

// Even over the sphere, by the golden angle.
std::vector<AmbientSample> samplesOf(const auto& radiance) {
  constexpr int COUNT = 400;
  std::vector<AmbientSample> samples;
  for (int i = 0; i < COUNT; ++i) {
    const double y = 1 - (2.0 * i + 1) / COUNT;
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double flat = std::sqrt(1 - y * y);
    const glm::dvec3 from(flat * std::cos(azimuth), y, flat * std::sin(azimuth));
    samples.push_back({from, 4 * std::numbers::pi / COUNT, radiance(from)});
  }
  return samples;
}

glm::dvec3 momentOf(const AmbientLight& light, const TransportShape& shape, size_t term) {
  const auto q = welkin::transportQuadrature();
  const auto travels = welkin::transportDirectionsIn(BOX, shape);
  glm::dvec3 sum(0);
  for (size_t d = 0; d < light.size(); ++d) {
    sum += q.coarse[d] * welkin::transportHarmonics(travels[d])[term] * glm::dvec3(light[d]);
  }
  return sum;
}

TEST(AmbientSource, OfLightThatIsTheSameEverywhereIsThatLight) {
  const auto samples = samplesOf([](const glm::dvec3&) { return glm::dvec3(0.25, 1, 4); });
  const AmbientLight light = welkin::ambientThrough(BOX, {}, samples);
  for (const glm::vec4& one : light) {
    EXPECT_NEAR(one.x, 0.25, 2 * EPS_FLOAT);
    EXPECT_NEAR(one.y, 1, 4 * EPS_FLOAT);
    EXPECT_NEAR(one.z, 4, 16 * EPS_FLOAT);
  }
  EXPECT_FALSE(welkin::dark(light));
  EXPECT_TRUE(welkin::dark(
      welkin::ambientThrough(BOX, {}, samplesOf([](const glm::dvec3&) { return glm::dvec3(0); }))));
}

// Bright above, darker below, brightest around the horizon.
TEST(AmbientSource, HasTheMomentsOfTheLightAroundIt) {
  const auto samples = samplesOf([](const glm::dvec3& from) {
    const double band = std::exp(-20 * from.y * from.y);
    return (from.y > 0 ? glm::dvec3(0.5, 0.7, 1) : glm::dvec3(0.3, 0.3, 0.2)) + 0.3 * band +
           0.2 * from.x;
  });
  for (const int thin : {-1, 1}) {
    TransportShape shape;
    shape.thinAxis = thin;
    const AmbientLight light = welkin::ambientThrough(BOX, shape, samples);
    for (size_t term = 0; term < 16; ++term) {
      glm::dvec3 wanted(0);
      glm::dvec3 mean(0);
      for (const AmbientSample& sample : samples) {
        mean += sample.radiance / static_cast<double>(samples.size());
      }
      for (const AmbientSample& sample : samples) {
        wanted += welkin::transportHarmonics(-sample.from)[term] * (sample.radiance - mean) /
                  static_cast<double>(samples.size());
      }
      wanted += term == 0 ? mean : glm::dvec3(0);
      const glm::dvec3 got = momentOf(light, shape, term);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(got[c], wanted[c], 26 * 4 * EPS_FLOAT) << "term " << term;
      }
    }
  }
}

TEST(AmbientSource, IsNowhereBelowZeroAndKeepsItsMean) {
  // One bright direction.
  const auto samples = samplesOf(
      [](const glm::dvec3& from) { return from.y > 0.95 ? glm::dvec3(10, 1, 0) : glm::dvec3(0); });
  const AmbientLight light = welkin::ambientThrough(BOX, {}, samples);
  glm::dvec3 mean(0);
  for (const AmbientSample& sample : samples) {
    mean += sample.radiance / static_cast<double>(samples.size());
  }
  for (const glm::vec4& one : light) {
    EXPECT_GE(one.x, 0.0f);
    EXPECT_EQ(one.z, 0.0f);
  }
  EXPECT_NEAR(momentOf(light, {}, 0).x, mean.x, 26 * EPS_FLOAT * mean.x);
}

}  // namespace
