// SPDX-License-Identifier: MIT
// Shafts of light by the engine's shadow map: what a wall with a window leaves of the light that
// fog scatters, against a quadrature written anew here; and maps that must change nothing.
#include "support/light_shadow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180;
constexpr double RADIUS = 6.371e6;
constexpr uint32_t WIDTH = 48;
constexpr uint32_t HEIGHT = 36;
constexpr Vec3 EYE{0, 400, 0};
constexpr double PITCH = 5;
constexpr double SURFACE = 900;  // m along the view's axis
constexpr double EXTINCTION = 2e-3;
constexpr double SCALE_HEIGHT = 300;
constexpr uint32_t TEXELS = 64;  // along a map's edge
constexpr double WALL = 0.25;    // depth; exact in every format and reversed

Vec3 directionOf(double x, double y) {
  const double half = std::tan(30 * DEGREE);
  const double right = (2 * (x + 0.5) / WIDTH - 1) * half * WIDTH / HEIGHT;
  const double up = (1 - 2 * (y + 0.5) / HEIGHT) * half;
  const double c = std::cos(PITCH * DEGREE);
  const double s = std::sin(PITCH * DEGREE);
  return unit({right, up * c + s, up * s - c});
}

// The wall is whole but for a window, from the first to the last texel of it in u and v.
struct Wall {
  LightFrame frame;
  uint32_t first;
  uint32_t last;
  bool inside(const Vec3& p) const {
    const Vec3 at = frame.place(p);
    return std::all_of(at.begin(), at.end(), [](double x) { return x >= 0 && x <= 1; });
  }
  bool shadows(const Vec3& p) const {
    const Vec3 at = frame.place(p);
    const auto open = [&](double x) { return x * TEXELS >= first && x * TEXELS < last + 1; };
    return at[2] > WALL && !(open(at[0]) && open(at[1]));
  }
  void draw(float depth, float empty, std::vector<float>& texels) const {
    for (uint32_t j = 0; j < TEXELS; ++j) {
      for (uint32_t i = 0; i < TEXELS; ++i) {
        const bool window = i >= first && i <= last && j >= first && j <= last;
        texels.push_back(window ? empty : depth);
      }
    }
  }
};

// Once-scattered light of the fog along a pixel's ray but for a factor of it: by the midpoint rule.
// `lit` tells where the sun shines.
template <typename Lit>
double fogLight(const Vec3& view, const Vec3& toSun, const Lit& lit) {
  constexpr int STEPS = 6000;
  const double c = std::cos(PITCH * DEGREE);
  const double s = std::sin(PITCH * DEGREE);
  const double reach = SURFACE / (s * view[1] - c * view[2]);
  const double step = reach / STEPS;
  double depth = 0;
  double sum = 0;
  for (int i = 0; i < STEPS; ++i) {
    const double t = (i + 0.5) * step;
    const Vec3 p{EYE[0] + t * view[0], EYE[1] + t * view[1], EYE[2] + t * view[2]};
    const double up = p[1] + RADIUS;
    const double altitude = std::sqrt(p[0] * p[0] + up * up + p[2] * p[2]) - RADIUS;
    const double beta = EXTINCTION * std::exp(-altitude / SCALE_HEIGHT);
    depth += 0.5 * beta * step;
    if (lit(p)) {
      // The layer is flat over its 20 scale heights to 1e-3 of its depth.
      sum += beta * step * std::exp(-depth - beta * SCALE_HEIGHT / toSun[1]);
    }
    depth += 0.5 * beta * step;
  }
  return sum;
}

struct Sun {
  const char* name;
  double elevation_deg;
  double azimuth_deg;
};
constexpr std::array SUNS{Sun{"from the left", 35, 270}, Sun{"ahead", 25, 20},
                          Sun{"behind", 50, 160}};

class LightShadowTest : public ::testing::Test {
 protected:
  LightShadowTest() : scene(options()) {
    scene.setFog(static_cast<float>(EXTINCTION), static_cast<float>(SCALE_HEIGHT));
    scene.setCamera(EYE, 0, PITCH);
    depth.assign(size_t{WIDTH} * HEIGHT, static_cast<float>(0.1 / SURFACE));
    setQuality(WLK_QUALITY_FLAG_LIGHT_SHADOWS, WLK_SCATTERING_SINGLE);
  }
  ~LightShadowTest() override { EXPECT_TRUE(scene.messages().empty()) << scene.messages().front(); }
  static SceneOptions options() {
    SceneOptions o;
    o.width = WIDTH;
    o.height = HEIGHT;
    return o;
  }
  void setQuality(uint64_t flags, uint32_t scattering) const {
    auto quality = make<WlkQuality>();
    quality.scattering = scattering;
    quality.flags = flags;
    check(wlkSetQuality(scene.context, scene.view, &quality));
  }
  Image plain() const {
    auto targets = make<WlkHeadlessInputs>();
    targets.depth = depth.data();
    targets.depthSize = depth.size() * sizeof(float);
    return scene.render(&targets);
  }
  Image shaded(const WlkLightShadow& shadow, const std::vector<float>& map) const {
    auto targets = make<WlkHeadlessInputs>();
    targets.depth = depth.data();
    targets.depthSize = depth.size() * sizeof(float);
    targets.lightShadow = &shadow;
    targets.shadowDepth = map.data();
    targets.shadowDepthSize = map.size() * sizeof(float);
    targets.shadowWidth = targets.shadowHeight = TEXELS;
    Image image = scene.render(&targets);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    EXPECT_EQ(image.badValues(), 0u);
    return image;
  }
  // One cascade around everything, with one value.
  Image uniform(float value, double elevation_deg = 35, double azimuth_deg = 270) const {
    auto shadow = make<WlkLightShadow>();
    const LightFrame all({0, 0, 0}, 8000, directionTo(elevation_deg, azimuth_deg));
    all.write({0, 0, 0}, false, shadow.clipFromWorld[0]);
    return shaded(shadow, std::vector<float>(size_t{TEXELS} * TEXELS, value));
  }

  HeadlessScene scene;
  std::vector<float> depth;
};

// Edges are found to 1/64 of a step; 23 steps that grow with the distance take the fog's own change
// (0.4 % by the midpoint rule where it changes most); the layer's first-order light itself is right
// to 0.5 % (riley2004.glsl). The wall's edges run through pixels: the truth is that of their
// middles, like the picture.
constexpr double EDGES = 2.0 / 64 * 2 / 23;  // two edges, the longest step in shares of the stretch
constexpr double MIDPOINTS = 0.004;
constexpr double FIRST_ORDER = 0.005;

TEST_F(LightShadowTest, WindowsLeaveShaftsAsAQuadratureSays) {
  for (const Sun& sun : SUNS) {
    for (const bool reversed : {false, true}) {
      for (const uint32_t cascades : {1u, 2u}) {
        SCOPED_TRACE(::testing::Message()
                     << sun.name << (reversed ? ", reversed, " : ", ") << cascades << " cascades");
        scene.setSun(sun.elevation_deg, sun.azimuth_deg);
        const Vec3 toSun = directionTo(sun.elevation_deg, sun.azimuth_deg);
        // The finer one lies inside the other and has a window of its own.
        const std::array walls{Wall{{{50, 420, -300}, 500, toSun}, 20, 45},
                               Wall{{{0, 400, -500}, 2400, toSun}, 26, 40}};
        auto shadow = make<WlkLightShadow>();
        shadow.cascadeCount = cascades;
        shadow.bias = 0;
        const Vec3 origin{1000, -200, 30};
        std::copy(origin.begin(), origin.end(), shadow.origin);
        std::vector<float> map;
        for (uint32_t i = 0; i < cascades; ++i) {
          const Wall& wall = walls[i + 2 - cascades];
          wall.frame.write(origin, reversed, shadow.clipFromWorld[i]);
          wall.draw(static_cast<float>(reversed ? 1 - WALL : WALL), reversed ? 0.0f : 1.0f, map);
        }
        const Image lit = plain();
        const Image shaft = shaded(shadow, map);
        const auto sees = [&](const Vec3& p) {
          const Wall& wall = cascades == 2 && walls[0].inside(p) ? walls[0] : walls[1];
          return !(wall.inside(p) && wall.shadows(p));
        };
        double worst = 0;
        double least = 1;
        double most = 0;
        for (uint32_t y = 0; y < HEIGHT; ++y) {
          for (uint32_t x = 0; x < WIDTH; ++x) {
            const Vec3 view = directionOf(x, y);
            const double share = fogLight(view, toSun, sees) /
                                 fogLight(view, toSun, [](const Vec3&) { return true; });
            const double seen = double{shaft.at(x, y)[1]} / double{lit.at(x, y)[1]};
            worst = std::max(worst, std::abs(seen - share));
            least = std::min(least, share);
            most = std::max(most, share);
          }
        }
        std::printf("%s, %u cascades: light left %.3f to %.3f, error at most %.4f\n", sun.name,
                    cascades, least, most, worst);
        EXPECT_LT(least, 0.5) << "nothing to see";
        EXPECT_GT(most - least, 0.2) << "nothing to see";
        EXPECT_LT(worst, EDGES + MIDPOINTS + FIRST_ORDER);
      }
    }
  }
}

TEST_F(LightShadowTest, AnEmptyMapChangesNothing) {
  scene.setSun(35, 270);
  EXPECT_TRUE(uniform(1.0f) == plain());
}

TEST_F(LightShadowTest, NoMapChangesNothing) {
  scene.setSun(35, 270);
  const Image with = plain();
  setQuality(0, WLK_SCATTERING_SINGLE);
  EXPECT_TRUE(plain() == with);
}

TEST_F(LightShadowTest, AllInShadowHasNoFirstOrder) {
  scene.setSun(35, 270);
  const Image lit = plain();
  const Image dark = uniform(0.0f);
  for (size_t i = 0; i < lit.rgba.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_LT(dark.rgba[i], (MIDPOINTS + FIRST_ORDER) * lit.rgba[i]) << i;
    }
  }
}

// The layer's density grows on below its base, in the shadow as in the light.
TEST_F(LightShadowTest, FogIsTheSameByAnyBase) {
  scene.setSun(35, 270);
  const Image lit = plain();
  const Image dark = uniform(0.0f);
  auto fog = make<WlkFog>();
  fog.baseAltitude = 1000;  // above all that is seen
  fog.scaleHeight = static_cast<float>(SCALE_HEIGHT);
  fog.extinction = static_cast<float>(EXTINCTION * std::exp(-1000 / SCALE_HEIGHT));
  check(wlkSetFog(scene.context, &fog));
  EXPECT_LT(relativeRms(plain(), lit), FIRST_ORDER);
  const Image other = uniform(0.0f);
  for (size_t i = 0; i < lit.rgba.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_LT(other.rgba[i], (MIDPOINTS + FIRST_ORDER) * lit.rgba[i]) << i;
      ASSERT_LT(dark.rgba[i], (MIDPOINTS + FIRST_ORDER) * lit.rgba[i]) << i;
    }
  }
}

// What the near half of the air and what the far half scatters is all: a gas between dims both.
TEST_F(LightShadowTest, HalvesAddUpInAGasThatAbsorbs) {
  check(wlkSetFog(scene.context, nullptr));
  scene.setSky();
  auto gas = make<WlkAbsorber>();
  std::fill_n(gas.absorption, 3, 2e-3f);
  gas.peakAltitude = 400;
  gas.halfWidth = 1500;
  check(wlkSetAbsorber(scene.context, &gas));
  scene.setSun(35, 270);
  const Image lit = plain();
  auto shadow = make<WlkLightShadow>();
  const LightFrame all({0, 0, 0}, 8000, directionTo(35, 270));
  all.write({0, 0, 0}, false, shadow.clipFromWorld[0]);
  std::array<Image, 2> halves;
  for (const bool near : {false, true}) {
    // Along u, the map's edge is at z = -500 m.
    std::vector<float> map;
    for (size_t i = 0; i < size_t{TEXELS} * TEXELS; ++i) {
      map.push_back((i % TEXELS >= 28) == near ? 0.0f : 1.0f);
    }
    halves[near ? 1 : 0] = shaded(shadow, map);
    EXPECT_LT(halves[near ? 1 : 0].mean(), 0.9 * lit.mean()) << "nothing to see";
  }
  double worst = 0;
  for (size_t i = 0; i < lit.rgba.size(); ++i) {
    if (i % 4 != 3) {
      const double sum = double{halves[0].rgba[i]} + double{halves[1].rgba[i]};
      worst = std::max(worst, std::abs(sum / double{lit.rgba[i]} - 1));
    }
  }
  std::printf("halves in a gas: sum within %.4f\n", worst);
  EXPECT_LT(worst, EDGES + MIDPOINTS + FIRST_ORDER);
}

// Beside the volumes own map the engine's is still read.
TEST_F(LightShadowTest, HoldsWithShadowsOfVolumesAsWell) {
  scene.setSun(35, 270);
  scene.addBall(0.01f);
  const Image dark = uniform(0.0f);
  setQuality(WLK_QUALITY_FLAG_LIGHT_SHADOWS | WLK_QUALITY_FLAG_VOLUME_SHADOWS,
             WLK_SCATTERING_SINGLE);
  const Image lit = plain();
  const Image both = uniform(0.0f);
  EXPECT_LT(both.mean(), 0.9 * lit.mean());
  EXPECT_LT(relativeRms(both, dark), MIDPOINTS + FIRST_ORDER);
}

// What was scattered before stays, and what lies beyond the map.
TEST_F(LightShadowTest, OnlyTheFirstOrderGoes) {
  scene.setSky();
  scene.setSun(35, 270);
  for (const bool fog : {true, false}) {
    if (!fog) {
      check(wlkSetFog(scene.context, nullptr));
    }
    setQuality(WLK_QUALITY_FLAG_LIGHT_SHADOWS, WLK_SCATTERING_SINGLE);
    const Image firstLit = plain();
    const Image firstDark = uniform(0.0f);
    setQuality(WLK_QUALITY_FLAG_LIGHT_SHADOWS, WLK_SCATTERING_DEFAULT);
    const Image allLit = plain();
    const Image allDark = uniform(0.0f);
    double worst = 0;
    for (size_t i = 0; i < firstLit.rgba.size(); ++i) {
      if (i % 4 != 3) {
        const double first = double{firstLit.rgba[i]} - double{firstDark.rgba[i]};
        const double all = double{allLit.rgba[i]} - double{allDark.rgba[i]};
        worst = std::max(worst, std::abs(first - all) / double{allLit.rgba[i]});
      }
    }
    std::printf("%s: shadow differs by %.5f of a pixel\n", fog ? "fog" : "air", worst);
    EXPECT_LT(worst, MIDPOINTS + FIRST_ORDER);
    EXPECT_GT(allDark.mean(), 0.01 * allLit.mean());
    EXPECT_LT(allDark.mean(), 0.9 * allLit.mean());
  }
}

TEST_F(LightShadowTest, AMapOfAnotherLightIsNotRead) {
  scene.setSun(35, 270);
  auto shadow = make<WlkLightShadow>();
  shadow.light = 1;
  const Image with = shaded(shadow, std::vector<float>(size_t{TEXELS} * TEXELS, 0.0f));
  EXPECT_TRUE(with == plain());
}

}  // namespace
}  // namespace welkin::test
