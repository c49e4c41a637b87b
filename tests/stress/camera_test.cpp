// SPDX-License-Identifier: MIT
// wlkSetCamera: projections and rotations that are none.
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

using Matrix4 = std::array<float, 16>;  // column-major
using Matrix3 = std::array<float, 9>;

WlkResult project(const Matrix4& m) {
  const HeadlessScene& scene = VictimScene::get().scene;
  auto camera = make<WlkCamera>();
  camera.position[0] = 50;
  std::memcpy(camera.clipFromView, m.data(), sizeof camera.clipFromView);
  return wlkSetCamera(scene.context, scene.view, &camera);
}

WlkResult rotate(const Matrix3& m) {
  const HeadlessScene& scene = VictimScene::get().scene;
  auto camera = make<WlkCamera>();
  camera.position[0] = 50;
  std::memcpy(camera.viewFromWorld, m.data(), sizeof camera.viewFromWorld);
  return wlkSetCamera(scene.context, scene.view, &camera);
}

TEST(CameraAbuse, SingularAndOrthographicProjectionsAreRefused) {
  const std::vector<Matrix4> bad{
      {},                                                           // all zero
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},             // identity
      {0.1f, 0, 0, 0, 0, 0.1f, 0, 0, 0, 0, -1e-3f, 0, 0, 0, 0, 1},  // orthographic
      {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0.1f, 0},         // two equal columns
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.1f, 0},          // w is always 0
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, 0, 0},           // near plane at the eye
      {1e-30f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 0.1f, 0}};   // 180 degrees wide
  for (size_t i = 0; i < bad.size(); ++i) {
    EXPECT_FAILS(project(bad[i]), WLK_ERROR_INVALID_ARGUMENT, "clipFromView") << i;
  }
  const HeadlessScene& scene = VictimScene::get().scene;
  EXPECT_FAILS(wlkSetCamera(scene.context, scene.view, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "WlkCamera");
  VictimScene::get().expectUnchanged();
}

TEST(CameraAbuse, MatricesThatAreNoRotationAreRefused) {
  const std::vector<Matrix3> bad{{},
                                 {1, 0, 0, 0, 1, 0, 0, 0, 0},
                                 {1, 0, 0, 1, 0, 0, 0, 0, 1},
                                 {0.99f, 0, 0, 0, 0.99f, 0, 0, 0, 0.99f},
                                 {1, 0.01f, 0, 0, 1, 0, 0, 0, 1},
                                 {-1, 0, 0, 0, 1, 0, 0, 0, 1.005f}};
  for (size_t i = 0; i < bad.size(); ++i) {
    EXPECT_FAILS(rotate(bad[i]), WLK_ERROR_INVALID_ARGUMENT, "viewFromWorld") << i;
  }
  VictimScene::get().expectUnchanged();
}

TEST(CameraAbuse, EveryUsualProjectionIsAcceptedAndFinite) {
  VictimScene& victim = VictimScene::get();
  constexpr float N = 0.1f;
  constexpr float F = 1e5f;
  const std::vector<Matrix4> good{
      {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1, 0, 0, N, 0},                         // reversed, inf
      {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, -1, 0, 0, -N, 0},                       // standard, inf
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, F / (N - F), -1, 0, 0, N * F / (N - F), 0},  // standard
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, N / (F - N), -1, 0, 0, N * F / (F - N), 0},  // reversed
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, N, 0},                           // left-handed
      {1, 0, 0, 0, 0, 1, 0, 0, 0.7f, -0.4f, 0, -1, 0, 0, N, 0},                   // off-axis
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 1e-6f, 0},                      // tiny near
      {1e5f, 0, 0, 0, 0, 1e5f, 0, 0, 0, 0, 0, -1, 0, 0, 100, 0},                  // telescope
      {1e-3f, 0, 0, 0, 0, 1e-3f, 0, 0, 0, 0, 0, -1, 0, 0, N, 0}};                 // 179.9 degrees
  const std::vector<float> depth(16 * 12, 0.3f);
  auto targets = make<WlkHeadlessInputs>();
  targets.depth = depth.data();
  targets.depthSize = depth.size() * sizeof(float);
  for (size_t i = 0; i < good.size(); ++i) {
    EXPECT_EQ(project(good[i]), WLK_SUCCESS) << i;
    for (const WlkHeadlessInputs* with : {static_cast<WlkHeadlessInputs*>(nullptr), &targets}) {
      ASSERT_EQ(wlkRenderHeadless(victim.scene.context, victim.scene.view, with), WLK_SUCCESS);
      EXPECT_EQ(victim.scene.read(WLK_IMAGE_COLOR).badValues(), 0u) << i;
      EXPECT_EQ(victim.scene.stats().nonFinitePixels, 0u) << i;
    }
  }
  victim.restore();
  victim.expectUnchanged();
}

TEST(CameraAbuse, AnyDepthAndColorOfTheEngineGiveAFinitePicture) {
  VictimScene& victim = VictimScene::get();
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> strange{nan,  infinity, -infinity, -1.0f,
                                   2.0f, 1e-45f,   3.4e38f,   -3.4e38f};
  std::vector<float> color;
  std::vector<float> depth;
  for (size_t i = 0; i < 16 * 12; ++i) {
    depth.push_back(strange[i % strange.size()]);
    for (size_t channel = 0; channel < 3; ++channel) {
      color.push_back(strange[(i / 8 + channel) % strange.size()]);
    }
    color.push_back(0.25f);
  }
  auto targets = make<WlkHeadlessInputs>();
  targets.depth = depth.data();
  targets.depthSize = depth.size() * sizeof(float);
  ASSERT_EQ(wlkRenderHeadless(victim.scene.context, victim.scene.view, &targets), WLK_SUCCESS);
  EXPECT_EQ(victim.scene.read(WLK_IMAGE_COLOR).badValues(), 0u);
  targets.color = color.data();
  targets.colorSize = color.size() * sizeof(float);
  ASSERT_EQ(wlkRenderHeadless(victim.scene.context, victim.scene.view, &targets), WLK_SUCCESS);
  const Image image = victim.scene.read(WLK_IMAGE_COLOR);
  EXPECT_EQ(image.badValues(), 0u);
  EXPECT_EQ(image.rgba[3], 0.25f) << "the engine's alpha stays";
  EXPECT_GT(victim.scene.stats().nonFinitePixels, 0u) << "the engine's NaN were not counted";
  victim.expectUnchanged();
}

}  // namespace
}  // namespace welkin::test
