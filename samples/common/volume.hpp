// SPDX-License-Identifier: MIT
// Voxel data in memory and where it comes from.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/vec.hpp"

namespace host {

/// Most voxels that a source may have: 512 MiB of floats.
constexpr uint64_t MAX_VOXELS = uint64_t{1} << 27;

/// One field on a regular grid, x fastest.
struct Grid {
  std::array<uint32_t, 3> size{};
  std::vector<float> values;
  /// Where the data's own coordinates put the unit box [0, 1]^3, in metres, y up.
  Affine worldFromVolume{};
};

/// Which axis of the data points up. Z: data (x, y, z) becomes world (x, z, -y), a rotation.
enum class UpAxis { Y, Z };

/// Throws InputError if an edge is 0 or the product passes MAX_VOXELS.
uint64_t checkedVoxelCount(const std::string& file, const std::array<uint64_t, 3>& size);

/// Turns a data-space vector into a world-space one.
Vec3 worldAxes(Vec3 data, UpAxis up);

enum class RawFormat { R32Float, R16Float, R8Unorm };

struct RawInfo {
  std::array<uint32_t, 3> size{};
  RawFormat format = RawFormat::R32Float;
  /// Edges of a voxel in metres.
  Vec3 voxelSize{1.0, 1.0, 1.0};
  UpAxis up = UpAxis::Y;
};

/// Headerless little-endian voxels; the file's length must be what size and format say.
Grid loadRaw(const std::filesystem::path& file, const RawInfo& info);

struct LesInfo {
  /// First index along each axis, 0 or 1; -1 finds out: an index equal to the size means 1,
  /// otherwise 0.
  int indexBase = -1;
  UpAxis up = UpAxis::Z;
  /// The droplets' median diameter instead of the extinction.
  bool diameters = false;
};

/// Large-eddy simulation as text: a comment line, `nx ny nz`, `dx dy` and nz level altitudes in
/// km, then rows `ix iy iz lwc reff` in g/m^3 and um. Values are extinction in 1/m,
/// 1.5 lwc / reff (water of 1e6 g/m^3, extinction efficiency 2), or median diameters in um,
/// 2 reff / exp(2.5 spread^2) for the spread of the library's tables. Cell k is centred on level k.
Grid loadLes(const std::filesystem::path& file, const LesInfo& info);

struct VdbInfo {
  /// Name of a FloatGrid.
  std::string grid = "density";
  UpAxis up = UpAxis::Y;
};

/// The active bounding box of an OpenVDB grid. A VDB value sits at its integer index, ours at the
/// voxel's centre, so index i becomes the centre of voxel i - min.
Grid loadVdb(const std::filesystem::path& file, const VdbInfo& info);

/// Most bricks along all edges of a sparse volume together: 2048^3 voxels.
constexpr uint64_t MAX_BRICKS = uint64_t{1} << 24;

/// One field's bricks of 8^3 voxels, x fastest, as wlkUploadVolumeBricks takes them.
struct BrickField {
  std::vector<uint32_t> coordinates;
  std::vector<float> values;
};

/// Fields on a common grid, only the bricks that grids store.
struct BrickVolume {
  std::array<uint32_t, 3> size{};
  std::vector<BrickField> fields;
  /// Where the grids' own coordinates put the active bounding box of all of them, as in Grid.
  Affine worldFromActive{};
  /// The volume's unit box in that of the active bounding box: bricks may reach past it.
  Affine activeFromVolume{};
};

struct VdbSource {
  std::filesystem::path file;
  VdbInfo info;
};

/// A field of each source, of an OpenVDB or NanoVDB file, without making anything dense but active
/// tiles. Grids must have the same transform and a background of 0. Reads each file once.
BrickVolume loadVdbBricks(const std::vector<VdbSource>& sources);

struct CumulusInfo {
  std::array<uint32_t, 3> size{128, 96, 128};
  uint32_t seed = 1;
  /// Edges of the box in metres.
  Vec3 extent{2400.0, 1800.0, 2400.0};
  /// Size of the puffs relative to the usual; smaller is more ragged. [0.3, 3].
  double puffScale = 1.0;
};

/// A fair-weather cumulus with a flat base and a cauliflower top, density in [0, 1], 0 on the
/// box's faces. The same input gives the same cloud on every machine, up to rounding in libm.
Grid makeCumulus(const CumulusInfo& info);

struct GradientInfo {
  std::array<uint32_t, 3> size{1, 1, 1};
  uint32_t axis = 0;
  /// Values in the first and last voxels along the axis, > 0; even steps of the logarithm between.
  double from = 1.0;
  double to = 1.0;
};

/// The same across the other axes; a box of 1 m.
Grid makeGradient(const GradientInfo& info);

struct SlabInfo {
  std::array<uint32_t, 3> size{32, 32, 32};
  /// Edges of the box in metres.
  Vec3 extent{1000.0, 1000.0, 1000.0};
  /// Distance from the faces across x, y and z over which the density rises to 1; 0: at once. m.
  Vec3 edge;
  /// Part of the density that noise may take away. [0, 1].
  double noise = 0.0;
  /// Size of the largest wisps, m.
  double noiseSize = 500.0;
  uint32_t seed = 1;
};

}  // namespace host
