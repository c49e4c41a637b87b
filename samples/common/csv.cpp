// SPDX-License-Identifier: MIT
#include "common/csv.hpp"

#include <algorithm>
#include <fstream>

#include "common/error.hpp"
#include "common/text.hpp"

namespace host {
namespace {

constexpr size_t MAX_CSV_BYTES = size_t{1} << 30;

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ",") + name;
  }
  return text;
}

std::vector<std::string> presetFor(const std::string& file, size_t width,
                                   const std::vector<std::vector<std::string>>& presets) {
  std::string known;
  for (const std::vector<std::string>& preset : presets) {
    if (preset.size() == width) {
      return preset;
    }
    known += (known.empty() ? "" : " or ") + join(preset);
  }
  throw InputError(file, "line 1", "expected the columns " + known);
}

}  // namespace

int CsvTable::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

void CsvTable::fail(size_t row, const std::string& column, const std::string& expected) const {
  throw InputError(file, "line " + std::to_string(lines[row]) + ", column " + column, expected);
}

CsvTable readCsv(const std::string& file, const std::vector<std::vector<std::string>>& presets) {
  const std::string text = readTextFile(file, MAX_CSV_BYTES, "a CSV table");
  CsvTable table;
  table.file = file;
  size_t position = 0;
  size_t lineNumber = 0;
  std::string_view line;
  while (nextLine(text, position, line)) {
    ++lineNumber;
    const std::vector<std::string_view> parts = splitCommas(line);
    if ((parts.size() == 1 && parts[0].empty()) || parts[0].starts_with('#')) {
      continue;
    }
    if (table.columns.empty()) {
      const bool header = std::none_of(parts.begin(), parts.end(), [](std::string_view part) {
        return parseNumber(part).has_value();
      });
      if (header) {
        table.columns.assign(parts.begin(), parts.end());
        continue;
      }
      table.columns = presetFor(file, parts.size(), presets);
    }
    const std::string where = "line " + std::to_string(lineNumber);
    if (parts.size() != table.columns.size()) {
      throw InputError(file, where,
                       "expected " + std::to_string(table.columns.size()) + " columns, got " +
                           std::to_string(parts.size()));
    }
    for (size_t i = 0; i < parts.size(); ++i) {
      const std::optional<double> number = parseNumber(parts[i]);
      if (!number) {
        throw InputError(file, where + ", column " + table.columns[i],
                         "expected a number, got '" + std::string(parts[i].substr(0, 40)) + "'");
      }
      table.values.push_back(*number);
    }
    table.lines.push_back(lineNumber);
  }
  if (table.columns.empty()) {
    throw InputError(file, "", "expected at least one row of numbers");
  }
  return table;
}

void writeCsv(const std::string& file, const std::vector<std::string>& columns,
              const std::vector<double>& values) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  std::string text = join(columns) + "\n";
  for (size_t i = 0; i < values.size(); ++i) {
    text += formatNumber(values[i]);
    text += (i + 1) % columns.size() == 0 ? '\n' : ',';
    if (text.size() > (size_t{1} << 20)) {
      stream << text;
      text.clear();
    }
  }
  stream << text;
  stream.flush();
  if (!stream) {
    throw HostError(file + ": cannot write");
  }
}

}  // namespace host
