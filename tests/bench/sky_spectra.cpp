// SPDX-License-Identifier: MIT
#include "bench/sky_spectra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/evaluate.hpp"
#include "reference/random.hpp"
#include "tables/sky_field.hpp"

namespace bench {
namespace {

using rt::Rgb;
using rt::SPECTRUM;
using rt::SPECTRUM_BINS;

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;
constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double PLANET_RADIUS = 6.371e6;
constexpr double SUN_RADIUS = 0.00466;
// 2.687e20 molecules per m^2, in a layer whose column is 15 km of its densest air.
constexpr double DOBSON_UNIT = 2.687e20 / 15000;

constexpr Atmosphere ATMOSPHERES[] = {{"clear", 300, 0, 1200, 0.1, true},
                                      {"hazy", 300, 3e-5, 1200, 0.1, true},
                                      {"clear", 350, 0, 1200, 0.3, false},
                                      {"no ozone", 0, 0, 1200, 0.1, false},
                                      {"thick haze", 300, 1e-4, 1000, 0.2, false}};

constexpr Group GROUPS[] = {{"sky, sun 10..90", Kind::Sky, 10, 90, 2, 12e3, 80},
                            {"sky, sun 0..10", Kind::Sky, 0, 10, 2, 12e3, 80},
                            {"twilight, sun -6..0", Kind::Sky, -6, 0, 2, 12e3, 80},
                            {"sky from 20 to 400 km", Kind::Sky, 0, 90, 20e3, 400e3, 80},
                            {"air before surfaces, 1 to 50 km", Kind::Aerial, 2, 90, 2, 12e3, 80},
                            {"sunlight through air", Kind::Sunlight, 0, 90, 2, 12e3, 80},
                            {"grey surface through 1 to 50 km", Kind::Seen, 90, 90, 2, 12e3, 80}};

struct Ray {
  size_t group;
  double altitude;
  double viewMu;
  double sunMu;
  double viewSun;
  double distance;
};

// Scattering and absorption of air at three wavelengths at once, which is what the model takes.
struct Wavelengths {
  Rgb air;
  Rgb ozone;  // per Dobson unit
};

Ray drawRay(size_t group, rt::Random& random) {
  const Group& g = GROUPS[group];
  Ray ray{};
  ray.group = group;
  const double height = random.uniform();
  // The Sun's own light changes colour near the horizon.
  const double share = g.kind == Kind::Sunlight ? height * height : height;
  const double sun_deg = g.sunLow_deg + (g.sunHigh_deg - g.sunLow_deg) * share;
  const bool standing = random.uniform() < 0.5 && g.lowest == 2;
  ray.altitude = standing ? 2 : g.lowest * std::pow(g.highest / g.lowest, random.uniform());
  const double azimuth = 2 * PI * random.uniform();
  const double u = random.uniform();
  const double dip_deg = std::acos(PLANET_RADIUS / (PLANET_RADIUS + ray.altitude)) / DEGREE;
  double view_deg = -dip_deg + (90 + dip_deg) * u * u;
  ray.distance = INF;
  if (g.lowest > 2) {
    // The planet and its limb.
    view_deg = -90 + (95 - dip_deg) * u;
  }
  if (g.kind == Kind::Aerial || g.kind == Kind::Seen) {
    view_deg = -30 + 60 * u;
    ray.distance = 1000 * std::pow(50, random.uniform());
  }
  if (g.kind == Kind::Sunlight) {
    view_deg = sun_deg;
  }
  ray.viewMu = std::sin(view_deg * DEGREE);
  ray.sunMu = std::sin(sun_deg * DEGREE);
  ray.viewSun = ray.viewMu * ray.sunMu +
                std::cos(view_deg * DEGREE) * std::cos(sun_deg * DEGREE) * std::cos(azimuth);
  const double ground = welkin::evalGroundDistance(ray.altitude, ray.viewMu, PLANET_RADIUS);
  if (ground >= 0) {
    ray.distance = std::min(ray.distance, ground);
  }
  return ray;
}

welkin::SkyFieldInput inputFor(const Atmosphere& atmosphere, const Wavelengths& wavelengths) {
  welkin::SkyFieldInput input;
  input.air.planetRadius = PLANET_RADIUS;
  for (size_t c = 0; c < 3; ++c) {
    input.air.airScattering[c] = wavelengths.air[c];
    input.air.absorption[c] = atmosphere.ozone_DU * wavelengths.ozone[c];
    input.air.fogAlbedo[c] = HAZE_ALBEDO;
  }
  input.groundAlbedo.fill(atmosphere.groundAlbedo);
  input.lightAngularRadius = SUN_RADIUS;
  input.air.fogExtinction = atmosphere.hazeExtinction;
  input.air.fogScaleHeight = atmosphere.hazeHeight;
  for (size_t l = 0; l < welkin::FOG_TERMS && atmosphere.hazeExtinction > 0; ++l) {
    input.fogMoments[l].fill(std::pow(HAZE_G, l + 1));
  }
  return input;
}

double henyeyGreenstein(double cosine) {
  const double base = 1 + HAZE_G * HAZE_G - 2 * HAZE_G * cosine;
  return (1 - HAZE_G * HAZE_G) / (4 * PI * base * std::sqrt(base));
}

// Light that air and haze scatter, all orders, or what they leave of light that passes.
Rgb bring(const Ray& ray, const welkin::SkyFieldInput& input, const welkin::SkyField& field) {
  const Kind kind = GROUPS[ray.group].kind;
  Rgb result{};
  if (kind == Kind::Sunlight || kind == Kind::Seen) {
    double depth[3];
    welkin::evalAirDepth(input.air, ray.altitude, ray.viewMu, ray.distance, depth);
    for (size_t c = 0; c < 3; ++c) {
      result[c] = std::exp(-depth[c]);
    }
    return result;
  }
  welkin::SkyColor phase{};
  phase.fill(henyeyGreenstein(ray.viewSun));
  double once[3];
  double depth[3];
  welkin::evalAirRay(input.air, ray.altitude, ray.viewMu, ray.sunMu, ray.viewSun, ray.distance,
                     phase.data(), SUN_RADIUS, once, depth);
  const welkin::SkyField::Parts more =
      field.higherOrders(ray.altitude, ray.viewMu, ray.sunMu, ray.viewSun, ray.distance, phase);
  for (size_t c = 0; c < 3; ++c) {
    result[c] = once[c] + more.air[c];
  }
  return result;
}

Wavelengths binsFrom(size_t first) {
  Wavelengths result{};
  for (size_t c = 0; c < 3; ++c) {
    const rt::SpectralBin& bin = SPECTRUM[std::min(first + c, SPECTRUM_BINS - 1)];
    result.air[c] = referenceScattering(bin.wavelength_nm);
    result.ozone[c] = DOBSON_UNIT * bin.ozone;
  }
  return result;
}

Wavelengths welkinWavelengths(Rgb ozone) {
  for (double& value : ozone) {
    value /= 300;
  }
  return {WELKIN_AIR, ozone};
}

}  // namespace

void addSamples(const Atmosphere& atmosphere, uint64_t seed, std::vector<Sample>& samples) {
  const size_t begin = samples.size();
  std::vector<Ray> rays;
  for (size_t g = 0; g < std::size(GROUPS); ++g) {
    for (size_t i = 0; i < GROUPS[g].rays; ++i) {
      rt::Random random(seed, g, i, 0);
      rays.push_back(drawRay(g, random));
      samples.push_back({g, &atmosphere, {}, {}, {}, {}});
    }
  }
  const auto evaluate = [&](const Wavelengths& wavelengths, auto&& store) {
    const welkin::SkyFieldInput input = inputFor(atmosphere, wavelengths);
    const welkin::SkyField field = welkin::solveSkyField(input);
    for (size_t i = 0; i < rays.size(); ++i) {
      store(samples[begin + i], bring(rays[i], input, field));
    }
  };
  evaluate(welkinWavelengths(WELKIN_OZONE),
           [](Sample& sample, const Rgb& value) { sample.stated = value; });
  evaluate(welkinWavelengths(BAND_OZONE),
           [](Sample& sample, const Rgb& value) { sample.banded = value; });
  for (size_t first = 0; first < SPECTRUM_BINS; first += 3) {
    evaluate(binsFrom(first), [first](Sample& sample, const Rgb& value) {
      for (size_t c = 0; c < 3 && first + c < SPECTRUM_BINS; ++c) {
        sample.share[first + c] = value[c];
      }
    });
  }
  for (size_t i = begin; i < samples.size(); ++i) {
    samples[i].truth = rt::linearSrgbOf(rt::sunlightOf(samples[i].share));
  }
}

double referenceScattering(double wavelength_nm) {
  double low = INF;
  double high = 0;
  for (size_t c = 0; c < 3; ++c) {
    const double ratio = WELKIN_AIR[c] / rt::rayleighCrossSection(WELKIN_nm[c]);
    low = std::min(low, ratio);
    high = std::max(high, ratio);
  }
  return std::sqrt(low * high) * rt::rayleighCrossSection(wavelength_nm);
}

std::span<const Atmosphere> atmospheres() {
  return ATMOSPHERES;
}

std::span<const Group> groups() {
  return GROUPS;
}

}  // namespace bench
