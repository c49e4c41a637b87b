// SPDX-License-Identifier: MIT
// The model of [R04] on slabs: against another quadrature, and against what the paper's equations
// say in their limits.
#include "reference/slab_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/forward_slab.hpp"

namespace {

using namespace welkin::reference;
using Attenuation = SlabModel::Attenuation;

constexpr double G = 0.85;

double separation(double mu0, double mu, double phi) {
  return 1 + mu * mu0 - std::sqrt((1 - mu * mu) * (1 - mu0 * mu0)) * std::cos(phi);
}

TEST(SlabModel, CorrectedIsTheForwardSlabForHenyeyGreenstein) {
  constexpr double NODES = 2e-4;  // ln P linear between the nodes of depth
  const double mu0 = 0.7;
  for (const double albedo : {0.8, 1.0}) {
    const SlabModel model(henyeyGreensteinSlabPhase(G), albedo, 60);
    for (const double tau : {0.3, 4.0, 30.0}) {
      const ForwardSlab slab{G, albedo, tau};
      for (const double mu : {0.9, 0.3, -0.4, -0.95}) {
        const double y = separation(mu0, mu, 1.0);
        const double expected = slab.radiance(std::fabs(mu), mu0, mu < 0, 1 - y, 2000);
        EXPECT_NEAR(model.corrected(tau, mu0, mu, model.prepare(y)) / expected, 1, NODES)
            << albedo << ' ' << tau << ' ' << mu;
      }
    }
  }
}

TEST(SlabModel, IntegerDistributionsOfHenyeyGreensteinHaveThePowerOfG) {
  const SlabModel model(henyeyGreensteinSlabPhase(G), 1, 1);
  const double y = 0.4;
  const SlabModel::Angle angle = model.prepare(y);
  for (int n = 1; n <= SlabModel::ORDERS; ++n) {
    const double power = std::pow(G, n);
    const double expected = henyeyGreensteinSlabPhase(power).value(y);
    EXPECT_NEAR(angle.integer[static_cast<size_t>(n - 1)] / expected, 1, 1e-12) << n;
    // Forward part, from the distribution function.
    const double forward =
        (1 - power * power) / (2 * power) * (1 / (1 - power) - 1 / std::sqrt(1 + power * power));
    EXPECT_NEAR(model.forwardInteger(n), forward, 1e-12) << n;
  }
}

TEST(SlabModel, PrintedThinSlabScattersTwiceAtLeastBelowItsFirstSlice) {
  // ceil(n + 1) is 2 as soon as n > 0: a rim never shows the phase function itself. All slices but
  // the first, 1 of 1000, have the second convolution.
  const SlabModel model(henyeyGreensteinSlabPhase(G), 1, 1);
  const double tau = 1e-4;
  const double mu0 = 0.8;
  const double mu = 0.5;
  const double y = separation(mu0, mu, 2);
  const SlabModel::Angle angle = model.prepare(y);
  const double twice = henyeyGreensteinSlabPhase(G * G).value(y);
  const double value = model.printed(tau, mu0, mu, angle, Attenuation::EQ_25, 1000);
  EXPECT_NEAR(value * mu / tau / twice, 1, 1.5e-3);
  EXPECT_NEAR(model.corrected(tau, mu0, mu, angle) * mu / tau / angle.integer[0], 1, 1e-3);
}

TEST(SlabModel, IntensityOfEq25DependsOnTheSlicesAndThatOfEq24DoesNot) {
  const SlabModel model(henyeyGreensteinSlabPhase(G), 1, 1);
  const auto at30 = [&](double step, Attenuation attenuation) {
    return model.lightBuffer(30, step, attenuation)[static_cast<size_t>(std::lround(30 / step))];
  };
  EXPECT_LT(at30(1, Attenuation::EQ_25), 0.001);
  EXPECT_GT(at30(0.004, Attenuation::EQ_25), 0.9);
  EXPECT_NEAR(at30(0.01, Attenuation::EQ_24) / at30(0.005, Attenuation::EQ_24), 1, 0.1);
}

}  // namespace
