// SPDX-License-Identifier: MIT
#include "stress/engine_life.hpp"

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t EDGE = 8;  // voxels of each volume

WlkVolumeUpload wholeVolume(const std::vector<float>& values) {
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = EDGE;
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  return upload;
}

// An image whose contents nobody needs.
WlkVulkanImage discarded(const SpyImage& image) {
  WlkVulkanImage described = EngineScene::describe(image, VK_IMAGE_LAYOUT_GENERAL);
  described.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  return described;
}

}  // namespace

Engine::Engine() {
  std::memset(target.bytes(), 0, size_t{16} * WIDTH * HEIGHT);
  target.write(VK_IMAGE_LAYOUT_GENERAL);
  std::memset(field.bytes(), 0, sizeof(float) * EDGE * EDGE * EDGE);
  field.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

std::vector<float> Engine::picture() const {
  target.read(VK_IMAGE_LAYOUT_GENERAL);
  const auto* begin = static_cast<const float*>(target.bytes());
  return {begin, begin + size_t{4} * WIDTH * HEIGHT};
}

WlkResult Life::create() {
  auto device = describeDevice(engine_.spy);
  device.getInstanceProcAddr = get_;
  auto info = make<WlkContextInfo>();
  info.next = &device;
  info.allocator = memory.callbacks();
  return wlkCreateContext(WLK_API_VERSION, &info, &context);
}

WlkResult Life::createMedium() {
  auto info = make<WlkMediumInfo>();
  // Of droplets the smallest, whose tables take least.
  info.particle = kind_.diameters ? WLK_PARTICLE_HAZE : WLK_PARTICLE_HENYEY_GREENSTEIN;
  const WlkResult result = wlkCreateMedium(context, &info, &medium);
  EXPECT_TRUE(result >= 0 || medium.id == 0);
  return result;
}

WlkResult Life::createView() {
  auto info = make<WlkViewInfo>();
  info.width = Engine::WIDTH;
  info.height = Engine::HEIGHT;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  const WlkResult result = wlkCreateView(context, &info, &view);
  EXPECT_TRUE(result >= 0 || view.id == 0);
  return result;
}

WlkResult Life::addVolume(WlkVolume& made) const {
  WlkVolumeField field{};
  field.medium = medium;
  field.extinctionScale = 2e-3f;
  auto info = make<WlkVolumeInfo>();
  info.size[0] = info.size[1] = info.size[2] = EDGE;
  info.fieldCount = 1;
  info.fields = &field;
  const auto transform = boxTransform({-500, 0, -2000}, {1000, 800, 1000});
  std::memcpy(info.worldFromVolume, transform.data(), sizeof info.worldFromVolume);
  const WlkResult result = wlkCreateVolume(context, &info, &made);
  EXPECT_TRUE(result >= 0 || made.id == 0);
  return result;
}

WlkResult Life::upload() const {
  const std::vector<float> values(size_t{EDGE} * EDGE * EDGE, 0.5f);
  const WlkVolumeUpload upload = wholeVolume(values);
  return wlkUploadVolume(context, volume, &upload);
}

WlkResult Life::uploadBricks() const {
  const std::array<uint32_t, 3> origin{};
  const std::vector<float> brick(512, 0.25f);
  auto bricks = make<WlkVolumeBricks>();
  bricks.count = 1;
  bricks.coordinates = origin.data();
  bricks.data = brick.data();
  bricks.dataSize = brick.size() * sizeof(float);
  return wlkUploadVolumeBricks(context, second, &bricks);
}

WlkResult Life::uploadDiameters() const {
  const std::vector<float> values(size_t{EDGE} * EDGE * EDGE, 12.0f);
  const WlkVolumeUpload upload = wholeVolume(values);
  return wlkUploadVolumeDiameters(context, volume, &upload);
}

WlkResult Life::setAerial() const {
  auto info = make<WlkAerialPerspective>();
  info.width = Engine::FROXELS.width;
  info.height = Engine::FROXELS.height;
  info.depth = Engine::FROXELS.depth;
  return wlkSetAerialPerspective(context, view, &info);
}

WlkResult Life::createSurface() {
  const SurfaceArrays arrays(support::boxMesh());
  WlkSurfaceInfo info = arrays.info(medium, 0.01f);
  place(info, {100, 100, 100}, {0, 200, -900});
  const WlkResult result = wlkCreateSurface(context, &info, &surface);
  EXPECT_TRUE(result >= 0 || surface.id == 0);
  return result;
}

WlkResult Life::setDetail() const {
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = 20;
  return wlkSetSurfaceDetail(context, surface, &detail);
}

WlkResult Life::moveSurface() const {
  const SurfaceArrays arrays(support::boxMesh());
  return wlkSetSurfacePositions(context, surface, arrays.positions.data(), 8, 12);
}

WlkResult Life::createMap() {
  auto info = make<WlkCloudShadowInfo>();
  info.width = info.height = Engine::MAP_SIZE;
  info.maxSamples = 8;
  const WlkResult result = wlkCreateCloudShadow(context, &info, &map);
  EXPECT_TRUE(result >= 0 || map.id == 0);
  return result;
}

WlkResult Life::setImage() const {
  const WlkVulkanImage image =
      EngineScene::describe(engine_.field, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  return wlkVulkanSetVolumeImage(context, second, 0, &image);
}

WlkResult Life::resize(uint32_t width) const {
  auto info = make<WlkViewInfo>();
  info.width = width;
  info.height = Engine::HEIGHT;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  return wlkUpdateView(context, view, &info);
}

WlkResult Life::begin() {
  auto info = make<WlkFrameInfo>();
  info.completedFrameIndex = frame_;
  info.frameIndex = frame_ + 1;
  const WlkResult result = wlkBeginFrame(context, &info);
  frame_ += result >= 0 ? 1 : 0;
  return result;
}

// Commands of a failed call are thrown away with their command buffer.
WlkResult Life::recorded(const std::function<WlkResult(VkCommandBuffer)>& record) const {
  WlkResult result = WLK_SUCCESS;
  struct Discard {};
  try {
    engine_.spy.run([&](VkCommandBuffer commands) {
      result = record(commands);
      if (result < 0) {
        throw Discard{};
      }
    });
  } catch (const Discard&) {
  }
  return result;
}

WlkResult Life::recordMap() {
  const WlkVulkanImage image = discarded(engine_.map);
  return recorded([&](VkCommandBuffer commands) {
    return wlkVulkanCmdRenderCloudShadow(context, commands, map, &image);
  });
}

WlkResult Life::record(bool ofView) {
  const WlkVulkanImage color = EngineScene::describe(engine_.target, VK_IMAGE_LAYOUT_GENERAL);
  const std::array more{discarded(engine_.aerial), discarded(engine_.through),
                        discarded(engine_.distance)};
  auto targets = make<WlkVulkanViewTargets>();
  targets.color = &color;
  if (kind_.targets) {
    targets.aerialRadiance = more.data();
    targets.aerialTransmittance = &more[1];
    targets.volumeDistance = &more[2];
  }
  return recorded([&](VkCommandBuffer commands) {
    return ofView ? wlkVulkanCmdRenderView(context, commands, view, &targets)
                  : wlkVulkanCmdUpdate(context, commands);
  });
}

// Planet, air and fog, of which the last two are taken away again: their tables take long.
void Life::addSetters(Steps& steps) {
  if (!kind_.setters) {
    return;
  }
  const auto planet = [this] {
    auto value = make<WlkPlanet>();
    value.groundAlbedo[1] = 0.2f;
    return wlkSetPlanet(context, &value);
  };
  const auto absorber = [this] {
    const auto value = make<WlkAbsorber>();
    return wlkSetAbsorber(context, &value);
  };
  const auto fog = [this] {
    auto value = make<WlkFog>();
    value.phaseModel = WLK_PHASE_ANALYTIC;
    return wlkSetFog(context, &value);
  };
  const auto sky = [this] {
    const auto value = make<WlkSky>();
    return wlkSetSky(context, &value);
  };
  const auto ambient = [this] {
    auto value = make<WlkAmbient>();
    value.mode = WLK_AMBIENT_GIVEN;
    value.sky[2] = 0.1f;
    return wlkSetAmbient(context, &value);
  };
  steps.push_back({"wlkSetPlanet", planet, false});
  steps.push_back({"wlkSetAbsorber", absorber, false});
  steps.push_back({"wlkSetFog", fog, false});
  steps.push_back({"wlkSetFog", [this] { return wlkSetFog(context, nullptr); }, false});
  steps.push_back({"wlkSetSky", sky, false});
  steps.push_back({"wlkSetAmbient", ambient, false});
}

void Life::addScene(Steps& steps) {
  const auto sky = [this] {
    const auto value = make<WlkSky>();
    return wlkSetSky(context, kind_.air ? &value : nullptr);
  };
  const auto lights = [this] {
    auto sun = make<WlkLight>();
    sun.direction[0] = 0.6f;
    sun.direction[1] = 0.8f;
    return wlkSetLights(context, kind_.light ? 1 : 0, sizeof sun, &sun);
  };
  const auto camera = [this] {
    const auto value = make<WlkCamera>();
    return wlkSetCamera(context, view, &value);
  };
  const auto quality = [this] {
    auto value = make<WlkQuality>();
    value.level = WLK_QUALITY_LOW;
    value.scattering = kind_.scattering;
    return wlkSetQuality(context, view, &value);
  };
  steps.push_back({"wlkSetSky", sky, false});
  steps.push_back({"wlkSetLights", lights, false});
  steps.push_back({"wlkCreateMedium", [this] { return createMedium(); }, false});
  steps.push_back({"wlkCreateVolume", [this] { return addVolume(volume); }, true});
  steps.push_back({"wlkUploadVolume", [this] { return upload(); }, true});
  steps.push_back({"wlkCreateVolume", [this] { return addVolume(second); }, true});
  steps.push_back({"wlkUploadVolumeBricks", [this] { return uploadBricks(); }, true});
  steps.push_back({"wlkCreateView", [this] { return createView(); }, true});
  steps.push_back({"wlkSetCamera", camera, false});
  steps.push_back({"wlkSetQuality", quality, false});
}

// What some engines ask for beside the picture.
void Life::addTargets(Steps& steps) {
  if (kind_.targets) {
    steps.push_back({"wlkSetAerialPerspective", [this] { return setAerial(); }, false});
    steps.push_back(
        {"wlkSetVolumeDistance", [this] { return wlkSetVolumeDistance(context, view, 1); }, false});
    steps.push_back({"wlkCreateCloudShadow", [this] { return createMap(); }, true});
  }
  if (kind_.diameters) {
    steps.push_back({"wlkUploadVolumeDiameters", [this] { return uploadDiameters(); }, true});
  }
  if (kind_.surface) {
    steps.push_back({"wlkCreateSurface", [this] { return createSurface(); }, true});
    steps.push_back({"wlkSetSurfaceDetail", [this] { return setDetail(); }, true});
  }
}

void Life::addLaterSetters(Steps& steps) {
  if (!kind_.setters) {
    return;
  }
  const auto turn = [this] {
    const auto transform = boxTransform({-400, 0, -2000}, {1000, 800, 1000});
    return wlkSetVolumeTransform(context, second, transform.data());
  };
  const auto move = [this] {
    const double transform[12] = {90, 0, 0, 0, 0, 90, 0, 200, 0, 0, 90, -900};
    return wlkSetSurfaceTransform(context, surface, transform);
  };
  const auto turnMap = [this] {
    auto info = make<WlkCloudShadowInfo>();
    info.width = info.height = Engine::MAP_SIZE;
    info.maxSamples = 8;
    info.center[2] = -1500;
    return wlkSetCloudShadow(context, map, &info);
  };
  steps.push_back({"wlkSetVolumeTransform", turn, false});
  steps.push_back({"wlkSetSurfaceTransform", move, false});
  steps.push_back({"wlkSetCloudShadow", turnMap, false});
  steps.push_back({"wlkVulkanSetVolumeImage", [this] { return setImage(); }, true});
}

// The context's answers; those of told() stand there.
void Life::addQueries(Steps& steps) {
  if (!kind_.setters) {
    return;
  }
  const auto stats = [this] {
    auto value = make<WlkFrameStats>();
    uint32_t count = 0;
    return wlkGetFrameStats(context, view, &value, &count, sizeof(WlkPassStats), nullptr);
  };
  const auto estimate = [this] {
    auto value = make<WlkErrorEstimate>();
    return wlkGetErrorEstimate(context, view, &value);
  };
  const auto mapState = [this] {
    auto value = make<WlkCloudShadowState>();
    return wlkGetCloudShadowState(context, map, &value);
  };
  const auto sky = [this] {
    const WlkRay ray{{0, 2, 0}, {0.6, 0.8, 0}, 1e5};
    auto batch = make<WlkRayBatch>();
    batch.count = 1;
    batch.rays = &ray;
    double radiance[3] = {};
    return wlkEvalSky(context, &batch, radiance, nullptr);
  };
  const auto skyMap = [this] {
    auto query = make<WlkSkyMapQuery>();
    query.size = 4;
    float rgb[4 * 4 * 3] = {};
    return wlkEvalSkyMap(context, &query, rgb, sizeof rgb);
  };
  const auto ambient = [this] {
    const double origin[3] = {0, 2, 0};
    double harmonics[WLK_AMBIENT_VALUES] = {};
    return wlkEvalAmbient(context, origin, harmonics);
  };
  const auto irradiance = [this] {
    const double origin[3] = {0, 2, 0};
    const double up[3] = {0, 1, 0};
    double direct[3] = {};
    double diffuse[3] = {};
    return wlkEvalIrradiance(context, origin, up, direct, diffuse);
  };
  const auto phase = [this] {
    const double angle = 0.5;
    auto query = make<WlkPhaseQuery>();
    query.medium = medium;
    query.count = 1;
    query.scatteringAngle = &angle;
    query.orderKind = WLK_ORDER_POISSON;
    double value[3] = {};
    return wlkEvalPhase(context, &query, value);
  };
  const auto sample = [this] {
    const double random = 0.5;
    double angle = 0;
    return wlkSamplePhase(context, medium, 0, 1, &random, &angle, nullptr);
  };
  steps.push_back({"wlkGetFrameStats", stats, false});
  steps.push_back({"wlkGetErrorEstimate", estimate, false});
  steps.push_back({"wlkGetCloudShadowState", mapState, false});
  steps.push_back({"wlkEvalSky", sky, false});
  steps.push_back({"wlkEvalSkyMap", skyMap, false});
  steps.push_back({"wlkEvalAmbient", ambient, false});
  steps.push_back({"wlkEvalIrradiance", irradiance, false});
  steps.push_back({"wlkEvalPhase", phase, false});
  steps.push_back({"wlkSamplePhase", sample, false});
}

void Life::addFrame(Steps& steps) {
  steps.push_back({"wlkBeginFrame", [this] { return begin(); }, true});
  steps.push_back({"wlkVulkanCmdUpdate", [this] { return record(false); }, true});
  if (kind_.targets) {
    steps.push_back({"wlkVulkanCmdRenderCloudShadow", [this] { return recordMap(); }, true});
  }
  steps.push_back({"wlkVulkanCmdRenderView", [this] { return record(true); }, true});
}

void Life::addEnd(Steps& steps) {
  if (kind_.setters) {
    steps.push_back({"wlkVulkanForgetImage",
                     [this] { return wlkVulkanForgetImage(context, engine_.field.handle); },
                     false});
  }
  steps.push_back(
      {"wlkDestroyVolume", [this] { return wlkDestroyVolume(context, second); }, false});
  steps.push_back({"wlkPrepare", [this] { return wlkPrepare(context); }, true});
  addFrame(steps);
  if (kind_.diameters) {
    steps.push_back({"wlkClearVolumeDiameters",
                     [this] { return wlkClearVolumeDiameters(context, volume); }, false});
  }
  if (kind_.surface) {
    steps.push_back(
        {"wlkDestroySurface", [this] { return wlkDestroySurface(context, surface); }, false});
  }
  if (kind_.targets) {
    steps.push_back(
        {"wlkDestroyCloudShadow", [this] { return wlkDestroyCloudShadow(context, map); }, false});
  }
  steps.push_back({"wlkDestroyView", [this] { return wlkDestroyView(context, view); }, false});
  steps.push_back(
      {"wlkDestroyVolume", [this] { return wlkDestroyVolume(context, volume); }, false});
  steps.push_back(
      {"wlkDestroyMedium", [this] { return wlkDestroyMedium(context, medium); }, false});
}

std::vector<Step> Life::steps() {
  const auto prepare = [this] { return wlkPrepare(context); };
  Steps steps{{"wlkCreateContext", [this] { return create(); }, false}};
  addSetters(steps);
  addScene(steps);
  addTargets(steps);
  addLaterSetters(steps);
  steps.push_back({"wlkPrepare", prepare, true});
  addFrame(steps);
  addQueries(steps);
  if (kind_.surface) {
    steps.push_back({"wlkSetSurfacePositions", [this] { return moveSurface(); }, true});
  }
  steps.push_back({"wlkUpdateView", [this] { return resize(Engine::WIDTH / 2); }, true});
  steps.push_back({"wlkPrepare", prepare, true});
  steps.push_back({"wlkUpdateView", [this] { return resize(Engine::WIDTH); }, true});
  steps.push_back({"wlkPrepare", prepare, true});
  steps.push_back({"wlkUploadVolume", [this] { return upload(); }, true});
  addFrame(steps);
  addFrame(steps);
  addEnd(steps);
  return steps;
}

std::vector<double> Life::told() const {
  std::vector<double> all;
  const auto say = [&all](WlkResult result, std::initializer_list<double> values) {
    all.push_back(result);
    all.insert(all.end(), values);
  };
  // The call first: what it fills is read after it.
  const double from[3] = {0, 2, 0};
  const double to[3] = {1000, 3000, 0};
  double rgb[3] = {};
  WlkResult result = wlkEvalTransmittance(context, from, to, rgb);
  say(result, {rgb[0], rgb[1], rgb[2]});
  double light[3] = {};
  result = wlkEvalLight(context, 0, from, light);
  say(result, {light[0], light[1], light[2]});
  auto optics = make<WlkMediumOptics>();
  result = wlkGetMediumOptics(context, medium, &optics);
  say(result, {double{optics.asymmetry[0]}});
  for (const WlkVolume one : {volume, second}) {
    auto state = make<WlkVolumeState>();
    result = wlkGetVolumeState(context, one, &state);
    say(result, {double(state.occupiedBricks), double(state.storedBricks),
                 double(state.deviceMemory), double(state.pendingMemory)});
  }
  auto quality = make<WlkQualityState>();
  result = wlkGetQualityState(context, view, &quality);
  say(result, {double(quality.control), double(quality.rung), double(quality.sliceCount)});
  return all;
}

}  // namespace welkin::test
