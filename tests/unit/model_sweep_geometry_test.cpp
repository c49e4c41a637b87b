// SPDX-License-Identifier: MIT
// Sweeps of geometry.glsl and of rays against triangles.
#include "model_sweep.hpp"

namespace welkin::test {
namespace {

constexpr auto ends = [](const auto& span) { return std::array{span.begin, span.end}; };

// Altitude along a ray in units of its size: altitude, way up or down, fall of the ground.
template <typename Real>
Real ofItsSize(Real value, Real altitude, Real mu, Real radius, Real t) {
  return value / std::fmax(std::fmax(std::fabs(altitude), std::fabs(t * mu)),
                           std::fmax(t * t / (2 * radius), Real(1e-30)));
}

TEST(ModelSweep, GeometryHoldsFromTheGroundToTheStars) {
  // A difference of two floats and a quotient, and the constant for a component of 0.
  SWEEP(12, "rayBox", (Claim{-1e30, 1e30, roundings(3)}),
        (joined(std::array{a.signedMagnitude(1e-6f, 1e9f), a.signedMagnitude(1e-6f, 1e9f),
                           a.signedMagnitude(1e-6f, 1e9f)},
                a.direction(),
                std::array{-a.magnitude(1e-3f, 1e9f), -a.magnitude(1e-3f, 1e9f),
                           -a.magnitude(1e-3f, 1e9f), a.magnitude(1e-3f, 1e9f),
                           a.magnitude(1e-3f, 1e9f), a.magnitude(1e-3f, 1e9f)})),
        ends(m::rayBox(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3), vectorOf<m::vec3>(x, 6),
                       vectorOf<m::vec3>(x, 9))));
  SWEEP(2, "altitudePower", (Claim{-1e18, 4e18, roundings(3)}),
        ({a.signedMagnitude(1e-6f, 1e4f), a.uniform(1e4f, 1e9f)}), m::altitudePower(x[0], x[1]));
  SWEEP(4, "altitudeAlongRay", (Claim{-LARGEST, LARGEST}),
        ({a.signedMagnitude(1e-6f, 1e9f), a.cosine(), a.uniform(1e4f, 1e9f),
          a.magnitude(1e-6f, 1e15f)}),
        m::altitudeAlongRay(std::fmax(x[0], -x[2]), x[1], x[2], x[3]));
  // "A few 1e-7": some eight roundings in a sum of three terms, above half of the radius.
  SWEEP(4, "altitudeAlongRay, near", (Claim{-10.0, 10.0, roundings(8), 1.0}),
        ({a.signedMagnitude(1e-3f, 5e3f), a.cosine(), a.uniform(1e4f, 1e9f),
          a.magnitude(1e-3f, 1e7f)}),
        ofItsSize(m::altitudeAlongRay(x[0], x[1], x[2], std::fmin(x[3], x[2] / 4)), x[0], x[1],
                  x[2], std::fmin(x[3], x[2] / 4)));
  SWEEP(2, "horizonMu", (Claim{-1.000001, 0.0, 1e-6, 1e-12}),
        ({a.magnitude(1e-6f, 1e9f), a.uniform(1e4f, 1e9f)}), m::horizonMu(x[0], x[1]));
  SWEEP(3, "groundDistance", (Claim{-1.0, 1e12}),
        ({a.signedMagnitude(1e-6f, 1e9f), a.cosine(), a.uniform(1e4f, 1e9f)}),
        m::groundDistance(x[0], x[1], x[2]));
}

// A vertex in front of the eye or behind: x W, y W, W.
std::array<float, 3> vertex(Arguments& a) {
  const float w = a.signedMagnitude(1e-3f, 1e7f);
  return {w * a.uniform(-2000.0f, 2000.0f), w * a.uniform(-2000.0f, 2000.0f), w};
}

// 1 where both directions of an edge say the same of it, of `whole` numbers.
template <typename Real, typename Edge>
Real holds(const Edge& there, const Edge& back) {
  const Real sum = there.side + back.side;
  const bool one = there.side == 1 || there.side == -1 || there.side == 0;
  return one && sum == 0 && std::fabs(there.area) == std::fabs(back.area) ? Real(1) : Real(0);
}

// Facing, and where between the depths of its vertices a crossing lies: [0, 1].
template <typename Real, typename Crossing>
std::array<Real, 2> between(const Crossing& crossing, const std::array<Real, 3>& depth) {
  const Real low = std::fmin(depth[0], std::fmin(depth[1], depth[2]));
  const Real high = std::fmax(depth[0], std::fmax(depth[1], depth[2]));
  const Real size = std::fmax(std::fabs(low), std::fmax(std::fabs(high), Real(1e-30)));
  const bool inside =
      crossing.depth >= low - Real(1e-6) * size && crossing.depth <= high + Real(1e-6) * size;
  return {crossing.facing, inside ? Real(1) : Real(-2)};
}

TEST(ModelSweep, TrianglesHaveTwoSides) {
  constexpr auto PIXEL = [](Arguments& a) {
    return std::array{a.uniform(0.0f, 960.0f), a.uniform(0.0f, 540.0f)};
  };
  // In units of its terms: a product and a difference.
  sweep<5>(
      "fromPixel", Claim{-2.0, 2.0, roundings(3), 1.0},
      [&](Arguments& a) { return joined(vertex(a), PIXEL(a)); },
      [](const std::array<float, 5>& x) {
        const f32::vec3 moved = f32::fromPixel(vectorOf<f32::vec3>(x, 0), f32::vec2(x[3], x[4]));
        return moved / std::fmax(std::fabs(x[0]) + std::fabs(x[1]) + 1500 * std::fabs(x[2]), 1e-9f);
      },
      [](const std::array<float, 5>& x) {
        const f64::vec3 moved = f64::fromPixel(vectorOf<f64::vec3>(x, 0), f64::vec2(x[3], x[4]));
        const double size =
            std::fabs(double{x[0]}) + std::fabs(double{x[1]}) + 1500 * std::fabs(double{x[2]});
        return moved / std::fmax(size, 1e-9);
      });
  SWEEP(6, "edgeArea", (Claim{-2.0, 2.0, roundings(4), 1.0}), (joined(vertex(a), vertex(a))),
        m::edgeArea(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3)) /
            std::fmax(std::fabs(x[0] * x[4]) + std::fabs(x[1] * x[3]), real(1e-30)));
  SWEEP(7, "edgeSide", (Claim{-1.0, 1.0}),
        (joined(vertex(a), vertex(a), std::array{a.signedMagnitude(1e-30f, 1e20f)})),
        m::edgeSide(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3), x[6]));
  SWEEP(6, "edgeAt", (Claim{1.0, 1.0}), (joined(vertex(a), vertex(a))),
        holds<real>(m::edgeAt(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3)),
                    m::edgeAt(vectorOf<m::vec3>(x, 3), vectorOf<m::vec3>(x, 0))));
  sweep<11>(
      "surfaceCrossing", Claim{-1.0, 1.0},
      [&](Arguments& a) { return joined(vertex(a), vertex(a), vertex(a), PIXEL(a)); },
      [](const std::array<float, 11>& x) {
        const auto found = f32::surfaceCrossing(
            vectorOf<f32::vec3>(x, 0), vectorOf<f32::vec3>(x, 3), vectorOf<f32::vec3>(x, 6),
            f32::vec3(x[2], x[5], x[8]), f32::vec2(x[9], x[10]));
        return between<float>(found, {x[2], x[5], x[8]});
      },
      [](const std::array<float, 11>& x) {
        const auto found = f64::surfaceCrossing(
            vectorOf<f64::vec3>(x, 0), vectorOf<f64::vec3>(x, 3), vectorOf<f64::vec3>(x, 6),
            f64::vec3(x[2], x[5], x[8]), f64::vec2(x[9], x[10]));
        return between<double>(found, {double{x[2]}, double{x[5]}, double{x[8]}});
      });
}

}  // namespace
}  // namespace welkin::test
