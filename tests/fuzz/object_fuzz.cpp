// SPDX-License-Identifier: MIT
// Sequences of calls of a headless context: volumes, their data, views, cameras, quality. Nothing
// is drawn, which keeps an input at some 100 us; the stress tests draw.
#include <algorithm>
#include <memory>

#include "framed.hpp"

namespace fuzz {
namespace {

constexpr uint32_t MAX_CALLS = 32;
constexpr uint64_t MEMORY_LIMIT = uint64_t{256} << 20;

// One device for all inputs; null where there is none, which is checked like any other context.
WlkContext makeContext() {
  auto headless = welkin::make<WlkHeadlessInfo>();
  auto info = welkin::make<WlkContextInfo>();
  info.next = &headless;
  info.deviceMemoryLimit = MEMORY_LIMIT;
  WlkContext context = nullptr;
  if (!checkResult(wlkCreateContext(WLK_API_VERSION, &info, &context))) {
    info.next = nullptr;
    (void)checkResult(wlkCreateContext(WLK_API_VERSION, &info, &context));
  }
  return context;
}

class Run {
 public:
  explicit Run(Input& input) : input_(input) {
    static const WlkContext context = makeContext();
    context_ = context;
    static const WlkMedium medium = [] {
      const auto info = welkin::make<WlkMediumInfo>();
      WlkMedium made{};
      (void)checkResult(wlkCreateMedium(context, &info, &made));
      return made;
    }();
    medium_ = medium;
  }
  ~Run() {
    for (const WlkVolume volume : volumes_.all()) {
      (void)wlkDestroyVolume(context_, volume);
    }
    for (const WlkSurface surface : surfaces_.all()) {
      (void)wlkDestroySurface(context_, surface);
    }
    for (const WlkView view : views_.all()) {
      (void)wlkDestroyView(context_, view);
    }
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void call() {
    switch (input_.below(18)) {
      case 0:
        return createVolume();
      case 1:
        (void)checkResult(wlkDestroyVolume(context_, volumes_.pick(input_)));
        return;
      case 2:
        return setTransform();
      case 3:
        return upload(wlkUploadVolume);
      case 4:
        return upload(wlkUploadVolumeDiameters);
      case 5:
        (void)checkResult(wlkClearVolumeDiameters(context_, volumes_.pick(input_)));
        return;
      case 6:
        return uploadBricks();
      case 7:
        return volumeState();
      case 8:
        return view(nullptr);
      case 9:
        return view(&views_);
      case 10:
        (void)checkResult(wlkDestroyView(context_, views_.pick(input_)));
        return;
      case 11:
        return camera();
      case 12:
        return quality();
      case 13:
        return estimate();
      case 14:
        return outOfOrder();
      case 15:
        return createSurface();
      case 16:
        return changeSurface();
      default:
        return light();
    }
  }

 private:
  Input& input_;
  WlkContext context_ = nullptr;
  WlkMedium medium_{};
  Handles<WlkVolume> volumes_;
  Handles<WlkView> views_;
  Handles<WlkSurface> surfaces_;
  unsigned char data_[4096] = {};

  void createVolume() {
    Framed<WlkVolumeInfo> info(input_);
    WlkVolumeField fields[3];
    for (WlkVolumeField& field : fields) {
      field = {input_.oneIn(16) ? WlkMedium{input_.take<uint64_t>()} : medium_,
               input_.number<float>(), 0};
    }
    info.value.fields = fields;
    info.value.fieldStride = sizeof fields[0];
    info.value.fieldCount = input_.oneIn(8) ? input_.below(4) : 1;
    for (uint32_t& edge : info.value.size) {
      edge = input_.oneIn(16) ? input_.take<uint32_t>() : input_.below(24);
    }
    WlkVolume volume{};
    const bool made = checkResult(wlkCreateVolume(context_, info.get(), &volume));
    require(made == (volume.id != 0), "a volume comes back exactly if there is one");
    volumes_.add(volume);
  }

  // A tetrahedron whose numbers are mostly good.
  void createSurface() {
    static constexpr uint32_t CLOSED[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    Framed<WlkSurfaceInfo> info(input_);
    float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    uint32_t indices[12];
    std::memcpy(indices, CLOSED, sizeof indices);
    if (input_.oneIn(2)) {
      positions[input_.below(12)] = input_.number<float>();
    }
    if (input_.oneIn(8)) {
      indices[input_.below(12)] = input_.below(6);
    }
    info.value.medium = input_.oneIn(16) ? WlkMedium{input_.take<uint64_t>()} : medium_;
    info.value.extinction = input_.number<float>();
    info.value.positions = positions;
    info.value.indices = indices;
    info.value.vertexStride = sizeof positions / 4;
    info.value.vertexCount = input_.oneIn(8) ? input_.below(5) : 4;
    info.value.triangleCount = input_.oneIn(8) ? input_.below(5) : 4;
    WlkSurface surface{};
    const bool made = checkResult(wlkCreateSurface(context_, info.get(), &surface));
    require(made == (surface.id != 0), "a surface comes back exactly if there is one");
    surfaces_.add(surface);
  }

  void changeSurface() {
    const WlkSurface surface = surfaces_.pick(input_);
    if (input_.oneIn(3)) {
      (void)checkResult(wlkDestroySurface(context_, surface));
    } else if (input_.oneIn(2)) {
      double transform[12];
      for (double& x : transform) {
        x = input_.number<double>();
      }
      (void)checkResult(wlkSetSurfaceTransform(context_, surface, transform));
    } else if (input_.oneIn(2)) {
      Framed<WlkSurfaceDetail> detail(input_);
      (void)checkResult(
          wlkSetSurfaceDetail(context_, surface, input_.oneIn(8) ? nullptr : detail.get()));
    } else {
      float positions[12];
      for (float& x : positions) {
        x = input_.number<float>();
      }
      (void)checkResult(wlkSetSurfacePositions(context_, surface, positions, 4, 12));
    }
  }

  void setTransform() {
    double transform[12];
    for (double& x : transform) {
      x = input_.number<double>();
    }
    (void)checkResult(wlkSetVolumeTransform(context_, volumes_.pick(input_), transform));
  }

  void fillData() {
    for (size_t i = 0; i < sizeof data_; i += 64) {
      data_[i + input_.below(64)] = input_.take<unsigned char>();
    }
  }

  void upload(WlkResult (*function)(WlkContext, WlkVolume, const WlkVolumeUpload*)) {
    fillData();
    Framed<WlkVolumeUpload> info(input_);
    WlkVolumeUpload& value = info.value;
    value.field = input_.oneIn(8) ? input_.take<uint8_t>() : 0;
    for (size_t i = 0; i < 3; ++i) {
      value.extent[i] = input_.oneIn(16) ? input_.take<uint32_t>() : input_.below(24);
      value.offset[i] = input_.oneIn(4) ? input_.below(24) : 0;
    }
    value.data = data_;
    value.dataSize = sizeof data_;
    (void)checkResult(function(context_, volumes_.pick(input_), info.get()));
  }

  void uploadBricks() {
    fillData();
    uint32_t coordinates[12];
    for (uint32_t& x : coordinates) {
      x = input_.oneIn(16) ? input_.take<uint32_t>() : input_.below(3);
    }
    Framed<WlkVolumeBricks> bricks(input_);
    bricks.value.count = input_.below(5);
    bricks.value.coordinates = coordinates;
    bricks.value.data = data_;
    bricks.value.dataSize = sizeof data_;
    (void)checkResult(wlkUploadVolumeBricks(context_, volumes_.pick(input_), bricks.get()));
  }

  void volumeState() {
    Framed<WlkVolumeState> state(input_);
    if (checkResult(wlkGetVolumeState(context_, volumes_.pick(input_), state.get()))) {
      require(state.value.deviceMemory <= MEMORY_LIMIT, "volumes keep the memory limit");
    }
  }

  // Makes one, or changes one of `known`.
  void view(const Handles<WlkView>* known) {
    Framed<WlkViewInfo> info(input_);
    if (!input_.oneIn(8)) {
      info.value.width = 1 + input_.below(64);
      info.value.height = 1 + input_.below(64);
    }
    if (known != nullptr) {
      (void)checkResult(wlkUpdateView(context_, known->pick(input_), info.get()));
      return;
    }
    WlkView view{};
    const bool made = checkResult(wlkCreateView(context_, info.get(), &view));
    require(made == (view.id != 0), "a view comes back exactly if there is one");
    views_.add(view);
  }

  void camera() {
    Framed<WlkCamera> camera(input_);
    (void)checkResult(wlkSetCamera(context_, views_.pick(input_), camera.get()));
  }

  void quality() {
    Framed<WlkQuality> quality(input_);
    const WlkView view = views_.pick(input_);
    (void)checkResult(wlkSetQuality(context_, view, quality.get()));
    auto state = welkin::make<WlkQualityState>();
    if (checkResult(wlkGetQualityState(context_, view, &state))) {
      require(state.lowestRung <= state.rung && state.rung <= state.highestRung,
              "the rung is on the ladder");
    }
    (void)checkResult(
        wlkReportFrameTime(context_, view, input_.take<uint64_t>(), input_.number<double>()));
  }

  void estimate() {
    Framed<WlkErrorEstimate> estimate(input_);
    if (checkResult(wlkGetErrorEstimate(context_, views_.pick(input_), estimate.get()))) {
      requireLight(&estimate.value.relativeError, 1, 1.0f, "estimates are in [0, 1]");
    }
  }

  void outOfOrder() {
    const WlkView view = views_.pick(input_);
    Framed<WlkFrameInfo> frame(input_);
    (void)checkResult(wlkBeginFrame(context_, frame.get()));
    Framed<WlkHeadlessInputs> targets(input_);
    targets.value.color = nullptr;
    targets.value.depth = nullptr;
    targets.value.lightShadow = nullptr;
    targets.value.shadowDepth = nullptr;
    // A view that was never prepared: everything is checked, nothing is drawn.
    require(!checkResult(wlkRenderHeadless(context_, view, targets.get())), "nothing is prepared");
    Framed<WlkImageData> image(input_);
    image.value.data = reinterpret_cast<float*>(data_);
    image.value.dataSize = std::min<uint64_t>(image.value.dataSize, sizeof data_);
    (void)checkResult(wlkReadback(context_, view, image.get()));
    Framed<WlkFrameStats> stats(input_);
    uint32_t count = 0;
    (void)checkResult(wlkGetFrameStats(context_, view, stats.get(), &count, 0, nullptr));
    (void)wlkReasonName(input_.take<uint32_t>());
    (void)wlkControlReasonName(input_.take<uint32_t>());
  }

  void light() {
    Framed<WlkLight> light(input_);
    (void)light.get();
    (void)checkResult(wlkSetLights(context_, 1, sizeof light.value, &light.value));
    Framed<WlkSky> sky(input_);
    (void)checkResult(wlkSetSky(context_, sky.get()));
  }
};

}  // namespace
}  // namespace fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::run<fuzz::Run>(data, size, fuzz::MAX_CALLS);
}
