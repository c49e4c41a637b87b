// SPDX-License-Identifier: MIT
#include "surface/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "failure.hpp"

namespace welkin {
namespace {

struct Input {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
};

// The box [0, size] moved by `offset`, wound outwards: corner i has x, y, z in its bits 0, 1, 2.
Input box(std::array<float, 3> size, float offset = 0) {
  Input input;
  for (uint32_t i = 0; i < 8; ++i) {
    for (uint32_t j = 0; j < 3; ++j) {
      input.positions.push_back(offset + ((i >> j) & 1 ? size[j] : 0));
    }
  }
  input.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return input;
}

SurfaceMesh make(const Input& input) {
  return makeSurfaceMesh(input.positions, input.indices);
}

// The field at fault, "" if none. `message` must begin what is said of it.
std::string fault(const Input& input, const std::string& message = "") {
  try {
    make(input);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.result, WLK_ERROR_INVALID_ARGUMENT);
    EXPECT_STRNE(failure.message, "");
    EXPECT_EQ(std::string(failure.message).rfind(message, 0), 0u) << failure.message;
    return failure.field;
  }
  return "";
}

// Every number is a small integer: exact.
TEST(SurfaceMesh, BoxIsMeasured) {
  const SurfaceMesh mesh = make(box({2, 3, 4}, 1000));
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.area_m2, 52);
  EXPECT_DOUBLE_EQ(mesh.volume_m3, 24);
  EXPECT_EQ(mesh.low, (std::array<float, 3>{1000, 1000, 1000}));
  EXPECT_EQ(mesh.high, (std::array<float, 3>{1002, 1003, 1004}));
}

TEST(SurfaceMesh, InwardWindingIsTurned) {
  Input input = box({1, 1, 1});
  const SurfaceMesh outward = make(input);
  for (size_t i = 0; i < input.indices.size(); i += 3) {
    std::swap(input.indices[i + 1], input.indices[i + 2]);
  }
  const SurfaceMesh turned = make(input);
  EXPECT_EQ(turned.triangles, outward.triangles);
  EXPECT_EQ(turned.volume_m3, outward.volume_m3);
}

// Each triangle with vertices of its own, one zero negative, and vertices that none uses.
TEST(SurfaceMesh, SplitVerticesAreOne) {
  const Input shared = box({2, 3, 4});
  Input split;
  for (const uint32_t index : shared.indices) {
    for (size_t j = 0; j < 3; ++j) {
      split.positions.push_back(shared.positions[3 * index + j]);
    }
    split.indices.push_back(static_cast<uint32_t>(split.indices.size()));
  }
  split.positions[0] = -0.0f;
  split.positions.insert(split.positions.end(), {500, 500, 500});
  const SurfaceMesh mesh = make(split);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_DOUBLE_EQ(mesh.volume_m3, 24);
  EXPECT_EQ(mesh.high, (std::array<float, 3>{2, 3, 4}));
}

// A triangle folded onto an edge keeps the mesh closed and has no area.
TEST(SurfaceMesh, TrianglesWithoutAreaAreDropped) {
  Input input = box({1, 1, 1});
  input.indices.insert(input.indices.end(), {0, 0, 1, 5, 5, 5});
  EXPECT_EQ(make(input).triangles.size(), 12u);
}

// A thin layer of cloud is no flat mesh: 10 m over 100 km.
TEST(SurfaceMesh, ThinLayerIsAccepted) {
  EXPECT_NEAR(make(box({1e5f, 1e5f, 10})).volume_m3, 1e11, 1);
}

TEST(SurfaceMesh, BadInputNamesItsField) {
  const Input good = box({1, 1, 1});
  EXPECT_EQ(fault(good), "");
  EXPECT_EQ(fault({{}, good.indices}), "positions");
  EXPECT_EQ(fault({good.positions, {}}), "indices");
  Input bad = good;
  bad.positions.pop_back();
  EXPECT_EQ(fault(bad), "positions") << "no list of x, y, z";
  bad = good;
  bad.indices.pop_back();
  EXPECT_EQ(fault(bad), "indices") << "no list of triangles";
  for (const float value : {std::numeric_limits<float>::quiet_NaN(),
                            -std::numeric_limits<float>::infinity(), 2 * SURFACE_POSITION_MAX}) {
    bad = good;
    bad.positions[7] = value;
    EXPECT_EQ(fault(bad, "vertex 2:"), "positions") << value;
  }
  bad = good;
  bad.indices[4] = 8;
  EXPECT_EQ(fault(bad), "indices") << "out of range";
  bad = good;
  bad.indices.resize(33);
  EXPECT_EQ(fault(bad), "indices") << "open";
  bad = good;
  std::swap(bad.indices[0], bad.indices[1]);
  EXPECT_EQ(fault(bad), "indices") << "one triangle wound the other way";
  EXPECT_EQ(fault(box({1, 1, 0})), "positions") << "flat";
  EXPECT_EQ(fault(box({0, 0, 0})), "positions") << "a point";
  bad = good;
  bad.indices.assign(3 * (SURFACE_TRIANGLES_MAX + 1), 0);
  EXPECT_EQ(fault(bad), "indices") << "too many";
}

}  // namespace
}  // namespace welkin
