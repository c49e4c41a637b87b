// SPDX-License-Identifier: MIT
// Every kind of particle of the catalogue: bows, rings and halos where optics puts them, energies,
// and the numbers of each kind's curve. Angles in degrees unless they are arguments of ours.
#include "particles/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "particles/medium.hpp"
#include "particles/mie_average.hpp"
#include "particles/solar_disk.hpp"
#include "reference/phase_reference.hpp"

namespace {

using namespace welkin;

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;

// The kind's own numbers where `params` leaves them 0.
Particle made(ParticleType type, ParticleParams params) {
  const ParticleKind& kind = particleKind(type);
  params.diameter_um = params.diameter_um > 0 ? params.diameter_um : kind.diameter_um.initial;
  params.spread = params.spread > 0 ? params.spread : kind.spread.initial;
  return kind.make(params);
}

Particle sized(ParticleType type, double diameter_um) {
  ParticleParams params;
  params.diameter_um = diameter_um;
  return made(type, params);
}

Particle rough(ParticleType type, double roughness) {
  ParticleParams params;
  params.roughness = roughness;
  return made(type, params);
}

double at(const Particle& particle, size_t channel, double degrees) {
  return evalParticle(particle, channel, degrees * DEGREE);
}

// Where sign times f is largest in [low, high], by the parabola through three points of a grid.
template <typename F>
double extremum(F f, double low, double high, double sign) {
  constexpr int STEPS = 400;
  const double step = (high - low) / STEPS;
  int best = 1;
  for (int i = 1; i < STEPS; ++i) {
    best = sign * f(low + i * step) > sign * f(low + best * step) ? i : best;
  }
  const double middle = f(low + best * step);
  const double left = middle - f(low + (best - 1) * step);
  const double right = middle - f(low + (best + 1) * step);
  return low + (best + (left - right) / (2 * (left + right))) * step;
}

// Index of the red, green and blue of water at 10 C to air, and places of the bows of drops of
// radius 0.5 mm, spread 0.25, by an independent Mie code.
struct Bow {
  double wavelength_um, index, primary, secondary;
};
constexpr Bow BOWS[] = {{0.68, 1.33129, 137.98, 129.02},
                        {0.55, 1.33503, 138.48, 128.12},
                        {0.44, 1.34065, 139.24, 126.72}};

// Descartes' angle of p chords in degrees, and Airy's peak beyond it: Ai^2 is largest at -1.01879.
double airyBow(const Bow& bow, int p, double radius_um) {
  const double n2 = bow.index * bow.index;
  const double i = std::acos(std::sqrt((n2 - 1) / (p * p - 1.0)));
  const double r = std::asin(std::sin(i) / bow.index);
  const double p2 = p * p;
  const double h = (p2 - 1) * (p2 - 1) / p2 * std::sqrt((p2 - n2) / std::pow(n2 - 1, 3));
  const double x = 2 * PI * radius_um / bow.wavelength_um;
  const double shift = 1.01879 * std::cbrt(h) * std::pow(x, -2.0 / 3) / DEGREE;
  // 2 (i - p r) + (p - 1) pi; the secondary's light goes round beyond 180 degrees.
  const double turned = (2 * (i - p * r) + (p - 1) * PI) / DEGREE;
  return p == 2 ? turned + shift : 360 - turned - shift;
}

TEST(Rain, HasBothBowsWhereAiryAndMiePutThem) {
  // Airy is within 0.1 of Mie at this size; the sun's disk moves a peak by less than 0.05.
  constexpr double NEAR = 0.15;
  const Particle rain = sized(ParticleType::Rain, 1000);
  for (size_t c = 0; c < RGB; ++c) {
    const auto p = [&](double degrees) { return at(rain, c, degrees); };
    const double primary = extremum(p, 136.5, 141, 1);
    const double secondary = extremum(p, 125, 131, 1);
    EXPECT_NEAR(primary, airyBow(BOWS[c], 2, 500), NEAR) << c;
    EXPECT_NEAR(secondary, airyBow(BOWS[c], 3, 500), NEAR) << c;
    EXPECT_NEAR(primary, BOWS[c].primary, NEAR) << c;
    EXPECT_NEAR(secondary, BOWS[c].secondary, NEAR) << c;
    // Alexander's dark band: at 134 degrees 64 to 90 and 10 to 14 times darker by Mie theory.
    const double dark = p(extremum(p, 130.5, 136.5, -1));
    EXPECT_GT(p(primary), 30 * dark) << c;
    EXPECT_GT(p(secondary), 7 * dark) << c;
  }
}

// Share of the extinction that does not go straight on for being turned by more than `limit`: half
// of it is diffraction [Babinet], of which J0^2 + J1^2 of z = x limit lies beyond the limit; the
// level there, J1^2 of the energy within, stays too. The sun's disk of radius R raises a tail of
// angle^-3: its mean over the disk is sum of ((3/2)_k)^2 / (k! (k + 1)!) (R / angle)^(2 k) times
// it.
double diffractedAside(double diameter_um, double wavelength_um, double spread) {
  constexpr int STEPS = 400;
  const double limit = 0.5 * DEGREE;
  double level = 0;
  double beyond = 0;
  double term = 1;
  for (int k = 0; k < 20; ++k) {
    level += term;
    beyond += term / (2 * k + 1);
    term *= std::pow((k + 1.5) * SUN_RADIUS / limit, 2) / ((k + 1) * (k + 2));
  }
  double sum = 0;
  double total = 0;
  for (int i = 0; i < STEPS; ++i) {
    const double deviate = std::lerp(-5.0, 5.0, (i + 0.5) / STEPS);
    const double radius_um = diameter_um / 2 * std::exp(spread * deviate);
    const double weight = std::exp(-deviate * deviate / 2) * radius_um * radius_um;
    const double z = 2 * PI * radius_um / wavelength_um * limit;
    const double j0 = std::cyl_bessel_j(0, z);
    const double j1 = std::cyl_bessel_j(1, z);
    sum += weight * 0.5 * (beyond * (j0 * j0 + j1 * j1) + level * j1 * j1);
    total += weight;
  }
  return sum / total;
}

TEST(Rain, WhatGoesStraightOnIsTheDiffraction) {
  for (const double d : {100.0, 150.0, 250.0, 700.0, 1300.0, 2000.0}) {
    const Particle rain = sized(ParticleType::Rain, d);
    for (size_t c = 0; c < RGB; ++c) {
      const double aside = diffractedAside(d, BOWS[c].wavelength_um, 0.25);
      // The tail of small drops is no power yet, and the extinction is 2 to 0.03: 12 %. Refraction
      // near the axis, and the largest drops, which count as those of x = 20 000: 1e-3.
      EXPECT_NEAR(rain.optics.delta[c], 0.5 - aside, 0.12 * aside + 1.2e-3) << d << " " << c;
      EXPECT_LE(rain.optics.delta[c], 0.50) << d << " " << c;
      EXPECT_GE(rain.optics.delta[c], d < 250 ? 0.35 : 0.44) << d << " " << c;
    }
  }
}

// Mie theory with the sun's disk, straight light included, halfway between two columns: beyond 1
// degree, and the mean of 1 - cos of all light.
TEST(Rain, ScattersWhatDoesNotGoStraightOn) {
  const double diameter_um = 320;
  const std::vector<double> degrees = {1.5, 30, 90};
  std::vector<double> angles;
  for (const double one : degrees) {
    angles.push_back(one * DEGREE);
  }
  MieSettings settings;
  settings.nodesPerSpread = 128;
  settings.solarDisk = true;
  const MieAverage truth = averageMie({SizeKind::LogNormal, diameter_um / 2, 0.25},
                                      waterSample(BOWS[1].wavelength_um, 10), angles, settings);
  const Particle rain = sized(ParticleType::Rain, diameter_um);
  const double scattered = 1 - rain.optics.delta[1];
  // Columns 1.4 apart in diameter, and 128 nodes per spread of the table and of the truth.
  constexpr double COLUMNS = 0.04;
  constexpr double NODES = 0.01;
  for (size_t i = 0; i < angles.size(); ++i) {
    const double ln = std::log(scattered * evalParticle(rain, 1, angles[i]) / truth.phase[i]);
    EXPECT_LE(std::abs(ln), COLUMNS + NODES) << degrees[i];
  }
  // What goes straight on has a cosine of 1 to 4e-5, of a gap of 0.12.
  EXPECT_NEAR(scattered * meanOneMinusCosine(rain.curve, 1) / (1 - truth.asymmetry), 1, 1e-3);
}

// Extrema of the corona at x angle and of the glory at x (180 - angle), x of the median: an
// independent Mie code's.
TEST(Cloud, HasCoronaAndGloryOfANarrowSpread) {
  ParticleParams params;
  params.diameter_um = 20;
  params.spread = 0.1;
  params.wavelength_um = 0.55;
  const Particle cloud = made(ParticleType::Cloud, params);
  ASSERT_FALSE(cloud.analytic);
  const double x = 2 * PI * 10 / 0.55;
  const auto forward = [&](double u) { return evalParticle(cloud, 0, u / x); };
  const auto backward = [&](double u) { return evalParticle(cloud, 0, PI - u / x); };
  const double values[] = {extremum(forward, 3, 4.4, -1), extremum(forward, 4, 6, 1),
                           extremum(forward, 6, 7.5, -1), extremum(backward, 1, 2.5, -1),
                           extremum(backward, 2, 4.5, 1)};
  const double printed[] = {3.75, 4.83, 6.97, 1.55, 3.0};
  for (size_t i = 0; i < std::size(printed); ++i) {
    EXPECT_NEAR(values[i] / printed[i], 1, 0.05) << i;
  }
  EXPECT_NEAR(backward(0) * 4 * PI, 0.65, 0.05 * 0.65);
}

// Half way up from the darkest place before the halo's edge to its peak. The disk's mean of a step
// is half way up where the step stands; the fall behind it takes off a part of the peak.
double halfRise(const Particle& particle, size_t channel, double edge) {
  const auto p = [&](double degrees) { return at(particle, channel, degrees); };
  const double low = p(edge - 0.8);
  double high = 0;
  for (double degrees = edge; degrees < edge + 1; degrees += 0.01) {
    high = std::max(high, p(degrees));
  }
  double degrees = edge - 0.8;
  while (degrees < edge + 1 && p(degrees) < (low + high) / 2) {
    degrees += 0.002;
  }
  return degrees;
}

TEST(Ice, HasItsHalosAtTheMinimumDeviation) {
  // Of 680, 550, 440 nm: 2 asin(n sin(A / 2)) - A with the index of Warren and Brandt 2008.
  constexpr double SMALL[RGB] = {21.635, 21.915, 22.318};
  constexpr double LARGE[RGB] = {45.156, 45.949, 47.109};
  for (const ParticleType type : {ParticleType::IceColumn, ParticleType::IcePlate}) {
    const Particle ice = rough(type, 0);
    for (size_t c = 0; c < RGB; ++c) {
      const double small = halfRise(ice, c, SMALL[c]);
      const double large = halfRise(ice, c, LARGE[c]);
      EXPECT_NEAR(small, SMALL[c], 0.1) << particleKind(type).name;
      EXPECT_NEAR(large, LARGE[c], 0.1) << particleKind(type).name;
      EXPECT_GT(at(ice, c, SMALL[c] + 0.3), 5 * at(ice, c, SMALL[c] - 0.8));
    }
  }
}

// From smooth to rough, light of parallel faces passes from what goes straight on to the curve, bit
// by bit: scattered light is linear in the roughness up to the first column, 0.01.
TEST(Ice, PassesFromSmoothToRoughWithAllItsLight) {
  // The axis is in float: 1e-8.
  constexpr double CALIBRATION = 2e-3;  // the curve's cosine is adjusted by some 1e-3 of its half
  for (const ParticleType type : {ParticleType::IceColumn, ParticleType::IcePlate}) {
    const Particle ends[] = {rough(type, 0), rough(type, 0.01)};
    for (const double t : {1e-4, 0.25, 0.5, 0.75}) {
      const Particle between = rough(type, 0.01 * t);
      for (size_t c = 0; c < RGB; ++c) {
        const auto scattered = [&](const Particle& particle, double degrees) {
          return (1 - particle.optics.delta[c]) * at(particle, c, degrees);
        };
        EXPECT_NEAR(between.optics.delta[c],
                    std::lerp(ends[0].optics.delta[c], ends[1].optics.delta[c], t), 1e-8);
        for (const double degrees : {0.3, 3.0, 15.0, 23.0, 46.5, 90.0, 140.0, 179.5}) {
          const double mean =
              std::lerp(scattered(ends[0], degrees), scattered(ends[1], degrees), t);
          EXPECT_NEAR(scattered(between, degrees) / mean, 1, CALIBRATION) << degrees;
        }
      }
    }
    // Smooth crystals let light through parallel faces: a quarter of a column's, half of a plate's.
    EXPECT_GT(ends[0].optics.delta[1], 0.6);
    EXPECT_NEAR(ends[1].optics.delta[1], 0.5, 1e-6);
  }
}

TEST(Snow, HasNoHalo) {
  for (const double roughness : {0.3, 0.4, 0.45, 0.5, 0.6}) {
    const Particle snow = rough(ParticleType::Snow, roughness);
    for (size_t c = 0; c < RGB; ++c) {
      double before = at(snow, c, 10);
      for (double degrees = 11; degrees <= 60; ++degrees) {
        const double here = at(snow, c, degrees);
        EXPECT_LT(here, before * 1.01) << roughness << " at " << degrees;  // and its rays' noise
        before = here;
      }
    }
  }
}

TEST(User, GivesATableBack) {
  std::vector<double> angle;
  std::vector<double> phase;
  constexpr double G[RGB] = {0.5, 0.8, -0.3};
  constexpr int ROWS = 720;
  for (int i = 0; i <= ROWS; ++i) {
    angle.push_back(i * PI / ROWS);
    for (const double g : G) {  // in a unit of its own
      phase.push_back(7e5 * static_cast<double>(reference::henyeyGreenstein(
                                g, std::cos(static_cast<reference::Real>(angle.back())))));
    }
  }
  ParticleParams params;
  params.userAngle = angle;
  params.userPhase = phase;
  const Particle user = made(ParticleType::User, params);
  // ln P is curved by 3 g / (1 - g)^2 at most, 60 for 0.8: 60 / 8 step^2 = 1.4e-4, of the norm
  // also.
  constexpr double CHORD = 60.0 / 8 * (PI / ROWS) * (PI / ROWS);
  for (size_t c = 0; c < RGB; ++c) {
    for (double degrees = 0; degrees <= 180; degrees += 0.37) {
      const auto truth = static_cast<double>(reference::henyeyGreenstein(
          G[c], std::cos(static_cast<reference::Real>(degrees * DEGREE))));
      EXPECT_NEAR(at(user, c, degrees) / truth, 1, 2 * CHORD) << c << " " << degrees;
    }
    EXPECT_NEAR(meanCosine(user.curve, c), G[c], 2 * CHORD);
  }
}

TEST(Air, IsRayleighs) {
  const Particle air = made(ParticleType::Air, {});
  EXPECT_TRUE(air.analytic);
  for (double degrees = 0; degrees <= 180; degrees += 0.5) {
    const auto truth = static_cast<double>(
        reference::rayleigh(std::cos(static_cast<reference::Real>(degrees * DEGREE))));
    for (size_t c = 0; c < RGB; ++c) {
      // 20 roundings; and those of the curve's parabolas, 2047 chords of it.
      EXPECT_NEAR(at(air, c, degrees) / truth, 1, 20 * 0x1p-53) << degrees;
      const double y = 2 * std::pow(std::sin(degrees * DEGREE / 2), 2);
      EXPECT_NEAR(evalPhaseCurve(air.curve, c, y) / truth, 1, 1e-6) << degrees;
    }
  }
}

// Five values of the number that each kind has, from one end of its range to the other.
std::vector<ParticleParams> fiveOf(const ParticleKind& kind) {
  std::vector<ParticleParams> result;
  for (const double t : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    ParticleParams params;
    if (kind.diameter_um.high > 0) {
      params.diameter_um =
          kind.diameter_um.low * std::pow(kind.diameter_um.high / kind.diameter_um.low, t);
    }
    params.spread = kind.spread.initial;
    params.roughness = std::lerp(kind.roughness.low, kind.roughness.high, t);
    params.asymmetry = std::lerp(-0.95, 0.95, t);
    result.push_back(params);
  }
  return result;
}

// The integral of the curve's pieces, added up independently.
double integralOf(const PhaseCurve& curve, size_t channel) {
  long double sum = 0;
  for (size_t i = 0; i + 1 < curve.y.size(); ++i) {
    const auto width = static_cast<long double>(curve.y[i + 1]) - curve.y[i];
    sum +=
        width * (static_cast<long double>(curve.value[channel][i]) + curve.value[channel][i + 1]);
  }
  return static_cast<double>(std::numbers::pi_v<long double> * sum);
}

TEST(Catalogue, EveryKindIsNormalisedPositiveAndFinite) {
  const std::vector<double> angle = {0, 1, PI};
  const std::vector<double> phase = {9, 8, 7, 1, 2, 3, 0, 4, 1};
  for (size_t k = 0; k < PARTICLE_TYPES; ++k) {
    const auto type = static_cast<ParticleType>(k);
    for (ParticleParams params : fiveOf(particleKind(type))) {
      params.userAngle = angle;
      params.userPhase = phase;
      for (const double wavelength : {0.0, 0.5}) {
        params.wavelength_um = wavelength;
        const Particle particle = particleKind(type).make(params);
        const std::string label = particleKind(type).name + std::string(" ") +
                                  std::to_string(params.diameter_um) + " " +
                                  std::to_string(params.roughness);
        for (size_t c = 0; c < RGB; ++c) {
          EXPECT_NEAR(integralOf(particle.curve, c), 1, 1e-6) << label;
          for (int i = 0; i <= 3600; ++i) {
            const double p = at(particle, c, i * 0.05);
            ASSERT_TRUE(std::isfinite(p) && p >= 0) << label << " at " << i * 0.05;
          }
          EXPECT_GE(particle.optics.delta[c], 0) << label;
          EXPECT_LT(particle.optics.delta[c], 1) << label;
          EXPECT_TRUE(std::isfinite(particle.optics.efficiency[c])) << label;
          EXPECT_GE(particle.optics.efficiency[c], 0) << label;
          if (wavelength > 0 && type != ParticleType::User) {
            EXPECT_EQ(particle.curve.value[c], particle.curve.value[0]) << label;
            EXPECT_EQ(particle.optics.efficiency[c], particle.optics.efficiency[0]) << label;
            EXPECT_EQ(particle.optics.delta[c], particle.optics.delta[0]) << label;
          }
        }
      }
    }
  }
}

}  // namespace
