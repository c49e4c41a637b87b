// SPDX-License-Identifier: MIT
// Checks of what comes over the C boundary. Each throws Failure naming structure and field.
#pragma once

#include <welkin/welkin_vulkan.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "failure.hpp"

namespace welkin {

// The first three fields of every structure.
struct StructHeader {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
};

const char* structName(uint32_t sType);

void checkPointer(const void* pointer, const char* argument);

// Size of a structure in the header of 1.0: the least that callers of any 1.x say. One that has
// grown since has a line of its own, offsetof(its first field that 1.0 did not have); if that is
// missing, the gate's client of 1.0 is refused (tests/abi).
template <typename T>
constexpr uint32_t FIRST_SIZE = sizeof(T);

// Pointer, sType and structSize of a structure that is read: at least `firstSize`; what lies beyond
// `size`, this library's sizeof, must be 0.
void checkHeader(const void* structure, uint32_t sType, uint32_t size, uint32_t firstSize);

// The same of one that is written, where what lies beyond is left alone; and it has no chain.
void checkOutput(const void* structure, uint32_t sType, uint32_t firstSize);

void checkReservedField(uint32_t sType, const char* field, uint32_t value);

// What reserved fields hold must be 0, else they could never get a meaning.
template <typename T>
void checkReserved(uint32_t sType, const T& value) {
  if constexpr (requires { value.reserved0; }) {
    checkReservedField(sType, "reserved0", value.reserved0);
  }
  if constexpr (requires { value.reserved1; }) {
    checkReservedField(sType, "reserved1", value.reserved1);
  }
  if constexpr (requires { value.before.reserved0; }) {
    checkReservedField(sType, "before.reserved0", value.before.reserved0);
    checkReservedField(sType, "after.reserved0", value.after.reserved0);
  }
}

// A copy of the caller's structure in this library's size; fields that the caller's header does not
// know are 0, which must be their default.
template <typename T>
T copyStruct(const T* structure, uint32_t sType) {
  checkHeader(structure, sType, sizeof(T), FIRST_SIZE<T>);
  T copy{};
  std::memcpy(&copy, structure, std::min<size_t>(structure->structSize, sizeof(T)));
  checkReserved(sType, copy);
  return copy;
}

// Element `i` of a caller's array, as copyStruct; the caller's header said how long it is by
// `stride`, which was found to be at least FIRST_SIZE<T>.
template <typename T>
T copyElement(const T* elements, uint32_t stride, size_t i, uint32_t sType) {
  T copy{};
  std::memcpy(&copy, reinterpret_cast<const char*>(elements) + i * stride,
              std::min<size_t>(stride, sizeof(T)));
  checkReserved(sType, copy);
  return copy;
}

// What a function fills for the caller's `structure`: all 0 but the header, which is the caller's.
template <typename T>
T startOutput(const T* structure, uint32_t sType) {
  checkOutput(structure, sType, FIRST_SIZE<T>);
  T value{};
  value.sType = sType;
  value.structSize = structure->structSize;
  return value;
}

// Gives the caller as much of it as the caller's header knows.
template <typename T>
void finishOutput(const T& value, T* structure) {
  std::memcpy(static_cast<void*>(structure), &value,
              std::min<size_t>(structure->structSize, sizeof(T)));
}

void checkNoChain(const void* structure);

// Bytes that the caller says are at a pointer.
void checkRoom(uint32_t sType, const char* field, uint64_t size, uint64_t least);

// NaN and infinities fail as out of range.
void checkRange(uint32_t sType, const char* field, double value, double lo, double hi);
void checkRange3(uint32_t sType, const char* field, const float (&value)[3], double lo, double hi);
// A unit vector within 1e-3 of length 1.
void checkUnit(uint32_t sType, const char* field, const float (&value)[3]);

// 12 finite numbers whose 3x3 part is invertible.
void checkTransform(uint32_t sType, const char* field, const double* matrix);

}  // namespace welkin
