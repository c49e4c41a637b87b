// SPDX-License-Identifier: MIT
// wlkUploadVolumeBricks: bricks outside, twice, too many, data that ends too early, any numbers.
#include <random>

#include "stress/abuse.hpp"
#include "support/brick_volume.hpp"

namespace welkin::test {
namespace {

// One brick, the only one that 4^3 voxels have.
BrickVolume oneBrick(float value) {
  return {{0, 0, 0}, std::vector<float>(512, value)};
}

TEST(BrickUpload, RefusesWhatDoesNotFitAndKeepsTheVolume) {
  VictimScene& victim = VictimScene::get();
  const BrickVolume valid = oneBrick(0.9f);
  static const std::vector<uint32_t> outside{0, 1, 0};
  static const std::vector<uint32_t> far{0xffffffffu, 0, 0};
  struct Case {
    const char* field;
    WlkResult code;
    std::function<void(WlkVolumeBricks&)> spoil;
  };
  using B = WlkVolumeBricks;
  constexpr WlkResult INVALID = WLK_ERROR_INVALID_ARGUMENT;
  constexpr uint32_t MOST = 0xffffffffu;
  const std::vector<Case> cases{
      {"field", INVALID, [](B& b) { b.field = 1; }},
      {"field", INVALID, [](B& b) { b.field = MOST; }},
      {"format", WLK_ERROR_UNSUPPORTED_FORMAT, [](B& b) { b.format = 0; }},
      {"format", WLK_ERROR_UNSUPPORTED_FORMAT, [](B& b) { b.format = MOST; }},
      {"count", INVALID, [](B& b) { b.count = 2; }},
      {"count", INVALID, [](B& b) { b.count = MOST; }},
      {"coordinates", INVALID, [](B& b) { b.coordinates = nullptr; }},
      {"coordinates", INVALID, [](B& b) { b.coordinates = outside.data(); }},
      {"coordinates", INVALID, [](B& b) { b.coordinates = far.data(); }},
      {"data", INVALID, [](B& b) { b.data = nullptr; }},
      {"dataSize", INVALID, [](B& b) { b.dataSize -= 1; }},
      {"dataSize", INVALID, [](B& b) { b.dataSize = 0; }},
      {"brickPitch", INVALID, [](B& b) { b.brickPitch = 2047; }}};
  for (size_t i = 0; i < cases.size(); ++i) {
    WlkVolumeBricks bricks = valid.upload();
    cases[i].spoil(bricks);
    EXPECT_FAILS(wlkUploadVolumeBricks(victim.scene.context, victim.volume, &bricks), cases[i].code,
                 cases[i].field)
        << "case " << i;
  }
  EXPECT_FAILS(wlkUploadVolumeBricks(victim.scene.context, victim.volume, nullptr), INVALID,
               "WlkVolumeBricks");
  victim.expectUnchanged();
}

TEST(BrickUpload, RefusesABrickTwiceAndPitchesThatOverflow) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  const WlkVolume volume =
      victim.scene.addVolume(victim.medium, {24, 8, 8}, boxTransform({0, 0, 0}, {1, 1, 1}), 0.01f);
  const std::vector<uint32_t> coordinates{2, 0, 0, 1, 0, 0, 2, 0, 0};
  const std::vector<float> values(3 * 512, 0.5f);
  auto bricks = make<WlkVolumeBricks>();
  bricks.count = 3;
  bricks.coordinates = coordinates.data();
  bricks.data = values.data();
  bricks.dataSize = values.size() * sizeof(float);
  EXPECT_FAILS(wlkUploadVolumeBricks(c, volume, &bricks), WLK_ERROR_INVALID_ARGUMENT,
               "coordinates");
  bricks.brickPitch = ~uint64_t{0};
  EXPECT_FAILS(wlkUploadVolumeBricks(c, volume, &bricks), WLK_ERROR_INVALID_ARGUMENT, "brickPitch");
  bricks.count = 2;
  bricks.brickPitch = 2048 + 2048;
  EXPECT_EQ(wlkUploadVolumeBricks(c, volume, &bricks), WLK_SUCCESS);
  auto state = make<WlkVolumeState>();
  ASSERT_EQ(wlkGetVolumeState(c, volume, &state), WLK_SUCCESS);
  EXPECT_EQ(state.bricks[0], 3u);
  EXPECT_EQ(state.occupiedBricks, 2u);
  EXPECT_EQ(state.storedBricks, 3u);  // the first is before an occupied one
  EXPECT_GT(state.pendingMemory, 0u);
  // Part of a field that is kept as bricks.
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = 8;
  upload.data = values.data();
  upload.dataSize = 512 * sizeof(float);
  EXPECT_FAILS(wlkUploadVolume(c, volume, &upload), WLK_ERROR_INVALID_ARGUMENT, "extent");
  EXPECT_EQ(wlkDestroyVolume(c, volume), WLK_SUCCESS);
  EXPECT_FAILS(wlkGetVolumeState(c, volume, &state), WLK_ERROR_INVALID_HANDLE, "volume");
  ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
  victim.expectUnchanged();
}

TEST(BrickUpload, OfAnyNumbersIsFinite) {
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  HeadlessScene scene(options);
  scene.setSky();
  scene.setSun(30, 40);
  scene.setCamera({0, 2, 0}, 0, 10);
  const WlkVolume volume = scene.addVolume(scene.addMedium(), {11, 17, 8},
                                           boxTransform({-300, 50, -1500}, {600, 500, 800}), 10.0f);
  const std::vector<uint32_t> coordinates{0, 0, 0, 1, 2, 0, 0, 1, 0, 1, 1, 0};
  std::mt19937 random(2004);
  for (const uint32_t format : {WLK_FORMAT_R32_FLOAT, WLK_FORMAT_R16_FLOAT, WLK_FORMAT_R8_UNORM}) {
    std::vector<uint32_t> bits(4 * 512);
    for (uint32_t& word : bits) {
      word = static_cast<uint32_t>(random());
    }
    auto bricks = make<WlkVolumeBricks>();
    bricks.format = format;
    bricks.count = 4;
    bricks.coordinates = coordinates.data();
    bricks.data = bits.data();
    bricks.dataSize = bits.size() * 4;
    check(wlkUploadVolumeBricks(scene.context, volume, &bricks));
    EXPECT_EQ(scene.render().badValues(), 0u);
  }
  // Bricks without anything take no slot.
  BrickVolume nothing = oneBrick(0.0f);
  nothing.values[7] = -1.0f;
  nothing.values[8] = 1e-9f;
  const WlkVolumeBricks bricks = nothing.upload();
  check(wlkUploadVolumeBricks(scene.context, volume, &bricks));
  auto state = make<WlkVolumeState>();
  check(wlkGetVolumeState(scene.context, volume, &state));
  EXPECT_EQ(state.occupiedBricks + state.storedBricks, 0u);
  EXPECT_EQ(scene.render().badValues(), 0u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

}  // namespace
}  // namespace welkin::test
