// SPDX-License-Identifier: MIT
// What an OpenEXR file says of itself, read without the library: only files of the few kinds that
// the host needs are handed to it.
#pragma once

#include <cstdint>
#include <filesystem>

namespace host {

struct ExrWindow {
  int32_t minX = 0;
  int32_t minY = 0;
  uint32_t width = 0;
  uint32_t height = 0;
};

/// Throws InputError unless the file is one part of scan lines without loss (no compression, RLE,
/// ZIPS or ZIP), of at most MAX_IMAGE_EDGE pixels a side, and long enough to hold them.
ExrWindow checkExrHeader(const std::filesystem::path& file);

}  // namespace host
