// SPDX-License-Identifier: MIT
// OpenVDB grids. The only file that sees OpenVDB's headers: they cost most of a compile minute.
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "common/error.hpp"
#include "common/sparse_grid.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

// Reads through a stream that throws at its end: io::File believes the counts of a cut-off or
// corrupt file and loops over billions of grids that are not there.
openvdb::GridPtrVecPtr readGrids(const std::string& file) {
  openvdb::initialize();
  std::ifstream stream(file, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
  // Of versions that it does not know the library reads on, after a warning.
  struct {
    int64_t magic;
    uint32_t version;
  } head{};
  stream.read(reinterpret_cast<char*>(&head.magic), sizeof head.magic);
  stream.read(reinterpret_cast<char*>(&head.version), sizeof head.version);
  if (head.magic != openvdb::OPENVDB_MAGIC || head.version > openvdb::OPENVDB_FILE_VERSION) {
    throw std::runtime_error("magic number or version are not known");
  }
  stream.seekg(0);
  return openvdb::io::Stream(stream, false).getGrids();
}

openvdb::FloatGrid::Ptr findGrid(const std::string& file, const openvdb::GridPtrVecPtr& grids,
                                 const std::string& wanted) {
  std::string names;
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
  throw InputError(file, "grid", "expected a grid named '" + wanted + "'; the file has: " + names);
}

// OpenVDB reports by its own exceptions, which derive from std::exception.
openvdb::GridPtrVecPtr checkedGrids(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(path.string(), "", "no such file; expected an OpenVDB file");
  }
  try {
    return readGrids(path.string());
  } catch (const std::exception& e) {
    throw InputError(path.string(), "", std::string("expected an OpenVDB file: ") + e.what());
  }
}

// The box of all active voxels; fails for what cannot be placed.
openvdb::CoordBBox activeBox(const std::string& file, const std::string& name,
                             const openvdb::FloatGrid& grid) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) {
    throw InputError(file, "grid '" + name + "'", "expected at least one active voxel");
  }
  if (!grid.transform().isLinear()) {
    throw InputError(file, "grid '" + name + "'", "expected a linear transform");
  }
  return box;
}

// Where a box of voxels of the index space lies in the world.
Affine placeBox(const openvdb::FloatGrid& grid, const openvdb::Coord& first,
                const openvdb::Vec3d& edges, UpAxis up) {
  const openvdb::Vec3d corner = first.asVec3d() - openvdb::Vec3d(0.5);
  const auto world = [&](const openvdb::Vec3d& index) {
    const openvdb::Vec3d p = grid.transform().indexToWorld(index);
    return worldAxes({p.x(), p.y(), p.z()}, up);
  };
  const Vec3 origin = world(corner);
  const auto edge = [&](double x, double y, double z) {
    return world(corner + openvdb::Vec3d(x, y, z)) - origin;
  };
  return affineFromEdges(origin, edge(edges.x(), 0.0, 0.0), edge(0.0, edges.y(), 0.0),
                         edge(0.0, 0.0, edges.z()));
}

static_assert(openvdb::FloatTree::LeafNodeType::DIM == LEAF_EDGE);

// Leaves have z fastest there, x here.
SparseGrid sparseOf(const std::string& file, openvdb::FloatGrid& source) {
  const std::string name = source.getName();
  const openvdb::CoordBBox box = activeBox(file, name, source);
  SparseGrid grid;
  for (size_t i = 0; i < 3; ++i) {
    grid.low[i] = box.min()[i];
    grid.high[i] = box.max()[i];
  }
  const auto world = [&](double x, double y, double z) {
    const openvdb::Vec3d p = source.transform().indexToWorld(openvdb::Vec3d(x, y, z));
    return Vec3{p.x(), p.y(), p.z()};
  };
  const Vec3 origin = world(0, 0, 0);
  grid.worldFromIndex = affineFromEdges(origin, world(1, 0, 0) - origin, world(0, 1, 0) - origin,
                                        world(0, 0, 1) - origin);
  grid.background = source.background();
  // Tiles are constant over many leaves: each becomes the leaves that it covers.
  if (source.activeVoxelCount() > MAX_VOXELS) {
    throw InputError(file, "grid '" + name + "'",
                     "expected at most " + std::to_string(MAX_VOXELS) + " active voxels");
  }
  source.tree().voxelizeActiveTiles();
  constexpr openvdb::Index EDGE = LEAF_EDGE;
  for (auto leaf = source.tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->onVoxelCount() == 0) {
      continue;
    }
    const openvdb::Coord& first = leaf->origin();
    grid.leaves.push_back({first.x(), first.y(), first.z()});
    for (openvdb::Index n = 0; n < EDGE * EDGE * EDGE; ++n) {
      const openvdb::Index x = n % EDGE;
      const openvdb::Index y = n / EDGE % EDGE;
      const openvdb::Index z = n / (EDGE * EDGE);
      grid.values.push_back(leaf->getValue((x * EDGE + y) * EDGE + z));
    }
  }
  return grid;
}

}  // namespace

Grid loadVdb(const std::filesystem::path& path, const VdbInfo& info) {
  if (isNanoVdb(path)) {
    throw InputError(path.string(), "",
                     "expected an OpenVDB file: one of NanoVDB gives bricks only");
  }
  const std::string file = path.string();
  const openvdb::FloatGrid::Ptr source = findGrid(file, checkedGrids(path), info.grid);
  const openvdb::CoordBBox box = activeBox(file, info.grid, *source);
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
  grid.worldFromVolume =
      placeBox(*source, box.min(), {double(edges[0]), double(edges[1]), double(edges[2])}, info.up);
  return grid;
}

std::vector<SparseGrid> readOpenVdb(const std::filesystem::path& path,
                                    const std::vector<std::string>& names) {
  const openvdb::GridPtrVecPtr grids = checkedGrids(path);
  std::vector<SparseGrid> result;
  for (const std::string& name : names) {
    result.push_back(sparseOf(path.string(), *findGrid(path.string(), grids, name)));
  }
  return result;
}

}  // namespace host
