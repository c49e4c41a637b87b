// SPDX-License-Identifier: MIT
// src/particles/{size_distribution, solar_disk, mie_average}: averages over sizes and wavelengths
// against integrals, published fits and the places of bows, rings and glories.
#include "particles/mie_average.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "particles/mie.hpp"
#include "particles/refractive_index.hpp"
#include "particles/solar_disk.hpp"
#include "reference/phase_reference.hpp"

namespace {

using namespace welkin;
using reference::Real;

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;

SizeDistribution logNormal(double diameter_um, double spread) {
  return {SizeKind::LogNormal, diameter_um / 2, spread};
}

MieSettings nodes(double perSpread) {
  MieSettings settings;
  settings.nodesPerSpread = perSpread;
  return settings;
}

std::vector<double> range(double begin, double end, double step) {
  std::vector<double> result;
  for (int i = 0; begin + i * step <= end + step / 2; ++i) {
    result.push_back(begin + i * step);
  }
  return result;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) {
    value *= factor;
  }
  return values;
}

// Where the values are largest, by the parabola through the three points about it; unit of at.
double peak(const std::vector<double>& at, const std::vector<double>& values) {
  const auto top = std::max_element(values.begin() + 1, values.end() - 1);
  const auto i = static_cast<size_t>(top - values.begin());
  const double left = values[i] - values[i - 1];
  const double right = values[i] - values[i + 1];
  const double shift = (left + right) > 0 ? (left - right) / (2 * (left + right)) : 0;
  return at[i] + shift * (at[1] - at[0]);
}

// --- sizes

TEST(SizeDistribution, NodesIntegrateEveryMomentUsed) {
  for (const SizeDistribution& one :
       {logNormal(20, 0.25), logNormal(20, 0.1), logNormal(1000, 0.6),
        SizeDistribution{SizeKind::Gamma, 1.5, 2}, SizeDistribution{SizeKind::Gamma, 0.5, 20}}) {
    const SizeNodes rule = sizeNodes(std::span(&one, 1), logSpread(one) / 16, 0.3);
    for (const int power : {2, 3, 4}) {
      double sum = 0;
      for (size_t i = 0; i < rule.radius_um.size(); ++i) {
        sum += rule.weight[i] * std::pow(rule.radius_um[i], power);
      }
      // Both tails of r^2 .. r^4: 1e-5 each; the rule's own error is far below.
      EXPECT_NEAR(sum / meanPower(one, power), 1, 2e-5) << one.spread << " power " << power;
    }
  }
}

TEST(SizeDistribution, DensityIntegratesToTheClosedMoments) {
  for (const SizeDistribution& one :
       {logNormal(20, 0.25), SizeDistribution{SizeKind::Gamma, 1.5, 2}}) {
    for (const double power : {0.0, 1.0, 2.5}) {
      double sum = 0;
      constexpr double STEP = 1e-3;
      for (double r = STEP / 2; r < 100; r += STEP) {  // midpoint rule: STEP^2 times a curvature
        sum += sizeDensity(one, r) * std::pow(r, power) * STEP;
      }
      EXPECT_NEAR(sum / meanPower(one, power), 1, 1e-6) << power;
    }
  }
}

// [B08] section A: r_e = (gamma + 2) r_n, 6 um for r_n = 1.5 um, gamma = 2.
TEST(SizeDistribution, GammaHasTheEffectiveRadiusOfThePaper) {
  EXPECT_NEAR(effectiveRadius({SizeKind::Gamma, 1.5, 2}), 6, 1e-12);
  // Log-normal: exp(5 s^2 / 2) medians.
  EXPECT_NEAR(effectiveRadius(logNormal(20, 0.25)), 10 * std::exp(2.5 * 0.0625), 1e-12);
}

// --- the sun's disk

double planValue(const AnglePlan& plan, size_t i, double (*f)(double)) {
  double sum = 0;
  for (size_t j = plan.begin[i]; j < plan.begin[i + 1]; ++j) {
    sum += plan.weight[j] * f(plan.angles[j]);
  }
  return sum;
}

TEST(SolarDisk, KeepsCosinesUpToTheDisksMoment) {
  const std::vector<double> angles = {0.0, 1e-6, 0.002, 0.00465, 0.005,      0.018, 0.02,
                                      0.5, 1.5,  2.0,   3.0,     PI - 0.001, PI};
  const AnglePlan plan = solarDiskPlan(angles);
  for (size_t i = 0; i < angles.size(); ++i) {
    // A harmonic of degree 1 keeps (1 + cos R) / 2 of itself; 1 - cos is what a peak sees.
    const double moment = (1 + std::cos(SUN_RADIUS)) / 2;
    const double value = planValue(plan, i, [](double t) { return std::cos(t); });
    const double away = std::min(angles[i], PI - angles[i]);
    // The rules' relative error 2e-3 of what the disk changes.
    const double scale = std::sin(away) * SUN_RADIUS + SUN_RADIUS * SUN_RADIUS;
    EXPECT_NEAR(value, moment * std::cos(angles[i]), 2e-3 * scale) << angles[i];
  }
}

// A diffraction peak 15 times narrower than the disk, against the plain mean over points of it.
TEST(SolarDisk, ResolvesAPeakNarrowerThanTheDisk) {
  const auto narrow = [](double t) { return 1 / std::pow(1 + std::pow(t / 3e-4, 2), 1.5); };
  const std::vector<double> angles = {0.0, 0.001, 0.003, 0.004, 0.0047, 0.006, 0.01, 0.02};
  const AnglePlan plan = solarDiskPlan(angles);
  for (size_t i = 0; i < angles.size(); ++i) {
    double sum = 0;
    constexpr int SIDE = 700;  // flat sky: SUN_RADIUS^2 / 6 = 4e-6
    double count = 0;
    for (int a = 0; a < SIDE; ++a) {
      for (int b = 0; b < SIDE; ++b) {
        const double x = ((a + 0.5) / SIDE * 2 - 1) * SUN_RADIUS;
        const double y = ((b + 0.5) / SIDE * 2 - 1) * SUN_RADIUS;
        if (x * x + y * y <= SUN_RADIUS * SUN_RADIUS) {
          sum += narrow(std::hypot(x - angles[i], y));
          count += 1;
        }
      }
    }
    EXPECT_NEAR(planValue(plan, i, narrow) / (sum / count), 1, 0.01) << angles[i];
  }
}

// --- averages

TEST(MieAverage, OfOneSizeIsThatSphere) {
  const std::vector<double> angles = {0, 0.01, 1, 2, PI};
  const std::vector<SpectralSample> green = waterSample(0.55, 10);
  const MieAverage mean = averageMie({SizeKind::Monodisperse, 7, 0}, green, angles, MieSettings{});
  MieSphere sphere;
  const double x = 2 * PI * 7 / 0.55;
  sphere.solve(x, green[0].index);
  const MieEfficiencies q = sphere.efficiencies();
  std::vector<double> intensity(angles.size());
  sphere.intensities(MieAngles(angles), intensity);
  constexpr double ROUNDINGS = 16 * 0x1p-53;
  EXPECT_NEAR(mean.scattering_um2 / (q.scattering * PI * 49), 1, ROUNDINGS);
  EXPECT_NEAR(mean.extinction_um2 / (q.extinction * PI * 49), 1, ROUNDINGS);
  EXPECT_NEAR(mean.efficiency / q.scattering, 1, ROUNDINGS);
  EXPECT_NEAR(mean.asymmetry / q.asymmetry, 1, ROUNDINGS);
  for (size_t i = 0; i < angles.size(); ++i) {
    EXPECT_NEAR(mean.phase[i] / (intensity[i] / (PI * x * x * q.scattering)), 1, ROUNDINGS);
  }
}

// Norm, mean cosine and forward half of the phase function, by quadrature over it.
TEST(MieAverage, MomentsAreIntegralsOfThePhaseFunction) {
  struct Case {
    SizeDistribution sizes;
    double widest;
    bool disk;
  };
  for (const auto& [sizes, widest, disk] :
       {Case{logNormal(5, 0.25), 0.03, false}, Case{logNormal(5, 0.25), 0.03, true},
        Case{{SizeKind::Monodisperse, 10, 0}, 0.005, false},
        Case{{SizeKind::Gamma, 1.5, 2}, 0.01, false}}) {
    auto points = reference::anglePoints(0, reference::PI / 2, widest);
    const size_t forward = points.size();
    const auto back = reference::anglePoints(reference::PI / 2, reference::PI, widest);
    points.insert(points.end(), back.begin(), back.end());
    std::vector<double> angles;
    for (const auto& point : points) {
      angles.push_back(static_cast<double>(point.theta));
    }
    MieSettings settings = nodes(64);
    settings.solarDisk = disk;
    const MieAverage mean = averageMie(sizes, waterSample(0.55, 10), angles, settings);
    double total = 0;
    double cosine = 0;
    double front = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      const double share = static_cast<double>(points[i].weight) * mean.phase[i];
      total += share;
      cosine += share * std::cos(angles[i]);
      front += i < forward ? share : 0;
    }
    // The disk's rules are good to 2e-5 of the peak's energy.
    const double tolerance = disk ? 2e-5 : 1e-8;
    EXPECT_NEAR(total, 1, tolerance);
    EXPECT_NEAR(cosine, mean.asymmetry, tolerance);
    // What mie_average.hpp states: the backward rule's offset changes from node to node.
    EXPECT_NEAR(front, mean.forwardFraction, 1e-4);
  }
}

TEST(MieAverage, TwiceTheNodesChangeNothingBeyondTheStatedError) {
  const std::vector<double> angles = scaled(range(0, 180, 3), DEGREE);
  const SizeDistribution fog = logNormal(5, 0.25);
  const MieAverage once = averageMie(fog, waterSample(0.55, 10), angles, MieSettings{});
  const MieAverage twice = averageMie(fog, waterSample(0.55, 10), angles, nodes(8192));
  for (size_t i = 0; i < angles.size(); ++i) {
    const double tolerance = angles[i] > 179 * DEGREE ? 4e-3 : 2e-3;
    EXPECT_NEAR(once.phase[i] / twice.phase[i], 1, tolerance) << angles[i] / DEGREE;
  }
}

TEST(MieAverage, SeveralDistributionsAtOnceEqualEachAlone) {
  const std::vector<double> angles = {0, 0.1, 2.4};
  const std::vector<SizeDistribution> sizes = {
      logNormal(5, 0.25), {SizeKind::Monodisperse, 3, 0}, logNormal(8, 0.25)};
  const auto green = waterSample(0.55, 10);
  const std::vector<MieAverage> together = averageMie(sizes, green, angles, nodes(128));
  for (size_t d = 0; d < sizes.size(); ++d) {
    const MieAverage alone = averageMie(sizes[d], green, angles, nodes(128));
    // The same nodes in another order: a rounding for each of 600.
    constexpr double ROUNDINGS = 600 * 0x1p-53;
    EXPECT_NEAR(together[d].scattering_um2 / alone.scattering_um2, 1, ROUNDINGS);
    for (size_t i = 0; i < angles.size(); ++i) {
      EXPECT_NEAR(together[d].phase[i] / alone.phase[i], 1, ROUNDINGS) << d << " " << angles[i];
    }
  }
}

TEST(MieAverage, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<double> angles = {0, 0.1, 2.4};
  MieSettings settings = nodes(64);
  const auto band = waterSamples(0.4, 0.7, 4, 10);
  const MieAverage one = averageMie(logNormal(5, 0.25), band, angles, settings);
  settings.threads = 3;
  const MieAverage three = averageMie(logNormal(5, 0.25), band, angles, settings);
  EXPECT_EQ(one.phase, three.phase);
  EXPECT_EQ(one.scattering_um2, three.scattering_um2);
  EXPECT_EQ(one.forwardFraction, three.forwardFraction);
}

// --- published and derived numbers of water clouds

std::vector<SpectralSample> greyWater(double index, int count) {
  std::vector<SpectralSample> samples = waterSamples(0.4, 0.7, count, 10);
  for (SpectralSample& sample : samples) {
    sample.index = index;
  }
  return samples;
}

// [J23] Eq. 1 in its continuous form for its own fit (Eq. 3-7) against its own reference: water of
// n = 1.333, log-normal diameters, 400-700 nm. E and g of an independent Mie code with the same
// parameters; printed digits, and 1 % for its own sampling of sizes and wavelengths.
TEST(MieAverage, GivesThePublishedFitItsPublishedError) {
  struct Row {
    double diameter_um, asymmetry, error;
  };
  const std::vector<double> angles = scaled(range(0, 180, 0.5), DEGREE);
  for (const Row& row : {Row{5, 0.8332, 0.0803}, Row{10, 0.8541, 0.1110}, Row{20, 0.8671, 0.1452},
                         Row{50, 0.8764, 0.2149}}) {
    const MieAverage mean =
        averageMie(logNormal(row.diameter_um, 0.25), greyWater(1.333, 8), angles, nodes(512));
    const reference::Fog fit(row.diameter_um);
    double error = 0;  // trapezoid: the weight |cos| sin vanishes at both ends
    for (size_t i = 0; i < angles.size(); ++i) {
      const double c = std::cos(angles[i]);
      const double log = std::log(static_cast<double>(fit(c)) / mean.phase[i]);
      error += 0.5 * DEGREE * std::abs(c) * std::sin(angles[i]) * log * log;
    }
    EXPECT_NEAR(mean.asymmetry, row.asymmetry, 1e-4) << row.diameter_um;
    EXPECT_NEAR(error / row.error, 1, 0.01) << row.diameter_um;
  }
}

// Energy scattered forwards and efficiency of clouds at 550 nm: [R04]'s F_1 and the approach of
// Qsca to 2.
TEST(MieAverage, GivesCloudsTheirForwardFractionAndEfficiency) {
  const auto green = waterSample(0.55, 10);
  EXPECT_NEAR(averageMie(logNormal(20, 0.25), green, {}, nodes(512)).forwardFraction, 0.9640, 5e-5);
  EXPECT_NEAR(averageMie(logNormal(5, 0.25), green, {}, nodes(256)).efficiency, 2.20, 5e-3);
  EXPECT_NEAR(averageMie(logNormal(50, 0.25), green, {}, nodes(64)).efficiency, 2.04, 5e-3);
}

// Positions in x theta of the corona and x (pi - theta) of the glory, x of the median radius 10 um,
// spread 0.1, 550 nm; to the printed digits, the later glory rings being broad.
TEST(MieAverage, PutsCoronaAndGloryRingsAtTheirAngles) {
  const double x = 2 * PI * 10 / 0.55;
  const auto green = waterSample(0.55, 10);
  const std::vector<double> u = range(1, 14, 0.05);
  std::vector<double> angles = scaled(u, 1 / x);
  for (size_t i = 0; i < u.size(); ++i) {
    angles.push_back(PI - u[i] / x);
  }
  const MieAverage mean = averageMie(logNormal(20, 0.1), green, angles, nodes(1024));
  const auto within = [&](bool backward, double low, double high, double sign) {
    std::vector<double> at;
    std::vector<double> value;
    for (size_t i = 0; i < u.size(); ++i) {
      if (u[i] >= low && u[i] <= high) {
        at.push_back(u[i]);
        value.push_back(sign * mean.phase[i + (backward ? u.size() : 0)]);
      }
    }
    return peak(at, value);
  };
  EXPECT_NEAR(within(false, 3, 4.4, -1), 3.75, 0.05);
  EXPECT_NEAR(within(false, 4, 6, 1), 4.83, 0.05);
  EXPECT_NEAR(within(false, 6, 7.5, -1), 6.97, 0.05);
  EXPECT_NEAR(within(false, 7.2, 9, 1), 7.9, 0.1);
  EXPECT_NEAR(within(true, 1, 2.5, -1), 1.55, 0.1);
  EXPECT_NEAR(within(true, 2, 4.5, 1), 3.0, 0.1);
  EXPECT_NEAR(within(true, 4, 6, -1), 5.0, 0.1);
  EXPECT_NEAR(within(true, 5.5, 8, 1), 6.4, 0.1);
}

// Airy: the primary's peak lies 99.14 x^(-2/3) degrees beyond Descartes' angle; 0.05 for the spread
// of sizes about the median and 0.05 for Airy itself at x = 5000.
TEST(MieAverage, PutsTheRainbowWhereAiryDoes) {
  struct Colour {
    double wavelength_um, descartes, mie;
  };
  for (const auto& [wavelength, descartes, mie] :
       {Colour{0.44, 139.022, 139.24}, Colour{0.55, 138.216, 138.48},
        Colour{0.68, 137.673, 137.98}}) {
    const double x = 2 * PI * 500 / wavelength;
    const std::vector<double> at = range(descartes - 0.4, descartes + 1.1, 0.1);
    const MieAverage rain = averageMie(logNormal(1000, 0.25), waterSample(wavelength, 10),
                                       scaled(at, DEGREE), nodes(64));
    const double top = peak(at, rain.phase);
    EXPECT_NEAR(top, descartes + 99.14 * std::pow(x, -2.0 / 3), 0.1) << wavelength;
    EXPECT_NEAR(top, mie, 0.05) << wavelength;
  }
}

// A white bow: its colours lie within 0.4 degrees, the rainbow's within 1.3, and all of them inside
// Airy's place by 0.3-0.7 degrees.
TEST(MieAverage, PutsTheFogbowsColoursTogether) {
  const std::vector<double> at = range(138, 146, 0.1);
  const double measured[3] = {141.91, 141.95, 142.27};
  for (int i = 0; i < 3; ++i) {
    const MieAverage fog = averageMie(logNormal(20, 0.1), waterSample(RGB_WAVELENGTH_UM[i], 10),
                                      scaled(at, DEGREE), nodes(1024));
    EXPECT_NEAR(peak(at, fog.phase), measured[i], 0.05) << RGB_WAVELENGTH_UM[i];
  }
}

}  // namespace
