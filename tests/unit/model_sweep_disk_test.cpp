// SPDX-License-Identifier: MIT
// Sweeps of sky/disk.glsl: disks of suns and moons.
#include "model_sweep.hpp"

namespace welkin::test {
namespace {

TEST(ModelSweep, DisksAreFiniteUpToTheRim) {
  SWEEP(3, "limbDarkenedDisk", (Claim{0.0, 2.0 + 1e-6}),
        ({a.magnitude(1e-20f, 0.01f), a.uniform(1e-10f, 0.005f), a.uniform(0.0f, 2.0f)}),
        m::limbDarkenedDisk(x[0], x[1], m::vec3(x[2])).x);
  // Float follows double to 2e-6 inside of the rim's steep part (disk.glsl).
  SWEEP(3, "limbDarkenedDisk, inside", (Claim{0.0, 2.0 + 1e-6, 2e-6}),
        ({a.uniform(0.0f, 0.9f), a.uniform(1e-10f, 0.005f), a.uniform(0.0f, 2.0f)}),
        m::limbDarkenedDisk(x[0] * x[1], x[1], m::vec3(x[2])));
  // The quotient's rounding and that of its difference from 1, times the steepest slope.
  constexpr double RIM = 12.5 * 1.5;
  SWEEP(2, "diskCoverage", (Claim{0.0, 1.0, RIM * roundings(2), 1.0}),
        ({a.magnitude(1e-20f, 2.0f), a.uniform(1e-10f, 0.005f)}), m::diskCoverage(x[0], x[1]));
  constexpr double MU_SQUARED = 1e-7 + roundings(2);  // disk.glsl, and its quotient
  SWEEP(2, "diskMuSquared", (Claim{0.0, 1.0 + 1e-6, MU_SQUARED, 1.0}),
        ({a.magnitude(1e-20f, 2.0f), a.uniform(1e-10f, 0.005f)}), m::diskMuSquared(x[0], x[1]));
  SWEEP(6, "phaseIntegral", (Claim{1.4e-5, 1.0 + 1e-6, 8e-6}),
        (joined(a.direction(), a.direction())),
        m::phaseIntegral(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3)));
  // 2 / phase is 1.4e5 at most; a direction of the disk is a step from its centre.
  SWEEP(9, "litDisk", (Claim{0.0, 1.4e5}),
        (joined(a.direction(), a.direction(),
                std::array{a.uniform(0.0f, 1.1f), a.uniform(1e-8f, 0.005f),
                           a.uniform(0.0f, 6.2831853f)})),
        m::litDisk(m::directionFromY(vectorOf<m::vec3>(x, 0), x[6] * x[7], x[8]),
                   vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3),
                   m::phaseIntegral(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3)), x[6] * x[7],
                   x[7]));
}

}  // namespace
}  // namespace welkin::test
