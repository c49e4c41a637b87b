// SPDX-License-Identifier: MIT
// A JSON value that knows its file and key path, so that every complaint can name them.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/vec.hpp"

namespace host {

using Json = nlohmann::json;

/// Reads a JSON file (comments allowed, depth at most 64). Throws InputError with line and column.
Json readJsonFile(const std::string& file);

/// Sets the value at a path such as "lights.0.irradiance": objects grow new keys, arrays don't grow
/// new elements. `value` is JSON if it parses as JSON, else a string.
void setJsonValue(Json& root, const std::string& assignment);

/// Read access with types checked; every function throws InputError naming the key path.
class JsonNode {
 public:
  JsonNode(const Json& value, std::string file, std::string path = "");

  /// Rejects an object with other keys than these, and anything that is no object.
  void onlyKeys(std::initializer_list<const char*> keys) const;
  /// True if the key is there and not null.
  [[nodiscard]] bool has(const char* key) const;
  /// True if the key is there and null: taken away rather than left out.
  [[nodiscard]] bool isNull(const char* key) const;
  /// The child, which must be there.
  [[nodiscard]] JsonNode at(const char* key) const;
  /// The elements; must be an array.
  [[nodiscard]] std::vector<JsonNode> elements() const;
  /// The members; must be an object.
  [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> members() const;

  /// A finite number within float range in [low, high].
  [[nodiscard]] double number(double low = -3.4e38, double high = 3.4e38) const;
  [[nodiscard]] uint32_t count(uint32_t low = 0, uint32_t high = UINT32_MAX) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool isText() const;
  /// [x, y, z].
  [[nodiscard]] Vec3 vec3() const;
  /// [r, g, b], or one number for grey.
  [[nodiscard]] Rgb rgb(double low = -3.4e38, double high = 3.4e38) const;
  /// Index of a word in `words`.
  [[nodiscard]] uint32_t word(std::initializer_list<const char*> words) const;

  /// Overwrites `target` if the key is there.
  void optional(const char* key, float& target) const;
  void optional(const char* key, double& target, double low, double high) const;
  void optional(const char* key, uint32_t& target) const;
  void optional(const char* key, Vec3& target) const;
  void optional(const char* key, Rgb& target, double low, double high) const;
  void optional(const char* key, float (&target)[3]) const;

  [[noreturn]] void fail(const std::string& expected) const;
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[nodiscard]] JsonNode child(const Json& value, const std::string& key) const;
  [[nodiscard]] double finiteNumber(const Json& value, double low, double high) const;

  const Json* value_;
  std::string file_;
  std::string path_;
};

}  // namespace host
