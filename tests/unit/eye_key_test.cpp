// SPDX-License-Identifier: MIT
// Which text of the eye's march a volume gets.
#include <gtest/gtest.h>

#include <memory_resource>

#include "frame/resources.hpp"

namespace welkin {
namespace {

constexpr size_t DIAMETERS_CONSTANT = 15;  // constant_id in shaders/pass/volume_source.glsl

TEST(EyeKey, ReadsDiametersOnlyWhereAVolumeHasThem) {
  VolumeState volume(std::pmr::new_delete_resource());
  EyeVariant variant{};
  const SliceQuality quality{};
  for (uint32_t fields = 1; fields <= WLK_MAX_FIELDS; ++fields) {
    volume.fieldCount = fields;
    for (const bool grey : {false, true}) {
      volume.grey = grey;
      const uint32_t kind = volume.fieldKind();
      EXPECT_EQ(kind, fields | (grey ? VolumeState::GREY : 0U)) << "nothing else of its own";
      EXPECT_EQ(volume.tableLayers(), fields);
      for (const bool stored : {false, true}) {
        variant.stored = stored;
        const vk::PipelineKey without = eyeKey(variant, kind, quality);
        EXPECT_EQ(without.constants[DIAMETERS_CONSTANT], 0U);
        for (uint32_t field = 0; field < fields; ++field) {
          const uint32_t with = kind + VolumeState::VARYING * (1 + field);
          EXPECT_LT(with, FIELD_KINDS);
          vk::PipelineKey key = eyeKey(variant, with, quality);
          EXPECT_EQ(key.constants[DIAMETERS_CONSTANT], 1 + field);
          key.constants[DIAMETERS_CONSTANT] = 0;
          EXPECT_TRUE(key == without) << "no other difference";
          EXPECT_TRUE(lightKey({true, stored}, with) == lightKey({true, stored}, kind));
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin
