// SPDX-License-Identifier: MIT
#include "frame/transport_steps.hpp"

#include <algorithm>

namespace welkin {
namespace {

// On a cumulus of 32^3 cells 4, 5, 6 and 16 rounds give means of 0.989, 0.98, 0.978 and 0.97.
constexpr TransportRounds ROUNDS{5, 5, 2, 10};
// Cells of a layer's coarsest level are optically thick, and hold light for long: at optical depth
// 64 the rounds above let a fifth too little through (32 cells). The level that begins from no
// light takes the most: extrapolation would multiply what is missing there.
constexpr TransportRounds LAYER_ROUNDS{14, 5, 2, 20};

}  // namespace

TransportSteps::TransportSteps(const TransportShape& shape)
    : shape_(shape),
      sizes_(transportSizes(shape.cells)),
      rounds_(shape.layer ? LAYER_ROUNDS : ROUNDS) {}

uint32_t TransportSteps::rays(uint32_t level) const {
  const uint32_t x = shape_.cells[0] >> level;
  const uint32_t y = shape_.cells[1] >> level;
  const uint32_t z = shape_.cells[2] >> level;
  return std::max({x * y, y * z, z * x});
}

uint64_t TransportSteps::cost(const TransportStep& step) const {
  // Measured by repeating each dispatch, 32^3 cells, 50 directions; coarser levels agree within 30
  // %.
  constexpr uint64_t DISPATCH = 1500;
  constexpr uint64_t SLICE = 15;     // of a group of rays
  constexpr uint64_t GATHERED = 22;  // direction, of a group of cells
  constexpr uint64_t SOURCE = 11;    // likewise
  constexpr uint64_t FIELD_SLICE = 50;
  constexpr uint64_t CELL = 300;  // of a group of anything else
  const uint64_t directions = transportDirections(step.level, shape_);
  const uint64_t slices = std::max({shape_.cells[0], shape_.cells[1], shape_.cells[2]});
  const uint64_t group = step.pass == vk::Pass::TransportSweep    ? SLICE * (slices >> step.level)
                         : step.pass == vk::Pass::TransportGather ? GATHERED * directions
                         : step.pass == vk::Pass::TransportSource ? SOURCE * directions
                         : step.pass == vk::Pass::TransportDepth  ? FIELD_SLICE * 2 * slices
                                                                  : CELL;
  return DISPATCH + group * step.groups * step.rows;
}

uint32_t TransportSteps::unitsBefore(const TransportStep& step, uint64_t at, uint64_t cost,
                                     uint64_t place) {
  if (place <= at) {
    return 0;
  }
  const uint64_t units = step.units();
  return static_cast<uint32_t>(std::min(units, (units * (place - at) + cost - 1) / cost));
}

}  // namespace welkin
