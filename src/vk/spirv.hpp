// SPDX-License-Identifier: MIT
// As much of SPIR-V as pruning a module needs. Opcodes and layouts: specification 1.6,
// section 3.42.
#pragma once
#include <cstdint>
#include <span>

namespace welkin::vk {

enum Op : uint32_t {
  OP_UNDEF = 1,
  OP_NAME = 5,
  OP_EXTENDED = 12,
  OP_CONSTANT_TRUE = 41,
  OP_CONSTANT_FALSE = 42,
  OP_CONSTANT = 43,
  OP_SPEC_TRUE = 48,
  OP_SPEC_FALSE = 49,
  OP_SPEC_CONSTANT = 50,
  OP_SPEC_OPERATION = 52,
  OP_FUNCTION = 54,
  OP_FUNCTION_END = 56,
  OP_VARIABLE = 59,
  OP_LOAD = 61,
  OP_STORE = 62,
  OP_COPY_MEMORY_SIZED = 64,
  OP_ACCESS_CHAIN = 65,
  OP_IN_BOUNDS_ACCESS_CHAIN = 66,
  OP_ARRAY_LENGTH = 68,
  OP_DECORATE = 71,
  OP_VECTOR_SHUFFLE = 79,
  OP_SAMPLED_IMAGE = 86,
  OP_IMAGE_GATHER = 97,
  OP_IMAGE_READ = 98,
  OP_IMAGE_WRITE = 99,
  OP_IMAGE = 100,
  OP_IMAGE_QUERY_SAMPLES = 107,
  OP_CONVERT_F_TO_U = 109,
  OP_IADD = 128,
  OP_ISUB = 130,
  OP_LOGICAL_EQUAL = 164,
  OP_LOGICAL_NOT_EQUAL = 165,
  OP_LOGICAL_OR = 166,
  OP_LOGICAL_AND = 167,
  OP_LOGICAL_NOT = 168,
  OP_SELECT = 169,
  OP_IEQUAL = 170,
  OP_INOT_EQUAL = 171,
  OP_UGREATER = 172,
  OP_UGREATER_EQUAL = 174,
  OP_ULESS = 176,
  OP_ULESS_EQUAL = 178,
  OP_BITWISE_OR = 197,
  OP_BITWISE_AND = 199,
  OP_BIT_COUNT = 205,
  OP_CONTROL_BARRIER = 224,
  OP_MEMORY_BARRIER = 225,
  OP_ATOMIC_STORE = 228,
  OP_PHI = 245,
  OP_LOOP_MERGE = 246,
  OP_SELECTION_MERGE = 247,
  OP_LABEL = 248,
  OP_BRANCH = 249,
  OP_BRANCH_CONDITIONAL = 250,
  OP_SWITCH = 251,
  OP_UNREACHABLE = 255,
};
constexpr uint32_t MAGIC = 0x07230203;
constexpr uint32_t HEADER_WORDS = 5;
constexpr uint32_t SPEC_ID = 1;  // a decoration

// Whether nothing but the result comes of it. Extended instructions: of GLSL.std.450, of which Modf
// and Frexp write through a pointer.
inline bool isPure(std::span<const uint32_t> words) {
  const uint32_t op = words[0] & 0xffffu;
  if (op == OP_EXTENDED) {
    constexpr uint32_t MODF = 35;
    constexpr uint32_t FREXP = 51;
    return words.size() > 4 && words[4] != MODF && words[4] != FREXP;
  }
  return op == OP_UNDEF || op == OP_LOAD || op == OP_ACCESS_CHAIN ||
         op == OP_IN_BOUNDS_ACCESS_CHAIN || op == OP_ARRAY_LENGTH ||
         (op >= OP_VECTOR_SHUFFLE && op <= OP_SAMPLED_IMAGE) ||
         (op > OP_SAMPLED_IMAGE && op <= OP_IMAGE_READ) ||
         (op >= OP_IMAGE && op <= OP_IMAGE_QUERY_SAMPLES) ||
         (op >= OP_CONVERT_F_TO_U && op <= OP_BIT_COUNT) || op == OP_PHI;
}

// The id that an instruction of a function defines, or 0.
inline uint32_t resultOf(std::span<const uint32_t> words) {
  const uint32_t op = words[0] & 0xffffu;
  if (op == OP_LABEL) {
    return words[1];
  }
  const bool none = (op >= OP_STORE && op <= OP_COPY_MEMORY_SIZED) || op == OP_IMAGE_WRITE ||
                    op == OP_CONTROL_BARRIER || op == OP_MEMORY_BARRIER || op == OP_ATOMIC_STORE ||
                    (op >= OP_LOOP_MERGE && op <= OP_UNREACHABLE);
  return none || words.size() < 3 ? 0 : words[2];
}

}  // namespace welkin::vk
