// SPDX-License-Identifier: MIT
// Random rays, deterministic, of one height over a planet, that tests of its sky look along. m,
// rad.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "reference/globe.hpp"
#include "reference/planet.hpp"

namespace welkin::reference {

struct SkyCase {
  Planet planet;
  PlanetRay ray;
  double fogPhase;  // Henyey and Greenstein 1941, 1/sr; 0 without fog
};

class SkyRays {
 public:
  SkyRays(const Planet& planet, double altitude) : planet_(planet), altitude_(altitude) {}

  // Any direction, the whole upper sky, and 10 degrees about the horizon in turn; from space half
  // of the rays pass the limb below 60 km and half meet the ground. Every fourth looks towards the
  // sun and every fourth away from it, within 10 degrees. The sun stands at `zenith` degrees at the
  // eye, but from space where the ray is lowest. Rays end at the ground.
  SkyCase next(double zenith, double length) {
    SkyCase sky{planet_, {}, 0.0};
    const double r = planet_.radius + altitude_;
    sky.ray.altitude = altitude_;
    sky.ray.viewMu = viewMu(r);
    const double ground = Climb{altitude_, sky.ray.viewMu, 1 / r}.ground();
    sky.ray.length = std::min(length, ground);

    const double across = sine(sky.ray.viewMu);
    const bool meets = ground < FAR;
    const double t = !space() ? 0.0 : meets ? ground : -r * sky.ray.viewMu;
    const double there = !space() ? r : meets ? planet_.radius : r * across;
    const double mu = std::clamp((r * sky.ray.viewMu + t) / there, -1.0, 1.0);
    const double sun = std::cos(zenith * DEGREE);
    const double azimuth = (count_ % 4 == 0   ? uniform(-10.0, 10.0)
                            : count_ % 4 == 1 ? uniform(170.0, 190.0)
                                              : uniform(0.0, 360.0)) *
                           DEGREE;
    sky.ray.viewLight = std::clamp(mu * sun + sine(mu) * sine(sun) * std::cos(azimuth), -1.0, 1.0);
    sky.ray.lightMu = std::clamp((there * sun - t * sky.ray.viewLight) / r, -1.0, 1.0);
    if (planet_.fogExtinction > 0.0) {
      constexpr double G = 0.76;
      sky.fogPhase = (1 - G * G) / (4 * std::numbers::pi) *
                     std::pow(1 + G * G - 2 * G * sky.ray.viewLight, -1.5);
    }
    ++count_;
    return sky;
  }
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(generator_);
  }

 private:
  static constexpr double DEGREE = std::numbers::pi / 180.0;

  bool space() const { return altitude_ > 5e4; }
  static double sine(double cosine) { return std::sqrt((1 - cosine) * (1 + cosine)); }

  double viewMu(double r) {
    const double radius = planet_.radius;
    if (space()) {
      const double lowest =
          count_ / 4 % 2 == 0 ? radius + uniform(0.0, 6e4) : radius * std::sqrt(uniform(0.0, 1.0));
      return -sine(std::min(lowest / r, 1.0));
    }
    const double horizon = std::numbers::pi - std::asin(radius / r);
    const int kind = count_ / 4 % 3;
    return kind == 0   ? uniform(-1.0, 1.0)
           : kind == 1 ? std::cos(uniform(0.0, horizon))
                       : std::cos(horizon + uniform(-10.0, 10.0) * DEGREE);
  }

  Planet planet_;
  double altitude_;
  int count_ = 0;
  std::mt19937 generator_{1871};
};

}  // namespace welkin::reference
