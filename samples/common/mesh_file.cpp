// SPDX-License-Identifier: MIT
// Wavefront OBJ by tinyobjloader.
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/cloud_mesh.hpp"
#include "common/error.hpp"

namespace host {

CloudMesh makeMesh(const MeshFile& shape) {
  const std::filesystem::path& file = shape.file;
  constexpr uintmax_t MOST_BYTES = uintmax_t{64} << 20;
  const std::string name = file.string();
  std::error_code code;
  const uintmax_t bytes = std::filesystem::file_size(file, code);
  std::ifstream stream(file);
  if (code || !stream) {
    throw InputError(name, "", "expected a readable file");
  }
  if (bytes > MOST_BYTES) {
    throw InputError(name, "", "expected at most 64 MiB");
  }
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::string warnings;
  std::string errors;
  // No materials: null.
  const bool read =
      tinyobj::LoadObj(&attributes, &shapes, nullptr, &warnings, &errors, &stream, nullptr,
                       /*triangulate*/ true, /*default_vcols_fallback*/ false);
  if (!read) {
    throw InputError(name, "", errors.empty() ? "expected Wavefront OBJ" : errors);
  }
  CloudMesh mesh;
  const std::vector<tinyobj::real_t>& places = attributes.vertices;
  for (size_t i = 0; i + 2 < places.size(); i += 3) {
    mesh.positions.push_back({static_cast<float>(places[i]), static_cast<float>(places[i + 1]),
                              static_cast<float>(places[i + 2])});
  }
  const auto vertexOf = [&](const tinyobj::index_t& index) {
    const int vertex = index.vertex_index;
    if (vertex < 0 || static_cast<size_t>(vertex) >= mesh.positions.size()) {
      throw InputError(name, "", "a face names a vertex that is not there");
    }
    return static_cast<uint32_t>(vertex);
  };
  for (const tinyobj::shape_t& part : shapes) {
    const std::vector<tinyobj::index_t>& indices = part.mesh.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
      mesh.triangles.push_back(
          {vertexOf(indices[i]), vertexOf(indices[i + 1]), vertexOf(indices[i + 2])});
    }
  }
  if (mesh.triangles.empty()) {
    throw InputError(name, "", "expected faces");
  }
  return mesh;
}

}  // namespace host
