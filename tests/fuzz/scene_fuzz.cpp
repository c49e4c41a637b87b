// SPDX-License-Identifier: MIT
// Scene files: whatever they hold, the host gives a scene or an InputError.
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/scene.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::File file(data, size);
  try {
    const host::Scene scene = host::parseScene(host::readSceneJson(file.path(), {}), "scene.json");
    fuzz::require(scene.lights.size() <= 1024, "the number of lights is bounded by the file");
    for (const host::VolumeDesc& volume : scene.volumes) {
      for (const host::FieldDesc& field : volume.fields) {
        fuzz::require(field.medium < scene.media.size(), "a field's medium exists");
      }
    }
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  return 0;
}
