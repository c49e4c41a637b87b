// SPDX-License-Identifier: MIT
#include "common/text.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "common/error.hpp"

namespace host {
namespace {

constexpr std::string_view BLANKS = " \t\r\f\v";

std::string_view trim(std::string_view text) {
  const size_t first = text.find_first_not_of(BLANKS);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(BLANKS) - first + 1);
}

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  text = trim(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);  // from_chars takes no plus sign
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || std::isnan(value)) {
    return std::nullopt;
  }
  return value;
}

std::string formatNumber(double value) {
  char buffer[40];
  const int length = std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return {buffer, static_cast<size_t>(length)};
}

std::vector<std::string_view> splitWords(std::string_view line) {
  std::vector<std::string_view> words;
  size_t position = 0;
  while ((position = line.find_first_not_of(BLANKS, position)) != std::string_view::npos) {
    const size_t end = std::min(line.find_first_of(BLANKS, position), line.size());
    words.push_back(line.substr(position, end - position));
    position = end;
  }
  return words;
}

std::vector<std::string_view> splitCommas(std::string_view line) {
  std::vector<std::string_view> parts;
  size_t begin = 0;
  for (size_t comma = 0; comma != std::string_view::npos; begin = comma + 1) {
    comma = line.find(',', begin);
    parts.push_back(trim(line.substr(begin, comma - begin)));
  }
  return parts;
}

std::string readTextFile(const std::string& file, size_t maxBytes, const std::string& kind) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(file, "", "no such file; expected " + kind);
  }
  const uintmax_t length = std::filesystem::file_size(file, error);
  if (error || length > maxBytes) {
    throw InputError(file, "", "expected at most " + std::to_string(maxBytes) + " bytes");
  }
  std::string text(static_cast<size_t>(length), '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size()))) {
    throw InputError(file, "", "cannot read; expected " + kind);
  }
  return text;
}

bool nextLine(std::string_view text, size_t& position, std::string_view& line) {
  if (position >= text.size()) {
    return false;
  }
  const size_t end = std::min(text.find('\n', position), text.size());
  line = text.substr(position, end - position);
  if (!line.empty() && line.back() == '\r') {
    line.remove_suffix(1);
  }
  position = end + 1;
  return true;
}

}  // namespace host
