// SPDX-License-Identifier: MIT
// CPU queries: rays and lights at the edge of their ranges and beyond.
#include <cmath>
#include <limits>
#include <numbers>
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
      ASSERT_EQ(wlkEvalSky(scene.context, &batch, radiance.data(), transmittance.data()),
                WLK_SUCCESS);
      for (size_t i = 0; i < radiance.size(); ++i) {
        const WlkRay& r = rays[i / 3];
        ASSERT_TRUE(std::isfinite(radiance[i]) && radiance[i] >= 0 && transmittance[i] >= 0 &&
                    transmittance[i] <= 1)
            << "radiance " << radiance[i] << ", transmittance " << transmittance[i] << ", altitude "
            << r.origin[1] << ", direction " << r.direction[0] << " " << r.direction[1]
            << ", length " << r.length << ", fog " << extinction << ", sun " << elevation_deg;
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
