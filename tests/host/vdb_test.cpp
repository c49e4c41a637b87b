// SPDX-License-Identifier: MIT
// OpenVDB grids: which voxel ends up where, and what is refused.
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include "common/volume.hpp"
#include "expect_input_error.hpp"
#include "temp_folder.hpp"

namespace {

using host_test::expectInputError;

void writeGrid(const std::string& file, const openvdb::GridBase::Ptr& grid) {
  grid->setName("density");
  openvdb::io::File(file).write({grid});
}

openvdb::FloatGrid::Ptr makeGrid(double voxelSize) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
  return grid;
}

TEST(HostVdb, PutsIntegerIndicesAtVoxelCentres) {
  const host_test::TempFolder folder;
  const auto source = makeGrid(2.5);
  source->transform().postTranslate({100.0, 0.0, 0.0});
  auto accessor = source->getAccessor();
  accessor.setValue({-2, 4, 7}, 0.5f);
  accessor.setValue({1, 5, 7}, 0.75f);
  writeGrid(folder.file("a.vdb"), source);
  const host::Grid grid = host::loadVdb(folder.file("a.vdb"), {});
  ASSERT_EQ(grid.size, (std::array<uint32_t, 3>{4, 2, 1}));
  EXPECT_EQ(grid.values, (std::vector<float>{0.5f, 0, 0, 0, 0, 0, 0, 0.75f}));
  // Voxel 0's centre, (0.5 / 4, 0.5 / 2, 0.5), is index (-2, 4, 7); all numbers are exact.
  const host::Vec3 p = host::transformPoint(grid.worldFromVolume, {0.125, 0.25, 0.5});
  EXPECT_EQ(p.x, 100.0 - 2.0 * 2.5);
  EXPECT_EQ(p.y, 4.0 * 2.5);
  EXPECT_EQ(p.z, 7.0 * 2.5);
}

TEST(HostVdb, TurnsZUpIntoYUp) {
  const host_test::TempFolder folder;
  const auto source = makeGrid(1.0);
  source->getAccessor().setValue({3, 5, 9}, 1.0f);
  writeGrid(folder.file("a.vdb"), source);
  host::VdbInfo info;
  info.up = host::UpAxis::Z;
  const host::Grid grid = host::loadVdb(folder.file("a.vdb"), info);
  const host::Vec3 p = host::transformPoint(grid.worldFromVolume, {0.5, 0.5, 0.5});
  EXPECT_EQ(p.x, 3.0);
  EXPECT_EQ(p.y, 9.0);
  EXPECT_EQ(p.z, -5.0);
}

TEST(HostVdb, RefusesWhatItCannotUse) {
  const host_test::TempFolder folder;
  expectInputError("no such file", [&] { host::loadVdb(folder.file("none.vdb"), {}); });
  const std::string text = folder.write("text.vdb", "no grid here, only a sentence or two");
  expectInputError("expected an OpenVDB file", [&] { host::loadVdb(text, {}); });

  const std::string file = folder.file("a.vdb");
  writeGrid(file, makeGrid(1.0));
  expectInputError("at least one active voxel", [&] { host::loadVdb(file, {}); });
  expectInputError("named 'smoke'; the file has: density", [&] {
    host::loadVdb(file, {"smoke", host::UpAxis::Y});
  });
  auto integers = openvdb::Int32Grid::create(0);
  integers->getAccessor().setValue({0, 0, 0}, 1);
  writeGrid(file, integers);
  expectInputError("expected a grid of floats", [&] { host::loadVdb(file, {}); });

  const auto huge = makeGrid(1.0);
  huge->getAccessor().setValue({-2000000, 0, 0}, 1.0f);
  huge->getAccessor().setValue({2000000, 2000000, 0}, 1.0f);
  writeGrid(file, huge);
  expectInputError("size: expected 1 to", [&] { host::loadVdb(file, {}); });
}

TEST(HostVdb, RefusesAFileThatIsCutOff) {
  const host_test::TempFolder folder;
  const std::string file = folder.file("cut.vdb");
  for (const double keep : {0.05, 0.4, 0.8}) {
    const auto grid = makeGrid(1.0);
    grid->fill(openvdb::CoordBBox({0, 0, 0}, {20, 20, 20}), 0.3f, true);
    grid->getAccessor().setValue({3, 3, 3}, 0.7f);
    writeGrid(file, grid);
    host_test::cutOff(file, keep);
    expectInputError("cut.vdb: expected an OpenVDB file", [&] { host::loadVdb(file, {}); });
  }
}

}  // namespace
