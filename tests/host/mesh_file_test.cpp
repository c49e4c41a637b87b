// SPDX-License-Identifier: MIT
// Meshes from files: a box comes as it is, what is no mesh is refused.
#include <gtest/gtest.h>

#include <array>

#include "common/cloud_mesh.hpp"
#include "common/error.hpp"
#include "temp_folder.hpp"

namespace {

using host_test::TempFolder;

host::CloudMesh read(const char* text) {
  const TempFolder folder;
  return host::makeMesh(host::MeshFile{folder.write("mesh.obj", text)});
}

TEST(MeshFile, ReadsPolygonsAsTriangles) {
  const host::CloudMesh box = read(
      "o box\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n");
  EXPECT_EQ(box.positions.size(), 8u);
  EXPECT_EQ(box.triangles.size(), 12u);
  EXPECT_EQ(box.positions[6], (std::array{1.0f, 1.0f, 1.0f}));
  double volume = 0;  // by the divergence theorem
  for (const auto& t : box.triangles) {
    const auto& a = box.positions[t[0]];
    const auto& b = box.positions[t[1]];
    const auto& c = box.positions[t[2]];
    volume += (double{a[0]} * (double{b[1]} * c[2] - double{b[2]} * c[1]) -
               double{a[1]} * (double{b[0]} * c[2] - double{b[2]} * c[0]) +
               double{a[2]} * (double{b[0]} * c[1] - double{b[1]} * c[0])) /
              6;
  }
  EXPECT_NEAR(volume, 1, 1e-6);
}

TEST(MeshFile, WhatIsNoMeshIsRefused) {
  EXPECT_THROW(host::makeMesh(host::MeshFile{"no/such/file.obj"}), host::InputError);
  for (const char* text : {"", "hello", "v 0 0 0\n", "f 1 2 3\n", "v 0 0 0\nf 1 2 9\n",
                           "v 0 0 0\nf -5 -6 -7\n", "f 1/2/3 99999999999 -\n"}) {
    EXPECT_THROW(read(text), host::InputError) << text;
  }
}

}  // namespace
