// SPDX-License-Identifier: MIT
#include "stress/device_lost_table.hpp"

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr WlkResult OK = WLK_SUCCESS;
constexpr WlkResult LOST = WLK_ERROR_DEVICE_LOST;
constexpr WlkResult MODE = WLK_ERROR_WRONG_STATE;     // not of headless contexts
constexpr WlkResult NONE = WLK_ERROR_INVALID_HANDLE;  // which have no such object
constexpr bool DESTROYS = true;

using Objects = const LostObjects&;
constexpr uint32_t EDGE = 8;
constexpr double POINT[3] = {0, 2, 0};
constexpr double UP[3] = {0, 1, 0};
constexpr std::array<double, 12> BOX{1000, 0, 0, 0, 0, 800, 0, 0, 0, 0, 1000, 0};
const std::vector<float> VALUES(size_t{EDGE} * EDGE * EDGE, 12.0f);

WlkResult said(const char* name) {
  return name != nullptr && name[0] != '\0' ? OK : WLK_ERROR_INTERNAL;
}

// Functions that take a structure with its defaults, or fill one.
template <typename T>
WlkResult set(WlkResult (*function)(WlkContext, const T*), Objects o) {
  const auto value = make<T>();
  return function(*o.context, &value);
}
template <typename Handle, typename T>
WlkResult set(WlkResult (*function)(WlkContext, Handle, const T*), Objects o, Handle handle) {
  const auto value = make<T>();
  return function(*o.context, handle, &value);
}
template <typename T>
WlkResult get(WlkResult (*function)(T*)) {
  auto value = make<T>();
  return function(&value);
}
template <typename Handle, typename T>
WlkResult get(WlkResult (*function)(WlkContext, Handle, T*), Objects o, Handle handle) {
  auto value = make<T>();
  return function(*o.context, handle, &value);
}

template <WlkResult (*FUNCTION)(WlkContext, WlkVolume, const WlkVolumeUpload*)>
WlkResult upload(Objects o) {
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = EDGE;
  upload.data = VALUES.data();
  upload.dataSize = VALUES.size() * sizeof(float);
  return FUNCTION(*o.context, o.volume, &upload);
}

WlkResult uploadBricks(Objects o) {
  const std::array<uint32_t, 3> origin{};
  auto bricks = make<WlkVolumeBricks>();
  bricks.count = 1;
  bricks.coordinates = origin.data();
  bricks.data = VALUES.data();
  bricks.dataSize = VALUES.size() * sizeof(float);
  return wlkUploadVolumeBricks(*o.context, o.volume, &bricks);
}

// Contexts without a device know nothing of the loss.
WlkResult createContext(Objects) {
  const auto info = make<WlkContextInfo>();
  WlkContext context = nullptr;
  const WlkResult result = wlkCreateContext(WLK_API_VERSION, &info, &context);
  wlkDestroyContext(context);
  return result;
}

WlkResult destroyVolumes(Objects o) {
  const WlkResult result = wlkDestroyVolume(*o.context, o.volume);
  return result < 0 || o.second.id == 0 ? result : wlkDestroyVolume(*o.context, o.second);
}

WlkResult destroyContext(Objects o) {
  wlkDestroyContext(*o.context);
  *o.context = nullptr;
  return OK;
}

WlkResult createMedium(Objects o) {
  auto info = make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  WlkMedium medium{};
  return wlkCreateMedium(*o.context, &info, &medium);
}

WlkResult createVolume(Objects o) {
  WlkVolumeField field{o.medium, 1e-3f, 0};
  auto info = make<WlkVolumeInfo>();
  info.fieldCount = 1;
  info.fields = &field;
  WlkVolume volume{};
  return wlkCreateVolume(*o.context, &info, &volume);
}

WlkResult createView(Objects o) {
  const auto info = make<WlkViewInfo>();
  WlkView view{};
  return wlkCreateView(*o.context, &info, &view);
}

WlkResult createSurface(Objects o) {
  const SurfaceArrays arrays(support::boxMesh());
  const WlkSurfaceInfo info = arrays.info(o.medium, 0.01f);
  WlkSurface surface{};
  return wlkCreateSurface(*o.context, &info, &surface);
}

WlkResult setDetail(Objects o) {
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = 10;
  return wlkSetSurfaceDetail(*o.context, o.surface, &detail);
}

WlkResult setPositions(Objects o) {
  const SurfaceArrays arrays(support::boxMesh());
  return wlkSetSurfacePositions(*o.context, o.surface, arrays.positions.data(), 8, 12);
}

WlkResult setLights(Objects o) {
  const auto light = make<WlkLight>();
  return wlkSetLights(*o.context, 1, sizeof light, &light);
}

// Then times may be reported.
WlkResult setQuality(Objects o) {
  auto quality = make<WlkQuality>();
  quality.control = WLK_CONTROL_REPORTED_TIME;
  quality.timeBudget_ms = 2;
  return wlkSetQuality(*o.context, o.view, &quality);
}

WlkResult beginFrame(Objects o) {
  auto frame = make<WlkFrameInfo>();
  frame.frameIndex = 100;
  frame.completedFrameIndex = 99;
  return wlkBeginFrame(*o.context, &frame);
}

WlkResult readback(Objects o) {
  std::vector<float> pixels(size_t{4} * HeadlessLife::WIDTH * HeadlessLife::HEIGHT);
  auto data = make<WlkImageData>();
  data.data = pixels.data();
  data.dataSize = pixels.size() * sizeof(float);
  return wlkReadback(*o.context, o.view, &data);
}

WlkResult frameStats(Objects o) {
  auto stats = make<WlkFrameStats>();
  uint32_t count = 0;
  return wlkGetFrameStats(*o.context, o.view, &stats, &count, sizeof(WlkPassStats), nullptr);
}

WlkResult evalSky(Objects o) {
  const WlkRay ray{{0, 2, 0}, {0, 1, 0}, 1e5};
  auto batch = make<WlkRayBatch>();
  batch.count = 1;
  batch.rays = &ray;
  batch.maxOrder = 1;
  double radiance[3] = {};
  return wlkEvalSky(*o.context, &batch, radiance, nullptr);
}

WlkResult evalSkyMap(Objects o) {
  auto query = make<WlkSkyMapQuery>();
  query.size = 4;
  query.maxOrder = 1;
  float rgb[4 * 4 * 3] = {};
  return wlkEvalSkyMap(*o.context, &query, rgb, sizeof rgb);
}

WlkResult evalPhase(Objects o) {
  const double angle = 0.5;
  auto query = make<WlkPhaseQuery>();
  query.medium = o.medium;
  query.count = 1;
  query.scatteringAngle = &angle;
  double phase[3] = {};
  return wlkEvalPhase(*o.context, &query, phase);
}

WlkResult samplePhase(Objects o) {
  const double random = 0.5;
  double angle = 0;
  return wlkSamplePhase(*o.context, o.medium, 0, 1, &random, &angle, nullptr);
}

WlkResult waterExtinction(Objects o) {
  const float content = 1e-3f;
  float extinction = 0;
  return wlkEvalWaterExtinction(*o.context, o.medium, 1, &content, nullptr, &extinction);
}

WlkResult capabilities(Objects o) {
  auto value = make<WlkCapabilities>();
  return wlkGetCapabilities(*o.context, &value);
}

WlkResult initMoon(Objects) {
  const float toSun[3] = {0, 1, 0};
  const float toMoon[3] = {0, 0, 1};
  const float irradiance[3] = {1, 1, 1};
  auto moon = make<WlkLight>();
  return wlkInitMoon(toSun, toMoon, irradiance, &moon);
}

WlkResult initPreset(Objects) {
  auto sky = make<WlkSky>();
  return wlkInitPresetStruct(WLK_ATMOSPHERE_MARS, WLK_STRUCT_SKY, sizeof sky, &sky);
}

WlkResult renderView(Objects o) {
  auto targets = make<WlkVulkanViewTargets>();
  targets.color = &o.image;
  return wlkVulkanCmdRenderView(*o.context, o.commands, o.view, &targets);
}

WlkResult createMap(Objects o) {
  const auto info = make<WlkCloudShadowInfo>();
  WlkCloudShadow map{};
  return wlkCreateCloudShadow(*o.context, &info, &map);
}

double values[WLK_AMBIENT_VALUES];

// What belongs to no context.
std::vector<LostRow> freeRows() {
  return {
      {"wlkApproximationName", OK, OK, [](Objects) { return said(wlkApproximationName(0)); }},
      {"wlkControlReasonName", OK, OK, [](Objects) { return said(wlkControlReasonName(0)); }},
      {"wlkReasonName", OK, OK, [](Objects) { return said(wlkReasonName(0)); }},
      {"wlkResultName", OK, OK, [](Objects) { return said(wlkResultName(0)); }},
      {"wlkGetVersion", OK, OK, [](Objects) { return wlkGetVersion() > 0 ? OK : LOST; }},
      {"wlkGetColorMatrix", OK, OK,
       [](Objects) {
         double matrix[9];
         return wlkGetColorMatrix(WLK_COLOR_LINEAR_SRGB, matrix);
       }},
      {"wlkGetLastError", OK, OK, [](Objects) { return get(wlkGetLastError); }},
      {"wlkInitMoon", OK, OK, initMoon},
      {"wlkInitPresetStruct", OK, OK, initPreset},
      {"wlkInitStruct", OK, OK,
       [](Objects) {
         WlkSky sky;
         return wlkInitStruct(WLK_STRUCT_SKY, sizeof sky, &sky);
       }},
      {"wlkVulkanGetRequirements", OK, OK, [](Objects) { return get(wlkVulkanGetRequirements); }},
      {"wlkCreateContext", OK, OK, createContext},
  };
}

// What is kept by the context and needs no device.
std::vector<LostRow> sceneRows() {
  return {
      {"wlkSetPlanet", OK, OK, [](Objects o) { return set(wlkSetPlanet, o); }},
      {"wlkSetSky", OK, OK, [](Objects o) { return wlkSetSky(*o.context, nullptr); }},
      {"wlkSetAbsorber", OK, OK, [](Objects o) { return set(wlkSetAbsorber, o); }},
      {"wlkSetFog", OK, OK, [](Objects o) { return wlkSetFog(*o.context, nullptr); }},
      {"wlkSetLights", OK, OK, setLights},
      {"wlkSetAmbient", OK, OK, [](Objects o) { return set(wlkSetAmbient, o); }},
      {"wlkCreateMedium", OK, OK, createMedium},
      {"wlkSetVolumeTransform", OK, OK,
       [](Objects o) { return wlkSetVolumeTransform(*o.context, o.volume, BOX.data()); }},
      {"wlkSetSurfaceTransform", OK, NONE,
       [](Objects o) { return wlkSetSurfaceTransform(*o.context, o.surface, BOX.data()); }},
      {"wlkSetCamera", OK, OK, [](Objects o) { return set(wlkSetCamera, o, o.view); }},
      {"wlkSetQuality", OK, OK, setQuality},
      {"wlkReportFrameTime", OK, OK,
       [](Objects o) { return wlkReportFrameTime(*o.context, o.view, 1, 1.5); }},
      {"wlkSetAerialPerspective", OK, MODE,
       [](Objects o) { return set(wlkSetAerialPerspective, o, o.view); }},
      {"wlkSetVolumeDistance", OK, MODE,
       [](Objects o) { return wlkSetVolumeDistance(*o.context, o.view, 0); }},
      {"wlkSetCloudShadow", OK, NONE, [](Objects o) { return set(wlkSetCloudShadow, o, o.map); }},
  };
}

std::vector<LostRow> queryRows() {
  return {
      {"wlkGetCapabilities", OK, OK, capabilities},
      {"wlkGetMediumOptics", OK, OK,
       [](Objects o) { return get(wlkGetMediumOptics, o, o.medium); }},
      {"wlkGetVolumeState", OK, OK, [](Objects o) { return get(wlkGetVolumeState, o, o.volume); }},
      {"wlkGetQualityState", OK, OK, [](Objects o) { return get(wlkGetQualityState, o, o.view); }},
      {"wlkGetErrorEstimate", OK, OK,
       [](Objects o) { return get(wlkGetErrorEstimate, o, o.view); }},
      {"wlkGetFrameStats", OK, OK, frameStats},
      {"wlkGetCloudShadowState", OK, NONE,
       [](Objects o) { return get(wlkGetCloudShadowState, o, o.map); }},
      {"wlkEvalSky", OK, OK, evalSky},
      {"wlkEvalSkyMap", OK, OK, evalSkyMap},
      {"wlkEvalPhase", OK, OK, evalPhase},
      {"wlkSamplePhase", OK, OK, samplePhase},
      {"wlkEvalWaterExtinction", OK, OK, waterExtinction},
      {"wlkEvalAmbient", OK, OK,
       [](Objects o) { return wlkEvalAmbient(*o.context, POINT, values); }},
      {"wlkEvalIrradiance", OK, OK,
       [](Objects o) { return wlkEvalIrradiance(*o.context, POINT, UP, values, nullptr); }},
      {"wlkEvalLight", OK, OK,
       [](Objects o) { return wlkEvalLight(*o.context, 0, POINT, values); }},
      {"wlkEvalTransmittance", OK, OK,
       [](Objects o) { return wlkEvalTransmittance(*o.context, POINT, UP, values); }},
  };
}

// What needs the device.
std::vector<LostRow> deviceRows() {
  return {
      {"wlkCreateVolume", LOST, LOST, createVolume},
      {"wlkUploadVolume", LOST, LOST, upload<wlkUploadVolume>},
      {"wlkUploadVolumeDiameters", LOST, LOST, upload<wlkUploadVolumeDiameters>},
      {"wlkUploadVolumeBricks", LOST, LOST, uploadBricks},
      {"wlkCreateSurface", LOST, LOST, createSurface},
      {"wlkSetSurfaceDetail", LOST, NONE, setDetail},
      {"wlkSetSurfacePositions", LOST, NONE, setPositions},
      {"wlkCreateView", LOST, LOST, createView},
      {"wlkUpdateView", LOST, LOST, [](Objects o) { return set(wlkUpdateView, o, o.view); }},
      {"wlkPrepare", LOST, LOST, [](Objects o) { return wlkPrepare(*o.context); }},
      {"wlkBeginFrame", LOST, LOST, beginFrame},
      {"wlkRenderHeadless", LOST, LOST,
       [](Objects o) { return wlkRenderHeadless(*o.context, o.view, nullptr); }},
      {"wlkReadback", LOST, LOST, readback},
      {"wlkVulkanCmdUpdate", LOST, LOST,
       [](Objects o) { return wlkVulkanCmdUpdate(*o.context, o.commands); }},
      {"wlkVulkanCmdRenderView", LOST, LOST, renderView},
      {"wlkVulkanCmdRenderCloudShadow", LOST, LOST,
       [](Objects o) {
         return wlkVulkanCmdRenderCloudShadow(*o.context, o.commands, o.map, &o.image);
       }},
      {"wlkCreateCloudShadow", LOST, MODE, createMap},
      {"wlkVulkanSetVolumeImage", LOST, MODE,
       [](Objects o) { return wlkVulkanSetVolumeImage(*o.context, o.volume, 0, &o.image); }},
  };
}

std::vector<LostRow> destroyingRows() {
  return {
      {"wlkVulkanForgetImage", OK, OK,
       [](Objects o) { return wlkVulkanForgetImage(*o.context, o.image.image); }, DESTROYS},
      {"wlkClearVolumeDiameters", OK, OK,
       [](Objects o) { return wlkClearVolumeDiameters(*o.context, o.volume); }, DESTROYS},
      {"wlkDestroyCloudShadow", OK, NONE,
       [](Objects o) { return wlkDestroyCloudShadow(*o.context, o.map); }, DESTROYS},
      {"wlkDestroySurface", OK, NONE,
       [](Objects o) { return wlkDestroySurface(*o.context, o.surface); }, DESTROYS},
      {"wlkDestroyView", OK, OK, [](Objects o) { return wlkDestroyView(*o.context, o.view); },
       DESTROYS},
      {"wlkDestroyVolume", OK, OK, destroyVolumes, DESTROYS},
      {"wlkDestroyMedium", OK, OK, [](Objects o) { return wlkDestroyMedium(*o.context, o.medium); },
       DESTROYS},
      {"wlkDestroyContext", OK, OK, destroyContext, DESTROYS},
  };
}

}  // namespace

std::vector<LostRow> lostTable() {
  std::vector<LostRow> all;
  for (const auto& rows : {freeRows(), sceneRows(), queryRows(), deviceRows(), destroyingRows()}) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

}  // namespace welkin::test
