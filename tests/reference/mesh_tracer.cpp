// SPDX-License-Identifier: MIT
#include "reference/mesh_tracer.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace welkin::reference {
namespace {

// Beyond this depth light survives with probability e^(SHADOW_DEPTH - depth): the right mean.
constexpr double SHADOW_DEPTH = 5;

// Point that lies a length inside the body along the ray; false if the ray leaves before.
bool reach(const std::vector<MeshStretch>& stretches, double length, MeshRay& ray) {
  for (const MeshStretch& stretch : stretches) {
    if (length <= stretch.end - stretch.begin) {
      ray.origin = along(ray.origin, ray.direction, stretch.begin + length);
      return true;
    }
    length -= stretch.end - stretch.begin;
  }
  return false;
}

}  // namespace

// Paths start at the eye; their first collision is forced, every collision sees the light.
MeshTracer::Light MeshTracer::path(const Start& start, Random& random) const {
  thread_local std::vector<MeshStretch> stretches;
  Light light;
  MeshRay ray = start.ray;
  light.opacity =
      -std::expm1(-medium_.extinction * body_.length(ray.origin, ray.direction, stretches));
  if (light.opacity <= 0) {
    return light;
  }
  if (stretches.front().front != MeshStretch::NONE) {
    light.facing = dot(body_.normal(stretches.front().front), start.toLight);
  }
  double weight = light.opacity;
  double depth = -std::log1p(-random.uniform() * light.opacity);
  for (uint64_t order = 1; reach(stretches, depth / medium_.extinction, ray); ++order) {
    weight *= medium_.albedo;
    if (weight <= 0) {
      break;
    }
    const double shade = medium_.extinction * body_.length(ray.origin, start.toLight, stretches);
    if (shade < SHADOW_DEPTH || random.uniform() < std::exp(SHADOW_DEPTH - shade)) {
      const double value = weight * std::exp(-std::fmin(shade, SHADOW_DEPTH)) *
                           medium_.phase.value(0, oneMinusCosine(ray.direction, start.toLight));
      (order == 1 ? light.once : light.rest) += value;
    }
    ray.direction = deflected(ray.direction, medium_.phase.sample(0, random.uniform()),
                              2 * std::numbers::pi * random.uniform());
    depth = random.exponential();
    body_.inside(ray.origin, ray.direction, stretches);
  }
  return light;
}

MeshEstimate MeshTracer::trace(const std::function<Start(Random&)>& draw, uint64_t paths,
                               uint64_t seed, uint64_t pixel) const {
  MeshEstimate sum;
  for (uint64_t i = 0; i < paths; ++i) {
    Random random(seed, pixel, i, 0);
    const Light light = path(draw(random), random);
    sum.once += light.once;
    sum.onceVariance += light.once * light.once;
    sum.rest += light.rest;
    sum.restVariance += light.rest * light.rest;
    sum.opacity += light.opacity;
    sum.facing += light.facing;
  }
  const auto n = static_cast<double>(paths);
  const auto variance = [n](double first, double second) {
    const double mean = first / n;
    return std::fmax(second / n - mean * mean, 0.0) / std::fmax(n - 1, 1.0);
  };
  return {sum.once / n,    variance(sum.once, sum.onceVariance),
          sum.rest / n,    variance(sum.rest, sum.restVariance),
          sum.opacity / n, sum.facing / n};
}

}  // namespace welkin::reference
