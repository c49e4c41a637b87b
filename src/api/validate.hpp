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

// What WlkRayBatch was before maxOrder, WlkLight before limbDarkening, WlkFog before medium,
// targets before shadow maps.
constexpr uint32_t CONTEXT_FIRST_SIZE = offsetof(WlkContextInfo, deviceMemoryLimit);
constexpr uint32_t RAY_BATCH_FIRST_SIZE = offsetof(WlkRayBatch, maxOrder);
constexpr uint32_t VIEW_FIRST_SIZE = offsetof(WlkViewInfo, colorSpace);
constexpr uint32_t LIGHT_FIRST_SIZE = offsetof(WlkLight, limbDarkening);
constexpr uint32_t QUALITY_FIRST_SIZE = offsetof(WlkQuality, volumeCells);
constexpr uint32_t FOG_FIRST_SIZE = offsetof(WlkFog, medium);
constexpr uint32_t HEADLESS_INPUTS_FIRST_SIZE = offsetof(WlkHeadlessInputs, lightShadow);
constexpr uint32_t VIEW_TARGETS_FIRST_SIZE = offsetof(WlkVulkanViewTargets, lightShadow);

// Pointer, sType and structSize of a structure; `size` is this library's sizeof, `firstSize` that
// of the header that introduced the structure, 0 if it has not grown since.
void checkHeader(const void* structure, uint32_t sType, uint32_t size, uint32_t firstSize = 0);

// As checkHeader for structures that are written: the caller's must be at least ours, and there is
// no chain.
void checkOutput(const void* structure, uint32_t sType, uint32_t size);

// A copy of the caller's structure in this library's size; fields that the caller's header does not
// know are 0, which must be their default.
template <typename T>
T copyStruct(const T* structure, uint32_t sType, uint32_t firstSize = 0) {
  checkHeader(structure, sType, sizeof(T), firstSize);
  T copy{};
  std::memcpy(&copy, structure, std::min<size_t>(structure->structSize, sizeof(T)));
  return copy;
}

void checkNoChain(const void* structure);

// NaN and infinities fail as out of range.
void checkRange(uint32_t sType, const char* field, double value, double lo, double hi);
void checkRange3(uint32_t sType, const char* field, const float (&value)[3], double lo, double hi);
// A unit vector within 1e-3 of length 1.
void checkUnit(uint32_t sType, const char* field, const float (&value)[3]);

// 12 finite numbers whose 3x3 part is invertible.
void checkTransform(uint32_t sType, const char* field, const double* matrix);

}  // namespace welkin
