// SPDX-License-Identifier: MIT
// Maps of shadows: fields and images that are wrong, frames that do not fit, extreme scenes.
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"
#include "support/shadow_map_scene.hpp"

namespace welkin::test {
namespace {

using Info = WlkCloudShadowInfo;

Info small() {
  auto info = make<Info>();
  info.width = 16;
  info.height = 12;
  info.extent[0] = info.extent[1] = 4000;
  info.center[1] = 1500;
  info.center[2] = -5000;
  return info;
}

class ShadowMapAbuse : public ::testing::Test {
 protected:
  ShadowMapAbuse() : s(small()) {
    s.scene.setSun(50, 20);
    volume = s.scene.addBall(0.01f);
    check(wlkPrepare(s.scene.context));
    s.record();
    before = s.read();
  }
  ~ShadowMapAbuse() override {
    EXPECT_EQ(s.read(), before);
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }
  // In a frame of its own; nothing may be recorded.
  WlkResult render(const WlkVulkanImage* image) {
    auto frame = make<WlkFrameInfo>();
    frame.frameIndex = next;
    frame.completedFrameIndex = next - 1;
    check(wlkBeginFrame(s.scene.context, &frame));
    ++next;
    WlkResult result = WLK_SUCCESS;
    s.scene.device().run([&](VkCommandBuffer commands) {
      check(wlkVulkanCmdUpdate(s.scene.context, commands));
      SpyDevice::counts() = {};
      result = wlkVulkanCmdRenderCloudShadow(s.scene.context, commands, s.map, image);
      EXPECT_EQ(SpyDevice::counts().dispatches + SpyDevice::counts().barriers, 0u);
    });
    return result;
  }

  ShadowMapScene s;
  WlkVolume volume{};
  std::vector<float> before;
  uint64_t next = 2;
};

TEST_F(ShadowMapAbuse, FieldsOutOfRangeAreNamedAndChangeNothing) {
  struct Case {
    const char* field;
    void (*spoil)(Info&);
  };
  constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases{{"width", [](Info& i) { i.width = 0; }},
                                {"width", [](Info& i) { i.width = 8193; }},
                                {"height", [](Info& i) { i.height = 0xffffffff; }},
                                {"content", [](Info& i) { i.content = 3; }},
                                {"light", [](Info& i) { i.light = 2; }},
                                {"center", [](Info& i) { i.center[2] = 2e9; }},
                                {"center", [](Info& i) { i.center[0] = NOT_A_NUMBER; }},
                                {"extent", [](Info& i) { i.extent[0] = 0; }},
                                {"extent", [](Info& i) { i.extent[1] = NOT_A_NUMBER; }},
                                {"maxSamples", [](Info& i) { i.maxSamples = 0; }},
                                {"maxSamples", [](Info& i) { i.maxSamples = 5000; }}};
  for (const Case& test : cases) {
    Info info = small();
    test.spoil(info);
    WlkCloudShadow made{};
    EXPECT_FAILS(wlkCreateCloudShadow(s.scene.context, &info, &made), WLK_ERROR_INVALID_ARGUMENT,
                 test.field);
    EXPECT_EQ(made.id, 0u);
    EXPECT_FAILS(wlkSetCloudShadow(s.scene.context, s.map, &info), WLK_ERROR_INVALID_ARGUMENT,
                 test.field);
  }
  abuseHeader<Info>(
      small(), [&](const Info* info) { return wlkSetCloudShadow(s.scene.context, s.map, info); });
  const Info info = small();
  EXPECT_FAILS(wlkCreateCloudShadow(s.scene.context, &info, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "map");
  EXPECT_EQ(s.record().state.reason, uint32_t{WLK_REASON_UNCHANGED});
}

TEST_F(ShadowMapAbuse, HandlesThatAreNoMapAreRefused) {
  const Info info = small();
  auto state = make<WlkCloudShadowState>();
  for (const uint64_t id : {uint64_t{0}, volume.id, s.scene.view.id, s.map.id + (1 << 24)}) {
    const WlkCloudShadow bad{id};
    EXPECT_FAILS(wlkSetCloudShadow(s.scene.context, bad, &info), WLK_ERROR_INVALID_HANDLE, "map");
    EXPECT_FAILS(wlkGetCloudShadowState(s.scene.context, bad, &state), WLK_ERROR_INVALID_HANDLE,
                 "map");
    EXPECT_FAILS(wlkDestroyCloudShadow(s.scene.context, bad), WLK_ERROR_INVALID_HANDLE, "map");
  }
  EXPECT_FAILS(wlkGetCloudShadowState(s.scene.context, s.map, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "WlkCloudShadowState");
  WlkCloudShadow fresh{};
  check(wlkCreateCloudShadow(s.scene.context, &info, &fresh));
  EXPECT_EQ(wlkGetCloudShadowState(s.scene.context, fresh, &state), WLK_NOT_READY);
  check(wlkDestroyCloudShadow(s.scene.context, fresh));
  EXPECT_FAILS(wlkDestroyCloudShadow(s.scene.context, fresh), WLK_ERROR_INVALID_HANDLE, "map");
}

TEST_F(ShadowMapAbuse, ImagesThatDoNotFitAreRefused) {
  const WlkVulkanImage good = s.described;
  WlkVulkanImage bad = good;
  bad.image = VK_NULL_HANDLE;
  EXPECT_EQ(render(&bad), WLK_ERROR_INVALID_ARGUMENT);
  bad = good;
  bad.width = 17;
  EXPECT_EQ(render(&bad), WLK_ERROR_INVALID_ARGUMENT);
  bad = good;
  bad.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  EXPECT_EQ(render(&bad), WLK_ERROR_UNSUPPORTED_FORMAT);
  bad = good;
  bad.after.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  EXPECT_EQ(render(&bad), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render(nullptr), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render(&good), WLK_SUCCESS);
}

TEST_F(ShadowMapAbuse, CallsOutOfOrderAreRefused) {
  s.scene.device().run([&](VkCommandBuffer commands) {
    // The constructor's frame is still the context's last.
    EXPECT_FAILS(wlkVulkanCmdRenderCloudShadow(s.scene.context, commands, s.map, &s.described),
                 WLK_ERROR_WRONG_STATE, "map");
  });
  Info info = small();
  info.width = 32;
  check(wlkSetCloudShadow(s.scene.context, s.map, &info));
  WlkVulkanImage wider = s.described;
  wider.width = 32;
  EXPECT_EQ(render(&wider), WLK_ERROR_NOT_PREPARED);
  info = small();
  check(wlkSetCloudShadow(s.scene.context, s.map, &info));
  EXPECT_EQ(render(&s.described), WLK_ERROR_NOT_PREPARED);
  check(wlkPrepare(s.scene.context));
  s.scene.addBall(0.01f);
  EXPECT_EQ(render(&s.described), WLK_ERROR_NOT_PREPARED) << "room for one volume";
}

TEST(ShadowMapModes, NeedAnEngineDevice) {
  WlkContext context = nullptr;
  const auto cpu = make<WlkContextInfo>();
  check(wlkCreateContext(WLK_API_VERSION, &cpu, &context));
  const Info info = small();
  WlkCloudShadow map{};
  EXPECT_EQ(wlkCreateCloudShadow(context, &info, &map), WLK_ERROR_WRONG_STATE);
  wlkDestroyContext(context);
}

// Far away, thin, flat, dense, through the volume's faces and edges: finite, never negative.
TEST(ShadowMapExtremes, AreFinite) {
  for (const uint32_t content : {WLK_CLOUD_SHADOW_OPTICAL_DEPTH, WLK_CLOUD_SHADOW_LAYER}) {
    for (const bool half : {false, true}) {
      Info info = small();
      info.content = content;
      ShadowMapScene s(info, half);
      const WlkVolume volume =
          s.scene.addVolume(s.scene.addHenyeyGreenstein(0), {1, 3, 1},
                            boxTransform({-1000, 500, -6000}, {2000, 2000, 2000}), 1e6f);
      s.scene.upload(volume, {1, 3, 1}, {65504.0f, 0.0f, 1e-7f});
      check(wlkPrepare(s.scene.context));
      const std::vector<std::array<double, 12>> places{
          boxTransform({-1000, 500, -6000}, {2000, 2000, 2000}),
          boxTransform({-1000, 500, -6000}, {2000, 0.01, 2000}),
          boxTransform({0, 1500, -5000}, {0.01, 0.01, 0.01}),
          boxTransform({-1e8, -1e8, -1e8}, {2e8, 2e8, 2e8}),
          boxTransform({-1000, 9e8, -6000}, {2000, 2000, 2000})};
      for (const auto& place : places) {
        check(wlkSetVolumeTransform(s.scene.context, volume, place.data()));
        for (const double elevation : {90.0, 45.0, 0.0, -30.0, -90.0}) {
          s.scene.setSun(elevation, 0);
          s.record();
          const std::vector<float> texels = s.read();
          for (size_t i = 0; i < texels.size(); i += 4) {
            ASSERT_TRUE(std::isfinite(texels[i]) && texels[i] >= 0) << elevation;
            ASSERT_TRUE(std::isfinite(texels[i + 1]) && std::isfinite(texels[i + 2])) << elevation;
            ASSERT_LE(texels[i + 1], texels[i + 2]) << elevation;
          }
        }
      }
      EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
    }
  }
}

// The widest and densest volume that is accepted, of several fields: distances along the light,
// squared, times its optical depth would be no float.
TEST(ShadowMapExtremes, OfTheMostThatIsAcceptedAreFinite) {
  Info info = small();
  info.content = WLK_CLOUD_SHADOW_LAYER;
  ShadowMapScene s(info);
  s.scene.setSun(71.565, 90);  // along the longest diagonal
  const WlkMedium medium = s.scene.addHenyeyGreenstein(0);
  const std::array<WlkVolumeField, 2> fields{WlkVolumeField{medium, 1e6f, 0},
                                             WlkVolumeField{medium, 1e6f, 0}};
  auto volume = make<WlkVolumeInfo>();
  std::fill_n(volume.size, 3, 1u);
  volume.fieldCount = 2;
  volume.fields = fields.data();
  const std::array<double, 12> place{1e9, -1e9, -1e9, 5e8, 1e9, 1e9, -1e9, -5e8, 1e9, 0, 1e9, -1e9};
  std::copy(place.begin(), place.end(), volume.worldFromVolume);
  WlkVolume made{};
  check(wlkCreateVolume(s.scene.context, &volume, &made));
  for (uint32_t field = 0; field < 2; ++field) {
    s.scene.upload(made, {1, 1, 1}, {65504.0f}, field);
  }
  check(wlkPrepare(s.scene.context));
  s.record();
  const std::vector<float> texels = s.read();
  for (size_t i = 0; i < texels.size(); i += 4) {
    ASSERT_TRUE(std::isfinite(texels[i]) && texels[i] >= 1e6f) << i;
    ASSERT_TRUE(std::isfinite(texels[i + 1]) && std::isfinite(texels[i + 2])) << i;
    ASSERT_LT(texels[i + 1], texels[i + 2]) << i;
  }
  EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
}

}  // namespace
}  // namespace welkin::test
