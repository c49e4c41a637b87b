// SPDX-License-Identifier: MIT
// sType, structSize and next of every structure that goes in or out, and null pointers.
#include <welkin/welkin_vulkan.h>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

template <typename T>
void abuseOutput(const std::function<WlkResult(T*)>& call, const char* type) {
  EXPECT_FAILS(call(nullptr), WLK_ERROR_INVALID_ARGUMENT, type);
  auto bad = make<T>();
  bad.sType = WLK_STRUCT_SKY;
  EXPECT_FAILS(call(&bad), WLK_ERROR_UNKNOWN_STRUCT, "sType");
  bad = make<T>();
  bad.structSize = sizeof(T) - 1;
  EXPECT_FAILS(call(&bad), WLK_ERROR_INVALID_ARGUMENT, "structSize");
  bad = make<T>();
  const std::array<uint32_t, 4> unknown{9999, 16, 0, 0};
  bad.next = &unknown;
  EXPECT_FAILS(call(&bad), WLK_ERROR_UNKNOWN_STRUCT, "next");
  struct Longer {
    T known;
    unsigned char tail[16];
  };
  Longer longer{make<T>(), {}};
  longer.known.structSize = sizeof longer;
  std::memset(longer.tail, 0x5a, sizeof longer.tail);
  EXPECT_GE(call(&longer.known), 0);
  for (const unsigned char byte : longer.tail) {
    EXPECT_EQ(byte, 0x5a) << "the library wrote past what it knows";
  }
}

TEST(StructHeader, OfSceneStructuresIsCheckedBeforeAnythingChanges) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  auto planet = make<WlkPlanet>();
  planet.radius = 5e6f;
  auto sky = make<WlkSky>();
  sky.scaleHeight = 4000.0f;
  auto fog = make<WlkFog>();
  fog.extinction = 0.5f;
  auto light = make<WlkLight>();
  light.irradiance[1] = 7.0f;
  const auto absorber = make<WlkAbsorber>();
  auto ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_GIVEN;
  ambient.sky[1] = 3.0f;
  const auto setPlanet = [&](const WlkPlanet* p) { return wlkSetPlanet(c, p); };
  const auto setSky = [&](const WlkSky* p) { return wlkSetSky(c, p); };
  const auto setFog = [&](const WlkFog* p) { return wlkSetFog(c, p); };
  const auto setLight = [&](const WlkLight* p) { return wlkSetLights(c, 1, sizeof *p, p); };
  const auto setAbsorber = [&](const WlkAbsorber* p) { return wlkSetAbsorber(c, p); };
  const auto setAmbient = [&](const WlkAmbient* p) { return wlkSetAmbient(c, p); };
  abuseHeader<WlkPlanet>(planet, setPlanet);
  abuseHeader<WlkSky>(sky, setSky);
  abuseHeader<WlkFog>(fog, setFog);
  abuseHeader<WlkLight>(light, setLight);
  abuseHeader<WlkAbsorber>(absorber, setAbsorber);
  abuseHeader<WlkAmbient>(ambient, setAmbient);
  victim.expectUnchanged();
  expectLongerAccepted<WlkPlanet>(planet, setPlanet);
  expectLongerAccepted<WlkSky>(sky, setSky);
  expectLongerAccepted<WlkFog>(fog, setFog);
  expectLongerAccepted<WlkLight>(light, setLight);
  expectLongerAccepted<WlkAbsorber>(absorber, setAbsorber);
  expectLongerAccepted<WlkAmbient>(ambient, setAmbient);
  victim.restore();
  victim.expectUnchanged();
}

TEST(StructHeader, OfCreationStructuresIsCheckedBeforeAnythingIsMade) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  // A failing call leaves the handle alone; what a good one made goes away at once.
  const auto createMedium = [&](const WlkMediumInfo* p) {
    WlkMedium made{};
    const WlkResult result = wlkCreateMedium(c, p, &made);
    EXPECT_EQ(made.id != 0, result == WLK_SUCCESS);
    EXPECT_TRUE(made.id == 0 || wlkDestroyMedium(c, made) == WLK_SUCCESS);
    return result;
  };
  const auto createVolume = [&](const WlkVolumeInfo* p) {
    WlkVolume made{};
    const WlkResult result = wlkCreateVolume(c, p, &made);
    EXPECT_EQ(made.id != 0, result == WLK_SUCCESS);
    EXPECT_TRUE(made.id == 0 || wlkDestroyVolume(c, made) == WLK_SUCCESS);
    return result;
  };
  const auto createView = [&](const WlkViewInfo* p) {
    WlkView made{};
    const WlkResult result = wlkCreateView(c, p, &made);
    EXPECT_EQ(made.id != 0, result == WLK_SUCCESS);
    EXPECT_TRUE(made.id == 0 || wlkDestroyView(c, made) == WLK_SUCCESS);
    return result;
  };
  WlkVolumeField field{};
  field.medium = victim.medium;
  auto volume = make<WlkVolumeInfo>();
  volume.fieldCount = 1;
  volume.fields = &field;
  abuseHeader<WlkMediumInfo>(make<WlkMediumInfo>(), createMedium);
  abuseHeader<WlkVolumeInfo>(volume, createVolume);
  abuseHeader<WlkViewInfo>(make<WlkViewInfo>(), createView);
  victim.expectUnchanged();
  expectLongerAccepted<WlkMediumInfo>(make<WlkMediumInfo>(), createMedium);
  expectLongerAccepted<WlkVolumeInfo>(volume, createVolume);
  expectLongerAccepted<WlkViewInfo>(make<WlkViewInfo>(), createView);
  // Creating a volume asks for wlkPrepare, whether the volume lives on or not.
  ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
  victim.expectUnchanged();
}

TEST(StructHeader, OfViewAndFrameStructuresIsCheckedBeforeAnythingChanges) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  const WlkView view = victim.scene.view;
  auto camera = make<WlkCamera>();
  camera.preExposure = 3.0f;
  auto quality = make<WlkQuality>();
  quality.sliceCount = 8;
  auto info = make<WlkViewInfo>();
  info.width = info.height = 8;
  std::vector<float> pixels(16 * 12 * 4);
  auto image = make<WlkImageData>();
  image.data = pixels.data();
  image.dataSize = pixels.size() * sizeof(float);
  const auto setCamera = [&](const WlkCamera* p) { return wlkSetCamera(c, view, p); };
  const auto setQuality = [&](const WlkQuality* p) { return wlkSetQuality(c, view, p); };
  const auto updateView = [&](const WlkViewInfo* p) { return wlkUpdateView(c, view, p); };
  const auto readback = [&](const WlkImageData* p) { return wlkReadback(c, view, p); };
  const auto render = [&](const WlkHeadlessInputs* p) { return wlkRenderHeadless(c, view, p); };
  abuseHeader<WlkCamera>(camera, setCamera);
  abuseHeader<WlkQuality>(quality, setQuality);
  abuseHeader<WlkViewInfo>(info, updateView);
  abuseHeader<WlkImageData>(image, readback);
  abuseHeader<WlkHeadlessInputs>(make<WlkHeadlessInputs>(), render);
  victim.expectUnchanged();
  expectLongerAccepted<WlkImageData>(image, readback);
  expectLongerAccepted<WlkHeadlessInputs>(make<WlkHeadlessInputs>(), render);
  expectLongerAccepted<WlkCamera>(camera, setCamera);
  expectLongerAccepted<WlkQuality>(quality, setQuality);
  expectLongerAccepted<WlkViewInfo>(info, updateView);
  info.width = 16;
  info.height = 12;
  ASSERT_EQ(wlkUpdateView(c, view, &info), WLK_SUCCESS);
  victim.scene.setQuality(WLK_QUALITY_LOW);
  victim.restore();
  ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
  victim.expectUnchanged();
}

TEST(StructHeader, OfUploadsAndQueriesIsChecked) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  const std::vector<float> values(64, 0.75f);
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = 4;
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  const auto uploadVolume = [&](const WlkVolumeUpload* p) {
    return wlkUploadVolume(c, victim.volume, p);
  };
  const std::array<uint32_t, 3> origin{};
  const std::vector<float> brick(512, 0.75f);
  auto bricks = make<WlkVolumeBricks>();
  bricks.count = 1;
  bricks.coordinates = origin.data();
  bricks.data = brick.data();
  bricks.dataSize = brick.size() * sizeof(float);
  const auto uploadBricks = [&](const WlkVolumeBricks* p) {
    return wlkUploadVolumeBricks(c, victim.volume, p);
  };
  const auto evalSky = [&](const WlkRayBatch* p) { return wlkEvalSky(c, p, nullptr, nullptr); };
  std::vector<float> map(3 * 4 * 4);
  auto mapQuery = make<WlkSkyMapQuery>();
  mapQuery.size = 4;
  mapQuery.maxOrder = 1;
  const auto evalMap = [&](const WlkSkyMapQuery* p) {
    return wlkEvalSkyMap(c, p, map.data(), map.size() * sizeof(float));
  };
  const auto evalPhase = [&](const WlkPhaseQuery* p) { return wlkEvalPhase(c, p, nullptr); };
  auto phaseQuery = make<WlkPhaseQuery>();
  phaseQuery.medium = victim.medium;
  abuseHeader<WlkVolumeUpload>(upload, uploadVolume);
  abuseHeader<WlkVolumeBricks>(bricks, uploadBricks);
  abuseHeader<WlkRayBatch>(make<WlkRayBatch>(), evalSky);
  abuseHeader<WlkSkyMapQuery>(mapQuery, evalMap);
  abuseHeader<WlkPhaseQuery>(phaseQuery, evalPhase);
  victim.expectUnchanged();
  expectLongerAccepted<WlkVolumeUpload>(upload, uploadVolume);
  expectLongerAccepted<WlkVolumeBricks>(bricks, uploadBricks);
  expectLongerAccepted<WlkRayBatch>(make<WlkRayBatch>(), evalSky);
  expectLongerAccepted<WlkSkyMapQuery>(mapQuery, evalMap);
  expectLongerAccepted<WlkPhaseQuery>(phaseQuery, evalPhase);
  victim.scene.upload(victim.volume, {4, 4, 4}, std::vector<float>(64, 0.5f));
  ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);  // voxels in the place of bricks
  victim.expectUnchanged();
}

TEST(StructHeader, OfContextStructuresIsCheckedAndNoContextComesBack) {
  const auto create = [](const WlkContextInfo* p) {
    // A value that only a successful call or a failing call that resets it can change.
    auto* context = reinterpret_cast<WlkContext>(uintptr_t{16});
    const WlkResult result = wlkCreateContext(WLK_API_VERSION, p, &context);
    EXPECT_EQ(context == nullptr, result != WLK_SUCCESS);
    if (result == WLK_SUCCESS) {
      wlkDestroyContext(context);
    }
    return result;
  };
  abuseHeader<WlkContextInfo>(make<WlkContextInfo>(), create);
  expectLongerAccepted<WlkContextInfo>(make<WlkContextInfo>(), create);
  EXPECT_FAILS(create(nullptr), WLK_ERROR_INVALID_ARGUMENT, "WlkContextInfo");
  const auto info = make<WlkContextInfo>();
  EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "context");

  // Chained structures have headers of their own; the chain may be circular.
  auto headless = make<WlkHeadlessInfo>();
  auto chained = make<WlkContextInfo>();
  chained.next = &headless;
  headless.next = &headless;
  EXPECT_FAILS(create(&chained), WLK_ERROR_UNKNOWN_STRUCT, "next");
  headless = make<WlkHeadlessInfo>();
  headless.structSize = 8;
  EXPECT_FAILS(create(&chained), WLK_ERROR_INVALID_ARGUMENT, "structSize");
  headless = make<WlkHeadlessInfo>();
  auto device = make<WlkVulkanDeviceInfo>();
  headless.next = &device;
  EXPECT_FAILS(create(&chained), WLK_ERROR_INVALID_ARGUMENT, "next");
}

TEST(StructHeader, OfOutputStructuresIsCheckedAndOnlyKnownBytesAreWritten) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  victim.expectUnchanged();  // a frame, so that statistics exist
  abuseOutput<WlkCapabilities>([&](WlkCapabilities* p) { return wlkGetCapabilities(c, p); },
                               "WlkCapabilities");
  abuseOutput<WlkVolumeState>(
      [&](WlkVolumeState* p) { return wlkGetVolumeState(c, victim.volume, p); }, "WlkVolumeState");
  abuseOutput<WlkFrameStats>(
      [&](WlkFrameStats* p) {
        uint32_t count = 0;
        return wlkGetFrameStats(c, victim.scene.view, p, &count, sizeof(WlkPassStats), nullptr);
      },
      "WlkFrameStats");
  abuseOutput<WlkQualityState>(
      [&](WlkQualityState* p) { return wlkGetQualityState(c, victim.scene.view, p); },
      "WlkQualityState");
  abuseOutput<WlkErrorEstimate>(
      [&](WlkErrorEstimate* p) { return wlkGetErrorEstimate(c, victim.scene.view, p); },
      "WlkErrorEstimate");
  abuseOutput<WlkMediumOptics>(
      [&](WlkMediumOptics* p) { return wlkGetMediumOptics(c, victim.medium, p); },
      "WlkMediumOptics");
  abuseOutput<WlkErrorInfo>([](WlkErrorInfo* p) { return wlkGetLastError(p); }, "WlkErrorInfo");
  abuseOutput<WlkVulkanRequirements>(
      [](WlkVulkanRequirements* p) { return wlkVulkanGetRequirements(p); },
      "WlkVulkanRequirements");
}

TEST(StructHeader, InitStructWritesDefaultsWithinTheSizeItIsGiven) {
  std::array<unsigned char, 512> bytes{};
  EXPECT_FAILS(wlkInitStruct(WLK_STRUCT_SKY, sizeof(WlkSky), nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "structure");
  for (const uint32_t unknown : {0u, 6u, 53u, 1004u, 0xffffffffu}) {
    EXPECT_FAILS(wlkInitStruct(unknown, 64, bytes.data()), WLK_ERROR_UNKNOWN_STRUCT, "sType");
  }
  EXPECT_FAILS(wlkInitStruct(WLK_STRUCT_SKY, sizeof(WlkSky) - 1, bytes.data()),
               WLK_ERROR_INVALID_ARGUMENT, "structSize");
  for (const unsigned char byte : bytes) {
    EXPECT_EQ(byte, 0) << "a failing wlkInitStruct wrote";
  }
  bytes.fill(0xee);
  ASSERT_EQ(wlkInitStruct(WLK_STRUCT_SKY, sizeof(WlkSky) + 8, bytes.data()), WLK_SUCCESS);
  for (size_t i = sizeof(WlkSky); i < bytes.size(); ++i) {
    EXPECT_EQ(bytes[i], i < sizeof(WlkSky) + 8 ? 0 : 0xee) << i;
  }
}

}  // namespace
}  // namespace welkin::test
