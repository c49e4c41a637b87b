// SPDX-License-Identifier: MIT
// NanoVDB grids of floats: files of version 32 without compression, as its documentation lays them
// out (little-endian): a header of 16 bytes, 176 bytes and a name for each grid, then the grids.
// Every offset is checked: a file may say anything.
#include <cstring>
#include <fstream>
#include <span>

#include "common/error.hpp"
#include "common/sparse_grid.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

constexpr std::string_view MAGIC = "NanoVDB";
constexpr size_t FILE_HEADER = 16;
constexpr size_t GRID_ENTRY = 176;
constexpr size_t GRID_HEADER = 672;  // the tree follows
constexpr size_t MATRIX = 296 + 88;  // of doubles: 9, their inverse's 9, the translation
constexpr size_t GRID_TYPE = 636;
constexpr uint32_t FLOATS = 1;
constexpr size_t LEAF = 2144;
constexpr size_t LEAF_VALUES = 96;
constexpr size_t LOWER = 33856;  // a node of 16^3 leaves
constexpr size_t LOWER_VALUE_MASK = 32;
constexpr size_t LOWER_CHILD_MASK = 544;
constexpr size_t LOWER_TABLE = 1088;
constexpr size_t UPPER = 270400;  // a node of 32^3 of those
constexpr size_t UPPER_VALUE_MASK = 32;
constexpr size_t UPPER_CHILD_MASK = 4128;
constexpr size_t ROOT_BACKGROUND = 28;
constexpr int LOWER_EDGE = 16;
constexpr size_t LEAF_VOXELS = 512;

class Bytes {
 public:
  Bytes(std::span<const char> bytes, const std::string& file) : bytes_(bytes), file_(file) {}
  size_t size() const { return bytes_.size(); }

  Bytes part(uint64_t offset, uint64_t size) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset) {
      throw InputError(file_, "", "expected a NanoVDB file that is whole");
    }
    return {bytes_.subspan(offset, size), file_};
  }
  template <typename T>
  T at(uint64_t offset) const {
    T value{};
    std::memcpy(&value, part(offset, sizeof value).bytes_.data(), sizeof value);
    return value;
  }
  bool bit(size_t mask, size_t index) const {
    return (at<uint8_t>(mask + index / 8) >> (index % 8) & 1) != 0;
  }
  std::string text(uint64_t offset, uint64_t size) const {
    const Bytes found = part(offset, size);
    return {found.bytes_.data(), strnlen(found.bytes_.data(), size)};
  }

 private:
  std::span<const char> bytes_;
  const std::string& file_;
};

struct Entry {
  std::string name;
  uint64_t begin;
  uint64_t size;
};

std::vector<Entry> entriesOf(const Bytes& bytes, const std::string& file) {
  constexpr uint32_t MAJOR = 32;
  if (bytes.text(0, MAGIC.size()) != MAGIC || bytes.at<uint32_t>(8) >> 21 != MAJOR) {
    throw InputError(file, "", "expected a NanoVDB file of version 32");
  }
  const auto count = bytes.at<uint16_t>(12);
  if (bytes.at<uint16_t>(14) != 0) {
    throw InputError(file, "", "expected a NanoVDB file without compression");
  }
  std::vector<Entry> entries;
  uint64_t at = FILE_HEADER;
  for (uint16_t i = 0; i < count; ++i) {
    const auto nameSize = bytes.at<uint32_t>(at + 136);
    entries.push_back({bytes.text(at + GRID_ENTRY, nameSize), 0, bytes.at<uint64_t>(at)});
    at += GRID_ENTRY + nameSize;
  }
  for (Entry& entry : entries) {
    entry.begin = at;
    at += bytes.part(at, entry.size).size();
  }
  return entries;
}

std::array<int64_t, 3> coordinate(const Bytes& bytes, size_t at, int edge) {
  std::array<int64_t, 3> result{};
  for (size_t i = 0; i < 3; ++i) {
    const int64_t x = bytes.at<int32_t>(at + 4 * i);
    result[i] = x & ~int64_t{edge - 1};
  }
  return result;
}

void addLeaf(const Bytes& leaf, SparseGrid& grid) {
  grid.leaves.push_back(coordinate(leaf, 0, LEAF_EDGE));
  for (size_t n = 0; n < LEAF_VOXELS; ++n) {
    const size_t x = n % 8;
    const size_t y = n / 8 % 8;
    const size_t z = n / 64;
    grid.values.push_back(leaf.at<float>(LEAF_VALUES + 4 * (x * 64 + y * 8 + z)));
  }
}

// Constant leaves, which are no leaves there.
void addTiles(const Bytes& node, SparseGrid& grid) {
  // Where the node lies: its box of active values is within it.
  const auto origin = coordinate(node, 0, LOWER_EDGE * LEAF_EDGE);
  for (size_t n = 0; n < 4096; ++n) {
    if (node.bit(LOWER_VALUE_MASK, n) && !node.bit(LOWER_CHILD_MASK, n)) {
      grid.leaves.push_back({origin[0] + LEAF_EDGE * static_cast<int64_t>(n / 256),
                             origin[1] + LEAF_EDGE * static_cast<int64_t>(n / 16 % 16),
                             origin[2] + LEAF_EDGE * static_cast<int64_t>(n % 16)});
      grid.values.insert(grid.values.end(), LEAF_VOXELS, node.at<float>(LOWER_TABLE + 8 * n));
    }
  }
}

SparseGrid readGrid(const Bytes& bytes, const std::string& file, const std::string& key) {
  if (bytes.text(0, MAGIC.size()) != MAGIC || bytes.at<uint32_t>(GRID_TYPE) != FLOATS) {
    throw InputError(file, key, "expected a grid of floats");
  }
  SparseGrid grid;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      grid.worldFromIndex[4 * row + column] = bytes.at<double>(MATRIX + 8 * (3 * row + column));
    }
    grid.worldFromIndex[4 * row + 3] = bytes.at<double>(MATRIX + 8 * (18 + row));
  }
  const auto nodes = [&](size_t level, size_t size) {
    const uint64_t count = bytes.at<uint32_t>(GRID_HEADER + 32 + 4 * level);
    return bytes.part(GRID_HEADER + bytes.at<uint64_t>(GRID_HEADER + 8 * level), count * size);
  };
  const uint64_t root = GRID_HEADER + bytes.at<uint64_t>(GRID_HEADER + 24);
  grid.background = bytes.at<float>(root + ROOT_BACKGROUND);
  for (size_t i = 0; i < 3; ++i) {
    grid.low[i] = bytes.at<int32_t>(root + 4 * i);
    grid.high[i] = bytes.at<int32_t>(root + 12 + 4 * i);
  }
  const Bytes leaves = nodes(0, LEAF);
  for (size_t at = 0; at < leaves.size(); at += LEAF) {
    addLeaf(leaves.part(at, LEAF), grid);
  }
  const Bytes lower = nodes(1, LOWER);
  for (size_t at = 0; at < lower.size(); at += LOWER) {
    addTiles(lower.part(at, LOWER), grid);
  }
  const Bytes upper = nodes(2, UPPER);
  for (size_t at = 0; at < upper.size(); at += UPPER) {
    for (size_t n = 0; n < 32768; ++n) {
      if (upper.bit(at + UPPER_VALUE_MASK, n) && !upper.bit(at + UPPER_CHILD_MASK, n)) {
        throw InputError(file, key, "expected no constant regions of 128^3 voxels");
      }
    }
  }
  return grid;
}

}  // namespace

bool isNanoVdb(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, MAGIC.size()> first{};
  stream.read(first.data(), first.size());
  return stream && std::string_view(first.data(), first.size()) == MAGIC;
}

std::vector<SparseGrid> readNanoVdb(const std::filesystem::path& path,
                                    const std::vector<std::string>& names) {
  const std::string file = path.string();
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> content{std::istreambuf_iterator<char>(stream), {}};
  const Bytes bytes(content, file);
  const std::vector<Entry> entries = entriesOf(bytes, file);
  std::string known;
  for (const Entry& entry : entries) {
    known += (known.empty() ? "" : ", ") + entry.name;
  }
  std::vector<SparseGrid> grids;
  for (const std::string& name : names) {
    const Entry* found = nullptr;
    for (const Entry& entry : entries) {
      found = entry.name == name ? &entry : found;
    }
    if (found == nullptr) {
      throw InputError(file, "grid",
                       "expected a grid named '" + name + "'; the file has: " + known);
    }
    grids.push_back(readGrid(bytes.part(found->begin, found->size), file, "grid '" + name + "'"));
  }
  return grids;
}

}  // namespace host
