// SPDX-License-Identifier: MIT
// Sweeps of shaders/model/phase: phase functions, their parameters, samples and tables.
#include "model_sweep.hpp"

namespace welkin::test {
namespace {

// Parameters of the blend with alpha in units of its largest value, 250.
constexpr auto parameters = [](const auto& p) {
  return std::array{p.gHg, p.gapHg, p.gD, p.gapD, p.alpha / 250, p.weightD};
};
constexpr auto yAndSide = [](const auto& axis) { return std::array{axis.y, axis.side}; };

TEST(ModelSweep, PhaseFunctionsAreFiniteAndPositive) {
  // [J23] blend: 2e-6 from 5 um on, 5e-6 below (fog.glsl).
  SWEEP(2, "fogPhase, 5 to 50 um", (Claim{0.0, 1e5, 2e-6}),
        ({a.uniform(5.0f, 50.0f), a.magnitude(1e-12f, 2.0f)}),
        m::fogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "fogPhase, 0 to 5 um", (Claim{0.0, 1e5, 5e-6}),
        ({a.uniform(0.0f, 5.0f), a.magnitude(1e-12f, 2.0f)}),
        m::fogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "fogPhase, any size", (Claim{0.0, 1e5}),
        ({a.signedMagnitude(1e-38f, 3e38f), a.magnitude(1e-12f, 2.0f)}),
        m::fogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "henyeyGreenstein", (Claim{0.0, 1e14, 2e-6}),
        ({a.uniform(-0.999f, 0.9999f), a.magnitude(1e-12f, 2.0f)}),
        m::henyeyGreenstein(x[0], real(1) - x[0], x[1]));
  SWEEP(3, "drainePhase", (Claim{0.0, 1e14, 2e-6}),
        ({a.uniform(-0.999f, 0.9999f), a.magnitude(1e-3f, 1000.0f), a.magnitude(1e-12f, 2.0f)}),
        m::drainePhase(x[0], real(1) - x[0], x[1], x[2]));
  SWEEP(1, "rayleighPhase", (Claim{0.05, 0.12, 1e-6}), ({a.magnitude(1e-12f, 2.0f)}),
        m::rayleighPhase(x[0]));
  // Differences are right to a rounding, their squares to three, the sum and the half to one each.
  SWEEP(6, "oneMinusCosine", (Claim{0.0, 2.0 + 1e-6, roundings(5)}),
        (joined(a.direction(), a.direction())),
        m::oneMinusCosine(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3)));
}

TEST(ModelSweep, PhaseParametersAreThoseOfAMixture) {
  // Waves below 1/2 of arguments up to 6, of which each loses two roundings. A blend divides the
  // logarithm's by that of its band, 1.5 / 1.2 at least.
  constexpr double FIT = roundings(0.5 * 6.0 * 2.0);
  constexpr double BLEND = FIT / 0.22;
  SWEEP(1, "fogFitTiny", (Claim{-0.1, 1.1, FIT, 1.0}), ({a.uniform(0.0f, 0.13f)}),
        parameters(m::fogFitTiny(x[0])));
  SWEEP(1, "fogFitSmall", (Claim{-0.04, 1.04, FIT, 1.0}), ({a.uniform(0.1f, 1.5f)}),
        parameters(m::fogFitSmall(m::log(x[0]))));
  SWEEP(1, "fogFitMiddle", (Claim{0.0, 1.0, FIT, 1.0}), ({a.uniform(1.2f, 5.0f)}),
        parameters(m::fogFitMiddle(m::log(x[0]))));
  SWEEP(1, "fogFitLarge", (Claim{0.0, 1.0, FIT, 1.0}), ({a.uniform(4.0f, 50.0f)}),
        parameters(m::fogFitLarge(x[0])));
  SWEEP(1, "fogBlend", (Claim{0.0, 1.0, BLEND, 1.0}), ({a.uniform(1.2f, 1.5f)}),
        parameters(m::fogBlend(m::fogFitSmall(m::log(x[0])), m::fogFitMiddle(m::log(x[0])),
                               m::log(x[0]), m::FOG_SMALL_END, m::FOG_MIDDLE_BEGIN)));
  SWEEP(1, "fogPhaseFromDiameter", (Claim{-0.04, 1.04, BLEND, 1.0}), ({a.uniform(0.0f, 60.0f)}),
        parameters(m::fogPhaseFromDiameter(x[0])));
}

TEST(ModelSweep, PhaseSamplesAreAngles) {
  constexpr float BELOW_ONE = 0x1.fffffep-1f;
  // Each factor is a sum of positive terms; (1 + g) - g xi has the most roundings of them, three.
  constexpr double FACTORS = roundings(3.0 * 4.0 + 4.0);
  SWEEP(2, "sampleDenominator", (Claim{1e-5, 2.0, FACTORS}),
        ({a.uniform(-0.9999f, 0.9999f), a.uniform(0.0f, 1.0f)}),
        m::sampleDenominator(x[0], real(1) - x[0], x[1]));
  SWEEP(2, "sampleHenyeyGreenstein", (Claim{0.0, 2.0, FACTORS}),
        ({a.uniform(-0.9999f, 0.9999f), a.uniform(0.0f, 1.0f)}),
        m::sampleHenyeyGreenstein(x[0], real(1) - x[0], x[1]));
  SWEEP(3, "sampleDraine", (Claim{0.0, 2.0}),
        ({a.uniform(-0.5f, 0.9999f), a.magnitude(1e-3f, 1000.0f), a.uniform(0.0f, 1.0f)}),
        m::sampleDraine(x[0], real(1) - x[0], x[1], x[2]));
  SWEEP(2, "sampleFogPhase", (Claim{0.0, 2.0}),
        ({a.uniform(0.0f, 50.0f), std::fmin(a.uniform(0.0f, 1.0f), BELOW_ONE)}),
        m::sampleFogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "sampleFogPhaseAxis", (Claim{-1.0, 2.0, FACTORS, 0.0}),
        ({a.uniform(-0.9999f, 0.9999f), std::fmin(a.uniform(0.0f, 1.0f), BELOW_ONE)}),
        yAndSide(m::sampleFogPhaseAxis(m::henyeyGreensteinOnly(x[0]), x[1])));
  // Sums of three products of numbers up to 1.
  SWEEP(5, "directionFromY", (Claim{-1.00001, 1.00001, roundings(3.0 * 5.0), 1.0}),
        (joined(a.direction(), std::array{a.magnitude(1e-12f, 2.0f), a.uniform(0.0f, 6.2831853f)})),
        m::directionFromY(vectorOf<m::vec3>(x, 0), x[3], x[4]));
}

TEST(ModelSweep, PhaseTablesStayWithinTheirCells) {
  constexpr double NODE = 2e-6;  // curve.glsl
  SWEEP(1, "curveEnd", (Claim{0.0, 1.0 + 1e-6, NODE}), ({a.magnitude(1e-9f, 0.5f)}),
        m::curveEnd(x[0]));
  SWEEP(1, "curveNode", (Claim{0.0, 2.0, NODE, 1.0}), ({a.uniform(0.0f, 1.0f)}),
        m::curveNode(x[0]));
  // No difference but that of y, which is right to a rounding.
  SWEEP(4, "curveCellEnergy", (Claim{0.0, 1e8, roundings(5)}),
        ({a.magnitude(1e-12f, 2.0f), a.magnitude(1e-12f, 2.0f), a.magnitude(1e-9f, 1e6f),
          a.magnitude(1e-9f, 1e6f)}),
        m::curveCellEnergy(x[0], x[1], x[2], x[3]));
  // Of the larger end: 1 - t has no relative precision.
  SWEEP(5, "curveCellValue", (Claim{0.0, 1.0 + 1e-6, roundings(7), 1.0}),
        ({a.magnitude(1e-12f, 2.0f), a.magnitude(1e-12f, 2.0f), a.magnitude(1e-9f, 1e6f),
          a.magnitude(1e-9f, 1e6f), a.magnitude(1e-12f, 2.0f)}),
        m::curveCellValue(x[0], x[1], x[2], x[3], x[4]) / std::fmax(x[2] + x[3], real(1e-30)));
  // Sums of positive terms, the last of y0 and the rest of a rising cell.
  SWEEP(5, "curveCellInvert", (Claim{0.0, 2.0 + 1e-6, roundings(10)}),
        ({a.uniform(0.0f, 1.0f), a.uniform(1.0f, 2.0f), a.magnitude(1e-9f, 1e6f),
          a.magnitude(1e-9f, 1e6f), a.uniform(0.0f, 1.0f)}),
        m::curveCellInvert(x[0], x[1], x[2], x[3], x[4]));
}

}  // namespace
}  // namespace welkin::test
