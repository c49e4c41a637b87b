// SPDX-License-Identifier: MIT
// Sparse grids of files as the bricks of one volume.
#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.hpp"
#include "common/sparse_grid.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

// The grids that several sources want of one file, read at once; each to its source's place.
std::vector<SparseGrid> readAll(const std::vector<VdbSource>& sources) {
  std::vector<SparseGrid> grids(sources.size());
  std::vector<bool> done(sources.size());
  for (size_t i = 0; i < sources.size(); ++i) {
    if (done[i]) {
      continue;
    }
    std::vector<size_t> places;
    std::vector<std::string> names;
    for (size_t k = i; k < sources.size(); ++k) {
      if (sources[k].file == sources[i].file) {
        done[k] = true;
        places.push_back(k);
        names.push_back(sources[k].info.grid);
      }
    }
    std::vector<SparseGrid> read = isNanoVdb(sources[i].file) ? readNanoVdb(sources[i].file, names)
                                                              : readOpenVdb(sources[i].file, names);
    for (size_t k = 0; k < places.size(); ++k) {
      grids[places[k]] = std::move(read[k]);
    }
  }
  return grids;
}

bool sameTransform(const Affine& a, const Affine& b) {
  // Files keep doubles; relative to the largest element.
  const double largest = std::abs(*std::max_element(
      a.begin(), a.end(), [](double x, double y) { return std::abs(x) < std::abs(y); }));
  return std::equal(a.begin(), a.end(), b.begin(),
                    [&](double x, double y) { return std::abs(x - y) <= 1e-9 * largest; });
}

int64_t leafBefore(int64_t index) {
  return index & ~int64_t{LEAF_EDGE - 1};
}

}  // namespace

BrickVolume loadVdbBricks(const std::vector<VdbSource>& sources) {
  const std::vector<SparseGrid> grids = readAll(sources);
  std::array<int64_t, 3> low = grids[0].low;
  std::array<int64_t, 3> high = grids[0].high;
  for (size_t f = 0; f < grids.size(); ++f) {
    const std::string key = "grid '" + sources[f].info.grid + "'";
    if (grids[f].background != 0.0f) {
      throw InputError(sources[f].file.string(), key, "expected a background of 0");
    }
    if (sources[f].info.up != sources[0].info.up ||
        !sameTransform(grids[f].worldFromIndex, grids[0].worldFromIndex)) {
      throw InputError(sources[f].file.string(), key, "expected the transform of field 0");
    }
    for (size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], grids[f].low[i]);
      high[i] = std::max(high[i], grids[f].high[i]);
    }
  }
  BrickVolume volume;
  std::array<int64_t, 3> first{};
  std::array<double, 3> active{};
  std::array<double, 3> offset{};
  uint64_t bricks = 1;
  for (size_t i = 0; i < 3; ++i) {
    first[i] = leafBefore(low[i]);
    const auto count = static_cast<uint64_t>((leafBefore(high[i]) - first[i]) / LEAF_EDGE + 1);
    if (low[i] > high[i] || count > MAX_BRICKS || bricks * count > MAX_BRICKS) {
      throw InputError(sources[0].file.string(), "size",
                       "expected at most " + std::to_string(MAX_BRICKS) +
                           " bricks of 8^3 voxels around the active voxels");
    }
    bricks *= count;
    volume.size[i] = static_cast<uint32_t>(count * LEAF_EDGE);
    active[i] = static_cast<double>(high[i] - low[i] + 1);
    offset[i] = static_cast<double>(first[i] - low[i]) / active[i];
  }
  // A value at a whole number is the middle of its voxel.
  const auto world = [&](double x, double y, double z) {
    const Vec3 index{static_cast<double>(low[0]) - 0.5 + x, static_cast<double>(low[1]) - 0.5 + y,
                     static_cast<double>(low[2]) - 0.5 + z};
    return worldAxes(transformPoint(grids[0].worldFromIndex, index), sources[0].info.up);
  };
  const Vec3 origin = world(0, 0, 0);
  volume.worldFromActive =
      affineFromEdges(origin, world(active[0], 0, 0) - origin, world(0, active[1], 0) - origin,
                      world(0, 0, active[2]) - origin);
  volume.activeFromVolume =
      affineFromEdges({offset[0], offset[1], offset[2]}, {volume.size[0] / active[0], 0, 0},
                      {0, volume.size[1] / active[1], 0}, {0, 0, volume.size[2] / active[2]});
  for (size_t f = 0; f < grids.size(); ++f) {
    BrickField field;
    for (const std::array<int64_t, 3>& leaf : grids[f].leaves) {
      for (size_t i = 0; i < 3; ++i) {
        const int64_t brick = (leaf[i] - first[i]) / LEAF_EDGE;
        if (leaf[i] < first[i] || brick * LEAF_EDGE >= volume.size[i]) {
          throw InputError(sources[f].file.string(), "grid '" + sources[f].info.grid + "'",
                           "expected leaves inside the box of active voxels");
        }
        field.coordinates.push_back(static_cast<uint32_t>(brick));
      }
    }
    field.values = grids[f].values;
    volume.fields.push_back(std::move(field));
  }
  return volume;
}

}  // namespace host
