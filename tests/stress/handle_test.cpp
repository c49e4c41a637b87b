// SPDX-License-Identifier: MIT
// Null, stale, invented and foreign handles at every function that takes one; objects in use.
#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

using Calls = std::vector<std::function<WlkResult(WlkContext, uint64_t)>>;

// Every function that takes a volume, with arguments that are right otherwise.
Calls volumeCalls() {
  static const std::array<float, 1> value{0.5f};
  static const auto transform = boxTransform({0, 0, 0}, {1, 1, 1});
  return {
      [](WlkContext c, uint64_t id) { return wlkDestroyVolume(c, {id}); },
      [](WlkContext c, uint64_t id) { return wlkSetVolumeTransform(c, {id}, transform.data()); },
      [](WlkContext c, uint64_t id) {
        auto upload = make<WlkVolumeUpload>();
        upload.extent[0] = upload.extent[1] = upload.extent[2] = 1;
        upload.data = value.data();
        upload.dataSize = sizeof value;
        return wlkUploadVolume(c, {id}, &upload);
      },
      [](WlkContext c, uint64_t id) {
        const auto bricks = make<WlkVolumeBricks>();
        return wlkUploadVolumeBricks(c, {id}, &bricks);
      },
      [](WlkContext c, uint64_t id) {
        auto state = make<WlkVolumeState>();
        return wlkGetVolumeState(c, {id}, &state);
      }};
}

Calls viewCalls() {
  return {[](WlkContext c, uint64_t id) { return wlkDestroyView(c, {id}); },
          [](WlkContext c, uint64_t id) {
            const auto info = make<WlkViewInfo>();
            return wlkUpdateView(c, {id}, &info);
          },
          [](WlkContext c, uint64_t id) {
            const auto camera = make<WlkCamera>();
            return wlkSetCamera(c, {id}, &camera);
          },
          [](WlkContext c, uint64_t id) {
            const auto quality = make<WlkQuality>();
            return wlkSetQuality(c, {id}, &quality);
          },
          [](WlkContext c, uint64_t id) { return wlkReportFrameTime(c, {id}, 1, 1.0); },
          [](WlkContext c, uint64_t id) {
            auto state = make<WlkQualityState>();
            return wlkGetQualityState(c, {id}, &state);
          },
          [](WlkContext c, uint64_t id) { return wlkRenderHeadless(c, {id}, nullptr); },
          [](WlkContext c, uint64_t id) {
            const auto image = make<WlkImageData>();
            return wlkReadback(c, {id}, &image);
          },
          [](WlkContext c, uint64_t id) {
            auto stats = make<WlkFrameStats>();
            uint32_t count = 0;
            return wlkGetFrameStats(c, {id}, &stats, &count, sizeof(WlkPassStats), nullptr);
          },
          [](WlkContext c, uint64_t id) {
            auto estimate = make<WlkErrorEstimate>();
            return wlkGetErrorEstimate(c, {id}, &estimate);
          }};
}

Calls mediumCalls() {
  return {[](WlkContext c, uint64_t id) { return wlkDestroyMedium(c, {id}); },
          [](WlkContext c, uint64_t id) {
            WlkVolumeField field{};
            field.medium.id = id;
            auto info = make<WlkVolumeInfo>();
            info.fieldCount = 1;
            info.fields = &field;
            WlkVolume volume{};
            return wlkCreateVolume(c, &info, &volume);
          },
          [](WlkContext c, uint64_t id) {
            auto query = make<WlkPhaseQuery>();
            query.medium.id = id;
            return wlkEvalPhase(c, &query, nullptr);
          },
          [](WlkContext c, uint64_t id) {
            return wlkSamplePhase(c, {id}, 0, 0, nullptr, nullptr, nullptr);
          },
          [](WlkContext c, uint64_t id) {
            auto optics = make<WlkMediumOptics>();
            return wlkGetMediumOptics(c, {id}, &optics);
          }};
}

void abuse(const Calls& calls, WlkContext c, uint64_t good, uint64_t stale, uint64_t foreign,
           const char* field) {
  const std::vector<uint64_t> bad{0,
                                  stale,
                                  foreign,
                                  ~uint64_t{0},
                                  good ^ 1,
                                  good | 0xffffffu,
                                  good & ~uint64_t{0xffffffu},
                                  good ^ uint64_t{1} << 24,
                                  good ^ uint64_t{1} << 48,
                                  1};
  for (size_t call = 0; call < calls.size(); ++call) {
    for (const uint64_t id : bad) {
      if (id != good) {
        EXPECT_FAILS(calls[call](c, id), WLK_ERROR_INVALID_HANDLE, field)
            << "call " << call << ", id " << std::hex << id;
      }
    }
  }
}

TEST(Handles, NullStaleInventedAndForeignOnesAreRefusedAndNothingChanges) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  HeadlessScene other;
  const WlkMedium otherMedium = other.addMedium();
  const WlkVolume otherVolume =
      other.addVolume(otherMedium, {1, 1, 1}, boxTransform({0, 0, 0}, {1, 1, 1}), 1.0f);
  const WlkMedium staleMedium = scene.addMedium();
  ASSERT_EQ(wlkDestroyMedium(scene.context, staleMedium), WLK_SUCCESS);
  const WlkVolume staleVolume =
      scene.addVolume(victim.medium, {1, 1, 1}, boxTransform({0, 0, 0}, {1, 1, 1}), 1.0f);
  ASSERT_EQ(wlkDestroyVolume(scene.context, staleVolume), WLK_SUCCESS);
  const WlkView staleView = scene.addView({});
  ASSERT_EQ(wlkDestroyView(scene.context, staleView), WLK_SUCCESS);
  // A new object in the old one's place does not revive the old handle.
  const WlkMedium successor = scene.addMedium();
  EXPECT_NE(successor.id, staleMedium.id);

  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  abuse(mediumCalls(), scene.context, victim.medium.id, staleMedium.id, otherMedium.id, "medium");
  abuse(volumeCalls(), scene.context, victim.volume.id, staleVolume.id, otherVolume.id, "volume");
  abuse(viewCalls(), scene.context, scene.view.id, staleView.id, other.view.id, "view");
  EXPECT_EQ(wlkDestroyMedium(scene.context, successor), WLK_SUCCESS);
  victim.expectUnchanged();
  EXPECT_TRUE(other.messages().empty());
}

TEST(Handles, OfADestroyedContextAreForeignToItsSuccessor) {
  // Allocators like to hand out the same address again; the handles must differ all the same.
  for (int i = 0; i < 16; ++i) {
    WlkMedium old{};
    const auto info = make<WlkMediumInfo>();
    {
      CpuContext first;
      ASSERT_EQ(wlkCreateMedium(first.context, &info, &old), WLK_SUCCESS);
    }
    CpuContext second;
    WlkMedium fresh{};
    ASSERT_EQ(wlkCreateMedium(second.context, &info, &fresh), WLK_SUCCESS);
    EXPECT_FAILS(wlkDestroyMedium(second.context, old), WLK_ERROR_INVALID_HANDLE, "medium");
    EXPECT_EQ(wlkDestroyMedium(second.context, fresh), WLK_SUCCESS);
  }
}

// Never hands memory out twice and never gives it back: what lay there stays readable.
struct KeepingAllocator {
  alignas(64) std::array<unsigned char, 1 << 16> memory{};
  uint64_t used = 0;
  WlkAllocator callbacks() {
    return {this,
            [](void* user, uint64_t size, uint64_t alignment) -> void* {
              auto& self = *static_cast<KeepingAllocator*>(user);
              self.used = (self.used + alignment - 1) / alignment * alignment + size;
              return self.used <= self.memory.size() ? &self.memory[self.used - size] : nullptr;
            },
            [](void*, void*, uint64_t, uint64_t) {}};
  }
};

TEST(Handles, ADestroyedContextWhoseMemoryIsStillThereIsRefused) {
  KeepingAllocator memory;
  WlkContext destroyed = nullptr;
  {
    CpuContext cpu(memory.callbacks());
    destroyed = cpu.context;
    EXPECT_EQ(wlkSetSky(destroyed, nullptr), WLK_SUCCESS);
  }
  EXPECT_FAILS(wlkSetSky(destroyed, nullptr), WLK_ERROR_INVALID_HANDLE, "context");
  wlkDestroyContext(destroyed);
}

TEST(Handles, NullContextsAreRefusedByEveryFunction) {
  Calls all = volumeCalls();
  for (const Calls& more : {viewCalls(), mediumCalls()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  all.push_back([](WlkContext c, uint64_t) { return wlkSetPlanet(c, nullptr); });
  all.push_back([](WlkContext c, uint64_t) { return wlkSetSky(c, nullptr); });
  all.push_back([](WlkContext c, uint64_t) { return wlkSetFog(c, nullptr); });
  all.push_back([](WlkContext c, uint64_t) { return wlkSetLights(c, 0, 0, nullptr); });
  all.push_back([](WlkContext c, uint64_t) { return wlkPrepare(c); });
  all.push_back([](WlkContext c, uint64_t) {
    auto capabilities = make<WlkCapabilities>();
    return wlkGetCapabilities(c, &capabilities);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const auto info = make<WlkMediumInfo>();
    WlkMedium medium{};
    return wlkCreateMedium(c, &info, &medium);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const auto info = make<WlkViewInfo>();
    WlkView view{};
    return wlkCreateView(c, &info, &view);
  });
  all.push_back([](WlkContext c, uint64_t) {
    auto frame = make<WlkFrameInfo>();
    frame.frameIndex = 1;
    return wlkBeginFrame(c, &frame);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const auto rays = make<WlkRayBatch>();
    return wlkEvalSky(c, &rays, nullptr, nullptr);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const double position[3] = {0, 0, 0};
    double irradiance[3];
    return wlkEvalLight(c, 0, position, irradiance);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const double position[3] = {0, 0, 0};
    double coefficients[WLK_AMBIENT_VALUES];
    return wlkEvalAmbient(c, position, coefficients);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const double position[3] = {0, 0, 0};
    double transmittance[3];
    return wlkEvalTransmittance(c, position, position, transmittance);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const double vector[3] = {0, 1, 0};
    return wlkEvalIrradiance(c, vector, vector, nullptr, nullptr);
  });
  all.push_back([](WlkContext c, uint64_t) {
    const auto query = make<WlkSkyMapQuery>();
    return wlkEvalSkyMap(c, &query, nullptr, 0);
  });
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_FAILS(all[i](nullptr, 1), WLK_ERROR_INVALID_HANDLE, "context") << i;
  }
  wlkDestroyContext(nullptr);
}

TEST(Handles, VolumesOutliveTheMediumTheyWereMadeWith) {
  VictimScene& victim = VictimScene::get();
  const HeadlessScene& scene = victim.scene;
  const WlkMedium medium = scene.addMedium();
  const WlkVolume volume =
      scene.addVolume(medium, {4, 4, 4}, boxTransform({0, 0, 0}, {1, 1, 1}), 1.0f);
  EXPECT_EQ(wlkDestroyMedium(scene.context, medium), WLK_SUCCESS);
  EXPECT_FAILS(wlkDestroyMedium(scene.context, medium), WLK_ERROR_INVALID_HANDLE, "medium");
  // Everything that asks a field for its particles: tables, light inside, diameters per voxel.
  const std::vector<float> diameters(64, 12.0f);
  auto upload = make<WlkVolumeUpload>();
  std::fill_n(upload.extent, 3, 4);
  upload.data = diameters.data();
  upload.dataSize = diameters.size() * sizeof(float);
  EXPECT_EQ(wlkUploadVolumeDiameters(scene.context, volume, &upload), WLK_SUCCESS);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  EXPECT_EQ(wlkRenderHeadless(scene.context, scene.view, nullptr), WLK_SUCCESS);
  EXPECT_EQ(wlkDestroyVolume(scene.context, volume), WLK_SUCCESS);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  victim.expectUnchanged();
}

TEST(Handles, OfOneKindAreNoHandlesOfAnother) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  // A medium in a slot that neither volumes nor views have: its number is theirs to refuse.
  std::vector<WlkMedium> media;
  for (int i = 0; i < 8; ++i) {
    media.push_back(victim.scene.addMedium());
  }
  EXPECT_FAILS(wlkDestroyVolume(c, {media.back().id}), WLK_ERROR_INVALID_HANDLE, "volume");
  EXPECT_FAILS(wlkDestroyView(c, {media.back().id}), WLK_ERROR_INVALID_HANDLE, "view");
  for (const WlkMedium medium : media) {
    EXPECT_EQ(wlkDestroyMedium(c, medium), WLK_SUCCESS);
  }
  victim.expectUnchanged();
}

}  // namespace
}  // namespace welkin::test
