// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace welkin::test {

// How often libwelkin has called the C++ runtime's operator new in this process: what does not go
// through the host's allocator. The layers of validation and the driver do not count.
uint64_t libraryAllocations();

}  // namespace welkin::test
