// SPDX-License-Identifier: MIT
// What SkyField's moments scatter along many rays at once: those of one view direction and all suns
// of the table. Loops have a known length over arrays of their own, for the compiler to vectorise.
// Unit of the moments.
#pragma once

#include "tables/sky_ray.hpp"

namespace welkin {

// One number for each sun of the table.
using Suns = std::array<float, SkyField::SUNS>;

// Rays of one altitude and direction: cosines between view and sun, and light towards the origin.
struct SkyFan {
  Suns viewSun;
  std::array<Lanes, SkyField::SUNS> radiance;
};

// The frame of the moments at one step along the rays: the view's horizontal component towards the
// light, and between which nodes the sun stands.
struct SkyPlaces {
  Suns x;
  Suns share;  // of the next node
  std::array<int, SkyField::SUNS> node;
};

// Cosines of the sun's zenith angles at a step. As placeAt().
inline Suns sunsAt(const SkyStep& step, float radius, const Suns& sunMu, const Suns& viewSun) {
  const float scale = 1 / step.radius;
  Suns mu;
  for (size_t s = 0; s < SkyField::SUNS; ++s) {
    mu[s] = std::clamp((radius * sunMu[s] + step.distance * viewSun[s]) * scale, -1.0F, 1.0F);
  }
  return mu;
}

// Loops of their own: std::sqrt may set errno, which keeps them from being vectorised.
inline void takeRoots(Suns& values) {
  for (float& one : values) {
    one = std::sqrt(std::max(one, 0.0F));
  }
}

// y, flat: the view's vertical and horizontal components at the step.
inline SkyPlaces placesOf(const Suns& mu, const Suns& viewSun, float y, float flat) {
  constexpr size_t SUNS = SkyField::SUNS;
  constexpr float MIDDLE = 0.5F * (SUNS - 1);
  Suns sine;
  Suns offset;
  for (size_t s = 0; s < SUNS; ++s) {
    sine[s] = (1 - mu[s]) * (1 + mu[s]);
    offset[s] = std::abs(mu[s]);
  }
  takeRoots(sine);
  SkyPlaces places;
  for (size_t s = 0; s < SUNS; ++s) {
    const float x = (viewSun[s] - mu[s] * y) / std::max(sine[s], 1e-4F);
    places.x[s] = std::clamp(x, -flat, flat);
    // As SkyAxes::sunCoordinate(), from the middle: float keeps more digits of the share.
    constexpr auto BEND = static_cast<float>(SkyAxes::SUN_BEND);
    const float from = (MIDDLE * (1 + BEND)) * mu[s] / (BEND + offset[s]);
    const int node = std::min(static_cast<int>(MIDDLE + from), static_cast<int>(SUNS) - 2);
    places.node[s] = node;
    places.share[s] = std::max(from - (static_cast<float>(node) - MIDDLE), 0.0F);
  }
  return places;
}

// What a step scatters towards the eye, for each sun: as y is given and z^2 = flat^2 - x^2, the
// moments enter as a polynomial of second degree in x. Its coefficients, that of x^2 first.
using SkySource = std::array<std::array<float, 3 * LANES>, SkyField::SUNS>;

// The moments for one sun, a share of the way from one altitude to the next.
inline std::array<float, VALUES> blendedMoments(const float* low, float share) {
  const float* high = low + SkyField::SUNS * VALUES;
  std::array<float, VALUES> m;
  for (size_t i = 0; i < VALUES; ++i) {
    m[i] = (1 - share) * low[i] + share * high[i];
  }
  return m;
}

// As gatherMoments() with Rayleigh's phase function, `low` the moments of the altitude below.
inline void airSource(const float* low, const SkyStep& step, float y, float flat,
                      SkySource& source) {
  const auto share = static_cast<float>(step.high.share);
  const Lanes air = step.air;
  for (size_t s = 0; s < SkyField::SUNS; ++s) {
    const std::array<float, VALUES> m = blendedMoments(low + s * VALUES, share);
    std::array<float, 3 * LANES> result;
    for (size_t c = 0; c < LANES; ++c) {
      const float xx = m[c];
      const float yy = m[LANES + c];
      const float zz = m[2 * LANES + c];
      const float xy = m[3 * LANES + c];
      const float scale = air[c] * RAYLEIGH;
      result[c] = scale * (xx - zz);
      result[LANES + c] = scale * (2 * y * xy);
      result[2 * LANES + c] = scale * (xx + (1 + y * y) * yy + (1 + flat * flat) * zz);
    }
    source[s] = result;
  }
}

// The same with two Legendre terms.
inline void fogSource(const float* low, const SkyStep& step, const FogTerms& terms, float y,
                      float flat, SkySource& source) {
  const auto share = static_cast<float>(step.high.share);
  const Lanes fog = step.fog;
  const FogTerms chi = terms;
  for (size_t s = 0; s < SkyField::SUNS; ++s) {
    const std::array<float, VALUES> m = blendedMoments(low + s * VALUES, share);
    std::array<float, 3 * LANES> result;
    for (size_t c = 0; c < LANES; ++c) {
      const float xx = m[c];
      const float yy = m[LANES + c];
      const float zz = m[2 * LANES + c];
      const float xy = m[3 * LANES + c];
      const float mean = xx + yy + zz;
      const float scale = fog[c] * ISOTROPIC;
      const float first = chi.first[c];
      const float second = chi.second[c];
      result[c] = scale * (3 * second * (xx - zz));
      result[LANES + c] = scale * (6 * second * y * xy + first * m[4 * LANES + c]);
      result[2 * LANES + c] = scale * ((1 - second) * mean + first * y * m[5 * LANES + c] +
                                       3 * second * (y * y * yy + flat * flat * zz));
    }
    source[s] = result;
  }
}

// In the direction x, a share of the way from one node to the next.
inline Lanes sourceAt(const SkySource& source, size_t node, float share, float x) {
  const float* a = source[node].data();
  const float* b = source[node + 1].data();
  Lanes result;
  for (size_t c = 0; c < LANES; ++c) {
    const float low = (a[c] * x + a[LANES + c]) * x + a[2 * LANES + c];
    const float high = (b[c] * x + b[LANES + c]) * x + b[2 * LANES + c];
    result[c] = low + share * (high - low);
  }
  return result;
}

inline void addAir(const SkySource& source, const SkyPlaces& places, SkyFan& fan) {
  for (size_t s = 0; s < SkyField::SUNS; ++s) {
    const auto node = static_cast<size_t>(places.node[s]);
    const Lanes light = sourceAt(source, node, places.share[s], places.x[s]);
    for (size_t c = 0; c < LANES; ++c) {
      fan.radiance[s][c] += light[c];
    }
  }
}

inline void addFog(const SkySource& source, const SkyPlaces& places, SkyFan& fan) {
  for (size_t s = 0; s < SkyField::SUNS; ++s) {
    const auto node = static_cast<size_t>(places.node[s]);
    const Lanes light = sourceAt(source, node, places.share[s], places.x[s]);
    for (size_t c = 0; c < LANES; ++c) {
      fan.radiance[s][c] += std::max(light[c], 0.0F);
    }
  }
}

}  // namespace welkin
