/* SPDX-License-Identifier: MIT
 *
 * A C99 program that calls every function: on a CPU context those that need no device must work,
 * and those that need one must say so. Counts, allocations and handles are checked on the way.
 */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <welkin/welkin_vulkan.h>

#define INIT(sType, structure) \
  EXPECT(WLK_SUCCESS, wlkInitStruct((sType), sizeof(structure), &(structure)))
#define PRESET(type, value) \
  EXPECT(WLK_SUCCESS, wlkInitPresetStruct(WLK_ATMOSPHERE_MARS, type, sizeof(value), &(value)))
#define EXPECT(expected, call) expectResult(expected, call, #call, __LINE__)
#define REQUIRE(condition) require(condition, #condition, __LINE__)

static int failures = 0;
static long long liveBlocks = 0;

static void require(int condition, const char* text, int line) {
  if (!condition) {
    fprintf(stderr, "line %d: not true: %s\n", line, text);
    ++failures;
  }
}

static void expectResult(WlkResult expected, WlkResult result, const char* call, int line) {
  if (result != expected) {
    WlkErrorInfo info;
    memset(&info, 0, sizeof info);
    (void)wlkInitStruct(WLK_STRUCT_ERROR_INFO, sizeof info, &info);
    (void)wlkGetLastError(&info);
    fprintf(stderr, "line %d: %s gave %s (%s: %s), expected %s\n", line, call,
            wlkResultName(result), info.field, info.message, wlkResultName(expected));
    ++failures;
  }
}

static void* allocate(void* user, uint64_t size, uint64_t alignment) {
  void* memory = NULL;
  (void)user;
  /* C99 has no aligned allocation: room for the alignment and for the block's own address. */
  void* block = malloc((size_t)(size + alignment + sizeof(void*)));
  if (block != NULL) {
    uintptr_t first = (uintptr_t)block + sizeof(void*);
    memory = (void*)((first + (uintptr_t)alignment - 1u) & ~((uintptr_t)alignment - 1u));
    memcpy((char*)memory - sizeof(void*), &block, sizeof block);
    ++liveBlocks;
  }
  return memory;
}

static void release(void* user, void* memory, uint64_t size, uint64_t alignment) {
  void* block = NULL;
  (void)user;
  (void)size;
  (void)alignment;
  memcpy(&block, (char*)memory - sizeof(void*), sizeof block);
  free(block);
  --liveBlocks;
}

static WlkContext createContext(void) {
  WlkContextInfo info;
  WlkContext context = NULL;
  INIT(WLK_STRUCT_CONTEXT_INFO, info);
  REQUIRE(info.maxFramesInFlight == 3);
  info.allocator.allocate = allocate;
  info.allocator.release = release;
  EXPECT(WLK_SUCCESS, wlkCreateContext(WLK_API_VERSION, &info, &context));
  return context;
}

static void freeFunctions(void) {
  WlkErrorInfo error;
  WlkSky sky;
  /* Only the major version: this program stays, the library goes on. */
  REQUIRE(wlkGetVersion() >> 22 == WLK_VERSION_MAJOR);
  REQUIRE(strcmp(wlkResultName(WLK_ERROR_VERSION), "WLK_ERROR_VERSION") == 0);
  REQUIRE(strcmp(wlkResultName(12345), "WLK_UNKNOWN_RESULT") == 0);
  REQUIRE(strcmp(wlkReasonName(WLK_REASON_ZERO_DENSITY), "WLK_REASON_ZERO_DENSITY") == 0);
  REQUIRE(strcmp(wlkApproximationName(WLK_APPROXIMATION_FOG), "WLK_APPROXIMATION_FOG") == 0);
  REQUIRE(strcmp(wlkControlReasonName(WLK_CONTROL_REASON_IDLE), "WLK_CONTROL_REASON_IDLE") == 0);
  /* Numbers of a later library have a name here, too: one that says so. */
  REQUIRE(strcmp(wlkReasonName(12345), "WLK_UNKNOWN_REASON") == 0);
  REQUIRE(strcmp(wlkApproximationName(12345), "WLK_UNKNOWN_APPROXIMATION") == 0);
  REQUIRE(strcmp(wlkControlReasonName(12345), "WLK_UNKNOWN_CONTROL_REASON") == 0);
  EXPECT(WLK_ERROR_UNKNOWN_STRUCT, wlkInitStruct(9999, sizeof sky, &sky));
  EXPECT(WLK_ERROR_INVALID_ARGUMENT, wlkInitStruct(WLK_STRUCT_SKY, 4, &sky));
  INIT(WLK_STRUCT_ERROR_INFO, error);
  EXPECT(WLK_SUCCESS, wlkGetLastError(&error));
  REQUIRE(error.result == WLK_ERROR_INVALID_ARGUMENT && error.message[0] != '\0');
}

/* Returns the number of values that are not finite or below 0. */
static int countBad(const double* values, int count) {
  int bad = 0;
  for (int i = 0; i < count; ++i) {
    bad += !(isfinite(values[i]) && values[i] >= 0.0);
  }
  return bad;
}

/* A caller of later headers: longer structures, with 0 in what this library does not know. */
static void laterHeaders(WlkContext context) {
  struct {
    WlkLight light;
    unsigned char later[4096]; /* more than the structure will ever grow by */
  } longer;
  memset(&longer, 0x5a, sizeof longer);
  EXPECT(WLK_SUCCESS, wlkInitStruct(WLK_STRUCT_LIGHT, (uint32_t)sizeof longer, &longer));
  REQUIRE(longer.light.structSize == sizeof longer && longer.later[4095] == 0);
  EXPECT(WLK_SUCCESS, wlkSetLights(context, 1, (uint32_t)sizeof longer, &longer.light));
  longer.later[4095] = 1;
  EXPECT(WLK_ERROR_STRUCT_TOO_NEW,
         wlkSetLights(context, 1, (uint32_t)sizeof longer, &longer.light));
}

static void atmosphere(WlkContext context) {
  WlkPlanet planet;
  WlkSky sky;
  WlkAbsorber gas;
  WlkFog haze;
  WlkMediumInfo dust;
  WlkLight sun;
  WlkLight moon;
  const float toMoon[3] = {0.6f, 0.8f, 0.0f};
  INIT(WLK_STRUCT_LIGHT, moon);
  EXPECT(WLK_ERROR_INVALID_ARGUMENT,
         wlkInitPresetStruct(1000, WLK_STRUCT_PLANET, sizeof planet, &planet));
  PRESET(WLK_STRUCT_PLANET, planet);
  PRESET(WLK_STRUCT_SKY, sky);
  PRESET(WLK_STRUCT_ABSORBER, gas);
  PRESET(WLK_STRUCT_FOG, haze);
  PRESET(WLK_STRUCT_MEDIUM_INFO, dust);
  PRESET(WLK_STRUCT_LIGHT, sun);
  REQUIRE(sun.sType == WLK_STRUCT_LIGHT && sun.structSize == sizeof sun);
  EXPECT(WLK_SUCCESS, wlkSetPlanet(context, &planet));
  EXPECT(WLK_SUCCESS, wlkSetSky(context, &sky));
  EXPECT(WLK_SUCCESS, wlkSetAbsorber(context, &gas));
  EXPECT(WLK_SUCCESS, wlkCreateMedium(context, &dust, &haze.medium));
  EXPECT(WLK_SUCCESS, wlkSetFog(context, &haze));
  EXPECT(WLK_SUCCESS, wlkDestroyMedium(context, haze.medium));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkSetFog(context, &haze));
  EXPECT(WLK_SUCCESS, wlkInitMoon(sun.direction, toMoon, sun.irradiance, &moon));
  EXPECT(WLK_SUCCESS, wlkSetLights(context, 1, sizeof moon, &moon));
  EXPECT(WLK_SUCCESS, wlkSetAbsorber(context, NULL));
  EXPECT(WLK_SUCCESS, wlkSetAmbient(context, NULL));
}

static void scene(WlkContext context) {
  WlkPlanet planet;
  WlkSky sky;
  WlkLight light;
  WlkFog fog;
  INIT(WLK_STRUCT_PLANET, planet);
  INIT(WLK_STRUCT_SKY, sky);
  INIT(WLK_STRUCT_LIGHT, light);
  INIT(WLK_STRUCT_FOG, fog);
  EXPECT(WLK_SUCCESS, wlkSetPlanet(context, &planet));
  EXPECT(WLK_SUCCESS, wlkSetSky(context, &sky));
  EXPECT(WLK_SUCCESS, wlkSetLights(context, 1, sizeof light, &light));
  EXPECT(WLK_SUCCESS, wlkSetFog(context, &fog));
}

static void queries(WlkContext context) {
  WlkCapabilities capabilities;
  WlkRayBatch batch;
  WlkRay ray = {{0.0, 2.0, 0.0}, {0.6, 0.8, 0.0}, INFINITY};
  WlkSkyMapQuery mapQuery;
  float map[4 * 4 * 3];
  double radiance[3], transmittance[3], irradiance[3], ambient[WLK_AMBIENT_VALUES];
  double first[3], diffuse[3], matrix[9];
  const double position[3] = {0.0, 2.0, 0.0}, up[3] = {0.0, 1.0, 0.0}, above[3] = {0.0, 9e4, 0.0};

  INIT(WLK_STRUCT_CAPABILITIES, capabilities);
  EXPECT(WLK_SUCCESS, wlkGetCapabilities(context, &capabilities));
  REQUIRE(capabilities.mode == WLK_MODE_CPU && capabilities.vulkanVersion == 0);
  REQUIRE(capabilities.maxLights >= 1 && capabilities.deviceName[0] == '\0');

  INIT(WLK_STRUCT_RAY_BATCH, batch);
  REQUIRE(batch.stride == sizeof ray);
  batch.count = 1;
  batch.rays = &ray;
  EXPECT(WLK_SUCCESS, wlkEvalSky(context, &batch, radiance, transmittance));
  REQUIRE(countBad(radiance, 3) == 0 && countBad(transmittance, 3) == 0);
  REQUIRE(radiance[2] > radiance[0]); /* a clear sky is blue */
  batch.maxOrder = 1;
  EXPECT(WLK_SUCCESS, wlkEvalSky(context, &batch, first, NULL));
  REQUIRE(first[0] > 0.0 && first[0] < radiance[0]);
  EXPECT(WLK_SUCCESS, wlkEvalTransmittance(context, position, above, transmittance));
  REQUIRE(transmittance[2] > 0.0 && transmittance[0] > transmittance[2] && transmittance[0] < 1.0);
  EXPECT(WLK_SUCCESS, wlkGetColorMatrix(WLK_COLOR_WAVELENGTHS, matrix));
  REQUIRE(matrix[0] == 1.0 && matrix[1] == 0.0 && matrix[8] == 1.0);
  EXPECT(WLK_SUCCESS, wlkEvalLight(context, 0, position, irradiance));
  REQUIRE(countBad(irradiance, 3) == 0 && irradiance[0] > irradiance[2]);
  EXPECT(WLK_SUCCESS, wlkEvalAmbient(context, position, ambient));
  REQUIRE(ambient[2] > ambient[0]);
  EXPECT(WLK_SUCCESS, wlkEvalIrradiance(context, position, up, first, diffuse));
  REQUIRE(first[0] > 0.99 * irradiance[0] && diffuse[2] > diffuse[0] && countBad(diffuse, 3) == 0);
  INIT(WLK_STRUCT_SKY_MAP_QUERY, mapQuery);
  REQUIRE(mapQuery.size == 32 && mapQuery.maxOrder == 0);
  mapQuery.size = 4;
  EXPECT(WLK_SUCCESS, wlkEvalSkyMap(context, &mapQuery, map, sizeof map));
  REQUIRE(map[2] > 0.0f && isfinite(map[4 * 4 * 3 - 1]));
}

static void phaseQueries(WlkContext context, WlkMedium medium) {
  WlkPhaseQuery query;
  WlkMediumOptics optics;
  double phase[6], sampled[2], density[2];
  const double angle[2] = {0.0, 1.0}, random[2] = {0.25, 0.75};
  const float water = 1e-3f;
  float extinction = 0.0f;

  INIT(WLK_STRUCT_PHASE_QUERY, query);
  query.medium = medium;
  query.count = 2;
  query.scatteringAngle = angle;
  EXPECT(WLK_SUCCESS, wlkEvalPhase(context, &query, phase));
  REQUIRE(phase[0] > phase[3] && phase[2] > phase[5] && countBad(phase, 6) == 0);
  EXPECT(WLK_SUCCESS, wlkSamplePhase(context, medium, 1, 2, random, sampled, density));
  REQUIRE(sampled[0] != sampled[1] && countBad(sampled, 2) == 0 && countBad(density, 2) == 0);
  INIT(WLK_STRUCT_MEDIUM_OPTICS, optics);
  EXPECT(WLK_SUCCESS, wlkGetMediumOptics(context, medium, &optics));
  REQUIRE(optics.asymmetry[0] > 0.8f && optics.effectiveRadius_um > 0.0f);
  EXPECT(WLK_SUCCESS, wlkEvalWaterExtinction(context, medium, 1, &water, NULL, &extinction));
  REQUIRE(extinction > 0.1f && extinction < 1.0f);
}

/* Media serve the phase queries of a host; volumes are for rendering only and need a device. */
static void objects(WlkContext context) {
  static const double moved[12] = {10, 0, 0, 5, 0, 10, 0, 5, 0, 0, 10, 5};
  WlkMediumInfo mediumInfo;
  WlkVolumeInfo volumeInfo;
  WlkVolumeUpload upload;
  WlkVolumeBricks bricks;
  WlkVolumeState state;
  WlkVolumeField field;
  WlkMedium medium = {0};
  WlkVolume volume = {0};
  WlkSurfaceInfo surfaceInfo;
  WlkSurfaceDetail surfaceDetail;
  WlkSurface surface = {0};
  static const float places[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

  INIT(WLK_STRUCT_MEDIUM_INFO, mediumInfo);
  EXPECT(WLK_SUCCESS, wlkCreateMedium(context, &mediumInfo, &medium));
  phaseQueries(context, medium);
  INIT(WLK_STRUCT_VOLUME_INFO, volumeInfo);
  REQUIRE(volumeInfo.fieldStride == sizeof field);
  memset(&field, 0, sizeof field);
  field.medium = medium;
  volumeInfo.fieldCount = 1;
  volumeInfo.fields = &field;
  INIT(WLK_STRUCT_VOLUME_UPLOAD, upload);
  EXPECT(WLK_ERROR_WRONG_STATE, wlkCreateVolume(context, &volumeInfo, &volume));
  REQUIRE(volume.id == 0);
  REQUIRE(wlkSetVolumeTransform(context, volume, moved) < 0);
  REQUIRE(wlkUploadVolume(context, volume, &upload) < 0);
  INIT(WLK_STRUCT_VOLUME_BRICKS, bricks);
  REQUIRE(wlkUploadVolumeBricks(context, volume, &bricks) < 0);
  REQUIRE(wlkUploadVolumeDiameters(context, volume, &upload) < 0);
  REQUIRE(wlkClearVolumeDiameters(context, volume) < 0);
  INIT(WLK_STRUCT_VOLUME_STATE, state);
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkGetVolumeState(context, volume, &state));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkDestroyVolume(context, volume));
  INIT(WLK_STRUCT_SURFACE_INFO, surfaceInfo);
  REQUIRE(surfaceInfo.vertexStride == 3 * sizeof(float));
  EXPECT(WLK_ERROR_INVALID_ARGUMENT, wlkCreateSurface(context, &surfaceInfo, &surface));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkSetSurfaceTransform(context, surface, moved));
  INIT(WLK_STRUCT_SURFACE_DETAIL, surfaceDetail);
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkSetSurfaceDetail(context, surface, &surfaceDetail));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkSetSurfacePositions(context, surface, places, 4, 12));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkDestroySurface(context, surface));
  EXPECT(WLK_SUCCESS, wlkDestroyMedium(context, medium));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkDestroyMedium(context, medium));
}

/* Maps are of an engine's device alone, so that no handle of one is known here. */
static void cloudShadows(WlkContext context) {
  WlkCloudShadowInfo info;
  WlkCloudShadowState state;
  WlkVulkanImage image;
  WlkCloudShadow map = {0};

  INIT(WLK_STRUCT_CLOUD_SHADOW_INFO, info);
  REQUIRE(info.width == 512 && info.height == 512 && info.extent[1] == 20000.0);
  INIT(WLK_STRUCT_CLOUD_SHADOW_STATE, state);
  INIT(WLK_STRUCT_VULKAN_IMAGE, image);
  EXPECT(WLK_ERROR_WRONG_STATE, wlkCreateCloudShadow(context, &info, &map));
  REQUIRE(map.id == 0);
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkSetCloudShadow(context, map, &info));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkGetCloudShadowState(context, map, &state));
  EXPECT(WLK_ERROR_WRONG_STATE, wlkVulkanCmdRenderCloudShadow(context, NULL, map, &image));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkDestroyCloudShadow(context, map));
}

/* The same of what views estimate and control. */
static void viewStates(WlkContext context) {
  WlkErrorEstimate estimate;
  WlkQualityState state;
  WlkView view = {0};

  INIT(WLK_STRUCT_ERROR_ESTIMATE, estimate);
  INIT(WLK_STRUCT_QUALITY_STATE, state);
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkGetErrorEstimate(context, view, &estimate));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkGetQualityState(context, view, &state));
  EXPECT(WLK_ERROR_INVALID_HANDLE, wlkReportFrameTime(context, view, 1, 2.0));
  REQUIRE(estimate.relativeError == 0.0f && state.switches == 0);
}

/* Every function that needs a device refuses a CPU context with a negative code. */
static void deviceFunctions(WlkContext context) {
  WlkViewInfo viewInfo;
  WlkCamera camera;
  WlkQuality quality;
  WlkFrameInfo frame;
  WlkImageData image;
  WlkFrameStats stats;
  WlkVulkanRequirements requirements;
  WlkVulkanViewTargets targets;
  WlkLightShadow shadow;
  WlkAerialPerspective aerial;
  WlkView view = {0};
  WlkVolume volume = {0};
  uint32_t passCount = 0;

  INIT(WLK_STRUCT_VULKAN_REQUIREMENTS, requirements);
  EXPECT(WLK_SUCCESS, wlkVulkanGetRequirements(&requirements));
  REQUIRE(requirements.apiVersion >= VK_API_VERSION_1_3);

  INIT(WLK_STRUCT_VIEW_INFO, viewInfo);
  INIT(WLK_STRUCT_CAMERA, camera);
  INIT(WLK_STRUCT_QUALITY, quality);
  INIT(WLK_STRUCT_FRAME_INFO, frame);
  INIT(WLK_STRUCT_IMAGE_DATA, image);
  INIT(WLK_STRUCT_FRAME_STATS, stats);
  INIT(WLK_STRUCT_VULKAN_VIEW_TARGETS, targets);
  INIT(WLK_STRUCT_LIGHT_SHADOW, shadow);
  REQUIRE(shadow.cascadeCount == 1 && shadow.clipFromWorld[3][15] == 1.0f);
  targets.lightShadow = &shadow;
  INIT(WLK_STRUCT_AERIAL_PERSPECTIVE, aerial);
  REQUIRE(targets.aerialRadiance == NULL && targets.aerialTransmittance == NULL);
  REQUIRE(aerial.width == 64 && aerial.height == 36 && aerial.depth == 32);
  REQUIRE(aerial.exponent == 2.0f && aerial.distance == 32000.0f);
  frame.frameIndex = 1;
  EXPECT(WLK_ERROR_WRONG_STATE, wlkPrepare(context));
  EXPECT(WLK_ERROR_WRONG_STATE, wlkBeginFrame(context, &frame));
  REQUIRE(wlkCreateView(NULL, &viewInfo, &view) < 0);
  REQUIRE(wlkUpdateView(context, view, &viewInfo) < 0);
  REQUIRE(wlkSetCamera(context, view, &camera) < 0);
  REQUIRE(wlkSetQuality(context, view, &quality) < 0);
  REQUIRE(wlkRenderHeadless(context, view, NULL) < 0);
  REQUIRE(wlkReadback(context, view, &image) < 0);
  REQUIRE(wlkGetFrameStats(context, view, &stats, &passCount, sizeof(WlkPassStats), NULL) < 0);
  REQUIRE(wlkDestroyView(context, view) < 0);
  REQUIRE(wlkVulkanSetVolumeImage(context, volume, 0, NULL) < 0);
  REQUIRE(wlkVulkanForgetImage(context, VK_NULL_HANDLE) < 0);
  REQUIRE(wlkVulkanCmdUpdate(context, NULL) < 0);
  REQUIRE(wlkVulkanCmdRenderView(context, NULL, view, &targets) < 0);
  EXPECT(WLK_ERROR_WRONG_STATE, wlkSetAerialPerspective(context, view, &aerial));
  REQUIRE(targets.volumeDistance == NULL);
  EXPECT(WLK_ERROR_WRONG_STATE, wlkSetVolumeDistance(context, view, 1));
}

int main(void) {
  WlkContext context = NULL;
  freeFunctions();
  wlkDestroyContext(NULL);
  context = createContext();
  if (context == NULL) {
    return 1;
  }
  REQUIRE(liveBlocks > 0);
  laterHeaders(context);
  atmosphere(context);
  scene(context);
  queries(context);
  objects(context);
  cloudShadows(context);
  viewStates(context);
  deviceFunctions(context);
  wlkDestroyContext(context);
  REQUIRE(liveBlocks == 0);
  return failures == 0 ? 0 : 1;
}
