// SPDX-License-Identifier: MIT
// Orders of scattering of every kind of particle: normalised, never negative, isotropic in the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "particles/catalogue.hpp"
#include "tables/angular_moments.hpp"
#include "tables/scattering_orders.hpp"

namespace {

using namespace welkin;

class KindOrders : public testing::TestWithParam<int> {
 protected:
  static Particle make() {
    const ParticleKind& kind = particleKind(static_cast<ParticleType>(GetParam()));
    ParticleParams params;
    params.diameter_um = kind.diameter_um.initial;
    params.spread = kind.spread.initial;
    params.roughness = kind.roughness.initial;
    static constexpr double ANGLE[] = {0, 0.3, 1, 3.14159265358979};
    static constexpr double PHASE[] = {90, 90, 90, 30, 30, 30, 1, 1, 1, 0.2, 0.2, 0.2};
    params.userAngle = ANGLE;
    params.userPhase = PHASE;
    return kind.make(params);
  }
};

TEST_P(KindOrders, IntegrateToOneAndAreNeverNegative) {
  const Particle particle = make();
  const std::vector<double>& y = particle.curve.y;
  for (const size_t channel : {size_t{0}, size_t{2}}) {
    const std::vector<double>& p = particle.curve.value[channel];
    std::vector<double> result(y.size());
    double forward = 1;
    for (const int n : {1, 2, 3, 5, 10, 26, 60}) {
      scatteredInteger(y, p, n, y, result);
      EXPECT_GE(*std::min_element(result.begin(), result.end()), 0) << n;
      // Lines between the nodes: the curve's own energy is exact, a convex peak gains some 1e-5.
      EXPECT_NEAR(sphereIntegral(y, result), 1, 1e-4) << n;
      const double now = forwardFractionInteger(y, p, n);
      EXPECT_LE(now, forward + 1e-6) << n;
      EXPECT_GE(now, 0.5 - 1e-6) << n;
      forward = now;
    }
    for (const double tau : {0.0, 0.1, 1.0, 10.0, 100.0}) {
      scatteredPoisson(y, p, tau, y, result);
      EXPECT_GE(*std::min_element(result.begin(), result.end()), 0) << tau;
      EXPECT_NEAR(sphereIntegral(y, result), 1, 1e-4) << tau;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, KindOrders, testing::Range(0, static_cast<int>(PARTICLE_TYPES)),
                         [](const testing::TestParamInfo<int>& kind) {
                           std::string name =
                               particleKind(static_cast<ParticleType>(kind.param)).name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
