// SPDX-License-Identifier: MIT
#include "bench/front_study.hpp"

#include <algorithm>
#include <future>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

namespace bench {
namespace {

// Width of the timed views at least, a multiple of the case's: frames of few milliseconds are
// mostly the waking of threads, and times of them in two runs differ by a tenth and more.
constexpr uint32_t TIMED_WIDTH = 512;
constexpr uint32_t TIMED_WIDTH_VOLUMES = 256;
// Frames before the measured ones: the first compiles, and every slot of the frames in flight
// (3) is recorded once.
constexpr size_t WARM_UPS = 3;
// Views of a method that are timed in turn. Where it lies changes the time of some short frames by
// 3 %, of long ones, which keep much, hardly.
size_t copiesOf(const Case& one, const Settings& settings) {
  const Settings high = levelSettings(WLK_QUALITY_HIGH);
  const bool isShort = settings.batchSize == 0 && settings.sliceCount <= high.sliceCount &&
                       settings.lightBufferSize <= high.lightBufferSize;
  return isShort || !hasVolumes(one) ? 6 : 3;
}

// A context keeps 512 MiB of light for its views, and draws in batches, several times slower, what
// finds no room: 512 x 512 texels of 256 slabs never do. The levels fit in; other light that takes
// a quarter of it has a context of its own, so that no method's time depends on which others there
// are.
bool keepsMuch(const Settings& settings) {
  constexpr uint64_t TEXELS = uint64_t{1} << 24;  // of two floats
  const uint64_t side = settings.lightBufferSize;
  return !settings.ambient && settings.batchSize == 0 &&
         side * side * settings.sliceCount >= TEXELS;
}

// A case's contexts: with the tables of the phase functions or the closed forms, with the light of
// sky and ground or without.
class Worlds {
 public:
  // All at once: what a context makes of a scene keeps one core busy.
  Worlds(const Case& one, const std::vector<Method>& methods) : case_(one) {
    std::map<Key, std::future<std::unique_ptr<World>>> made;
    for (const Method& method : methods) {
      const auto make = [this, &method] {
        const Settings& settings = method.settings;
        auto world = std::make_unique<World>(case_, settings.analytic, settings.ambient);
        // Its first view compiles, and makes the tables that all share.
        const WlkView view = world->addView(qualityOf(method));
        world->prepare();
        world->removeView(view);
        return world;
      };
      std::future<std::unique_ptr<World>>& world = made[keyOf(method)];
      if (!world.valid()) {
        world = std::async(std::launch::async, make);
      }
    }
    for (auto& [key, world] : made) {
      worlds_[key] = world.get();
    }
    opaque_ = usual().makeOpaque();
  }
  World& of(const Method& method) {
    std::unique_ptr<World>& world = worlds_[keyOf(method)];
    if (!world) {
      world = std::make_unique<World>(case_, method.settings.analytic, method.settings.ambient);
    }
    return *world;
  }
  // Of the levels.
  World& usual() { return of(levelMethods().front()); }
  // One background for all methods: its light does not depend on them.
  [[nodiscard]] const host::RasterResult& opaque() const { return opaque_; }

 private:
  // Closed forms of the phase functions, light of sky and ground; of methods that keep much, what
  // light that is.
  using Key = std::tuple<bool, bool, uint32_t, uint32_t, uint32_t>;

  static Key keyOf(const Method& method) {
    const Settings& settings = method.settings;
    Key key{settings.analytic, settings.ambient, 0, 0, 0};
    if (keepsMuch(settings)) {
      std::get<2>(key) = settings.lightBufferSize;
      std::get<3>(key) = settings.sliceCount;
      std::get<4>(key) = settings.scattering;
    }
    return key;
  }

  const Case& case_;
  std::map<Key, std::unique_ptr<World>> worlds_;
  host::RasterResult opaque_;
};

struct Shot {
  host::Image picture;
  FrameCounts counts;
};

// The first frame of a view that is there alone, so that the memory counted is its own, and what
// the second records: a frame of a scene that stays. `stays`: the view, too.
Shot shoot(Worlds& worlds, const Method& method, bool stays = false) {
  World& world = worlds.of(method);
  const WlkView view = world.addView(qualityOf(method));
  world.prepare();
  world.render(view, worlds.opaque());
  Shot shot{world.read(view), {}};
  world.render(view, worlds.opaque());
  shot.counts = world.counts(view);
  if (!stays) {
    world.removeView(view);
  }
  return shot;
}

// The finest level comes last and stays: its light inside volumes takes many seconds, and the timed
// views then share it. No memory is counted after it.
bool staysForTiming(const Method& method) {
  return method.settings.level == WLK_QUALITY_ULTRA && !method.settings.analytic &&
         method.settings.scattering == WLK_SCATTERING_ALL_ORDERS;
}

// Pictures that methods converge to, made when first asked for.
class Limits {
 public:
  Limits(Worlds& worlds, const StudyOptions& options, const Reference& committed)
      : worlds_(worlds), options_(options), committed_(committed) {}

  const Reference& of(const Settings& settings) {
    const bool usual = settings.scattering == WLK_SCATTERING_FORWARD && !settings.analytic;
    if (options_.quick || options_.levelsOnly) {
      return usual ? committed_ : none_;
    }
    Reference& limit = limits_[{settings.scattering, settings.analytic}];
    if (!limit.picture) {
      limit.picture = shoot(worlds_, {"converged", false, convergedSettings(settings)}).picture;
    }
    return limit;
  }

 private:
  Worlds& worlds_;
  const StudyOptions& options_;
  const Reference& committed_;
  const Reference none_;
  std::map<std::pair<uint32_t, bool>, Reference> limits_;
};

// Pictures and counts of all methods.
std::vector<Row> measureRows(const Case& one, const StudyOptions& options, Worlds& worlds,
                             const std::vector<Method>& methods, const Tell& tell) {
  const bool cloudy = hasVolumes(one);
  const References references = readReferences(options.referenceFolder, one);
  Limits limits(worlds, options, references.converged);
  std::vector<size_t> order(methods.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](size_t i) { return !staysForTiming(methods[i]); });
  std::vector<Shot> shots(methods.size());
  for (const size_t i : order) {
    tell("errors of " + methods[i].name);
    const Method& method = methods[i];
    shots[i] = shoot(worlds, method, staysForTiming(method));
  }
  std::vector<Row> rows;
  for (size_t i = 0; i < methods.size(); ++i) {
    const Method& method = methods[i];
    const Shot& shot = shots[i];
    const bool single = method.settings.scattering == WLK_SCATTERING_SINGLE;
    Row row{method, shot.counts, {}, errorsOf(shot.picture, references.all, one), nullptr, nullptr};
    if (single) {
      row.single = errorsOf(shot.picture, references.single, one);
    }
    if (cloudy) {
      row.converged = errorsOf(shot.picture, limits.of(method.settings), one);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<Method> methodsOf(const Case& one, const StudyOptions& options) {
  return options.levelsOnly ? levelMethods() : methodsFor(one, options.quick);
}

struct FrontStudy::Parts {
  Parts(const Case& one, const std::vector<Method>& methods, const StudyOptions& options,
        const Tell& tell)
      : worlds(one, methods), rows(measureRows(one, options, worlds, methods, tell)) {}

  Worlds worlds;
  std::vector<Row> rows;
  size_t anchor = 0;
  host::RasterResult opaque;  // of the timed views
  std::unique_ptr<Sampler> sampler;
};

FrontStudy::FrontStudy(const Case& one, const StudyOptions& options, const Tell& tell) {
  tell("scene");
  parts_ = std::make_unique<Parts>(one, methodsOf(one, options), options, tell);
  tell("warm-ups");
  const uint32_t usual = hasVolumes(one) ? TIMED_WIDTH_VOLUMES : TIMED_WIDTH;
  const uint32_t width = std::max(usual, one.timedWidth);
  const uint32_t scale = (width + one.width - 1) / one.width;
  parts_->opaque = parts_->worlds.usual().makeOpaque(scale);
  std::vector<Copies> frames;
  for (size_t i = 0; i < parts_->rows.size(); ++i) {
    parts_->rows[i].timedScale = scale;
    const Method& method = parts_->rows[i].method;
    parts_->anchor = method.name == ANCHOR ? i : parts_->anchor;
    World& world = parts_->worlds.of(method);
    Copies& copies = frames.emplace_back();
    for (size_t copy = 0; copy < copiesOf(one, method.settings); ++copy) {
      const WlkView view = world.addView(qualityOf(method), scale);
      copies.emplace_back([&world, &opaque = parts_->opaque, view] {
        world.render(view, opaque);
        return 1e-6 * static_cast<double>(world.counts(view).gpuTime_ns);
      });
    }
  }
  for (const Row& row : parts_->rows) {
    parts_->worlds.of(row.method).prepare();
  }
  parts_->sampler = std::make_unique<Sampler>(std::move(frames), parts_->anchor, WARM_UPS);
}

FrontStudy::~FrontStudy() = default;

void FrontStudy::takeBlock(bool onOneCore) {
  parts_->sampler->takeBlock(onOneCore);
}

std::vector<Row> FrontStudy::rows() const {
  std::vector<Row> rows = parts_->rows;
  const std::vector<Timing> timings =
      timingsOf(parts_->sampler->samples(), rows.size(), parts_->anchor);
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].timing = timings[i];
  }
  return rows;
}

Ordered FrontStudy::device() const {
  const WlkCapabilities device = parts_->worlds.usual().capabilities();
  return {{"name", std::string(device.deviceName)},
          {"driver", "Vulkan " + std::to_string(device.vulkanVersion >> 22 & 0x7fu) + "." +
                         std::to_string(device.vulkanVersion >> 12 & 0x3ffu) + "." +
                         std::to_string(device.vulkanVersion & 0xfffu)}};
}

size_t FrontStudy::cores() const {
  return parts_->sampler->driverCores();
}

bool isQuiet(const Row& row) {
  const Timing& timing = row.timing;
  return 2 * timing.quietRounds >= timing.rounds && areQuiet(timing.cores);
}

}  // namespace bench
