// SPDX-License-Identifier: MIT
// Frames on an engine's device, of any scene into any images: targets that are missing, of another
// role or behind a wrong header, calls in any order, froxels, distance, maps of shadows, an
// engine's own volume. The images are what they are said to be, as the API asks; the validation
// layer has nothing to say, and what was written is finite and not negative.
#include <optional>

#include "engine_images.hpp"
#include "scene_calls.hpp"
#include "support/engine_scene.hpp"

namespace fuzz {
namespace {

using welkin::test::EngineScene;

constexpr uint32_t MAX_CALLS = 24;
constexpr uint32_t MAX_RECORDED = 6;  // calls in a frame
constexpr uint32_t OWN = 7;           // calls that are no frame
constexpr uint32_t FRAMES = 12;       // as likely as so many of them
constexpr uint64_t MEMORY_LIMIT = uint64_t{512} << 20;
constexpr uint32_t INPUTS_PER_CONTEXT = 32;

// What a frame leaves when a call in it runs out of something: commands that may not be submitted.
struct ThrownAway {};

// One device and mostly one context for all inputs: pipelines take longer than frames.
class Host {
 public:
  // Never destroyed, as the driver and its layers have statics of their own.
  static Host& get() {
    static Host* const host = new Host;
    return *host;
  }

  // A context whose last frame was thrown away has lost count of its images, and one of many inputs
  // has many pipelines, 2.5 MB of lavapipe's each.
  void renewAfter(bool thrownAway) {
    if (thrownAway || ++inputs_ % INPUTS_PER_CONTEXT == 0) {
      renew();
    }
  }

  SpyDevice spy{true};
  Images images{spy};
  WlkContext context = nullptr;
  WlkMedium medium{};
  uint64_t frame = 0;

 private:
  Host() { renew(); }
  void renew() {
    wlkDestroyContext(context);
    context = nullptr;
    auto device = welkin::test::describeDevice(spy);
    device.enabledFeatures = WLK_VULKAN_FEATURE_BLEND;
    auto info = welkin::make<WlkContextInfo>();
    info.next = &device;
    info.deviceMemoryLimit = MEMORY_LIMIT;
    require(checkResult(wlkCreateContext(WLK_API_VERSION, &info, &context)), "there is a context");
    const auto made = welkin::make<WlkMediumInfo>();
    require(checkResult(wlkCreateMedium(context, &made, &medium)), "there is a medium");
    frame = 0;
  }
  uint32_t inputs_ = 0;
};

class Run {
 public:
  explicit Run(Input& input)
      : input_(input), host_(Host::get()), images_(host_.images), view_(makeView()) {
    scene_.emplace(input, host_.context, host_.medium, view_);
    if (input_.oneIn(2)) {
      aerial();
      check(wlkSetVolumeDistance(host_.context, view_, 1));
      map();
    }
  }
  ~Run() {
    scene_.reset();
    (void)wlkDestroyView(host_.context, view_);
    (void)wlkDestroyCloudShadow(host_.context, map_);
    (void)wlkDestroyVolume(host_.context, volume_);
    (void)wlkVulkanForgetImage(host_.context, images_.voxels.handle);
    host_.renewAfter(thrownAway_);
    for (const std::string& message : host_.spy.messages()) {
      std::fprintf(stderr, "%s\n", message.c_str());
    }
    require(host_.spy.messages().empty(), "the validation layer has nothing to say");
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void call() {
    if (thrownAway_) {
      return;
    }
    const uint32_t which = input_.below(SceneCalls::COUNT + OWN + FRAMES);
    if (which < SceneCalls::COUNT) {
      return scene_->call(which);
    }
    switch (which - SceneCalls::COUNT) {
      case 0:
        return aerial();
      case 1:
        return check(wlkSetVolumeDistance(host_.context, view_, input_.below(3)));
      case 2:
        return map();
      case 3:
        return volumeImage();
      case 4:
        return updateView();
      case 5:
        return forget();
      case 6:
        return check(wlkPrepare(host_.context));
      default:
        return frame();
    }
  }

  void lastFrame() {
    if (!thrownAway_) {
      frame();
    }
  }

 private:
  Input& input_;
  Host& host_;
  Images& images_;
  WlkView view_;
  WlkCloudShadow map_{};
  WlkVolume volume_{};  // with the engine's voxels
  std::optional<SceneCalls> scene_;
  uint32_t composite_ = WLK_COMPOSITE_COMPUTE;
  bool half_ = false;
  bool thrownAway_ = false;
  bool otherUsed_ = false;  // by the call that is made: no image has two roles

  static void check(WlkResult result) { (void)checkResult(result); }

  static WlkViewInfo viewInfo() {
    auto info = welkin::make<WlkViewInfo>();
    info.width = VIEW.width;
    info.height = VIEW.height;
    info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
    return info;
  }
  static WlkView makeView() {
    const WlkViewInfo info = viewInfo();
    WlkView view{};
    require(checkResult(wlkCreateView(Host::get().context, &info, &view)), "there is a view");
    return view;
  }
  void updateView() {
    WlkViewInfo right = viewInfo();
    right.composite = input_.below(3);
    right.targetFormat = input_.below(2);
    right.colorSpace = input_.below(2);
    if (input_.oneIn(4)) {
      right.layers &= ~(uint64_t{1} << input_.below(16));
    }
    if (input_.oneIn(8)) {
      right.width = OTHER.width;
      right.height = OTHER.height;
    }
    Framed<WlkViewInfo> info(input_, right);
    if (checkResult(wlkUpdateView(host_.context, view_, info.get()))) {
      composite_ = right.composite;
      half_ = right.targetFormat != WLK_TARGET_RGBA32_FLOAT;
    }
  }

  void aerial() {
    Framed<WlkAerialPerspective> info(input_);
    info.value.width = FROXELS.width;
    info.value.height = FROXELS.height;
    info.value.depth = FROXELS.depth + (input_.oneIn(8) ? 1 : 0);
    const bool none = input_.oneIn(8);
    check(wlkSetAerialPerspective(host_.context, view_, none ? nullptr : info.get()));
  }

  void map() {
    Framed<WlkCloudShadowInfo> info(input_);
    info.value.width = MAP.width;
    info.value.height = MAP.height;
    info.value.maxSamples = 8 + input_.below(56);
    if (map_.id != 0 && input_.oneIn(2)) {
      return check(wlkSetCloudShadow(host_.context, map_, info.get()));
    }
    (void)wlkDestroyCloudShadow(host_.context, map_);
    check(wlkCreateCloudShadow(host_.context, info.get(), &map_));
  }

  void volumeImage() {
    (void)wlkDestroyVolume(host_.context, volume_);
    Framed<WlkVolumeInfo> info(input_);
    WlkVolumeField field{host_.medium, std::abs(input_.number<float>()), 0};
    info.value.fields = &field;
    info.value.fieldStride = sizeof field;
    info.value.fieldCount = 1;
    info.value.size[0] = VOXELS.width;
    info.value.size[1] = VOXELS.height;
    info.value.size[2] = VOXELS.depth + (input_.oneIn(8) ? 1 : 0);
    const bool made = checkResult(wlkCreateVolume(host_.context, info.get(), &volume_));
    const Place place(input_);
    place.require(made, wlkSetVolumeTransform(host_.context, volume_, place.transform));
    Framed<WlkVulkanImage> image(
        input_, EngineScene::describe(images_.voxels, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL));
    check(wlkVulkanSetVolumeImage(host_.context, volume_, input_.oneIn(8) ? 1 : 0, image.get()));
  }

  void forget() {
    const SpyImage* const any[] = {&images_.color32, &images_.voxels, &images_.mapDepth,
                                   &images_.aerialRadiance};
    const VkImage image = any[input_.below(4)]->handle;
    check(wlkVulkanForgetImage(host_.context, input_.oneIn(8) ? VK_NULL_HANDLE : image));
  }

  // After a lack of memory or the device the frame's commands are not to run.
  void recorded(WlkResult result) {
    check(result);
    if (result <= WLK_ERROR_OUT_OF_HOST_MEMORY && result >= WLK_ERROR_DEVICE_LOST) {
      throw ThrownAway{};
    }
  }

  void frame() {
    if (!input_.oneIn(4)) {
      check(wlkPrepare(host_.context));
    }
    auto right = welkin::make<WlkFrameInfo>();
    right.frameIndex = host_.frame + 1;
    right.completedFrameIndex = host_.frame;
    if (input_.oneIn(16)) {
      // Refused: a frame that was, or one that is complete before it began.
      right.frameIndex = input_.oneIn(2) ? host_.frame : 0;
      right.completedFrameIndex += input_.below(3);
    }
    Framed<WlkFrameInfo> info(input_, right);
    if (checkResult(wlkBeginFrame(host_.context, info.get()))) {
      host_.frame = right.frameIndex;
    }
    // What is blended lies on what was there.
    Images::fill(images_.color32, 0.5f);
    Images::fill(images_.color16, 0.0f);
    Images::fill(images_.other, 0.5f);
    try {
      host_.spy.run([this](VkCommandBuffer commands) {
        recorded(input_.oneIn(16) ? WLK_SUCCESS : wlkVulkanCmdUpdate(host_.context, commands));
        recordView(commands);
        for (uint32_t n = input_.below(MAX_RECORDED); n > 0; --n) {
          record(commands);
        }
      });
    } catch (const ThrownAway&) {
      thrownAway_ = true;
      return;
    }
    for (const SpyImage* image :
         {&images_.color32, &images_.color16, &images_.radiance32, &images_.radiance16,
          &images_.transmittance32, &images_.transmittance16, &images_.other, &images_.mapDepth,
          &images_.mapColor, &images_.aerialRadiance, &images_.aerialTransmittance,
          &images_.distance}) {
      requireLightIn(*image);
    }
  }

  void record(VkCommandBuffer commands) {
    switch (input_.below(6)) {
      case 0:
        return recorded(wlkVulkanCmdUpdate(host_.context, commands));
      case 1:
        return recordMap(commands);
      case 2:
        return scene_->call(input_.below(SceneCalls::COUNT));
      case 3:
        return check(wlkPrepare(host_.context));
      default:
        return recordView(commands);
    }
  }

  // The image of a role, most of the time; else none, one of another size, or a wrong header.
  const WlkVulkanImage* pick(std::optional<Framed<WlkVulkanImage>>& place, const SpyImage& image,
                             uint32_t noneIn = 12) {
    if (input_.oneIn(noneIn)) {
      return nullptr;
    }
    const bool misfit = input_.oneIn(24) && !otherUsed_;
    otherUsed_ = otherUsed_ || misfit;
    WlkVulkanImage right =
        EngineScene::describe(misfit ? images_.other : image, VK_IMAGE_LAYOUT_GENERAL);
    if (input_.oneIn(32)) {
      right.after.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    }
    place.emplace(input_, right);
    return place->get();
  }

  void recordView(VkCommandBuffer commands) {
    otherUsed_ = false;
    std::optional<Framed<WlkVulkanImage>> depth, input, color, radiance, transmittance, shadow,
        aerialRadiance, aerialTransmittance, distance;
    Framed<WlkLightShadow> lies(input_);
    lies.value.clipFromWorld[0][0] = lies.value.clipFromWorld[0][5] =
        lies.value.clipFromWorld[0][10] = 1e-3f;
    auto right = welkin::make<WlkVulkanViewTargets>();
    right.depth = pick(depth, images_.depth, 3);
    const bool separate = (composite_ == WLK_COMPOSITE_SEPARATE) != input_.oneIn(24);
    if (separate) {
      right.radiance = pick(radiance, half_ ? images_.radiance16 : images_.radiance32);
      right.transmittance =
          pick(transmittance, half_ ? images_.transmittance16 : images_.transmittance32);
    } else {
      right.color = pick(color, half_ ? images_.color16 : images_.color32);
      if (composite_ == WLK_COMPOSITE_COMPUTE) {
        right.colorInput = input_.oneIn(3) ? right.color : pick(input, images_.input, 3);
      }
    }
    if (input_.oneIn(4)) {
      right.lightShadow = input_.oneIn(8) ? nullptr : lies.get();
      right.shadowMap = pick(shadow, images_.shadow);
    }
    if (input_.oneIn(3)) {
      right.aerialRadiance = pick(aerialRadiance, images_.aerialRadiance);
      right.aerialTransmittance = pick(aerialTransmittance, images_.aerialTransmittance);
    }
    if (input_.oneIn(3)) {
      right.volumeDistance = pick(distance, images_.distance);
    }
    Framed<WlkVulkanViewTargets> targets(input_, right);
    recorded(wlkVulkanCmdRenderView(host_.context, commands, view_, targets.get()));
  }

  void recordMap(VkCommandBuffer commands) {
    otherUsed_ = false;
    std::optional<Framed<WlkVulkanImage>> image;
    const WlkVulkanImage* target =
        pick(image, input_.oneIn(3) ? images_.mapColor : images_.mapDepth);
    recorded(wlkVulkanCmdRenderCloudShadow(host_.context, commands, map_, target));
  }
};

}  // namespace
}  // namespace fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::run<fuzz::Run>(data, size, fuzz::MAX_CALLS, &fuzz::Run::lastFrame);
}
