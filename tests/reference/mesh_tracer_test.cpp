// SPDX-License-Identifier: MIT
// Monte Carlo in a mesh against an analytic sphere, a quadrature, the solver of slabs and the
// conservation of energy.
#include "reference/mesh_tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "reference/body.hpp"
#include "reference/mesh_shapes.hpp"
#include "reference/slab_solver.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double ERRORS = 3.5;  // standard errors; seeds are fixed
constexpr double G = 0.85;

MeshMedium medium(double extinction, double albedo = 1) {
  return {extinction, albedo, PhaseFunction::henyeyGreenstein(G)};
}

double errorOf(const MeshEstimate& e) {
  return std::sqrt(e.onceVariance + e.restVariance);
}

TEST(MeshTracer, SphereIsTheAnalyticSphere) {
  constexpr double RADIUS = 5;
  constexpr uint64_t PATHS = 40000;
  // 16 000 facets of a sphere of the same volume: below 3e-3 of the radiance, away from the rim.
  constexpr double FACETS = 3e-3;
  const MeshBody mesh = sphereBody(1, 64);
  const MeshMedium cloud = medium(RADIUS);
  const MeshTracer tracer(mesh, cloud);
  const Body sphere = makeBody("sphere-5");
  double squares = 0;
  int count = 0;
  for (const double degrees : {180.0, 90.0, 20.0}) {
    const double angle = degrees * PI / 180;
    for (const auto& [u, v] : {std::pair{0.05, 0.1}, {-0.6, 0.2}, {0.5, -0.55}}) {
      constexpr double SIZE = 0.05;
      const BodyEstimate truth = traceBody(sphere, cloud.phase, angle, u, v, SIZE, PATHS,
                                           1 + static_cast<uint64_t>(count));
      const auto draw = [&, left = u, low = v](Random& random) {
        const BodyRay ray =
            bodyRay(sphere, angle, left + SIZE * random.uniform(), low + SIZE * random.uniform());
        return MeshTracer::Start{{along({0, 0, 0}, ray.origin, 1 / RADIUS), ray.direction},
                                 {0, 0, 1}};
      };
      const MeshEstimate found = tracer.trace(draw, PATHS, 77, static_cast<uint64_t>(count));
      const double value = found.once + found.rest;
      const double error = std::hypot(errorOf(found), std::sqrt(truth.variance / PATHS));
      EXPECT_NEAR(value, truth.radiance, ERRORS * error + FACETS * truth.radiance) << degrees;
      EXPECT_LT(error, 0.06 * truth.radiance) << degrees;
      squares += std::pow((value - truth.radiance) / error, 2);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.71);  // 3 sigma of the root of a mean of 9 squares
}

// Light from everywhere, radiance 1, nothing absorbed: what is scattered makes up for the opacity.
TEST(MeshTracer, FurnaceIsEvenlyBright) {
  const MeshBody torus = shaped(torusShape(), {1, 1, 1}, 0.3);
  for (const double extinction : {1.0, 12.0}) {
    const MeshMedium cloud = medium(extinction);
    const MeshTracer tracer(torus, cloud);
    for (const Point& direction : {Point{0.3, 0.1, -1}, Point{1, 0.05, 0.02}}) {
      const auto draw = [&](Random& random) {
        const Point d = normalized(direction);
        const Point toLight = deflected({0, 0, 1}, 2 * random.uniform(), 2 * PI * random.uniform());
        return MeshTracer::Start{{along({0.6, 0.1, 0}, d, -5), d}, toLight};
      };
      const MeshEstimate found = tracer.trace(draw, 150000, 5, 0);
      const double scattered = 4 * PI * (found.once + found.rest);
      const double error = 4 * PI * errorOf(found);
      EXPECT_NEAR(scattered, found.opacity, ERRORS * error) << extinction;
      EXPECT_LT(error, 0.02 * found.opacity);
      EXPECT_GT(found.opacity, 0.3);
    }
  }
}

TEST(MeshTracer, LightScatteredOnceIsItsIntegral) {
  constexpr int STEPS = 2000;  // midpoints of smooth pieces: 1e-6
  const MeshBody box = shaped(boxShape(), {1, 0.5, 0.8}, 0.4);
  const MeshMedium cloud = medium(3, 0.9);
  const MeshTracer tracer(box, cloud);
  std::vector<MeshStretch> memory;
  std::vector<MeshStretch> other;
  for (const Point& to : {Point{0, 0, 1}, Point{0.7, -0.5, 0.2}}) {
    for (const Point& way : {Point{0.2, 0.1, -1}, Point{-0.4, 1, 0.3}}) {
      const Point light = normalized(to);
      const Point direction = normalized(way);
      const Point origin = along({0.1, 0.05, -0.1}, direction, -6);
      box.inside(origin, direction, memory);
      ASSERT_EQ(memory.size(), 1U);
      const double step = (memory[0].end - memory[0].begin) / STEPS;
      double expected = 0;
      for (int i = 0; i < STEPS; ++i) {
        const double at = (i + 0.5) * step;
        const double shade =
            box.length(along(origin, direction, memory[0].begin + at), light, other);
        expected += cloud.albedo * cloud.phase.value(0, oneMinusCosine(direction, light)) *
                    cloud.extinction * step * std::exp(-cloud.extinction * (at + shade));
      }
      const auto draw = [&](Random&) { return MeshTracer::Start{{origin, direction}, light}; };
      const MeshEstimate found = tracer.trace(draw, 60000, 9, 0);
      EXPECT_NEAR(found.once, expected, ERRORS * std::sqrt(found.onceVariance));
      EXPECT_LT(std::sqrt(found.onceVariance), 0.01 * expected);
    }
  }
}

// The middle of a wide box, thickness 1, 200 wide, light and view askew.
TEST(MeshTracer, MiddleOfAWideBoxIsTheSlab) {
  const MeshBody box = shaped(boxShape(), {100, 100, 0.5}, 0.3);
  constexpr double MU_LIGHT = 0.7;
  const Point light = {std::sqrt(1 - MU_LIGHT * MU_LIGHT), 0, MU_LIGHT};
  for (const auto& [tau, albedo] : {std::pair{2.0, 1.0}, {8.0, 1.0}, {8.0, 0.95}}) {
    const MeshMedium cloud = medium(tau, albedo);
    const MeshTracer tracer(box, cloud);
    const SlabSolver solver(henyeyGreensteinSlabPhase(G), albedo, 48);
    for (const auto& [mu, phi] : {std::pair{0.8, 2.0}, {0.4, 0.5}, {-0.6, 1.0}}) {
      // The light that is seen travels along -direction; the beam has azimuth pi.
      const double sine = std::sqrt(1 - mu * mu);
      const Point direction = {sine * std::cos(phi), sine * std::sin(phi), -mu};
      const SlabRadiance truth = solver.radiance(tau, MU_LIGHT, {mu, phi});
      const auto draw = [&](Random&) {
        return MeshTracer::Start{{along({0.3, 0.1, 0}, direction, -20), direction}, light};
      };
      const MeshEstimate found = tracer.trace(draw, 60000, 13, 0);
      EXPECT_NEAR(found.once + found.rest, truth.total, ERRORS * errorOf(found)) << tau << mu;
      EXPECT_NEAR(found.once, truth.single, ERRORS * std::sqrt(found.onceVariance)) << tau << mu;
      EXPECT_LT(errorOf(found), 0.04 * truth.total) << tau << mu;
    }
  }
}

TEST(MeshTracer, RepeatsAndIsDarkBesideTheBody) {
  const MeshBody box = shaped(boxShape(), {1, 1, 1});
  const MeshMedium cloud = medium(4);
  const MeshTracer tracer(box, cloud);
  const auto through = [](double x) {
    return [x](Random&) { return MeshTracer::Start{{{x, 0.2, 5}, {0, 0, -1}}, {0.6, 0, 0.8}}; };
  };
  const MeshEstimate a = tracer.trace(through(0.1), 500, 3, 7);
  const MeshEstimate b = tracer.trace(through(0.1), 500, 3, 7);
  EXPECT_EQ(a.once, b.once);
  EXPECT_EQ(a.rest, b.rest);
  EXPECT_NE(a.rest, tracer.trace(through(0.1), 500, 4, 7).rest);
  const MeshEstimate beside = tracer.trace(through(1.1), 100, 3, 7);
  EXPECT_EQ(beside.once + beside.rest + beside.opacity, 0);
}

}  // namespace
}  // namespace welkin::reference
