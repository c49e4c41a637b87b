// SPDX-License-Identifier: MIT
// Sweeps of shaders/model/surface but its triangles: chords, shells, slabs, footprints and sources
// of surface clouds.
#include "model_sweep.hpp"

namespace welkin::test {
namespace {

constexpr auto chordNumbers = [](const auto& chord) {
  return std::array{chord.transmittance, chord.inscatter};
};

TEST(ModelSweep, ChordsKeepEnergy) {
  // The series' end and, at its joint, the rounding of 1 - x over x.
  constexpr double LOGARITHM = 2e-7 + roundings(1.0 / 0.03) + roundings(4);
  SWEEP(1, "chordLogarithm", (Claim{0.0, 47.0, LOGARITHM}),
        ({std::fmin(a.magnitude(1e-30f, 1.0f), 0.99f)}), m::chordLogarithm(x[0]));
  SWEEP(1, "chordLogarithm, to 1", (Claim{0.0, 47.0}), ({1.0f - a.magnitude(1e-9f, 1.0f)}),
        m::chordLogarithm(x[0]));
  SWEEP(2, "chordDepth", (Claim{0.0, 1e30}), ({a.uniform(0.0f, 1.0f), a.magnitude(1e-30f, 1e30f)}),
        m::chordDepth(x[0], x[1]));
  SWEEP(2, "chordDepthOf", (Claim{0.0, 1e30}),
        ({a.uniform(0.0f, 1.0f), a.magnitude(1e-30f, 1e30f)}),
        m::chordDepthOf(x[0], m::oneMinusExp(x[1]), x[1]));
  SWEEP(4, "chordStretch", (Claim{0.0, 1.0 + 1e-6}),
        ({a.magnitude(1e-9f, 1e9f), a.magnitude(1e-9f, 1e9f), a.magnitude(1e-9f, 1e9f),
          a.magnitude(1e-9f, 1e9f)}),
        chordNumbers(m::chordStretch(
            m::chordStretch(m::emptyChord(), x[0], std::fmax(x[0] - x[2], real(0)) + x[1], x[2]),
            x[1], std::fmax(x[1] - x[3], real(0)) + x[0], x[3])));
}

TEST(ModelSweep, ShellsRunFromFaceToCore) {
  // Twice a number of up to 4 with a rounding each.
  SWEEP(1, "shellDepth", (Claim{-1.5, 1.5, roundings(2.0 * 4.0), 1.0}),
        ({a.signedMagnitude(1e-30f, 1e30f)}), m::shellDepth(x[0]));
  // Two roundings of numbers up to 1, beyond which it is clamped, over the softness.
  SWEEP(3, "shellDensity", (Claim{0.0, 1.0, roundings(2.0 / 0.01), 1.0}),
        ({a.signedMagnitude(1e-9f, 1e9f), a.uniform(0.0f, 1.0f), a.uniform(0.01f, 1.0f)}),
        m::shellDensity(x[0], x[1], x[2]));
}

// Thickness, depth, normal, directions to light and eye.
std::array<float, 11> anySlab(Arguments& a) {
  return joined(std::array{a.magnitude(1e-30f, 1e30f), a.magnitude(1e-30f, 1e30f)}, a.direction(),
                a.direction(), a.direction());
}
template <typename Vec3, typename Real, size_t N, typename Make>
auto slabOf(const std::array<Real, N>& x, const Make& make) {
  return make(x[0], x[1], vectorOf<Vec3>(x, 2), vectorOf<Vec3>(x, 5), vectorOf<Vec3>(x, 8));
}
#define SLAB slabOf<m::vec3>(x, [](auto... arguments) { return m::tangentSlab(arguments...); })

// Folds what has to hold of the parts into one number: 1 where all of it does.
constexpr auto slabHolds = [](const auto& slab) {
  using Real = decltype(slab.phi);
  const bool holds = slab.thickness >= 0 && slab.depth >= 0 && slab.depth <= slab.thickness &&
                     slab.muLight >= Real(0.0099) && slab.muLight <= 1 && slab.muView >= -1 &&
                     slab.muView <= 1 && slab.phi >= 0 && slab.phi <= Real(3.14159275);
  return Real(holds ? 1 : -1);
};

TEST(ModelSweep, SlabsOfAnyTwoDirectionsAreInRange) {
  SWEEP(11, "tangentSlab", (Claim{1.0, 1.0}), (anySlab(a)), slabHolds(SLAB));
  // That of the arc tangent; 0 for what has no direction.
  SWEEP(2, "slabAngle", (Claim{0.0, 3.1415928, roundings(4), 1.0}),
        ({a.signedMagnitude(1e-30f, 1e3f), a.magnitude(1e-30f, 1e3f)}), m::slabAngle(x[0], x[1]));
}

TEST(ModelSweep, CollectorsStepNoFurtherThanAWidth) {
  SWEEP(3, "collectorStep", (Claim{-LARGEST, LARGEST}),
        ({a.signedMagnitude(1e-30f, 1e9f), a.signedMagnitude(1e-30f, 1e9f),
          a.magnitude(1e-30f, 1e9f)}),
        m::collectorStep(m::vec2(x[0], x[1]), m::vec2(x[1], x[0]), x[2]).x);
  // A difference, its square, their sum and root, a quotient.
  SWEEP(
      5, "collectorResidual", (Claim{0.0, 1e16, roundings(5)}),
      ({a.signedMagnitude(1e-9f, 1e9f), a.signedMagnitude(1e-9f, 1e9f),
        a.signedMagnitude(1e-9f, 1e9f), a.signedMagnitude(1e-9f, 1e9f), a.magnitude(1e-9f, 1e9f)}),
      m::collectorResidual(m::vec2(x[0], x[1]), m::vec2(x[2], x[3]), x[4]));
  SWEEP(2, "footprintLevel", (Claim{0.0, 300.0}),
        ({a.magnitude(1e-30f, 1e15f), a.magnitude(1e-30f, 1e15f)}), m::footprintLevel(x[0], x[1]));
  // An inverse and a product.
  SWEEP(2, "footprintMean", (Claim{0.0, 1e36, roundings(2.01)}),
        ({a.magnitude(1e-30f, 1e30f), a.magnitude(1e-9f, 1.0f)}), m::footprintMean(x[0], x[1]));
}

TEST(ModelSweep, WidthsOfFootprintsAreFinite) {
  SWEEP(1, "collectorWidth", (Claim{0.4, 14.0, roundings(1)}), ({a.index(8)}),
        m::collectorWidth(int(x[0])));
  SWEEP(2, "diffuseWidth", (Claim{11.0, 1e6, roundings(6)}),
        ({a.magnitude(1e-9f, 1e6f), a.uniform(0.0f, 1.0f)}), m::diffuseWidth(x[0], x[0] * x[1]));
  // That of the width, of a slab whose own numbers are drawn.
  SWEEP(12, "footprintSpread", (Claim{0.0, 1e6}), (joined(anySlab(a), std::array{a.index(8)})),
        m::footprintSpread(int(x[11]), SLAB));
  SWEEP(1, "footprintRung", (Claim{0.0, 4.0, roundings(1)}), ({a.index(7)}),
        real(m::footprintRung(int(x[0]))));
  SWEEP(12, "footprintMapLevel", (Claim{-70.0, 70.0}),
        (joined(anySlab(a), std::array{a.magnitude(1e-30f, 1e30f)})),
        m::footprintMapLevel(SLAB, x[11]));
  SWEEP(12, "footprintSetLevel", (Claim{-2.0, 20.0}), (joined(anySlab(a), std::array{a.index(8)})),
        m::footprintSetLevel(int(x[11]), SLAB));
  // No shorter than 0.3 before it is normalised.
  SWEEP(7, "slabNormal", (Claim{-1.00001, 1.00001, roundings(6.0 / 0.3), 1.0}),
        (joined(a.direction(), a.direction(), std::array{a.magnitude(1e-9f, 1e9f)})),
        m::slabNormal(vectorOf<m::vec3>(x, 0), vectorOf<m::vec3>(x, 3), x[6]));
  // Means of unit vectors; those as long as the limit are left out, where a rounding decides.
  SWEEP(
      7, "directionOr", (Claim{-1.00001, 1.00001, roundings(6), 1.0}),
      (joined(a.direction(), a.direction(),
              std::array{(a.index(2) > 0 ? a.positive(1e-5f, 1.0f) : a.magnitude(1e-30f, 1e-7f))})),
      m::directionOr(vectorOf<m::vec3>(x, 0) * x[6], vectorOf<m::vec3>(x, 3)));
}

TEST(ModelSweep, SharesOfSurfaceLightAreShares) {
  // e^-t again; -ln(1 - a) is known to a rounding of 1 over its least value, 1e-3.
  SWEEP(3, "footprintSurvival", (Claim{0.0, 1.0, roundings(2.0 / 2.7 / 1e-3), 1.0}),
        ({a.index(8), a.signedMagnitude(1e-9f, 1.1f), a.uniform(0.0f, 1.0f)}),
        m::footprintSurvival(int(x[0]), x[1], x[2]));
  // e^-t, t e^-t at most 1/e; t has five factors of coverage and four more.
  SWEEP(3, "hillKept", (Claim{0.0, 1.0, roundings(9.0 / 2.7 + 2.0), 1.0}),
        ({a.index(8), a.uniform(-0.1f, 1.1f), a.signedMagnitude(1e-9f, 1e9f)}),
        m::hillKept(int(x[0]), x[1], x[2]));
  SWEEP(3, "depthInSlab", (Claim{0.0, 1e30}),
        ({a.magnitude(1e-30f, 1e30f), a.uniform(0.0f, 1.0f), a.magnitude(1e-30f, 1e30f)}),
        m::depthInSlab(x[0], x[1], x[2]));
  SWEEP(2, "lightDepthShare", (Claim{0.0, 1.0, roundings(2)}),
        ({a.magnitude(1e-9f, 1e20f), a.magnitude(1e-9f, 1e20f)}), m::lightDepthShare(x[0], x[1]));
}

template <typename Footprint, typename Vec3, typename Real, size_t N>
Footprint footprintOf(const std::array<Real, N>& x) {
  Footprint around;
  around.coverage = x[0];
  around.through = x[1];
  around.lit = vectorOf<Vec3>(x, 2) * x[0];
  around.shaded = vectorOf<Vec3>(x, 5) * x[0];
  around.rise = x[8];
  return around;
}
constexpr auto surfaceHolds = [](const auto& surface) {
  const bool inside = surface.inside >= 0 && surface.inside <= 1;
  return inside ? slabHolds(surface.slab) : decltype(surface.inside)(-1);
};
// Where a node lies in a table of that many, in shares of it.
constexpr auto sourceNumbers = [](const auto& place) {
  using Real = decltype(place.view);
  return std::array<Real, 5>{place.node.x / Real(20), place.node.y / Real(22),
                             place.node.z / Real(4), place.view / Real(4), place.azimuth / Real(3)};
};
constexpr auto shareNumbers = [](const auto& place) {
  using Real = decltype(place.view);
  return std::array<Real, 4>{place.node.x / Real(10), place.node.y / Real(11), place.view / Real(3),
                             place.diffuse};
};

TEST(ModelSweep, SourcesOfSurfacesAreReadInside) {
  // Coverage, depth, both faces, rise; share of depth, cloud here, directions; set.
  SWEEP(18, "surfaceSlab", (Claim{1.0, 1.0}),
        (joined(std::array{a.uniform(0.0f, 1.0f), a.magnitude(1e-30f, 1e30f)}, a.direction(),
                a.direction(), std::array{a.signedMagnitude(1e-6f, 1e6f)},
                std::array{a.uniform(0.0f, 1.0f), a.magnitude(1e-30f, 1e30f)}, a.direction(),
                a.direction(), std::array{a.index(8)})),
        surfaceHolds(m::surfaceSlab(int(x[17]), footprintOf<m::LightFootprint, m::vec3>(x), x[9],
                                    x[10], vectorOf<m::vec3>(x, 11), vectorOf<m::vec3>(x, 14))));
  SWEEP(1, "sourceOrders", (Claim{1.0, 30.0, roundings(1)}), ({a.index(8)}),
        m::sourceOrders(int(x[0])));
  // A difference of floats and a sum over a sum.
  SWEEP(2, "diffuseLeft", (Claim{0.0, 1.0, roundings(5)}),
        ({a.magnitude(1e-9f, 1e6f), a.magnitude(1e-9f, 1e6f)}),
        m::diffuseLeft(std::fmax(x[0], x[1]), std::fmin(x[0], x[1])));
  SWEEP(12, "sourcePlace", (Claim{-1e-5, 1.0 + 1e-5}), (joined(anySlab(a), std::array{a.index(8)})),
        sourceNumbers(m::sourcePlace(int(x[11]), SLAB)));
  SWEEP(12, "sourcePlace, outside", (Claim{-600.0, 1.0}),
        (joined(anySlab(a), std::array{a.index(8)})), m::sourcePlace(int(x[11]), SLAB).outside);
  // The exponent's sum, at most 70, rounds once.
  SWEEP(4, "sourceRadiance", (Claim{0.0, 1e31, roundings(70.0 + 6.0)}),
        ({a.uniform(-20.0f, 35.0f), a.uniform(-20.0f, 35.0f), a.uniform(0.01f, 1.0f),
          a.uniform(0.0f, 1.0f)}),
        m::sourceRadiance(x[0], x[1], x[2], x[3]));
  SWEEP(3, "sharePlace", (Claim{-1e-5, 1.0 + 1e-5}),
        ({a.magnitude(1e-30f, 1e30f), a.magnitude(1e-30f, 1e30f), a.uniform(-1.0f, 1.0f)}),
        shareNumbers(m::sharePlace(x[0], x[1], x[2])));
}

}  // namespace
}  // namespace welkin::test
