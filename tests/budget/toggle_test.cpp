// SPDX-License-Identifier: MIT
// Sun, density and visibility that change in every frame: what comes back may not find what was
// kept for something else. Each frame is that of a scene that skips nothing, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t N = 8;   // voxels along an edge of the ball
constexpr int FRAMES = 16;  // of periods 2, 3, 4 and 5: few pairs of frames are alike

SceneOptions small() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  return options;
}

struct Kind {
  const char* name;
  uint32_t pass;  // whose result is kept
  uint32_t scattering;
  uint64_t flags;
  bool ambient;
};

class Toggled : public ::testing::TestWithParam<Kind> {
 protected:
  // One that keeps what it can, and one that computes all in each frame.
  void build(EngineScene& scene, uint64_t flags) {
    scene.setSky();
    scene.setSun(30, 20);
    scene.setCamera({0, 2, 0}, 0, 12);
    if (GetParam().pass == WLK_PASS_CLOUD_SHADOW) {
      scene.setFog(1e-4f, 2000);  // what the volume shades is seen
    }
    volumes_.push_back(scene.addBall(0.01f));
    setQuality(scene, flags);
    if (GetParam().ambient) {
      setAmbient(scene, 0.1f);
    }
    check(wlkPrepare(scene.context));
  }
  static void setQuality(const EngineScene& scene, uint64_t flags) {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = GetParam().scattering;
    quality.flags = GetParam().flags | flags;
    check(wlkSetQuality(scene.context, scene.view, &quality));
  }
  // The map by which volumes shade the air is kept in spite of the flag, but by its view.
  static void renewView(EngineScene& scene) {
    check(wlkDestroyView(scene.context, scene.view));
    scene.view = scene.addView(small());
    setQuality(scene, WLK_QUALITY_FLAG_NO_SKIP);
    check(wlkPrepare(scene.context));
  }
  static void setAmbient(const EngineScene& scene, float sky) {
    auto ambient = make<WlkAmbient>();
    ambient.mode = WLK_AMBIENT_GIVEN;
    std::fill_n(ambient.sky, 3, sky);
    check(wlkSetAmbient(scene.context, &ambient));
  }
  // Frame i of a scene.
  void show(EngineScene& scene, size_t which, int i) const {
    if (i % 5 == 4) {
      scene.clearLights();
    } else {
      scene.setSun(i / 2 % 2 == 0 ? 30 : 50, 20);
    }
    const float density = i % 3 == 0 ? 0.3f : i % 3 == 1 ? 1.0f : 0.0f;
    scene.upload(volumes_[which], {N, N, N}, std::vector<float>(size_t{N} * N * N, density));
    scene.setCamera({0, 2, 0}, i % 4 == 3 ? 180 : 0, 12);
    if (GetParam().ambient) {
      setAmbient(scene, i % 2 == 0 ? 0.1f : 0.4f);
    }
    scene.renderFrame();
  }
  static bool runs(const EngineScene& scene) {
    const std::vector<WlkPassStats> passes = scene.passes();
    return std::any_of(passes.begin(), passes.end(), [](const WlkPassStats& pass) {
      return pass.pass == GetParam().pass && pass.recorded != 0;
    });
  }

  std::vector<WlkVolume> volumes_;
};

TEST_P(Toggled, EachFrameIsThatOfASceneThatSkipsNothing) {
  EngineScene kept(small());
  EngineScene full(small());
  build(kept, 0);
  build(full, WLK_QUALITY_FLAG_NO_SKIP);
  int recorded = 0;
  for (int i = 0; i < FRAMES; ++i) {
    if (GetParam().pass == WLK_PASS_CLOUD_SHADOW) {
      renewView(full);
    }
    show(kept, 0, i);
    show(full, 1, i);
    recorded += runs(kept) ? 1 : 0;
    const Image picture = kept.read();
    EXPECT_TRUE(picture == full.read())
        << i << ": relative RMS " << relativeRms(picture, full.read());
  }
  EXPECT_GT(recorded, 0) << "the pass under test";
  EXPECT_LT(recorded, FRAMES);
  for (const EngineScene* scene : {&kept, &full}) {
    EXPECT_TRUE(scene->device().messages().empty()) << scene->device().messages().front();
  }
}

INSTANTIATE_TEST_SUITE_P(All, Toggled,
                         ::testing::Values(Kind{"VolumeLight", WLK_PASS_VOLUME_LIGHT,
                                                WLK_SCATTERING_ALL_ORDERS, 0, false},
                                           Kind{"AmbientLight", WLK_PASS_VOLUME_AMBIENT,
                                                WLK_SCATTERING_ALL_ORDERS, 0, true},
                                           Kind{"ViewShadow", WLK_PASS_CLOUD_SHADOW,
                                                WLK_SCATTERING_FORWARD,
                                                WLK_QUALITY_FLAG_VOLUME_SHADOWS, false}),
                         [](const ::testing::TestParamInfo<Kind>& one) { return one.param.name; });

}  // namespace
}  // namespace welkin::test
