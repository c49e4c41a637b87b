// SPDX-License-Identifier: MIT
// Shadow maps of the engine: fields, matrices and images that are wrong, and extreme ones that are
// right: clear errors and the picture as before, or finite pictures.
#include "support/light_shadow.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "stress/abuse.hpp"
#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t TEXELS = 8;
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr float INFINITE = std::numeric_limits<float>::infinity();
const Vec3 TO_SUN = directionTo(30, 20);

SceneOptions small() {
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  options.qualityFlags = WLK_QUALITY_FLAG_LIGHT_SHADOWS;
  return options;
}

WlkLightShadow validShadow() {
  auto shadow = make<WlkLightShadow>();
  shadow.cascadeCount = 2;
  LightFrame({0, 0, 0}, 500, TO_SUN).write({0, 0, 0}, false, shadow.clipFromWorld[0]);
  LightFrame({0, 0, 0}, 9000, TO_SUN).write({0, 0, 0}, true, shadow.clipFromWorld[1]);
  return shadow;
}

struct ShadowCase {
  const char* field;
  WlkResult code;
  std::function<void(WlkLightShadow&)> spoil;
};

std::vector<ShadowCase> wrongShadows() {
  using S = WlkLightShadow;
  constexpr WlkResult BAD = WLK_ERROR_INVALID_ARGUMENT;
  return {
      {"cascadeCount", BAD, [](S& s) { s.cascadeCount = 0; }},
      {"cascadeCount", BAD, [](S& s) { s.cascadeCount = 5; }},
      {"light", BAD, [](S& s) { s.light = 2; }},
      {"origin", BAD, [](S& s) { s.origin[1] = std::nan(""); }},
      {"origin", BAD, [](S& s) { s.origin[2] = 2e9; }},
      {"bias", BAD, [](S& s) { s.bias = -1; }},
      {"bias", BAD, [](S& s) { s.bias = NOT_A_NUMBER; }},
      {"clipFromWorld", BAD, [](S& s) { s.clipFromWorld[0][5] = NOT_A_NUMBER; }},
      {"clipFromWorld", BAD, [](S& s) { s.clipFromWorld[1][12] = INFINITE; }},
      {"clipFromWorld", BAD, [](S& s) { s.clipFromWorld[1][0] = 2e9f; }},
      // Perspective, or w of 0 and less.
      {"clipFromWorld", BAD, [](S& s) { s.clipFromWorld[1][11] = 1; }},
      {"clipFromWorld", BAD, [](S& s) { s.clipFromWorld[0][15] = 0; }},
      {"clipFromWorld", BAD, [](S& s) { s.clipFromWorld[0][15] = -1; }},
      // Singular: all 0, two equal rows, no depth.
      {"clipFromWorld", BAD, [](S& s) { std::memset(s.clipFromWorld[1], 0, 15 * sizeof(float)); }},
      {"clipFromWorld", BAD,
       [](S& s) {
         for (size_t i = 0; i < 3; ++i) {
           s.clipFromWorld[0][4 * i + 1] = s.clipFromWorld[0][4 * i];
         }
       }},
      {"clipFromWorld", BAD,
       [](S& s) {
         for (size_t i = 0; i < 3; ++i) {
           s.clipFromWorld[0][4 * i + 2] = 0;
         }
       }},
      // Across the light.
      {"clipFromWorld", BAD,
       [](S& s) {
         const Vec3 across = unit(cross(TO_SUN, {0, 1, 0}));
         LightFrame({0, 0, 0}, 100, across).write({0, 0, 0}, false, s.clipFromWorld[0]);
       }},
      {"sType", WLK_ERROR_UNKNOWN_STRUCT, [](S& s) { s.sType = WLK_STRUCT_SKY; }},
      {"structSize", BAD, [](S& s) { s.structSize = 16; }}};
}

class LightShadowAbuse : public ::testing::Test {
 protected:
  LightShadowAbuse() : scene(small()) {
    scene.setSky();
    scene.setFog(0.001f, 300);
    scene.setSun(30, 20);
    scene.setCamera({0, 30, 0}, 0, 5);
    before = scene.render();
  }
  ~LightShadowAbuse() override {
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
  WlkHeadlessInputs targets() const {
    auto t = make<WlkHeadlessInputs>();
    t.lightShadow = &shadow;
    t.shadowDepth = depth.data();
    t.shadowDepthSize = depth.size() * sizeof(float);
    t.shadowWidth = t.shadowHeight = TEXELS;
    return t;
  }
  WlkResult render(const WlkHeadlessInputs& t) const {
    return wlkRenderHeadless(scene.context, scene.view, &t);
  }

  HeadlessScene scene;
  WlkLightShadow shadow = validShadow();
  std::vector<float> depth = std::vector<float>(4 * TEXELS * TEXELS, 0.25f);
  Image before;
};

TEST_F(LightShadowAbuse, WrongFieldsAreNamedAndChangeNothing) {
  for (const ShadowCase& test : wrongShadows()) {
    shadow = validShadow();
    test.spoil(shadow);
    EXPECT_FAILS(render(targets()), test.code, test.field);
  }
  shadow = validShadow();
  struct Case {
    const char* field;
    std::function<void(WlkHeadlessInputs&)> spoil;
  };
  using T = WlkHeadlessInputs;
  const std::vector<Case> cases{{"shadowDepth", [](T& t) { t.shadowDepth = nullptr; }},
                                {"shadowDepthSize", [](T& t) { t.shadowDepthSize = 4; }},
                                {"shadowWidth", [](T& t) { t.shadowWidth = 0; }},
                                {"shadowHeight", [](T& t) { t.shadowHeight = 8193; }}};
  for (const Case& test : cases) {
    WlkHeadlessInputs bad = targets();
    test.spoil(bad);
    EXPECT_FAILS(render(bad), WLK_ERROR_INVALID_ARGUMENT, test.field);
  }
  const auto bad = [&] {
    WlkHeadlessInputs tall = targets();
    tall.shadowHeight = 8193;
    return tall;
  };
  depth[2 * TEXELS * TEXELS - 1] = NOT_A_NUMBER;
  EXPECT_FAILS(render(targets()), WLK_ERROR_INVALID_ARGUMENT, "shadowDepth");
  depth[2 * TEXELS * TEXELS - 1] = 0.25f;
  EXPECT_TRUE(scene.render() == before);
  const uint64_t frame = scene.stats().frameIndex;
  EXPECT_FAILS(render(bad()), WLK_ERROR_INVALID_ARGUMENT, "shadowHeight");
  EXPECT_EQ(render(targets()), WLK_SUCCESS);
  EXPECT_EQ(scene.stats().frameIndex, frame + 1) << "what is refused is no frame";
  scene.setQuality(WLK_QUALITY_LOW);
  check(wlkPrepare(scene.context));
  EXPECT_FAILS(render(targets()), WLK_ERROR_WRONG_STATE, "lightShadow");
}

// Values outside [0, 1], maps of a metre and of a planet, eyes far away, light from straight above.
TEST_F(LightShadowAbuse, ExtremesStayFinite) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anyOf(-1, 1);
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    const double elevation = i % 4 == 0 ? 89.99 : 45 + 44 * anyOf(random);
    const double azimuth = 180 * anyOf(random);
    scene.setSun(elevation, azimuth);
    const double far = std::pow(10.0, 4 + 4.9 * anyOf(random));
    const Vec3 eye{far * anyOf(random), 1 + std::abs(far * anyOf(random)), far * anyOf(random)};
    scene.setCamera(eye, 180 * anyOf(random), 80 * anyOf(random));
    shadow = make<WlkLightShadow>();
    shadow.cascadeCount = 1 + static_cast<uint32_t>(i) % WLK_MAX_SHADOW_CASCADES;
    shadow.bias = static_cast<float>(std::pow(10.0, 6 * anyOf(random)));
    std::copy(eye.begin(), eye.end(), shadow.origin);
    for (uint32_t k = 0; k < shadow.cascadeCount; ++k) {
      const double edge = std::pow(10.0, 3.4 + 3.4 * anyOf(random));
      LightFrame(eye, edge, directionTo(elevation, azimuth))
          .write(eye, k % 2 == 0, shadow.clipFromWorld[k]);
    }
    for (float& value : depth) {
      value = static_cast<float>(i % 5 == 0 ? 1e30 * anyOf(random) : 0.5 + 0.6 * anyOf(random));
    }
    ASSERT_EQ(render(targets()), WLK_SUCCESS) << lastError().message;
    EXPECT_EQ(scene.read(WLK_IMAGE_COLOR).badValues(), 0u);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
  }
}

TEST(LightShadowImageAbuse, WrongImagesAreNamedAndRecordNothing) {
  EngineScene scene(small());
  const SpyImage texels(scene.device(), VK_FORMAT_R32_SFLOAT, {TEXELS, TEXELS, 1},
                        VK_IMAGE_USAGE_SAMPLED_BIT);
  std::memset(texels.bytes(), 0, sizeof(float) * TEXELS * TEXELS);
  texels.write(VK_IMAGE_LAYOUT_GENERAL);
  scene.setSky();
  scene.setSun(30, 20);
  check(wlkPrepare(scene.context));
  scene.renderFrame();
  const Image before = scene.read();
  const WlkVulkanImage color = scene.describe(scene.target(), VK_IMAGE_LAYOUT_GENERAL);
  const WlkVulkanImage right = scene.describe(texels, VK_IMAGE_LAYOUT_GENERAL);
  WlkLightShadow shadow = validShadow();
  shadow.cascadeCount = 1;
  auto frame = make<WlkFrameInfo>();
  frame.frameIndex = 50;
  frame.completedFrameIndex = 49;
  check(wlkBeginFrame(scene.context, &frame));
  using T = WlkVulkanViewTargets;
  using I = WlkVulkanImage;
  struct Case {
    const char* field;
    WlkResult code;
    std::function<void(T&, I&)> spoil;
  };
  constexpr WlkResult BAD = WLK_ERROR_INVALID_ARGUMENT;
  std::vector<Case> cases{
      {"shadowMap", BAD, [](T& t, I&) { t.shadowMap = nullptr; }},
      {"lightShadow", BAD, [](T& t, I&) { t.lightShadow = nullptr; }},
      {"shadowMap", BAD, [](T&, I& i) { i.image = VK_NULL_HANDLE; }},
      {"shadowMap", BAD, [](T&, I& i) { i.depth = 0; }},
      {"shadowMap", BAD, [](T&, I& i) { i.depth = 1u << 30; }},
      {"shadowMap", BAD, [](T&, I& i) { i.after.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"shadowMap", WLK_ERROR_UNSUPPORTED_FORMAT,
       [](T&, I& i) { i.format = VK_FORMAT_R8G8B8A8_UNORM; }},
      {"sType", WLK_ERROR_UNKNOWN_STRUCT, [](T&, I& i) { i.sType = WLK_STRUCT_SKY; }}};
  for (const Case& test : cases) {
    WlkVulkanViewTargets targets = scene.targets(color);
    WlkVulkanImage image = right;
    targets.lightShadow = &shadow;
    targets.shadowMap = &image;
    test.spoil(targets, image);
    scene.device().run([&](VkCommandBuffer commands) {
      SpyDevice::counts() = {};
      EXPECT_FAILS(wlkVulkanCmdRenderView(scene.context, commands, scene.view, &targets), test.code,
                   test.field);
      const VulkanCounts& counts = SpyDevice::counts();
      EXPECT_EQ(counts.dispatches + counts.draws + counts.barriers + counts.copies, 0u);
    });
  }
  EXPECT_TRUE(scene.read() == before);
  check(wlkVulkanForgetImage(scene.context, texels.handle));
  EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
}

}  // namespace
}  // namespace welkin::test
