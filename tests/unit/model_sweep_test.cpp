// SPDX-License-Identifier: MIT
// A million arguments for each function of the model text, over all of its documented domain with
// the edges of float among them: no invalid operation, division by zero or overflow, results in
// range, and float as close to double as the text promises.
#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "model/model.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;

#ifndef WELKIN_SWEEP_POINTS  // a hundred times as many: -DWELKIN_SWEEP_POINTS=100000000
#define WELKIN_SWEEP_POINTS 1000000
#endif
constexpr int POINTS = WELKIN_SWEEP_POINTS;
constexpr int TRAPPED = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
// An ordered comparison with NaN is an invalid operation, and what finiteValue is for.
constexpr int TRAPPED_BUT_NAN = FE_DIVBYZERO | FE_OVERFLOW;

class Arguments {
 public:
  // In [low, high), one in 16 an end.
  float uniform(float low, float high) {
    const uint64_t bits = random_();
    const float t = static_cast<float>(bits >> 40) * 0x1p-24f;
    return edge(bits) ? ((bits & 16) != 0 ? low : high) : low + (high - low) * t;
  }
  // Even steps of the logarithm between two magnitudes; one in 16 is 0.
  float magnitude(float low, float high) {
    const uint64_t bits = random_();
    const double t = static_cast<double>(bits >> 11) * 0x1p-53;
    const double x = low * std::exp(t * std::log(double{high} / double{low}));
    return edge(bits) ? 0.0f : std::fmin(static_cast<float>(x), high);
  }
  float signedMagnitude(float low, float high) {
    return (random_() & 1) != 0 ? magnitude(low, high) : -magnitude(low, high);
  }
  float anyBits() {
    const auto bits = static_cast<uint32_t>(random_());
    float x = 0;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }
  // The cosine of an angle, dense around the horizon and the poles.
  float cosine() {
    const float x = signedMagnitude(1e-8f, 1.0f);
    return (random_() & 1) != 0 ? x : std::copysign(1.0f - std::fabs(x), x);
  }
  std::array<float, 3> direction() {
    const double y = double{cosine()};
    const double azimuth = double{uniform(0.0f, 6.2831853f)};
    const double r = std::sqrt(std::fmax(1.0 - y * y, 0.0));
    return {static_cast<float>(r * std::cos(azimuth)), static_cast<float>(y),
            static_cast<float>(r * std::sin(azimuth))};
  }

 private:
  static bool edge(uint64_t bits) { return (bits & 15) == 0; }
  std::mt19937_64 random_{20251};
};

struct Range {
  double low;
  double high;
};

// `draw` gives N floats, `single` and `full` compute from them in float and double. A result may be
// off by `bound` times the truth's size or `floor`; bound 0 compares ranges only, where the
// arguments' own rounding decides (a ray that just meets the planet or not).
template <size_t N, typename Draw, typename Single, typename Full>
void sweep(const char* name, Range range, double bound, double floor, const Draw& draw,
           const Single& single, const Full& full, int trapped = TRAPPED) {
  Arguments arguments;
  double worst = 0.0;
  std::array<float, N> worstAt{};
  int bad = 0;
  for (int n = 0; n < POINTS && bad < 3; ++n) {
    const std::array<float, N> at = draw(arguments);
    std::feclearexcept(FE_ALL_EXCEPT);
    // Read anew, so that no compiler computes before the flags are cleared.
    std::array<float, N> used{};
    for (size_t i = 0; i < N; ++i) {
      used[i] = *const_cast<const volatile float*>(&at[i]);
    }
    const volatile float value = single(used);
    const volatile double truth = full(used);
    const int raised = std::fetestexcept(trapped);
    const double v = double{value};
    const double t = truth;
    const double error = std::fabs(v - t) / std::fmax(std::fabs(t), floor);
    const bool fits = v >= range.low && v <= range.high && t >= range.low && t <= range.high;
    if (error > worst) {
      worst = error;
      worstAt = at;
    }
    if (raised != 0 || !fits) {
      ++bad;
      std::string list;
      for (const float x : at) {
        char text[32];
        std::snprintf(text, sizeof text, " %.9g", double{x});
        list += text;
      }
      ADD_FAILURE() << name << " of" << list << ": float " << v << ", double " << t
                    << (fits ? "" : ", out of range")
                    << ((raised & FE_INVALID) != 0 ? ", invalid" : "")
                    << ((raised & FE_DIVBYZERO) != 0 ? ", division by zero" : "")
                    << ((raised & FE_OVERFLOW) != 0 ? ", overflow" : "");
    }
  }
  if (bound > 0.0) {
    EXPECT_LE(worst, bound) << name << " at " << double{worstAt[0]} << " "
                            << double{worstAt[N > 1 ? 1 : 0]} << " "
                            << double{worstAt[N > 2 ? 2 : 0]};
    std::printf("%-24s %d points, worst error %.2g of %.2g\n", name, POINTS, worst, bound);
  } else {
    std::printf("%-24s %d points in range\n", name, POINTS);
  }
}

#define SWEEP(N, name, range, bound, floor, drawn, call)                                  \
  sweep<N>(                                                                               \
      name, range, bound, floor, [](Arguments& a) { return std::array<float, N> drawn; }, \
      [](const std::array<float, N>& x) {                                                 \
        namespace m = f32;                                                                \
        using real = float;                                                               \
        (void)sizeof(real);                                                               \
        return call;                                                                      \
      },                                                                                  \
      [](const std::array<float, N>& floats) {                                            \
        namespace m = f64;                                                                \
        using real = double;                                                              \
        std::array<double, N> x{};                                                        \
        std::copy(floats.begin(), floats.end(), x.begin());                               \
        (void)sizeof(real);                                                               \
        return call;                                                                      \
      })

constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double LARGEST = 3.4028234663852886e38;

TEST(ModelSweep, NumericFunctionsHoldForEveryArgument) {
  // Their own bounds, and what |x| times the argument's rounding adds below zero: at most 80.
  SWEEP(1, "oneMinusExp", (Range{-1e35, 1.0}), 3e-7, 0.0, ({a.signedMagnitude(1e-38f, 79.0f)}),
        m::oneMinusExp(x[0]));
  SWEEP(1, "phi1", (Range{0.0, 1e35}), 3e-7, 0.0, ({a.signedMagnitude(1e-38f, 79.0f)}),
        m::phi1(x[0]));
  SWEEP(1, "phi1, far", (Range{0.0, 1.0}), 3e-7, 0.0, ({a.magnitude(1.0f, 3e38f)}), m::phi1(x[0]));
  SWEEP(1, "safeExp", (Range{0.0, 6e34}), 3e-7, 0.0, ({a.signedMagnitude(1e-38f, 3e38f)}),
        m::safeExp(x[0]));
  SWEEP(1, "erfcxPositive", (Range{0.0, 1.000001}), 4.1e-7, 0.0, ({a.magnitude(1e-38f, 1e30f)}),
        m::erfcxPositive(x[0]));
  sweep<1>(
      "finiteValue", Range{0.0, 65504.0}, 0.0, 1.0,
      [](Arguments& a) { return std::array<float, 1>{a.anyBits()}; },
      [](const std::array<float, 1>& x) { return f32::finiteValue(x[0], 65504.0f); },
      [](const std::array<float, 1>& x) { return f64::finiteValue(double{x[0]}, 65504.0); },
      TRAPPED_BUT_NAN);
}

TEST(ModelSweep, PhaseFunctionsAreFiniteAndPositive) {
  // [J23] blend: 2e-6 from 5 um on, 5e-6 below (fog.glsl).
  SWEEP(2, "fogPhase, 5 to 50 um", (Range{0.0, 1e5}), 2e-6, 0.0,
        ({a.uniform(5.0f, 50.0f), a.magnitude(1e-12f, 2.0f)}),
        m::fogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "fogPhase, 0 to 5 um", (Range{0.0, 1e5}), 5e-6, 0.0,
        ({a.uniform(0.0f, 5.0f), a.magnitude(1e-12f, 2.0f)}),
        m::fogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "fogPhase, any size", (Range{0.0, 1e5}), 0.0, 1.0,
        ({a.signedMagnitude(1e-38f, 3e38f), a.magnitude(1e-12f, 2.0f)}),
        m::fogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
  SWEEP(2, "henyeyGreenstein", (Range{0.0, 1e14}), 2e-6, 0.0,
        ({a.uniform(-0.999f, 0.9999f), a.magnitude(1e-12f, 2.0f)}),
        m::henyeyGreenstein(x[0], real(1) - x[0], x[1]));
  SWEEP(1, "rayleighPhase", (Range{0.05, 0.12}), 1e-6, 0.0, ({a.magnitude(1e-12f, 2.0f)}),
        m::rayleighPhase(x[0]));
  SWEEP(2, "sampleFogPhase", (Range{0.0, 2.0}), 0.0, 1.0,
        ({a.uniform(0.0f, 50.0f), std::fmin(a.uniform(0.0f, 1.0f), 0x1.fffffep-1f)}),
        m::sampleFogPhase(m::fogPhaseFromDiameter(x[0]), x[1]));
}

TEST(ModelSweep, GeometryHoldsFromTheGroundToTheStars) {
  SWEEP(4, "altitudeAlongRay", (Range{-LARGEST, LARGEST}), 0.0, 1.0,
        ({a.signedMagnitude(1e-6f, 1e9f), a.cosine(), a.uniform(1e4f, 1e9f),
          a.magnitude(1e-6f, 1e15f)}),
        m::altitudeAlongRay(std::fmax(x[0], -x[2]), x[1], x[2], x[3]));
  SWEEP(2, "horizonMu", (Range{-1.000001, 0.0}), 1e-6, 1e-12,
        ({a.magnitude(1e-6f, 1e9f), a.uniform(1e4f, 1e9f)}), m::horizonMu(x[0], x[1]));
  SWEEP(3, "groundDistance", (Range{-1.0, 1e12}), 0.0, 1.0,
        ({a.signedMagnitude(1e-6f, 1e9f), a.cosine(), a.uniform(1e4f, 1e9f)}),
        m::groundDistance(x[0], x[1], x[2]));
}

TEST(ModelSweep, SegmentsAndColumnsAreFiniteAndNeverNegative) {
  // 5e-5 down to the cut at e^-46, around which float and double may part.
  SWEEP(3, "segmentInscatter", (Range{0.0, 1.0 + 1e-6}), 0.0, 1.0,
        ({a.magnitude(1e-30f, 1e38f), a.magnitude(1e-30f, 1e38f), a.magnitude(1e-30f, 1e38f)}),
        // The far end lies no nearer to the light than the stretch between is thick.
        m::segmentInscatter(x[0], std::fmax(x[0] - x[2], real(0)) + x[1], x[2]));
  SWEEP(3, "exponentialDepth", (Range{0.0, 1.01e30}), 0.0, 1.0,
        ({a.magnitude(1e-30f, 10.0f), a.signedMagnitude(1e-30f, 1e30f), a.magnitude(1e-6f, 1e30f)}),
        m::exponentialDepth(x[0], x[1], std::fmin(x[2], real(1e20))));
  SWEEP(5, "flatExponentialSegment", (Range{0.0, 1.01e30}), 0.0, 1.0,
        ({a.magnitude(1e-12f, 10.0f), a.uniform(1e-5f, 1.0f), a.cosine(), a.cosine(),
          a.magnitude(1e-6f, 1e30f)}),
        m::flatExponentialSegment(x[0], x[1], x[2], x[3], x[4]).inscatter);
  SWEEP(4, "layerColumn", (Range{0.0, 1e25}), 0.0, 1.0,
        ({a.uniform(-60.0f, 30.0f), a.uniform(1.0f, 1e5f), a.uniform(1e4f, 1e9f), a.cosine()}),
        m::layerColumn(x[0], m::layerDensity(x[0]), x[1], x[2], x[3]));
  SWEEP(5, "absorberColumnTo", (Range{0.0, 1e9}), 0.0, 1.0,
        ({a.uniform(-1000.0f, 2e5f), a.cosine(), a.uniform(1e4f, 1e9f), a.uniform(0.0f, 1e5f),
          a.uniform(100.0f, 1e5f)}),
        m::absorberColumnTo(x[0], x[1], x[2], x[3], x[4]));
  SWEEP(3, "bentDepth", (Range{-2.0, 2.0}), 0.0, 1.0,
        ({a.signedMagnitude(1e-9f, 1e9f), a.signedMagnitude(1e-9f, 1e9f),
          a.signedMagnitude(1e-9f, 1e30f)}),
        m::bentDepth(x[0], x[1], x[2]));
}

TEST(ModelSweep, DisksAreFiniteUpToTheRim) {
  SWEEP(3, "limbDarkenedDisk", (Range{0.0, 2.0 + 1e-6}), 0.0, 1.0,
        ({a.magnitude(1e-20f, 0.01f), a.uniform(1e-10f, 0.005f), a.uniform(0.0f, 2.0f)}),
        m::limbDarkenedDisk(x[0], x[1], m::vec3(x[2])).x);
  SWEEP(2, "diskCoverage", (Range{0.0, 1.0}), 0.0, 1.0,
        ({a.magnitude(1e-20f, 2.0f), a.uniform(1e-10f, 0.005f)}), m::diskCoverage(x[0], x[1]));
}

TEST(ModelSweep, VolumeAndSurfaceCoordinatesStayInTheirTables) {
  constexpr double COORDINATE = 4e-7;  // of [0, 1]: a few roundings of logarithm and root
  SWEEP(1, "phaseCoordinate", (Range{0.0, 1.0}), COORDINATE, 1.0, ({a.magnitude(1e-30f, 2.0f)}),
        m::phaseCoordinate(x[0]));
  SWEEP(1, "depthCoordinate", (Range{0.0, 1.0}), COORDINATE, 1.0,
        ({a.signedMagnitude(1e-30f, 1e30f)}), m::depthCoordinate(x[0]));
  SWEEP(1, "canonicalThickness", (Range{0.0, 1.0 + 1e-6}), COORDINATE, 1.0,
        ({a.magnitude(1e-30f, 1e30f)}), m::canonicalThickness(x[0]));
  SWEEP(1, "canonicalCosine", (Range{0.0, 1.0 + 1e-6}), COORDINATE, 1.0, ({a.uniform(-1.0f, 1.0f)}),
        m::canonicalCosine(x[0]));
  SWEEP(2, "canonicalDepth", (Range{-1e-6, 1.0 + 1e-6}), 0.0, 1.0,
        ({a.uniform(0.0f, 1.0f), a.uniform(0.0625f, 128.0f)}),
        m::canonicalDepth(x[0] * x[1], x[1]));
  SWEEP(2, "chordDepth", (Range{0.0, 1e30}), 0.0, 1.0,
        ({a.uniform(0.0f, 1.0f), a.magnitude(1e-30f, 1e30f)}), m::chordDepth(x[0], x[1]));
  SWEEP(3, "collectorStep", (Range{-LARGEST, LARGEST}), 0.0, 1.0,
        ({a.signedMagnitude(1e-30f, 1e9f), a.signedMagnitude(1e-30f, 1e9f),
          a.magnitude(1e-30f, 1e9f)}),
        m::collectorStep(m::vec2(x[0], x[1]), m::vec2(x[1], x[0]), x[2]).x);
  SWEEP(2, "footprintLevel", (Range{0.0, 300.0}), 0.0, 1.0,
        ({a.magnitude(1e-30f, 1e15f), a.magnitude(1e-30f, 1e15f)}), m::footprintLevel(x[0], x[1]));
}

TEST(ModelSweep, SlabsOfAnyTwoDirectionsAreInRange) {
  const auto draw = [](Arguments& a) {
    const std::array<float, 3> n = a.direction();
    const std::array<float, 3> l = a.direction();
    const std::array<float, 3> e = a.direction();
    return std::array<float, 11>{a.magnitude(1e-30f, 1e30f),
                                 a.magnitude(1e-30f, 1e30f),
                                 n[0],
                                 n[1],
                                 n[2],
                                 l[0],
                                 l[1],
                                 l[2],
                                 e[0],
                                 e[1],
                                 e[2]};
  };
  // Folds what has to hold of the parts into one number: 1 where all of it does.
  const auto whole = [](auto slab) {
    const bool holds = slab.thickness >= 0 && slab.depth >= 0 && slab.depth <= slab.thickness &&
                       slab.muLight >= 0.0099 && slab.muLight <= 1 && slab.muView >= -1 &&
                       slab.muView <= 1 && slab.phi >= 0 && slab.phi <= 3.14159275;
    return decltype(slab.phi)(holds ? 1 : -1);
  };
  sweep<11>(
      "tangentSlab", Range{1.0, 1.0}, 0.0, 1.0, draw,
      [&](const std::array<float, 11>& x) {
        return whole(f32::tangentSlab(x[0], x[1], f32::vec3(x[2], x[3], x[4]),
                                      f32::vec3(x[5], x[6], x[7]), f32::vec3(x[8], x[9], x[10])));
      },
      [&](const std::array<float, 11>& x) {
        return whole(f64::tangentSlab(double{x[0]}, double{x[1]}, f64::vec3(x[2], x[3], x[4]),
                                      f64::vec3(x[5], x[6], x[7]), f64::vec3(x[8], x[9], x[10])));
      });
}

}  // namespace
