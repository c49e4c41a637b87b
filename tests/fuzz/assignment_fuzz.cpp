// SPDX-License-Identifier: MIT
// `--set key.path=value` on a scene: lines of the input are assignments.
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/json.hpp"
#include "common/text.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  host::Json root = {{"lights", {{{"irradiance", {1, 1, 1}}}}}, {"camera", {{"pitch_deg", 3}}}};
  const std::string text(reinterpret_cast<const char*>(data), size);
  size_t position = 0;
  std::string_view line;
  while (host::nextLine(text, position, line)) {
    try {
      host::setJsonValue(root, std::string(line));
    } catch (const host::InputError&) {
      // What is expected of most inputs.
    }
  }
  fuzz::require(root.is_object(), "assignments keep the scene an object");
  return 0;
}
