// SPDX-License-Identifier: MIT
// Stops of rays through layers: each lies ahead of the one before, so that a ray gets to its end.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/model.hpp"

namespace {

namespace m = welkin::model::f32;

constexpr int RAYS = 200000;
constexpr float EARTH = 6371000.0f;  // m

class Random {
 public:
  float uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(generator_);
  }
  // Even in ln x.
  float logarithmic(float low, float high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

 private:
  std::mt19937 generator_{5};
};

struct Layer {
  float extinction;   // at the base, 1/m
  float scaleHeight;  // m
};

// From the ray's origin to its end.
int stopsOf(const m::Air& air, const m::AirRay& ray, float distance, const Layer& layer) {
  const m::AirPath path = m::clipToAir(air, ray, distance);
  const float focus = std::fmin(std::fmax(path.lowest, 0.0f), path.reach);
  const m::Stops stops = m::layerStops(air, path, focus, layer.extinction, 0.0f, layer.scaleHeight);
  constexpr int MANY = 100;
  int count = 0;
  float t = 0;
  while (t < path.reach && count < MANY) {
    t = std::fmin(m::nextStop(stops, t, path.reach), path.reach);
    ++count;
  }
  return count;
}

// Also of layers that are opaque towards the light, where the stops of a side have next to no room.
TEST(Stops, TakeARayToItsEnd) {
  Random random;
  int most = 0;
  int failed = 0;
  for (int i = 0; i < RAYS; ++i) {
    const Layer layer = {random.logarithmic(1e-7f, 1.0f), random.logarithmic(50.0f, 8000.0f)};
    m::Air air{};
    air.planetRadius = EARTH;
    air.airScaleHeight = 8000.0f;
    air.fogScaleHeight = layer.scaleHeight;
    m::AirRay ray{};
    ray.altitude = random.logarithmic(1.0f, 1e5f);
    ray.viewMu = i % 2 == 0 ? random.uniform(-1.0f, 1.0f) : random.uniform(-0.1f, 0.1f);
    ray.sunMu = random.uniform(-0.1f, 1.0f);
    const float across = std::sqrt((1 - ray.viewMu * ray.viewMu) * (1 - ray.sunMu * ray.sunMu));
    ray.viewSun = ray.viewMu * ray.sunMu + across * random.uniform(-1.0f, 1.0f);
    const int stops = stopsOf(air, ray, random.logarithmic(10.0f, 1e6f), layer);
    most = std::max(most, stops);
    failed += stops > static_cast<int>(m::MOST_STOPS) ? 1 : 0;
  }
  EXPECT_EQ(failed, 0) << "at most " << most << " stops";
}

}  // namespace
