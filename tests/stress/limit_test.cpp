// SPDX-License-Identifier: MIT
// Sizes, counts, enumerations and flags outside their ranges; states that do not fit the call.
#include <welkin/welkin_vulkan.h>

#include <cmath>

#include "stress/abuse.hpp"
#include "support/on_gpu.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t HUGE_COUNT = 0xffffffffu;

template <typename T>
struct Case {
  const char* field;
  WlkResult code;
  std::function<void(T&)> spoil;
};

TEST(Limits, OfVolumesAreChecked) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  using Info = WlkVolumeInfo;
  const std::vector<Case<Info>> cases{
      {"size", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.size[1] = 0; }},
      {"size", WLK_ERROR_LIMIT_EXCEEDED, [](Info& v) { v.size[2] = HUGE_COUNT; }},
      {"size", WLK_ERROR_LIMIT_EXCEEDED, [](Info& v) { v.size[0] = 32769; }},
      {"fieldCount", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.fieldCount = 0; }},
      {"fieldCount", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.fieldCount = 5; }},
      {"fieldCount", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.fieldCount = HUGE_COUNT; }},
      {"fieldStride", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.fieldStride = 0; }},
      {"fieldStride", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.fieldStride = 15; }},
      {"fields", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.fields = nullptr; }},
      {"reserved0", WLK_ERROR_INVALID_ARGUMENT,
       [&](Info& v) {
         static WlkVolumeField garbage{};
         garbage = *v.fields;
         garbage.reserved0 = 1;
         v.fields = &garbage;
       }},
      {"worldFromVolume", WLK_ERROR_INVALID_ARGUMENT,
       [](Info& v) { v.worldFromVolume[0] = 0; }},  // flat
      {"worldFromVolume", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) {
         v.worldFromVolume[1] = v.worldFromVolume[5] = 1;
         v.worldFromVolume[4] = 1;
       }}};
  WlkVolumeField field{};
  field.medium = victim.medium;
  field.extinctionScale = 1;
  for (const auto& test : cases) {
    auto info = make<Info>();
    info.fieldCount = 1;
    info.fields = &field;
    test.spoil(info);
    WlkVolume volume{};
    EXPECT_FAILS(wlkCreateVolume(c, &info, &volume), test.code, test.field);
    EXPECT_EQ(volume.id, 0u);
  }
  auto good = make<Info>();
  good.fieldCount = 1;
  good.fields = &field;
  EXPECT_FAILS(wlkCreateVolume(c, &good, nullptr), WLK_ERROR_INVALID_ARGUMENT, "volume");
  EXPECT_FAILS(wlkSetVolumeTransform(c, victim.volume, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "worldFromVolume");
  victim.expectUnchanged();
}

TEST(Limits, AVolumeThatNoHeapHoldsIsRefusedAtOnce) {
  VictimScene& victim = VictimScene::get();
  auto capabilities = make<WlkCapabilities>();
  ASSERT_EQ(wlkGetCapabilities(victim.scene.context, &capabilities), WLK_SUCCESS);
  std::array<WlkVolumeField, 4> fields{};
  for (WlkVolumeField& field : fields) {
    field.medium = victim.medium;
    field.extinctionScale = 1;
  }
  auto info = make<WlkVolumeInfo>();
  info.size[0] = info.size[1] = info.size[2] = 4096;
  info.fieldCount = 4;
  info.fields = fields.data();
  WlkVolume volume{};
  // 4 fields of 4096^3 half floats are 512 GiB.
  const bool allowed = capabilities.maxVolumeSize >= 4096;
  EXPECT_FAILS(wlkCreateVolume(victim.scene.context, &info, &volume),
               allowed ? WLK_ERROR_OUT_OF_DEVICE_MEMORY : WLK_ERROR_LIMIT_EXCEEDED, "size");
  victim.expectUnchanged();
}

TEST(Limits, OfViewsAreChecked) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  using Info = WlkViewInfo;
  const std::vector<Case<Info>> cases{
      {"width", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.width = 0; }},
      {"width", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.width = 16385; }},
      {"height", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.height = 0; }},
      {"height", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.height = HUGE_COUNT; }},
      {"composite", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.composite = 3; }},
      {"composite", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.composite = HUGE_COUNT; }},
      {"composite", WLK_ERROR_WRONG_STATE, [](Info& v) { v.composite = WLK_COMPOSITE_BLEND; }},
      {"targetFormat", WLK_ERROR_UNSUPPORTED_FORMAT, [](Info& v) { v.targetFormat = 0; }},
      {"targetFormat", WLK_ERROR_UNSUPPORTED_FORMAT, [](Info& v) { v.targetFormat = 4; }},
      {"targetFormat", WLK_ERROR_UNSUPPORTED_FORMAT, [](Info& v) { v.targetFormat = HUGE_COUNT; }},
      {"layers", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.layers = 0x40; }},
      {"layers", WLK_ERROR_INVALID_ARGUMENT, [](Info& v) { v.layers = ~uint64_t{0}; }}};
  for (const auto& test : cases) {
    auto info = make<Info>();
    info.width = info.height = 9;
    info.layers = WLK_LAYER_SKY;
    test.spoil(info);
    WlkView view{};
    EXPECT_FAILS(wlkCreateView(scene.context, &info, &view), test.code, test.field);
    EXPECT_EQ(view.id, 0u);
    EXPECT_FAILS(wlkUpdateView(scene.context, scene.view, &info), test.code, test.field);
  }
  // ALL is what a newer header means by it, too: all that this library has.
  for (const uint64_t layers :
       {uint64_t{WLK_LAYER_ALL}, uint64_t{WLK_LAYER_ALL & ~WLK_LAYER_GROUND},
        uint64_t{WLK_LAYER_SKY | WLK_LAYER_SURFACES}}) {
    auto of = make<Info>();
    EXPECT_EQ(of.layers, uint64_t{WLK_LAYER_ALL});
    of.width = of.height = 9;
    of.layers = layers;
    WlkView view{};
    EXPECT_EQ(wlkCreateView(scene.context, &of, &view), WLK_SUCCESS) << layers;
    EXPECT_EQ(wlkDestroyView(scene.context, view), WLK_SUCCESS);
  }
  const auto info = make<Info>();
  EXPECT_FAILS(wlkCreateView(scene.context, &info, nullptr), WLK_ERROR_INVALID_ARGUMENT, "view");
  EXPECT_FAILS(wlkCreateView(scene.context, nullptr, nullptr), WLK_ERROR_INVALID_ARGUMENT, "view");
  victim.expectUnchanged();
}

TEST(Limits, OfTheQualityAreChecked) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  using Q = WlkQuality;
  const std::vector<Case<Q>> cases{
      {"level", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.level = 4; }},
      {"level", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.level = HUGE_COUNT; }},
      {"sliceCount", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.sliceCount = 7; }},
      {"sliceCount", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.sliceCount = 2049; }},
      {"sliceCount", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.sliceCount = HUGE_COUNT; }},
      {"batchSize", WLK_ERROR_INVALID_ARGUMENT,
       [](Q& q) {
         q.sliceCount = 16;
         q.batchSize = 17;
       }},
      {"batchSize", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.batchSize = HUGE_COUNT; }},
      {"lightBufferSize", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.lightBufferSize = 15; }},
      {"lightBufferSize", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.lightBufferSize = 2049; }},
      {"slicing", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.slicing = 3; }},
      {"scattering", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.scattering = 5; }},
      {"volumeCells", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.volumeCells = 7; }},
      {"volumeCells", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.volumeCells = 129; }},
      {"volumeCells", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.volumeCells = HUGE_COUNT; }},
      {"volumeResolution", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.volumeResolution = 3; }},
      {"lightFrames", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.lightFrames = 65; }},
      {"lightFrames", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.lightFrames = HUGE_COUNT; }},
      {"control", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.control = 4; }},
      {"lowestLevel", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.lowestLevel = WLK_QUALITY_ULTRA; }},
      {"timeBudget_ms", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.timeBudget_ms = 1; }},
      {"timeBudget_ms", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.control = WLK_CONTROL_TIME; }},
      {"timeBudget_ms", WLK_ERROR_INVALID_ARGUMENT,
       [](Q& q) {
         q.control = WLK_CONTROL_REPORTED_TIME;
         q.timeBudget_ms = NAN;
       }},
      {"timeBudget_ms", WLK_ERROR_INVALID_ARGUMENT,
       [](Q& q) {
         q.control = WLK_CONTROL_TIME;
         q.timeBudget_ms = 1e30f;
       }},
      {"errorTarget", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.errorTarget = 0.1f; }},
      {"errorTarget", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.control = WLK_CONTROL_ERROR; }},
      {"errorTarget", WLK_ERROR_INVALID_ARGUMENT,
       [](Q& q) {
         q.control = WLK_CONTROL_ERROR;
         q.errorTarget = -1;
       }},
      {"sliceCount", WLK_ERROR_INVALID_ARGUMENT,
       [](Q& q) {
         q.control = WLK_CONTROL_ERROR;
         q.errorTarget = 0.1f;
       }},
      {"flags", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.flags = 8; }},
      {"flags", WLK_ERROR_INVALID_ARGUMENT, [](Q& q) { q.flags = uint64_t{1} << 63; }}};
  for (const auto& test : cases) {
    auto quality = make<Q>();
    quality.sliceCount = 9;
    test.spoil(quality);
    EXPECT_FAILS(wlkSetQuality(scene.context, scene.view, &quality), test.code, test.field);
  }
  victim.expectUnchanged();
}

// Light inside volumes needs lists that lavapipe does not hold; nothing has changed then.
TEST(Limits, CellsThatTheDeviceDoesNotHoldAreRefused) {
  SceneOptions options;
  options.width = options.height = 8;
  const HeadlessScene scene(options);
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  const Image before = scene.render();
  auto quality = make<WlkQuality>();
  quality.volumeCells = 128;  // 50 floats each in a list: 400 MiB
  check(wlkSetQuality(scene.context, scene.view, &quality));
  if (onGpu()) {
    GTEST_SKIP() << "GPUs hold lists of any length";
  }
  EXPECT_FAILS(wlkPrepare(scene.context), WLK_ERROR_LIMIT_EXCEEDED, "volumeCells");
  scene.setQuality(options.level);
  EXPECT_TRUE(scene.render() == before);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

TEST(Limits, OfMediaLightsAndContextsAreChecked) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  auto medium = make<WlkMediumInfo>();
  WlkMedium made{};
  for (const uint32_t particle : {10u, HUGE_COUNT}) {
    medium.particle = particle;
    EXPECT_FAILS(wlkCreateMedium(c, &medium, &made), WLK_ERROR_INVALID_ARGUMENT, "particle");
  }
  medium = make<WlkMediumInfo>();
  EXPECT_FAILS(wlkCreateMedium(c, &medium, nullptr), WLK_ERROR_INVALID_ARGUMENT, "medium");

  auto light = make<WlkLight>();
  light.irradiance[0] = 9.0f;
  EXPECT_FAILS(wlkSetLights(c, 3, sizeof light, &light), WLK_ERROR_LIMIT_EXCEEDED, "count");
  EXPECT_FAILS(wlkSetLights(c, HUGE_COUNT, sizeof light, &light), WLK_ERROR_LIMIT_EXCEEDED,
               "count");
  EXPECT_FAILS(wlkSetLights(c, 1, sizeof light - 1, &light), WLK_ERROR_INVALID_ARGUMENT, "stride");
  EXPECT_FAILS(wlkSetLights(c, 1, 0, &light), WLK_ERROR_INVALID_ARGUMENT, "stride");
  EXPECT_FAILS(wlkSetLights(c, 1, sizeof light, nullptr), WLK_ERROR_INVALID_ARGUMENT, "lights");
  victim.expectUnchanged();

  using Info = WlkContextInfo;
  const std::vector<Case<Info>> cases{
      {"maxFramesInFlight", WLK_ERROR_INVALID_ARGUMENT, [](Info& i) { i.maxFramesInFlight = 0; }},
      {"maxFramesInFlight", WLK_ERROR_INVALID_ARGUMENT, [](Info& i) { i.maxFramesInFlight = 9; }},
      {"allocator", WLK_ERROR_INVALID_ARGUMENT,
       [](Info& i) {
         i.allocator.allocate = [](void*, uint64_t, uint64_t) -> void* { return nullptr; };
       }},
      {"allocator", WLK_ERROR_INVALID_ARGUMENT,
       [](Info& i) { i.allocator.release = [](void*, void*, uint64_t, uint64_t) {}; }}};
  for (const auto& test : cases) {
    auto info = make<Info>();
    test.spoil(info);
    WlkContext context = nullptr;
    EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), test.code, test.field);
    EXPECT_EQ(context, nullptr);
  }
}

TEST(Limits, HeadlessInputsSayHowLargeTheyAre) {
  VictimScene& victim = VictimScene::get();  // 16 x 12 pixels
  const std::vector<float> pixels(16 * 12 * 4, 1.0f);
  auto inputs = make<WlkHeadlessInputs>();
  inputs.color = pixels.data();
  inputs.colorSize = 16 * 12 * 16 - 1;
  const auto render = [&] {
    return wlkRenderHeadless(victim.scene.context, victim.scene.view, &inputs);
  };
  EXPECT_FAILS(render(), WLK_ERROR_INVALID_ARGUMENT, "colorSize");
  inputs.colorSize += 1;
  EXPECT_EQ(render(), WLK_SUCCESS);
  inputs.depth = pixels.data();
  inputs.depthSize = 16 * 12 * 4 - 1;
  EXPECT_FAILS(render(), WLK_ERROR_INVALID_ARGUMENT, "depthSize");
  inputs.depthSize += 1;
  EXPECT_EQ(render(), WLK_SUCCESS);
  victim.expectUnchanged();
}

TEST(Limits, NullAmbientLightIsThatOfANewContext) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  // With air there is light to come from the sky again, which needs pipelines of its own.
  ASSERT_EQ(wlkSetAmbient(c, nullptr), WLK_SUCCESS);
  EXPECT_FAILS(wlkRenderHeadless(c, victim.scene.view, nullptr), WLK_ERROR_NOT_PREPARED, "view");
  auto off = make<WlkAmbient>();
  EXPECT_EQ(off.mode, uint32_t{WLK_AMBIENT_AUTOMATIC});
  off.mode = WLK_AMBIENT_OFF;
  ASSERT_EQ(wlkSetAmbient(c, &off), WLK_SUCCESS);
  ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
  victim.expectUnchanged();
}

TEST(Limits, CallersOfTheSameMajorVersionAreTaken) {
  const auto info = make<WlkContextInfo>();
  WlkContext context = nullptr;
  for (const uint32_t other : {0u, HUGE_COUNT, WLK_MAKE_VERSION(WLK_VERSION_MAJOR + 1, 0, 0),
                               WLK_MAKE_VERSION(WLK_VERSION_MAJOR - 1, 1, 0)}) {
    EXPECT_FAILS(wlkCreateContext(other, &info, &context), WLK_ERROR_VERSION, "apiVersion")
        << other;
    EXPECT_EQ(context, nullptr);
  }
  for (const uint32_t version :
       {WLK_MAKE_VERSION(WLK_VERSION_MAJOR, 0, 0), uint32_t{WLK_API_VERSION},
        WLK_MAKE_VERSION(WLK_VERSION_MAJOR, WLK_VERSION_MINOR + 7, 3)}) {
    EXPECT_EQ(wlkCreateContext(version, &info, &context), WLK_SUCCESS) << version;
    wlkDestroyContext(context);
  }
}

TEST(Limits, AHeadlessContextRefusesUnknownFlagsAndNamesTheDeviceItDidNotFind) {
  chooseDriver();
  auto headless = make<WlkHeadlessInfo>();
  auto info = make<WlkContextInfo>();
  info.next = &headless;
  WlkContext context = nullptr;
  headless.flags = uint64_t{1} << 40;
  EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_ERROR_INVALID_ARGUMENT,
               "flags");
  headless.flags = 0;
  headless.deviceName = "no device has this name";
  EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_ERROR_NO_DEVICE,
               "deviceName");
  EXPECT_EQ(context, nullptr);
}

TEST(Limits, ReadBackWritesNothingUnlessEverythingFits) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  victim.expectUnchanged();
  std::vector<float> pixels(16 * 12 * 4, -5.0f);
  auto image = make<WlkImageData>();
  image.dataSize = pixels.size() * sizeof(float);
  EXPECT_FAILS(wlkReadback(scene.context, scene.view, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "WlkImageData");
  EXPECT_FAILS(wlkReadback(scene.context, scene.view, &image), WLK_ERROR_INVALID_ARGUMENT, "data");
  image.data = pixels.data();
  image.dataSize -= 1;
  EXPECT_FAILS(wlkReadback(scene.context, scene.view, &image), WLK_ERROR_INVALID_ARGUMENT,
               "dataSize");
  image.dataSize += 1;
  for (const uint32_t kind :
       {uint32_t{WLK_IMAGE_RADIANCE}, uint32_t{WLK_IMAGE_TRANSMITTANCE}, 3u, HUGE_COUNT}) {
    image.image = kind;
    EXPECT_FAILS(wlkReadback(scene.context, scene.view, &image), WLK_ERROR_INVALID_ARGUMENT,
                 "image");
  }
  for (const float x : pixels) {
    EXPECT_EQ(x, -5.0f);
  }
}

TEST(Limits, CallsThatDoNotFitTheModeOrTheStateSayWhich) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  auto frame = make<WlkFrameInfo>();
  frame.frameIndex = 1000000;
  EXPECT_FAILS(wlkBeginFrame(scene.context, &frame), WLK_ERROR_WRONG_STATE, "context");
  victim.expectUnchanged();

  const WlkView fresh = scene.addView({});
  EXPECT_FAILS(wlkRenderHeadless(scene.context, fresh, nullptr), WLK_ERROR_NOT_PREPARED, "view");
  std::vector<float> pixels(32 * 24 * 4);
  auto image = make<WlkImageData>();
  image.data = pixels.data();
  image.dataSize = pixels.size() * sizeof(float);
  EXPECT_EQ(wlkReadback(scene.context, fresh, &image), WLK_NOT_READY);
  auto stats = make<WlkFrameStats>();
  uint32_t count = 0;
  EXPECT_EQ(wlkGetFrameStats(scene.context, fresh, &stats, &count, sizeof(WlkPassStats), nullptr),
            WLK_NOT_READY);
  EXPECT_FAILS(
      wlkGetFrameStats(scene.context, fresh, &stats, nullptr, sizeof(WlkPassStats), nullptr),
      WLK_ERROR_INVALID_ARGUMENT, "passCount");
  ASSERT_EQ(wlkDestroyView(scene.context, fresh), WLK_SUCCESS);

  CpuContext cpu;
  const auto info = make<WlkViewInfo>();
  WlkView view{};
  EXPECT_FAILS(wlkCreateView(cpu.context, &info, &view), WLK_ERROR_WRONG_STATE, "context");
  EXPECT_FAILS(wlkPrepare(cpu.context), WLK_ERROR_WRONG_STATE, "context");
  EXPECT_FAILS(wlkBeginFrame(cpu.context, &frame), WLK_ERROR_WRONG_STATE, "context");
  WlkVolumeField field{};
  auto volumeInfo = make<WlkVolumeInfo>();
  volumeInfo.fieldCount = 1;
  volumeInfo.fields = &field;
  WlkVolume volume{};
  EXPECT_FAILS(wlkCreateVolume(cpu.context, &volumeInfo, &volume), WLK_ERROR_WRONG_STATE,
               "context");
}

TEST(Limits, APictureOfAnotherSizeIsNotReadyUntilItIsRendered) {
  SceneOptions options;
  options.width = options.height = 8;
  HeadlessScene scene(options);
  scene.setSky();
  scene.setSun(40, 0);
  const Image before = scene.render();
  ASSERT_GT(before.mean(), 0.0);
  // A new quality makes new targets: what they hold is no picture.
  scene.setQuality(WLK_QUALITY_MEDIUM);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  std::vector<float> pixels(8 * 8 * 4);
  auto image = make<WlkImageData>();
  image.data = pixels.data();
  image.dataSize = pixels.size() * sizeof(float);
  EXPECT_EQ(wlkReadback(scene.context, scene.view, &image), WLK_NOT_READY);
  EXPECT_TRUE(scene.render() == before);
}

TEST(Limits, StatisticsReportAnArrayThatIsTooShort) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  victim.expectUnchanged();
  auto stats = make<WlkFrameStats>();
  uint32_t count = 0;
  ASSERT_EQ(
      wlkGetFrameStats(scene.context, scene.view, &stats, &count, sizeof(WlkPassStats), nullptr),
      WLK_SUCCESS);
  ASSERT_GE(count, 3u);
  std::vector<WlkPassStats> passes(count);
  std::memset(passes.data(), 0x7f, passes.size() * sizeof passes[0]);
  uint32_t room = 2;
  EXPECT_EQ(wlkGetFrameStats(scene.context, scene.view, &stats, &room, sizeof(WlkPassStats),
                             passes.data()),
            WLK_INCOMPLETE);
  EXPECT_EQ(room, count);
  EXPECT_NE(passes[1].pass, 0x7f7f7f7fu);
  EXPECT_EQ(passes[2].pass, 0x7f7f7f7fu) << "written past the array's room";
}

}  // namespace
}  // namespace welkin::test
