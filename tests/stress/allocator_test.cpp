// SPDX-License-Identifier: MIT
// The host allocator: everything comes back, with the size and alignment it was asked for; any
// allocation may fail at any time, which leaks nothing and leaves a context that works.
#include "stress/abuse.hpp"
#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

// Calls with the n-th allocation failing, n = 0, 1, ..., until it succeeds. Returns that n.
uint64_t failEachUntilSuccess(CountingAllocator& memory, const std::function<WlkResult()>& call,
                              const std::function<void()>& afterFailure) {
  for (uint64_t n = 0; n < 10000; ++n) {
    memory.failFrom(n);
    const WlkResult result = call();
    memory.failFrom(CountingAllocator::NEVER);
    if (result == WLK_SUCCESS) {
      return n;
    }
    EXPECT_EQ(result, WLK_ERROR_OUT_OF_HOST_MEMORY) << "allocation " << n;
    EXPECT_EQ(lastError().result, WLK_ERROR_OUT_OF_HOST_MEMORY);
    EXPECT_NE(lastError().message[0], '\0');
    afterFailure();
  }
  ADD_FAILURE() << "no success after 10000 allocations";
  return 0;
}

void expectCreationSurvives(CountingAllocator& memory, const WlkContextInfo& info) {
  WlkContext context = nullptr;
  const uint64_t needed = failEachUntilSuccess(
      memory, [&] { return wlkCreateContext(WLK_API_VERSION, &info, &context); },
      [&] {
        EXPECT_EQ(context, nullptr);
        EXPECT_EQ(memory.live(), 0u) << "a failed wlkCreateContext leaks";
      });
  EXPECT_GT(needed, 0u);
  EXPECT_GT(memory.live(), 0u);
  wlkDestroyContext(context);
  EXPECT_EQ(memory.live(), 0u);
}

TEST(Allocator, CreationOfACpuContextSurvivesEveryFailure) {
  CountingAllocator memory;
  auto info = make<WlkContextInfo>();
  info.allocator = memory.callbacks();
  expectCreationSurvives(memory, info);
}

TEST(Allocator, CreationOfAHeadlessContextSurvivesEveryFailure) {
  chooseDriver();
  CountingAllocator memory;
  const auto headless = make<WlkHeadlessInfo>();
  auto info = make<WlkContextInfo>();
  info.next = &headless;
  info.allocator = memory.callbacks();
  expectCreationSurvives(memory, info);
}

TEST(Allocator, EveryStepOfASceneSurvivesEveryFailure) {
  CountingAllocator memory;
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  options.view = false;
  options.allocator = memory.callbacks();
  Image direct;
  {
    SceneOptions plain = options;
    plain.view = true;
    HeadlessScene scene(plain);
    scene.setSky();
    scene.setSun(30, 40);
    const WlkVolume volume = scene.addVolume(scene.addMedium(), {4, 4, 4},
                                             boxTransform({-200, 0, -900}, {400, 300, 400}), 1e-3f);
    scene.upload(volume, {4, 4, 4}, std::vector<float>(64, 0.5f));
    direct = scene.render();
  }
  EXPECT_EQ(memory.live(), 0u);
  {
    HeadlessScene scene(options);
    const WlkContext c = scene.context;
    scene.setSky();
    scene.setSun(30, 40);
    const auto nothing = [] {};

    const auto mediumInfo = make<WlkMediumInfo>();
    WlkMedium medium{};
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkCreateMedium(c, &mediumInfo, &medium); },
                  [&] { EXPECT_EQ(medium.id, 0u); }),
              0u);

    WlkVolumeField field{};
    field.medium = medium;
    field.extinctionScale = 1e-3f;
    auto volumeInfo = make<WlkVolumeInfo>();
    volumeInfo.size[0] = volumeInfo.size[1] = volumeInfo.size[2] = 4;
    volumeInfo.fieldCount = 1;
    volumeInfo.fields = &field;
    const auto transform = boxTransform({-200, 0, -900}, {400, 300, 400});
    std::memcpy(volumeInfo.worldFromVolume, transform.data(), sizeof volumeInfo.worldFromVolume);
    WlkVolume volume{};
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkCreateVolume(c, &volumeInfo, &volume); },
                  [&] { EXPECT_EQ(volume.id, 0u); }),
              0u);

    const std::vector<float> values(64, 0.5f);
    auto upload = make<WlkVolumeUpload>();
    upload.extent[0] = upload.extent[1] = upload.extent[2] = 4;
    upload.data = values.data();
    upload.dataSize = values.size() * sizeof(float);
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkUploadVolume(c, volume, &upload); }, nothing),
              0u);

    const std::vector<float> sizes(64, 9.0f);
    auto diameters = upload;
    diameters.data = sizes.data();
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkUploadVolumeDiameters(c, volume, &diameters); }, nothing),
              0u);
    failEachUntilSuccess(
        memory, [&] { return wlkClearVolumeDiameters(c, volume); }, nothing);

    // Bricks, and voxels in their place again.
    const std::array<uint32_t, 3> origin{};
    const std::vector<float> brick(512, 0.25f);
    auto bricks = make<WlkVolumeBricks>();
    bricks.count = 1;
    bricks.coordinates = origin.data();
    bricks.data = brick.data();
    bricks.dataSize = brick.size() * sizeof(float);
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkUploadVolumeBricks(c, volume, &bricks); }, nothing),
              0u);
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkUploadVolume(c, volume, &upload); }, nothing),
              0u);

    auto viewInfo = make<WlkViewInfo>();
    viewInfo.width = options.width;
    viewInfo.height = options.height;
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkCreateView(c, &viewInfo, &scene.view); },
                  [&] { EXPECT_EQ(scene.view.id, 0u); }),
              0u);
    scene.setQuality(options.level);

    EXPECT_GT(
        failEachUntilSuccess(
            memory, [&] { return wlkPrepare(c); },
            [&] { EXPECT_EQ(wlkRenderHeadless(c, scene.view, nullptr), WLK_ERROR_NOT_PREPARED); }),
        0u);
    // The first frame may still make room for uploads that are on their way.
    failEachUntilSuccess(
        memory, [&] { return wlkRenderHeadless(c, scene.view, nullptr); }, nothing);
    EXPECT_TRUE(scene.read(WLK_IMAGE_COLOR) == direct);

    // Further ones and destruction: the frame before is not lost by failures.
    EXPECT_EQ(failEachUntilSuccess(
                  memory, [&] { return wlkRenderHeadless(c, scene.view, nullptr); }, nothing),
              0u)
        << "a steady frame allocates";
    failEachUntilSuccess(
        memory, [&] { return wlkDestroyVolume(c, volume); },
        [&] {
          EXPECT_EQ(wlkRenderHeadless(c, scene.view, nullptr), WLK_SUCCESS);
          EXPECT_TRUE(scene.read(WLK_IMAGE_COLOR) == direct);
        });
    failEachUntilSuccess(
        memory, [&] { return wlkDestroyView(c, scene.view); }, nothing);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
  EXPECT_EQ(memory.live(), 0u) << "the context leaks";
}

TEST(Allocator, TargetsBesideThePictureSurviveEveryFailure) {
  CountingAllocator memory;
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  options.allocator = memory.callbacks();
  {
    EngineScene scene(options);
    const WlkContext c = scene.context;
    scene.setSun(30, 40);
    scene.addBall(0.005f);
    const auto nothing = [] {};
    auto aerial = make<WlkAerialPerspective>();
    aerial.width = aerial.height = aerial.depth = 4;
    failEachUntilSuccess(
        memory, [&] { return wlkSetAerialPerspective(c, scene.view, &aerial); }, nothing);
    failEachUntilSuccess(
        memory, [&] { return wlkSetVolumeDistance(c, scene.view, 1); }, nothing);
    const auto info = make<WlkCloudShadowInfo>();
    WlkCloudShadow map{};
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkCreateCloudShadow(c, &info, &map); },
                  [&] { EXPECT_EQ(map.id, 0u); }),
              0u);
    EXPECT_GT(failEachUntilSuccess(
                  memory, [&] { return wlkPrepare(c); }, nothing),
              0u);
    scene.renderFrame();
    EXPECT_EQ(scene.read().badValues(), 0u);
    failEachUntilSuccess(
        memory, [&] { return wlkDestroyCloudShadow(c, map); }, nothing);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
  EXPECT_EQ(memory.live(), 0u) << "the context leaks";
}

TEST(Allocator, TheBalanceIsZeroAfterUploadsThatWereNeverRendered) {
  CountingAllocator memory;
  SceneOptions options;
  options.allocator = memory.callbacks();
  {
    const HeadlessScene scene(options);
    scene.addBall(0.01f);
    scene.addBall(0.01f);
    ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
    const WlkVolume third = scene.addBall(0.01f);
    ASSERT_EQ(wlkDestroyVolume(scene.context, third), WLK_SUCCESS);
    EXPECT_GT(memory.live(), 0u);
  }
  EXPECT_EQ(memory.live(), 0u);
}

TEST(Allocator, TheStatisticsCountWhatTheAllocatorGave) {
  CountingAllocator memory;
  SceneOptions options;
  options.allocator = memory.callbacks();
  const HeadlessScene scene(options);
  scene.setSky();
  (void)scene.render();
  const uint64_t before = scene.stats().hostMemory;
  EXPECT_GT(before, 0u);
  const WlkMedium medium = scene.addMedium();
  EXPECT_GT(scene.stats().hostMemory, before);
  ASSERT_EQ(wlkDestroyMedium(scene.context, medium), WLK_SUCCESS);
}

}  // namespace
}  // namespace welkin::test
