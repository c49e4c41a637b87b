// SPDX-License-Identifier: MIT
// NanoVDB files as bricks. The magic is put in front: OpenVDB's reader is not for such files.
#include <vector>

#include "common/error.hpp"
#include "common/volume.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr char MAGIC[] = "NanoVDB";
  std::vector<uint8_t> bytes(MAGIC, MAGIC + sizeof MAGIC - 1);
  if (size > bytes.size()) {
    bytes.insert(bytes.end(), data + bytes.size(), data + size);
  }
  const fuzz::File file(bytes.data(), bytes.size());
  try {
    const host::BrickVolume volume =
        host::loadVdbBricks({{file.path(), {"density", host::UpAxis::Y}}});
    const host::BrickField& field = volume.fields.at(0);
    fuzz::require(field.values.size() == field.coordinates.size() / 3 * 512,
                  "512 values for each brick");
    for (size_t i = 0; i < field.coordinates.size(); ++i) {
      fuzz::require(field.coordinates[i] < (volume.size[i % 3] + 7) / 8,
                    "bricks lie in the volume");
    }
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  return 0;
}
