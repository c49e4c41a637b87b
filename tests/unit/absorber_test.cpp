// SPDX-License-Identifier: MIT
// A gas that absorbs and does not scatter, in the air of shaders/model/sky/air.glsl: columns and
// once-scattered light against quadrature on the sphere, from below the sea to a geostationary
// orbit, by day and in twilight.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "model/air_input.hpp"
#include "reference/sky_rays.hpp"
#include "unit/sky_model.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
namespace ref = welkin::reference;
using welkin::test::ErrorSample;
using welkin::test::relativeError;

constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double SUN_RADIUS = 0.00465;  // rad

// The promise of sky_heights_test.cpp, which ozone must not break: relative, of the worst channel
// among those above DARK of the irradiance per sr.
constexpr double DARK = 1e-5;
constexpr double DAY_P95 = 5e-3;  // suns to 80 degrees from the zenith
constexpr double DAY_MAX = 2e-2;
constexpr double LOW_P95 = 1e-2;   // 88 degrees
constexpr double DUSK_P90 = 5e-2;  // 92 degrees

// Of the radiance of the brightest channel; a tenth of the tightest promise is 5e-4.
constexpr double TRUTH = 5e-5;

// 300 Dobson units at 680, 550 and 440 nm: the layer takes 2.8 % of a vertical ray's light in green
// and two thirds of that of a ray whose lowest point is at 25 km.
ref::Planet ozonePlanet(bool hazy) {
  ref::Planet planet;
  planet.absorption = {2.7e-6, 1.7e-6, 8.5e-8};
  if (hazy) {
    planet.fogExtinction = 2.5e-5;
    planet.fogScaleHeight = 1200.0;
    planet.fogAlbedo = {0.9, 0.9, 0.9};
  }
  return planet;
}

// The gas alone, so that depths are its columns.
ref::Planet gasPlanet(double peak, double width, double radius) {
  ref::Planet planet;
  planet.radius = radius;
  planet.airScattering = {0.0, 0.0, 0.0};
  planet.absorption = {1.0, 1.0, 1.0};
  planet.absorberPeak = peak;
  planet.absorberWidth = width;
  return planet;
}

void report(const char* name, ErrorSample& sample) {
  std::printf("  %s: median %.2e, p90 %.2e, p95 %.2e, max %.2e of %zu\n", name, sample.median(),
              sample.quantile(0.9), sample.p95(), sample.max(), sample.count());
}

// Heights that cameras have, and where the gas is.
double anyAltitude(ref::SkyRays& random, double lowest) {
  const double kind = random.uniform(0.0, 3.0);
  return kind < 1.0   ? random.uniform(lowest, 500.0)
         : kind < 2.0 ? random.uniform(0.0, 6e4)
                      : std::exp(random.uniform(std::log(6e4), std::log(3.6e7)));
}

// Any direction, or, as from far away no other meets the air, one whose lowest point is below
// 60 km.
double anyMu(ref::SkyRays& random, double radius, double altitude) {
  const double low = (radius + random.uniform(-500.0, 6e4)) / (radius + altitude);
  return low < 1.0 && random.uniform(0.0, 1.0) < 0.6 ? -std::sqrt((1.0 - low) * (1.0 + low))
                                                     : random.uniform(-1.0, 1.0);
}

constexpr double EARTH = 6.371e6;
struct Tent {
  double peak, width;
  double radius = EARTH;
};
// Ozone; layers that reach down to the sea, high up, thin, and cut in half by the sea; around a
// body that is little larger than its layer.
constexpr Tent TENTS[] = {{25000, 15000}, {15000, 15000}, {80000, 20000},
                          {1000, 100},    {0, 30000},     {30000, 30000, 1e5}};

// r + a is taken as constant (absorber.glsl), at a mean, so that its change through the layer,
// twice the width in twice the radius, counts by its square: in each of two ramps. Of the column,
// or of the vertical one if that is more: a ray that only touches the layer has little of it.
double allowedError(const Tent& tent) {
  constexpr double RAMPS = 2.0;
  const double change = tent.width / (tent.radius + tent.peak + tent.width);
  return RAMPS * change * change;
}

double columnError(double value, double truth, double width) {
  return std::fabs(value - truth) / std::max(truth, width);
}

class AbsorberDepth : public testing::TestWithParam<Tent> {};

TEST_P(AbsorberDepth, AlongARayMatchesQuadrature) {
  const auto [peak, width, radius] = GetParam();
  const double allowed = allowedError(GetParam());
  const ref::Planet planet = gasPlanet(peak, width, radius);
  ref::SkyRays random(planet, 0.0);
  ErrorSample errors;
  ErrorSample segments;
  for (int i = 0; i < 4000; ++i) {
    ref::PlanetRay ray{};
    // Below the sea there is none of it.
    ray.altitude = anyAltitude(random, peak < width ? 0.0 : -500.0);
    ray.viewMu = anyMu(random, planet.radius, ray.altitude);
    ray.lightMu = 1.0;
    ray.viewLight = ray.viewMu;
    ray.length = i % 3 == 0 ? std::exp(random.uniform(std::log(10.0), std::log(1e8))) : INF;
    // From below the sea rays end 1000 m deep (UNDERGROUND).
    const double above = ray.altitude + (ray.altitude < 0.0 ? 1000.0 : 0.0);
    const ref::Climb climb{above, ray.viewMu, 1.0 / (planet.radius + ray.altitude)};
    ray.length = std::min(ray.length, climb.ground());
    const double truth = ref::columns(planet, ray.altitude, ray.viewMu, ray.length).absorber;
    const f64::vec3 depth = f64::airOpticalDepth(air64(planet), ray64(ray), ray.length);
    const f64::AirResult along =
        f64::airAlongRay(air64(planet), ray64(ray), ray.length, 0.0, 0.0, SUN_RADIUS);
    errors.add(columnError(depth.y, truth, width));
    segments.add(columnError(along.opticalDepth.y, truth, width));
  }
  report("column", errors);
  report("column, segments", segments);
  EXPECT_LE(errors.max(), allowed);
  EXPECT_LE(segments.max(), allowed);
}

TEST_P(AbsorberDepth, ToTheLightMatchesQuadratureDownToTheHorizon) {
  const auto [peak, width, radius] = GetParam();
  const double allowed = allowedError(GetParam());
  const ref::Planet planet = gasPlanet(peak, width, radius);
  ref::SkyRays random(planet, 0.0);
  ErrorSample errors;
  for (int i = 0; i < 4000; ++i) {
    const double altitude = anyAltitude(random, peak < width ? 0.0 : -500.0);
    const double low = planet.radius / (planet.radius + std::max(altitude, 0.0));
    const double horizon = -std::sqrt((1.0 - low) * (1.0 + low));
    const double mu = std::max(anyMu(random, planet.radius, altitude), horizon + 1e-9);
    const double truth = ref::columns(planet, altitude, mu, INF).absorber;
    const double depth = f64::lightOpticalDepth(air64(planet), altitude, mu).y;
    errors.add(columnError(depth, truth, width));
  }
  report("column to the light", errors);
  EXPECT_LE(errors.max(), allowed);
}

INSTANTIATE_TEST_SUITE_P(Layers, AbsorberDepth, testing::ValuesIn(TENTS));

class OzoneFrom : public testing::TestWithParam<double> {};

void add(ErrorSample& errors, const ref::SkyCase& sky) {
  const std::array<double, 3> truth =
      ref::inscatter(sky.planet, sky.ray, airPhase(sky.ray), sky.fogPhase, SUN_RADIUS, TRUTH);
  const f64::AirResult result = f64::airAlongRay(air64(sky.planet), ray64(sky.ray), sky.ray.length,
                                                 airPhase(sky.ray), sky.fogPhase, SUN_RADIUS);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(result.radiance[k], 0.0);
    EXPECT_TRUE(std::isfinite(result.radiance[k]));
  }
  if (*std::max_element(truth.begin(), truth.end()) > DARK) {
    errors.add(radianceError(result.radiance, truth, DARK));
  }
}

constexpr int RAYS = 20;  // of each sun and atmosphere

TEST_P(OzoneFrom, HoldsThePromisedErrors) {
  ErrorSample day;
  ErrorSample low;
  ErrorSample dusk;
  for (const bool hazy : {false, true}) {
    ref::SkyRays rays(ozonePlanet(hazy), GetParam());
    for (int i = 0; i < RAYS; ++i) {
      add(day, rays.next(i % 2 == 0 ? 80.0 : rays.uniform(0.0, 80.0), INF));
      add(low, rays.next(88.0, INF));
      add(dusk, rays.next(92.0, INF));
    }
  }
  report("sun to 80", day);
  report("sun at 88", low);
  report("sun at 92", dusk);
  EXPECT_LE(day.p95(), DAY_P95);
  EXPECT_LE(day.max(), DAY_MAX);
  EXPECT_LE(low.p95(), LOW_P95);
  EXPECT_LE(dusk.quantile(0.9), DUSK_P90);
}

// From 36 000 km a float ray is the host's to move to the air (sky_heights_test.cpp).
TEST_P(OzoneFrom, FloatFollowsDouble) {
  constexpr double BRIGHT = 1e-6;
  constexpr double FLOAT = 1e-4;
  ErrorSample errors;
  for (const bool hazy : {false, true}) {
    ref::SkyRays rays(ozonePlanet(hazy), GetParam());
    for (int i = 0; i < 2000; ++i) {
      ref::SkyCase sky = rays.next(rays.uniform(0.0, 88.0), i % 3 == 0 ? 5e4 : INF);
      const f32::AirRay ray = ray32(sky.ray);
      const auto length = static_cast<float>(sky.ray.length);
      sky.ray = {ray.altitude, ray.viewMu, ray.sunMu, ray.viewSun, length};
      const f64::AirResult a = f64::airAlongRay(air64(sky.planet), ray64(sky.ray), sky.ray.length,
                                                0.1, sky.fogPhase, SUN_RADIUS);
      const f32::AirResult b =
          f32::airAlongRay(air32(sky.planet), ray, length, 0.1F, static_cast<float>(sky.fogPhase),
                           static_cast<float>(SUN_RADIUS));
      for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(std::isfinite(b.radiance[k]) && b.radiance[k] >= 0.0F) << i;
        if (a.radiance[k] > BRIGHT) {
          errors.add(relativeError(b.radiance[k], a.radiance[k]));
        }
      }
    }
  }
  if (GetParam() < 1e6) {
    report("float", errors);
    EXPECT_LE(errors.max(), FLOAT);
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, OzoneFrom, testing::Values(0.0, 2.0, 1.2e4, 1e5, 3.6e7));

// A layer of any size around a planet of any size.
template <typename Air, typename Ray, typename T>
void expectFinite(const Air& air, T altitude, T mu, T sun, T distance) {
  Ray ray;
  ray.altitude = altitude;
  ray.viewMu = mu;
  ray.sunMu = sun;
  ray.viewSun = mu * sun + std::sqrt((1 - mu * mu) * (1 - sun * sun));
  const auto r = airAlongRay(air, ray, distance, static_cast<T>(0.1), static_cast<T>(1),
                             static_cast<T>(0.005));
  const auto depth = airOpticalDepth(air, ray, distance);
  const auto light = lightOpticalDepth(air, altitude, sun);
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(r.radiance[k] >= 0 && r.radiance[k] < T(1.5) && r.opticalDepth[k] >= 0 &&
                std::isfinite(r.opticalDepth[k]) && depth[k] >= 0 && std::isfinite(depth[k]) &&
                light[k] >= 0 && std::isfinite(light[k]))
        << "peak " << air.absorberPeak << " width " << air.absorberWidth << " R "
        << air.planetRadius << " h " << altitude << " mu " << mu << " sun " << sun << " K "
        << distance << ": L " << r.radiance[k] << " tau " << r.opticalDepth[k] << " " << depth[k]
        << " " << light[k];
  }
}

TEST(Absorber, IsFiniteAndNeverNegativeAnywhere) {
  for (const double peak : {0.0, 25000.0, 1e5}) {
    for (const double width : {100.0, 15000.0, 1e5, 1e7}) {
      for (const double radius : {1e4, 6.371e6, 1e9}) {
        ref::Planet planet;
        planet.radius = radius;
        planet.fogExtinction = 1e-5;
        planet.absorption = {1e-7, 1e-4, 1.0};
        planet.absorberPeak = peak;
        planet.absorberWidth = width;
        for (const float altitude : {-500.0F, 0.0F, 2.0F, 12000.0F, 1e5F, 3.6e7F, 1e9F}) {
          for (const float mu : {-1.0F, -0.9F, -0.1F, -1e-4F, 0.0F, 1e-6F, 0.1F, 1.0F}) {
            for (const float sun : {-1.0F, -0.5F, -0.03F, 0.0F, 1e-3F, 0.3F, 1.0F}) {
              for (const float distance : {1e-3F, 1e4F, 1e9F, static_cast<float>(INF)}) {
                expectFinite<f32::Air, f32::AirRay, float>(air32(planet), altitude, mu, sun,
                                                           distance);
                expectFinite<f64::Air, f64::AirRay, double>(
                    air64(planet), double{altitude}, double{mu}, double{sun}, double{distance});
                if (HasFatalFailure()) {
                  return;
                }
              }
            }
          }
        }
      }
    }
  }
}

// Bit for bit, wherever the layer that is not there would be.
TEST(Absorber, OfNoAbsorptionChangesNothing) {
  welkin::AirInput none;
  std::copy_n(ozonePlanet(false).airScattering.begin(), 3, none.airScattering);
  none.airScaleHeight = 1000.0;  // its top is below that of some of the layers
  none.fogExtinction = 2.5e-5;
  none.fogScaleHeight = 300.0;
  for (const Tent& tent : TENTS) {
    welkin::AirInput input = none;
    input.absorberPeak = tent.peak;
    input.absorberWidth = tent.width;
    for (const double altitude : {0.0, 2.0, 12000.0, 3.6e7}) {
      ref::SkyRays rays(ref::Planet{}, altitude);
      for (int i = 0; i < 200; ++i) {
        const ref::SkyCase sky = rays.next(rays.uniform(0.0, 95.0), i % 2 == 0 ? INF : 5e4);
        const f64::AirRay ray = ray64(sky.ray);
        const f64::AirResult a =
            f64::airAlongRay(welkin::airFrom(none), ray, sky.ray.length, 0.1, 0.2, SUN_RADIUS);
        const f64::AirResult b =
            f64::airAlongRay(welkin::airFrom(input), ray, sky.ray.length, 0.1, 0.2, SUN_RADIUS);
        for (int k = 0; k < 3; ++k) {
          ASSERT_EQ(a.radiance[k], b.radiance[k]);
          ASSERT_EQ(a.opticalDepth[k], b.opticalDepth[k]);
        }
      }
    }
  }
}

}  // namespace
