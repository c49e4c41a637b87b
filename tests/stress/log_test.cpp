// SPDX-License-Identifier: MIT
// The log: what no call returns as an error, and which message it is.
#include <welkin/welkin_vulkan.h>

#include <limits>
#include <string>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

struct Message {
  uint32_t severity;
  uint32_t id;
  std::string text;
};

class Log : public ::testing::Test {
 protected:
  Log() {
    chooseDriver();
    auto headless = make<WlkHeadlessInfo>();
    auto info = make<WlkContextInfo>();
    info.next = &headless;
    info.log = [](void* user, const WlkLogMessage* m) {
      EXPECT_EQ(m->sType, uint32_t{WLK_STRUCT_LOG_MESSAGE});
      EXPECT_EQ(m->structSize, sizeof(WlkLogMessage));
      EXPECT_EQ(m->next, nullptr);
      static_cast<std::vector<Message>*>(user)->push_back({m->severity, m->id, m->text});
    };
    info.logUser = &messages;
    check(wlkCreateContext(WLK_API_VERSION, &info, &context));
    auto viewInfo = make<WlkViewInfo>();
    viewInfo.width = viewInfo.height = 8;
    check(wlkCreateView(context, &viewInfo, &view));
  }
  ~Log() override { wlkDestroyContext(context); }

  // Those with the id, which are taken out.
  std::vector<Message> take(uint32_t id) {
    std::vector<Message> found;
    std::erase_if(messages, [&](const Message& m) {
      if (m.id == id) {
        found.push_back(m);
      }
      return m.id == id;
    });
    return found;
  }

  std::vector<Message> messages;
  WlkContext context = nullptr;
  WlkView view{};
};

TEST_F(Log, SaysHowManyVoxelsWereReplaced) {
  WlkMedium medium{};
  const auto mediumInfo = make<WlkMediumInfo>();
  check(wlkCreateMedium(context, &mediumInfo, &medium));
  WlkVolumeField field{};
  field.medium = medium;
  auto info = make<WlkVolumeInfo>();
  info.size[0] = info.size[1] = info.size[2] = 8;
  info.fieldCount = 1;
  info.fields = &field;
  WlkVolume volume{};
  check(wlkCreateVolume(context, &info, &volume));
  std::vector<float> values(512, 0.5f);
  auto upload = make<WlkVolumeUpload>();
  std::fill_n(upload.extent, 3, 8);
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  check(wlkUploadVolume(context, volume, &upload));
  EXPECT_TRUE(take(WLK_LOG_ID_VALUES_REPLACED).empty());
  values[3] = -1;
  values[4] = std::numeric_limits<float>::quiet_NaN();
  values[5] = 1e6f;
  values[6] = -0.0f;  // that is 0
  check(wlkUploadVolume(context, volume, &upload));
  const std::array<uint32_t, 3> origin{};
  auto bricks = make<WlkVolumeBricks>();
  bricks.count = 1;
  bricks.coordinates = origin.data();
  bricks.data = values.data();
  bricks.dataSize = values.size() * sizeof(float);
  check(wlkUploadVolumeBricks(context, volume, &bricks));
  const std::vector<Message> told = take(WLK_LOG_ID_VALUES_REPLACED);
  ASSERT_EQ(told.size(), 2u);
  for (const Message& message : told) {
    EXPECT_EQ(message.severity, uint32_t{WLK_LOG_WARNING});
    EXPECT_NE(message.text.find(": 3 voxels"), std::string::npos) << message.text;
  }
  EXPECT_TRUE(messages.empty());
}

TEST_F(Log, SaysWhatPreparingTook) {
  check(wlkPrepare(context));
  const std::vector<Message> told = take(WLK_LOG_ID_PREPARED);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].severity, uint32_t{WLK_LOG_INFO});
  EXPECT_NE(told[0].text.find("1 views"), std::string::npos) << told[0].text;
  EXPECT_TRUE(messages.empty());
}

TEST_F(Log, SaysOnceThatAShadowMapIsOfNoUse) {
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.flags = WLK_QUALITY_FLAG_LIGHT_SHADOWS;
  check(wlkSetQuality(context, view, &quality));
  const auto light = make<WlkLight>();
  check(wlkSetLights(context, 1, sizeof light, &light));
  auto shadow = make<WlkLightShadow>();
  // Down from above: x and z across, depth along -y.
  const float matrix[16] = {0.01f, 0, 0, 0, 0, 0, 0.001f, 0, 0, 0.01f, 0, 0, 0, 0, 0.5f, 1};
  std::copy(std::begin(matrix), std::end(matrix), shadow.clipFromWorld[0]);
  const std::vector<float> depth(16, 0.0f);
  auto inputs = make<WlkHeadlessInputs>();
  inputs.lightShadow = &shadow;
  inputs.shadowDepth = depth.data();
  inputs.shadowDepthSize = depth.size() * sizeof(float);
  inputs.shadowWidth = inputs.shadowHeight = 4;
  check(wlkPrepare(context));
  for (int frame = 0; frame < 3; ++frame) {  // without air: nothing to shade
    check(wlkRenderHeadless(context, view, &inputs));
  }
  ASSERT_EQ(take(WLK_LOG_ID_SHADOW_MAP_UNUSED).size(), 1u);
  const auto sky = make<WlkSky>();
  check(wlkSetSky(context, &sky));
  check(wlkPrepare(context));
  check(wlkRenderHeadless(context, view, &inputs));
  EXPECT_TRUE(take(WLK_LOG_ID_SHADOW_MAP_UNUSED).empty());
  check(wlkSetSky(context, nullptr));
  check(wlkPrepare(context));
  check(wlkRenderHeadless(context, view, &inputs));
  EXPECT_EQ(take(WLK_LOG_ID_SHADOW_MAP_UNUSED).size(), 1u);
}

}  // namespace
}  // namespace welkin::test
