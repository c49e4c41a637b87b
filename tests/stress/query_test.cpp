// SPDX-License-Identifier: MIT
// CPU queries: rays and lights at the edge of their ranges and beyond.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

// Air and fog and a sun, worst things first.
struct QueryScene : CpuContext {
  QueryScene() {
    const auto sky = make<WlkSky>();
    check(wlkSetSky(context, &sky));
  }
  void setSun(double elevation_deg) const {
    auto light = make<WlkLight>();
    const double e = elevation_deg * std::numbers::pi / 180.0;
    light.direction[0] = static_cast<float>(std::cos(e));
    light.direction[1] = static_cast<float>(std::sin(e));
    check(wlkSetLights(context, 1, sizeof light, &light));
  }
};

WlkRay ray(double altitude, const std::array<double, 3>& direction, double length) {
  WlkRay r{};
  r.origin[1] = altitude;
  std::memcpy(r.direction, direction.data(), sizeof r.direction);
  r.length = length;
  return r;
}

std::vector<WlkRay> extremeRays() {
  std::vector<WlkRay> rays;
  const double s = std::sqrt(0.5);
  for (const double altitude :
       {-1e9, -6.371e6, -1e6, -1e4, -1.0, 0.0, 1e-9, 2.0, 1e4, 1e5, 1e7, 1e9}) {
    for (const std::array<double, 3>& direction : {std::array<double, 3>{0, 1, 0},
                                                   {0, -1, 0},
                                                   {1, 0, 0},
                                                   {-1, 0, 0},
                                                   {s, s, 0},
                                                   {s, -s, 0},
                                                   {1, 1e-12, 0},
                                                   {1, -1e-12, 0},
                                                   {std::sqrt(1 - 1e-6), -1e-3, 0}}) {
      for (const double length : {5e-324, 1e-12, 1.0, 1e4, 1e9, 1e300, INFINITE}) {
        rays.push_back(ray(altitude, direction, length));
      }
    }
  }
  return rays;
}

TEST(QuerySky, ExtremeRaysAreFiniteAndPhysical) {
  const QueryScene scene;
  const std::vector<WlkRay> rays = extremeRays();
  auto batch = make<WlkRayBatch>();
  batch.count = static_cast<uint32_t>(rays.size());
  batch.rays = rays.data();
  std::vector<double> radiance(3 * rays.size());
  std::vector<double> transmittance(3 * rays.size());
  for (const float extinction : {0.0f, 1e-30f, 1e-3f, 10.0f}) {
    auto fog = make<WlkFog>();
    fog.extinction = extinction;
    fog.scaleHeight = extinction > 1.0f ? 1.0f : 100.0f;
    ASSERT_EQ(wlkSetFog(scene.context, &fog), WLK_SUCCESS);
    for (const double elevation_deg : {90.0, 30.0, 1e-6, 0.0, -1e-6, -20.0, -90.0}) {
      scene.setSun(elevation_deg);
      // All orders in every other light: what differs is what follows from the same table.
      batch.maxOrder = elevation_deg == 30.0 || elevation_deg == 1e-6 ? 1 : 0;
      ASSERT_EQ(wlkEvalSky(scene.context, &batch, radiance.data(), transmittance.data()),
                WLK_SUCCESS);
      for (size_t i = 0; i < radiance.size(); ++i) {
        const WlkRay& r = rays[i / 3];
        ASSERT_TRUE(std::isfinite(radiance[i]) && radiance[i] >= 0 && transmittance[i] >= 0 &&
                    transmittance[i] <= 1)
            << "radiance " << radiance[i] << ", transmittance " << transmittance[i] << ", altitude "
            << r.origin[1] << ", direction " << r.direction[0] << " " << r.direction[1]
            << ", length " << r.length << ", fog " << extinction << ", sun " << elevation_deg
            << ", orders " << batch.maxOrder;
      }
    }
  }
}

TEST(QuerySky, BadRaysAreRefusedBeforeTheFirstResult) {
  const QueryScene scene;
  scene.setSun(30);
  struct Case {
    const char* field;
    std::function<void(WlkRay&)> spoil;
  };
  const std::vector<Case> cases{{"origin", [](WlkRay& r) { r.origin[0] = NOT_A_NUMBER; }},
                                {"origin", [](WlkRay& r) { r.origin[2] = 1.1e9; }},
                                {"origin", [](WlkRay& r) { r.origin[1] = -INFINITE; }},
                                {"direction", [](WlkRay& r) { r.direction[1] = 0.5; }},
                                {"direction", [](WlkRay& r) { r.direction[1] = NOT_A_NUMBER; }},
                                {"direction", [](WlkRay& r) { r.direction[0] = INFINITE; }},
                                {"length", [](WlkRay& r) { r.length = 0; }},
                                {"length", [](WlkRay& r) { r.length = -1; }},
                                {"length", [](WlkRay& r) { r.length = NOT_A_NUMBER; }},
                                {"length", [](WlkRay& r) { r.length = -INFINITE; }}};
  for (const Case& test : cases) {
    std::array<WlkRay, 3> rays;
    rays.fill(ray(2.0, {0, 1, 0}, 100.0));
    test.spoil(rays[2]);
    auto batch = make<WlkRayBatch>();
    batch.count = 3;
    batch.rays = rays.data();
    std::array<double, 9> radiance{};
    std::array<double, 9> transmittance{};
    EXPECT_FAILS(wlkEvalSky(scene.context, &batch, radiance.data(), transmittance.data()),
                 WLK_ERROR_INVALID_ARGUMENT, test.field);
    EXPECT_EQ(radiance, (std::array<double, 9>{}));
    EXPECT_EQ(transmittance, (std::array<double, 9>{}));
  }
  auto batch = make<WlkRayBatch>();
  batch.count = 1;
  EXPECT_FAILS(wlkEvalSky(scene.context, &batch, nullptr, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "rays");
  const WlkRay good = ray(2.0, {0, 1, 0}, 100.0);
  batch.rays = &good;
  batch.stride = sizeof(WlkRay) - 1;
  EXPECT_FAILS(wlkEvalSky(scene.context, &batch, nullptr, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "stride");
  batch.stride = sizeof(WlkRay);
  for (const uint32_t order : {2u, 0xffffffffu}) {
    batch.maxOrder = order;
    EXPECT_FAILS(wlkEvalSky(scene.context, &batch, nullptr, nullptr), WLK_ERROR_INVALID_ARGUMENT,
                 "maxOrder");
  }
  EXPECT_FAILS(wlkEvalSky(scene.context, nullptr, nullptr, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "WlkRayBatch");
}

TEST(QuerySky, AnEmptySceneIsBlackAndClear) {
  const CpuContext cpu;
  const WlkRay r = ray(2.0, {0, 1, 0}, INFINITE);
  auto batch = make<WlkRayBatch>();
  batch.count = 1;
  batch.rays = &r;
  std::array<double, 3> radiance{-1, -1, -1};
  std::array<double, 3> transmittance{-1, -1, -1};
  ASSERT_EQ(wlkEvalSky(cpu.context, &batch, radiance.data(), transmittance.data()), WLK_SUCCESS);
  EXPECT_EQ(radiance, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(transmittance, (std::array<double, 3>{1, 1, 1}));
}

TEST(QueryLight, ExtremesAreFiniteAndNeverBrighterThanOutside) {
  const QueryScene scene;
  double irradiance[3];
  const double origin[3] = {0, 0, 0};
  EXPECT_FAILS(wlkEvalLight(scene.context, 0, origin, irradiance), WLK_ERROR_INVALID_ARGUMENT,
               "lightIndex");
  for (const float extinction : {0.0f, 1e-3f, 10.0f}) {
    auto fog = make<WlkFog>();
    fog.extinction = extinction;
    ASSERT_EQ(wlkSetFog(scene.context, &fog), WLK_SUCCESS);
    for (const double elevation_deg : {90.0, 10.0, 0.3, 0.0, -0.3, -10.0, -90.0}) {
      scene.setSun(elevation_deg);
      for (const double altitude : {-1e9, -6.371e6, -1e4, 0.0, 1e-6, 1e3, 1e5, 1e7, 1e9}) {
        const double position[3] = {0, altitude, 0};
        ASSERT_EQ(wlkEvalLight(scene.context, 0, position, irradiance), WLK_SUCCESS);
        for (const double x : irradiance) {
          EXPECT_TRUE(x >= 0 && x <= 1)
              << x << " at " << altitude << " m, sun " << elevation_deg << ", fog " << extinction;
        }
      }
    }
  }
  for (const double bad : {NOT_A_NUMBER, INFINITE, -INFINITE, 1e10, -1e300}) {
    const double position[3] = {0, bad, 0};
    irradiance[0] = -7;
    EXPECT_FAILS(wlkEvalLight(scene.context, 0, position, irradiance), WLK_ERROR_INVALID_ARGUMENT,
                 "position");
    EXPECT_EQ(irradiance[0], -7);
  }
  EXPECT_FAILS(wlkEvalLight(scene.context, 1, origin, irradiance), WLK_ERROR_INVALID_ARGUMENT,
               "lightIndex");
  EXPECT_FAILS(wlkEvalLight(scene.context, 0, nullptr, irradiance), WLK_ERROR_INVALID_ARGUMENT,
               "position");
  EXPECT_FAILS(wlkEvalLight(scene.context, 0, origin, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "irradiance");
}

TEST(QueryAmbient, ExtremesAreFiniteAndBadPositionsRefused) {
  const QueryScene scene;
  std::array<double, WLK_AMBIENT_VALUES> values{};
  for (const float extinction : {0.0f, 10.0f}) {
    auto fog = make<WlkFog>();
    fog.extinction = extinction;
    ASSERT_EQ(wlkSetFog(scene.context, &fog), WLK_SUCCESS);
    for (const double elevation_deg : {90.0, 0.0, -90.0}) {
      scene.setSun(elevation_deg);
      for (const double altitude : {-6.371e6, -1e4, 0.0, 1e-6, 1e3, 7.9e4}) {
        const double position[3] = {0, altitude, 0};
        ASSERT_EQ(wlkEvalAmbient(scene.context, position, values.data()), WLK_SUCCESS);
        // No brighter than a white furnace around, and no harmonic above the first's bound.
        for (const double x : values) {
          EXPECT_TRUE(std::abs(x) <= 4) << x << " at " << altitude << ", sun " << elevation_deg;
        }
        EXPECT_GE(values[0], 0.0);
      }
    }
  }
  values.fill(-7);
  const std::array<double, WLK_AMBIENT_VALUES> untouched = values;
  for (const double bad : {NOT_A_NUMBER, INFINITE, -INFINITE, 1e10, 1e5}) {
    const double position[3] = {0, bad, 0};
    EXPECT_FAILS(wlkEvalAmbient(scene.context, position, values.data()), WLK_ERROR_INVALID_ARGUMENT,
                 "position");
    EXPECT_EQ(values, untouched);
  }
  const double origin[3] = {0, 0, 0};
  EXPECT_FAILS(wlkEvalAmbient(scene.context, nullptr, values.data()), WLK_ERROR_INVALID_ARGUMENT,
               "position");
  EXPECT_FAILS(wlkEvalAmbient(scene.context, origin, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "coefficients");
}

// Points near and far, below and above.
std::vector<std::array<double, 3>> extremePoints() {
  return {{0, 0, 0},        {0, 2, 0},       {0, 2, 1e-9},      {1e-300, 2, 0},      {1000, -5, 7},
          {0, -6.371e6, 0}, {0, -3e6, 0},    {0, -1.2742e7, 0}, {0, -1.3e7, 0},      {3e4, 1e5, 0},
          {-5e5, 1e4, 2e6}, {1e9, 1e9, 1e9}, {-1e9, -1e9, 1e9}, {6.4e6, -6.371e6, 0}};
}

TEST(QueryTransmittance, ExtremesAreInRangeAndBadPointsRefused) {
  const QueryScene scene;
  const std::vector<std::array<double, 3>> points = extremePoints();
  for (const float extinction : {0.0f, 1e-30f, 1e-3f, 10.0f}) {
    auto fog = make<WlkFog>();
    fog.extinction = extinction;
    ASSERT_EQ(wlkSetFog(scene.context, &fog), WLK_SUCCESS);
    for (const auto& a : points) {
      for (const auto& b : points) {
        std::array<double, 3> there{};
        std::array<double, 3> back{};
        ASSERT_EQ(wlkEvalTransmittance(scene.context, a.data(), b.data(), there.data()),
                  WLK_SUCCESS);
        ASSERT_EQ(wlkEvalTransmittance(scene.context, b.data(), a.data(), back.data()),
                  WLK_SUCCESS);
        for (size_t c = 0; c < 3; ++c) {
          EXPECT_TRUE(there[c] >= 0 && there[c] <= 1) << there[c];
          EXPECT_NEAR(there[c], back[c], 1e-9);
        }
      }
    }
  }
  std::array<double, 3> result{-7, -7, -7};
  const std::array<double, 3> good{0, 2, 0};
  for (const double bad : {NOT_A_NUMBER, INFINITE, -INFINITE, 1.1e9}) {
    const std::array<double, 3> point{0, bad, 0};
    EXPECT_FAILS(wlkEvalTransmittance(scene.context, point.data(), good.data(), result.data()),
                 WLK_ERROR_INVALID_ARGUMENT, "from");
    EXPECT_FAILS(wlkEvalTransmittance(scene.context, good.data(), point.data(), result.data()),
                 WLK_ERROR_INVALID_ARGUMENT, "to");
  }
  EXPECT_FAILS(wlkEvalTransmittance(scene.context, nullptr, good.data(), result.data()),
               WLK_ERROR_INVALID_ARGUMENT, "from");
  EXPECT_FAILS(wlkEvalTransmittance(scene.context, good.data(), nullptr, result.data()),
               WLK_ERROR_INVALID_ARGUMENT, "to");
  EXPECT_FAILS(wlkEvalTransmittance(scene.context, good.data(), good.data(), nullptr),
               WLK_ERROR_INVALID_ARGUMENT, "transmittance");
  EXPECT_EQ(result, (std::array<double, 3>{-7, -7, -7}));
}

TEST(QueryIrradiance, ExtremesAreFiniteAndBadInputRefused) {
  const QueryScene scene;
  const double s = std::sqrt(0.5);
  const std::vector<std::array<double, 3>> normals{{0, 1, 0}, {0, -1, 0}, {s, 0, s}, {-s, s, 0}};
  std::array<double, 3> direct{};
  std::array<double, 3> diffuse{};
  for (const float extinction : {0.0f, 1e-3f, 10.0f}) {
    auto fog = make<WlkFog>();
    fog.extinction = extinction;
    fog.baseAltitude = extinction > 1.0f ? -5000.0f : 300.0f;
    ASSERT_EQ(wlkSetFog(scene.context, &fog), WLK_SUCCESS);
    for (const double elevation_deg : {90.0, 0.0, -1e-6, -20.0, -90.0}) {
      scene.setSun(elevation_deg);
      for (const auto& normal : normals) {
        for (const auto& point : extremePoints()) {
          const bool high = point[1] > 9e4 || std::abs(point[2]) > 1e6 || std::abs(point[0]) > 1e6;
          const bool far = high || point[1] < -1.2743e7;
          ASSERT_EQ(wlkEvalIrradiance(scene.context, point.data(), normal.data(), direct.data(),
                                      far ? nullptr : diffuse.data()),
                    WLK_SUCCESS);
          for (size_t c = 0; c < 3; ++c) {
            EXPECT_TRUE(direct[c] >= 0 && direct[c] <= 1 + 1e-6) << direct[c];
            // A white furnace has pi times a radiance of 1 / pi, and the peak another.
            EXPECT_TRUE(diffuse[c] >= 0 && diffuse[c] <= 2) << diffuse[c];
          }
        }
      }
    }
  }
  const std::array<double, 3> up{0, 1, 0};
  const std::array<double, 3> origin{0, 0, 0};
  direct.fill(-7);
  diffuse.fill(-7);
  const std::array<double, 3> untouched = direct;
  for (const double bad : {NOT_A_NUMBER, INFINITE, -INFINITE, 1e10, 1e5}) {
    const std::array<double, 3> point{0, bad, 0};
    EXPECT_FAILS(
        wlkEvalIrradiance(scene.context, point.data(), up.data(), direct.data(), diffuse.data()),
        WLK_ERROR_INVALID_ARGUMENT, "position");
  }
  for (const double bad : {NOT_A_NUMBER, INFINITE, 0.0, 0.99, 1.01}) {
    const std::array<double, 3> normal{0, bad, 0};
    EXPECT_FAILS(wlkEvalIrradiance(scene.context, origin.data(), normal.data(), direct.data(),
                                   diffuse.data()),
                 WLK_ERROR_INVALID_ARGUMENT, "normal");
  }
  EXPECT_FAILS(wlkEvalIrradiance(scene.context, nullptr, up.data(), direct.data(), diffuse.data()),
               WLK_ERROR_INVALID_ARGUMENT, "position");
  EXPECT_FAILS(
      wlkEvalIrradiance(scene.context, origin.data(), nullptr, direct.data(), diffuse.data()),
      WLK_ERROR_INVALID_ARGUMENT, "normal");
  EXPECT_EQ(direct, untouched);
  EXPECT_EQ(diffuse, untouched);
  EXPECT_EQ(wlkEvalIrradiance(scene.context, origin.data(), up.data(), nullptr, nullptr),
            WLK_SUCCESS);
}

TEST(QuerySkyMap, ExtremesAreFiniteAndBadQueriesRefused) {
  const QueryScene scene;
  auto query = make<WlkSkyMapQuery>();
  EXPECT_EQ(query.size, 32u);
  query.size = 7;
  std::vector<float> rgb(size_t{3} * 7 * 7);
  for (const float extinction : {0.0f, 10.0f}) {
    auto fog = make<WlkFog>();
    fog.extinction = extinction;
    ASSERT_EQ(wlkSetFog(scene.context, &fog), WLK_SUCCESS);
    for (const double elevation_deg : {90.0, 0.0, -90.0}) {
      scene.setSun(elevation_deg);
      for (const auto& point : extremePoints()) {
        for (query.maxOrder = 0; query.maxOrder < 2; ++query.maxOrder) {
          std::copy(point.begin(), point.end(), query.position);
          ASSERT_EQ(wlkEvalSkyMap(scene.context, &query, rgb.data(), rgb.size() * sizeof(float)),
                    WLK_SUCCESS);
          for (const float one : rgb) {
            // Fog's forward peak is the largest: 1e3 per sr.
            ASSERT_TRUE(one >= 0 && one <= 1e4f) << one;
          }
        }
      }
    }
  }
  auto light = make<WlkLight>();
  std::fill_n(light.irradiance, 3, std::numeric_limits<float>::max());
  if (wlkSetLights(scene.context, 1, sizeof light, &light) == WLK_SUCCESS) {
    query.maxOrder = 0;
    ASSERT_EQ(wlkEvalSkyMap(scene.context, &query, rgb.data(), rgb.size() * sizeof(float)),
              WLK_SUCCESS);
    for (const float one : rgb) {
      ASSERT_TRUE(std::isfinite(one));
    }
  }
  struct Case {
    const char* field;
    std::function<void(WlkSkyMapQuery&)> spoil;
  };
  const std::vector<Case> cases{
      {"position", [](WlkSkyMapQuery& q) { q.position[2] = NOT_A_NUMBER; }},
      {"position", [](WlkSkyMapQuery& q) { q.position[0] = -1.1e9; }},
      {"size", [](WlkSkyMapQuery& q) { q.size = 3; }},
      {"size", [](WlkSkyMapQuery& q) { q.size = 1025; }},
      {"maxOrder", [](WlkSkyMapQuery& q) { q.maxOrder = 2; }}};
  rgb.assign(rgb.size(), -7.0f);
  const std::vector<float> untouched = rgb;
  for (const Case& test : cases) {
    auto bad = make<WlkSkyMapQuery>();
    bad.size = 4;
    test.spoil(bad);
    EXPECT_FAILS(wlkEvalSkyMap(scene.context, &bad, rgb.data(), rgb.size() * sizeof(float)),
                 WLK_ERROR_INVALID_ARGUMENT, test.field);
    EXPECT_EQ(rgb, untouched);
  }
  EXPECT_FAILS(wlkEvalSkyMap(scene.context, nullptr, rgb.data(), rgb.size() * sizeof(float)),
               WLK_ERROR_INVALID_ARGUMENT, "WlkSkyMapQuery");
  query = make<WlkSkyMapQuery>();
  EXPECT_FAILS(wlkEvalSkyMap(scene.context, &query, rgb.data(), rgb.size() * sizeof(float) - 1),
               WLK_ERROR_INVALID_ARGUMENT, "rgbSize");
  EXPECT_FAILS(wlkEvalSkyMap(scene.context, &query, nullptr, 0), WLK_ERROR_INVALID_ARGUMENT, "rgb");
}

TEST(QueryRandom, AnyAtmosphereGivesFiniteLight) {
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) {
    return static_cast<float>(low * std::pow(high / low, unit(generator)));
  };
  const auto direction = [&] {
    const double y = 2 * unit(generator) - 1;
    const double azimuth = 2 * std::numbers::pi * unit(generator);
    const double s = std::sqrt((1 - y) * (1 + y));
    return std::array<double, 3>{s * std::cos(azimuth), y, s * std::sin(azimuth)};
  };
  for (int i = 0; i < 8; ++i) {
    const QueryScene scene;
    auto planet = make<WlkPlanet>();
    planet.radius = between(1e4, 1e9);
    std::fill_n(planet.groundAlbedo, 3, static_cast<float>(unit(generator)));
    auto sky = make<WlkSky>();
    sky.scaleHeight = between(100, 5e4);
    for (float& one : sky.rayleighScattering) {
      one = between(1e-8, 1e-3);
    }
    auto fog = make<WlkFog>();
    fog.extinction = between(1e-6, 1);
    fog.scaleHeight = between(1, 1e4);
    fog.baseAltitude = static_cast<float>(4000 * unit(generator) - 2000);
    auto sun = make<WlkLight>();
    const std::array<double, 3> to = direction();
    for (size_t k = 0; k < 3; ++k) {
      sun.direction[k] = static_cast<float>(to[k]);
    }
    check(wlkSetPlanet(scene.context, &planet));
    check(wlkSetSky(scene.context, &sky));
    check(wlkSetFog(scene.context, &fog));
    check(wlkSetLights(scene.context, 1, sizeof sun, &sun));
    for (int k = 0; k < 100; ++k) {
      const double altitude = static_cast<double>(between(1e-3, 1e8));
      const WlkRay one = ray(altitude, direction(), static_cast<double>(between(1e-3, 1e12)));
      auto batch = make<WlkRayBatch>();
      batch.count = 1;
      batch.rays = &one;
      std::array<double, 12> result{};
      const std::array<double, 3> end{one.direction[0] * 1e4, altitude + one.direction[1] * 1e4,
                                      one.direction[2] * 1e4};
      const double low[3] = {0, std::min(altitude, 999.0), 0};  // below any top of the table
      ASSERT_EQ(wlkEvalSky(scene.context, &batch, &result[0], nullptr), WLK_SUCCESS);
      ASSERT_EQ(wlkEvalTransmittance(scene.context, one.origin, end.data(), &result[3]),
                WLK_SUCCESS);
      ASSERT_EQ(wlkEvalIrradiance(scene.context, low, one.direction, &result[6], &result[9]),
                WLK_SUCCESS);
      for (const double x : result) {
        ASSERT_TRUE(std::isfinite(x) && x >= 0) << x << " in atmosphere " << i << ", ray " << k;
      }
    }
  }
}

TEST(LastError, IsOfTheThreadAndNamesEveryCode) {
  EXPECT_STREQ(wlkResultName(WLK_SUCCESS), "WLK_SUCCESS");
  EXPECT_STREQ(wlkResultName(WLK_ERROR_INTERNAL), "WLK_ERROR_INTERNAL");
  for (const WlkResult unknown : {3, -17, 2147483647, -2147483647 - 1}) {
    EXPECT_STREQ(wlkResultName(unknown), "WLK_UNKNOWN_RESULT");
  }
  for (const uint32_t unknown : {100u, 0xffffffffu}) {
    EXPECT_STREQ(wlkReasonName(unknown), "WLK_UNKNOWN_REASON");
  }
  EXPECT_FAILS(wlkSetSky(nullptr, nullptr), WLK_ERROR_INVALID_HANDLE, "context");
  std::thread([] {
    EXPECT_EQ(lastError().result, WLK_SUCCESS);
    EXPECT_FAILS(wlkInitStruct(0, 0, nullptr), WLK_ERROR_INVALID_ARGUMENT, "structure");
  }).join();
  EXPECT_EQ(lastError().result, WLK_ERROR_INVALID_HANDLE);
  // A successful call keeps it.
  EXPECT_EQ(wlkGetVersion(), uint32_t{WLK_API_VERSION});
  auto sky = make<WlkSky>();
  EXPECT_EQ(wlkInitStruct(WLK_STRUCT_SKY, sizeof sky, &sky), WLK_SUCCESS);
  EXPECT_EQ(lastError().result, WLK_ERROR_INVALID_HANDLE);
}

}  // namespace
}  // namespace welkin::test
