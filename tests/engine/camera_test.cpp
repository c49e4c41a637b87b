// SPDX-License-Identifier: MIT
// Depth formats and camera conventions, all derived from the matrix.
#include <gtest/gtest.h>

#include <cmath>

#include "codec.hpp"
#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;

constexpr VkExtent2D EXTENT{61, 45};
constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr double NEAR = 2.0;         // near plane of the cameras, m
constexpr double FARTHEST = 5000.0;  // surface in the picture, m

class EngineCamera : public testing::Test {
 protected:
  EngineCamera()
      : headless_(EXTENT.width, EXTENT.height),
        view_(engine_.makeView(EXTENT, WLK_COMPOSITE_COMPUTE, COLOR)) {}

  std::vector<float> render(const CameraCase& camera, VkFormat depthFormat) {
    const EnginePicture picture = makeEnginePicture(EXTENT.width, EXTENT.height, camera);
    Request request;
    request.view = view_;
    request.extent = EXTENT;
    request.format = COLOR;
    request.depthFormat = depthFormat;
    request.color = picture.color;
    request.depth = picture.depth(camera);
    return engine_.render(request, cameraOf(camera, EXTENT.width, EXTENT.height)).output;
  }

  // Headless takes the depths that the format keeps.
  std::vector<float> expected(const CameraCase& camera, VkFormat depthFormat) {
    const EnginePicture picture = makeEnginePicture(EXTENT.width, EXTENT.height, camera);
    return headless_.render(cameraOf(camera, EXTENT.width, EXTENT.height), picture.color,
                            quantised(depthFormat, picture.depth(camera)));
  }

  Engine engine_;
  Headless headless_;
  welkin::View view_;
};

TEST_F(EngineCamera, EveryDepthFormatEqualsHeadlessInEveryConvention) {
  // The texture unit converts 16- and 24-bit depths in its own way: the codec, the unit's constant
  // and its product round once each, and a rounding of d near 1 moves a surface at distance z by
  // 2^-24 z / near of z. Radiance changes at most in proportion to z: air and fog are thin.
  constexpr double roundings = 3.0;
  constexpr double relative = roundings * 0x1p-24 * FARTHEST / NEAR;
  constexpr Tolerance conversion{{relative, relative, relative}, 1e-7};
  constexpr std::array formats{VK_FORMAT_D32_SFLOAT,          VK_FORMAT_D16_UNORM,
                               VK_FORMAT_D24_UNORM_S8_UINT,   VK_FORMAT_D32_SFLOAT_S8_UINT,
                               VK_FORMAT_X8_D24_UNORM_PACK32, VK_FORMAT_R32_SFLOAT};
  int tested = 0;
  for (const VkFormat format : formats) {
    if (!engine_.device().supports(format, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT)) {
      continue;
    }
    const bool isFloat = format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_R32_SFLOAT ||
                         format == VK_FORMAT_D32_SFLOAT_S8_UINT;
    for (const CameraCase& camera : CAMERAS) {
      SCOPED_TRACE(camera.name);
      SCOPED_TRACE(format);
      const std::vector<float> wanted = expected(camera, format);
      expectStructure(wanted);
      expectClose(render(camera, format), wanted, isFloat ? SAME_SHADER : conversion, "picture");
      ++tested;
    }
  }
  // D32F, D16 and R32F are mandatory in Vulkan, and one of the two with stencil.
  EXPECT_GE(tested, 4 * static_cast<int>(CAMERAS.size()));
}

TEST_F(EngineCamera, ConventionsAgreeWithinTheDepthBuffersPrecision) {
  const std::vector<float> reference = render(CAMERAS[0], VK_FORMAT_D32_SFLOAT);
  // A float's rounding of a standard depth near 1 moves a surface by 2^-24 z / near of its distance
  // z: once in the depth, once in each of the two terms that the inverse matrix subtracts, and once
  // in their difference. Radiance changes at most in proportion to z: air and fog are thin.
  constexpr double roundings = 4.0;
  constexpr double relative = roundings * 0x1p-24 * FARTHEST / NEAR;
  constexpr Tolerance precision{{relative, relative, relative}, 1e-6};
  for (const CameraCase& camera : CAMERAS) {
    SCOPED_TRACE(camera.name);
    const std::vector<float> picture = render(camera, VK_FORMAT_D32_SFLOAT);
    expectClose(turned(picture, EXTENT.width, camera), reference, precision, "picture");
    if (camera.flipY || camera.mirrorX) {
      EXPECT_NE(picture, reference) << "the camera does not turn the picture";
    }
  }
}

TEST_F(EngineCamera, PreExposureScalesWhatWelkinAddsAndNothingElse) {
  const CameraCase& camera = CAMERAS[0];
  const EnginePicture picture = makeEnginePicture(EXTENT.width, EXTENT.height, camera);
  Request request;
  request.view = view_;
  request.extent = EXTENT;
  request.depth = picture.depth(camera);
  WlkCamera value = cameraOf(camera, EXTENT.width, EXTENT.height);
  request.color.assign(picture.color.size(), 0.0f);
  const std::vector<float> one = engine_.render(request, value).output;
  value.preExposure = 0.25f;  // a power of two: exact
  const std::vector<float> quarter = engine_.render(request, value).output;
  ASSERT_EQ(one.size(), quarter.size());
  for (size_t i = 0; i < one.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_EQ(quarter[i], 0.25f * one[i]) << i;
    }
  }
}

}  // namespace
