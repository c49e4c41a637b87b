// SPDX-License-Identifier: MIT
// Disks of lights of shaders/model/sky/disk.glsl: energy, published limb darkening, phases.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "model/model.hpp"
#include "reference/quadrature.hpp"
#include "support/tolerance.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
using welkin::test::EPS_DOUBLE;
using welkin::test::EPS_FLOAT;
using welkin::test::ErrorSample;
using welkin::test::relativeError;

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;
constexpr double KEPT = 0.96;  // of the area, by a smoothstep over the last 8 % of it
constexpr double SUN_DIAMETER = 0.0093;

double edgeOf(double diameter) {
  const double half = std::sin(diameter / 4);
  return 2 * half * half;
}

// To float and no further: gcc 12 at -O2 drops the rounding of vectors that turn double again.
float single(double x) {
  const volatile float y = static_cast<float>(x);
  return y;
}
f32::vec3 single(const f64::vec3& v) {
  return {single(v.x), single(v.y), single(v.z)};
}

// A light somewhere in the sky and the plane across it; `u` points to the lit side.
struct Moon {
  Moon(double phase, std::mt19937& random) {
    std::normal_distribution<double> normal;
    toLight = glm::normalize(f64::vec3(normal(random), normal(random), normal(random)));
    const f64::vec3 other(normal(random), normal(random), normal(random));
    u = glm::normalize(other - toLight * glm::dot(other, toLight));
    v = glm::cross(toLight, u);
    // The eye is at -toLight as seen from the ball; `phase` is the angle between eye and light.
    litFrom = u * std::sin(phase) - toLight * std::cos(phase);
    integral = f64::phaseIntegral(toLight, litFrom);
  }
  // Towards the share t of the disk's area at azimuth phi from the lit side.
  f64::vec3 direction(double edge, double t, double phi) const {
    const double y = t * edge;
    const double sine = std::sqrt(y * (2 - y));
    return toLight * (1 - y) + (u * std::cos(phi) + v * std::sin(phi)) * sine;
  }
  double radiance(double edge, double t, double phi) const {
    return f64::litDisk(direction(edge, t, phi), toLight, litFrom, integral, t * edge, edge);
  }
  f64::vec3 toLight;
  f64::vec3 u;
  f64::vec3 v;
  f64::vec3 litFrom;
  double integral;
};

// Integral over [0, 1] in panels that end where the softened rim begins and where crescents are.
template <typename Function>
double overShare(const Function& function) {
  static const welkin::reference::GaussRule rule = welkin::reference::gaussLegendre(48);
  constexpr std::array<double, 5> ends{0, 0.5, 0.92, 0.98, 1};
  double sum = 0;
  for (size_t panel = 0; panel + 1 < ends.size(); ++panel) {
    const double width = ends[panel + 1] - ends[panel];
    for (size_t i = 0; i < rule.node.size(); ++i) {
      const double t = ends[panel] + width * static_cast<double>(rule.node[i]);
      sum += width * static_cast<double>(rule.weight[i]) * function(t);
    }
  }
  return sum;
}

TEST(LimbDarkening, DiskCarriesTheIrradianceForAnyExponentAndSize) {
  // Cusps of mu^a at the rim under the Gauss rule.
  constexpr double QUADRATURE = 1e-6;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponents(0, 2);
  std::uniform_real_distribution<double> logarithms(std::log(2e-5), std::log(0.2));
  for (int i = 0; i < 200; ++i) {
    const double diameter = std::exp(logarithms(random));
    const double edge = edgeOf(diameter);
    const f64::vec3 exponent(exponents(random), exponents(random), 0);
    for (int c = 0; c < 3; ++c) {
      // Irradiance on a surface that faces the light: cosine 1 - y, solid angle 2 pi dy.
      const double sum = overShare([&](double t) {
        const double y = t * edge;
        return f64::limbDarkenedDisk(y, edge, exponent)[c] * (1 - y) * 2 * PI * edge;
      });
      const double sine = std::sin(diameter / 2);
      const double solidAngle = PI * sine * sine * KEPT;
      // 1 - cos of the disk is not quite the sine's square.
      const double size = diameter * diameter / 16;
      EXPECT_NEAR(sum / solidAngle, 1, QUADRATURE + size) << diameter << " " << exponent[c];
    }
  }
}

TEST(LimbDarkening, ExponentZeroIsTheUniformDiskToTheBit) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> shares(0, 1.2f);
  const auto edge = static_cast<float>(edgeOf(SUN_DIAMETER));
  for (int i = 0; i < 20000; ++i) {
    const float y = shares(random) * edge;
    const float x = std::clamp((1.0f - y / edge) * 12.5f, 0.0f, 1.0f);
    const float uniform = x * x * (3.0f - 2.0f * x);
    EXPECT_EQ(f32::limbDarkenedDisk(y, edge, f32::vec3(0))[1], uniform);
    EXPECT_EQ(f32::diskCoverage(y, edge), uniform);
  }
  EXPECT_EQ(f64::diskCoverage(0.5, 1), 1);
  EXPECT_NEAR(f64::diskCoverage(0.96, 1), 0.5, 50 * EPS_DOUBLE);
  EXPECT_EQ(f64::diskCoverage(1, 1), 0);
}

// Neckel and Labs 1994, Table 1: coefficients of mu^0 to mu^5 of the radiance relative to the
// centre, at the two wavelengths around each of ours.
struct Published {
  double wavelength;
  std::array<double, 6> coefficient;
};
constexpr Published PUBLISHED[3][2] = {
    {{669.400, {0.34685, 1.37539, -2.04425, 2.70493, -1.94290, 0.55999}},
     {700.875, {0.37885, 1.25553, -1.70908, 2.19647, -1.59554, 0.47378}}},
    {{541.760, {0.26073, 1.27428, -1.30352, 1.47085, -0.96618, 0.26384}},
     {559.950, {0.26892, 1.34319, -1.58427, 1.91271, -1.31350, 0.37295}}},
    {{427.930, {0.14249, 1.28796, -1.19564, 1.68603, -1.36658, 0.44572}},
     {443.885, {0.16220, 1.24893, -0.92165, 0.89978, -0.50148, 0.11220}}}};
constexpr double WAVELENGTH[3] = {680, 550, 440};
const f64::vec3 SUN_EXPONENT(0.36, 0.47, 0.62);

TEST(LimbDarkening, OfTheSunIsThePublishedOne) {
  constexpr double CENTRAL = 0.013;  // fit error of the power law to mu = 0.3
  constexpr double OUTER = 0.03;     // to mu = 0.21, where the soft rim begins
  constexpr double RMS = 0.0135;     // over the disk's area
  const double edge = edgeOf(SUN_DIAMETER);
  for (int c = 0; c < 3; ++c) {
    const Published* two = PUBLISHED[c];
    const double share =
        (WAVELENGTH[c] - two[0].wavelength) / (two[1].wavelength - two[0].wavelength);
    const auto relative = [&](double mu) {
      double sum = 0;
      for (size_t k = 6; k-- > 0;) {
        sum = sum * mu + (1 - share) * two[0].coefficient[k] + share * two[1].coefficient[k];
      }
      return sum;
    };
    const double mean = overShare([&](double m) { return relative(std::sqrt(m)); });
    double central = 0;
    double outer = 0;
    for (double mu = 0.21; mu < 1; mu += 0.01) {
      const double y = (1 - mu * mu) * KEPT * edge;
      const double value = f64::limbDarkenedDisk(y, edge, SUN_EXPONENT)[c];
      const double error = std::abs(value / (relative(mu) / mean) - 1);
      (mu > 0.3 ? central : outer) = std::max(mu > 0.3 ? central : outer, error);
    }
    // Least squares over the disk's area.
    const auto rms = [&](double exponent) {
      return std::sqrt(overShare([&](double m) {
        const double law = (exponent + 2) / 2 * std::pow(m, exponent / 2);
        return std::pow(law - relative(std::sqrt(m)) / mean, 2);
      }));
    };
    const double a = SUN_EXPONENT[c];
    std::printf("%3.0f nm: mu^%.2f within %.2f %% to mu = 0.3, %.2f %% to the rim, rms %.2f %%\n",
                WAVELENGTH[c], a, 100 * central, 100 * outer, 100 * rms(a));
    EXPECT_LE(central, CENTRAL) << c;
    EXPECT_LE(outer, OUTER) << c;
    EXPECT_LE(rms(a), RMS) << c;
    EXPECT_LT(rms(a), std::min(rms(a - 0.02), rms(a + 0.02))) << c;
  }
}

// The law integrated along the lit part of the equator: cos^2 of the latitude integrates alike for
// every phase.
long double phaseByQuadrature(long double phase) {
  static const welkin::reference::GaussRule rule = welkin::reference::gaussLegendre(32);
  // Near full moon the integrand turns within the phase angle from either end.
  constexpr std::array<long double, 9> ends{0,     1e-4L,  3e-3L,   0.05L, 0.5L,
                                            0.95L, 0.997L, 0.9999L, 1};
  const long double half = std::numbers::pi_v<long double> / 2;
  const long double width = 2 * half - phase;
  long double sum = 0;
  for (size_t panel = 0; panel + 1 < ends.size(); ++panel) {
    const long double part = ends[panel + 1] - ends[panel];
    for (size_t i = 0; i < rule.node.size(); ++i) {
      const long double longitude = phase - half + width * (ends[panel] + part * rule.node[i]);
      const long double mu0 = std::cos(longitude - phase);
      const long double mu = std::cos(longitude);
      sum += width * part * rule.weight[i] * mu0 * mu / (mu0 + mu);
    }
  }
  return sum;
}

TEST(LunarPhase, IntegralIsThatOfLommelAndSeeliger) {
  // Angles near new moon come with the rounding of sums of unit vectors. The series' rest.
  constexpr double SERIES = 2e-9;
  constexpr double FLOAT_ROUNDINGS = 90;  // 6 roundings, 15-fold cancellation at the switch
  std::mt19937 random(3);
  ErrorSample errors;
  ErrorSample floats;
  for (int i = 0; i < 2000; ++i) {
    const double phase = std::uniform_real_distribution<double>(0, 179.4)(random) * DEGREE;
    const Moon moon(phase, random);
    const long double truth = phaseByQuadrature(static_cast<long double>(phase));
    errors.add(relativeError(moon.integral, truth));
    const auto value = f32::phaseIntegral(f32::vec3(moon.toLight), f32::vec3(moon.litFrom));
    if (phase < 170 * DEGREE) {
      floats.add(relativeError(static_cast<long double>(value), truth));
    }
  }
  std::printf("phase integral: double %.1e, float %.1e\n", errors.max(), floats.max());
  EXPECT_LE(errors.max(), SERIES);
  EXPECT_LE(floats.max(), FLOAT_ROUNDINGS * EPS_FLOAT);
}

TEST(LunarPhase, DiskCarriesTheIrradianceAtAnyPhase) {
  constexpr int AZIMUTHS = 1024;
  constexpr double QUADRATURE = 5e-4;  // kinks at the terminator, in 1024 x 192 nodes
  std::mt19937 random(4);
  std::vector<double> phases{0, 30, 90, 150, 170, 175};
  for (int i = 0; i < 12; ++i) {
    phases.push_back(std::uniform_real_distribution<double>(0, 170)(random));
  }
  for (const double phase : phases) {
    const Moon moon(phase * DEGREE, random);
    const double edge = edgeOf(std::uniform_real_distribution<double>(1e-3, 0.2)(random));
    const double mean = overShare([&](double t) {
      double sum = 0;
      for (int i = 0; i < AZIMUTHS; ++i) {
        sum += moon.radiance(edge, t, 2 * PI * (i + 0.5) / AZIMUTHS);
      }
      return sum / AZIMUTHS;
    });
    EXPECT_NEAR(mean / KEPT, 1, QUADRATURE) << "phase " << phase;
  }
}

TEST(LunarPhase, FullMoonIsFlatAndNewMoonDark) {
  std::mt19937 random(5);
  const double edge = edgeOf(SUN_DIAMETER);
  const Moon full(0, random);
  const Moon dark(PI, random);
  for (double t = 0.005; t < 0.999; t += 0.01) {
    EXPECT_NEAR(full.radiance(edge, t, 1), f64::diskCoverage(t, 1), 1e-9);
    EXPECT_NEAR(dark.radiance(edge, t, 1) * dark.integral, 0, 1e-9);
  }
}

TEST(LunarPhase, TerminatorStandsWhereTheSunRises) {
  std::mt19937 random(6);
  const double edge = edgeOf(SUN_DIAMETER);
  for (const double phase_deg : {20.0, 60.0, 90.0, 120.0, 160.0}) {
    const Moon moon(phase_deg * DEGREE, random);
    // On the diameter through the lit side, -cos(phase) radii from the centre; radii of the body,
    // whose disk keeps 0.96 of the area.
    const double terminator = -std::cos(phase_deg * DEGREE);
    const auto at = [&](double x) { return moon.radiance(edge, x * x * KEPT, x > 0 ? 0 : PI); };
    EXPECT_GT(at(terminator + 1e-3), 0.0) << phase_deg;
    EXPECT_EQ(at(terminator - 1e-3), 0.0) << phase_deg;
    EXPECT_LT(at(terminator + 1e-3), 0.05 * at(0.97)) << phase_deg;
    // Across it the terminator passes the centre's poles, which see the light while it is high.
    if (phase_deg != 90) {
      EXPECT_EQ(moon.radiance(edge, 0.5, PI / 2) > 0, phase_deg < 90) << phase_deg;
    }
  }
}

TEST(DiskPrecision, FloatFollowsDouble) {
  // Limb: the share y/edge has 2 roundings, which mu^2 > 0.02 amplifies 50-fold, then log and exp.
  constexpr double LIMB = (50 * 2 * 2 + 8) * EPS_FLOAT;
  // Phase, of the brightest there can be, 2/phase: 12 roundings of mu0, which mu at t = 0.94
  // amplifies 10-fold.
  constexpr double LIT = 12 * 10 * EPS_FLOAT;
  std::mt19937 random(7);
  ErrorSample limb;
  ErrorSample lit;
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double diameter = 0.002 + 0.1 * uniform(random);
    const double edge = edgeOf(diameter);
    const Moon moon(170 * DEGREE * uniform(random), random);
    const double t = 0.94 * uniform(random);
    const f32::vec3 toLight = single(moon.toLight);
    const f32::vec3 litFrom = single(moon.litFrom);
    const f32::vec3 direction = single(moon.direction(edge, t, 2 * PI * uniform(random)));
    const float edgeFloat = single(edge);
    const float y = f32::oneMinusCosine(direction, toLight);
    const f32::vec3 exponent(single(uniform(random)), single(2 * uniform(random)), 0);
    const f64::vec3 sharp = f64::limbDarkenedDisk(
        static_cast<double>(y), static_cast<double>(edgeFloat), f64::vec3(exponent));
    const f32::vec3 rounded = f32::limbDarkenedDisk(y, edgeFloat, exponent);
    for (int c = 0; c < 3; ++c) {
      limb.add(relativeError(static_cast<long double>(rounded[c]), sharp[c]));
    }
    const float integral = single(moon.integral);
    const double truth = f64::litDisk(f64::vec3(direction), f64::vec3(toLight), f64::vec3(litFrom),
                                      static_cast<double>(integral), static_cast<double>(y),
                                      static_cast<double>(edgeFloat));
    const float value = f32::litDisk(direction, toLight, litFrom, integral, y, edgeFloat);
    const double scale = 2 / moon.integral;
    lit.add(std::abs(static_cast<double>(value) - truth) / scale);
  }
  std::printf("float: limb darkening %.1e, phase %.1e of 2/phase\n", limb.max(), lit.max());
  EXPECT_LE(limb.max(), LIMB);
  EXPECT_LE(lit.max(), LIT);
}

TEST(Disk, IsFiniteForEverything) {
  std::mt19937 random(8);
  for (const double phase : {0.0, 1e-9, 90 * DEGREE, PI - 1e-3, PI - 1e-9, PI}) {
    const Moon moon(phase, random);
    const f32::vec3 toLight(moon.toLight);
    const f32::vec3 litFrom(moon.litFrom);
    for (const float edge : {1e-30f, 1e-12f, 1e-5f, 0.005f}) {
      const float integral = f32::phaseIntegral(toLight, litFrom);
      EXPECT_TRUE(integral > 0 && integral <= 1) << phase;
      for (const float t : {0.0f, 1e-20f, 1e-7f, 0.5f, 0.92f, 0.9999999f, 1.0f, 2.0f}) {
        const float y = t * edge;
        for (const double phi : {0.0, 2.0, PI}) {
          const f32::vec3 direction(
              moon.direction(static_cast<double>(edge), static_cast<double>(t), phi));
          const float lit = f32::litDisk(direction, toLight, litFrom, integral, y, edge);
          EXPECT_TRUE(std::isfinite(lit) && lit >= 0) << phase << " " << edge << " " << t;
          EXPECT_LE(lit, 2 / integral);
        }
        const f32::vec3 limb = f32::limbDarkenedDisk(y, edge, f32::vec3(0, 0.5f, 2));
        for (int c = 0; c < 3; ++c) {
          EXPECT_TRUE(std::isfinite(limb[c]) && limb[c] >= 0 && limb[c] <= 2.0f) << edge << t;
        }
      }
    }
    const f32::vec3 away = -toLight;
    EXPECT_EQ(f32::phaseIntegral(toLight, away), 1.0f);
    EXPECT_GT(f32::phaseIntegral(toLight, toLight), 0.0f);
    EXPECT_TRUE(std::isfinite(f32::phaseIntegral(f32::vec3(0), f32::vec3(0))));
  }
}

}  // namespace
