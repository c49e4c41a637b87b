// SPDX-License-Identifier: MIT
// Cloud surfaces: meshes that are none, numbers that are none, and extreme ones; each is refused
// with its field named and nothing changed, or drawn as a finite picture.
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"
#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr WlkResult INVALID = WLK_ERROR_INVALID_ARGUMENT;

class SurfaceAbuse : public ::testing::Test {
 protected:
  SurfaceAbuse() : arrays(support::boxMesh()) {}

  VictimScene& victim = VictimScene::get();
  SurfaceArrays arrays;

  WlkResult create(const WlkSurfaceInfo& info) const {
    WlkSurface surface{};
    const WlkResult result = wlkCreateSurface(victim.scene.context, &info, &surface);
    EXPECT_EQ(result >= 0, surface.id != 0);
    return result;
  }

  void fails(const char* field, WlkResult code,
             const std::function<void(WlkSurfaceInfo&)>& spoil) const {
    WlkSurfaceInfo info = arrays.info(victim.medium, 0.01f);
    spoil(info);
    EXPECT_FAILS(create(info), code, field);
  }
};

TEST_F(SurfaceAbuse, NumbersOutOfRangeAreRefused) {
  using I = WlkSurfaceInfo;
  for (const float x : {-1e-6f, 1.1e6f, NOT_A_NUMBER, INFINITE}) {
    fails("extinction", INVALID, [x](I& i) { i.extinction = x; });
  }
  fails("vertexCount", INVALID, [](I& i) { i.vertexCount = 3; });
  fails("vertexCount", INVALID, [](I& i) { i.vertexCount = 0xffffffff; });
  fails("triangleCount", INVALID, [](I& i) { i.triangleCount = 0; });
  fails("triangleCount", INVALID, [](I& i) { i.triangleCount = 5'000'000; });
  for (const uint32_t stride : {0u, 8u, 13u, 4100u}) {
    fails("vertexStride", INVALID, [stride](I& i) { i.vertexStride = stride; });
  }
  fails("positions", INVALID, [](I& i) { i.positions = nullptr; });
  fails("indices", INVALID, [](I& i) { i.indices = nullptr; });
  fails("worldFromSurface", INVALID, [](I& i) { i.worldFromSurface[0] = 0; });
  fails("worldFromSurface", INVALID,
        [](I& i) { i.worldFromSurface[3] = std::numeric_limits<double>::infinity(); });
  fails("medium", WLK_ERROR_INVALID_HANDLE, [](I& i) { i.medium.id += 1 << 24; });
  const WlkSurfaceInfo good = arrays.info(victim.medium, 0.01f);
  EXPECT_FAILS(wlkCreateSurface(victim.scene.context, &good, nullptr), INVALID, "surface");
  abuseHeader<WlkSurfaceInfo>(good, [&](const WlkSurfaceInfo* info) {
    WlkSurface surface{};
    return wlkCreateSurface(victim.scene.context, info, &surface);
  });
  victim.expectUnchanged();
}

TEST_F(SurfaceAbuse, MeshesThatEncloseNothingAreRefused) {
  const auto broken = [&](const char* field, const std::function<void(SurfaceArrays&)>& spoil) {
    SurfaceArrays bad(support::boxMesh());
    spoil(bad);
    EXPECT_FAILS(create(bad.info(victim.medium, 0.01f)), INVALID, field);
  };
  for (const float x : {NOT_A_NUMBER, INFINITE, 1.1e7f}) {
    broken("positions", [x](SurfaceArrays& a) { a.positions[7] = x; });
  }
  broken("positions", [](SurfaceArrays& a) {  // flat
    for (size_t i = 0; i < a.positions.size(); i += 3) {
      a.positions[i] = 5;
    }
  });
  broken("indices", [](SurfaceArrays& a) { a.indices[4] = 8; });
  broken("indices", [](SurfaceArrays& a) { a.indices.resize(33); });  // open
  broken("indices", [](SurfaceArrays& a) { std::swap(a.indices[0], a.indices[1]); });
  victim.expectUnchanged();
}

TEST_F(SurfaceAbuse, MovesThatDoNotFitAreRefused) {
  const WlkContext c = victim.scene.context;
  WlkSurfaceInfo info = arrays.info(victim.medium, 0.01f);
  place(info, {50, 50, 50}, {0, 2, -300});
  WlkSurface surface{};
  check(wlkCreateSurface(c, &info, &surface));
  const Image before = victim.scene.render();
  const auto moved = [&](uint32_t count, uint32_t stride) {
    return wlkSetSurfacePositions(c, surface, arrays.positions.data(), count, stride);
  };
  EXPECT_FAILS(moved(7, 12), INVALID, "vertexCount");
  EXPECT_FAILS(moved(8, 11), INVALID, "vertexStride");
  EXPECT_FAILS(wlkSetSurfacePositions(c, surface, nullptr, 8, 12), INVALID, "positions");
  arrays.positions[20] = NOT_A_NUMBER;
  EXPECT_FAILS(moved(8, 12), INVALID, "positions");
  const double singular[12] = {};
  EXPECT_FAILS(wlkSetSurfaceTransform(c, surface, singular), INVALID, "worldFromSurface");
  EXPECT_FAILS(wlkSetSurfaceTransform(c, surface, nullptr), INVALID, "worldFromSurface");
  EXPECT_TRUE(victim.scene.render() == before);
  check(wlkDestroySurface(c, surface));
  EXPECT_FAILS(moved(8, 12), WLK_ERROR_INVALID_HANDLE, "surface");
  EXPECT_FAILS(wlkSetSurfaceTransform(c, surface, info.worldFromSurface), WLK_ERROR_INVALID_HANDLE,
               "surface");
  EXPECT_FAILS(wlkDestroySurface(c, surface), WLK_ERROR_INVALID_HANDLE, "surface");
  victim.expectUnchanged();
}

TEST_F(SurfaceAbuse, DetailsOutOfRangeAreRefused) {
  WlkContext c = victim.scene.context;
  const WlkSurfaceInfo info = arrays.info(victim.medium, 0.01f);
  WlkSurface surface{};
  check(wlkCreateSurface(c, &info, &surface));
  check(wlkPrepare(c));
  const Image before = victim.scene.render();
  const auto refused = [&](const char* field, const std::function<void(WlkSurfaceDetail&)>& spoil) {
    auto detail = make<WlkSurfaceDetail>();
    detail.depth = 0.1f;
    spoil(detail);
    EXPECT_FAILS(wlkSetSurfaceDetail(c, surface, &detail), INVALID, field);
  };
  using D = WlkSurfaceDetail;
  for (const float x : {-1e-6f, 1.1e6f, NOT_A_NUMBER, INFINITE}) {
    refused("depth", [x](D& d) { d.depth = x; });
    refused("size", [x](D& d) { d.size = x; });
  }
  for (const float x : {0.04f, 1.01f, NOT_A_NUMBER}) {
    refused("softness", [x](D& d) { d.softness = x; });
  }
  for (const float x : {-1.1e7f, 1.1e7f, NOT_A_NUMBER}) {
    refused("offset", [x](D& d) { d.offset[2] = x; });
  }
  auto good = make<WlkSurfaceDetail>();
  good.depth = 0.1f;
  abuseHeader<WlkSurfaceDetail>(good, [&](const WlkSurfaceDetail* detail) {
    return wlkSetSurfaceDetail(c, surface, detail);
  });
  EXPECT_TRUE(victim.scene.render() == before);
  check(wlkDestroySurface(c, surface));
  EXPECT_FAILS(wlkSetSurfaceDetail(c, surface, &good), WLK_ERROR_INVALID_HANDLE, "surface");
  EXPECT_FAILS(wlkSetSurfaceDetail(c, surface, nullptr), WLK_ERROR_INVALID_HANDLE, "surface");
  victim.expectUnchanged();
}

// Depths and lumps from a micrometre to far more than the cloud, and back, while frames run.
TEST_F(SurfaceAbuse, AnyDetailIsSane) {
  WlkContext c = victim.scene.context;
  const WlkSurfaceInfo info = arrays.info(victim.medium, 0.01f);
  WlkSurface surface{};
  check(wlkCreateSurface(c, &info, &surface));
  check(wlkPrepare(c));
  const Image plain = victim.scene.render();
  for (const float depth : {1e6f, 1e-7f, 3.0f, 0.2f, 1e-3f}) {
    for (const float size : {0.0f, 1e-6f, 1e6f}) {
      auto detail = make<WlkSurfaceDetail>();
      detail.depth = depth;
      detail.size = size;
      detail.softness = size > 0 ? 0.05f : 1.0f;
      detail.offset[0] = 1e7f;
      check(wlkSetSurfaceDetail(c, surface, &detail));
      EXPECT_EQ(victim.scene.render().badValues(), 0u) << depth << ' ' << size;
    }
  }
  check(wlkSetSurfaceDetail(c, surface, nullptr));
  EXPECT_TRUE(victim.scene.render() == plain);
  check(wlkDestroySurface(c, surface));
  victim.expectUnchanged();
}

TEST_F(SurfaceAbuse, NeedADevice) {
  const CpuContext cpu;
  auto medium = make<WlkMediumInfo>();
  medium.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  WlkMedium handle{};
  check(wlkCreateMedium(cpu.context, &medium, &handle));
  WlkSurface surface{};
  const WlkSurfaceInfo info = arrays.info(handle, 0.01f);
  EXPECT_FAILS(wlkCreateSurface(cpu.context, &info, &surface), WLK_ERROR_WRONG_STATE, "context");
}

struct Extreme {
  const char* name;
  float extinction;
  std::array<double, 3> scale;
  std::array<double, 3> middle;
};

// Thin as a film, thick as a stone, a planet's size and a grain's, far away, around the eye, with
// the eye in a face; meshes that meet themselves, or were moved flat or inside out.
TEST(SurfaceExtremes, PicturesAreFinite) {
  SceneOptions options;
  options.validation = false;
  HeadlessScene scene(options);
  scene.setSky();
  scene.setSun(20, 30);
  scene.setFog(1e-4f, 200);
  auto ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_AUTOMATIC;
  check(wlkSetAmbient(scene.context, &ambient));
  const WlkMedium cloud = scene.addMedium();
  const WlkMedium forward = scene.addHenyeyGreenstein(0.999f);
  const WlkMedium backward = scene.addHenyeyGreenstein(-0.999f);
  for (const Extreme& e : {Extreme{"usual", 0.01f, {500, 500, 500}, {0, 400, -2000}},
                           Extreme{"none", 0, {500, 500, 500}, {0, 400, -2000}},
                           Extreme{"thinnest", 1e-30f, {500, 500, 500}, {0, 400, -2000}},
                           Extreme{"thickest", 1e6f, {500, 500, 500}, {0, 400, -2000}},
                           Extreme{"flat", 0.1f, {5000, 0.01, 5000}, {0, 400, -2000}},
                           Extreme{"planet", 1e6f, {1e9, 1e9, 1e9}, {0, 0, 0}},
                           Extreme{"grain", 1e6f, {1e-3, 1e-3, 1e-3}, {0, 2, -0.01}},
                           Extreme{"far", 1, {1e7, 1e7, 1e7}, {0, 0, -9e8}},
                           Extreme{"around", 0.001f, {500, 500, 500}, {0, 2, 0}},
                           Extreme{"face", 0.01f, {500, 500, 500}, {0, 2, -500}},
                           Extreme{"edge", 0.01f, {500, 500, 500}, {500, 2, -500}}}) {
    for (const WlkMedium medium : {cloud, forward, backward}) {
      for (const auto& mesh : {support::boxMesh(), support::torusMesh()}) {
        const WlkSurface surface = addSurface(scene, mesh, medium, e.extinction, e.scale, e.middle);
        const Image image = scene.render();
        EXPECT_EQ(image.badValues(), 0u) << e.name;
        EXPECT_EQ(scene.stats().nonFinitePixels, 0u) << e.name;
        check(wlkDestroySurface(scene.context, surface));
      }
    }
  }
}

TEST(SurfaceExtremes, MovedFlatInsideOutOrIntoAPointIsFinite) {
  SceneOptions options;
  options.validation = false;
  HeadlessScene scene(options);
  scene.setSun(20, 30);
  const WlkSurface surface = addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f,
                                        {500, 500, 500}, {0, 400, -2000});
  const SurfaceArrays arrays(support::torusMesh());
  for (const std::array<float, 3>& scale : {std::array{1.0f, 0.0f, 1.0f},
                                            {-1.0f, 1.0f, 1.0f},
                                            {0.0f, 0.0f, 0.0f},
                                            {1e4f, 1e4f, 1e4f},
                                            {1.0f, 1.0f, 1.0f}}) {
    std::vector<float> positions = arrays.positions;
    for (size_t i = 0; i < positions.size(); ++i) {
      positions[i] *= scale[i % 3];
    }
    check(wlkSetSurfacePositions(scene.context, surface, positions.data(),
                                 static_cast<uint32_t>(positions.size() / 3), 12));
    EXPECT_EQ(scene.render().badValues(), 0u) << scale[0] << ' ' << scale[1];
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
  }
}

}  // namespace
}  // namespace welkin::test
