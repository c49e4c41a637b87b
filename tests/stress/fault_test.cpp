// SPDX-License-Identifier: MIT
// Every call of Vulkan that can fail fails once, at every place of an engine's life: creation,
// uploads, preparation, frames, a resize, destruction. The failing function says so, changes
// nothing and leaks nothing; after a lack of memory the same call succeeds, and the picture is the
// one without faults; after a lost device nothing is asked of Vulkan any more but to destroy.
#include <map>
#include <optional>
#include <set>

#include "stress/abuse.hpp"
#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"
#include "support/fault_layer.hpp"
#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t WIDTH = 16;
constexpr uint32_t HEIGHT = 12;

constexpr uint32_t MAP_SIZE = 16;
constexpr VkExtent3D FROXELS{8, 6, 4};

// The engine's device and targets, shared by all runs: nothing of a context may stay in them.
struct Engine {
  SpyDevice spy;
  SpyImage aerial{spy, VK_FORMAT_R32G32B32A32_SFLOAT, FROXELS, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage through{spy, VK_FORMAT_R32G32B32A32_SFLOAT, FROXELS, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage distance{spy, VK_FORMAT_R32G32_SFLOAT, {WIDTH, HEIGHT, 1}, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage map{spy, VK_FORMAT_R32_SFLOAT, {MAP_SIZE, MAP_SIZE, 1}, VK_IMAGE_USAGE_STORAGE_BIT};
  SpyImage target{spy,
                  VK_FORMAT_R32G32B32A32_SFLOAT,
                  {WIDTH, HEIGHT, 1},
                  VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT};
  Engine() {
    std::memset(target.bytes(), 0, size_t{16} * WIDTH * HEIGHT);
    target.write(VK_IMAGE_LAYOUT_GENERAL);
  }
};

struct Step {
  const char* entry;
  std::function<WlkResult()> call;
  bool needsDevice;
};

// The first light in air, and the phase functions for all orders, cost 0.3 s of the host each: of
// lives by the hundred, each has one thing.
struct Kind {
  bool air;
  bool light;
  uint32_t scattering;
  bool targets = false;    // froxels, distance, a shadow map
  bool diameters = false;  // of droplets, whose tables take longest
  bool surface = false;    // a cloud of a mesh, moved between frames
  // Of so many calls one fails.
  uint64_t stride = 1;
};
constexpr Kind WHOLE{true, true, WLK_SCATTERING_ALL_ORDERS, false, false, false, 23};
constexpr Kind CLOUD{false, true, WLK_SCATTERING_FORWARD};
constexpr Kind AIR{true, false, WLK_SCATTERING_FORWARD};
constexpr Kind TARGETS{false, true, WLK_SCATTERING_FORWARD, true, false, false, 2};
constexpr Kind DROPLETS{false, true, WLK_SCATTERING_FORWARD, true, true, false, 61};
constexpr Kind SURFACE{false, true, WLK_SCATTERING_FORWARD, false, false, true, 3};

// What an engine does with one context.
class Life {
 public:
  Life(Engine& engine, const Kind& kind) : engine_(engine), kind_(kind) {}
  ~Life() { wlkDestroyContext(context); }
  Life(const Life&) = delete;
  Life& operator=(const Life&) = delete;

  std::vector<Step> steps();
  CountingAllocator memory;
  WlkContext context = nullptr;

 private:
  WlkResult create();
  WlkResult addVolume(WlkVolume& volume) const;
  WlkResult upload() const;
  WlkResult uploadBricks() const;
  WlkResult uploadDiameters() const;
  void addTargetSteps(std::vector<Step>& steps);
  WlkResult createSurface();
  WlkResult setDetail() const;
  WlkResult moveSurface() const;
  WlkResult createMap();
  WlkResult recordMap();
  WlkResult recorded(const std::function<WlkResult(VkCommandBuffer)>& record) const;
  WlkResult resize(uint32_t width) const;
  WlkResult record(bool view);
  WlkResult begin();

  Engine& engine_;
  Kind kind_;
  WlkMedium medium_{};
  WlkVolume volume_{};
  WlkVolume second_{};
  WlkView view_{};
  WlkShadowMap map_{};
  WlkSurface surface_{};
  uint64_t frame_ = 0;
};

WlkResult Life::create() {
  auto device = describeDevice(engine_.spy);
  device.getInstanceProcAddr = FaultLayer::getInstanceProcAddr();
  auto info = make<WlkContextInfo>();
  info.next = &device;
  info.allocator = memory.callbacks();
  return wlkCreateContext(&info, &context);
}

WlkResult Life::addVolume(WlkVolume& volume) const {
  WlkVolumeField field{};
  field.medium = medium_;
  field.extinctionScale = 2e-3f;
  auto info = make<WlkVolumeInfo>();
  info.size[0] = info.size[1] = info.size[2] = 8;
  info.fieldCount = 1;
  info.fields = &field;
  const auto transform = boxTransform({-500, 0, -2000}, {1000, 800, 1000});
  std::memcpy(info.worldFromVolume, transform.data(), sizeof info.worldFromVolume);
  return wlkCreateVolume(context, &info, &volume);
}

WlkResult Life::upload() const {
  const std::vector<float> values(512, 0.5f);
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = 8;
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  return wlkUploadVolume(context, volume_, &upload);
}

WlkResult Life::uploadBricks() const {
  const std::array<uint32_t, 3> origin{};
  const std::vector<float> brick(512, 0.25f);
  auto bricks = make<WlkVolumeBricks>();
  bricks.count = 1;
  bricks.coordinates = origin.data();
  bricks.data = brick.data();
  bricks.dataSize = brick.size() * sizeof(float);
  return wlkUploadVolumeBricks(context, second_, &bricks);
}

WlkResult Life::resize(uint32_t width) const {
  auto info = make<WlkViewInfo>();
  info.width = width;
  info.height = HEIGHT;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  return wlkUpdateView(context, view_, &info);
}

WlkResult Life::begin() {
  auto info = make<WlkFrameInfo>();
  info.completedFrameIndex = frame_;
  info.frameIndex = frame_ + 1;
  const WlkResult result = wlkBeginFrame(context, &info);
  frame_ += result >= 0 ? 1 : 0;
  return result;
}

WlkResult Life::uploadDiameters() const {
  const std::vector<float> values(512, 12.0f);
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = 8;
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  return wlkUploadVolumeDiameters(context, volume_, &upload);
}

WlkResult Life::createSurface() {
  const SurfaceArrays arrays(support::boxMesh());
  WlkSurfaceInfo info = arrays.info(medium_, 0.01f);
  place(info, {100, 100, 100}, {0, 200, -900});
  const WlkResult result = wlkCreateSurface(context, &info, &surface_);
  EXPECT_TRUE(result >= 0 || surface_.id == 0);
  return result;
}

WlkResult Life::setDetail() const {
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = 20;
  return wlkSetSurfaceDetail(context, surface_, &detail);
}

WlkResult Life::moveSurface() const {
  const SurfaceArrays arrays(support::boxMesh());
  return wlkSetSurfacePositions(context, surface_, arrays.positions.data(), 8, 12);
}

WlkResult Life::createMap() {
  auto info = make<WlkShadowMapInfo>();
  info.width = info.height = MAP_SIZE;
  info.maxSamples = 8;
  const WlkResult result = wlkVulkanCreateShadowMap(context, &info, &map_);
  EXPECT_TRUE(result >= 0 || map_.id == 0);
  return result;
}

// An image whose contents nobody needs.
WlkVulkanImage discarded(const SpyImage& image) {
  WlkVulkanImage described = EngineScene::describe(image, VK_IMAGE_LAYOUT_GENERAL);
  described.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  return described;
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
    return wlkVulkanCmdRenderShadowMap(context, commands, map_, &image);
  });
}

WlkResult Life::record(bool view) {
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
    return view ? wlkVulkanCmdRenderView(context, commands, view_, &targets)
                : wlkVulkanCmdUpdate(context, commands);
  });
}

// What some engines ask for beside the picture.
void Life::addTargetSteps(std::vector<Step>& steps) {
  if (!kind_.targets) {
    return;
  }
  const auto froxels = [this] {
    auto info = make<WlkAerialPerspective>();
    info.width = FROXELS.width;
    info.height = FROXELS.height;
    info.depth = FROXELS.depth;
    return wlkVulkanSetAerialPerspective(context, view_, &info);
  };
  steps.push_back({"wlkVulkanSetAerialPerspective", froxels, true});
  steps.push_back({"wlkVulkanSetVolumeDistance",
                   [this] { return wlkVulkanSetVolumeDistance(context, view_, 1); }, true});
  steps.push_back({"wlkVulkanCreateShadowMap", [this] { return createMap(); }, true});
  if (kind_.diameters) {
    steps.push_back({"wlkUploadVolumeDiameters", [this] { return uploadDiameters(); }, true});
  }
}

std::vector<Step> Life::steps() {
  const auto createView = [this] {
    auto info = make<WlkViewInfo>();
    info.width = WIDTH;
    info.height = HEIGHT;
    info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
    const WlkResult result = wlkCreateView(context, &info, &view_);
    EXPECT_TRUE(result >= 0 || view_.id == 0);
    return result;
  };
  const auto setScene = [this] {
    const auto sky = make<WlkSky>();
    auto sun = make<WlkLight>();
    sun.direction[0] = 0.6f;
    sun.direction[1] = 0.8f;
    auto mediumInfo = make<WlkMediumInfo>();
    if (!kind_.diameters) {
      mediumInfo.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;  // droplets' tables take 0.3 s
    }
    const WlkResult first = wlkSetSky(context, kind_.air ? &sky : nullptr);
    const WlkResult second = wlkSetLights(context, kind_.light ? 1 : 0, sizeof sun, &sun);
    return first < 0    ? first
           : second < 0 ? second
                        : wlkCreateMedium(context, &mediumInfo, &medium_);
  };
  const auto setView = [this] {
    const auto camera = make<WlkCamera>();
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = kind_.scattering;
    const WlkResult first = wlkSetCamera(context, view_, &camera);
    return first < 0 ? first : wlkSetQuality(context, view_, &quality);
  };
  const auto prepare = [this] { return wlkPrepare(context); };
  std::vector<Step> steps{{"wlkCreateContext", [this] { return create(); }, false},
                          {"scene", setScene, false},
                          {"wlkCreateVolume", [this] { return addVolume(volume_); }, true},
                          {"wlkUploadVolume", [this] { return upload(); }, true},
                          {"wlkCreateVolume", [this] { return addVolume(second_); }, true},
                          {"wlkUploadVolumeBricks", [this] { return uploadBricks(); }, true},
                          {"wlkCreateView", createView, true},
                          {"view", setView, false}};
  addTargetSteps(steps);
  if (kind_.surface) {
    steps.push_back({"wlkCreateSurface", [this] { return createSurface(); }, true});
    steps.push_back({"wlkSetSurfaceDetail", [this] { return setDetail(); }, true});
  }
  steps.push_back({"wlkPrepare", prepare, true});
  const auto frame = [&] {
    steps.push_back({"wlkBeginFrame", [this] { return begin(); }, true});
    steps.push_back({"wlkVulkanCmdUpdate", [this] { return record(false); }, true});
    if (kind_.targets) {
      steps.push_back({"wlkVulkanCmdRenderShadowMap", [this] { return recordMap(); }, true});
    }
    steps.push_back({"wlkVulkanCmdRenderView", [this] { return record(true); }, true});
  };
  frame();
  if (kind_.surface) {
    steps.push_back({"wlkSetSurfacePositions", [this] { return moveSurface(); }, true});
  }
  steps.push_back({"wlkUpdateView", [this] { return resize(WIDTH / 2); }, true});
  steps.push_back({"wlkPrepare", prepare, true});
  steps.push_back({"wlkUpdateView", [this] { return resize(WIDTH); }, true});
  steps.push_back({"wlkPrepare", prepare, true});
  steps.push_back({"wlkUploadVolume", [this] { return upload(); }, true});
  frame();
  frame();
  steps.push_back(
      {"wlkDestroyVolume", [this] { return wlkDestroyVolume(context, second_); }, false});
  steps.push_back({"wlkPrepare", prepare, true});
  frame();
  if (kind_.targets) {
    steps.push_back({"wlkVulkanDestroyShadowMap",
                     [this] { return wlkVulkanDestroyShadowMap(context, map_); }, false});
  }
  steps.push_back({"wlkDestroyView", [this] { return wlkDestroyView(context, view_); }, false});
  return steps;
}

WlkResult codeOf(VkResult code) {
  return code == VK_ERROR_OUT_OF_HOST_MEMORY     ? WLK_ERROR_OUT_OF_HOST_MEMORY
         : code == VK_ERROR_OUT_OF_DEVICE_MEMORY ? WLK_ERROR_OUT_OF_DEVICE_MEMORY
                                                 : WLK_ERROR_DEVICE_LOST;
}

class Faults : public ::testing::Test {
 protected:
  Faults() { FaultLayer::failNever(); }
  ~Faults() override {
    FaultLayer::failNever();
    FaultLayer::makeHollowPipelines(false);
    EXPECT_TRUE(engine.spy.messages().empty()) << engine.spy.messages().front();
  }

  std::vector<float> picture() const {
    engine.target.read(VK_IMAGE_LAYOUT_GENERAL);
    const auto* begin = static_cast<const float*>(engine.target.bytes());
    return {begin, begin + size_t{4} * WIDTH * HEIGHT};
  }

  // A life whose k-th call fails. Tells how many calls there are.
  uint64_t live(const Kind& kind, uint64_t k, VkResult code);
  void expectNothingLeft(const char* when) {
    const auto left = FaultLayer::live();
    EXPECT_TRUE(left.empty()) << when << ": " << left.size() << " kinds are left, among them "
                              << left.begin()->second << " of " << left.begin()->first;
  }

  Engine engine;
  std::map<std::string, uint64_t> faultsOf;  // by entry point
  uint64_t absorbed = 0;                     // timestamps that could not be read
};

uint64_t Faults::live(const Kind& kind, uint64_t k, VkResult code) {
  FaultLayer::failAt(k, code, false);
  uint64_t calls = 0;
  CountingAllocator* memory = nullptr;
  {
    Life life(engine, kind);
    memory = &life.memory;
    bool failed = false;
    bool lost = false;
    for (const Step& step : life.steps()) {
      const uint64_t before = FaultLayer::anyCalls();
      WlkResult result = step.call();
      if (lost) {
        // Handles that were never made are the only other thing that fails.
        EXPECT_TRUE(result == WLK_ERROR_INVALID_HANDLE ||
                    result == (step.needsDevice ? WLK_ERROR_DEVICE_LOST : WLK_SUCCESS))
            << step.entry << " returns " << result;
        EXPECT_TRUE(!step.needsDevice || FaultLayer::anyCalls() == before)
            << step.entry << " asks a lost device";
        continue;
      }
      if (result >= 0) {
        continue;
      }
      EXPECT_FALSE(failed) << step.entry << " fails without a fault: " << lastError().message;
      failed = true;
      ++faultsOf[step.entry];
      EXPECT_EQ(result, codeOf(code)) << step.entry;
      EXPECT_EQ(lastError().vkResult, code) << step.entry;
      EXPECT_STREQ(lastError().field, FaultLayer::failed()) << step.entry;
      if (life.context == nullptr) {
        expectNothingLeft("after a failed wlkCreateContext");
        EXPECT_EQ(life.memory.live(), 0u);
      } else {
        lost = code == VK_ERROR_DEVICE_LOST;
      }
      if (!lost) {
        EXPECT_EQ(step.call(), WLK_SUCCESS) << "again, " << step.entry << ": " << lastError().field;
      }
    }
    calls = FaultLayer::calls();
    absorbed += !failed && k < calls ? 1 : 0;
    EXPECT_TRUE(failed || k >= calls ||
                std::string(FaultLayer::failed()) == "vkGetQueryPoolResults")
        << FaultLayer::failed() << " failed and nobody said so";
    if (life.context != nullptr) {
      wlkDestroyContext(life.context);
      life.context = nullptr;
    }
    EXPECT_EQ(memory->live(), 0u) << "host memory is left";
  }
  expectNothingLeft("after wlkDestroyContext");
  return calls;
}

constexpr std::array CODES{VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                           VK_ERROR_DEVICE_LOST};

// Pipelines are hollow here: compiling them takes the driver 3 s for each life.
// The codes take turns, and where tables are made it is every 23rd call or fewer; with
// WELKIN_ALL_FAULTS in the environment each call meets each code.
TEST_F(Faults, EveryCallOfVulkanMayFailOnce) {
  FaultLayer::makeHollowPipelines(true);
  const bool all = std::getenv("WELKIN_ALL_FAULTS") != nullptr;
  uint64_t faults = 0;
  for (const Kind& kind : {CLOUD, AIR, WHOLE, TARGETS, DROPLETS, SURFACE}) {
    const uint64_t calls = live(kind, FaultLayer::NEVER, VK_SUCCESS);
    ASSERT_GT(calls, 100u);
    for (uint64_t k = 0; k < calls && !HasFailure(); k += kind.stride) {
      for (uint64_t i = k; i < k + (all ? CODES.size() : 1); ++i) {
        const VkResult code = CODES[i % CODES.size()];
        SCOPED_TRACE("call " + std::to_string(k) + " returns " + std::to_string(code));
        live(kind, k, code);
        ++faults;
      }
    }
  }
  std::printf("%llu faults, %llu of them unread timestamps\n",
              static_cast<unsigned long long>(faults), static_cast<unsigned long long>(absorbed));
  for (const auto& [entry, count] : faultsOf) {
    std::printf("  %-24s %llu\n", entry.c_str(), static_cast<unsigned long long>(count));
  }
  for (const char* entry : {"wlkCreateContext", "wlkUploadVolume", "wlkUploadVolumeBricks",
                            "wlkCreateSurface", "wlkSetSurfaceDetail", "wlkPrepare"}) {
    EXPECT_GT(faultsOf[entry], 0u) << entry;
  }
}

TEST_F(Faults, ThePictureAfterThemIsTheOneWithout) {
  const uint64_t calls = live(WHOLE, FaultLayer::NEVER, VK_SUCCESS);
  const std::vector<float> truth = picture();
  EXPECT_GT(*std::max_element(truth.begin(), truth.end()), 0.0f);
  constexpr uint64_t LIVES = 4;
  for (uint64_t i = 0; i < LIVES; ++i) {
    const uint64_t k = calls * (2 * i + 1) / (2 * LIVES);
    SCOPED_TRACE("call " + std::to_string(k));
    live(WHOLE, k, CODES[i % 2]);
    EXPECT_TRUE(picture() == truth) << "another one after " << FaultLayer::failed();
  }
}

}  // namespace
}  // namespace welkin::test
