// SPDX-License-Identifier: MIT
// Cloud surfaces that meet themselves or have very many triangles, drawn: what they hide is known,
// their light is finite and not negative.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

// Metres of a ray that starts outside in a mesh, parts that lie in it several times counted as
// often, in parts turned inside out against it.
double chordThrough(const SurfaceArrays& mesh, const std::array<double, 3>& scale,
                    const std::array<double, 3>& middle, const glm::dvec3& eye,
                    const glm::dvec3& ray) {
  const auto corner = [&](size_t k) {
    glm::dvec3 p;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<size_t>(i);
      p[i] = static_cast<double>(mesh.positions[3 * mesh.indices[k] + axis]) * scale[axis] +
             middle[axis];
    }
    return p;
  };
  double chord = 0;
  for (size_t k = 0; k < mesh.indices.size(); k += 3) {
    const glm::dvec3 a = corner(k);
    const glm::dvec3 side = corner(k + 1) - a;
    const glm::dvec3 other = corner(k + 2) - a;
    const glm::dvec3 normal = glm::cross(side, other);
    const double facing = glm::dot(normal, ray);
    const glm::dvec3 at = glm::cross(eye - a, ray);
    const double u = glm::dot(other, at) / -facing;
    const double v = glm::dot(side, at) / facing;
    if (facing != 0 && u >= 0 && v >= 0 && u + v <= 1) {
      const double t = glm::dot(a - eye, normal) / facing;
      chord += facing > 0 ? t : -t;
    }
  }
  return chord;
}

class MeshThatMeetsItself : public ::testing::Test {
 protected:
  static constexpr float EXTINCTION = 1e-3f;
  static constexpr std::array<double, 3> SCALE{500, 500, 500};
  static constexpr std::array<double, 3> MIDDLE{0, 400, -2000};

  static SceneOptions separate() {
    SceneOptions options;
    options.composite = WLK_COMPOSITE_SEPARATE;
    options.validation = false;
    return options;
  }

  MeshThatMeetsItself() { scene.setSun(40, 60); }

  // Of a picture of `mesh` where its densities add; counts pixels where any ray crosses it, and
  // those where what is inside out outweighs the rest, which are empty.
  void expectSane(const SurfaceArrays& mesh, int& covered, int& turned) const {
    const glm::dvec3 eye(0, 2, 0);
    scene.setCamera({eye.x, eye.y, eye.z}, 0, 5);
    const Image light = scene.render();
    const Image passes = scene.read(WLK_IMAGE_TRANSMITTANCE);
    EXPECT_EQ(light.badValues(), 0u);
    EXPECT_EQ(passes.badValues(), 0u);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    EXPECT_GT(light.mean(), 0);
    const double c = std::cos(5 * 3.14159265358979 / 180);
    const double s = std::sin(5 * 3.14159265358979 / 180);
    for (uint32_t y = 0; y < passes.height; ++y) {
      for (uint32_t x = 0; x < passes.width; ++x) {
        const glm::dvec3 flat = pixelDirection(scene, x, y);
        const glm::dvec3 ray(flat.x, c * flat.y - s * flat.z, s * flat.y + c * flat.z);
        const double chord = chordThrough(mesh, SCALE, MIDDLE, eye, ray);
        covered += chord > 0 ? 1 : 0;
        turned += chord < -1 ? 1 : 0;
        // Steps of depth (2^-20 of the box's), four roundings for each of some ten crossings.
        constexpr double LENGTH = 0.1;
        EXPECT_NEAR(passes.at(x, y)[0],
                    std::exp(-static_cast<double>(EXTINCTION) * std::max(chord, 0.0)),
                    static_cast<double>(EXTINCTION) * LENGTH)
            << x << ' ' << y;
      }
    }
  }

  HeadlessScene scene{separate()};
};

// Two boxes, one in the other's corner: where both are, twice the density.
TEST_F(MeshThatMeetsItself, DensitiesAdd) {
  SurfaceArrays mesh(support::boxMesh());
  const SurfaceArrays other(support::boxMesh());
  for (size_t i = 0; i < other.positions.size(); ++i) {
    constexpr std::array<float, 3> ASIDE{0.7f, 0.55f, 0.4f};
    mesh.positions.push_back(0.8f * other.positions[i] + ASIDE[i % 3]);
  }
  for (const uint32_t index : other.indices) {
    mesh.indices.push_back(index + 8);
  }
  // Isotropic: there is no forward peak to take off.
  WlkSurfaceInfo info = mesh.info(scene.addHenyeyGreenstein(0), EXTINCTION);
  place(info, SCALE, MIDDLE);
  WlkSurface surface{};
  check(wlkCreateSurface(scene.context, &info, &surface));
  int covered = 0;
  int turned = 0;
  expectSane(mesh, covered, turned);
  EXPECT_GT(covered, 100);
  EXPECT_EQ(turned, 0);
}

// A ring whose vertices were thrown about: crossings in any order, parts inside out.
TEST_F(MeshThatMeetsItself, TangledByItsAnimation) {
  SurfaceArrays mesh(support::torusMesh());
  const WlkSurface surface = addSurface(scene, support::torusMesh(), scene.addHenyeyGreenstein(0),
                                        EXTINCTION, SCALE, MIDDLE);
  std::mt19937 random(7);
  int covered = 0;
  int turned = 0;
  for (const float far : {0.1f, 0.5f, 2.0f}) {
    for (float& x : mesh.positions) {
      x += far * (static_cast<float>(random()) * 0x1p-31f - 1);
    }
    check(wlkSetSurfacePositions(scene.context, surface, mesh.positions.data(),
                                 static_cast<uint32_t>(mesh.positions.size() / 3), 12));
    expectSane(mesh, covered, turned);
  }
  EXPECT_GT(covered, 300);
  EXPECT_GT(turned, 30);
}

// 2.25 million triangles, most far smaller than a pixel, of which 2^21 fill a row of workgroups:
// the picture of the coarser ring.
TEST(LargeSurface, IsThePictureOfACoarserOne) {
  SceneOptions options;
  options.composite = WLK_COMPOSITE_SEPARATE;
  options.validation = false;
  const HeadlessScene scene(options);
  scene.setSun(20, 30);
  const WlkMedium medium = scene.addMedium();
  std::array<Image, 2> passes;
  std::array<Image, 2> light;
  for (const uint32_t fine : {0u, 1u}) {
    const support::ClosedMesh ring = support::torusMesh(fine ? 1500 : 300, fine ? 750 : 150);
    const WlkSurface surface =
        addSurface(scene, ring, medium, 0.01f, {500, 500, 500}, {0, 400, -2000});
    light[fine] = scene.render();
    passes[fine] = scene.read(WLK_IMAGE_TRANSMITTANCE);
    EXPECT_EQ(light[fine].badValues() + passes[fine].badValues(), 0u);
    EXPECT_GT(light[fine].mean(), 0);
    check(wlkDestroySurface(scene.context, surface));
  }
  // Facets of 1 / 150 of a circle of 150 m lie 0.07 m under it; at its rim that is 9 m of a chord.
  EXPECT_LT(relativeRms(passes[0], passes[1]), 5e-3);
  EXPECT_LT(relativeRms(light[0], light[1]), 0.02);
}

}  // namespace
}  // namespace welkin::test
