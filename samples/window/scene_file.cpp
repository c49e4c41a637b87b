// SPDX-License-Identifier: MIT
#include "scene_file.hpp"

#include <nlohmann/json.hpp>

host::Scene readScene(const std::string& file) {
  return host::parseScene(host::readSceneJson(file, {}), file);
}
