// SPDX-License-Identifier: MIT
// shaders/pass/surface_cover.glsl on the device: what triangle.glsl says of each pixel on the CPU,
// with boxes around triangles and atomic sums in place of loops over everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "model/model.hpp"
#include "support/closed_meshes.hpp"
#include "support/compute_runner.hpp"
#include "surface_cover_spv.h"

namespace {

namespace f32 = welkin::model::f32;
using f32::vec3;
using f32::vec4;
using support::ClosedMesh;
using uvec4 = glm::uvec4;
using ivec4 = glm::ivec4;
using uint = uint32_t;
#include "interface/surface.glsl"

constexpr int WIDTH = 57;
constexpr int HEIGHT = 43;
constexpr float MOST = 1 << 24;  // steps

// A parallel picture along z of [-1.2, 1.2]^2; or from z = -3, -1.5 or inside, with 53 degrees.
SurfaceUniforms uniformsOf(bool parallel, float eye) {
  SurfaceUniforms u{};
  const float scale = parallel ? HEIGHT / 2.4f : HEIGHT;
  if (parallel) {
    u.pixelX = {scale, 0, 0, WIDTH / 2.0f};
    u.pixelY = {0, scale, 0, HEIGHT / 2.0f};
    u.pixelW = {0, 0, 0, 1};
  } else {
    u.pixelX = {scale, 0, WIDTH / 2.0f, -eye * WIDTH / 2.0f};
    u.pixelY = {0, scale, HEIGHT / 2.0f, -eye * HEIGHT / 2.0f};
    u.pixelW = {0, 0, 1, -eye};
  }
  u.depth = {0.01f, 0.02f, 1, parallel ? 2 : -eye};  // not quite the axis
  u.steps = {0, MOST / 8, MOST, parallel ? -1e30f : 0.0f};
  u.rect = {0, 0, WIDTH, HEIGHT};
  return u;
}

struct Covered {
  SurfaceCover cover{};
  uint32_t passed = 0;  // how often a ray leaves less how often it enters
};

float along(const vec4& row, const vec3& p) {
  return row.x * p.x + row.y * p.y + row.z * p.z + row.w;
}

std::vector<Covered> onCpu(const ClosedMesh& mesh, const SurfaceUniforms& u) {
  std::vector<Covered> cover(size_t{WIDTH} * HEIGHT);
  for (const auto& t : mesh.triangle) {
    vec3 corner[3];
    vec3 depths(0.0f);
    for (int i = 0; i < 3; ++i) {
      const vec3 p(mesh.position[t[static_cast<size_t>(i)]]);
      corner[i] = {along(u.pixelX, p), along(u.pixelY, p), along(u.pixelW, p)};
      depths[i] = along(u.depth, p);
    }
    for (int y = 0; y < HEIGHT; ++y) {
      for (int x = 0; x < WIDTH; ++x) {
        const f32::SurfaceCrossing hit =
            f32::surfaceCrossing(corner[0], corner[1], corner[2], depths,
                                 {static_cast<float>(x), static_cast<float>(y)});
        if (hit.facing == 0.0f || !(hit.depth > u.steps.w)) {
          continue;
        }
        const auto step = static_cast<int>(
            std::clamp((hit.depth - u.steps.x) * u.steps.y, 0.0f, u.steps.z) + 0.5f);
        Covered& pixel = cover[static_cast<size_t>(y * WIDTH + x)];
        SurfaceCover& c = pixel.cover;
        if (hit.facing > 0.0f) {
          c.front = std::max(c.front, ~static_cast<uint32_t>(step));
        } else {
          c.leave = std::max(c.leave, ~static_cast<uint32_t>(step));
          c.back = std::max(c.back, static_cast<uint32_t>(step));
        }
        c.chord -= static_cast<int>(hit.facing) * step;
        pixel.passed -= static_cast<uint32_t>(static_cast<int>(hit.facing));
      }
    }
  }
  return cover;
}

// Of words as surface_cross.glsl counts them.
SurfaceCover coverOf(const std::array<uint32_t, SURFACE_COVER_WORDS>& row) {
  SurfaceCover cover{row[SURFACE_FRONT], row[SURFACE_LEAVE], row[SURFACE_FARTHEST],
                     static_cast<int>(row[SURFACE_REST])};
  if (cover.front != 0) {
    cover.chord -= static_cast<int>(~cover.front);
  }
  if (cover.leave != 0) {
    cover.chord += static_cast<int>(~cover.leave);
    cover.back = std::max(cover.back, ~cover.leave);
  }
  return cover;
}

// `large`: triangles of many pixels by themselves; `strips`: how many more than those.
std::vector<Covered> onDevice(support::ComputeRunner& runner, const ClosedMesh& mesh,
                              SurfaceUniforms u, bool large = true, uint32_t* strips = nullptr) {
  const auto triangles = static_cast<uint32_t>(mesh.triangle.size());
  constexpr uint32_t STRIPS = 1u << SURFACE_STRIPS;  // at most, in pictures so small
  const auto pixels = static_cast<size_t>((u.rect.z - u.rect.x) * (u.rect.w - u.rect.y));
  u.triangle = {triangles, 0, 0, large ? 1 : 0};
  std::vector<float> input(sizeof u / sizeof(float));
  std::memcpy(input.data(), &u, sizeof u);
  for (const glm::dvec3& p : mesh.position) {
    input.insert(input.end(),
                 {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  for (const auto& t : mesh.triangle) {
    for (const uint32_t index : t) {
      input.push_back(std::bit_cast<float>(index));
    }
  }
  const std::vector<float> output = runner.run(
      surface_cover_spv, static_cast<int>(mesh.position.size()), input,
      pixels * (SURFACE_COVER_WORDS + 1) + 1,
      (triangles + SURFACE_LANES - 1) / SURFACE_LANES + (large ? STRIPS * triangles : 0));
  std::vector<Covered> cover(pixels);
  for (size_t i = 0; i < cover.size(); ++i) {
    std::array<uint32_t, SURFACE_COVER_WORDS> row{};
    std::memcpy(row.data(), &output[i * SURFACE_COVER_WORDS], sizeof row);
    cover[i].cover = coverOf(row);
    cover[i].passed = std::bit_cast<uint32_t>(output[cover.size() * SURFACE_COVER_WORDS + i]);
  }
  if (strips != nullptr) {
    *strips = std::bit_cast<uint32_t>(output.back());
  }
  return cover;
}

// Seen from its side, so that rays enter twice; and with the last triangle first.
ClosedMesh aside(ClosedMesh mesh) {
  for (glm::dvec3& p : mesh.position) {
    p = {p.z, p.x, p.y};
  }
  return mesh;
}

ClosedMesh backwards(ClosedMesh mesh) {
  std::reverse(mesh.triangle.begin(), mesh.triangle.end());
  return mesh;
}

TEST(SurfaceCover, DeviceCoversAsTheModelTextSays) {
  // Depths up to 5 of 8 roundings, in steps of 8 / 2^24; near an edge seen at a slant of up to
  // 1:300 (53 degrees, a vertex on the sphere) places differ by as much more.
  constexpr int STEPS = 8 * 300;
  support::ComputeRunner runner;
  struct Case {
    bool parallel;
    float eye;
    int net;
  };
  for (const ClosedMesh& mesh :
       {support::boxMesh(), support::sphereMesh(3), support::torusMesh(),
        aside(support::torusMesh()), backwards(aside(support::torusMesh()))}) {
    for (const Case& c : {Case{true, 0, 0}, Case{false, -3, 0}, Case{false, -1.5f, 0}}) {
      const SurfaceUniforms u = uniformsOf(c.parallel, c.eye);
      const std::vector<Covered> expected = onCpu(mesh, u);
      const std::vector<Covered> found = onDevice(runner, mesh, u);
      int covered = 0;
      int moved = 0;
      for (size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(static_cast<int>(found[i].passed), c.net) << i;
        covered += found[i].cover.back > 0 ? 1 : 0;
        // A pixel on a silhouette may fall to either side.
        moved += (found[i].cover.back > 0) != (expected[i].cover.back > 0) ? 1 : 0;
        if (found[i].cover.back > 0 && expected[i].cover.back > 0) {
          EXPECT_NEAR(found[i].cover.chord, expected[i].cover.chord, 4 * STEPS) << i;
          EXPECT_NEAR(static_cast<double>(found[i].cover.back),
                      static_cast<double>(expected[i].cover.back), STEPS);
          EXPECT_NEAR(static_cast<double>(~found[i].cover.leave),
                      static_cast<double>(~expected[i].cover.leave), STEPS);
          EXPECT_NEAR(static_cast<double>(~found[i].cover.front),
                      static_cast<double>(~expected[i].cover.front), STEPS);
        }
      }
      EXPECT_GT(covered, WIDTH * HEIGHT / 10);
      EXPECT_LE(moved, 2);
    }
  }
  for (const std::string& message : runner.messages()) {
    ADD_FAILURE() << message;
  }
}

// Whether large triangles have workgroups of their own is all one, and so is how many.
TEST(SurfaceCover, LargeTrianglesAreTheSameByThemselves) {
  // Pictures of 156864 pixels: more than a strip has.
  constexpr int SCALE = 8;
  support::ComputeRunner runner;
  for (const ClosedMesh& mesh :
       {support::boxMesh(), support::sphereMesh(1), support::needleMesh(12)}) {
    uint32_t most = 0;
    for (const float eye : {-1.5f, 0.3f}) {
      SurfaceUniforms u = uniformsOf(false, eye);
      u.pixelX *= float{SCALE};
      u.pixelY *= float{SCALE};
      u.rect *= SCALE;
      const std::vector<Covered> together = onDevice(runner, mesh, u, false);
      uint32_t strips = 0;
      const std::vector<Covered> apart = onDevice(runner, mesh, u, true, &strips);
      most = std::max(most, strips);
      ASSERT_EQ(std::memcmp(together.data(), apart.data(), apart.size() * sizeof(Covered)), 0);
      ASSERT_TRUE(std::any_of(apart.begin(), apart.end(),
                              [](const Covered& pixel) { return pixel.cover.back > 0; }));
    }
    EXPECT_GT(most, 0u);
  }
}

// The same picture as a part of one of 16384 pixels, in which places are known to 4e-3 of a pixel.
TEST(SurfaceCover, FarFromTheFirstPixelNoCrossingIsLost) {
  constexpr int FAR = 16384 - 64;
  support::ComputeRunner runner;
  for (const ClosedMesh& mesh :
       {support::boxMesh(), support::sphereMesh(5), support::torusMesh()}) {
    for (const bool parallel : {true, false}) {
      SurfaceUniforms u = uniformsOf(parallel, -3);
      const std::vector<Covered> expected = onDevice(runner, mesh, u);
      u.pixelX += float{FAR} * u.pixelW;
      u.pixelY += float{FAR} * u.pixelW;
      u.rect = {FAR, FAR, FAR + WIDTH, FAR + HEIGHT};
      const std::vector<Covered> found = onDevice(runner, mesh, u);
      int moved = 0;
      for (size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].passed, 0u) << i;
        moved += (found[i].cover.back > 0) != (expected[i].cover.back > 0) ? 1 : 0;
      }
      // Of some 150 pixels on outlines one is expected within 4e-3 of them on either side.
      EXPECT_LE(moved, 2);
    }
  }
}

// The eye inside, also close to a wall before or behind it: triangles before, behind and around it.
TEST(SurfaceCover, FromInsideEveryPixelLeavesOnce) {
  support::ComputeRunner runner;
  for (const ClosedMesh& mesh : {support::boxMesh(), support::sphereMesh(3)}) {
    for (const float eye : {0.3f, -0.98f, 0.97f}) {
      const SurfaceUniforms u = uniformsOf(false, eye);
      const std::vector<Covered> expected = onCpu(mesh, u);
      const std::vector<Covered> found = onDevice(runner, mesh, u);
      for (size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].passed, 1u) << i << ' ' << eye;
        ASSERT_EQ(found[i].cover.front, 0u) << i;
        ASSERT_NEAR(found[i].cover.chord, expected[i].cover.chord, 64) << i;
      }
    }
  }
}

// Order of triangles and of lanes is all one: the same numbers each time.
TEST(SurfaceCover, RepeatsItselfBitByBit) {
  support::ComputeRunner runner;
  const ClosedMesh mesh = support::sphereMesh(4);
  const SurfaceUniforms u = uniformsOf(false, -1.5f);
  const std::vector<Covered> first = onDevice(runner, mesh, u);
  for (int i = 0; i < 3; ++i) {
    const std::vector<Covered> again = onDevice(runner, mesh, u);
    ASSERT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(Covered)), 0);
  }
}

}  // namespace
