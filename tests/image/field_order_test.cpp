// SPDX-License-Identifier: MIT
// What a picture of fields may not depend on: whether their contents came before or after
// wlkPrepare, what they held before, and in which format the first of them came.
#include <gtest/gtest.h>

#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

constexpr std::array<uint32_t, 3> SIZE{8, 8, 8};
constexpr std::array<double, 3> CORNER{-1000, 500, -6000};
constexpr std::array<double, 3> EDGES{2000, 2000, 2000};

SceneOptions withAllLight() {
  SceneOptions options;
  options.scattering = WLK_SCATTERING_ALL_ORDERS;
  options.ambient = true;
  return options;
}

// Dust that scatters all ways and droplets that scatter forwards in one volume.
struct TwoFields {
  TwoFields() : scene(withAllLight()) {
    scene.setSky();
    scene.setSun(30, 20);
    const std::array<WlkMedium, 2> media{scene.addHenyeyGreenstein(0), scene.addMedium()};
    std::array<WlkVolumeField, 2> fields{};
    for (size_t i = 0; i < fields.size(); ++i) {
      fields[i].medium = media[i];
      fields[i].extinctionScale = 0.01f;
    }
    auto info = make<WlkVolumeInfo>();
    info.fieldCount = 2;
    info.fields = fields.data();
    const std::array<double, 12> box = boxTransform(CORNER, EDGES);
    std::copy(SIZE.begin(), SIZE.end(), info.size);
    std::copy(box.begin(), box.end(), info.worldFromVolume);
    check(wlkCreateVolume(scene.context, &info, &volume));
  }
  ~TwoFields() {
    for (const std::string& message : scene.messages()) {
      ADD_FAILURE() << message;
    }
  }

  void fill(float dust, float droplets) const {
    scene.upload(volume, SIZE, std::vector<float>(512, dust), 0);
    scene.upload(volume, SIZE, std::vector<float>(512, droplets), 1);
  }
  Image renderUnprepared() const {
    check(wlkRenderHeadless(scene.context, scene.view, nullptr));
    return scene.read(WLK_IMAGE_COLOR);
  }

  HeadlessScene scene;
  WlkVolume volume{};
};

// By contents that came before all else.
Image truth(float dust, float droplets) {
  const TwoFields s;
  s.fill(dust, droplets);
  return s.scene.render();
}

TEST(FieldOrder, ContentsAfterPrepareAreThoseBeforeIt) {
  const Image before = truth(1, 0);
  EXPECT_GT(before.mean(), 0);
  EXPECT_GT(relativeRms(truth(0, 1), before), 0.02) << "the fields look alike";
  const TwoFields again;
  check(wlkPrepare(again.scene.context));
  again.fill(1, 0);
  EXPECT_TRUE(again.scene.render() == before) << "with a second wlkPrepare";
  const TwoFields once;
  check(wlkPrepare(once.scene.context));
  once.fill(1, 0);
  EXPECT_TRUE(once.renderUnprepared() == before) << "without one";
}

// While frames run: dust first, then droplets alone, then a little more of both.
TEST(FieldOrder, ContentsThatChangeLookAsIfTheyHadAlwaysBeenThere) {
  const TwoFields s;
  s.fill(1, 0);
  s.scene.render();
  s.fill(0, 1);
  EXPECT_TRUE(s.renderUnprepared() == truth(0, 1));
  s.fill(0.02f, 1);
  const Image mixed = truth(0.02f, 1);
  // A share that moves by less than 0.05 waits for wlkPrepare; by 0.02 it cost 0.053.
  EXPECT_LT(relativeRms(s.renderUnprepared(), mixed), 0.07);
  EXPECT_TRUE(s.scene.render() == mixed);
}

// A half float's last step is 6e-8.
TEST(FieldOrder, FloatsStayFloatsAfterBytes) {
  std::array<Image, 2> images;
  for (const bool bytesFirst : {false, true}) {
    const HeadlessScene scene(withAllLight());
    scene.setSun(30, 20);
    const WlkVolume volume =
        scene.addVolume(scene.addMedium(), SIZE, boxTransform(CORNER, EDGES), 1e6f);
    if (bytesFirst) {
      const std::vector<uint8_t> bytes(512, 1);
      auto upload = make<WlkVolumeUpload>();
      upload.format = WLK_FORMAT_R8_UNORM;
      std::copy(SIZE.begin(), SIZE.end(), upload.extent);
      upload.data = bytes.data();
      upload.dataSize = bytes.size();
      check(wlkUploadVolume(scene.context, volume, &upload));
      scene.render();
    }
    scene.upload(volume, SIZE, std::vector<float>(512, 1e-8f));
    images[bytesFirst ? 1 : 0] = scene.render();
    EXPECT_TRUE(scene.messages().empty());
  }
  EXPECT_GT(images[0].mean(), 0);
  EXPECT_TRUE(images[1] == images[0]);
}

}  // namespace
}  // namespace welkin::test
