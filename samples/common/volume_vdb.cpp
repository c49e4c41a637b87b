// SPDX-License-Identifier: MIT
// OpenVDB grids. The only file that sees OpenVDB's headers: they cost most of a compile minute.
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <fstream>
#include <map>
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

constexpr int BRICK = 8;  // edge of OpenVDB's leaves as well
static_assert(openvdb::FloatTree::LeafNodeType::DIM == BRICK);

// Leaves have z fastest, bricks x.
BrickField bricksOf(const openvdb::FloatGrid& grid, const openvdb::Coord& first) {
  BrickField field;
  field.coordinates.reserve(3 * size_t{grid.tree().leafCount()});
  field.values.reserve(size_t{BRICK * BRICK * BRICK} * grid.tree().leafCount());
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->onVoxelCount() == 0) {
      continue;
    }
    const openvdb::Coord brick = leaf->origin() - first;
    for (size_t axis = 0; axis < 3; ++axis) {
      field.coordinates.push_back(static_cast<uint32_t>(brick[axis] / BRICK));
    }
    for (openvdb::Index n = 0; n < BRICK * BRICK * BRICK; ++n) {
      const openvdb::Index x = n % BRICK;
      const openvdb::Index y = n / BRICK % BRICK;
      const openvdb::Index z = n / (BRICK * BRICK);
      field.values.push_back(leaf->getValue((x * BRICK + y) * BRICK + z));
    }
  }
  return field;
}

}  // namespace

Grid loadVdb(const std::filesystem::path& path, const VdbInfo& info) {
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

BrickVolume loadVdbBricks(const std::vector<VdbSource>& sources) {
  std::map<std::filesystem::path, openvdb::GridPtrVecPtr> files;
  std::vector<openvdb::FloatGrid::Ptr> grids;
  openvdb::CoordBBox active;
  for (const VdbSource& source : sources) {
    const std::string file = source.file.string();
    if (!files.contains(source.file)) {
      files[source.file] = checkedGrids(source.file);
    }
    const std::string& name = source.info.grid;
    const openvdb::FloatGrid::Ptr grid = findGrid(file, files[source.file], name);
    active.expand(activeBox(file, name, *grid));
    if (grid->background() != 0.0f) {
      throw InputError(file, "grid '" + name + "'", "expected a background of 0");
    }
    if (source.info.up != sources[0].info.up ||
        (!grids.empty() && grid->transform() != grids[0]->transform())) {
      throw InputError(file, "grid '" + name + "'", "expected the transform of field 0");
    }
    grids.push_back(grid);
  }
  BrickVolume volume;
  openvdb::Coord first;
  openvdb::Vec3d activeEdges;
  Vec3 low;
  uint64_t bricks = 1;
  const std::array<double*, 3> lows{&low.x, &low.y, &low.z};
  for (size_t i = 0; i < 3; ++i) {
    const auto down = [](int64_t index) {
      return index >= 0 ? index / BRICK : (index - BRICK + 1) / BRICK;
    };
    const int64_t begin = down(active.min()[i]);
    const int64_t end = down(active.max()[i]) + 1;
    const auto count = static_cast<uint64_t>(end - begin);
    if (count > MAX_BRICKS || bricks * count > MAX_BRICKS) {
      throw InputError(sources[0].file.string(), "size",
                       "expected at most " + std::to_string(MAX_BRICKS) +
                           " bricks of 8^3 voxels around the active voxels");
    }
    bricks *= count;
    first[i] = static_cast<int>(begin * BRICK);
    volume.size[i] = static_cast<uint32_t>(count * BRICK);
    activeEdges[static_cast<int>(i)] =
        static_cast<double>(int64_t{active.max()[i]} - active.min()[i] + 1);
    *lows[i] = (first[i] - active.min()[i]) / activeEdges[static_cast<int>(i)];
  }
  volume.worldFromActive = placeBox(*grids[0], active.min(), activeEdges, sources[0].info.up);
  volume.activeFromVolume = affineFromEdges(low, {volume.size[0] / activeEdges.x(), 0.0, 0.0},
                                            {0.0, volume.size[1] / activeEdges.y(), 0.0},
                                            {0.0, 0.0, volume.size[2] / activeEdges.z()});
  for (const openvdb::FloatGrid::Ptr& grid : grids) {
    // Tiles are constant over many leaves: each becomes the bricks that it covers.
    if (grid->activeVoxelCount() > MAX_VOXELS) {
      throw InputError(sources[0].file.string(), "grid '" + grid->getName() + "'",
                       "expected at most " + std::to_string(MAX_VOXELS) + " active voxels");
    }
    grid->tree().voxelizeActiveTiles();
    volume.fields.push_back(bricksOf(*grid, first));
  }
  return volume;
}

}  // namespace host
