// SPDX-License-Identifier: MIT
// OpenVDB grids: which voxel ends up where, and what is refused.
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "common/error.hpp"
#include "common/image.hpp"
#include "common/text.hpp"
#include "common/volume.hpp"
#include "expect_input_error.hpp"
#include "temp_folder.hpp"
#include "welkin_program.hpp"

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

TEST(HostVdb, RefusesVersionsThatTheLibraryDoesNotKnow) {
  const host_test::TempFolder folder;
  const auto grid = makeGrid(1.0);
  grid->getAccessor().setValue({0, 0, 0}, 1.0f);
  writeGrid(folder.file("a.vdb"), grid);
  std::string content = host::readTextFile(folder.file("a.vdb"), 1 << 20, "VDB");
  EXPECT_NO_THROW(host::loadVdb(folder.write("b.vdb", content), {}));
  content[11] = 5;
  const std::string file = folder.write("newer.vdb", content);
  expectInputError("magic number or version", [&] { host::loadVdb(file, {}); });
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

// Two grids of one file, with negative indices: where each active voxel of the dense loader is, the
// bricks have its value, and nothing else.
TEST(HostVdb, LoadsSeveralGridsAsTheBricksTheyStore) {
  const host_test::TempFolder folder;
  const auto density = makeGrid(2.0);
  density->fill(openvdb::CoordBBox({-13, 2, 5}, {6, 9, 30}), 0.25f, true);
  density->getAccessor().setValue({-40, 3, 90}, 0.75f);
  density->setName("density");
  const auto ice = makeGrid(2.0);
  ice->getAccessor().setValue({-41, 77, 6}, 0.5f);
  ice->setName("ice");
  const std::string file = folder.file("two.vdb");
  openvdb::io::File(file).write({density, ice});
  const std::vector<host::VdbSource> sources{{file, {"density", host::UpAxis::Y}},
                                             {file, {"ice", host::UpAxis::Y}}};
  const host::BrickVolume volume = host::loadVdbBricks(sources);
  // Bricks of indices -48 to 7, 0 to 79 and 0 to 95.
  ASSERT_EQ(volume.size, (std::array<uint32_t, 3>{56, 80, 96}));
  ASSERT_EQ(volume.fields.size(), 2u);
  EXPECT_EQ(volume.fields[0].coordinates.size() / 3, 3u * 2 * 4 + 1);
  EXPECT_EQ(volume.fields[1].coordinates, (std::vector<uint32_t>{0, 9, 0}));
  for (size_t f = 0; f < 2; ++f) {
    const host::BrickField& field = volume.fields[f];
    ASSERT_EQ(field.values.size(), field.coordinates.size() / 3 * 512);
    const auto accessor = (f == 0 ? density : ice)->getConstAccessor();
    double sum = 0;
    for (size_t n = 0; n < field.values.size(); ++n) {
      const uint32_t* brick = &field.coordinates[n / 512 * 3];
      const openvdb::Coord at(static_cast<int>(8 * brick[0] + n % 8) - 48,
                              static_cast<int>(8 * brick[1] + n / 8 % 8),
                              static_cast<int>(8 * brick[2] + n / 64 % 8));
      ASSERT_EQ(field.values[n], accessor.getValue(at)) << at;
      sum += double{field.values[n]};
    }
    EXPECT_EQ(sum, f == 0 ? 0.25 * 20 * 8 * 26 + 0.75 : 0.5);
  }
  // The box of active voxels, -41 to 6, 2 to 77, 5 to 90, and voxel (0, 0, 0) of the bricks in it.
  const host::Vec3 low = host::transformPoint(volume.worldFromActive, {});
  EXPECT_EQ(low.x, -83.0);
  EXPECT_EQ(low.y, 3.0);
  EXPECT_EQ(low.z, 9.0);
  const host::Vec3 p = host::transformPoint(
      volume.worldFromActive,
      host::transformPoint(volume.activeFromVolume, {0.5 / 56, 0.5 / 80, 0.5 / 96}));
  EXPECT_NEAR(p.x, -96.0, 1e-12);
  EXPECT_NEAR(p.y, 0.0, 1e-12);
  EXPECT_NEAR(p.z, 0.0, 1e-12);
}

TEST(HostVdb, RefusesGridsThatDoNotGoTogether) {
  const host_test::TempFolder folder;
  const auto one = makeGrid(1.0);
  one->getAccessor().setValue({0, 0, 0}, 1.0f);
  one->setName("one");
  const auto moved = makeGrid(1.5);
  moved->getAccessor().setValue({0, 0, 0}, 1.0f);
  moved->setName("moved");
  auto full = openvdb::FloatGrid::create(2.0f);
  full->getAccessor().setValue({0, 0, 0}, 1.0f);
  full->setName("full");
  const auto far = makeGrid(1.0);
  far->getAccessor().setValue({-2000000, 0, 0}, 1.0f);
  far->getAccessor().setValue({2000000, 2000000, 0}, 1.0f);
  far->setName("far");
  const std::string file = folder.file("a.vdb");
  openvdb::io::File(file).write({one, moved, full, far});
  const auto load = [&](const std::string& first, const std::string& second) {
    return [&file, first, second] {
      host::loadVdbBricks({{file, {first, host::UpAxis::Y}}, {file, {second, host::UpAxis::Y}}});
    };
  };
  expectInputError("expected the transform of field 0", load("one", "moved"));
  expectInputError("expected a background of 0", load("one", "full"));
  expectInputError("named 'none'; the file has: one, moved, full, far", load("one", "none"));
  expectInputError("bricks of 8^3 voxels around", load("one", "far"));
}

// The same box, whether its voxels come as bricks or as raw floats.
TEST(HostVdb, RendersAsTheSameVoxelsFromAnotherFile) {
  const host_test::TempFolder folder;
  const auto density = makeGrid(20.0);
  std::string raw;
  for (int n = 0; n < 16 * 8 * 24; ++n) {
    const openvdb::Coord at(n % 16, n / 16 % 8, n / 128);
    const double r = (at.asVec3d() - openvdb::Vec3d(8, 4, 11)).length() / 9;
    // Halves, as bricks are kept, and above 0 in the corners: the box is that of the raw file.
    const auto value = static_cast<float>(std::ceil(64 * std::max(1 - r, 0.01)) / 64);
    density->getAccessor().setValue(at, value);
    raw.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  writeGrid(folder.file("a.vdb"), density);
  static_cast<void>(folder.write("a.raw", raw));
  const std::string scene = R"({"sky": {}, "lights": [{"elevation_deg": 40, "azimuth_deg": 110}],
    "media": {"m": {"particle": "henyey-greenstein"}},
    "volumes": [{"source": SOURCE, "transform": {"min": [-200, 300, -1000],
    "size": [400, 200, 300]},
    "fields": [{"medium": "m", "extinctionScale": 0.02}]}],
    "camera": {"position": [0, 400, 0], "target": [0, 400, -1000]}, "view": {"size": [32, 24]}})";
  const auto with = [&](const std::string& source) {
    std::string text = scene;
    return text.replace(text.find("SOURCE"), 6, source);
  };
  static_cast<void>(folder.write("vdb.json", with(R"({"type": "vdb", "file": "a.vdb"})")));
  static_cast<void>(
      folder.write("raw.json", with(R"({"type": "raw", "file": "a.raw", "size": [16, 8, 24]})")));
  host_test::expectSuccess(folder, "render vdb.json -o vdb.exr");
  host_test::expectSuccess(folder, "render raw.json -o raw.exr");
  host_test::expectSuccess(folder, "render raw.json -o none.exr --set volumes=[]");
  const auto apart = [](const host::Image& a, const host::Image& b) {
    float most = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
      most = std::max(most, std::abs(a.rgba[i] - b.rgba[i]));
    }
    return most;
  };
  const auto truth = host::readExr(folder.file("raw.exr"));
  // Files have half floats, of radiances about 0.1.
  EXPECT_LE(apart(host::readExr(folder.file("vdb.exr")), truth), 2.0f * 0.1f * 0x1p-11f);
  EXPECT_GT(apart(host::readExr(folder.file("none.exr")), truth), 0.01f);
}

// Diameters in a grid beside the density's, against the same numbers as raw floats.
TEST(HostVdb, DiametersComeFromAGridOfTheirOwn) {
  const host_test::TempFolder folder;
  const auto density = makeGrid(20.0);
  const auto diameter = makeGrid(20.0);
  density->setName("density");
  diameter->setName("diameter");
  std::string raw;
  std::string rawDiameters;
  for (int n = 0; n < 16 * 8 * 8; ++n) {
    const openvdb::Coord at(n % 16, n / 16 % 8, n / 128);
    const float value = 0.5f;
    const float size = at.x() < 8 ? 6.0f : 30.0f;
    density->getAccessor().setValue(at, value);
    diameter->getAccessor().setValue(at, size);
    raw.append(reinterpret_cast<const char*>(&value), sizeof value);
    rawDiameters.append(reinterpret_cast<const char*>(&size), sizeof size);
  }
  openvdb::io::File(folder.file("a.vdb")).write({density, diameter});
  static_cast<void>(folder.write("a.raw", raw));
  static_cast<void>(folder.write("d.raw", rawDiameters));
  const auto with = [&](const std::string& source, const std::string& diameters) {
    return R"({"lights": [{"elevation_deg": 4, "azimuth_deg": 170}], "media": {"m": {}},
      "volumes": [{"source": )" +
           source + R"(, "transform": {"min": [-200, 300, -1000], "size": [400, 200, 200]},
      "fields": [{"medium": "m", "extinctionScale": 0.02)" +
           diameters + R"(}]}], "quality": {"scattering": "single"},
      "camera": {"position": [0, 400, 0], "target": [0, 400, -1000]}, "view": {"size": [32, 24]}})";
  };
  const std::string rawSource = R"({"type": "raw", "file": "a.raw", "size": [16, 8, 8]})";
  const std::string rawField =
      R"(, "diameters": {"type": "raw", "file": "d.raw", "size": [16, 8, 8]})";
  static_cast<void>(folder.write(
      "vdb.json", with(R"({"type": "vdb", "file": "a.vdb"})",
                       R"(, "diameters": {"type": "vdb", "file": "a.vdb", "grid": "diameter"})")));
  static_cast<void>(folder.write("raw.json", with(rawSource, rawField)));
  static_cast<void>(folder.write("none.json", with(rawSource, "")));
  static_cast<void>(
      folder.write("bad.json", with(R"({"type": "vdb", "file": "a.vdb"})", rawField)));
  host_test::expectSuccess(folder, "render vdb.json -o vdb.exr");
  host_test::expectSuccess(folder, "render raw.json -o raw.exr");
  host_test::expectSuccess(folder, "render none.json -o none.exr");
  const auto apart = [&](const char* a, const char* b) {
    const host::Image one = host::readExr(folder.file(a));
    const host::Image other = host::readExr(folder.file(b));
    double most = 0;
    double mean = 0;
    for (size_t i = 0; i < one.rgba.size(); ++i) {
      most = std::max(most, double{std::abs(one.rgba[i] - other.rgba[i])});
      mean += double{other.rgba[i]} / static_cast<double>(one.rgba.size());
    }
    return most / mean;
  };
  EXPECT_LE(apart("vdb.exr", "raw.exr"), 0.01);
  EXPECT_GT(apart("none.exr", "raw.exr"), 0.05);
}

template <typename T>
void put(std::string& bytes, size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

// A file of one grid: leaf (-8, 0, 16) with 0.5 at its voxel (1, 2, 3), and below lower node
// (-128, 0, 0) a constant leaf of 0.25 at (-128, 8, 0). Offsets as NanoVDB 32.6 has them.
std::string nanoFile() {
  constexpr size_t GRID = 16 + 176 + 5;
  constexpr size_t TREE = GRID + 672;
  constexpr size_t ROOT = TREE + 64;
  constexpr size_t LOWER = ROOT + 64;
  constexpr size_t LEAF = LOWER + 33856;
  std::string bytes(LEAF + 2144, '\0');
  bytes.replace(0, 8, "NanoVDB2");
  put(bytes, 8, uint32_t{32u << 21 | 6u << 10});
  put(bytes, 12, uint16_t{1});
  put(bytes, 16, uint64_t{bytes.size() - GRID});
  put(bytes, 16 + 136, uint32_t{5});
  bytes.replace(16 + 176, 4, "dens");
  bytes.replace(GRID, 8, "NanoVDB1");
  put(bytes, GRID + 636, uint32_t{1});
  for (size_t i = 0; i < 3; ++i) {
    put(bytes, GRID + 296 + 88 + 8 * (4 * i), 2.0);
  }
  put(bytes, GRID + 296 + 88 + 8 * 18, 100.0);
  put(bytes, TREE, uint64_t{LEAF - TREE});
  put(bytes, TREE + 8, uint64_t{LOWER - TREE});
  put(bytes, TREE + 16, uint64_t{LOWER - TREE});
  put(bytes, TREE + 24, uint64_t{ROOT - TREE});
  put(bytes, TREE + 32, uint32_t{1});
  put(bytes, TREE + 36, uint32_t{1});
  const std::array<int32_t, 6> box{-128, 2, 0, -7, 15, 19};
  for (size_t i = 0; i < box.size(); ++i) {
    put(bytes, ROOT + 4 * i, box[i]);
    put(bytes, LOWER + 4 * i, box[i]);
  }
  constexpr size_t TILE = 16;  // (0, 1, 0) of 16^3
  put(bytes, LOWER + 32 + TILE / 8, uint8_t{1 << TILE % 8});
  put(bytes, LOWER + 1088 + 8 * TILE, 0.25f);
  put(bytes, LEAF, int32_t{-7});
  put(bytes, LEAF + 4, int32_t{2});
  put(bytes, LEAF + 8, int32_t{19});
  put(bytes, LEAF + 96 + 4 * (1 * 64 + 2 * 8 + 3), 0.5f);
  return bytes;
}

TEST(HostVdb, LoadsTheLeavesAndSmallTilesOfNanoVdb) {
  const host_test::TempFolder folder;
  const std::string file = folder.write("a.nvdb", nanoFile());
  const host::BrickVolume volume = host::loadVdbBricks({{file, {"dens", host::UpAxis::Y}}});
  ASSERT_EQ(volume.size, (std::array<uint32_t, 3>{128, 16, 24}));
  const host::BrickField& field = volume.fields[0];
  EXPECT_EQ(field.coordinates, (std::vector<uint32_t>{15, 0, 2, 0, 1, 0}));
  ASSERT_EQ(field.values.size(), 1024u);
  for (size_t n = 0; n < 512; ++n) {
    EXPECT_EQ(field.values[n], n == 3 * 64 + 2 * 8 + 1 ? 0.5f : 0.0f);
    EXPECT_EQ(field.values[512 + n], 0.25f);
  }
  // Voxel (-128, 2, 0) is the first of the active ones.
  const host::Vec3 p = host::transformPoint(volume.worldFromActive, {});
  EXPECT_EQ(p.x, 100.0 + 2.0 * -128.5);
  EXPECT_EQ(p.y, 2.0 * 1.5);
  EXPECT_EQ(p.z, 2.0 * -0.5);
}

TEST(HostVdb, RefusesNanoVdbThatItCannotUse) {
  const host_test::TempFolder folder;
  const auto refuses = [&](const char* what, const std::function<void(std::string&)>& spoil) {
    std::string bytes = nanoFile();
    spoil(bytes);
    const std::string file = folder.write("bad.nvdb", bytes);
    expectInputError(what, [&] { host::loadVdbBricks({{file, {"dens", host::UpAxis::Y}}}); });
  };
  constexpr size_t GRID = 16 + 176 + 5;
  refuses("version 32", [](std::string& b) { put(b, 8, uint32_t{29u << 21}); });
  refuses("without compression", [](std::string& b) { put(b, 14, uint16_t{1}); });
  refuses("named 'dens'; the file has: gens", [](std::string& b) { b[16 + 176] = 'g'; });
  refuses("grid of floats", [](std::string& b) { put(b, GRID + 636, uint32_t{2}); });
  refuses("that is whole", [](std::string& b) { b.pop_back(); });
  refuses("that is whole", [](std::string& b) { put(b, 12, uint16_t{9}); });
  refuses("that is whole", [](std::string& b) { put(b, GRID + 672 + 32, ~uint32_t{0}); });
  refuses("that is whole", [](std::string& b) { put(b, GRID + 672, ~uint64_t{0} - 700); });
  refuses("background of 0", [](std::string& b) { put(b, GRID + 672 + 64 + 28, 1.0f); });
  refuses("inside the box", [](std::string& b) { put(b, GRID + 672 + 64 + 64 + 33856, 64); });
  for (const size_t size : {0u, 8u, 100u, 700u, 20000u}) {
    const std::string file = folder.write("cut.nvdb", nanoFile().substr(0, size));
    EXPECT_THROW(host::loadVdbBricks({{file, {"dens", host::UpAxis::Y}}}), host::InputError);
  }
}

}  // namespace
