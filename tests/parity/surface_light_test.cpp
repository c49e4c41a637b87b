// SPDX-License-Identifier: MIT
// The fetches of shaders/pass/surface_light.glsl on the device against the rule in double.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "model/model.hpp"
#include "support/compute_runner.hpp"
#include "surface_light_spv.h"
#include "tables/surface_source.hpp"

namespace {

using namespace welkin;
namespace f64 = welkin::model::f64;

constexpr size_t ROWS = 1024;
constexpr uint32_t GROUP = 64;

// The maps of surface_light.comp: columns and faces at a level.
struct Maps {
  f64::vec4 column;
  f64::vec4 face;
};

Maps mapsAt(double x, double y, double level) {
  const double coverage = 1 / (1 + 0.1 * level);
  const double slope = 0.6 * x / (1 + level);
  return {f64::vec4(1, 20 * y + level, slope, 0.1) * coverage,
          f64::vec4(0.8, 0.2, slope, 5 + level) * coverage};
}

// Linear between whole levels.
f64::LightFootprint footprint(double x, double y, double level, double extinction,
                              double shade = 0) {
  const double low = std::floor(level);
  const Maps a = mapsAt(x, y, low);
  const Maps b = mapsAt(x, y, low + 1);
  const f64::vec4 column = glm::mix(a.column, b.column, level - low);
  const f64::vec4 face = glm::mix(a.face, b.face, level - low);
  const double coverage = column.x;
  f64::LightFootprint around{};
  around.coverage = coverage;
  around.through = column.y * extinction;
  around.lit = f64::vec3(column.z, column.w, face.x);
  around.shaded = f64::vec3(face.y, face.z,
                            -std::sqrt(coverage * coverage - face.y * face.y - face.z * face.z));
  around.rise = (face.w / coverage - (8 - shade)) * extinction;  // a point 8 m along the light
  return around;
}

double expected(const SurfaceSource& source, const float* row) {
  const f64::vec3 light(0, 0, 1);
  const f64::vec3 eye(static_cast<double>(row[3]), static_cast<double>(row[4]),
                      static_cast<double>(row[5]));
  const double x = static_cast<double>(row[0]);
  const double y = static_cast<double>(row[1]);
  const double texel = static_cast<double>(row[6]);
  const double extinction = static_cast<double>(row[7]);
  const f64::LightFootprint here = footprint(x, y, 0, extinction);
  const double through = f64::footprintMean(here.through, here.coverage);
  const double share = f64::lightDepthShare(static_cast<double>(row[2]) * extinction, through);
  const f64::LightFootprint some =
      footprint(x, y, f64::footprintLevel(f64::LOCAL_SPREAD / extinction, texel), extinction);
  const double across = f64::footprintMean(some.through, some.coverage);
  const f64::TangentSlab local = f64::tangentSlab(across, f64::depthInSlab(across, share, through),
                                                  f64::directionOr(some.lit, light), light, eye);
  double sum = 0;
  for (int set = 0; set < f64::SURFACE_SETS; ++set) {
    const double level = f64::footprintLevel(f64::footprintSpread(set, local) / extinction, texel);
    const f64::SurfaceSlab found =
        f64::surfaceSlab(set, footprint(x, y, level, extinction, static_cast<double>(row[2])),
                         share, through, light, eye);
    sum += found.inside * surfaceSourceAt(source, static_cast<size_t>(set),
                                          {found.slab.thickness, found.slab.depth,
                                           found.slab.muLight, found.slab.muView, found.slab.phi});
  }
  return sum;
}

TEST(SurfaceLight, DeviceIsTheRuleInDouble) {
  const SurfaceSource source = surfaceSource(decodeCanonical(shippedCanonical()));
  const SurfaceSourceImage image = surfaceSourceImage(source);
  std::vector<float> input = image.values;
  input.insert(input.end(), image.logPhase.begin(), image.logPhase.end());
  const size_t first = input.size();
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.05, 1);
  for (size_t i = 0; i < ROWS; ++i) {
    const double v[3] = {normal(generator), normal(generator), normal(generator)};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (const double number :
         {uniform(generator), uniform(generator), 20 * uniform(generator), v[0] / length,
          v[1] / length, v[2] / length, uniform(generator), uniform(generator)}) {
      input.push_back(static_cast<float>(number));
    }
  }
  support::ComputeRunner runner;
  const std::vector<float> device = runner.run(surface_light_spv, 0, input, ROWS, ROWS / GROUP);
  // Values of up to 40 are interpolated five times and meet an exponential (condition 40), which
  // takes 40 * 12 roundings; near the glory ln P changes by 10 per rad, and lavapipe's atan is off
  // by 3.4e-6. 2 for the freedom of order.
  constexpr double BOUND = 2 * (40 * 12 * 0x1p-24 + 10 * 3.4e-6);
  double worst = 0;
  for (size_t i = 0; i < ROWS; ++i) {
    const double truth = expected(source, &input[first + 8 * i]);
    worst = std::max(worst, std::abs(static_cast<double>(device[i]) / truth - 1));
  }
  std::printf("worst %.2g\n", worst);
  EXPECT_LE(worst, BOUND);
  EXPECT_TRUE(runner.messages().empty()) << runner.messages().front();
}

}  // namespace
