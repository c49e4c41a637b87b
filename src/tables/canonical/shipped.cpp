// SPDX-License-Identifier: MIT
// The table that welkin_canonical wrote, in the library's constant data.
#include "tables/canonical_table.hpp"

namespace welkin {
namespace {
#include "canonical_slab.h"
}  // namespace

std::span<const uint32_t> shippedCanonical() {
  return CANONICAL_WORDS;
}

}  // namespace welkin
