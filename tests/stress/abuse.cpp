// SPDX-License-Identifier: MIT
#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

SceneOptions victimOptions() {
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  options.volumeCells = 8;
  return options;
}

std::unique_ptr<VictimScene>& instance() {
  static std::unique_ptr<VictimScene> scene;
  return scene;
}

// Ends the scene before the process leaves main: drivers and layers have statics of their own.
class EndScene : public ::testing::Environment {
 public:
  void TearDown() override {
    if (instance()) {
      EXPECT_TRUE(instance()->scene.messages().empty()) << instance()->scene.messages().front();
      instance().reset();
    }
  }
};
const auto* const registered = ::testing::AddGlobalTestEnvironment(new EndScene);

}  // namespace

VictimScene& VictimScene::get() {
  if (!instance()) {
    instance().reset(new VictimScene);
  }
  return *instance();
}

VictimScene::VictimScene() : scene(victimOptions()) {
  scene.addBall(0.005f);
  medium = scene.addMedium();
  volume =
      scene.addVolume(medium, {4, 4, 4}, boxTransform({-200, 0, -900}, {400, 300, 400}), 1e-3f);
  scene.upload(volume, {4, 4, 4}, std::vector<float>(64, 0.5f));
  restore();
  before_ = scene.render();
  EXPECT_EQ(before_.badValues(), 0u);
}

void VictimScene::restore() {
  check(wlkSetPlanet(scene.context, nullptr));
  check(wlkSetAbsorber(scene.context, nullptr));
  auto off = make<WlkAmbient>();
  off.mode = WLK_AMBIENT_OFF;
  check(wlkSetAmbient(scene.context, &off));
  scene.setSky();
  scene.setFog(2e-4f, 300.0f);
  scene.setSun(35.0, 20.0);
  scene.setCamera({0, 2, 0}, 0.0, 12.0);
  const auto transform = boxTransform({-200, 0, -900}, {400, 300, 400});
  check(wlkSetVolumeTransform(scene.context, volume, transform.data()));
  check(wlkPrepare(scene.context));
}

void VictimScene::expectUnchanged() {
  ASSERT_EQ(wlkRenderHeadless(scene.context, scene.view, nullptr), WLK_SUCCESS)
      << "a failed call left the view unprepared: " << lastError().message;
  const Image now = scene.read(WLK_IMAGE_COLOR);
  EXPECT_TRUE(now == before_) << "relative RMS " << relativeRms(now, before_);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

::testing::AssertionResult failsWith(WlkResult result, WlkResult code, const char* field) {
  if (result != code) {
    return ::testing::AssertionFailure()
           << "returned " << wlkResultName(result) << ", expected " << wlkResultName(code);
  }
  const WlkErrorInfo info = lastError();
  if (info.result != code || std::strcmp(info.field, field) != 0 || info.message[0] == '\0') {
    return ::testing::AssertionFailure()
           << "last error is " << wlkResultName(info.result) << " of the field '" << info.field
           << "' (" << info.message << "), expected the field '" << field << "'";
  }
  return ::testing::AssertionSuccess();
}

CpuContext::CpuContext(const WlkAllocator& allocator) {
  auto info = make<WlkContextInfo>();
  info.allocator = allocator;
  check(wlkCreateContext(WLK_API_VERSION, &info, &context));
}

}  // namespace welkin::test
