// SPDX-License-Identifier: MIT
// The section surfaces: what it makes and how its mistakes are named.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/scene.hpp"
#include "expect_input_error.hpp"
#include "temp_folder.hpp"

namespace {

host::Scene parse(const std::string& surface) {
  const host_test::TempFolder folder;
  const std::string file =
      folder.write("s.json", R"({"media": {"drop": {}}, "surfaces": [)" + surface + "]}");
  return host::parseScene(host::readSceneJson(file, {}), file);
}

void expectSurfaceError(const std::string& part, const std::string& surface) {
  host_test::expectInputError(part, [&] { parse(surface); });
}

TEST(HostSceneSurfaces, ReadsEveryShape) {
  const host::Scene sphere = parse(R"({"mesh": {"sphere": {"radius": 7, "subdivisions": 2}},
      "medium": "drop", "extinction": 0.5})");
  ASSERT_EQ(sphere.surfaces.size(), 1u);
  EXPECT_EQ(sphere.surfaces[0].extinction, 0.5);
  EXPECT_EQ(std::get<host::SphereMesh>(sphere.surfaces[0].shape).radius, 7.0);
  const host::Scene box = parse(R"({"mesh": {"box": {"cells": [1, 2, 3]}}, "medium": "drop"})");
  EXPECT_EQ(std::get<host::BoxMesh>(box.surfaces[0].shape).cells[2], 3u);
  const host::Scene sheet =
      parse(R"({"mesh": {"stratocumulus": {"relief": 0.5}}, "medium": "drop", "time": 12})");
  EXPECT_EQ(std::get<host::StratocumulusMesh>(sheet.surfaces[0].shape).time, 12.0);
  EXPECT_EQ(std::get<host::StratocumulusMesh>(sheet.surfaces[0].shape).relief, 0.5);
  const host::Scene cumulus =
      parse(R"({"mesh": {"cumulus": {"seed": 4, "detail": 20}}, "medium": "drop"})");
  EXPECT_EQ(std::get<host::CumulusMesh>(cumulus.surfaces[0].shape).seed, 4u);
}

TEST(HostSceneSurfaces, AreVolumesOnDemand) {
  const host::Scene scene = parse(R"({"mesh": {"sphere": {}}, "medium": "drop",
      "extinction": 0.25, "as": "volume", "resolution": 16, "transform": {"scale": 2}})");
  EXPECT_TRUE(scene.surfaces.empty());
  ASSERT_EQ(scene.volumes.size(), 1u);
  EXPECT_EQ(scene.volumes[0].fields[0].extinctionScale, 0.25);
  EXPECT_EQ(scene.volumes[0].placement.scale, 2.0);
  const host::Grid grid = host::loadSource(scene.volumes[0].fields[0].source);
  EXPECT_EQ(grid.size, (std::array<uint32_t, 3>{16, 16, 16}));
}

// A mesh and its voxels are at one place, whatever moves them: corners of the box, to a few float
// roundings of 2000 m.
TEST(HostSceneSurfaces, StandWhereTheirVoxelsStand) {
  const host::CloudMesh mesh = makeMesh(host::CumulusMesh{.detail = 16});
  host::PlacementDesc turned;
  turned.scale = 1.5;
  turned.origin = {100.0, 900.0, -300.0};
  turned.rotationDeg = {20.0, 130.0, 5.0};
  host::PlacementDesc fitted;
  fitted.box = true;
  fitted.min = {1.0, 2.0, 3.0};
  fitted.size = {10.0, 20.0, 40.0};
  const host::Affine natural = boundsOf(mesh);
  for (const host::PlacementDesc& placement : {host::PlacementDesc{}, turned, fitted}) {
    const host::Affine ofMesh = placeMesh(mesh, placement);
    const host::Affine ofBox = placeVolume(natural, placement);
    for (const host::Vec3 corner : {host::Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}) {
      const host::Vec3 gap =
          transformPoint(ofMesh, transformPoint(natural, corner)) - transformPoint(ofBox, corner);
      EXPECT_LT(host::length(gap), 1e-9);
    }
  }
}

TEST(HostSceneSurfaces, NamesMistakes) {
  expectSurfaceError("surfaces.0.medium: expected the name of one of media",
                     R"({"mesh": {"sphere": {}}, "medium": "fog"})");
  expectSurfaceError("surfaces.0.mesh", R"({"medium": "drop"})");
  expectSurfaceError("surfaces.0.mesh: expected one of sphere",
                     R"({"mesh": {"sphere": {}, "box": {}}, "medium": "drop"})");
  expectSurfaceError("surfaces.0.mesh", R"({"mesh": {"cone": {}}, "medium": "drop"})");
  expectSurfaceError("surfaces.0.mesh.sphere.radius",
                     R"({"mesh": {"sphere": {"radius": -1}}, "medium": "drop"})");
  expectSurfaceError("surfaces.0.mesh.sphere.subdivisions",
                     R"({"mesh": {"sphere": {"subdivisions": 12}}, "medium": "drop"})");
  expectSurfaceError("surfaces.0.mesh.box.cells: expected [nx, ny, nz]",
                     R"({"mesh": {"box": {"cells": [1]}}, "medium": "drop"})");
  expectSurfaceError("surfaces.0.mesh.cumulus.extent",
                     R"({"mesh": {"cumulus": {"extent": [1, 1, 1e9]}}, "medium": "drop"})");
  expectSurfaceError("surfaces.0.time: expected only with a stratocumulus",
                     R"({"mesh": {"sphere": {}}, "medium": "drop", "time": 1})");
  expectSurfaceError("surfaces.0.resolution: expected only with \"as\": \"volume\"",
                     R"({"mesh": {"sphere": {}}, "medium": "drop", "resolution": 64})");
  expectSurfaceError("surfaces.0.as", R"({"mesh": {"sphere": {}}, "medium": "drop", "as": "x"})");
  expectSurfaceError("surfaces.0.extinction",
                     R"({"mesh": {"sphere": {}}, "medium": "drop", "extinction": -1})");
}

}  // namespace
