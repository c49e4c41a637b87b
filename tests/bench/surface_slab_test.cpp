// SPDX-License-Identifier: MIT
// The shipped scene of a slab, samples/scenes/surface-slab.json, without its sky: what its camera
// sees in the middle against discrete ordinates of the scene's own droplets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/apply.hpp"
#include "reference/slab_solver.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr double RADIANS = std::numbers::pi / 180;

// Green of the medium's phase function.
rt::SlabPhase phaseOf(WlkContext context, WlkMedium medium) {
  std::vector<double> angle;
  for (int i = 0; i <= 3600; ++i) {
    angle.push_back(i * std::numbers::pi / 3600);
  }
  std::vector<double> rgb(3 * angle.size());
  auto query = host::make<WlkPhaseQuery>();
  query.medium = medium;
  query.count = static_cast<uint32_t>(angle.size());
  query.scatteringAngle = angle.data();
  host::check(wlkEvalPhase(context, &query, rgb.data()), "wlkEvalPhase");
  std::vector<double> value;
  for (size_t i = 0; i < angle.size(); ++i) {
    value.push_back(rgb[3 * i + 1]);
  }
  return rt::tabulatedSlabPhase(angle, value, 700);
}

TEST(SurfaceSlabScene, MiddleIsTheSlabOfItsDroplets) {
  const std::string file = WELKIN_SCENES "/surface-slab.json";
  host::Scene scene = host::parseScene(
      host::readSceneJson(file, {"view.size=[4, 4]", "camera.verticalFov_deg=0.3"}), file);
  scene.sky.reset();
  scene.ambient.mode = WLK_AMBIENT_OFF;
  scene.view.layers = WLK_LAYER_SURFACES;
  host::LogCounter log;
  const host::ContextPtr context = host::makeHeadlessContext(false, "", log);
  host::applyWorld(context.get(), scene);
  host::applyBodies(context.get(), scene, [](const std::string&) {});
  const WlkView view = host::applyView(context.get(), scene);
  host::check(wlkPrepare(context.get()), "wlkPrepare");
  host::check(wlkRenderHeadless(context.get(), view, nullptr), "wlkRenderHeadless");
  std::vector<float> rgba(size_t{4} * 4 * 4);
  auto data = host::make<WlkImageData>();
  data.data = rgba.data();
  data.dataSize = rgba.size() * sizeof(float);
  host::check(wlkReadback(context.get(), view, &data), "wlkReadback");
  double found = 0;
  for (size_t pixel = 0; pixel < 16; ++pixel) {
    found += double{rgba[4 * pixel + 1]} / 16;
  }

  ASSERT_EQ(scene.surfaces.size(), 1u);
  const host::SurfaceDesc& slab = scene.surfaces[0];
  WlkMedium medium{};
  const WlkMediumInfo info = host::mediumInfo(scene.media[slab.medium]);
  host::check(wlkCreateMedium(context.get(), &info, &medium), "wlkCreateMedium");
  const double tau = slab.extinction * std::get<host::BoxMesh>(slab.shape).extent.y;
  const rt::SlabSolver solver(phaseOf(context.get(), medium), 1, 48);
  const float* sun = scene.lights.at(0).direction;
  const host::Vec3 toEye = scene.camera.forward * -1.0;
  const double azimuth = std::atan2(toEye.z, toEye.x) -
                         std::atan2(-static_cast<double>(sun[2]), -static_cast<double>(sun[0]));
  const rt::SlabRadiance truth =
      solver.radiance(tau, static_cast<double>(sun[1]), {toEye.y, azimuth, 0});
  const double expected = truth.total * static_cast<double>(scene.lights[0].irradiance[1]);
  std::printf("depth %.2f, sun %.3f, view %.3f, azimuth %.1f: %.4f of the truth\n", tau,
              static_cast<double>(sun[1]), toEye.y, azimuth / RADIANS, found / expected);
  // The rule has slabs of the canonical cloud of equal (1 - g) depth for all droplets.
  // Measured 0.054, and a fifth more.
  EXPECT_NEAR(found / expected, 1, 0.065);
}

}  // namespace
}  // namespace bench
