// SPDX-License-Identifier: MIT
// The grids of OpenVDB and NanoVDB files as the leaves that they store.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/vec.hpp"

namespace host {

constexpr int LEAF_EDGE = 8;  // voxels

struct SparseGrid {
  /// First and last active voxel along the axes.
  std::array<int64_t, 3> low{};
  std::array<int64_t, 3> high{};
  /// In the data's axes: of index space, where values lie at whole numbers.
  Affine worldFromIndex{};
  float background = 0.0f;
  /// First voxels, and LEAF_EDGE^3 values each, x fastest.
  std::vector<std::array<int64_t, 3>> leaves;
  std::vector<float> values;
};

/// The file begins as NanoVDB's do.
bool isNanoVdb(const std::filesystem::path& file);

/// Grids of floats, by name. Throw InputError.
std::vector<SparseGrid> readOpenVdb(const std::filesystem::path& file,
                                    const std::vector<std::string>& names);
std::vector<SparseGrid> readNanoVdb(const std::filesystem::path& file,
                                    const std::vector<std::string>& names);

}  // namespace host
