// SPDX-License-Identifier: MIT
#include "values.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <stdexcept>

Size readSize(const std::string& text) {
  Size size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%ux%u%c", &size.width, &size.height, &rest) != 2 ||
      size.width < 16 || size.height < 16 || size.width > 16384 || size.height > 16384) {
    throw std::invalid_argument("expected WIDTHxHEIGHT, 16 to 16384 each");
  }
  return size;
}

float readNumber(const std::string& text, const Range& range) {
  float number = 0.0f;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || !(number >= range.least && number <= range.most)) {
    std::array<char, 64> message{};
    std::snprintf(message.data(), message.size(), "expected a number from %g to %g",
                  double{range.least}, double{range.most});
    throw std::invalid_argument(message.data());
  }
  return number;
}

const std::map<std::string, uint32_t>& qualityLevels() {
  static const std::map<std::string, uint32_t> LEVELS{{"low", WLK_QUALITY_LOW},
                                                      {"medium", WLK_QUALITY_MEDIUM},
                                                      {"high", WLK_QUALITY_HIGH},
                                                      {"ultra", WLK_QUALITY_ULTRA}};
  return LEVELS;
}
