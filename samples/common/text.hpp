// SPDX-License-Identifier: MIT
// Numbers from text without a locale, and text from numbers without loss.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace host {

/// The whole of `text`, blanks at the ends aside, as a number. "inf" counts, "nan" does not.
std::optional<double> parseNumber(std::string_view text);

/// The shortest form that printf's %.17g gives: reading it back is exact.
std::string formatNumber(double value);

/// Splits at blanks.
std::vector<std::string_view> splitWords(std::string_view line);

/// Splits at commas; blanks at the ends of each part are dropped.
std::vector<std::string_view> splitCommas(std::string_view line);

/// Reads a text file of at most `maxBytes`. Throws InputError; `kind` says what was expected.
std::string readTextFile(const std::string& file, size_t maxBytes, const std::string& kind);

/// Next line of `text` from `position`, without its line end; false at the end.
bool nextLine(std::string_view text, size_t& position, std::string_view& line);

}  // namespace host
