// SPDX-License-Identifier: MIT
// Meshes from Wavefront OBJ files: the input is the file.
#include <algorithm>

#include "common/cloud_mesh.hpp"
#include "common/error.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::File file(data, size);
  try {
    const host::CloudMesh mesh = host::makeMesh(host::MeshFile{file.path()});
    fuzz::require(!mesh.triangles.empty(), "a mesh has triangles");
    for (const auto& triangle : mesh.triangles) {
      fuzz::require(
          std::ranges::all_of(triangle, [&](uint32_t i) { return i < mesh.positions.size(); }),
          "triangles name vertices");
    }
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  return 0;
}
