// SPDX-License-Identifier: MIT
// Sweeps of sky/segment.glsl: exponential layers, flat and around a sphere, and stretches of rays
// through them.
#include "model_sweep.hpp"

namespace welkin::test {
namespace {

constexpr auto densityAndColumn = [](const auto& point) {
  return std::array{point.density, point.column};
};
constexpr auto columnAndLean = [](const auto& span) {
  return std::array{span.column, span.lean + decltype(span.lean)(0.5)};
};
constexpr auto nearAndFar = [](const auto& bend) { return std::array{bend.near, bend.far}; };
constexpr auto depthAndLight = [](const auto& segment) {
  return std::array{segment.opticalDepth, segment.inscatter};
};

// Ends of a segment at two depths.
template <typename End, typename Vec3, typename Real>
End endAt(Real depth, Vec3 transmittance) {
  End end;
  end.depth = Vec3(depth);
  end.transmittance = transmittance;
  return end;
}

TEST(ModelSweep, SegmentsAndColumnsAreFiniteAndNeverNegative) {
  // 5e-5 (segment.glsl) down to the cut at e^-46, around which float and double may part.
  constexpr double SEGMENT = 5e-5;
  constexpr double CUT = 1e-20 / SEGMENT;
  SWEEP(3, "segmentInscatter", (Claim{0.0, 1.0 + 1e-6, SEGMENT, CUT}),
        ({a.magnitude(1e-30f, 1e38f), a.magnitude(1e-30f, 1e38f), a.magnitude(1e-30f, 1e38f)}),
        // The far end lies no nearer to the light than the stretch between is thick.
        m::segmentInscatter(x[0], std::fmax(x[0] - x[2], real(0)) + x[1], x[2]));
  // phi1's; sizes below 1e-22 come of subnormal numbers times e^40.
  SWEEP(3, "exponentialDepth", (Claim{0.0, 1.01e30, 3e-7 + roundings(4), 1e-22}),
        ({a.magnitude(1e-30f, 10.0f), a.signedMagnitude(1e-30f, 1e30f), a.magnitude(1e-6f, 1e30f)}),
        m::exponentialDepth(x[0], x[1], std::fmin(x[2], real(1e20))));
  SWEEP(5, "flatExponentialSegment", (Claim{0.0, 1.01e30, SEGMENT, CUT}),
        ({a.magnitude(1e-12f, 10.0f), a.uniform(1e-5f, 1.0f), a.cosine(), a.cosine(),
          a.magnitude(1e-6f, 1e30f)}),
        depthAndLight(m::flatExponentialSegment(x[0], x[1], x[2], x[3], x[4])));
  SWEEP(3, "bentDepth", (Claim{-2.0, 2.0}),
        ({a.signedMagnitude(1e-9f, 1e9f), a.signedMagnitude(1e-9f, 1e9f),
          a.signedMagnitude(1e-9f, 1e30f)}),
        m::bentDepth(x[0], x[1], x[2]));
  SWEEP(3, "bentDepth3", (Claim{-2.0, 2.0}),
        ({a.signedMagnitude(1e-9f, 1e9f), a.signedMagnitude(1e-9f, 1e9f),
          a.signedMagnitude(1e-9f, 1e30f)}),
        m::bentDepth3(m::vec3(x[0], x[1], real(0)), m::vec3(x[1], real(0), x[0]), m::vec3(x[2])));
}

TEST(ModelSweep, LayersHoldFromVacuumToSolid) {
  // Exponents reach 60, whose roundings, two of altitude over scale height, the density magnifies.
  constexpr double EXPONENT = 60.0 * 2.0;
  SWEEP(3, "layerExponent", (Claim{-1e9, 2e6, roundings(3)}),
        ({a.signedMagnitude(1e-3f, 1e9f), a.uniform(-1e4f, 1e5f), a.uniform(100.0f, 1e5f)}),
        m::layerExponent(std::fmax(x[0], real(-1e5f)), x[1], x[2]));
  SWEEP(1, "layerDensity", (Claim{8e-27, 1.1e13, roundings(3)}), ({a.signedMagnitude(1e-9f, 1e9f)}),
        m::layerDensity(x[0]));
  // That of erfcx, and a factor close to 1.
  SWEEP(3, "layerErfcx", (Claim{0.0, 2.0, 4.1e-7 + roundings(6)}),
        ({a.magnitude(1e-9f, 1e6f), a.uniform(1e4f, 1e9f), a.uniform(1.0f, 1e5f)}),
        m::layerErfcx(x[0], x[1], x[2]));
  // Down to the lowest point and back: the exponent grows from vacuum to solid, with 5 roundings
  // of its own, 1 of the sum, and half the sine's 2. The way up is then next to nothing of it.
  constexpr double DROP = (60.0 + 30.0) * (5.0 + 1.0 + 1.0);
  SWEEP(4, "layerColumn", (Claim{0.0, 1e25, roundings(DROP) + 4.1e-7}),
        ({a.uniform(-60.0f, 30.0f), a.uniform(1.0f, 1e5f), a.uniform(1e4f, 1e9f), a.cosine()}),
        m::layerColumn(x[0], m::layerDensity(x[0]), x[1], x[2], x[3]));
  SWEEP(5, "layerPoint", (Claim{0.0, 1e22, roundings(EXPONENT) + 4.1e-7 + roundings(12)}),
        ({a.signedMagnitude(1e-3f, 1e6f), a.uniform(-1e4f, 1e5f), a.positive(1.0f, 1e5f),
          a.uniform(1e4f, 1e9f), a.signedMagnitude(1e-3f, 1e9f)}),
        densityAndColumn(m::layerPoint(x[0], x[1], x[2], x[3], x[4])));
  // Both points on the same side of the lowest one, as its text asks; columns as they come.
  SWEEP(6, "layerSpan", (Claim{0.0, 1e25}),
        ({a.signedMagnitude(1e-3f, 1e6f), a.signedMagnitude(1e-3f, 1e6f), a.positive(1.0f, 1e5f),
          a.uniform(1e4f, 1e9f), a.magnitude(1e-3f, 1e9f), a.magnitude(1e-3f, 1e9f)}),
        columnAndLean(m::layerSpan(m::layerPoint(x[0], real(0), x[2], x[3], x[4]),
                                   m::layerPoint(x[1], real(0), x[2], x[3], x[4] + x[5]), x[2],
                                   x[5], x[5] * (x[5] / (real(8) * x[3])))));
}

TEST(ModelSweep, MeansOverASegmentLieBetweenItsEnds) {
  // The series' own and, beyond 1/2, the rounding of e^-t magnified by 1 / (1 - e^-1/2).
  constexpr double MEAN = 3e-7 + roundings(2.0 * 2.6);
  SWEEP(1, "meanTransmittance", (Claim{0.0, 1e33, MEAN}), ({a.signedMagnitude(1e-30f, 79.0f)}),
        m::meanTransmittance(real(1), m::exp(-x[0]), x[0]));
  SWEEP(3, "meanTransmittance3", (Claim{0.0, 1e33, MEAN}),
        ({a.signedMagnitude(1e-30f, 79.0f), a.uniform(-1.0f, 1.0f), a.uniform(-40.0f, 40.0f)}),
        m::meanTransmittance3(m::vec3(real(1)), m::exp(m::vec3(-x[0], -x[1], -x[2])),
                              m::vec3(x[0], x[1], x[2])));
  // Of 1, the most. What is displaced is a difference of depths up to 1e3, whose two roundings
  // count where little is left. The other layer changes the depth by no more than both ends have.
  SWEEP(4, "displacedMean", (Claim{0.0, 1.0 + 1e-6, MEAN + roundings(2.0 * 1e3), 1.0}),
        ({a.magnitude(1e-9f, 1e3f), a.magnitude(1e-9f, 1e3f), a.uniform(0.0f, 1.0f),
          a.uniform(-2.0f, 2.0f)}),
        m::displacedMean(endAt<m::SegmentEnd>(x[0], m::safeExp3(m::vec3(-x[0]))),
                         endAt<m::SegmentEnd>(x[1], m::safeExp3(m::vec3(-x[1]))),
                         m::vec3(x[2] * x[1] - (real(1) - x[2]) * x[0]), x[3]));
  // displacedMean clamps it; towards the dense end of an opaque layer it may pass 1 far.
  SWEEP(5, "displacement", (Claim{-1e7, 1e7}),
        ({a.uniform(-2e4f, 4e5f), a.uniform(-2e4f, 4e5f), a.positive(100.0f, 1e5f),
          a.signedMagnitude(1e-9f, 1e9f), a.uniform(-0.5f, 0.5f)}),
        m::displacement(m::layerPoint(x[0], real(0), x[2], real(6.4e6f), real(0)),
                        m::layerPoint(x[1], real(0), x[2], real(6.4e6f), real(0)), x[3], x[4]));
  // Five products and sums, of positive terms.
  SWEEP(1, "bentTransmittance", (Claim{0.2 - 1e-6, 5.0 + 1e-6, roundings(6)}),
        ({a.signedMagnitude(1e-30f, 2.0f)}), m::bentTransmittance(x[0]));
  SWEEP(2, "bentTransmittance3", (Claim{0.2 - 1e-6, 5.0 + 1e-6, roundings(6)}),
        ({a.signedMagnitude(1e-30f, 2.0f), a.uniform(-2.0f, 2.0f)}),
        m::bentTransmittance3(m::vec3(x[0], x[1], real(0))));
  // Half a difference and twice another of numbers up to 1, whose roundings g halves.
  SWEEP(4, "meanVisibility", (Claim{0.0, 1.0, roundings(6), 1.0}),
        ({a.uniform(0.0f, 1.0f), a.uniform(0.0f, 1.0f), a.uniform(0.0f, 1.0f),
          a.signedMagnitude(1e-9f, 1e30f)}),
        m::meanVisibility(x[0], x[1], x[2], m::vec3(x[3])));
}

TEST(ModelSweep, SlopesOfDepthAreFinite) {
  SWEEP(3, "slopeOf", (Claim{-1e12, 1e12, roundings(2.1)}),
        ({a.signedMagnitude(1e-20f, 1e12f), a.magnitude(1e-27f, 1e13f), a.positive(1e9f, 1e12f)}),
        m::slopeOf(x[0], x[1], x[2]));
  SWEEP(6, "layerBend", (Claim{-LARGEST, LARGEST}),
        ({a.positive(8.8e-27f, 1.1e13f), a.positive(8.8e-27f, 1.1e13f),
          a.signedMagnitude(1e-30f, 1e13f), a.signedMagnitude(1e-30f, 1e13f),
          a.magnitude(1e-6f, 1e22f), a.signedMagnitude(1e-6f, 1e22f)}),
        [&] {
          m::LayerPoint here;
          m::LayerPoint next;
          here.exponent = next.exponent = here.column = next.column = real(0);
          here.density = x[0];
          next.density = x[1];
          return nearAndFar(m::layerBend(here, next, x[2], x[3], x[4], x[5]));
        }());
  // The difference of rates is right to a rounding; the logarithm of at most 70 adds to 36.
  SWEEP(3, "bulge", (Claim{-1e35, 1e35, roundings(8)}),
        ({a.signedMagnitude(1e-18f, 1e12f), a.signedMagnitude(1e-18f, 1e12f),
          a.magnitude(1e-6f, 1e22f)}),
        m::bulge(x[0], x[1], x[2]));
}

}  // namespace
}  // namespace welkin::test
