// SPDX-License-Identifier: MIT
// Descriptions of media, and phase queries, at the edge of their ranges and beyond.
#include <cmath>
#include <limits>
#include <numbers>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr uint32_t HUGE_COUNT = 0xffffffffu;

using Info = WlkMediumInfo;

Info droplets(uint32_t particle = WLK_PARTICLE_CLOUD) {
  auto info = make<Info>();
  info.particle = particle;
  return info;
}

// A table of the caller's, as long as the test.
struct UserTable {
  std::vector<double> angle{0.0, 1.0, std::numbers::pi};
  std::vector<double> phase{4, 2, 1, 1, 1, 1, 0, 3, 5};
  Info info() const {
    Info info = droplets(WLK_PARTICLE_USER);
    info.userAngle = angle.data();
    info.userPhase = phase.data();
    info.userCount = static_cast<uint32_t>(angle.size());
    return info;
  }
};

struct Particles : ::testing::Test {
  CpuContext cpu;

  WlkMedium medium(const Info& info) const {
    WlkMedium made{};
    check(wlkCreateMedium(cpu.context, &info, &made));
    return made;
  }
  void expectRefused(const Info& info, const char* field) const {
    WlkMedium made{};
    EXPECT_FAILS(wlkCreateMedium(cpu.context, &info, &made), WLK_ERROR_INVALID_ARGUMENT, field);
    EXPECT_EQ(made.id, 0u);
  }
  // Values, samples and optics are finite and of the right sign.
  void expectPhysical(const Info& info) const {
    const WlkMedium made = medium(info);
    std::vector<double> angles{0.0, 5e-324, 1e-12, 1e-6, 1e-3, std::numbers::pi};
    for (int i = 0; i <= 64; ++i) {
      angles.push_back(std::numbers::pi * i / 64);
    }
    auto query = make<WlkPhaseQuery>();
    query.medium = made;
    query.count = static_cast<uint32_t>(angles.size());
    query.scatteringAngle = angles.data();
    std::vector<double> values(3 * angles.size(), -1.0);
    for (const uint32_t kind : {WLK_ORDER_SINGLE, WLK_ORDER_INTEGER, WLK_ORDER_POISSON}) {
      query.orderKind = kind;
      query.order = 1000;
      query.opticalDepth = 1e4;
      ASSERT_EQ(wlkEvalPhase(cpu.context, &query, values.data()), WLK_SUCCESS);
      for (size_t i = 0; i < values.size(); ++i) {
        EXPECT_TRUE(std::isfinite(values[i]) && values[i] >= 0)
            << values[i] << " at " << angles[i / 3] << ", kind " << kind;
      }
    }
    const std::vector<double> random{0.0, 5e-324, 1e-12, 0.5, 1 - 0x1p-53};
    std::vector<double> angle(random.size(), -1.0);
    std::vector<double> density(random.size(), -1.0);
    for (uint32_t channel = 0; channel < 3; ++channel) {
      ASSERT_EQ(wlkSamplePhase(cpu.context, made, channel, static_cast<uint32_t>(random.size()),
                               random.data(), angle.data(), density.data()),
                WLK_SUCCESS);
      for (size_t i = 0; i < random.size(); ++i) {
        EXPECT_TRUE(angle[i] >= 0 && angle[i] <= std::numbers::pi) << angle[i];
        EXPECT_TRUE(std::isfinite(density[i]) && density[i] >= 0) << density[i];
      }
    }
    auto optics = make<WlkMediumOptics>();
    ASSERT_EQ(wlkGetMediumOptics(cpu.context, made, &optics), WLK_SUCCESS);
    EXPECT_TRUE(std::isfinite(optics.effectiveRadius_um) && optics.effectiveRadius_um >= 0);
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(optics.extinctionEfficiency[i] >= 0 && optics.extinctionEfficiency[i] < 10);
      EXPECT_TRUE(optics.extinctionCrossSection[i] >= 0 && optics.extinctionCrossSection[i] < 1);
      EXPECT_TRUE(std::abs(optics.asymmetry[i]) <= 1);
      EXPECT_TRUE(optics.forwardFraction[i] >= 0 && optics.forwardFraction[i] <= 1);
      EXPECT_TRUE(optics.deltaFraction[i] >= 0 && optics.deltaFraction[i] < 1);
    }
    EXPECT_EQ(wlkDestroyMedium(cpu.context, made), WLK_SUCCESS);
  }
};

TEST_F(Particles, OfEveryTypeArePhysicalAtBothEndsOfTheirRanges) {
  struct Range {
    uint32_t particle;
    float low;
    float high;
  };
  for (const Range& range : {Range{WLK_PARTICLE_CLOUD, 5.0f, 50.0f},
                             {WLK_PARTICLE_FOG, 0.1f, 50.0f},
                             {WLK_PARTICLE_HAZE, 0.1f, 5.0f},
                             {WLK_PARTICLE_RAIN, 100.0f, 2000.0f}}) {
    SCOPED_TRACE(range.particle);
    Info info = droplets(range.particle);
    expectPhysical(info);
    for (const float diameter : {range.low, range.high}) {
      info.diameter_um = diameter;
      expectPhysical(info);
      if (range.particle != WLK_PARTICLE_RAIN) {
        info.phaseModel = WLK_PHASE_ANALYTIC;
        expectPhysical(info);
        info.phaseModel = WLK_PHASE_DEFAULT;
      }
    }
    for (const float diameter :
         {std::nextafter(range.low, 0.0f), std::nextafter(range.high, INFINITE), -1.0f, 1e-30f,
          std::numeric_limits<float>::max(), INFINITE, NOT_A_NUMBER}) {
      info.diameter_um = diameter;
      expectRefused(info, "diameter_um");
    }
  }
}

TEST_F(Particles, WithoutASizeArePhysicalAndHaveNoCrossSection) {
  Info hg = droplets(WLK_PARTICLE_HENYEY_GREENSTEIN);
  for (const float g : {-0.999f, -1e-30f, 1e-7f, 0.999f}) {
    hg.asymmetry = g;
    expectPhysical(hg);
  }
  for (const float g : {-1.0f, 0.9995f, 1.0f, INFINITE, NOT_A_NUMBER}) {
    hg.asymmetry = g;
    expectRefused(hg, "asymmetry");
  }
  const UserTable table;
  for (const Info& info :
       {droplets(WLK_PARTICLE_AIR), droplets(WLK_PARTICLE_HENYEY_GREENSTEIN), table.info()}) {
    expectPhysical(info);
    const WlkMedium made = medium(info);
    auto optics = make<WlkMediumOptics>();
    ASSERT_EQ(wlkGetMediumOptics(cpu.context, made, &optics), WLK_SUCCESS);
    EXPECT_EQ(optics.extinctionEfficiency[1], 0.0f);
    EXPECT_EQ(optics.extinctionCrossSection[1], 0.0);
    EXPECT_EQ(optics.effectiveRadius_um, 0.0f);
  }
}

TEST_F(Particles, OfIceArePhysicalSmoothAndRough) {
  Info info = droplets(WLK_PARTICLE_ICE_COLUMN);
  expectPhysical(info);
  info.roughness = 0.2f;
  expectPhysical(info);
  expectPhysical(droplets(WLK_PARTICLE_ICE_PLATE));
  Info snow = droplets(WLK_PARTICLE_SNOW);
  expectPhysical(snow);
  for (const uint32_t particle : {WLK_PARTICLE_ICE_COLUMN, WLK_PARTICLE_ICE_PLATE}) {
    info = droplets(particle);
    for (const float roughness : {-0.01f, 0.21f, 1.0f, INFINITE, NOT_A_NUMBER}) {
      info.roughness = roughness;
      expectRefused(info, "roughness");
    }
  }
  for (const float roughness : {-0.3f, 1e-30f, 0.29f, 0.61f, NOT_A_NUMBER}) {
    snow.roughness = roughness;
    expectRefused(snow, "roughness");
  }
}

TEST_F(Particles, WithUnknownWordsAreRefused) {
  for (const uint32_t particle : {10u, 99u, HUGE_COUNT}) {
    expectRefused(droplets(particle), "particle");
  }
  for (const uint32_t model : {3u, HUGE_COUNT}) {
    Info info = droplets();
    info.phaseModel = model;
    expectRefused(info, "phaseModel");
  }
  for (const uint32_t particle :
       {WLK_PARTICLE_RAIN, WLK_PARTICLE_ICE_COLUMN, WLK_PARTICLE_ICE_PLATE, WLK_PARTICLE_SNOW}) {
    Info info = droplets(particle);
    info.phaseModel = WLK_PHASE_ANALYTIC;
    expectRefused(info, "phaseModel");
  }
  Info user = UserTable().info();
  user.phaseModel = WLK_PHASE_ANALYTIC;
  expectRefused(user, "phaseModel");
  auto fog = make<WlkFog>();
  for (const uint32_t model : {3u, HUGE_COUNT}) {
    fog.phaseModel = model;
    EXPECT_FAILS(wlkSetFog(cpu.context, &fog), WLK_ERROR_INVALID_ARGUMENT, "phaseModel");
  }
  for (const float diameter : {0.1f, 0.7f, 50.0f}) {
    for (const uint32_t model : {WLK_PHASE_DEFAULT, WLK_PHASE_ANALYTIC, WLK_PHASE_TABLE}) {
      fog.phaseModel = model;
      fog.dropletDiameter_um = diameter;
      EXPECT_EQ(wlkSetFog(cpu.context, &fog), WLK_SUCCESS) << diameter << " um, model " << model;
    }
  }
}

TEST_F(Particles, WithSpreadsOrWavelengthsOutOfRangeAreRefused) {
  for (const uint32_t particle : {WLK_PARTICLE_CLOUD, WLK_PARTICLE_FOG, WLK_PARTICLE_HAZE}) {
    Info info = droplets(particle);
    for (const float spread : {-0.1f, 0.049f, 0.51f, INFINITE, NOT_A_NUMBER}) {
      info.spread = spread;
      expectRefused(info, "spread");
    }
    // Only the table knows other spreads than that of the fit.
    info.spread = 0.1f;
    info.phaseModel = WLK_PHASE_ANALYTIC;
    expectRefused(info, "spread");
    info.spread = 0.25f;
    expectPhysical(info);
  }
  Info rain = droplets(WLK_PARTICLE_RAIN);
  rain.spread = 0.1f;
  expectRefused(rain, "spread");
  for (const float wavelength : {0.39f, 0.71f, -0.5f, 1e-30f, INFINITE, NOT_A_NUMBER}) {
    Info info = droplets();
    info.wavelength_um = wavelength;
    expectRefused(info, "wavelength_um");
  }
  Info user = UserTable().info();
  user.wavelength_um = 0.5f;
  expectRefused(user, "wavelength_um");
}

TEST_F(Particles, OfTheCallerNeedAWholeTable) {
  const double pi = std::numbers::pi;
  UserTable table;
  expectPhysical(table.info());
  Info info = table.info();
  info.userAngle = nullptr;
  expectRefused(info, "userAngle");
  info = table.info();
  info.userPhase = nullptr;
  expectRefused(info, "userPhase");
  for (const uint32_t count : {0u, 1u, 65537u, HUGE_COUNT}) {
    info = table.info();
    info.userCount = count;
    expectRefused(info, "userCount");
  }
  info = table.info();
  info.particle = WLK_PARTICLE_CLOUD;
  expectRefused(info, "userCount");

  for (const std::vector<double>& angle :
       std::vector<std::vector<double>>{{0, 1, 1},
                                        {0, 2, 1},
                                        {0, 0, pi},
                                        {0.1, 1, pi},
                                        {-0.1, 1, pi},
                                        {0, 1, 3},
                                        {0, 1, 4},
                                        {0, double{NOT_A_NUMBER}, pi},
                                        {double{NOT_A_NUMBER}, 1, pi},
                                        {0, 1, double{NOT_A_NUMBER}},
                                        {0, 1, double{INFINITE}},
                                        {-double{INFINITE}, 1, pi}}) {
    UserTable bad;
    bad.angle = angle;
    expectRefused(bad.info(), "userAngle");
  }
  for (const double value : {-1.0, -1e-300, double{NOT_A_NUMBER}, double{INFINITE}}) {
    for (size_t i = 0; i < table.phase.size(); i += 4) {
      UserTable bad;
      bad.phase[i] = value;
      expectRefused(bad.info(), "userPhase");
    }
  }
  // A channel that is 0 everywhere has no integral to divide by.
  UserTable dark;
  dark.phase[1] = dark.phase[4] = dark.phase[7] = 0;
  expectRefused(dark.info(), "userPhase");
  for (const double scale : {1e-300, 1e-30, 1e29}) {
    UserTable scaled;
    for (double& value : scaled.phase) {
      value *= scale;
    }
    expectPhysical(scaled.info());
  }
}

TEST_F(Particles, WithEveryEdgeOfAQueryAreRefusedBeforeTheFirstResult) {
  const double angles[2] = {1.0, 2.0};
  auto good = make<WlkPhaseQuery>();
  good.medium = medium(droplets());
  good.count = 2;
  good.scatteringAngle = angles;
  EXPECT_EQ(good.order, 1u);
  EXPECT_EQ(good.opticalDepth, 1.0);
  std::array<double, 6> values{};
  values.fill(-3);
  const std::array<double, 6> untouched = values;
  const auto expectFails = [&](const WlkPhaseQuery& query, WlkResult code, const char* field) {
    EXPECT_FAILS(wlkEvalPhase(cpu.context, &query, values.data()), code, field);
    EXPECT_EQ(values, untouched);
  };
  WlkPhaseQuery bad = good;
  for (const uint32_t kind : {3u, HUGE_COUNT}) {
    bad.orderKind = kind;
    expectFails(bad, WLK_ERROR_INVALID_ARGUMENT, "orderKind");
  }
  bad = good;
  bad.orderKind = WLK_ORDER_INTEGER;
  for (const uint32_t order : {0u, 1001u, HUGE_COUNT}) {
    bad.order = order;
    expectFails(bad, WLK_ERROR_INVALID_ARGUMENT, "order");
  }
  bad = good;
  bad.orderKind = WLK_ORDER_POISSON;
  for (const double depth : {-1e-300, -1.0, 1.0001e4, double{INFINITE}, double{NOT_A_NUMBER}}) {
    bad.opticalDepth = depth;
    expectFails(bad, WLK_ERROR_INVALID_ARGUMENT, "opticalDepth");
  }
  for (const double depth : {0.0, 5e-324, 1e-12, 1e4}) {
    bad.opticalDepth = depth;
    EXPECT_EQ(wlkEvalPhase(cpu.context, &bad, values.data()), WLK_SUCCESS);
    for (const double value : values) {
      EXPECT_TRUE(std::isfinite(value) && value > 0) << value << ", depth " << depth;
    }
  }
  values = untouched;
  for (const double angle :
       {double{NOT_A_NUMBER}, double{INFINITE}, -double{INFINITE}, -1e-300, 3.15}) {
    const double wrong[2] = {1.0, angle};
    bad = good;
    bad.scatteringAngle = wrong;
    expectFails(bad, WLK_ERROR_INVALID_ARGUMENT, "scatteringAngle");
  }
  bad = good;
  bad.scatteringAngle = nullptr;
  expectFails(bad, WLK_ERROR_INVALID_ARGUMENT, "scatteringAngle");
  EXPECT_FAILS(wlkEvalPhase(cpu.context, &good, nullptr), WLK_ERROR_INVALID_ARGUMENT, "phase");
  EXPECT_FAILS(wlkEvalPhase(cpu.context, nullptr, values.data()), WLK_ERROR_INVALID_ARGUMENT,
               "WlkPhaseQuery");
  EXPECT_FAILS(wlkEvalPhase(nullptr, &good, values.data()), WLK_ERROR_INVALID_HANDLE, "context");
  bad = good;
  bad.count = 0;
  bad.scatteringAngle = nullptr;
  EXPECT_EQ(wlkEvalPhase(cpu.context, &bad, nullptr), WLK_SUCCESS);
}

TEST_F(Particles, AnswerSamplesOnlyForNumbersInTheirRange) {
  const WlkMedium made = medium(droplets());
  double random[2] = {0.25, 0.5};
  std::array<double, 2> angle{-3, -3};
  std::array<double, 2> density{-3, -3};
  const auto sample = [&](uint32_t channel) {
    return wlkSamplePhase(cpu.context, made, channel, 2, random, angle.data(), density.data());
  };
  for (const uint32_t channel : {3u, HUGE_COUNT}) {
    EXPECT_FAILS(sample(channel), WLK_ERROR_INVALID_ARGUMENT, "channel");
  }
  for (const double bad :
       {1.0, 1.5, -1e-300, -1.0, double{INFINITE}, -double{INFINITE}, double{NOT_A_NUMBER}}) {
    random[1] = bad;
    EXPECT_FAILS(sample(0), WLK_ERROR_INVALID_ARGUMENT, "random");
  }
  random[1] = 0.5;
  const WlkContext c = cpu.context;
  EXPECT_FAILS(wlkSamplePhase(c, made, 0, 2, nullptr, angle.data(), density.data()),
               WLK_ERROR_INVALID_ARGUMENT, "random");
  EXPECT_FAILS(wlkSamplePhase(c, made, 0, 2, random, nullptr, density.data()),
               WLK_ERROR_INVALID_ARGUMENT, "scatteringAngle");
  EXPECT_EQ(angle, (std::array<double, 2>{-3, -3}));
  EXPECT_EQ(density, (std::array<double, 2>{-3, -3}));
  EXPECT_EQ(wlkSamplePhase(c, made, 0, 0, nullptr, nullptr, nullptr), WLK_SUCCESS);
  EXPECT_EQ(wlkSamplePhase(c, made, 0, 2, random, angle.data(), nullptr), WLK_SUCCESS);
  EXPECT_NE(angle[0], angle[1]);
  EXPECT_EQ(density[0], -3);
  EXPECT_FAILS(wlkGetMediumOptics(c, made, nullptr), WLK_ERROR_INVALID_ARGUMENT, "WlkMediumOptics");
}

}  // namespace
}  // namespace welkin::test
