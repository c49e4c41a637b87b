// SPDX-License-Identifier: MIT
// The volumes' distance: images that are wrong, calls out of order, extreme scenes.
#include <cmath>

#include "stress/abuse.hpp"
#include "support/distance_scene.hpp"

namespace welkin::test {
namespace {

class DistanceAbuse : public ::testing::Test {
 protected:
  DistanceAbuse() {
    s.scene.addBall(0.002f);
    s.scene.setCamera({0, 1500, 0}, 0, 0);
    check(wlkPrepare(s.scene.context));
    s.render();
    before = s.at(MIDDLE);
    EXPECT_GT(before[1], 0.5);
  }
  ~DistanceAbuse() override {
    s.render();
    EXPECT_EQ(s.at(MIDDLE), before);
  }
  WlkResult set(uint32_t enabled) {
    return wlkSetVolumeDistance(s.scene.context, s.scene.view, enabled);
  }
  // The frame's code with a spoilt image; nothing may be recorded.
  WlkResult render(const std::function<void(WlkVulkanImage&)>& spoil) {
    const WlkVulkanImage good = s.described;
    spoil(s.described);
    WlkResult code = WLK_SUCCESS;
    try {
      s.scene.renderFrame();
    } catch (const Error& error) {
      code = error.result();
      EXPECT_EQ(SpyDevice::counts().dispatches + SpyDevice::counts().barriers, 0u);
    }
    s.described = good;
    return code;
  }

  static constexpr uint32_t MIDDLE = DistanceScene::SIZE * (DistanceScene::SIZE + 1) / 2;
  DistanceScene s;
  std::array<double, 2> before{};
};

TEST_F(DistanceAbuse, ImagesThatDoNotFitAreRefused) {
  using I = WlkVulkanImage;
  EXPECT_EQ(render([](I& i) { i.image = VK_NULL_HANDLE; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render([](I& i) { i.width += 1; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render([](I& i) { i.height -= 1; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render([](I& i) { i.after.layout = VK_IMAGE_LAYOUT_UNDEFINED; }),
            WLK_ERROR_INVALID_ARGUMENT);
  for (const VkFormat format :
       {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16_UNORM, VK_FORMAT_D32_SFLOAT}) {
    EXPECT_EQ(render([&](I& i) { i.format = format; }), WLK_ERROR_UNSUPPORTED_FORMAT);
  }
  EXPECT_EQ(render([](I& i) { i.sType = WLK_STRUCT_SKY; }), WLK_ERROR_UNKNOWN_STRUCT);
  EXPECT_EQ(render([](I& i) { i.next = &i; }), WLK_ERROR_UNKNOWN_STRUCT);
}

TEST_F(DistanceAbuse, CallsOutOfOrderAreRefused) {
  EXPECT_FAILS(set(2), WLK_ERROR_INVALID_ARGUMENT, "enabled");
  EXPECT_FAILS(set(0xffffffff), WLK_ERROR_INVALID_ARGUMENT, "enabled");
  for (const uint64_t id : {uint64_t{0}, s.scene.view.id + (1 << 24)}) {
    EXPECT_FAILS(wlkSetVolumeDistance(s.scene.context, {id}, 1), WLK_ERROR_INVALID_HANDLE, "view");
  }
  const auto nothing = [](WlkVulkanImage&) {};
  check(set(0));
  EXPECT_EQ(render(nothing), WLK_ERROR_WRONG_STATE);
  check(set(1));
  EXPECT_EQ(render(nothing), WLK_ERROR_NOT_PREPARED);
  check(wlkPrepare(s.scene.context));
  check(set(1));
  EXPECT_EQ(render(nothing), WLK_SUCCESS) << "nothing has changed";
}

TEST(DistanceModes, NeedAnEngineDevice) {
  const CpuContext cpu;
  EXPECT_FAILS(wlkSetVolumeDistance(cpu.context, {}, 1), WLK_ERROR_WRONG_STATE, "context");
}

// Eyes inside and far from volumes as dense as they get and nearly empty: between the nearest and
// the farthest point of the box, or 0.
TEST(DistanceExtremes, AreFinite) {
  for (const uint32_t batch : {0u, 16u}) {
    DistanceScene s;
    const WlkVolume volume =
        s.scene.addVolume(s.scene.addMedium(), {1, 3, 1},
                          boxTransform({-1000, -1500, -3000}, {2000, 3000, 2000}), 10.0f);
    s.scene.upload(volume, {1, 3, 1}, {65504.0f, 0.0f, 1e-7f});
    s.setQuality(batch);
    for (const double away : {-2000.0, 0.0, 1e5, 3e7}) {
      for (const double elevation : {60.0, -5.0}) {
        s.scene.setSun(elevation, 10);
        s.scene.setCamera({0, 0, away}, 0, 0);
        s.render();
        for (uint32_t i = 0; i < DistanceScene::SIZE * DistanceScene::SIZE; ++i) {
          const auto [distance, hidden] = s.at(i);
          ASSERT_TRUE(std::isfinite(distance) && hidden >= 0 && hidden <= 1) << away;
          ASSERT_GE(distance, hidden > 0 ? std::max(away + 1000, 0.0) * (1 - 1e-5) : 0) << away;
          ASSERT_LE(distance, (std::abs(away) + 5000) * (1 + 1e-5)) << away;
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin::test
