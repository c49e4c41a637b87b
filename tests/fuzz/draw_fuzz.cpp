// SPDX-License-Identifier: MIT
// Small pictures of any scene that the API accepts: sky, fog, lights, a volume, a cloud surface,
// any camera. What was prepared is drawn, and every pixel is finite and not negative.
#include <algorithm>
#include <vector>

#include "framed.hpp"

namespace fuzz {
namespace {

constexpr uint32_t MAX_CALLS = 24;
constexpr uint32_t WIDTH = 8;
constexpr uint32_t HEIGHT = 6;
constexpr uint32_t EDGE = 6;  // voxels, at most
constexpr uint64_t MEMORY_LIMIT = uint64_t{512} << 20;

// One device for all inputs: its pipelines take longer than a picture.
struct Host {
  WlkContext context = nullptr;
  WlkMedium medium{};
};

const Host& host() {
  static const Host made = [] {
    Host host;
    auto headless = welkin::make<WlkHeadlessInfo>();
    auto info = welkin::make<WlkContextInfo>();
    info.next = &headless;
    info.deviceMemoryLimit = MEMORY_LIMIT;
    require(checkResult(wlkCreateContext(WLK_API_VERSION, &info, &host.context)),
            "there is a device to draw with");
    const auto medium = welkin::make<WlkMediumInfo>();
    require(checkResult(wlkCreateMedium(host.context, &medium, &host.medium)), "there is a medium");
    return host;
  }();
  return made;
}

class Run {
 public:
  explicit Run(Input& input) : input_(input), context_(host().context) {
    auto info = welkin::make<WlkViewInfo>();
    info.width = WIDTH;
    info.height = HEIGHT;
    require(checkResult(wlkCreateView(context_, &info, &view_)), "there is a view");
    quality();
    const auto sky = welkin::make<WlkSky>();
    (void)checkResult(wlkSetSky(context_, &sky));
    camera();
  }
  ~Run() {
    (void)wlkDestroyVolume(context_, volume_);
    (void)wlkDestroySurface(context_, surface_);
    (void)wlkDestroyView(context_, view_);
    (void)wlkSetSky(context_, nullptr);
    (void)wlkSetFog(context_, nullptr);
    (void)wlkSetAbsorber(context_, nullptr);
    (void)wlkSetAmbient(context_, nullptr);
    (void)wlkSetPlanet(context_, nullptr);
    (void)wlkSetLights(context_, 0, 0, nullptr);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void call() {
    switch (input_.below(12)) {
      case 0:
        return set(wlkSetSky);
      case 1:
        return set(wlkSetFog);
      case 2:
        return set(wlkSetAbsorber);
      case 3:
        return set(wlkSetAmbient);
      case 4:
        return set(wlkSetPlanet);
      case 5:
        return lights();
      case 6:
        return volume();
      case 7:
        return surface();
      case 8:
        return camera();
      case 9:
        return quality();
      case 10:
        return upload();
      default:
        return draw();
    }
  }

  void draw() {
    if (input_.oneIn(2) && !prepare()) {
      return;
    }
    auto inputs = welkin::make<WlkHeadlessInputs>();
    float depth[WIDTH * HEIGHT];
    if (input_.oneIn(2)) {
      std::generate_n(depth, WIDTH * HEIGHT, [&] { return input_.number<float>(); });
      inputs.depth = depth;
      inputs.depthSize = sizeof depth;
    }
    WlkResult result = wlkRenderHeadless(context_, view_, &inputs);
    if (result == WLK_ERROR_NOT_PREPARED) {
      if (!prepare()) {
        return;
      }
      result = wlkRenderHeadless(context_, view_, &inputs);
      require(result != WLK_ERROR_NOT_PREPARED, "what was just prepared can be drawn");
    }
    if (!checkResult(result)) {
      return;
    }
    float picture[4 * WIDTH * HEIGHT];
    auto image = welkin::make<WlkImageData>();
    image.data = picture;
    image.dataSize = sizeof picture;
    require(checkResult(wlkReadback(context_, view_, &image)), "what was drawn can be read");
    requireLight(picture, std::size(picture), std::numeric_limits<float>::max(),
                 "pixels are finite and not negative");
    auto stats = welkin::make<WlkFrameStats>();
    uint32_t count = 0;
    require(checkResult(wlkGetFrameStats(context_, view_, &stats, &count, 0, nullptr)),
            "a frame has statistics");
    require(stats.nonFinitePixels == 0, "no pixel had to be replaced");
    require(stats.deviceMemory <= MEMORY_LIMIT, "the memory limit is kept");
  }

 private:
  Input& input_;
  WlkContext context_ = nullptr;
  WlkView view_{};
  WlkVolume volume_{};
  WlkSurface surface_{};
  uint32_t size_[3] = {};

  bool prepare() { return checkResult(wlkPrepare(context_)); }

  template <typename T>
  void set(WlkResult (*function)(WlkContext, const T*)) {
    Framed<T> value(input_);
    (void)checkResult(function(context_, input_.oneIn(8) ? nullptr : value.get()));
  }

  void lights() {
    WlkLight two[2];
    for (WlkLight& one : two) {
      Framed<WlkLight> light(input_);
      (void)light.get();
      one = light.value;
      one.next = nullptr;
    }
    (void)checkResult(wlkSetLights(context_, input_.below(3), sizeof two[0], two));
  }

  void camera() {
    Framed<WlkCamera> camera(input_);
    // Near the ground, most of the time.
    camera.value.position[1] += input_.oneIn(4) ? input_.number<double>() : 100.0;
    (void)checkResult(wlkSetCamera(context_, view_, camera.get()));
  }

  // Of any level, and small: what is asked for in pixels, slices and cells is time.
  void quality() {
    Framed<WlkQuality> quality(input_);
    WlkQuality& q = quality.value;
    q.level = input_.below(4);
    q.sliceCount = 1 + input_.below(24);
    q.batchSize = input_.oneIn(4) ? 1 + input_.below(8) : 0;
    q.lightBufferSize = 16 + input_.below(32);
    q.volumeCells = 8;
    static constexpr uint32_t SCATTERING[] = {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD,
                                              WLK_SCATTERING_ALL_ORDERS};
    q.scattering = SCATTERING[input_.below(3)];
    (void)checkResult(wlkSetQuality(context_, view_, quality.get()));
  }

  // A box around the eye or before it, mostly.
  void box(double (&transform)[12]) {
    const double edge = 100.0 * (1 + input_.below(40));
    for (int i = 0; i < 3; ++i) {
      transform[4 * i] = edge;
      transform[9 + i] = edge * (input_.below(5) - 2.5);
    }
    while (input_.oneIn(3)) {
      transform[input_.below(12)] = input_.number<double>();
    }
  }

  void volume() {
    (void)wlkDestroyVolume(context_, volume_);
    Framed<WlkVolumeInfo> info(input_);
    WlkVolumeField field{host().medium, std::abs(input_.number<float>()), 0};
    info.value.fields = &field;
    info.value.fieldStride = sizeof field;
    info.value.fieldCount = 1;
    for (size_t i = 0; i < 3; ++i) {
      size_[i] = 1 + input_.below(EDGE);
      info.value.size[i] = size_[i];
    }
    (void)checkResult(wlkCreateVolume(context_, info.get(), &volume_));
    double transform[12] = {};
    box(transform);
    (void)checkResult(wlkSetVolumeTransform(context_, volume_, transform));
    upload();
  }

  void upload() {
    float voxels[EDGE * EDGE * EDGE];
    const bool any = input_.oneIn(4);
    for (float& one : voxels) {
      one = any ? input_.number<float>() : static_cast<float>(input_.below(3));
    }
    Framed<WlkVolumeUpload> info(input_);
    std::copy_n(size_, 3, info.value.extent);
    info.value.data = voxels;
    info.value.dataSize = sizeof voxels;
    (void)checkResult(wlkUploadVolume(context_, volume_, info.get()));
  }

  void surface() {
    static constexpr uint32_t CLOSED[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    (void)wlkDestroySurface(context_, surface_);
    Framed<WlkSurfaceInfo> info(input_);
    float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (input_.oneIn(4)) {
      positions[input_.below(12)] = input_.number<float>();
    }
    info.value.medium = host().medium;
    info.value.positions = positions;
    info.value.indices = CLOSED;
    info.value.vertexStride = 12;
    info.value.vertexCount = 4;
    info.value.triangleCount = 4;
    if (!checkResult(wlkCreateSurface(context_, info.get(), &surface_))) {
      return;
    }
    double transform[12] = {};
    box(transform);
    (void)checkResult(wlkSetSurfaceTransform(context_, surface_, transform));
    if (input_.oneIn(2)) {
      Framed<WlkSurfaceDetail> detail(input_);
      (void)checkResult(wlkSetSurfaceDetail(context_, surface_, detail.get()));
    }
  }
};

}  // namespace
}  // namespace fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Input input(data, size);
  fuzz::Run run(input);
  fuzz::call(run, input, fuzz::MAX_CALLS);
  run.draw();
  return 0;
}
