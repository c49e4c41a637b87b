// SPDX-License-Identifier: MIT
// shaders/model/surface/triangle.glsl: no crack, no double hit, and the chords of rays by Moeller
// and Trumbore's intersection in double, which shares no formula with it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "model/model.hpp"
#include "support/closed_meshes.hpp"

namespace {

namespace f32 = welkin::model::f32;
using namespace support;
using Point = glm::dvec3;

constexpr int SIZE = 48;  // pixels along the picture's edge

struct Camera {
  Point eye;
  glm::dmat3 axes{1.0};  // columns: right, down, ahead
  double scale = SIZE;   // pixels for an angle of 45 degrees

  Point ray(int x, int y) const {
    return axes * Point((x - SIZE / 2.0) / scale, (y - SIZE / 2.0) / scale, 1);
  }
  f32::vec3 project(const Point& p) const {
    const Point v = glm::transpose(axes) * (p - eye);
    return f32::vec3(glm::dvec3(v.x * scale + v.z * SIZE / 2, v.y * scale + v.z * SIZE / 2, v.z));
  }
};

Camera lookAt(const Point& eye, const Point& target) {
  Camera camera;
  camera.eye = eye;
  const Point ahead = glm::normalize(target - eye);
  const Point right = glm::normalize(glm::cross(ahead, Point(0.1, 0.2, 1)));
  camera.axes = glm::dmat3(right, glm::cross(ahead, right), ahead);
  return camera;
}

struct Seen {
  int net = 0;       // fronts less backs
  double chord = 0;  // along the view's axis
};

// What the kernel does for each pixel, all triangles.
std::vector<Seen> draw(const ClosedMesh& mesh, const Camera& camera) {
  std::vector<f32::vec3> vertex;
  for (const Point& p : mesh.position) {
    vertex.push_back(camera.project(p));
  }
  std::vector<Seen> picture(size_t{SIZE} * SIZE);
  for (const auto& t : mesh.triangle) {
    const f32::vec3 depths(vertex[t[0]].z, vertex[t[1]].z, vertex[t[2]].z);
    for (int i = 0; i < SIZE * SIZE; ++i) {
      const f32::vec2 pixel(static_cast<float>(i % SIZE), static_cast<float>(i / SIZE));
      const f32::SurfaceCrossing hit =
          f32::surfaceCrossing(vertex[t[0]], vertex[t[1]], vertex[t[2]], depths, pixel);
      if (hit.facing != 0.0f && hit.depth > 0.0f) {
        Seen& seen = picture[static_cast<size_t>(i)];
        seen.net += static_cast<int>(hit.facing);
        seen.chord -= static_cast<double>(hit.facing) * static_cast<double>(hit.depth);
      }
    }
  }
  return picture;
}

struct Truth {
  double chord = 0;
  double margin = 1e9;  // to the nearest edge of a triangle, in its own coordinates
};

Truth trace(const ClosedMesh& mesh, const Point& eye, const Point& ray) {
  Truth truth;
  for (const auto& t : mesh.triangle) {
    const Point e1 = mesh.position[t[1]] - mesh.position[t[0]];
    const Point e2 = mesh.position[t[2]] - mesh.position[t[0]];
    const Point p = glm::cross(ray, e2);
    const double det = glm::dot(e1, p);
    if (std::fabs(det) < 1e-9) {
      truth.margin = 0;  // along the triangle
      continue;
    }
    const Point s = (eye - mesh.position[t[0]]) / det;
    const double u = glm::dot(s, p);
    const Point q = glm::cross(s, e1);
    const double v = glm::dot(ray, q);
    const double inside = std::min({u, v, 1 - u - v});
    truth.margin = std::min(truth.margin, std::fabs(inside));
    const double depth = glm::dot(e2, q);
    if (inside > 0 && depth > 0) {
      truth.chord -= (det > 0 ? 1 : -1) * depth;  // det > 0: from outside
    }
  }
  return truth;
}

std::vector<Camera> cameras() {
  std::vector<Camera> list = {lookAt({3, 1, 2}, {0, 0, 0}), lookAt({-2, 4, 0.3}, {0.2, 0, 0}),
                              lookAt({0, 0, 9}, {0, 0, 0})};
  list[2].scale = 4 * SIZE;
  // Vertices and edges of the box lie on pixels.
  Camera straight;
  straight.eye = {0, 0, -3};
  straight.scale = 16;
  list.push_back(straight);
  return list;
}

// No pixel of a closed mesh enters more often than it leaves, and none has a negative chord.
TEST(SurfaceTriangle, ClosedMeshesHaveNoCrackAndNoDoubleHit) {
  for (const ClosedMesh& mesh : {boxMesh(), sphereMesh(4), torusMesh()}) {
    for (const Camera& camera : cameras()) {
      int covered = 0;
      for (const Seen& seen : draw(mesh, camera)) {
        ASSERT_EQ(seen.net, 0);
        ASSERT_GE(seen.chord, -1e-5 * glm::length(camera.eye));
        covered += seen.chord > 1e-4 ? 1 : 0;
      }
      EXPECT_GT(covered, SIZE);
    }
  }
}

TEST(SurfaceTriangle, ChordsAreThoseOfExactRays) {
  // Places of lines: 8 roundings of numbers up to 100 pixels times the depth; a chord changes by
  // the facet's slope, up to 50 where the margin is kept, for each pixel of 1/16 to 1/192 depths.
  constexpr double MARGIN = 1e-3;
  constexpr double BOUND = 8 * 6e-8 * 100 * 50;
  for (const ClosedMesh& mesh : {boxMesh(), sphereMesh(3), torusMesh()}) {
    for (const Camera& camera : cameras()) {
      const std::vector<Seen> picture = draw(mesh, camera);
      int compared = 0;
      for (int i = 0; i < SIZE * SIZE; ++i) {
        const Truth truth = trace(mesh, camera.eye, camera.ray(i % SIZE, i / SIZE));
        if (truth.margin > MARGIN) {
          ASSERT_NEAR(picture[static_cast<size_t>(i)].chord, truth.chord, BOUND) << i;
          ++compared;
        }
      }
      EXPECT_GT(compared, SIZE * SIZE / 4);
    }
  }
}

// The eye inside, and triangles that reach from before the eye to behind it.
TEST(SurfaceTriangle, FromInsideEveryRayLeavesOnce) {
  constexpr double BOUND = 1e-3;
  for (const ClosedMesh& mesh : {boxMesh(), sphereMesh(0), sphereMesh(4)}) {
    for (const Point& eye : {Point(0, 0, 0), Point(0.2, -0.1, 0.3), Point(-0.4, 0.3, 0.1)}) {
      Camera camera = lookAt(eye, {0.7, 0.1, -0.3});
      camera.scale = SIZE / 4.0;  // 127 degrees
      const std::vector<Seen> picture = draw(mesh, camera);
      for (int i = 0; i < SIZE * SIZE; ++i) {
        const Seen& seen = picture[static_cast<size_t>(i)];
        ASSERT_EQ(seen.net, -1);
        const Truth truth = trace(mesh, eye, camera.ray(i % SIZE, i / SIZE));
        if (truth.margin > 1e-3) {
          ASSERT_NEAR(seen.chord, truth.chord, BOUND * truth.chord);
        }
      }
    }
  }
}

// Many small random places: pixels on and beside edges and vertices.
TEST(SurfaceTriangle, SharedEdgesBelongToOneTriangleWhateverTheirPlace) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> place(0, 12);
  for (int n = 0; n < 2000; ++n) {
    // A fan around a vertex on a pixel; its rim on pixels, too.
    const f32::vec3 middle(6, 6, 1);
    const std::array<f32::vec3, 4> rim = {f32::vec3(static_cast<float>(place(random)), 0, 1),
                                          f32::vec3(12, static_cast<float>(place(random)), 1),
                                          f32::vec3(static_cast<float>(place(random)), 12, 1),
                                          f32::vec3(0, static_cast<float>(place(random)), 1)};
    for (int y = 3; y < 10; ++y) {
      for (int x = 3; x < 10; ++x) {
        const f32::vec2 pixel(static_cast<float>(x), static_cast<float>(y));
        int hits = 0;
        bool beside = false;
        for (size_t i = 0; i < 4; ++i) {
          const size_t next = (i + 1) % 4;
          const f32::SurfaceCrossing hit =
              f32::surfaceCrossing(middle, rim[i], rim[next], f32::vec3(1.0f), pixel);
          hits += hit.facing < 0.0f ? 1 : 0;
          beside = beside || f32::edgeArea(f32::fromPixel(rim[i], pixel),
                                           f32::fromPixel(rim[next], pixel)) <= 0.0f;
        }
        if (!beside) {
          ASSERT_EQ(hits, 1) << n << " at " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
