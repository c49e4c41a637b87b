// SPDX-License-Identifier: MIT
// The three composite modes on the engine's images against the headless context.
#include <gtest/gtest.h>

#include "codec.hpp"
#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;

constexpr VkExtent2D EXTENT{61, 45};  // no multiple of a work group
constexpr std::array FORMATS{VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
                             VK_FORMAT_B10G11R11_UFLOAT_PACK32};
constexpr const CameraCase& CAMERA = CAMERAS[0];

// The engine's picture in a format, and the headless context's answer to what the format keeps.
struct Case {
  VkFormat format;
  std::vector<float> color;
  std::vector<float> depth;
  std::vector<float> expected;
};

class EngineFormats : public testing::Test {
 protected:
  EngineFormats() : headless_(EXTENT.width, EXTENT.height) {}

  Case makeCase(VkFormat format) {
    const EnginePicture picture = makeEnginePicture(EXTENT.width, EXTENT.height, CAMERA);
    Case result{format, quantised(format, picture.color), picture.depth(CAMERA), {}};
    result.expected = headless_.render(camera_, result.color, result.depth);
    expectStructure(result.expected);
    return result;
  }

  Result render(const Case& c, uint32_t composite, bool inPlace = true) {
    const welkin::View view = engine_.makeView(EXTENT, composite, c.format);
    Request request;
    request.view = view;
    request.extent = EXTENT;
    request.composite = composite;
    request.format = c.format;
    request.inPlace = inPlace;
    request.color = c.color;
    request.depth = c.depth;
    return engine_.render(request, camera_);
  }

  bool supported(VkFormat format, VkFormatFeatureFlags features) {
    return engine_.device().supports(format, features | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT);
  }

  const WlkCamera camera_ = cameraOf(CAMERA, EXTENT.width, EXTENT.height);
  Headless headless_;
  Engine engine_;
};

// Vulkan lets an image store truncate or round small floats: up to two half units. Welkin rounds to
// half itself, so there one half unit is left.
Tolerance storing(VkFormat format) {
  return roundingOf(format) * (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32 ? 2.0 : 1.0) +
         SAME_SHADER;
}

TEST_F(EngineFormats, ComputeEqualsHeadlessWithinTheFormatsRounding) {
  for (const VkFormat format : FORMATS) {
    if (!supported(format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
      continue;
    }
    SCOPED_TRACE(format);
    const Case c = makeCase(format);
    const Result result = render(c, WLK_COMPOSITE_COMPUTE, false);
    expectClose(result.output, c.expected, storing(format), "compute");
    expectSameAlpha(result.output, c.color);
    EXPECT_EQ(result.color, c.color) << "the input changed";
    EXPECT_EQ(result.depth, c.depth) << "the depth buffer changed";
  }
}

TEST_F(EngineFormats, ComputeInPlaceEqualsComputeIntoAnotherImage) {
  for (const VkFormat format : FORMATS) {
    if (!supported(format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
      continue;
    }
    SCOPED_TRACE(format);
    const Case c = makeCase(format);
    const Result apart = render(c, WLK_COMPOSITE_COMPUTE, false);
    const Result inPlace = render(c, WLK_COMPOSITE_COMPUTE, true);
    EXPECT_EQ(inPlace.output, apart.output);
    EXPECT_NE(inPlace.output, c.color);
  }
}

TEST_F(EngineFormats, BlendEqualsHeadlessWithinTheFormatsRounding) {
  for (const VkFormat format : FORMATS) {
    if (!supported(format, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT)) {
      continue;
    }
    SCOPED_TRACE(format);
    const Case c = makeCase(format);
    const Result result = render(c, WLK_COMPOSITE_BLEND);
    // Vulkan may blend in the format's precision: radiance, transmittance, product and sum round,
    // and each may truncate (2 half units). All terms are positive, so relative errors add.
    constexpr double roundings = 4.0 * 2.0;
    expectClose(result.output, c.expected, roundingOf(format) * roundings + SAME_MODEL, "blend");
    expectSameAlpha(result.output, c.color);
    EXPECT_EQ(result.depth, c.depth) << "the depth buffer changed";
  }
}

TEST_F(EngineFormats, SeparateRecombinedEqualsHeadlessWithinTheFormatsRounding) {
  for (const VkFormat format : FORMATS) {
    if (!supported(format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
      continue;
    }
    SCOPED_TRACE(format);
    const Case c = makeCase(format);
    const Result result = render(c, WLK_COMPOSITE_SEPARATE);
    std::vector<float> recombined(c.color.size());
    for (size_t i = 0; i < recombined.size(); ++i) {
      recombined[i] = c.color[i] * result.transmittance[i] + result.radiance[i];
    }
    // Both terms are positive and round once: the sum's relative error is no larger. The largest
    // colour (3) multiplies the transmittance's subnormal step.
    Tolerance tolerance = storing(format);
    tolerance.absolute *= 1.0 + 3.0;
    expectClose(recombined, c.expected, tolerance, "separate");
    for (size_t i = 0; i < result.transmittance.size(); ++i) {
      ASSERT_GE(result.transmittance[i], 0.0f);
      ASSERT_LE(result.transmittance[i], 1.0f);
    }
    EXPECT_EQ(result.color, c.color) << "the engine's picture changed";
  }
}

TEST_F(EngineFormats, PictureWithoutDepthIsAllSky) {
  Case c = makeCase(VK_FORMAT_R32G32B32A32_SFLOAT);
  c.depth.clear();
  const std::vector<float> expected = headless_.render(camera_, c.color, {});
  const Result result = render(c, WLK_COMPOSITE_COMPUTE);
  expectClose(result.output, expected, SAME_SHADER, "without depth");
}

}  // namespace
