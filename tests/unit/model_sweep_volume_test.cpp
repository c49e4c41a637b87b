// SPDX-License-Identifier: MIT
// Sweeps of shaders/model/volume: slabs, tables of scattering orders, the canonical slab.
#include "model_sweep.hpp"

namespace welkin::test {
namespace {

constexpr double COORDINATE = 4e-7;  // of [0, 1]: a few roundings of logarithm and root

TEST(ModelSweep, SlabsOfVolumesKeepEnergy) {
  // The sum of two unit vectors is no shorter than sqrt(2); which of two depends on a rounding
  // where they are square.
  SWEEP(6, "halfAngleAxis", (Claim{1.0 - 1e-6, 1.0 + 1e-6}), (joined(a.direction(), a.direction())),
        glm::length(m::halfAngleAxis(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3))));
  SWEEP(1, "slabOpacity", (Claim{0.0, 1.0, 3e-7}), ({a.magnitude(1e-38f, 3e38f)}),
        m::slabOpacity(x[0]));
  // Of 1: what is lost is a difference.
  SWEEP(2, "forwardLoss", (Claim{0.0, 1.0, roundings(2), 1.0}),
        ({a.uniform(0.0f, 1.0f), a.uniform(0.0f, 1.0f)}), m::forwardLoss(x[0], x[1]));
}

TEST(ModelSweep, TablesOfOrdersAreReadInside) {
  SWEEP(1, "phaseCoordinate", (Claim{0.0, 1.0, COORDINATE, 1.0}), ({a.magnitude(1e-30f, 2.0f)}),
        m::phaseCoordinate(x[0]));
  SWEEP(1, "depthCoordinate", (Claim{0.0, 1.0, COORDINATE, 1.0}),
        ({a.signedMagnitude(1e-30f, 1e30f)}), m::depthCoordinate(x[0]));
}

TEST(ModelSweep, CanonicalSlabsAreReadInside) {
  SWEEP(1, "canonicalThickness", (Claim{0.0, 1.0 + 1e-6, COORDINATE, 1.0}),
        ({a.magnitude(1e-30f, 1e30f)}), m::canonicalThickness(x[0]));
  SWEEP(1, "canonicalCosine", (Claim{0.0, 1.0 + 1e-6, COORDINATE, 1.0}), ({a.uniform(-1.0f, 1.0f)}),
        m::canonicalCosine(x[0]));
  // A logarithm of 1 and more: of thin slabs it has the rounding of 1.
  SWEEP(1, "canonicalSpread", (Claim{0.0, 20.0, roundings(3), 1.0}), ({a.magnitude(1e-30f, 1e6f)}),
        m::canonicalSpread(x[0]));
  // Three such logarithms, over that of the thinnest.
  SWEEP(2, "canonicalDepth", (Claim{-1e-6, 1.0 + 1e-6, roundings(3.0 * 3.0 / 0.48), 1.0}),
        ({a.uniform(0.0f, 128.0f), a.uniform(0.0625f, 128.0f)}),
        m::canonicalDepth(std::fmin(x[0], x[1]), x[1]));
  // Three factors up to 2, each right to a rounding.
  SWEEP(1, "canonicalCubic", (Claim{-0.13, 1.0 + 1e-6, roundings(2.0 * 3.0), 1.0}),
        ({a.uniform(0.0f, 1.0f)}), m::canonicalCubic(x[0]));
  // Of the thickest: distances from the far face.
  SWEEP(2, "canonicalInside", (Claim{0.0, 128.0, roundings(3), 128.0}),
        ({a.magnitude(1e-30f, 1e6f), a.magnitude(1e-30f, 1e6f)}),
        m::canonicalInside(std::fmax(x[0], x[1]), std::fmin(x[0], x[1])));
  SWEEP(3, "canonicalLength", (Claim{0.0, 1e12, roundings(3)}),
        ({a.magnitude(1e-9f, 1e6f), a.magnitude(1e-9f, 1e6f), a.cosine()}),
        m::canonicalLength(std::fmin(x[0], x[1]), std::fmax(x[0], x[1]), x[2]));
  // Four factors; those of exp and 1 - e^-x are 3e-7 at most. No product is subnormal.
  SWEEP(4, "canonicalRadiance", (Claim{0.0, 1e20, 2.0 * 3e-7 + roundings(4)}),
        ({a.uniform(-45.0f, 20.0f), a.magnitude(1e-3f, 1e5f), a.uniform(0.01f, 1.0f),
          a.magnitude(1e-12f, 1e30f)}),
        m::canonicalRadiance(x[0], x[1], x[2], x[3]));
}

}  // namespace
}  // namespace welkin::test
