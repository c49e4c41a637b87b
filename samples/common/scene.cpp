// SPDX-License-Identifier: MIT
// From a scene file to a scene: bases, assignments, sections.
#include "common/scene.hpp"

#include <nlohmann/json.hpp>

#include "common/api.hpp"
#include "common/error.hpp"

namespace host {
namespace {

constexpr int MAX_BASES = 8;

Json readWithBases(const std::string& file, int depth) {
  Json own = readJsonFile(file);
  if (!own.is_object()) {
    throw InputError(file, "", "expected a JSON object");
  }
  const auto found = own.find("base");
  if (found == own.end() || found->is_null()) {
    return own;
  }
  if (depth == MAX_BASES) {
    throw InputError(file, "base", "expected at most 8 files, one based on the next");
  }
  const std::string base = resolvePath(JsonNode(own, file).at("base")).string();
  own.erase("base");
  Json merged = readWithBases(base, depth + 1);
  merged.merge_patch(own);
  // A patch drops a null; here the section is taken away, from `atmosphere` too.
  for (const auto& [key, value] : own.items()) {
    if (value.is_null()) {
      merged[key] = nullptr;
    }
  }
  return merged;
}

}  // namespace

std::filesystem::path resolvePath(const JsonNode& node) {
  const std::filesystem::path path = node.text();
  if (path.empty()) {
    node.fail("expected a file name");
  }
  const std::filesystem::path besideScene = std::filesystem::path(node.file()).parent_path() / path;
  std::error_code error;
  // A path given with --set is meant from where the user stands.
  return path.is_relative() && !std::filesystem::exists(besideScene, error) &&
                 std::filesystem::exists(path, error)
             ? path
             : besideScene;
}

Json readSceneJson(const std::string& file, const std::vector<std::string>& assignments) {
  Json root = readWithBases(file, 0);
  for (const std::string& assignment : assignments) {
    setJsonValue(root, assignment);
  }
  return root;
}

Scene parseScene(const Json& json, const std::string& file) {
  const JsonNode root(json, file);
  root.onlyKeys({"description", "atmosphere", "planet", "sky", "absorber", "ambient", "lights",
                 "fog", "media", "volumes", "surfaces", "quality", "view", "camera", "opaque",
                 "png"});
  Scene scene;
  scene.file = file;
  parseVolumes(root, scene);
  parseSurfaces(root, scene);
  parseWorld(root, scene);
  parseView(root, scene);
  if (scene.geometry && scene.geometry->terrain && scene.planet.up[1] < 0.999999f) {
    throw InputError(file, "planet.up", "expected [0, 1, 0] in a scene with terrain");
  }
  return scene;
}

}  // namespace host
