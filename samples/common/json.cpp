// SPDX-License-Identifier: MIT
#include "common/json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/text.hpp"

namespace host {
namespace {

constexpr size_t MAX_JSON_BYTES = size_t{16} << 20;
// Some operations of the JSON library recurse; no scene nests deeper than 8.
constexpr int MAX_JSON_DEPTH = 64;

Json parseJson(const std::string& text, const std::string& file) {
  const auto limitDepth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > MAX_JSON_DEPTH) {
      throw InputError(file, "", "expected at most 64 levels of nesting");
    }
    return true;
  };
  return Json::parse(text, limitDepth, true, true);
}

// "[json.exception.parse_error.101] parse error at line 1, ..." without the bracket.
std::string plainMessage(const Json::exception& e) {
  const std::string text = e.what();
  const size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

std::string shortDump(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > 40 ? text.substr(0, 37) + "..." : text;
}

std::string range(double low, double high) {
  const auto print = [](double x) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", x);
    return std::string(buffer);
  };
  if (low <= -3.4e38 && high >= 3.4e38) {
    return "expected a number";
  }
  return "expected a number in [" + print(low) + ", " + print(high) + "]";
}

}  // namespace

Json readJsonFile(const std::string& file) {
  const std::string text = readTextFile(file, MAX_JSON_BYTES, "JSON");
  try {
    return parseJson(text, file);
  } catch (const Json::exception& e) {
    throw InputError(file, "", "expected JSON: " + plainMessage(e));
  }
}

void setJsonValue(Json& root, const std::string& assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set", assignment, "expected key.path=value");
  }
  const std::string path = assignment.substr(0, equals);
  const std::string text = assignment.substr(equals + 1);
  Json* node = &root;
  int depth = 0;
  for (size_t begin = 0; begin <= path.size();) {
    const size_t end = std::min(path.find('.', begin), path.size());
    const std::string key = path.substr(begin, end - begin);
    if (key.empty() || ++depth > MAX_JSON_DEPTH) {
      throw InputError("--set", path, "expected names and indices joined by single dots");
    }
    if (node->is_array()) {
      const std::optional<double> index = parseNumber(key);
      if (!index || *index < 0.0 || *index >= static_cast<double>(node->size()) ||
          *index != std::floor(*index)) {
        throw InputError(
            "--set", path,
            "expected an index below " + std::to_string(node->size()) + ", got '" + key + "'");
      }
      node = &(*node)[static_cast<size_t>(*index)];
    } else if (node->is_object() || node->is_null()) {
      node = &(*node)[key];
    } else {
      throw InputError("--set", path, "'" + key + "' is inside a value, expected an object");
    }
    begin = end + 1;
  }
  try {
    *node = parseJson(text, "--set");
  } catch (const Json::exception&) {
    *node = text;
  }
}

JsonNode::JsonNode(const Json& value, std::string file, std::string path)
    : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

void JsonNode::fail(const std::string& expected) const {
  throw InputError(file_, path_, expected + ", got " + shortDump(*value_));
}

JsonNode JsonNode::child(const Json& value, const std::string& key) const {
  return {value, file_, path_.empty() ? key : path_ + "." + key};
}

void JsonNode::onlyKeys(std::initializer_list<const char*> keys) const {
  if (!value_->is_object()) {
    fail("expected an object");
  }
  for (const auto& [key, value] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      std::string list;
      for (const char* known : keys) {
        list += (list.empty() ? "" : ", ") + std::string(known);
      }
      throw InputError(file_, child(value, key).path(), "unknown key; expected one of " + list);
    }
  }
}

bool JsonNode::has(const char* key) const {
  if (!value_->is_object()) {
    fail("expected an object");
  }
  const auto found = value_->find(key);
  return found != value_->end() && !found->is_null();
}

bool JsonNode::isNull(const char* key) const {
  return value_->is_object() && value_->contains(key) && !has(key);
}

JsonNode JsonNode::at(const char* key) const {
  if (!has(key)) {
    throw InputError(file_, path_.empty() ? key : path_ + "." + key, "expected a value, got none");
  }
  return child(*value_->find(key), key);
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_->is_array()) {
    fail("expected an array");
  }
  std::vector<JsonNode> nodes;
  for (size_t i = 0; i < value_->size(); ++i) {
    nodes.push_back(child((*value_)[i], std::to_string(i)));
  }
  return nodes;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object()) {
    fail("expected an object");
  }
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& [key, value] : value_->items()) {
    nodes.emplace_back(key, child(value, key));
  }
  return nodes;
}

double JsonNode::finiteNumber(const Json& value, double low, double high) const {
  if (!value.is_number()) {
    fail(range(low, high));
  }
  const double number = value.get<double>();
  if (!(number >= low && number <= high)) {
    fail(range(low, high));
  }
  return number;
}

double JsonNode::number(double low, double high) const {
  return finiteNumber(*value_, low, high);
}

uint32_t JsonNode::count(uint32_t low, uint32_t high) const {
  const double number = value_->is_number() ? value_->get<double>() : -1.0;
  if (!(number >= low && number <= high) || number != std::floor(number)) {
    fail("expected a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  }
  return static_cast<uint32_t>(number);
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean()) {
    fail("expected true or false");
  }
  return value_->get<bool>();
}

std::string JsonNode::text() const {
  if (!value_->is_string()) {
    fail("expected a string");
  }
  return value_->get<std::string>();
}

bool JsonNode::isText() const {
  return value_->is_string();
}

Vec3 JsonNode::vec3() const {
  if (!value_->is_array() || value_->size() != 3) {
    fail("expected [x, y, z]");
  }
  const auto get = [&](size_t i) { return finiteNumber((*value_)[i], -3.4e38, 3.4e38); };
  return {get(0), get(1), get(2)};
}

Rgb JsonNode::rgb(double low, double high) const {
  if (value_->is_number()) {
    const auto grey = static_cast<float>(finiteNumber(*value_, low, high));
    return {grey, grey, grey};
  }
  if (!value_->is_array() || value_->size() != 3) {
    fail("expected a number or [r, g, b]");
  }
  Rgb rgb{};
  for (size_t i = 0; i < 3; ++i) {
    rgb[i] = static_cast<float>(finiteNumber((*value_)[i], low, high));
  }
  return rgb;
}

uint32_t JsonNode::word(std::initializer_list<const char*> words) const {
  std::string list;
  uint32_t index = 0;
  for (const char* known : words) {
    if (value_->is_string() && *value_ == known) {
      return index;
    }
    list += (index++ == 0 ? "" : ", ") + std::string(known);
  }
  fail("expected one of " + list);
}

void JsonNode::optional(const char* key, float& target) const {
  if (has(key)) {
    target = static_cast<float>(at(key).number());
  }
}

void JsonNode::optional(const char* key, double& target, double low, double high) const {
  if (has(key)) {
    target = at(key).number(low, high);
  }
}

void JsonNode::optional(const char* key, uint32_t& target) const {
  if (has(key)) {
    target = at(key).count();
  }
}

void JsonNode::optional(const char* key, Vec3& target) const {
  if (has(key)) {
    target = at(key).vec3();
  }
}

void JsonNode::optional(const char* key, Rgb& target, double low, double high) const {
  if (has(key)) {
    target = at(key).rgb(low, high);
  }
}

void JsonNode::optional(const char* key, float (&target)[3]) const {
  if (has(key)) {
    const Rgb rgb = at(key).rgb();
    std::copy(rgb.begin(), rgb.end(), target);
  }
}

}  // namespace host
