// SPDX-License-Identifier: MIT
#include "api/validate.hpp"

#include <cmath>
#include <glm/glm.hpp>

namespace welkin {
namespace {

[[noreturn]] void failSize(uint32_t sType, uint32_t size, uint32_t least) {
  fail(WLK_ERROR_INVALID_ARGUMENT, sType, "structSize",
       "%s::structSize is %u, expected at least %u", structName(sType), size, least);
}

}  // namespace

const char* structName(uint32_t sType) {
  switch (sType) {
    case WLK_STRUCT_ERROR_INFO:
      return "WlkErrorInfo";
    case WLK_STRUCT_CONTEXT_INFO:
      return "WlkContextInfo";
    case WLK_STRUCT_HEADLESS_INFO:
      return "WlkHeadlessInfo";
    case WLK_STRUCT_CAPABILITIES:
      return "WlkCapabilities";
    case WLK_STRUCT_LOG_MESSAGE:
      return "WlkLogMessage";
    case WLK_STRUCT_PLANET:
      return "WlkPlanet";
    case WLK_STRUCT_SKY:
      return "WlkSky";
    case WLK_STRUCT_LIGHT:
      return "WlkLight";
    case WLK_STRUCT_FOG:
      return "WlkFog";
    case WLK_STRUCT_ABSORBER:
      return "WlkAbsorber";
    case WLK_STRUCT_AMBIENT:
      return "WlkAmbient";
    case WLK_STRUCT_MEDIUM_INFO:
      return "WlkMediumInfo";
    case WLK_STRUCT_MEDIUM_OPTICS:
      return "WlkMediumOptics";
    case WLK_STRUCT_PHASE_QUERY:
      return "WlkPhaseQuery";
    case WLK_STRUCT_SURFACE_INFO:
      return "WlkSurfaceInfo";
    case WLK_STRUCT_SURFACE_DETAIL:
      return "WlkSurfaceDetail";
    case WLK_STRUCT_VOLUME_INFO:
      return "WlkVolumeInfo";
    case WLK_STRUCT_VOLUME_UPLOAD:
      return "WlkVolumeUpload";
    case WLK_STRUCT_VOLUME_BRICKS:
      return "WlkVolumeBricks";
    case WLK_STRUCT_VOLUME_STATE:
      return "WlkVolumeState";
    case WLK_STRUCT_VIEW_INFO:
      return "WlkViewInfo";
    case WLK_STRUCT_CAMERA:
      return "WlkCamera";
    case WLK_STRUCT_QUALITY:
      return "WlkQuality";
    case WLK_STRUCT_QUALITY_STATE:
      return "WlkQualityState";
    case WLK_STRUCT_FRAME_INFO:
      return "WlkFrameInfo";
    case WLK_STRUCT_HEADLESS_INPUTS:
      return "WlkHeadlessInputs";
    case WLK_STRUCT_IMAGE_DATA:
      return "WlkImageData";
    case WLK_STRUCT_FRAME_STATS:
      return "WlkFrameStats";
    case WLK_STRUCT_ERROR_ESTIMATE:
      return "WlkErrorEstimate";
    case WLK_STRUCT_LIGHT_SHADOW:
      return "WlkLightShadow";
    case WLK_STRUCT_RAY_BATCH:
      return "WlkRayBatch";
    case WLK_STRUCT_SKY_MAP_QUERY:
      return "WlkSkyMapQuery";
    case WLK_STRUCT_VULKAN_DEVICE_INFO:
      return "WlkVulkanDeviceInfo";
    case WLK_STRUCT_VULKAN_REQUIREMENTS:
      return "WlkVulkanRequirements";
    case WLK_STRUCT_VULKAN_IMAGE:
      return "WlkVulkanImage";
    case WLK_STRUCT_VULKAN_VIEW_TARGETS:
      return "WlkVulkanViewTargets";
    case WLK_STRUCT_CLOUD_SHADOW_INFO:
      return "WlkCloudShadowInfo";
    case WLK_STRUCT_CLOUD_SHADOW_STATE:
      return "WlkCloudShadowState";
    case WLK_STRUCT_AERIAL_PERSPECTIVE:
      return "WlkAerialPerspective";
    default:
      return "unknown structure";
  }
}

void checkPointer(const void* pointer, const char* argument) {
  if (pointer == nullptr) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, argument, "%s is null", argument);
  }
}

void checkHeader(const void* structure, uint32_t sType, uint32_t size, uint32_t firstSize) {
  checkPointer(structure, structName(sType));
  StructHeader header;
  std::memcpy(&header, structure, sizeof header.sType + sizeof header.structSize);
  if (header.sType != sType) {
    fail(WLK_ERROR_UNKNOWN_STRUCT, sType, "sType", "%s::sType is %u, expected %u",
         structName(sType), header.sType, sType);
  }
  if (header.structSize < firstSize) {
    failSize(sType, header.structSize, firstSize);
  }
  constexpr uint32_t largest = 1u << 16;
  if (header.structSize > largest) {
    fail(WLK_ERROR_INVALID_ARGUMENT, sType, "structSize", "%s::structSize is %u, over %u",
         structName(sType), header.structSize, largest);
  }
  const auto* bytes = static_cast<const unsigned char*>(structure);
  for (uint32_t i = size; i < header.structSize; ++i) {
    if (bytes[i] != 0) {
      fail(WLK_ERROR_STRUCT_TOO_NEW, sType, "structSize",
           "%s has a field at byte %u that this library does not know", structName(sType), i);
    }
  }
}

void checkOutput(const void* structure, uint32_t sType, uint32_t firstSize) {
  checkPointer(structure, structName(sType));
  StructHeader header;
  std::memcpy(&header, structure, sizeof header.sType + sizeof header.structSize);
  if (header.sType != sType) {
    fail(WLK_ERROR_UNKNOWN_STRUCT, sType, "sType", "%s::sType is %u, expected %u",
         structName(sType), header.sType, sType);
  }
  if (header.structSize < firstSize) {
    failSize(sType, header.structSize, firstSize);
  }
  checkNoChain(structure);
}

void checkReservedField(uint32_t sType, const char* field, uint32_t value) {
  if (value != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, sType, field, "%s::%s is %u, reserved fields are 0",
         structName(sType), field, value);
  }
}

void checkNoChain(const void* structure) {
  StructHeader header;
  std::memcpy(&header, structure, sizeof header);
  if (header.next != nullptr) {
    uint32_t chained = 0;
    std::memcpy(&chained, header.next, sizeof chained);
    fail(WLK_ERROR_UNKNOWN_STRUCT, header.sType, "next", "%s takes no chained structure (sType %u)",
         structName(header.sType), chained);
  }
}

void checkRoom(uint32_t sType, const char* field, uint64_t size, uint64_t least) {
  if (size < least) {
    fail(WLK_ERROR_INVALID_ARGUMENT, sType, field, "%s is %llu bytes, expected at least %llu",
         field, static_cast<unsigned long long>(size), static_cast<unsigned long long>(least));
  }
}

void checkRange(uint32_t sType, const char* field, double value, double lo, double hi) {
  if (!(value >= lo && value <= hi)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, sType, field, "%s::%s is %g, expected [%g, %g]",
         structName(sType), field, value, lo, hi);
  }
}

void checkRange3(uint32_t sType, const char* field, const float (&value)[3], double lo, double hi) {
  for (const float x : value) {
    checkRange(sType, field, static_cast<double>(x), lo, hi);
  }
}

void checkUnit(uint32_t sType, const char* field, const float (&value)[3]) {
  double sum = 0;
  for (const float x : value) {
    sum += static_cast<double>(x) * static_cast<double>(x);
  }
  const double length = std::sqrt(sum);
  if (!(std::abs(length - 1.0) <= 1e-3)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, sType, field, "%s::%s has the length %g, expected 1",
         structName(sType), field, length);
  }
}

void checkTransform(uint32_t sType, const char* field, const double* m) {
  for (int i = 0; i < 12; ++i) {
    if (!(std::abs(m[i]) <= 1e9)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, sType, field, "element %d is %g, expected |x| <= 1e9", i,
           m[i]);
    }
  }
  const glm::dmat3 linear(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);
  const double scale = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  const double determinant = std::abs(glm::determinant(linear));
  // Edges shorter than a millimetre or a box flatter than 1e-6 of its size are not usable.
  if (!(scale > 0) || !(determinant > 1e-6 * scale) || glm::length(linear[0]) < 1e-3 ||
      glm::length(linear[1]) < 1e-3 || glm::length(linear[2]) < 1e-3) {
    fail(WLK_ERROR_INVALID_ARGUMENT, sType, field, "the transform is not invertible");
  }
}

}  // namespace welkin
