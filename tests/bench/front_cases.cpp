// SPDX-License-Identifier: MIT
#include "bench/front_cases.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/error.hpp"

namespace bench {
namespace {

std::vector<std::string> textsOf(const host::JsonNode& node, const char* key) {
  std::vector<std::string> texts;
  if (node.has(key)) {
    for (const host::JsonNode& item : node.at(key).elements()) {
      texts.push_back(item.text());
    }
  }
  return texts;
}

Case parseCase(const host::JsonNode& node) {
  node.onlyKeys({"name", "scene", "overrides", "analytic", "size", "samples", "flip", "curves",
                 "timedWidth", "ultraInTests"});
  Case one;
  one.name = node.at("name").text();
  const auto folder = std::filesystem::path(node.file()).parent_path();
  one.scene = (folder / node.at("scene").text()).lexically_normal().string();
  one.overrides = textsOf(node, "overrides");
  one.analytic = textsOf(node, "analytic");
  const std::vector<host::JsonNode> size = node.at("size").elements();
  const std::vector<host::JsonNode> samples = node.at("samples").elements();
  const std::vector<host::JsonNode> flip = node.at("flip").elements();
  if (size.size() != 2 || samples.size() != 2 || flip.size() != 3) {
    node.fail("expected size [width, height], samples [all, single], flip [start, stop, count]");
  }
  one.width = size[0].count(1, host::MAX_IMAGE_EDGE);
  one.height = size[1].count(1, host::MAX_IMAGE_EDGE);
  one.samplesAll = samples[0].count(1);
  one.samplesSingle = samples[1].count(1);
  one.curves = node.has("curves") && node.at("curves").boolean();
  one.ultraInTests = node.has("ultraInTests") && node.at("ultraInTests").boolean();
  if (node.has("timedWidth")) {
    one.timedWidth = node.at("timedWidth").count(1, host::MAX_IMAGE_EDGE);
  }
  one.flipStart = flip[0].number(-60.0, 60.0);
  one.flipStop = flip[1].number(one.flipStart, 60.0);
  one.flipCount = flip[2].count(1, 64);
  return one;
}

}  // namespace

std::vector<Case> readCases(const std::string& file) {
  const host::Json json = host::readJsonFile(file);
  const host::JsonNode root(json, file);
  root.onlyKeys({"description", "cases"});
  std::vector<Case> cases;
  for (const host::JsonNode& node : root.at("cases").elements()) {
    cases.push_back(parseCase(node));
    const auto same = [&](const Case& other) { return other.name == cases.back().name; };
    if (std::count_if(cases.begin(), cases.end(), same) != 1) {
      node.at("name").fail("expected a name of its own");
    }
  }
  return cases;
}

std::vector<std::string> assignmentsOf(const Case& one) {
  std::vector<std::string> assignments = one.overrides;
  assignments.emplace_back("quality=null");
  assignments.push_back("view.size=[" + std::to_string(one.width) + "," +
                        std::to_string(one.height) + "]");
  return assignments;
}

host::Scene sceneOf(const Case& one, bool analytic) {
  std::vector<std::string> assignments = assignmentsOf(one);
  if (analytic) {
    assignments.insert(assignments.end(), one.analytic.begin(), one.analytic.end());
  }
  return host::parseScene(host::readSceneJson(one.scene, assignments), one.scene);
}

bool hasVolumes(const Case& one) {
  return !sceneOf(one, false).volumes.empty();
}

}  // namespace bench
