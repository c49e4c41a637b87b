// SPDX-License-Identifier: MIT
// Volumes of garbage and of extreme shape: the picture stays finite and non-negative.
#include <limits>
#include <random>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

SceneOptions small() {
  SceneOptions options;
  options.width = 17;
  options.height = 13;
  options.volumeCells = 8;
  return options;
}

// A scene with sky and sun and one volume around the line of sight; remade by each test.
struct VolumeScene {
  explicit VolumeScene(const std::array<uint32_t, 3>& voxels, float extinction = 0.01f)
      : scene(small()), medium(scene.addMedium()) {
    scene.setSky();
    scene.setSun(30, 40);
    scene.setCamera({0, 2, 0}, 0, 10);
    addVolume(voxels, extinction);
  }
  void addVolume(const std::array<uint32_t, 3>& voxels, float extinction) {
    size = voxels;
    volume = scene.addVolume(medium, voxels, boxTransform({-300, 50, -1500}, {600, 500, 800}),
                             extinction);
  }
  // Keeps the pipelines, which cost more than anything else here.
  void replaceVolume(const std::array<uint32_t, 3>& voxels, float extinction) {
    check(wlkDestroyVolume(scene.context, volume));
    addVolume(voxels, extinction);
  }
  void upload(uint32_t format, const void* data, uint64_t bytes) const {
    auto info = make<WlkVolumeUpload>();
    info.format = format;
    std::memcpy(info.extent, size.data(), sizeof info.extent);
    info.data = data;
    info.dataSize = bytes;
    check(wlkUploadVolume(scene.context, volume, &info));
  }
  void expectFinite() const {
    EXPECT_EQ(scene.render().badValues(), 0u);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
  HeadlessScene scene;
  WlkMedium medium{};
  std::array<uint32_t, 3> size{};
  WlkVolume volume{};
};

TEST(GarbageVolume, OfRandomBitsInAnyFormatIsFinite) {
  constexpr std::array<uint32_t, 3> SIZE{9, 7, 5};
  const VolumeScene s(SIZE, 10.0f);
  std::mt19937 random(2004);
  constexpr int ROUNDS = 67 / WELKIN_SPARSER;  // 201 volumes, fewer instrumented
  for (int round = 0; round < ROUNDS; ++round) {
    std::vector<uint32_t> bits(size_t{9} * 7 * 5);
    for (uint32_t& word : bits) {
      word = static_cast<uint32_t>(random());
    }
    s.upload(WLK_FORMAT_R32_FLOAT, bits.data(), bits.size() * 4);
    s.expectFinite();
    s.upload(WLK_FORMAT_R16_FLOAT, bits.data(), bits.size() * 2);
    s.expectFinite();
    s.upload(WLK_FORMAT_R8_UNORM, bits.data(), bits.size());
    s.expectFinite();
  }
}

TEST(GarbageVolume, OfRandomBitsInHalfFloatsIsFinite) {
  // The first upload decides the image's format: here 16 bits, into which floats are rounded.
  constexpr std::array<uint32_t, 3> SIZE{8, 8, 8};
  const VolumeScene s(SIZE, 10.0f);
  std::mt19937 random(2023);
  std::vector<uint32_t> bits(512);
  for (uint32_t& word : bits) {
    word = static_cast<uint32_t>(random());
  }
  s.upload(WLK_FORMAT_R16_FLOAT, bits.data(), bits.size() * 2);
  s.expectFinite();
  s.upload(WLK_FORMAT_R32_FLOAT, bits.data(), bits.size() * 4);
  s.expectFinite();
}

TEST(GarbageVolume, ValuesThatAreNoDensityCountAsZero) {
  constexpr std::array<uint32_t, 3> SIZE{2, 2, 2};
  const VolumeScene s(SIZE, 1.0f);
  const std::vector<float> zero(8, 0.0f);
  s.scene.upload(s.volume, SIZE, zero);
  const Image empty = s.scene.render();
  using F = std::numeric_limits<float>;
  for (const float strange :
       {F::quiet_NaN(), F::infinity(), -F::infinity(), -1.0f, -F::max(), -0.0f}) {
    s.scene.upload(s.volume, SIZE, std::vector<float>(8, strange));
    EXPECT_TRUE(s.scene.render() == empty) << strange;
    for (const WlkPassStats& pass : s.scene.passes()) {
      if (pass.pass == WLK_PASS_LIGHT_SLICES || pass.pass == WLK_PASS_EYE_SLICES) {
        EXPECT_EQ(pass.reason, uint32_t{WLK_REASON_ZERO_DENSITY}) << strange;
      }
    }
  }
  // What is too large is the largest: 65504.
  s.scene.upload(s.volume, SIZE, std::vector<float>(8, 65504.0f));
  const Image dense = s.scene.render();
  EXPECT_GT(relativeRms(dense, empty), 0.01);
  for (const float strange : {1e30f, F::max(), 65505.0f}) {
    s.scene.upload(s.volume, SIZE, std::vector<float>(8, strange));
    EXPECT_TRUE(s.scene.render() == dense) << strange;
  }
}

TEST(GarbageVolume, OneStrangeVoxelDoesNotSpread) {
  constexpr std::array<uint32_t, 3> SIZE{8, 8, 8};
  const VolumeScene s(SIZE, 0.01f);
  std::vector<float> values(512, 1.0f);
  values[300] = 0.0f;
  s.scene.upload(s.volume, SIZE, values);
  const Image clean = s.scene.render();
  values[300] = std::numeric_limits<float>::quiet_NaN();
  s.scene.upload(s.volume, SIZE, values);
  EXPECT_TRUE(s.scene.render() == clean);
}

TEST(VolumeShape, OneVoxelAndFlatAndLongOnesAreFinite) {
  VolumeScene s({1, 1, 1});
  for (const std::array<uint32_t, 3>& size : {std::array<uint32_t, 3>{1, 1, 1},
                                              {1, 5, 9},
                                              {9, 1, 5},
                                              {5, 9, 1},
                                              {1, 1, 64},
                                              {257, 1, 3}}) {
    SCOPED_TRACE(std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                 std::to_string(size[2]));
    s.replaceVolume(size, 0.01f);
    s.scene.upload(s.volume, size, std::vector<float>(size_t{size[0]} * size[1] * size[2], 1.0f));
    s.expectFinite();
    EXPECT_EQ(s.scene.passes().front().reason, uint32_t{WLK_REASON_NEEDED});
  }
}

TEST(VolumeShape, AnyOpticalDepthPerVoxelIsFinite) {
  constexpr std::array<uint32_t, 3> SIZE{8, 8, 8};
  // Voxels of 100 m along z: extinctions that make 1e-7 to 1e7 per voxel, 1e4 among them.
  VolumeScene s(SIZE);
  for (const float extinction : {1e-9f, 1e-4f, 1.0f, 100.0f, 1e6f}) {
    SCOPED_TRACE(extinction);
    s.replaceVolume(SIZE, extinction);
    std::vector<float> values;
    for (uint32_t i = 0; i < 512; ++i) {
      values.push_back((i + i / 8 + i / 64) % 2 == 0 ? 1.0f : 0.0f);
    }
    s.scene.upload(s.volume, SIZE, values);  // a checkerboard: the steepest field there is
    s.expectFinite();
    s.scene.upload(s.volume, SIZE, std::vector<float>(512, 1.0f));  // dense up to the faces
    s.expectFinite();
    s.scene.upload(s.volume, SIZE, std::vector<float>(512, 65504.0f));
    s.expectFinite();
  }
}

TEST(VolumeShape, AnyInvertibleTransformIsFinite) {
  constexpr std::array<uint32_t, 3> SIZE{4, 4, 4};
  const VolumeScene s(SIZE);
  s.scene.upload(s.volume, SIZE, std::vector<float>(64, 1.0f));
  const std::vector<std::array<double, 12>> transforms{
      {-600, 0, 0, 300, 0, 500, 0, 0, 0, 0, 800, -1500},       // mirrored
      {0, 0, 600, -300, 500, 0, 0, 0, 0, 800, 0, -1500},       // axes exchanged
      {1e-3, 0, 0, 0, 0, 1e-3, 0, 2, 0, 0, 1e-3, -1},          // a grain
      {1e9, 0, 0, -5e8, 0, 1e9, 0, -5e8, 0, 0, 1e9, -5e8},     // everything
      {1e9, 0, 0, -5e8, 0, 1e-3, 0, 2, 0, 0, 1e9, -5e8},       // a sheet through the eye
      {600, 550, 0, -300, 0, 500, 0, 50, 0, 490, 800, -1500},  // sheared
      {600, 0, 0, 1e9, 0, 500, 0, 1e9, 0, 0, 800, -1e9}};      // far away
  for (size_t i = 0; i < transforms.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(wlkSetVolumeTransform(s.scene.context, s.volume, transforms[i].data()), WLK_SUCCESS);
    for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
      auto quality = make<WlkQuality>();
      quality.level = WLK_QUALITY_LOW;
      quality.slicing = slicing;
      ASSERT_EQ(wlkSetQuality(s.scene.context, s.scene.view, &quality), WLK_SUCCESS);
      s.expectFinite();
    }
  }
}

}  // namespace
}  // namespace welkin::test
