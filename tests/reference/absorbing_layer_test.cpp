// SPDX-License-Identifier: MIT
// A layer that absorbs and does not scatter: columns of both references against their closed form,
// light through it against exact limits, quadrature and particles with an albedo.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/layers.hpp"
#include "reference/monte_carlo.hpp"
#include "reference/planet.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double ERRORS = 3.5;  // standard errors; seeds are fixed

struct Tent {
  double radius, peak, halfWidth;
};
// Ozone of the Earth, from the ground up, cut by the ground, thin, and thick around small planets.
constexpr Tent TENTS[] = {{6.371e6, 25000, 15000}, {6.371e6, 15000, 15000}, {6.371e6, 0, 30000},
                          {6.371e6, 2000, 9000},   {6.371e6, 1000, 100},    {1e5, 4000, 3000},
                          {1e5, 2000, 8000}};

Planet planetOf(const Tent& tent) {
  Planet planet;
  planet.radius = tent.radius;
  planet.absorption = {1, 1, 1};
  planet.absorberPeak = tent.peak;
  planet.absorberWidth = tent.halfWidth;
  return planet;
}

AbsorbingLayer layerOf(const Tent& tent, double extinction = 1) {
  return {tent.peak, tent.halfWidth, {extinction, extinction, extinction}};
}

// With s the distance from the point nearest the planet's centre, p its radius and r = sqrt(p^2 +
// s^2), the integral of r is (s r + p^2 asinh(s / p)) / 2: so it is of r - a beyond the radius a of
// a knot, and the density is made of three of them and of a step at sea level.
class ClosedColumn {
 public:
  ClosedColumn(const Tent& tent, double altitude, double mu) : tent_(tent) {
    const long double r = static_cast<long double>(tent.radius) + altitude;
    low_ = r * std::sqrt((1.0L - mu) * (1.0L + mu));
    start_ = r * mu;
  }
  double over(double length) const { return static_cast<double>(to(start_ + length) - to(start_)); }

 private:
  long double meets(long double a) const {
    return a > low_ ? std::sqrt((a - low_) * (a + low_)) : 0.0L;
  }
  long double whole(long double s) const {
    const long double turn = low_ > 0 ? low_ * low_ * std::asinh(s / low_) : 0.0L;
    return (s * std::sqrt(low_ * low_ + s * s) + turn) / 2;
  }
  long double beyond(long double s, long double a) const {
    const long double knot = meets(a);
    return s > knot ? whole(s) - whole(knot) - a * (s - knot) : 0.0L;
  }
  // From the lowest point; odd.
  long double to(long double s) const {
    const long double ground = tent_.radius;
    const long double peak = ground + tent_.peak;
    const long double reach = std::min(std::fabs(s), meets(peak + tent_.halfWidth));
    const long double bottom = std::max(peak - tent_.halfWidth, ground);
    const long double step = std::max(tent_.halfWidth - tent_.peak, 0.0);
    const long double sum = beyond(reach, bottom) - 2 * beyond(reach, peak) +
                            step * std::max(reach - meets(ground), 0.0L);
    return (s < 0 ? -sum : sum) / tent_.halfWidth;
  }

  Tent tent_;
  long double low_ = 0;
  long double start_ = 0;
};

template <typename Visit>
void forRays(Visit&& visit) {
  for (const Tent& tent : TENTS) {
    for (const double altitude : {-500.0, 0.0, 2.0, 1500.0, 12000.0, 25000.0, 1e5, 3.6e7}) {
      const double r = tent.radius + altitude;
      std::vector<double> cosines = {-1.0, -0.6, -0.2, -0.03, 0.0, 0.01, 0.3, 1.0};
      for (const double above : {30.0, 11000.0, 24990.0, 25000.0, 39999.0}) {
        const double sine = (tent.radius + above) / r;  // the ray's lowest point
        if (sine < 1) {
          cosines.push_back(-std::sqrt((1 - sine) * (1 + sine)));
        }
      }
      for (const double mu : cosines) {
        for (const double length : {50.0, 2e4, 7e5, 3.7e7, FAR}) {
          visit(tent, altitude, mu, length);
        }
      }
    }
  }
}

// Of a column. An altitude is as good as one rounding of the square of the ray's longest radius,
// and counts against the tent's slopes and the slope at which the ray meets the step at the sea;
// 16 nodes 1e-12.
double tolerance(const Tent& tent, double altitude, double mu, double length) {
  constexpr double FLATTEST = 0.01;
  const double r = tent.radius + altitude;
  const Climb::Interval part = Climb{altitude, mu, 1 / r}.below(tent.peak + tent.halfWidth);
  const double inside = std::max(std::min(part.end, length) - part.begin, 0.0);
  const double rounding = 2 * 0x1p-53 * r * r / tent.radius;
  return rounding * (inside / tent.halfWidth + 1 / FLATTEST) + 1e-12 * inside;
}

TEST(AbsorberReference, ColumnIsItsClosedForm) {
  forRays([](const Tent& tent, double altitude, double mu, double length) {
    EXPECT_NEAR(columns(planetOf(tent), altitude, mu, length).absorber,
                ClosedColumn(tent, altitude, mu).over(length),
                tolerance(tent, altitude, mu, length))
        << tent.radius << " " << tent.peak << " " << altitude << " " << mu << " " << length;
  });
}

TEST(AbsorbingLayer, DepthAgreesWithItsClosedForm) {
  forRays([](const Tent& tent, double altitude, double mu, double length) {
    EXPECT_NEAR(layerOf(tent).opticalDepth({altitude, mu, 1 / (tent.radius + altitude)}, 0, length),
                ClosedColumn(tent, altitude, mu).over(length),
                tolerance(tent, altitude, mu, length))
        << tent.radius << " " << tent.peak << " " << altitude << " " << mu << " " << length;
  });
}

TEST(AbsorbingLayer, HasTheAreaOfItsTentOnAVerticalRay) {
  constexpr double ROUNDING = 1e-12;
  for (const Tent& tent : TENTS) {
    const double cut = std::max(tent.halfWidth - tent.peak, 0.0);  // of the rising side
    const double area = tent.halfWidth - cut * cut / (2 * tent.halfWidth);
    const Planet planet = planetOf(tent);
    const AbsorbingLayer layer = layerOf(tent);
    const double r = 1 / (tent.radius + 3.6e7);
    EXPECT_NEAR(columns(planet, 0, 1, FAR).absorber / area, 1, ROUNDING);
    EXPECT_NEAR(columns(planet, 3.6e7, -1, 3.6e7).absorber / area, 1, 1e-9);  // 1e-9 m of 100 m
    EXPECT_NEAR(columns(planet, 3.6e7, -1, FAR).absorber / area, 2, 1e-9);
    EXPECT_NEAR(layer.opticalDepth({0, 1, 1 / tent.radius}, 0, FAR) / area, 1, ROUNDING);
    EXPECT_NEAR(layer.opticalDepth({0, 1, 0}, 0, FAR) / area, 1, ROUNDING);
    EXPECT_NEAR(layer.opticalDepth({3.6e7, -1, r}, 0, 3.6e7) / area, 1, 1e-9);
    EXPECT_NEAR(layer.opticalDepth({1e5, -0.5, 0}, 0, FAR) / area, 2, ROUNDING);
  }
}

TEST(AbsorbingLayer, IsEmptyAboveItsTopAndBelowTheSea) {
  for (const Tent& tent : TENTS) {
    const Planet planet = planetOf(tent);
    const double top = tent.peak + tent.halfWidth;
    const double sine = (tent.radius + top + 1) / (tent.radius + 1e6);
    const double past = -std::sqrt((1 - sine) * (1 + sine));
    for (const auto& [altitude, mu, length] :
         {std::array{top, 0.0, FAR}, {1e6, past, FAR}, {1e6, 0.3, FAR}, {-400.0, 0.7, 500.0}}) {
      EXPECT_EQ(columns(planet, altitude, mu, length).absorber, 0) << altitude << " " << mu;
      const Climb climb{altitude, mu, 1 / (tent.radius + altitude)};
      EXPECT_EQ(layerOf(tent).opticalDepth(climb, 0, length), 0) << altitude << " " << mu;
    }
  }
}

TEST(AbsorbingLayer, FlatDepthIsExact) {
  const AbsorbingLayer layer = layerOf({FAR, 500, 200}, 0.01);
  constexpr double ROUNDING = 1e-13;
  EXPECT_EQ(layer.opticalDepth({500, 0, 0}, 0, FAR), FAR);
  EXPECT_EQ(layer.opticalDepth({701, 0, 0}, 0, FAR), 0);
  EXPECT_EQ(layer.opticalDepth({299, 0, 0}, 0, FAR), 0);
  EXPECT_NEAR(layer.opticalDepth({400, 0, 0}, 0, 30), 0.01 * 0.5 * 30, ROUNDING);
  EXPECT_NEAR(layer.opticalDepth({400, 0.5, 0}, 0, 200), 0.01 * 0.75 * 200, ROUNDING);
  EXPECT_NEAR(layer.opticalDepth({600, -0.5, 0}, 0, 400), 0.01 * 0.75 * 400, ROUNDING);
  EXPECT_NEAR(layer.opticalDepth({1e4, -0.1, 0}, 0, FAR), 0.01 * 2000, 1e-10);
}

// A plane as far as 1 m in 1e6: light on its way in goes through the whole layer once.
TEST(AbsorberReference, LayerAboveTheAirDimsTheLight) {
  Planet planet;
  planet.radius = 1e12;
  planet.airScaleHeight = 500;
  planet.absorberPeak = 60000;
  planet.absorberWidth = 5000;
  const PlanetRay ray{10, 0.4, 0.5, 0.3, FAR};
  constexpr double TOLERANCE = 1e-6;
  const std::array<double, 3> clear = inscatter(planet, ray, 0.1, 0, 0, TOLERANCE);
  planet.absorption = {1e-5, 3e-5, 8e-5};
  const std::array<double, 3> dimmed = inscatter(planet, ray, 0.1, 0, 0, TOLERANCE);
  for (size_t c = 0; c < 3; ++c) {
    const double expected = clear[c] * std::exp(-planet.absorption[c] * 5000 / 0.5);
    EXPECT_NEAR(dimmed[c], expected, 3 * TOLERANCE * clear[2]) << c;
  }
}

RenderOptions optionsOf(uint64_t samples, uint32_t firstOrder = 0,
                        uint32_t lastOrder = ALL_ORDERS) {
  RenderOptions options;
  options.samples = samples;
  options.firstOrder = firstOrder;
  options.lastOrder = lastOrder;
  return options;
}

EyeRay rayOf(double altitude, double elevation, double azimuth) {
  EyeRay ray;
  ray.origin = {0, altitude, 0};
  ray.direction = {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                   std::cos(elevation) * std::sin(azimuth)};
  return ray;
}

// Turbid air over bright ground on a plane.
Scene slabScene() {
  Scene scene;
  scene.ground = true;
  scene.groundAlbedo = {0.4, 0.6, 0.3};
  UniformLayer layer;
  layer.top = 1000;
  layer.extinction = {1e-3, 1.5e-3, 5e-4};
  layer.albedo = {1, 0.98, 0.95};
  layer.phase = PhaseFunction::henyeyGreenstein(0.7);
  scene.uniformLayers = {layer};
  scene.lights.resize(1);
  scene.lights[0].direction = {0.8, 0.6, 0};
  return scene;
}

// Every path of any order goes through a layer above the rest once from the light, and once more to
// an eye above it: on a plane each sample has the same factor.
TEST(AbsorbingLayer, AboveTheRestDimsEveryPathAlike) {
  Scene scene = slabScene();
  const std::vector<EyeRay> rays = {rayOf(2, 0.3, 1), rayOf(500, -0.4, 2), rayOf(2, 1.2, 0),
                                    rayOf(9000, -0.7, 0.5), rayOf(9000, -0.2, 3)};
  // Without the chances that paths of many orders and shadows of depths above 5 take.
  const RenderOptions options = optionsOf(500, 1, 32);
  const RenderResult clear = render(scene, rays, options);
  scene.absorbers = {{3000, 2000, {2e-4, 5e-4, 1e-5}}};
  const RenderResult dimmed = render(scene, rays, options);
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const double depth = scene.absorbers[0].extinction[c] * 2000;
      const double view = i < 3 ? 0 : depth / -rays[i].direction[1];
      const double expected = std::exp(-depth / 0.6 - view);
      EXPECT_GT(clear.pixels[i].radiance[c], 0.01);
      EXPECT_NEAR(dimmed.pixels[i].radiance[c] / clear.pixels[i].radiance[c], expected, 1e-10)
          << i << " " << c;
    }
  }
}

// The same gas as a stack of particles with an albedo below 1, which paths do hit.
TEST(AbsorbingLayer, InTheAirIsWhatPathsLoseByAlbedo) {
  Scene scene = slabScene();
  const UniformLayer air = scene.uniformLayers[0];
  const Rgb gas = {2e-3, 1e-3, 4e-4};
  Scene stack = scene;
  scene.absorbers = {{500, 500, gas}};
  stack.uniformLayers.clear();
  constexpr int SLICES = 20;  // the tent's mean in each: 4e-4 of the light, less than the noise
  for (int i = 0; i < SLICES; ++i) {
    UniformLayer slice = air;
    slice.bottom = 1000.0 * i / SLICES;
    slice.top = 1000.0 * (i + 1) / SLICES;
    const double density = 1 - std::fabs((i + 0.5) / SLICES - 0.5) * 2;
    for (size_t c = 0; c < 3; ++c) {
      const double scattering = air.extinction[c] * air.albedo[c];
      slice.extinction[c] += gas[c] * density;
      slice.albedo[c] = scattering / slice.extinction[c];
    }
    stack.uniformLayers.push_back(slice);
  }
  const std::vector<EyeRay> rays = {rayOf(2, 0.5, 1), rayOf(600, -0.3, 2), rayOf(3000, -1.0, 0)};
  for (const auto& [first, last] : {std::pair{0u, 1u}, {2u, ALL_ORDERS}}) {
    const RenderResult a = render(scene, rays, optionsOf(8000, first, last));
    const RenderResult b = render(stack, rays, optionsOf(8000, first, last));
    for (size_t i = 0; i < rays.size(); ++i) {
      for (size_t c = 0; c < 3; ++c) {
        const double noise = std::sqrt(a.pixels[i].variance[c] + b.pixels[i].variance[c]);
        EXPECT_NEAR(a.pixels[i].radiance[c], b.pixels[i].radiance[c], ERRORS * noise)
            << i << " " << c << " " << first;
        EXPECT_LT(noise, 0.1 * b.pixels[i].radiance[c]) << i << " " << c << " " << first;
      }
    }
  }
}

Planet ozonePlanet() {
  Planet planet;
  planet.absorption = {6.5e-6, 1.881e-5, 8.5e-7};  // ten times the Earth's
  return planet;
}

TEST(AbsorbingLayer, OnceScatteredSkyAgreesWithQuadrature) {
  const Planet planet = ozonePlanet();
  Scene scene;
  scene.globe.radius = planet.radius;
  scene.ground = true;  // black
  scene.layers.resize(1);
  scene.layers[0].extinction = planet.airScattering;
  scene.layers[0].phase = PhaseFunction::rayleigh();
  scene.absorbers = {{planet.absorberPeak, planet.absorberWidth, planet.absorption}};
  scene.lights.resize(1);
  struct Case {
    double altitude, viewElevation, lightElevation, length;
  };
  for (const Case& c : {Case{2, 1.3, 0.4, FAR}, Case{2, 0.1, 0.02, FAR}, Case{2, 0.5, -0.035, FAR},
                        Case{3e5, -0.31, 0.1, FAR}, Case{25000, 0.02, 0.2, 3e5}}) {
    EyeRay ray = rayOf(c.altitude, c.viewElevation, 0);
    ray.length = c.length;
    Point& sun = scene.lights[0].direction;
    sun = {0.8 * std::cos(c.lightElevation), std::sin(c.lightElevation),
           0.6 * std::cos(c.lightElevation)};
    const double y = oneMinusCosine(ray.direction, sun);
    const double ground = scene.globe.climb(ray.origin, ray.direction).ground();
    const std::array<double, 3> expected =
        inscatter(planet, {c.altitude, ray.direction[1], sun[1], 1 - y, std::min(c.length, ground)},
                  scene.layers[0].phase.value(0, y), 0, 0, 1e-4);
    const Estimate estimate = render(scene, {ray}, optionsOf(60000, 1, 1)).pixels[0];
    for (size_t k = 0; k < 3; ++k) {
      const double error = std::sqrt(estimate.variance[k]);
      EXPECT_NEAR(estimate.radiance[k], expected[k], ERRORS * error + 1e-4 * expected[k])
          << c.altitude << " " << c.viewElevation << " " << k;
      EXPECT_LT(error, 0.03 * *std::max_element(expected.begin(), expected.end()));
    }
  }
}

TEST(AbsorbingLayer, DimsWhatIsSeenDirectly) {
  const Planet planet = ozonePlanet();
  Scene scene;
  scene.globe.radius = planet.radius;
  scene.ground = true;
  scene.groundAlbedo = {0.5, 0.5, 0.5};
  scene.absorbers = {{planet.absorberPeak, planet.absorberWidth, planet.absorption}};
  scene.lights.resize(1);
  scene.lights[0].direction = {0.8, 0.6, 0};
  const EyeRay down = rayOf(1e5, -PI / 2, 0);
  EyeRay wall = rayOf(0, 0.5, 0);
  wall.length = 6e4;
  wall.background = {1, 2, 3};
  const RenderResult result = render(scene, {down, wall}, optionsOf(2));
  const Columns light = columns(planet, 0, 0.6, FAR);
  const Columns view = columns(planet, 0, std::sin(0.5), 6e4);
  for (size_t c = 0; c < 3; ++c) {
    const double depth = planet.absorption[c] * (light.absorber + 15000);
    EXPECT_NEAR(result.pixels[0].radiance[c], 0.5 / PI * 0.6 * std::exp(-depth), 1e-12);
    const double through = std::exp(-planet.absorption[c] * view.absorber);
    EXPECT_NEAR(result.pixels[1].transmittance[c], through, 1e-12);
    EXPECT_NEAR(result.pixels[1].radiance[c], through * wall.background[c], 1e-12);
  }
}

TEST(AbsorbingLayer, NeedsAWidthAndMayHaveAColour) {
  Scene scene;
  scene.absorbers = {{1000, 500, {1e-4, 1e-4, 1e-4}}};
  EXPECT_TRUE(scene.grey());
  scene.absorbers[0].extinction[1] = 0;
  EXPECT_FALSE(scene.grey());
  scene.absorbers[0].halfWidth = 0;
  EXPECT_THROW(render(scene, {EyeRay{}}, optionsOf(10)), std::invalid_argument);
}

}  // namespace
}  // namespace welkin::reference
