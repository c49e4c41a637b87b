// SPDX-License-Identifier: MIT
// OpenEXR files: only what the header check lets pass may reach the library's decoders.
#include "common/error.hpp"
#include "common/image.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::File file(data, size);
  try {
    const host::Image image = host::readExr(file.path());
    fuzz::require(image.rgba.size() == image.pixelCount() * 4, "four values for each pixel");
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  try {
    const host::DepthImage depth = host::readExrDepth(file.path());
    fuzz::require(depth.values.size() == size_t{depth.width} * depth.height,
                  "a value for each pixel");
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  return 0;
}
