// SPDX-License-Identifier: MIT
// OpenVDB grids. The only file that sees OpenVDB's headers: they cost most of a compile minute.
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <fstream>
#include <string>

#include "common/error.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

// Reads through a stream that throws at its end: io::File believes the counts of a cut-off or
// corrupt file and loops over billions of grids that are not there.
openvdb::GridPtrVecPtr readGrids(const std::string& file) {
  openvdb::initialize();
  std::ifstream stream(file, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
  return openvdb::io::Stream(stream, false).getGrids();
}

// OpenVDB reports by its own exceptions, which derive from std::exception.
openvdb::FloatGrid::Ptr readGrid(const std::string& file, const std::string& wanted) {
  try {
    std::string names;
    const openvdb::GridPtrVecPtr grids = readGrids(file);
    for (const openvdb::GridBase::Ptr& base : *grids) {
      names += (names.empty() ? "" : ", ") + base->getName();
      if (base->getName() != wanted) {
        continue;
      }
      auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(base);
      if (!grid) {
        throw InputError(file, "grid '" + wanted + "'", "expected a grid of floats");
      }
      return grid;
    }
    throw InputError(file, "grid",
                     "expected a grid named '" + wanted + "'; the file has: " + names);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(file, "", std::string("expected an OpenVDB file: ") + e.what());
  }
}

}  // namespace

Grid loadVdb(const std::filesystem::path& path, const VdbInfo& info) {
  const std::string file = path.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(file, "", "no such file; expected an OpenVDB file");
  }
  const openvdb::FloatGrid::Ptr source = readGrid(file, info.grid);
  const openvdb::CoordBBox box = source->evalActiveVoxelBoundingBox();
  if (box.empty()) {
    throw InputError(file, "grid '" + info.grid + "'", "expected at least one active voxel");
  }
  if (!source->transform().isLinear()) {
    throw InputError(file, "grid '" + info.grid + "'", "expected a linear transform");
  }
  Grid grid;
  std::array<uint64_t, 3> edges{};
  for (size_t i = 0; i < 3; ++i) {
    // In 64 bits: a corrupt box may span all of int.
    edges[i] = static_cast<uint64_t>(int64_t{box.max()[i]} - int64_t{box.min()[i]} + 1);
  }
  grid.values.resize(checkedVoxelCount(file, edges));
  for (size_t i = 0; i < 3; ++i) {
    grid.size[i] = static_cast<uint32_t>(edges[i]);
  }
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, grid.values.data());
  openvdb::tools::copyToDense(*source, dense);

  const openvdb::Vec3d corner = box.min().asVec3d() - openvdb::Vec3d(0.5);
  const auto world = [&](const openvdb::Vec3d& index) {
    const openvdb::Vec3d p = source->transform().indexToWorld(index);
    return worldAxes({p.x(), p.y(), p.z()}, info.up);
  };
  const Vec3 origin = world(corner);
  const auto edge = [&](double x, double y, double z) {
    return world(corner + openvdb::Vec3d(x, y, z)) - origin;
  };
  grid.worldFromVolume =
      affineFromEdges(origin, edge(grid.size[0], 0.0, 0.0), edge(0.0, grid.size[1], 0.0),
                      edge(0.0, 0.0, grid.size[2]));
  return grid;
}

}  // namespace host
