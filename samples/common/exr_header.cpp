// SPDX-License-Identifier: MIT
// The header of an OpenEXR file ("OpenEXR File Layout"): magic number, version, then attributes,
// each a name, a type, a size and so many bytes. Most of the library's known defects lie in tiled,
// deep and multi-part files and in the lossy decoders: none of them is reached.
#include "common/exr_header.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/image.hpp"

namespace host {
namespace {

constexpr size_t MAX_HEADER = size_t{64} << 10;
constexpr uint32_t MAGIC = 20000630;
constexpr uint32_t VERSION = 2;
constexpr uint32_t LONG_NAMES = 0x400;  // the only flag of the version that is no other kind
constexpr size_t LONGEST_NAME = 255;
constexpr uint8_t LAST_COMPRESSION = 3;  // NONE 0, RLE 1, ZIPS 2, ZIP 3
// Deflate makes at most 1032 bytes of one, RLE 64; half floats are the smallest pixels.
constexpr uint64_t MAX_EXPANSION = 1032;
constexpr uint64_t LEAST_PIXEL = 2;

// The library reads attributes of the types that it knows by what these hold, whatever size the
// file tells. Where the two differ it goes on in the middle of an attribute, and takes room of up
// to 2 GiB for what seems to be the next one.
struct TypeSize {
  const char* type;
  uint32_t size;
};
constexpr TypeSize SIZES[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"deepImageState", 1},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

uint32_t numberAt(const char* data, uint64_t at) {
  uint32_t result = 0;
  std::memcpy(&result, data + at, sizeof result);
  return result;
}

// Bytes that the library reads of an attribute, more than `size` where it would read on behind it.
uint64_t bytesRead(const std::string& type, const char* data, uint64_t size) {
  for (const TypeSize& known : SIZES) {
    if (type == known.type) {
      return known.size;
    }
  }
  uint64_t at = 0;
  if (type == "chlist") {
    constexpr uint64_t CHANNEL = 16;  // behind its name
    while (at < size && data[at] != '\0') {
      const size_t length = strnlen(data + at, size - at);
      at += length > LONGEST_NAME ? size : length + 1 + CHANNEL;
    }
    return at + 1;
  }
  if (type == "stringvector") {
    while (at + sizeof(uint32_t) <= size) {
      at += sizeof(uint32_t) + numberAt(data, at);
    }
    return at;
  }
  if (type == "preview") {
    constexpr uint64_t EDGES = 8;
    if (size < EDGES) {
      return EDGES;
    }
    // Larger edges do not fit a header either way.
    const uint64_t width = std::min<uint64_t>(numberAt(data, 0), MAX_HEADER);
    const uint64_t height = std::min<uint64_t>(numberAt(data, sizeof(uint32_t)), MAX_HEADER);
    return EDGES + 4 * width * height;
  }
  return type == "floatvector" ? size / sizeof(float) * sizeof(float) : size;
}

class HeaderReader {
 public:
  HeaderReader(std::vector<char> bytes, std::string file)
      : bytes_(std::move(bytes)), file_(std::move(file)) {}

  template <typename T>
  T value() {
    T result{};
    std::memcpy(&result, take(sizeof result), sizeof result);
    return result;
  }
  // Up to the next zero byte.
  std::string name() {
    std::string result;
    for (char c = *take(1); c != '\0'; c = *take(1)) {
      result += c;
      if (result.size() > LONGEST_NAME) {
        fail("names of at most 255 characters");
      }
    }
    return result;
  }
  const char* take(size_t count) {
    if (count > bytes_.size() - at_) {
      fail("a header that is whole, of at most 64 KiB");
    }
    at_ += count;
    return bytes_.data() + at_ - count;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, "", "expected an OpenEXR file: " + what);
  }

 private:
  std::vector<char> bytes_;
  std::string file_;
  size_t at_ = 0;
};

HeaderReader openHeader(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> bytes(MAX_HEADER);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(stream.gcount()));
  return {std::move(bytes), file.string()};
}

ExrWindow checkedWindow(const std::string& file, const std::array<int32_t, 4>& edges,
                        uint64_t length) {
  const int64_t width = int64_t{edges[2]} - edges[0] + 1;
  const int64_t height = int64_t{edges[3]} - edges[1] + 1;
  if (width < 1 || height < 1 || width > MAX_IMAGE_EDGE || height > MAX_IMAGE_EDGE) {
    throw InputError(file, "dataWindow",
                     "expected 1 to " + std::to_string(MAX_IMAGE_EDGE) + " pixels a side, got " +
                         std::to_string(width) + " x " + std::to_string(height));
  }
  // The library adds to and subtracts from the edges in 32 bits.
  for (const int32_t edge : edges) {
    if (edge < -(1 << 30) || edge > 1 << 30) {
      throw InputError(file, "dataWindow", "expected edges within 2^30 pixels of the origin");
    }
  }
  const auto pixels = static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
  if (pixels * LEAST_PIXEL > length * MAX_EXPANSION) {
    throw InputError(file, "", "expected a complete file, this one is too short for its pixels");
  }
  return {edges[0], edges[1], static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

}  // namespace

ExrWindow checkExrHeader(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(file, "", "no such file; expected an OpenEXR file");
  }
  HeaderReader header = openHeader(path);
  if (header.value<uint32_t>() != MAGIC) {
    header.fail("its magic number is not there");
  }
  if ((header.value<uint32_t>() & ~LONG_NAMES) != VERSION) {
    header.fail("version 2, one part of scan lines (not tiled, deep or multi-part)");
  }
  std::optional<std::array<int32_t, 4>> window;
  bool compression = false;
  for (std::string name = header.name(); !name.empty(); name = header.name()) {
    const std::string type = header.name();
    const auto size = header.value<uint32_t>();
    const char* data = header.take(size);
    if (bytesRead(type, data, size) != size) {
      throw InputError(
          file, name,
          "expected a value of type " + type + ", not of " + std::to_string(size) + " bytes");
    }
    if (name == "dataWindow" && type == "box2i" && size == sizeof *window && !window) {
      std::memcpy(window.emplace().data(), data, size);
    } else if (name == "compression" && type == "compression" && size == 1 && !compression) {
      compression = true;
      if (static_cast<uint8_t>(*data) > LAST_COMPRESSION) {
        throw InputError(file, "compression", "expected none, RLE, ZIPS or ZIP");
      }
    } else if (name == "dataWindow" || name == "compression") {
      throw InputError(file, name, "expected it once and of its usual type");
    }
  }
  if (!window || !compression) {
    header.fail("dataWindow and compression");
  }
  return checkedWindow(file, *window, std::filesystem::file_size(path, error));
}

}  // namespace host
