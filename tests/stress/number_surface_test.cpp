// SPDX-License-Identifier: MIT
// Numbers of cloud surfaces, their detail and a view's controlled quality (number_abuse.hpp).
#include "stress/number_abuse.hpp"
#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr float EXTINCTION = 0.01f;  // 1/m

// A box of 200 m in sight of the victim's eye.
WlkSurfaceInfo surfaceInSight(const SurfaceArrays& arrays) {
  WlkSurfaceInfo info = arrays.info(VictimScene::get().medium, EXTINCTION);
  const double place[12] = {100, 0, 0, 40, 0, 100, 0, 120, 0, 0, 100, -600};
  std::copy(std::begin(place), std::end(place), info.worldFromSurface);
  return info;
}

TEST(NumberFields, OfSurfacesAreRefusedOrHarmless) {
  const WlkContext c = VictimScene::get().scene.context;
  const SurfaceArrays arrays(support::boxMesh());
  WlkSurface surface{};
  abuseNumbers<WlkSurfaceInfo>(
      surfaceInSight(arrays),
      {FLOATS(WlkSurfaceInfo, extinction, 1), DOUBLES(WlkSurfaceInfo, worldFromSurface, 12)},
      [&](const WlkSurfaceInfo& p) {
        surface = {};
        const WlkResult result = wlkCreateSurface(c, &p, &surface);
        EXPECT_EQ(result == WLK_SUCCESS, surface.id != 0);
        return result;
      },
      [&] {
        ASSERT_EQ(wlkDestroySurface(c, surface), WLK_SUCCESS);
        ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
      });
}

TEST(NumberFields, OfDetailAreRefusedOrHarmless) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  const SurfaceArrays arrays(support::boxMesh());
  const WlkSurfaceInfo info = surfaceInSight(arrays);
  WlkSurface surface{};
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = 20.0f;
  // Each value's surface is its own: a refused one must leave the scene as it was without.
  abuseNumbers<WlkSurfaceDetail>(
      detail,
      {FLOATS(WlkSurfaceDetail, depth, 1), FLOATS(WlkSurfaceDetail, size, 1),
       FLOATS(WlkSurfaceDetail, softness, 1), FLOATS(WlkSurfaceDetail, offset, 3)},
      [&](const WlkSurfaceDetail& p) {
        EXPECT_EQ(wlkCreateSurface(c, &info, &surface), WLK_SUCCESS);
        const WlkResult result = wlkSetSurfaceDetail(c, surface, &p);
        if (result != WLK_SUCCESS) {
          const WlkErrorInfo error = lastError();
          EXPECT_EQ(wlkDestroySurface(c, surface), WLK_SUCCESS);
          EXPECT_EQ(wlkPrepare(c), WLK_SUCCESS);
          // The error that abuseNumbers looks at again: calls that succeed leave it.
          EXPECT_STREQ(lastError().field, error.field);
        }
        return result;
      },
      [&] {
        ASSERT_EQ(wlkDestroySurface(c, surface), WLK_SUCCESS);
        ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
      });
}

TEST(NumberFields, OfControlledQualityAreRefusedOrHarmless) {
  const HeadlessScene& scene = VictimScene::get().scene;
  const auto set = [&](const WlkQuality& p) {
    return wlkSetQuality(scene.context, scene.view, &p);
  };
  const auto undo = [&] {
    ASSERT_EQ(set(qualityOf(scene.options())), WLK_SUCCESS);
    ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  };
  WlkQuality quality = qualityOf(scene.options());
  quality.control = WLK_CONTROL_REPORTED_TIME;
  quality.timeBudget_ms = 5.0f;
  abuseNumbers<WlkQuality>(quality, {FLOATS(WlkQuality, timeBudget_ms, 1)}, set, undo);
  quality = qualityOf(scene.options());
  quality.control = WLK_CONTROL_ERROR;
  quality.errorTarget = 0.1f;
  abuseNumbers<WlkQuality>(quality, {FLOATS(WlkQuality, errorTarget, 1)}, set, undo);
}

}  // namespace
}  // namespace welkin::test
