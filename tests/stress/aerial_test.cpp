// SPDX-License-Identifier: MIT
// Aerial perspective: fields and images that are wrong, calls out of order, extreme scenes.
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"
#include "support/aerial_scene.hpp"

namespace welkin::test {
namespace {

using Info = WlkAerialPerspective;

Info small() {
  auto info = make<Info>();
  info.width = 8;
  info.height = 6;
  info.depth = 4;
  return info;
}

class AerialAbuse : public ::testing::Test {
 protected:
  AerialAbuse() : s(small()) {
    s.scene.setSky();
    check(wlkPrepare(s.scene.context));
    s.render();
    before = s.texels(0);
  }
  ~AerialAbuse() override {
    s.render();
    EXPECT_EQ(s.texels(0), before);
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }
  WlkResult set(const Info* info) {
    return wlkSetAerialPerspective(s.scene.context, s.scene.view, info);
  }
  // The frame's code with these images; nothing may be recorded.
  WlkResult render(const WlkVulkanImage* radiance, const WlkVulkanImage* transmittance) {
    const auto usual = s.scene.addTargets;
    s.scene.addTargets = [&](WlkVulkanViewTargets& targets) {
      usual(targets);
      targets.aerialRadiance = radiance;
      targets.aerialTransmittance = transmittance;
    };
    WlkResult code = WLK_SUCCESS;
    try {
      s.scene.renderFrame();
    } catch (const Error& error) {
      code = error.result();
      EXPECT_EQ(SpyDevice::counts().dispatches + SpyDevice::counts().barriers, 0u);
    }
    s.scene.addTargets = usual;
    return code;
  }
  WlkResult renderRadiance(const std::function<void(WlkVulkanImage&)>& spoil) {
    WlkVulkanImage bad = s.described[0];
    spoil(bad);
    return render(&bad, &s.described[1]);
  }

  AerialScene s;
  std::vector<float> before;
};

TEST_F(AerialAbuse, FieldsOutOfRangeAreNamedAndChangeNothing) {
  struct Case {
    const char* field;
    void (*spoil)(Info&);
  };
  constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Case> cases{{"width", [](Info& i) { i.width = 0; }},
                                {"width", [](Info& i) { i.width = 2049; }},
                                {"height", [](Info& i) { i.height = 0xffffffff; }},
                                {"depth", [](Info& i) { i.depth = 1; }},
                                {"depth", [](Info& i) { i.depth = 1025; }},
                                {"exponent", [](Info& i) { i.exponent = 0.5f; }},
                                {"exponent", [](Info& i) { i.exponent = NOT_A_NUMBER; }},
                                {"distance", [](Info& i) { i.distance = 0; }},
                                {"distance", [](Info& i) { i.distance = 2e7f; }},
                                {"distance", [](Info& i) { i.distance = NOT_A_NUMBER; }}};
  for (const Case& test : cases) {
    Info info = small();
    test.spoil(info);
    EXPECT_FAILS(set(&info), WLK_ERROR_INVALID_ARGUMENT, test.field);
  }
  abuseHeader<Info>(small(), [&](const Info* info) { return set(info); });
  const Info info = small();
  for (const uint64_t id : {uint64_t{0}, s.scene.view.id + (1 << 24)}) {
    EXPECT_FAILS(wlkSetAerialPerspective(s.scene.context, {id}, &info), WLK_ERROR_INVALID_HANDLE,
                 "view");
  }
}

TEST_F(AerialAbuse, ImagesThatDoNotFitAreRefused) {
  using I = WlkVulkanImage;
  EXPECT_EQ(renderRadiance([](I& i) { i.image = VK_NULL_HANDLE; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(renderRadiance([](I& i) { i.width = 9; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(renderRadiance([](I& i) { i.height = 5; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(renderRadiance([](I& i) { i.depth = 1; }), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(renderRadiance([](I& i) { i.after.layout = VK_IMAGE_LAYOUT_UNDEFINED; }),
            WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(renderRadiance([](I& i) { i.format = VK_FORMAT_R8G8B8A8_UNORM; }),
            WLK_ERROR_UNSUPPORTED_FORMAT);
  EXPECT_EQ(renderRadiance([](I& i) { i.sType = WLK_STRUCT_SKY; }), WLK_ERROR_UNKNOWN_STRUCT);
  EXPECT_EQ(render(&s.described[0], nullptr), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render(nullptr, &s.described[1]), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(render(&s.described[0], s.described.data()), WLK_ERROR_INVALID_ARGUMENT);
}

TEST_F(AerialAbuse, CallsOutOfOrderAreRefused) {
  check(set(nullptr));
  EXPECT_EQ(render(&s.described[0], &s.described[1]), WLK_ERROR_WRONG_STATE);
  Info info = small();
  info.depth = 5;
  check(set(&info));
  EXPECT_EQ(render(nullptr, nullptr), WLK_ERROR_NOT_PREPARED);
  info = small();
  check(set(&info));
  check(wlkPrepare(s.scene.context));
  info.distance = 100;
  check(set(&info));
  EXPECT_EQ(render(&s.described[0], &s.described[1]), WLK_SUCCESS) << "another distance";
  info = small();
  check(set(&info));
}

TEST(AerialModes, NeedAnEngineDevice) {
  const CpuContext cpu;
  const Info info = small();
  EXPECT_FAILS(wlkSetAerialPerspective(cpu.context, {}, &info), WLK_ERROR_WRONG_STATE, "context");
}

// Froxels of every length, an eye in space, underground and inside dense volumes: finite, never
// negative, transmittance at most 1 and falling.
TEST(AerialExtremes, AreFinite) {
  for (const float distance : {1.0f, 32000.0f, 1e7f}) {
    Info info = small();
    info.distance = distance;
    info.exponent = distance > 1e6f ? 8.0f : 1.0f;
    AerialScene s(info);
    s.scene.setSky();
    s.scene.setFog(1e-4f, 1000);
    const WlkVolume volume =
        s.scene.addVolume(s.scene.addMedium(), {1, 3, 1},
                          boxTransform({-1000, 500, -6000}, {2000, 2000, 7000}), 10.0f);
    s.scene.upload(volume, {1, 3, 1}, {65504.0f, 0.0f, 1e-7f});
    check(wlkPrepare(s.scene.context));
    for (const double height : {-1000.0, 2.0, 1100.0, 1e5, 3.6e7}) {
      for (const double elevation : {60.0, -5.0}) {
        s.scene.setSun(elevation, 10);
        s.scene.setCamera({0, height, 0}, 0, height > 1e4 ? -80 : 0);
        s.render();
        for (uint32_t i = 0; i < info.width * info.height * info.depth; ++i) {
          const uint32_t slice = i / (info.width * info.height);
          const RayLayer here = s.froxel(i % info.width, i / info.width % info.height, slice);
          const RayLayer last =
              s.froxel(i % info.width, i / info.width % info.height, slice > 0 ? slice - 1 : 0);
          for (size_t c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(here.radiance[c]) && here.radiance[c] >= 0) << height;
            ASSERT_GE(here.transmittance[c], 0) << height;
            ASSERT_LE(here.transmittance[c], last.transmittance[c] + 1e-6) << height;
          }
        }
        EXPECT_EQ(s.scene.stats().nonFinitePixels, 0u);
      }
    }
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }
}

}  // namespace
}  // namespace welkin::test
