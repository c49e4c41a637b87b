// SPDX-License-Identifier: MIT
// Small pictures of any scene that the API accepts: sky, fog, lights, a volume, a cloud surface,
// any camera. What was prepared is drawn, and every pixel is finite and not negative.
#include <algorithm>
#include <vector>

#include "scene_calls.hpp"

namespace fuzz {
namespace {

constexpr uint32_t MAX_CALLS = 24;
constexpr uint32_t WIDTH = 8;
constexpr uint32_t HEIGHT = 6;
constexpr uint64_t MEMORY_LIMIT = uint64_t{512} << 20;
constexpr uint32_t INPUTS_PER_CONTEXT = 128;

// One device for many inputs: its pipelines take longer than a picture.
class Host {
 public:
  // Never destroyed, as the driver has statics of its own.
  static Host& get() {
    static Host* const host = new Host;
    return *host;
  }
  // For every input. Scenes have ever other pipelines, 2.5 MB of lavapipe's each, which a context
  // keeps: that of another input is a new one now and then.
  static Host& next() {
    Host& host = get();
    if (++host.inputs_ % INPUTS_PER_CONTEXT == 0) {
      wlkDestroyContext(host.context);
      host.create();
    }
    return host;
  }

  WlkContext context = nullptr;
  WlkMedium medium{};

 private:
  Host() { create(); }
  void create() {
    auto headless = welkin::make<WlkHeadlessInfo>();
    auto info = welkin::make<WlkContextInfo>();
    info.next = &headless;
    info.deviceMemoryLimit = MEMORY_LIMIT;
    require(checkResult(wlkCreateContext(WLK_API_VERSION, &info, &context)),
            "there is a device to draw with");
    const auto made = welkin::make<WlkMediumInfo>();
    require(checkResult(wlkCreateMedium(context, &made, &medium)), "there is a medium");
  }
  uint32_t inputs_ = 0;
};

class Run {
 public:
  explicit Run(Input& input)
      : input_(input),
        context_(Host::next().context),
        view_(makeView()),
        scene_(input, context_, Host::get().medium, view_) {}
  ~Run() { (void)wlkDestroyView(context_, view_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void call() {
    const uint32_t which = input_.below(SceneCalls::COUNT + 1);
    which < SceneCalls::COUNT ? scene_.call(which) : draw();
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
  WlkContext context_;
  WlkView view_;
  SceneCalls scene_;

  static WlkView makeView() {
    auto info = welkin::make<WlkViewInfo>();
    info.width = WIDTH;
    info.height = HEIGHT;
    WlkView view{};
    require(checkResult(wlkCreateView(Host::get().context, &info, &view)), "there is a view");
    return view;
  }

  bool prepare() { return checkResult(wlkPrepare(context_)); }
};

}  // namespace
}  // namespace fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::run<fuzz::Run>(data, size, fuzz::MAX_CALLS, &fuzz::Run::draw);
}
