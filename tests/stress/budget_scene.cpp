// SPDX-License-Identifier: MIT
#include "stress/budget_scene.hpp"

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t WIDTH = 1280;
constexpr uint32_t HEIGHT = 720;
constexpr std::array<uint32_t, 3> BALLAST{512, 512, 256};  // voxels, of 4 bytes

// Of 2.3 MB, which the view's buffers leave no room for in their block.
const SurfaceArrays& mesh() {
  static const SurfaceArrays arrays(support::torusMesh(360, 180));
  return arrays;
}

}  // namespace

const SpyImage& BudgetEngine::target(uint32_t width, uint32_t height) {
  for (const auto& one : targets) {
    if (one->extent.width == width && one->extent.height == height) {
      return *one;
    }
  }
  return *targets.emplace_back(
      std::make_unique<SpyImage>(spy, VK_FORMAT_R32G32B32A32_SFLOAT, VkExtent3D{width, height, 1},
                                 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
}

const char* BudgetScene::nameOf(Needing needing) {
  constexpr std::array NAMES{"volume", "surface", "view", "size", "map"};
  return NAMES[static_cast<size_t>(needing)];
}

WlkResult BudgetScene::create(uint64_t limit) {
  auto device = describeDevice(engine_.spy);
  device.getInstanceProcAddr = FaultLayer::getInstanceProcAddr();
  auto info = make<WlkContextInfo>();
  info.next = &device;
  info.deviceMemoryLimit = limit;
  const WlkResult result = wlkCreateContext(WLK_API_VERSION, &info, &context);
  if (result < 0) {
    return result;
  }
  auto sun = make<WlkLight>();
  sun.direction[0] = 0.6f;
  sun.direction[1] = 0.8f;
  check(wlkSetLights(context, 1, sizeof sun, &sun));
  auto medium = make<WlkMediumInfo>();
  medium.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;  // droplets' tables take 0.3 s
  check(wlkCreateMedium(context, &medium, &medium_));
  return result;
}

void BudgetScene::addSky() const {
  const auto sky = make<WlkSky>();
  check(wlkSetSky(context, &sky));
}

void BudgetScene::rise() const {
  auto camera = make<WlkCamera>();
  camera.position[1] = 50e3;
  check(wlkSetCamera(context, view_, &camera));
}

std::vector<BudgetScene::Step> BudgetScene::steps(bool ballast, bool surface) {
  std::vector<Step> all;
  if (ballast) {
    all.push_back({"wlkUploadVolume (ballast)",
                   [this] {
                     if (ballast_.id == 0) {
                       check(create(BALLAST, ballast_));
                     }
                     return upload(ballast_, {1, 1, 1});
                   },
                   true});
  }
  const auto whole = [this] {
    const std::array<uint32_t, 3> size{128, 128, 128};
    if (volume_.id == 0) {
      check(create(size, volume_));
    }
    return upload(volume_, size);
  };
  all.push_back({"wlkUploadVolume", whole});
  if (surface) {
    all.push_back({"wlkCreateSurface", [this] { return addSurface(surface_); }});
  }
  all.push_back({"wlkCreateView", [this] {
                   width_ = WIDTH;
                   height_ = HEIGHT;
                   return addView(WIDTH, HEIGHT, view_);
                 }});
  all.push_back({"wlkCreateCloudShadow", [this] { return addMap(BudgetEngine::MAP_SIZE, map_); }});
  all.push_back({"wlkPrepare", [this] { return prepare(); }});
  all.push_back({"a frame", [this] { return frame(); }});
  all.push_back({"a frame", [this] { return frame(); }});
  return all;
}

WlkResult BudgetScene::create(const std::array<uint32_t, 3>& size, WlkVolume& volume) const {
  WlkVolumeField field{};
  field.medium = medium_;
  field.extinctionScale = 1e-3f;
  auto info = make<WlkVolumeInfo>();
  std::copy(size.begin(), size.end(), info.size);
  info.fieldCount = 1;
  info.fields = &field;
  const auto transform = boxTransform({-500, 0, -2000}, {1000, 800, 1000});
  std::memcpy(info.worldFromVolume, transform.data(), sizeof info.worldFromVolume);
  return wlkCreateVolume(context, &info, &volume);
}

WlkResult BudgetScene::upload(WlkVolume volume, const std::array<uint32_t, 3>& extent) const {
  const std::vector<float> values(size_t{extent[0]} * extent[1] * extent[2], 0.5f);
  auto info = make<WlkVolumeUpload>();
  std::copy(extent.begin(), extent.end(), info.extent);
  info.data = values.data();
  info.dataSize = values.size() * sizeof(float);
  return wlkUploadVolume(context, volume, &info);
}

WlkResult BudgetScene::addVolume(uint32_t edge) {
  check(create({edge, edge, edge}, last_));
  const WlkResult result = upload(last_, {1, 1, 1});
  if (result < 0) {
    EXPECT_EQ(destroyVolume(), WLK_SUCCESS) << "the volume is unusable";
  }
  return result;
}

WlkResult BudgetScene::destroyVolume() {
  return wlkDestroyVolume(context, last_);
}

WlkResult BudgetScene::addSurface(WlkSurface& surface) const {
  WlkSurfaceInfo info = mesh().info(medium_, 0.01f);
  place(info, {100, 100, 100}, {0, 200, -900});
  return wlkCreateSurface(context, &info, &surface);
}

WlkResult BudgetScene::addView(uint32_t width, uint32_t height, WlkView& view) const {
  auto info = make<WlkViewInfo>();
  info.width = width;
  info.height = height;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  const WlkResult result = wlkCreateView(context, &info, &view);
  if (result < 0) {
    return result;
  }
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = WLK_SCATTERING_FORWARD;
  return wlkSetQuality(context, view, &quality);
}

WlkResult BudgetScene::addMap(uint32_t size, WlkCloudShadow& map) const {
  auto info = make<WlkCloudShadowInfo>();
  info.width = info.height = size;
  return wlkCreateCloudShadow(context, &info, &map);
}

WlkResult BudgetScene::resize(uint32_t width, uint32_t height) {
  auto info = make<WlkViewInfo>();
  info.width = width_ = width;
  info.height = height_ = height;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  return wlkUpdateView(context, view_, &info);
}

WlkResult BudgetScene::record(VkCommandBuffer commands) {
  const WlkResult updated = wlkVulkanCmdUpdate(context, commands);
  if (updated < 0) {
    return updated;
  }
  if (map_.id != 0) {
    WlkVulkanImage image = EngineScene::describe(engine_.map, VK_IMAGE_LAYOUT_GENERAL);
    image.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    const WlkResult shadowed = wlkVulkanCmdRenderCloudShadow(context, commands, map_, &image);
    if (shadowed < 0) {
      return shadowed;
    }
  }
  const WlkVulkanImage color =
      EngineScene::describe(engine_.target(width_, height_), VK_IMAGE_LAYOUT_GENERAL);
  auto targets = make<WlkVulkanViewTargets>();
  targets.color = &color;
  return wlkVulkanCmdRenderView(context, commands, view_, &targets);
}

WlkResult BudgetScene::frame() {
  auto info = make<WlkFrameInfo>();
  info.completedFrameIndex = frame_;
  info.frameIndex = ++frame_;
  WlkResult result = wlkBeginFrame(context, &info);
  if (result >= 0) {
    engine_.spy.record([&](VkCommandBuffer commands) { result = record(commands); });
  }
  return result;
}

WlkFrameStats BudgetScene::stats() const {
  auto stats = make<WlkFrameStats>();
  uint32_t count = 0;
  check(wlkGetFrameStats(context, view_, &stats, &count, sizeof(WlkPassStats), nullptr));
  return stats;
}

WlkResult BudgetScene::stageBlock() const {
  return upload(ballast_, {256, 256, 64});
}

WlkResult BudgetScene::dropBallast() {
  if (ballast_.id == 0) {
    return WLK_SUCCESS;
  }
  const WlkResult result = wlkDestroyVolume(context, ballast_);
  ballast_ = {};
  return result < 0 ? result : completeAll();
}

WlkResult BudgetScene::completeAll() {
  auto info = make<WlkFrameInfo>();
  info.completedFrameIndex = frame_;
  info.frameIndex = ++frame_;
  return wlkBeginFrame(context, &info);
}

WlkResult BudgetScene::shrink() {
  if (map_.id != 0) {
    check(wlkDestroyCloudShadow(context, map_));
    map_ = {};
  }
  if (surface_.id != 0) {
    check(wlkDestroySurface(context, surface_));
    surface_ = {};
  }
  check(resize(16, 12));
  return completeAll();
}

WlkResult BudgetScene::add(Needing needing) {
  switch (needing) {
    case Needing::VOLUME:
      return addVolume(192);
    case Needing::SURFACE:
      return addSurface(surface_);
    case Needing::VIEW:
      check(secondView_.id != 0 ? WLK_SUCCESS : addView(WIDTH, HEIGHT, secondView_));
      break;
    case Needing::SIZE:
      check(resize(2 * WIDTH, 2 * HEIGHT));
      break;
    case Needing::MAP:
      check(secondMap_.id != 0 ? WLK_SUCCESS : addMap(4096, secondMap_));
      break;
  }
  return prepare();
}

void BudgetScene::goBack(Needing needing) {
  if (needing == Needing::VIEW) {
    check(wlkDestroyView(context, secondView_));
    secondView_ = {};
  }
  if (needing == Needing::SIZE) {
    check(resize(WIDTH, HEIGHT));
  }
  if (needing == Needing::MAP) {
    check(wlkDestroyCloudShadow(context, secondMap_));
    secondMap_ = {};
  }
}

}  // namespace welkin::test
