// SPDX-License-Identifier: MIT
// WlkContextInfo::deviceMemoryLimit: what would exceed it is refused before the driver is asked,
// and nothing is lost; with the limit raised to what is used, everything fits.
#include "stress/abuse.hpp"
#include "support/engine_scene.hpp"
#include "support/fault_layer.hpp"

namespace welkin::test {
namespace {

constexpr uint64_t MIB = uint64_t{1} << 20;

class MemoryLimit : public ::testing::Test {
 protected:
  // A context with one medium whose device memory is limited.
  WlkContext makeContext(uint64_t limit) {
    auto device = describeDevice(spy);
    device.getInstanceProcAddr = FaultLayer::getInstanceProcAddr();
    auto info = make<WlkContextInfo>();
    info.next = &device;
    info.deviceMemoryLimit = limit;
    WlkContext context = nullptr;
    result = wlkCreateContext(WLK_API_VERSION, &info, &context);
    return context;
  }

  // A volume, and a voxel of it: memory is taken when there is something to keep.
  static WlkResult addVolume(WlkContext context, WlkMedium medium, uint32_t edge,
                             WlkVolume& volume) {
    WlkVolumeField field{};
    field.medium = medium;
    field.extinctionScale = 1e-3f;
    auto info = make<WlkVolumeInfo>();
    info.size[0] = info.size[1] = info.size[2] = edge;
    info.fieldCount = 1;
    info.fields = &field;
    const WlkResult made = wlkCreateVolume(context, &info, &volume);
    const float value = 1;
    auto upload = make<WlkVolumeUpload>();
    upload.extent[0] = upload.extent[1] = upload.extent[2] = 1;
    upload.data = &value;
    upload.dataSize = sizeof value;
    return made < 0 ? made : wlkUploadVolume(context, volume, &upload);
  }

  SpyDevice spy;
  WlkResult result = WLK_SUCCESS;
};

TEST_F(MemoryLimit, VolumesBeyondItAreRefusedBeforeTheDriverIsAsked) {
  WlkContext context = makeContext(48 * MIB);
  ASSERT_EQ(result, WLK_SUCCESS);
  const auto mediumInfo = make<WlkMediumInfo>();
  WlkMedium medium{};
  ASSERT_EQ(wlkCreateMedium(context, &mediumInfo, &medium), WLK_SUCCESS);
  WlkVolume small{};
  WlkVolume large{};
  WlkVolume other{};
  ASSERT_EQ(addVolume(context, medium, 64, small), WLK_SUCCESS);
  FaultLayer::failNever();
  EXPECT_FAILS(addVolume(context, medium, 512, large), WLK_ERROR_OUT_OF_DEVICE_MEMORY,
               "deviceMemoryLimit");
  EXPECT_EQ(lastError().vkResult, 0) << "the driver was asked";
  EXPECT_EQ(addVolume(context, medium, 64, other), WLK_SUCCESS) << "what fits still fits";
  wlkDestroyContext(context);
  EXPECT_TRUE(FaultLayer::live().empty());
}

TEST_F(MemoryLimit, ContextsBeyondItAreNotMade) {
  EXPECT_EQ(makeContext(1), nullptr);
  EXPECT_EQ(result, WLK_ERROR_OUT_OF_DEVICE_MEMORY);
  EXPECT_STREQ(lastError().field, "deviceMemoryLimit");
  EXPECT_TRUE(FaultLayer::live().empty());
}

TEST_F(MemoryLimit, MemoryThatIsFreedCountsNoMore) {
  WlkContext context = makeContext(96 * MIB);
  ASSERT_EQ(result, WLK_SUCCESS);
  const auto mediumInfo = make<WlkMediumInfo>();
  WlkMedium medium{};
  ASSERT_EQ(wlkCreateMedium(context, &mediumInfo, &medium), WLK_SUCCESS);
  for (int round = 0; round < 8; ++round) {
    WlkVolume volume{};
    ASSERT_EQ(addVolume(context, medium, 192, volume), WLK_SUCCESS) << round;  // 27 MiB of floats
    ASSERT_EQ(wlkDestroyVolume(context, volume), WLK_SUCCESS);
  }
  wlkDestroyContext(context);
}

TEST_F(MemoryLimit, NoneIsTheDefault) {
  EXPECT_EQ(make<WlkContextInfo>().deviceMemoryLimit, 0u);
  WlkContext context = makeContext(0);
  EXPECT_EQ(result, WLK_SUCCESS);
  wlkDestroyContext(context);
}

}  // namespace
}  // namespace welkin::test
