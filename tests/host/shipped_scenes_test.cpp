// SPDX-License-Identifier: MIT
// Every scene under samples/scenes parses, so that a renamed key cannot rot one.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/scene.hpp"

namespace {

std::vector<std::string> shippedScenes() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(WELKIN_SCENES)) {
    if (entry.path().extension() == ".json") {
      files.push_back(entry.path().filename().string());
    }
  }
  return files;
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, ParsesAndHasALight) {
  const std::string file = (std::filesystem::path(WELKIN_SCENES) / GetParam()).string();
  const host::Scene scene = host::parseScene(host::readSceneJson(file, {}), file);
  EXPECT_FALSE(scene.lights.empty());
}

std::string caseName(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param.substr(0, scene.param.find('.'));
  for (char& c : name) {
    c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(shippedScenes()), caseName);

}  // namespace
