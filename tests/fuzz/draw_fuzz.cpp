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
  explicit Run(Input& input)
      : input_(input),
        context_(host().context),
        view_(makeView()),
        scene_(input, context_, host().medium, view_) {}
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
    require(checkResult(wlkCreateView(host().context, &info, &view)), "there is a view");
    return view;
  }

  bool prepare() { return checkResult(wlkPrepare(context_)); }
};

}  // namespace
}  // namespace fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::run<fuzz::Run>(data, size, fuzz::MAX_CALLS, &fuzz::Run::draw);
}
