// SPDX-License-Identifier: MIT
// The C API with C++ manners: initialised structures, results as exceptions, an owned context.
#pragma once

#include <welkin/welkin.h>

#include <memory>
#include <string>

namespace host {

/// sType of a structure; one overload per structure that the host fills.
inline constexpr WlkStructType structType(const WlkErrorInfo&) {
  return WLK_STRUCT_ERROR_INFO;
}
inline constexpr WlkStructType structType(const WlkContextInfo&) {
  return WLK_STRUCT_CONTEXT_INFO;
}
inline constexpr WlkStructType structType(const WlkHeadlessInfo&) {
  return WLK_STRUCT_HEADLESS_INFO;
}
inline constexpr WlkStructType structType(const WlkCapabilities&) {
  return WLK_STRUCT_CAPABILITIES;
}
inline constexpr WlkStructType structType(const WlkPlanet&) {
  return WLK_STRUCT_PLANET;
}
inline constexpr WlkStructType structType(const WlkSky&) {
  return WLK_STRUCT_SKY;
}
inline constexpr WlkStructType structType(const WlkLight&) {
  return WLK_STRUCT_LIGHT;
}
inline constexpr WlkStructType structType(const WlkFog&) {
  return WLK_STRUCT_FOG;
}
inline constexpr WlkStructType structType(const WlkAbsorber&) {
  return WLK_STRUCT_ABSORBER;
}
inline constexpr WlkStructType structType(const WlkAmbient&) {
  return WLK_STRUCT_AMBIENT;
}
inline constexpr WlkStructType structType(const WlkMediumInfo&) {
  return WLK_STRUCT_MEDIUM_INFO;
}
inline constexpr WlkStructType structType(const WlkMediumOptics&) {
  return WLK_STRUCT_MEDIUM_OPTICS;
}
inline constexpr WlkStructType structType(const WlkSurfaceInfo&) {
  return WLK_STRUCT_SURFACE_INFO;
}
inline constexpr WlkStructType structType(const WlkSurfaceDetail&) {
  return WLK_STRUCT_SURFACE_DETAIL;
}
inline constexpr WlkStructType structType(const WlkVolumeInfo&) {
  return WLK_STRUCT_VOLUME_INFO;
}
inline constexpr WlkStructType structType(const WlkVolumeUpload&) {
  return WLK_STRUCT_VOLUME_UPLOAD;
}
inline constexpr WlkStructType structType(const WlkVolumeBricks&) {
  return WLK_STRUCT_VOLUME_BRICKS;
}
inline constexpr WlkStructType structType(const WlkVolumeState&) {
  return WLK_STRUCT_VOLUME_STATE;
}
inline constexpr WlkStructType structType(const WlkViewInfo&) {
  return WLK_STRUCT_VIEW_INFO;
}
inline constexpr WlkStructType structType(const WlkCamera&) {
  return WLK_STRUCT_CAMERA;
}
inline constexpr WlkStructType structType(const WlkQuality&) {
  return WLK_STRUCT_QUALITY;
}
inline constexpr WlkStructType structType(const WlkQualityState&) {
  return WLK_STRUCT_QUALITY_STATE;
}
inline constexpr WlkStructType structType(const WlkLightShadow&) {
  return WLK_STRUCT_LIGHT_SHADOW;
}
inline constexpr WlkStructType structType(const WlkHeadlessInputs&) {
  return WLK_STRUCT_HEADLESS_INPUTS;
}
inline constexpr WlkStructType structType(const WlkImageData&) {
  return WLK_STRUCT_IMAGE_DATA;
}
inline constexpr WlkStructType structType(const WlkFrameStats&) {
  return WLK_STRUCT_FRAME_STATS;
}
inline constexpr WlkStructType structType(const WlkErrorEstimate&) {
  return WLK_STRUCT_ERROR_ESTIMATE;
}
inline constexpr WlkStructType structType(const WlkRayBatch&) {
  return WLK_STRUCT_RAY_BATCH;
}
inline constexpr WlkStructType structType(const WlkPhaseQuery&) {
  return WLK_STRUCT_PHASE_QUERY;
}
inline constexpr WlkStructType structType(const WlkSkyMapQuery&) {
  return WLK_STRUCT_SKY_MAP_QUERY;
}

/// Throws unless `result` is a success. A value that the library rejects is the input's fault
/// (InputError: `file`: `key`.<field>: message); everything else is a HostError.
void check(WlkResult result, const std::string& file, const std::string& key);

/// The same for calls that no input can make fail.
void check(WlkResult result, const char* call);

/// A structure with the library's defaults.
template <class Struct>
Struct make() {
  Struct value{};
  check(wlkInitStruct(structType(value), sizeof(Struct), &value), "wlkInitStruct");
  return value;
}

/// A part of an atmosphere, WLK_ATMOSPHERE_*.
template <class Struct>
Struct makePreset(uint32_t preset) {
  Struct value{};
  check(wlkInitPresetStruct(preset, structType(value), sizeof(Struct), &value),
        "wlkInitPresetStruct");
  return value;
}

struct ContextDeleter {
  void operator()(WlkContext context) const { wlkDestroyContext(context); }
};
using ContextPtr = std::unique_ptr<WlkContext_T, ContextDeleter>;

/// Counts what the library logs as error or warning, and repeats it on stderr.
struct LogCounter {
  uint32_t problems = 0;
  static void receive(void* user, const WlkLogMessage* message);
};

/// A context without Vulkan.
ContextPtr makeCpuContext();

/// A context with its own device. `log` must outlive it.
ContextPtr makeHeadlessContext(bool validation, const std::string& deviceName, LogCounter& log);

}  // namespace host
