// SPDX-License-Identifier: MIT
// Closed triangle meshes of clouds: shapes that are made, and what they fill as voxels. In m, y up.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

#include "common/vec.hpp"
#include "common/volume.hpp"

namespace host {

/// Every edge is walked once each way; triangles run counter-clockwise seen from outside.
struct CloudMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// About the origin; an octahedron whose triangles become four, `subdivisions` times.
struct SphereMesh {
  double radius = 500.0;
  /// [1, 9].
  uint32_t subdivisions = 5;
};
CloudMesh makeMesh(const SphereMesh& shape);

/// About the origin, each face a grid; a wide one is a slab.
struct BoxMesh {
  Vec3 extent{1000.0, 1000.0, 1000.0};
  /// Along x, y, z, each [1, 512].
  std::array<uint32_t, 3> cells{8, 8, 8};
};
CloudMesh makeMesh(const BoxMesh& shape);

/// A sheet about the origin in x and z, with a bumpy top and a flatter bottom that meet at its rim
/// at y = 0.
struct StratocumulusMesh {
  /// Width, greatest height above the rim, width.
  Vec3 extent{8000.0, 400.0, 8000.0};
  /// Along x and z, [4, 1024].
  uint32_t cells = 192;
  /// Of the largest bumps, m.
  double bumpSize = 1200.0;
  /// Part of the height that bumps take. [0, 1].
  double relief = 0.7;
  uint32_t seed = 1;
  /// s; bumps of each octave drift and change.
  double time = 0.0;
};
CloudMesh makeMesh(const StratocumulusMesh& shape);

/// Lobes over a flat base at y = 0, about the origin in x and z.
struct CumulusMesh {
  /// The bounding box, m.
  Vec3 extent{2000.0, 1400.0, 2000.0};
  /// [1, 64].
  uint32_t lobes = 24;
  /// Depth of the billows relative to the largest lobe's radius. [0, 0.4].
  double billows = 0.14;
  /// Lattice cells along the longest edge. [8, 256].
  uint32_t detail = 96;
  uint32_t seed = 1;
};
CloudMesh makeMesh(const CumulusMesh& shape);

/// Wavefront OBJ: all its objects together, polygons as triangles. Throws InputError: no file, not
/// OBJ, no faces, over 64 MiB.
struct MeshFile {
  std::filesystem::path file;
};
CloudMesh makeMesh(const MeshFile& shape);

using MeshShape = std::variant<SphereMesh, BoxMesh, StratocumulusMesh, CumulusMesh, MeshFile>;
CloudMesh makeMesh(const MeshShape& shape);

/// The part of each voxel that the mesh encloses, in its bounding box; `resolution` voxels along
/// the longest edge. Where the mesh meets itself, parts add.
Grid voxelise(const CloudMesh& mesh, uint32_t resolution);

/// The map from the unit box to the mesh's bounding box.
Affine boundsOf(const CloudMesh& mesh);

}  // namespace host
