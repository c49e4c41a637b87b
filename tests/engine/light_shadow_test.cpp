// SPDX-License-Identifier: MIT
// The engine's shadow map in every depth format and composite mode against the headless context.
#include "support/light_shadow.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "codec.hpp"
#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;
using welkin::check;
using welkin::make;
using welkin::test::LightFrame;

constexpr VkExtent2D EXTENT{61, 45};
constexpr VkExtent2D MAP{40, 24};
constexpr uint32_t CASCADES = 3;
constexpr const CameraCase& CAMERA = CAMERAS[0];
constexpr std::array FORMATS{VK_FORMAT_D32_SFLOAT,          VK_FORMAT_D16_UNORM,
                             VK_FORMAT_D24_UNORM_S8_UINT,   VK_FORMAT_D32_SFLOAT_S8_UINT,
                             VK_FORMAT_X8_D24_UNORM_PACK32, VK_FORMAT_R32_SFLOAT};

class EngineLightShadow : public testing::Test {
 protected:
  EngineLightShadow() : headless_(EXTENT.width, EXTENT.height, WLK_QUALITY_FLAG_LIGHT_SHADOWS) {
    const LightFrame frames[CASCADES]{{{30, 60, -60}, 150, TO_SUN},
                                      {{30, 80, -200}, 500, TO_SUN},
                                      {{0, 200, -800}, 4000, TO_SUN}};
    shadow_.cascadeCount = CASCADES;
    std::copy_n(camera_.position, 3, shadow_.origin);
    for (uint32_t i = 0; i < CASCADES; ++i) {
      frames[i].write({camera_.position[0], camera_.position[1], camera_.position[2]}, true,
                      shadow_.clipFromWorld[i]);
      // Bars of another direction and depth in each layer; nothing between them.
      for (uint32_t y = 0; y < MAP.height; ++y) {
        for (uint32_t x = 0; x < MAP.width; ++x) {
          const bool bar = ((i == 1 ? x : y) / 4 + i) % 2 == 0;
          map_.push_back(bar ? 0.55f + 0.1f * static_cast<float>(i) : 0.0f);
        }
      }
    }
  }

  Result render(uint32_t composite, VkFormat format, VkFormat shadowFormat, bool withMap = true) {
    const welkin::View view = engine_.makeView(EXTENT, composite, format);
    setQuality(engine_.context(), view, WLK_QUALITY_FLAG_LIGHT_SHADOWS);
    check(wlkPrepare(engine_.context()));
    Request request;
    request.view = view;
    request.extent = EXTENT;
    request.composite = composite;
    request.format = format;
    request.color = quantised(format, picture_.color);
    request.depth = picture_.depth(CAMERA);
    request.lightShadow = shadow_;
    request.shadowMap = withMap ? map_ : std::vector<float>();
    request.shadowExtent = MAP;
    request.shadowFormat = shadowFormat;
    return engine_.render(request, camera_);
  }

  std::vector<float> expected(VkFormat format, VkFormat shadowFormat) {
    const std::vector<float> map = quantised(shadowFormat, map_);
    auto targets = make<WlkHeadlessInputs>();
    targets.lightShadow = &shadow_;
    targets.shadowDepth = map.data();
    targets.shadowDepthSize = map.size() * sizeof(float);
    targets.shadowWidth = MAP.width;
    targets.shadowHeight = MAP.height;
    return headless_.render(camera_, quantised(format, picture_.color), picture_.depth(CAMERA),
                            &targets);
  }

  static constexpr welkin::test::Vec3 TO_SUN{0.48, 0.6, -0.64};
  const WlkCamera camera_ = cameraOf(CAMERA, EXTENT.width, EXTENT.height);
  const EnginePicture picture_ = makeEnginePicture(EXTENT.width, EXTENT.height, CAMERA);
  WlkLightShadow shadow_ = make<WlkLightShadow>();
  std::vector<float> map_;
  Headless headless_;
  Engine engine_;
};

TEST_F(EngineLightShadow, EveryDepthFormatEqualsHeadless) {
  constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;
  const std::vector<float> lit = render(WLK_COMPOSITE_COMPUTE, COLOR, FORMATS[0], false).output;
  int tested = 0;
  for (const VkFormat format : FORMATS) {
    if (!engine_.device().supports(format, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT)) {
      continue;
    }
    SCOPED_TRACE(format);
    ++tested;
    const Result result = render(WLK_COMPOSITE_COMPUTE, COLOR, format);
    expectClose(result.output, expected(COLOR, format), SAME_MODEL, "compute");
    double taken = 0;
    for (size_t i = 0; i < lit.size(); ++i) {
      taken = std::max(taken, double{lit[i]} - double{result.output[i]});
    }
    EXPECT_GT(taken, 0.05) << "nothing to see";
  }
  EXPECT_GE(tested, 3);
}

TEST_F(EngineLightShadow, EveryCompositeModeEqualsHeadless) {
  constexpr VkFormat COLOR = VK_FORMAT_R16G16B16A16_SFLOAT;
  const std::vector<float> truth = expected(COLOR, FORMATS[0]);
  const Result blended = render(WLK_COMPOSITE_BLEND, COLOR, FORMATS[0]);
  // As in format_test.cpp: radiance, transmittance, product and sum may each truncate.
  constexpr double roundings = 4.0 * 2.0;
  expectClose(blended.output, truth, roundingOf(COLOR) * roundings + SAME_MODEL, "blend");
  const Result apart = render(WLK_COMPOSITE_SEPARATE, COLOR, FORMATS[0]);
  std::vector<float> recombined(truth.size());
  const std::vector<float> color = quantised(COLOR, picture_.color);
  for (size_t i = 0; i < truth.size(); ++i) {
    recombined[i] = color[i] * apart.transmittance[i] + apart.radiance[i];
  }
  Tolerance tolerance = roundingOf(COLOR) + SAME_MODEL;
  tolerance.absolute *= 1.0 + 3.0;  // the largest colour multiplies the transmittance's step
  expectClose(recombined, truth, tolerance, "separate");
}

}  // namespace
