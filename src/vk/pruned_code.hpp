// SPDX-License-Identifier: MIT
// Shader modules without what a pipeline's constants rule out.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace welkin::vk {

// `code`, a valid SPIR-V module, without the blocks that are never entered where the constant of
// SpecId i has the value constants[i], and without what only they needed. A driver reads the whole
// module for every pipeline and cleans it up in many passes before most of it falls away: lavapipe
// makes pipelines in half the time from what is left. The constants stay constants, so that the
// pipeline has to be given the same values. All of `code` where a loop is left without a way
// back to its head, where a block ends in what is not known here, and where it is no module.
std::pmr::vector<uint32_t> prunedCode(std::span<const uint32_t> code,
                                      std::span<const uint32_t> constants,
                                      std::pmr::memory_resource* memory);

}  // namespace welkin::vk
