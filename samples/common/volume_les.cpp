// SPDX-License-Identifier: MIT
// Liquid water of a large-eddy simulation, read from text, as extinction in 1/m.
#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.hpp"
#include "common/text.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

constexpr size_t MAX_LES_BYTES = size_t{1} << 30;
constexpr double METRES_PER_KILOMETRE = 1000.0;
// Levels may be printed with three decimals of a kilometre: 1 m of 40 m.
constexpr double LEVEL_TOLERANCE = 0.05;
constexpr double MEDIAN_OF_EFFECTIVE = 0.8553453273074225;  // exp(-2.5 * 0.25^2)

struct Header {
  std::array<uint32_t, 3> size{};
  double dx = 0.0;
  double dy = 0.0;
  double firstLevel = 0.0;
  double dz = 0.0;
};

struct Cell {
  std::array<uint32_t, 3> index{};
  float value = 0.0f;
};

// Reads one file line by line and says where it is when something is wrong.
class Reader {
 public:
  Reader(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

  // The numbers of the next line; false at the end of the file.
  bool next(std::vector<double>& numbers) {
    std::string_view line;
    if (!nextLine(text_, position_, line)) {
      return false;
    }
    ++line_;
    numbers.clear();
    for (const std::string_view word : splitWords(line)) {
      const std::optional<double> number = parseNumber(word);
      if (!number || !std::isfinite(*number)) {
        fail("expected finite numbers, got '" + std::string(word.substr(0, 40)) + "'");
      }
      numbers.push_back(*number);
    }
    return true;
  }

  void skipLine() {
    std::string_view line;
    nextLine(text_, position_, line);
    ++line_;
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(file_, "line " + std::to_string(line_), expected);
  }

 private:
  std::string file_;
  std::string text_;
  size_t position_ = 0;
  size_t line_ = 0;
};

bool isIndex(double x) {
  return x >= 0.0 && x <= 1e6 && x == std::floor(x);
}

Header readHeader(const std::string& file, Reader& reader) {
  Header header;
  std::vector<double> numbers;
  reader.skipLine();
  if (!reader.next(numbers) || numbers.size() != 3 ||
      !std::all_of(numbers.begin(), numbers.end(), isIndex)) {
    reader.fail("expected the grid's size 'nx ny nz'");
  }
  for (size_t i = 0; i < 3; ++i) {
    header.size[i] = static_cast<uint32_t>(numbers[i]);
  }
  checkedVoxelCount(file, {header.size[0], header.size[1], header.size[2]});
  if (!reader.next(numbers) || numbers.size() != size_t{2} + header.size[2] || numbers[0] <= 0.0 ||
      numbers[1] <= 0.0) {
    reader.fail("expected 'dx dy' and " + std::to_string(header.size[2]) + " levels in km");
  }
  header.dx = numbers[0] * METRES_PER_KILOMETRE;
  header.dy = numbers[1] * METRES_PER_KILOMETRE;
  header.firstLevel = numbers[2] * METRES_PER_KILOMETRE;
  // One level says nothing of its thickness: take a cube.
  header.dz = header.size[2] == 1
                  ? header.dx
                  : (numbers.back() - numbers[2]) * METRES_PER_KILOMETRE / (header.size[2] - 1);
  for (size_t k = 1; k < header.size[2]; ++k) {
    const double step = (numbers[2 + k] - numbers[1 + k]) * METRES_PER_KILOMETRE;
    if (header.dz <= 0.0 || std::abs(step - header.dz) > LEVEL_TOLERANCE * header.dz) {
      reader.fail("expected evenly spaced, rising levels");
    }
  }
  return header;
}

std::vector<Cell> readCells(Reader& reader, const Header& header, bool diameters) {
  std::vector<Cell> cells;
  std::vector<double> numbers;
  while (reader.next(numbers)) {
    if (numbers.empty()) {
      continue;
    }
    if (numbers.size() != 5) {
      reader.fail("expected 'ix iy iz lwc reff'");
    }
    Cell cell;
    for (size_t i = 0; i < 3; ++i) {
      if (!isIndex(numbers[i]) || numbers[i] > header.size[i]) {
        reader.fail("expected indices inside the grid");
      }
      cell.index[i] = static_cast<uint32_t>(numbers[i]);
    }
    // 1e4 bounds both far beyond nature and keeps the quotient a float.
    if (numbers[3] < 0.0 || numbers[3] > 1e4 || numbers[4] < 1e-2 || numbers[4] > 1e4) {
      reader.fail("expected lwc in [0, 1e4] g/m^3 and reff in [0.01, 1e4] um");
    }
    cell.value = static_cast<float>(diameters ? MEDIAN_OF_EFFECTIVE * 2.0 * numbers[4]
                                              : 1.5 * numbers[3] / numbers[4]);
    cells.push_back(cell);
  }
  return cells;
}

uint32_t findIndexBase(const std::string& file, const Header& header,
                       const std::vector<Cell>& cells, int requested) {
  bool zero = false;
  bool full = false;
  for (const Cell& cell : cells) {
    for (size_t i = 0; i < 3; ++i) {
      zero = zero || cell.index[i] == 0;
      full = full || cell.index[i] == header.size[i];
    }
  }
  const uint32_t base = requested < 0 ? (full ? 1u : 0u) : static_cast<uint32_t>(requested);
  if ((base == 1 && zero) || (base == 0 && full)) {
    throw InputError(file, "",
                     "expected indices from " + std::to_string(base) + " on, inside the grid");
  }
  return base;
}

}  // namespace

Grid loadLes(const std::filesystem::path& path, const LesInfo& info) {
  const std::string file = path.string();
  Reader reader(file, readTextFile(file, MAX_LES_BYTES, "LES text"));
  const Header header = readHeader(file, reader);
  const std::vector<Cell> cells = readCells(reader, header, info.diameters);
  const uint32_t base = findIndexBase(file, header, cells, info.indexBase);

  Grid grid;
  grid.size = header.size;
  grid.values.assign(size_t{header.size[0]} * header.size[1] * header.size[2], 0.0f);
  for (const Cell& cell : cells) {
    const size_t x = cell.index[0] - base;
    const size_t y = cell.index[1] - base;
    const size_t z = cell.index[2] - base;
    grid.values[x + header.size[0] * (y + header.size[1] * z)] = cell.value;
  }
  grid.worldFromVolume =
      affineFromEdges(worldAxes({0.0, 0.0, header.firstLevel - 0.5 * header.dz}, info.up),
                      worldAxes({header.dx * header.size[0], 0.0, 0.0}, info.up),
                      worldAxes({0.0, header.dy * header.size[1], 0.0}, info.up),
                      worldAxes({0.0, 0.0, header.dz * header.size[2]}, info.up));
  return grid;
}

}  // namespace host
