// SPDX-License-Identifier: MIT
// Tables of numbers as comma-separated text.
#pragma once

#include <string>
#include <vector>

namespace host {

struct CsvTable {
  std::string file;
  /// Names of the columns, from the file's first line or from the defaults.
  std::vector<std::string> columns;
  /// Row by row.
  std::vector<double> values;
  /// Line in the file of each row, for messages.
  std::vector<size_t> lines;

  [[nodiscard]] size_t rowCount() const { return lines.size(); }
  /// Index of a column, or -1.
  [[nodiscard]] int find(const std::string& column) const;
  [[nodiscard]] double at(size_t row, int column) const {
    return values[row * columns.size() + static_cast<size_t>(column)];
  }
  /// Throws InputError naming line and column.
  [[noreturn]] void fail(size_t row, const std::string& column, const std::string& expected) const;
};

/// Reads a table of at most 1 GiB. A first line that holds no number names the columns; otherwise
/// the one of `presets` with the right count of columns does. Empty lines and lines that begin
/// with # are skipped. Throws InputError: a part that is no number, rows of unequal length.
CsvTable readCsv(const std::string& file, const std::vector<std::vector<std::string>>& presets);

/// Writes rows of %.17g under a line of names. Throws HostError.
void writeCsv(const std::string& file, const std::vector<std::string>& columns,
              const std::vector<double>& values);

}  // namespace host
