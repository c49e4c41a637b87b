// SPDX-License-Identifier: MIT
// wlkUploadVolume: boxes outside the volume, pitches that overflow, data that ends too early.
#include <sys/mman.h>
#include <unistd.h>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

// `size` readable bytes whose end is the end of a page that an unreadable one follows.
class FencedBytes {
 public:
  explicit FencedBytes(size_t size) : size_(size) {
    const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
    mapped_ = (size + page - 1) / page * page + page;
    base_ = static_cast<unsigned char*>(
        mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    mprotect(base_ + mapped_ - page, page, PROT_NONE);
    end_ = base_ + mapped_ - page;
  }
  ~FencedBytes() { munmap(base_, mapped_); }
  FencedBytes(const FencedBytes&) = delete;
  FencedBytes& operator=(const FencedBytes&) = delete;
  const void* data() const { return end_ - size_; }

 private:
  size_t size_;
  size_t mapped_ = 0;
  unsigned char* base_ = nullptr;
  unsigned char* end_ = nullptr;
};

// A box of 3 x 2 x 2 voxels inside the victim's 4^3, from data in 24-byte rows of 64-byte slices.
WlkVolumeUpload pitched(const void* data) {
  auto upload = make<WlkVolumeUpload>();
  upload.offset[0] = 1;
  upload.extent[0] = 3;
  upload.extent[1] = upload.extent[2] = 2;
  upload.rowPitch = 24;
  upload.slicePitch = 64;
  upload.data = data;
  upload.dataSize = 64 + 24 + 12;  // the last slice's last row need not be padded
  return upload;
}

TEST(Upload, RefusesBoxesPitchesAndDataThatDoNotFitAndKeepsTheVolume) {
  VictimScene& victim = VictimScene::get();
  const std::vector<float> values(256, 0.9f);
  struct Case {
    const char* field;
    WlkResult code;
    std::function<void(WlkVolumeUpload&)> spoil;
  };
  using U = WlkVolumeUpload;
  constexpr WlkResult INVALID = WLK_ERROR_INVALID_ARGUMENT;
  constexpr uint64_t HUGE_PITCH = uint64_t{1} << 63;
  constexpr uint32_t MOST = 0xffffffffu;
  const std::vector<Case> cases{
      {"field", INVALID, [](U& u) { u.field = 1; }},
      {"field", INVALID, [](U& u) { u.field = MOST; }},
      {"format", WLK_ERROR_UNSUPPORTED_FORMAT, [](U& u) { u.format = 0; }},
      {"format", WLK_ERROR_UNSUPPORTED_FORMAT, [](U& u) { u.format = 4; }},
      {"format", WLK_ERROR_UNSUPPORTED_FORMAT, [](U& u) { u.format = MOST; }},
      {"extent", INVALID, [](U& u) { u.extent[0] = 0; }},
      {"extent", INVALID, [](U& u) { u.extent[0] = 4; }},
      {"extent", INVALID, [](U& u) { u.extent[2] = 5; }},
      {"extent", INVALID, [](U& u) { u.offset[1] = 3; }},
      {"extent", INVALID, [](U& u) { u.offset[1] = 5; }},
      {"extent", INVALID, [](U& u) { u.offset[2] = MOST; }},
      {"extent", INVALID,
       [](U& u) {
         u.offset[2] = MOST - 1;
         u.extent[2] = 4;
       }},
      {"extent", INVALID,
       [](U& u) {
         u.extent[1] = MOST;
         u.offset[1] = 2;
       }},
      {"data", INVALID, [](U& u) { u.data = nullptr; }},
      {"dataSize", INVALID, [](U& u) { u.dataSize = 0; }},
      {"dataSize", INVALID, [](U& u) { u.dataSize -= 1; }},
      {"rowPitch", INVALID, [](U& u) { u.rowPitch = 11; }},
      {"slicePitch", INVALID, [](U& u) { u.slicePitch = 35; }},
      {"dataSize", INVALID, [](U& u) { u.slicePitch = uint64_t{1} << 40; }},
      {"slicePitch", INVALID, [](U& u) { u.rowPitch = ~uint64_t{0}; }},
      {"slicePitch", INVALID,
       [](U& u) {
         u.rowPitch = HUGE_PITCH;
         u.slicePitch = 0;
       }},
      {"slicePitch", INVALID, [](U& u) { u.slicePitch = ~uint64_t{0}; }},
      {"dataSize", INVALID, [](U& u) { u.slicePitch = HUGE_PITCH; }}};
  for (size_t i = 0; i < cases.size(); ++i) {
    WlkVolumeUpload upload = pitched(values.data());
    cases[i].spoil(upload);
    EXPECT_FAILS(wlkUploadVolume(victim.scene.context, victim.volume, &upload), cases[i].code,
                 cases[i].field)
        << "case " << i;
  }
  EXPECT_FAILS(wlkUploadVolume(victim.scene.context, victim.volume, nullptr), INVALID,
               "WlkVolumeUpload");
  victim.expectUnchanged();
}

TEST(Upload, ReadsExactlyTheBytesThatThePitchesReach) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  const FencedBytes bytes(64 + 24 + 12);
  const WlkVolumeUpload upload = pitched(bytes.data());
  EXPECT_EQ(wlkUploadVolume(c, victim.volume, &upload), WLK_SUCCESS);
  // Every format, tight, without an aligned byte: bytes right before the fence.
  for (const uint32_t format : {WLK_FORMAT_R32_FLOAT, WLK_FORMAT_R16_FLOAT, WLK_FORMAT_R8_UNORM}) {
    const uint32_t voxel = format == WLK_FORMAT_R32_FLOAT   ? 4
                           : format == WLK_FORMAT_R16_FLOAT ? 2
                                                            : 1;
    const FencedBytes tight(27 * voxel);
    auto whole = make<WlkVolumeUpload>();
    whole.format = format;
    whole.extent[0] = whole.extent[1] = whole.extent[2] = 3;
    whole.data = tight.data();
    whole.dataSize = 27 * voxel;
    EXPECT_EQ(wlkUploadVolume(c, victim.volume, &whole), WLK_SUCCESS);
  }
  victim.scene.upload(victim.volume, {4, 4, 4}, std::vector<float>(64, 0.5f));
  victim.expectUnchanged();
}

TEST(Upload, OfPartsEqualsTheUploadOfTheWhole) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  victim.scene.upload(victim.volume, {4, 4, 4}, std::vector<float>(64, 0.25f));
  ASSERT_EQ(wlkRenderHeadless(c, victim.scene.view, nullptr), WLK_SUCCESS);
  // Sixteen columns of the value the scene began with, in one frame, last one first.
  const std::array<float, 4> column{0.5f, 0.5f, 0.5f, 0.5f};
  for (uint32_t i = 16; i-- > 0;) {
    auto upload = make<WlkVolumeUpload>();
    upload.offset[0] = i % 4;
    upload.offset[1] = i / 4;
    upload.extent[0] = upload.extent[1] = 1;
    upload.extent[2] = 4;
    upload.data = column.data();
    upload.dataSize = sizeof column;
    ASSERT_EQ(wlkUploadVolume(c, victim.volume, &upload), WLK_SUCCESS);
  }
  victim.expectUnchanged();
}

}  // namespace
}  // namespace welkin::test
