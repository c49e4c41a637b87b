// SPDX-License-Identifier: MIT
// Diameters of droplets per voxel: uploads that do not fit, media that have none, extreme values.
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

WlkVolumeUpload whole(const std::vector<float>& values) {
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = 4;
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  return upload;
}

TEST(DiameterAbuse, UploadsThatDoNotFitAreRefusedAndTheVolumeKept) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  const std::vector<float> values(64, 9.0f);
  const auto fails = [&](const char* field, WlkResult code,
                         const std::function<void(WlkVolumeUpload&)>& spoil) {
    WlkVolumeUpload upload = whole(values);
    spoil(upload);
    EXPECT_FAILS(wlkUploadVolumeDiameters(c, victim.volume, &upload), code, field);
  };
  using U = WlkVolumeUpload;
  constexpr WlkResult INVALID = WLK_ERROR_INVALID_ARGUMENT;
  fails("field", INVALID, [](U& u) { u.field = 1; });
  fails("format", WLK_ERROR_UNSUPPORTED_FORMAT, [](U& u) { u.format = WLK_FORMAT_R8_UNORM; });
  fails("format", WLK_ERROR_UNSUPPORTED_FORMAT, [](U& u) { u.format = 7; });
  fails("extent", INVALID, [](U& u) { u.extent[1] = 3; });
  fails("extent", INVALID, [](U& u) { u.offset[2] = 1; });
  fails("data", INVALID, [](U& u) { u.data = nullptr; });
  fails("dataSize", INVALID, [](U& u) { u.dataSize -= 1; });
  fails("rowPitch", INVALID, [](U& u) { u.rowPitch = 15; });
  const WlkVolumeUpload good = whole(values);
  EXPECT_FAILS(wlkUploadVolumeDiameters(c, {victim.volume.id + (1 << 24)}, &good),
               WLK_ERROR_INVALID_HANDLE, "volume");
  EXPECT_FAILS(wlkClearVolumeDiameters(c, {0}), WLK_ERROR_INVALID_HANDLE, "volume");
  victim.expectUnchanged();
}

TEST(DiameterAbuse, MediaWithoutDropletsAreRefused) {
  const HeadlessScene scene;
  const WlkContext c = scene.context;
  const WlkMedium none = scene.addHenyeyGreenstein(0.5f);
  const WlkVolume volume =
      scene.addVolume(none, {4, 4, 4}, boxTransform({0, 0, 0}, {1, 1, 1}), 0.0f);
  const std::vector<float> values(64, 9.0f);
  const WlkVolumeUpload good = whole(values);
  EXPECT_FAILS(wlkUploadVolumeDiameters(c, volume, &good), WLK_ERROR_INVALID_ARGUMENT, "medium");
  const float water = 1e-3f;
  float extinction = 0;
  EXPECT_FAILS(wlkEvalWaterExtinction(c, none, 1, &water, nullptr, &extinction),
               WLK_ERROR_INVALID_ARGUMENT, "medium");
}

TEST(WaterExtinction, IsCheckedAndFinite) {
  const CpuContext cpu;
  const auto info = make<WlkMediumInfo>();
  WlkMedium medium{};
  check(wlkCreateMedium(cpu.context, &info, &medium));
  const auto eval = [&](float water, const float* diameter) {
    float extinction = -1;
    EXPECT_EQ(wlkEvalWaterExtinction(cpu.context, medium, 1, &water, diameter, &extinction),
              WLK_SUCCESS);
    return static_cast<double>(extinction);
  };
  // 0.3 g/m^3 of 10 um effective radius: 1.5 W / (density r) = 0.045 / m.
  const float diameter = static_cast<float>(20 / std::exp(2.5 * 0.25 * 0.25));
  EXPECT_NEAR(eval(3e-4f, &diameter), 0.045, 0.05 * 0.045);
  const double own = eval(3e-4f, nullptr);
  for (const float none : {0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(eval(3e-4f, &none), own);
  }
  for (const float extreme : {1e-30f, 1e-3f, 1e30f}) {
    EXPECT_TRUE(std::isfinite(eval(1000, &extreme)));
  }
  EXPECT_EQ(eval(0, nullptr), 0);
  float water = -1;
  float out = 0;
  EXPECT_FAILS(wlkEvalWaterExtinction(cpu.context, medium, 1, &water, nullptr, &out),
               WLK_ERROR_INVALID_ARGUMENT, "waterContent");
  water = std::nanf("");
  EXPECT_FAILS(wlkEvalWaterExtinction(cpu.context, medium, 1, &water, nullptr, &out),
               WLK_ERROR_INVALID_ARGUMENT, "waterContent");
  EXPECT_FAILS(wlkEvalWaterExtinction(cpu.context, medium, 1, nullptr, nullptr, &out),
               WLK_ERROR_INVALID_ARGUMENT, "waterContent");
  water = 1;
  EXPECT_FAILS(wlkEvalWaterExtinction(cpu.context, medium, 1, &water, nullptr, nullptr),
               WLK_ERROR_INVALID_ARGUMENT, "extinction");
  EXPECT_EQ(wlkEvalWaterExtinction(cpu.context, medium, 0, nullptr, nullptr, nullptr), WLK_SUCCESS);
}

TEST(DiameterExtremes, AreFinite) {
  HeadlessScene scene;
  scene.setSun(20, 180);
  const WlkVolume volume = scene.addVolume(
      scene.addMedium(), {4, 4, 4}, boxTransform({-1000, -1000, -3000}, {2000, 2000, 2000}), 0.1f);
  scene.upload(volume, {4, 4, 4}, std::vector<float>(64, 65504.0f));
  std::vector<float> values(64);
  constexpr float INF = std::numeric_limits<float>::infinity();
  const std::array<float, 8> kinds{0.0f, -INF, INF, std::nanf(""), 1e-38f, 3e38f, 5.0f, 50.0f};
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = kinds[i * 5 % kinds.size()];
  }
  const WlkVolumeUpload upload = whole(values);
  check(wlkUploadVolumeDiameters(scene.context, volume, &upload));
  auto frame = make<WlkHeadlessInputs>();
  EXPECT_EQ(wlkRenderHeadless(scene.context, scene.view, &frame), WLK_ERROR_NOT_PREPARED);
  EXPECT_EQ(scene.render().badValues(), 0u);
  check(wlkClearVolumeDiameters(scene.context, volume));
  check(wlkUploadVolumeDiameters(scene.context, volume, &upload));
  check(wlkDestroyVolume(scene.context, volume));
  EXPECT_EQ(scene.render().badValues(), 0u) << "what was on its way went with the volume";
  EXPECT_TRUE(scene.messages().empty());
}

}  // namespace
}  // namespace welkin::test
