// SPDX-License-Identifier: MIT
// The defaults that the header documents, in one place.
#include <algorithm>
#include <cstring>

#include "api/error.hpp"
#include "api/validate.hpp"
#include "welkin/welkin_vulkan.h"

namespace {

using namespace welkin;

template <typename T>
T blank(uint32_t sType) {
  T value{};
  value.sType = sType;
  value.structSize = sizeof(T);
  return value;
}

// The caller's header may be older: as much as it knows.
template <typename T>
void write(const T& value, uint32_t structSize, void* structure) {
  if (structSize < FIRST_SIZE<T>) {
    fail(WLK_ERROR_INVALID_ARGUMENT, value.sType, "structSize",
         "%s::structSize is %u, expected at least %u", structName(value.sType), structSize,
         FIRST_SIZE<T>);
  }
  std::memset(structure, 0, structSize);
  std::memcpy(structure, &value, std::min<size_t>(structSize, sizeof value));
  std::memcpy(static_cast<char*>(structure) + sizeof(uint32_t), &structSize, sizeof structSize);
}

template <size_t N>
void assign(float (&to)[N], const float (&from)[N]) {
  std::memcpy(to, from, sizeof to);
}

WlkPlanet planet() {
  auto p = blank<WlkPlanet>(WLK_STRUCT_PLANET);
  p.up[1] = 1.0f;
  p.radius = 6.371e6f;
  assign(p.groundAlbedo, {0.1f, 0.1f, 0.1f});
  return p;
}

WlkSky sky() {
  auto s = blank<WlkSky>(WLK_STRUCT_SKY);
  assign(s.rayleighScattering, {5.8e-6f, 1.35e-5f, 3.31e-5f});
  s.scaleHeight = 8000.0f;
  return s;
}

WlkLight light() {
  auto l = blank<WlkLight>(WLK_STRUCT_LIGHT);
  l.direction[1] = 1.0f;
  l.angularDiameter = 0.0093f;
  assign(l.irradiance, {1.0f, 1.0f, 1.0f});
  return l;
}

WlkAmbient ambient() {
  auto a = blank<WlkAmbient>(WLK_STRUCT_AMBIENT);
  a.mode = WLK_AMBIENT_AUTOMATIC;
  return a;
}

WlkFog fog() {
  auto f = blank<WlkFog>(WLK_STRUCT_FOG);
  f.dropletDiameter_um = 10.0f;
  f.extinction = 0.002f;
  f.scaleHeight = 100.0f;
  assign(f.singleScatteringAlbedo, {1.0f, 1.0f, 1.0f});
  return f;
}

WlkAbsorber absorber() {
  auto a = blank<WlkAbsorber>(WLK_STRUCT_ABSORBER);
  assign(a.absorption, {2.7e-6f, 1.7e-6f, 8.5e-8f});
  a.peakAltitude = 25000.0f;
  a.halfWidth = 15000.0f;
  return a;
}

WlkMediumInfo medium() {
  auto m = blank<WlkMediumInfo>(WLK_STRUCT_MEDIUM_INFO);
  m.asymmetry = 0.85f;
  assign(m.singleScatteringAlbedo, {1.0f, 1.0f, 1.0f});
  return m;
}

WlkVolumeInfo volume() {
  auto v = blank<WlkVolumeInfo>(WLK_STRUCT_VOLUME_INFO);
  v.size[0] = v.size[1] = v.size[2] = 1;
  v.fieldStride = sizeof(WlkVolumeField);
  v.worldFromVolume[0] = v.worldFromVolume[5] = v.worldFromVolume[10] = 1.0;
  return v;
}

WlkSurfaceInfo surface() {
  auto s = blank<WlkSurfaceInfo>(WLK_STRUCT_SURFACE_INFO);
  s.vertexStride = 3 * sizeof(float);
  s.worldFromSurface[0] = s.worldFromSurface[5] = s.worldFromSurface[10] = 1.0;
  return s;
}

WlkSurfaceDetail surfaceDetail() {
  auto d = blank<WlkSurfaceDetail>(WLK_STRUCT_SURFACE_DETAIL);
  d.softness = 0.3f;
  return d;
}

WlkVolumeUpload upload() {
  auto u = blank<WlkVolumeUpload>(WLK_STRUCT_VOLUME_UPLOAD);
  u.format = WLK_FORMAT_R32_FLOAT;
  return u;
}

WlkVolumeBricks bricks() {
  auto b = blank<WlkVolumeBricks>(WLK_STRUCT_VOLUME_BRICKS);
  b.format = WLK_FORMAT_R32_FLOAT;
  return b;
}

WlkViewInfo view() {
  auto v = blank<WlkViewInfo>(WLK_STRUCT_VIEW_INFO);
  v.width = 1280;
  v.height = 720;
  v.targetFormat = WLK_TARGET_RGBA16_FLOAT;
  v.layers = WLK_LAYER_ALL;
  return v;
}

WlkCamera camera() {
  auto c = blank<WlkCamera>(WLK_STRUCT_CAMERA);
  c.position[1] = 2.0;
  c.viewFromWorld[0] = c.viewFromWorld[4] = c.viewFromWorld[8] = 1.0f;
  c.preExposure = 1.0f;
  // 60 degrees vertically, 16:9, y down in clip space, infinite reversed depth, near plane 0.1 m.
  constexpr float cotangent = 1.7320508f;
  c.clipFromView[0] = cotangent * 9.0f / 16.0f;
  c.clipFromView[5] = -cotangent;
  c.clipFromView[11] = -1.0f;
  c.clipFromView[14] = 0.1f;
  return c;
}

WlkQuality quality() {
  auto q = blank<WlkQuality>(WLK_STRUCT_QUALITY);
  q.level = WLK_QUALITY_HIGH;
  return q;
}

WlkContextInfo context() {
  auto c = blank<WlkContextInfo>(WLK_STRUCT_CONTEXT_INFO);
  c.maxFramesInFlight = 3;
  return c;
}

WlkRayBatch rays() {
  auto r = blank<WlkRayBatch>(WLK_STRUCT_RAY_BATCH);
  r.stride = sizeof(WlkRay);
  return r;
}

WlkSkyMapQuery skyMap() {
  auto q = blank<WlkSkyMapQuery>(WLK_STRUCT_SKY_MAP_QUERY);
  q.size = 32;
  return q;
}

WlkCloudShadowInfo shadowMap() {
  auto m = blank<WlkCloudShadowInfo>(WLK_STRUCT_CLOUD_SHADOW_INFO);
  m.width = m.height = 512;
  m.extent[0] = m.extent[1] = 20000;
  m.maxSamples = 512;
  return m;
}

WlkLightShadow lightShadow() {
  auto s = blank<WlkLightShadow>(WLK_STRUCT_LIGHT_SHADOW);
  s.cascadeCount = 1;
  for (auto& matrix : s.clipFromWorld) {
    matrix[0] = matrix[5] = matrix[10] = matrix[15] = 1;
  }
  s.bias = 0.1f;
  return s;
}

WlkAerialPerspective aerial() {
  auto a = blank<WlkAerialPerspective>(WLK_STRUCT_AERIAL_PERSPECTIVE);
  a.width = 64;
  a.height = 36;
  a.depth = 32;
  a.exponent = 2.0f;
  a.distance = 32000.0f;
  return a;
}

WlkVulkanImage vulkanImage() {
  auto i = blank<WlkVulkanImage>(WLK_STRUCT_VULKAN_IMAGE);
  i.depth = 1;
  i.layerCount = 1;
  return i;
}

WlkPhaseQuery phaseQuery() {
  auto q = blank<WlkPhaseQuery>(WLK_STRUCT_PHASE_QUERY);
  q.order = 1;
  q.opticalDepth = 1;
  return q;
}

void writeDefault(uint32_t sType, uint32_t structSize, void* structure) {
  switch (sType) {
    case WLK_STRUCT_ERROR_INFO:
      return write(blank<WlkErrorInfo>(sType), structSize, structure);
    case WLK_STRUCT_CONTEXT_INFO:
      return write(context(), structSize, structure);
    case WLK_STRUCT_HEADLESS_INFO:
      return write(blank<WlkHeadlessInfo>(sType), structSize, structure);
    case WLK_STRUCT_CAPABILITIES:
      return write(blank<WlkCapabilities>(sType), structSize, structure);
    case WLK_STRUCT_LOG_MESSAGE:
      return write(blank<WlkLogMessage>(sType), structSize, structure);
    case WLK_STRUCT_PLANET:
      return write(planet(), structSize, structure);
    case WLK_STRUCT_SKY:
      return write(sky(), structSize, structure);
    case WLK_STRUCT_LIGHT:
      return write(light(), structSize, structure);
    case WLK_STRUCT_FOG:
      return write(fog(), structSize, structure);
    case WLK_STRUCT_ABSORBER:
      return write(absorber(), structSize, structure);
    case WLK_STRUCT_AMBIENT:
      return write(ambient(), structSize, structure);
    case WLK_STRUCT_MEDIUM_INFO:
      return write(medium(), structSize, structure);
    case WLK_STRUCT_MEDIUM_OPTICS:
      return write(blank<WlkMediumOptics>(sType), structSize, structure);
    case WLK_STRUCT_VOLUME_INFO:
      return write(volume(), structSize, structure);
    case WLK_STRUCT_SURFACE_INFO:
      return write(surface(), structSize, structure);
    case WLK_STRUCT_SURFACE_DETAIL:
      return write(surfaceDetail(), structSize, structure);
    case WLK_STRUCT_VOLUME_UPLOAD:
      return write(upload(), structSize, structure);
    case WLK_STRUCT_VOLUME_BRICKS:
      return write(bricks(), structSize, structure);
    case WLK_STRUCT_VOLUME_STATE:
      return write(blank<WlkVolumeState>(sType), structSize, structure);
    case WLK_STRUCT_VIEW_INFO:
      return write(view(), structSize, structure);
    case WLK_STRUCT_CAMERA:
      return write(camera(), structSize, structure);
    case WLK_STRUCT_QUALITY:
      return write(quality(), structSize, structure);
    case WLK_STRUCT_QUALITY_STATE:
      return write(blank<WlkQualityState>(sType), structSize, structure);
    case WLK_STRUCT_FRAME_INFO:
      return write(blank<WlkFrameInfo>(sType), structSize, structure);
    case WLK_STRUCT_HEADLESS_INPUTS:
      return write(blank<WlkHeadlessInputs>(sType), structSize, structure);
    case WLK_STRUCT_IMAGE_DATA:
      return write(blank<WlkImageData>(sType), structSize, structure);
    case WLK_STRUCT_FRAME_STATS:
      return write(blank<WlkFrameStats>(sType), structSize, structure);
    case WLK_STRUCT_ERROR_ESTIMATE:
      return write(blank<WlkErrorEstimate>(sType), structSize, structure);
    case WLK_STRUCT_LIGHT_SHADOW:
      return write(lightShadow(), structSize, structure);
    case WLK_STRUCT_RAY_BATCH:
      return write(rays(), structSize, structure);
    case WLK_STRUCT_SKY_MAP_QUERY:
      return write(skyMap(), structSize, structure);
    case WLK_STRUCT_PHASE_QUERY:
      return write(phaseQuery(), structSize, structure);
    case WLK_STRUCT_VULKAN_DEVICE_INFO:
      return write(blank<WlkVulkanDeviceInfo>(sType), structSize, structure);
    case WLK_STRUCT_VULKAN_REQUIREMENTS:
      return write(blank<WlkVulkanRequirements>(sType), structSize, structure);
    case WLK_STRUCT_VULKAN_IMAGE:
      return write(vulkanImage(), structSize, structure);
    case WLK_STRUCT_VULKAN_VIEW_TARGETS:
      return write(blank<WlkVulkanViewTargets>(sType), structSize, structure);
    case WLK_STRUCT_CLOUD_SHADOW_INFO:
      return write(shadowMap(), structSize, structure);
    case WLK_STRUCT_CLOUD_SHADOW_STATE:
      return write(blank<WlkCloudShadowState>(sType), structSize, structure);
    case WLK_STRUCT_AERIAL_PERSPECTIVE:
      return write(aerial(), structSize, structure);
    default:
      fail(WLK_ERROR_UNKNOWN_STRUCT, sType, "sType", "%u is no structure of this library", sType);
  }
}

}  // namespace

WlkResult wlkInitStruct(uint32_t sType, uint32_t structSize, void* structure) {
  return guarded([&] {
    checkPointer(structure, "structure");
    writeDefault(sType, structSize, structure);
    return WLK_SUCCESS;
  });
}
