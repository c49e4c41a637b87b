// SPDX-License-Identifier: MIT
// Noise that shapes the detail under the faces of surface clouds: round lumps, their fissures
// between them. No Vulkan.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace welkin {

// Repeats after DETAIL_LUMPS of its largest lumps.
constexpr uint32_t DETAIL_TEXELS = 128;  // along an edge
constexpr uint32_t DETAIL_LUMPS = 8;
constexpr uint32_t DETAIL_LEVELS = 8;

// Texels of all levels, x first, coarser ones last: 0 in the middle of lumps, 255 in the deepest
// fissures. Distances to the nearest of points scattered over cells, at three sizes (Worley 1996).
std::vector<uint8_t> detailNoise();

// Where a level begins in them.
size_t detailLevelBegin(uint32_t level);

// The same texels, each with its neighbours along x, y and both (low byte first): the corners of a
// face between four of them. z first, then x: what lies between two faces is read from one place.
// Levels are put beside each other in one image, since drivers such as lavapipe look up where the
// levels of an image begin lane by lane.
std::vector<uint32_t> detailFaces(const std::vector<uint8_t>& noise);

// Where a level begins in the image, and the image's texels: coarser levels lie in a row on the
// finest one.
constexpr std::array<uint32_t, 3> DETAIL_IMAGE = {DETAIL_TEXELS, DETAIL_TEXELS,
                                                  DETAIL_TEXELS + DETAIL_TEXELS / 2};
constexpr std::array<uint32_t, 3> detailBegin(uint32_t level) {
  return level > 0 ? std::array{DETAIL_TEXELS - 2 * (DETAIL_TEXELS >> level), 0U, DETAIL_TEXELS}
                   : std::array{0U, 0U, 0U};
}

// The finest level between its texels, as linear filters have it, [0, 1]; 1 is the period.
double detailNoiseAt(const std::vector<uint8_t>& noise, const std::array<double, 3>& place);

}  // namespace welkin
