// SPDX-License-Identifier: MIT
#include "bench/volume_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numeric>

#include "bench/front_timing.hpp"
#include "bench/volume_bare.hpp"
#include "bench/volume_march.hpp"
#include "bench/volume_slicer.hpp"
#include "bench/volume_welkin.hpp"

namespace bench {
namespace {

constexpr size_t WARM_UPS = 2;
constexpr uint32_t CPU_THREADS = 2;
constexpr double LIGHT_DEG = 45;  // of the scaling studies
constexpr uint32_t LIGHT_SIZE = 256;
constexpr uint32_t SLICES = 128;
constexpr uint32_t SMALL = 256;  // pixels, where the size is not what is studied

struct Setting {
  uint32_t slices;
  uint32_t lightSize;
};
// As the quality levels pair them, and one before.
constexpr std::array<Setting, 5> SLICED{{{16, 96}, {32, 96}, {64, 160}, {128, 256}, {256, 448}}};
constexpr std::array<Setting, 3> FRESH{{{32, 96}, {64, 160}, {128, 256}}};
constexpr std::array<Setting, 2> BARE{{{128, 256}, {256, 448}}};
constexpr std::array<Setting, 3> CPU{{{64, 160}, {128, 256}, {256, 448}}};

// One way to draw and what is known of it.
struct Method {
  VolumeRow row{};
  RenderFrame frame;
  std::function<std::vector<float>()> picture;  // after a frame; empty: no picture
  std::function<void()> finish;                 // fills in counts
};

double medianOrNone(const std::vector<double>& times_ms) {
  return times_ms.empty() ? 0.0 : medianOf(times_ms);
}

class CaseStudy {
 public:
  CaseStudy(Gpu& gpu, const VolumeCase& one, const VolumeOptions& options)
      : gpu_(gpu), options_(options), one_(one), cloud_(makeCloud(one.occupied)) {
    toLight_ = cloudLight(one.light_deg);
    target_ = gpu.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, {options.size, options.size, 1},
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    density_ = uploadCloud(gpu, cloud_);
    truth_ = cloudTruth(cloud_, toLight_, options.size, options.truth);
    for (const Setting& setting : SLICED) {
      addWelkin(setting, "welkin", {});
    }
    for (const Setting& setting : SLICED) {
      WelkinVolumeOptions half;
      half.half = true;
      addWelkin(setting, "welkin, half", half);
    }
    for (const Setting& setting : FRESH) {
      WelkinVolumeOptions fresh;
      fresh.fresh = true;
      addWelkin(setting, "welkin, light computed", fresh);
    }
    for (const Setting& setting : SLICED) {
      addSlicer(setting);
    }
    for (const Setting& setting : BARE) {
      addBare(setting);
    }
    for (const Setting& setting : CPU) {
      addCpu(setting);
    }
  }

  VolumeStudy run() {
    std::vector<Copies> copies;
    for (const Method& method : methods_) {
      copies.push_back({method.frame});
    }
    const std::vector<Timing> timings = interleave(copies, 0, WARM_UPS, options_.rounds);
    VolumeStudy study{one_, cloud_.occupied, cloud_.meanDepth, {}};
    for (size_t i = 0; i < methods_.size(); ++i) {
      Method& method = methods_[i];
      method.row.time_ms = timings[i].wall;
      method.row.deviation_ms = timings[i].wallDeviation;
      method.row.cpu_ms = timings[i].cpu;
      method.row.error = -1;
      if (method.picture) {
        method.frame();
        const std::vector<float> picture = method.picture();
        method.row.error = cloudError(truth_, picture, options_.size);
        method.row.bias = cloudBias(truth_, picture, options_.size);
      }
      method.finish();
      study.rows.push_back(method.row);
    }
    return study;
  }

 private:
  Method& add(const char* name, const Setting& setting) {
    methods_.emplace_back();
    Method& method = methods_.back();
    method.row.method = name;
    method.row.slices = setting.slices;
    method.row.lightSize = setting.lightSize;
    method.row.samples = eyeSamples(toLight_, options_.size, setting.slices);
    method.finish = [] {};
    return method;
  }

  void addWelkin(const Setting& setting, const char* name, WelkinVolumeOptions how) {
    how.slices = setting.slices;
    how.lightSize = setting.lightSize;
    welkins_.push_back(std::make_unique<WelkinVolume>(gpu_, target_, &cloud_, toLight_, how));
    WelkinVolume* welkin = welkins_.back().get();
    auto times = std::make_shared<std::array<std::vector<double>, 2>>();
    Method& method = add(name, setting);
    method.frame = [this, welkin, times] {
      const double spent = gpu_.run([&](VkCommandBuffer c) { welkin->record(c); });
      for (const auto& [pass, time] : welkin->counts().passes_ms) {
        if (time > 0 && (pass == "eye slices" || pass == "light slices")) {
          (*times)[pass == "eye slices" ? 0 : 1].push_back(time);
        }
      }
      return spent;
    };
    method.picture = [this] { return gpu_.download(target_); };
    const size_t index = methods_.size() - 1;
    method.finish = [this, index, welkin, times] {
      VolumeRow& row = methods_[index].row;
      const GpuCounts counts = welkin->counts();
      // The device's clock may give a frame nothing, and kept light takes no time.
      row.eye_ms = medianOrNone((*times)[0]);
      row.light_ms = medianOrNone((*times)[1]);
      row.invocations = counts.invocations;
      row.commands = counts.dispatches;
    };
  }

  void addSlicer(const Setting& setting) {
    slicers_.push_back(std::make_unique<Slicer>(gpu_, density_, target_, toLight_, setting.slices,
                                                setting.lightSize));
    Slicer* slicer = slicers_.back().get();
    Method& method = add("slicer", setting);
    method.row.samples = 0;  // its slabs lie otherwise
    method.frame = [this, slicer] {
      return gpu_.run([&](VkCommandBuffer c) { slicer->record(c); });
    };
    method.picture = [this] { return gpu_.download(target_); };
    const size_t index = methods_.size() - 1;
    method.finish = [this, index, slicer] { methods_[index].row.commands = slicer->draws(); };
  }

  void addBare(const Setting& setting) {
    bares_.push_back(std::make_unique<BareLoop>(gpu_, density_, target_, toLight_, setting.slices,
                                                setting.lightSize));
    BareLoop* bare = bares_.back().get();
    auto times = std::make_shared<std::vector<double>>();
    Method& method = add("bare", setting);
    method.frame = [this, bare, times] {
      times->push_back(gpu_.run([&](VkCommandBuffer c) { bare->record(c); }));
      return times->back();
    };
    const size_t index = methods_.size() - 1;
    method.finish = [this, index, times] {
      methods_[index].row.eye_ms = medianOf(*times);
      methods_[index].row.commands = 1;
    };
  }

  void addCpu(const Setting& setting) {
    if (!marchRuns()) {
      return;
    }
    marches_.push_back(std::make_unique<CloudMarch>(cloud_, toLight_, options_.size, setting.slices,
                                                    setting.lightSize, CPU_THREADS));
    CloudMarch* march = marches_.back().get();
    Method& method = add("cpu", setting);
    method.frame = [march] {
      march->render();
      return 0.0;
    };
    method.picture = [march] { return march->picture(); };
  }

  Gpu& gpu_;
  VolumeOptions options_;
  VolumeCase one_;
  Cloud cloud_;
  Vec3 toLight_;
  GpuImage target_;
  GpuImage density_;
  CloudTruth truth_;
  std::vector<std::unique_ptr<WelkinVolume>> welkins_;
  std::vector<std::unique_ptr<Slicer>> slicers_;
  std::vector<std::unique_ptr<BareLoop>> bares_;
  std::vector<std::unique_ptr<CloudMarch>> marches_;
  std::vector<Method> methods_;
};

GpuImage makeTarget(Gpu& gpu, uint32_t size) {
  return gpu.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, {size, size, 1},
                       VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

// A point of a scaling study.
struct Point {
  double x;
  uint32_t size;
  uint32_t slices;
  double occupied;
  uint32_t deep = 1;  // see WelkinVolumeOptions
};

constexpr double BRICKS = 512;  // of a cloud

// Slabs of the same thickness across a box that is as many clouds deep.
uint32_t slabsFor(uint32_t slices, uint32_t deep) {
  const Vec3 l = cloudLight(LIGHT_DEG);
  const double side = std::abs(l.x) + std::abs(l.y);
  const double along = std::abs(l.z);
  return static_cast<uint32_t>(std::lround(slices * (side + along * deep) / (side + along)));
}

Scaling scale(const char* what, const std::vector<Point>& points, uint32_t rounds) {
  Gpu gpu;
  Scaling scaling{what, {}, {}, {}, {}};
  std::vector<std::unique_ptr<WelkinVolume>> frames;
  std::vector<Copies> copies;
  for (const Point& point : points) {
    const Cloud cloud = makeCloud(point.occupied);
    WelkinVolumeOptions options;
    options.slices = slabsFor(point.slices, point.deep);
    options.lightSize = LIGHT_SIZE;
    options.deep = point.deep;
    frames.push_back(std::make_unique<WelkinVolume>(gpu, makeTarget(gpu, point.size), &cloud,
                                                    cloudLight(LIGHT_DEG), options));
    WelkinVolume* frame = frames.back().get();
    copies.push_back(
        {[&gpu, frame] { return gpu.run([&](VkCommandBuffer c) { frame->record(c); }); }});
    scaling.x.push_back(point.x < 0 ? cloud.occupied * BRICKS : point.x);
  }
  const std::vector<Timing> timings = interleave(copies, 0, WARM_UPS, rounds);
  for (size_t i = 0; i < points.size(); ++i) {
    scaling.time_ms.push_back(timings[i].wall);
    scaling.cpu_ms.push_back(timings[i].cpu);
    scaling.invocations.push_back(static_cast<double>(frames[i]->counts().invocations));
  }
  return scaling;
}

// CPU time of every thread of this process so far, by its number.
std::map<std::string, double> threadTimes_ms() {
  std::map<std::string, double> times;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(thread.path() / "schedstat");
    double running_ns = 0;
    if (file >> running_ns) {
      times[thread.path().filename()] = 1e-6 * running_ns;
    }
  }
  return times;
}

Ordered commandsOf(const WelkinVolume& frame, size_t view) {
  Ordered result = Ordered::object();
  for (const auto& [name, count] : frame.commands(view)) {
    result[name] = result.contains(name) ? result[name].get<uint32_t>() + count : count;
  }
  return result;
}

}  // namespace

std::vector<VolumeStudy> studyVolumes(const VolumeOptions& options, Ordered& device) {
  std::vector<VolumeStudy> studies;
  for (const VolumeCase& one : volumeCases()) {
    if (!options.only.empty() && one.name != options.only) {
      continue;
    }
    Gpu gpu(options.validation);
    device = {{"name", gpu.properties().deviceName}, {"driver", gpu.driver()}};
    CaseStudy study(gpu, one, options);
    studies.push_back(study.run());
    std::fprintf(stderr, "%s measured\n", one.name.c_str());
    for (const std::string& message : gpu.messages()) {
      std::fprintf(stderr, "%s\n", message.c_str());
    }
  }
  return studies;
}

std::vector<Scaling> measureScaling(const VolumeOptions& options) {
  std::vector<Point> pixels;
  for (const uint32_t size : {192u, 256u, 384u, 512u}) {
    pixels.push_back({1.0 * size * size, size, SLICES, 1});
  }
  std::vector<Point> slices;
  for (const uint32_t count : {64u, 128u, 192u, 256u}) {  // whole batches
    slices.push_back({1.0 * count, SMALL, count, 1});
  }
  std::vector<Point> bricks;
  for (const double occupied : {0.05, 0.2, 0.5, 1.0}) {
    bricks.push_back({-1, SMALL, SLICES, occupied});
  }
  // The same cloud in ever larger boxes: empty bricks behind it, slabs as thick.
  std::vector<Point> empty;
  for (const uint32_t deep : {1u, 2u, 4u, 8u}) {
    empty.push_back({(deep - 0.2) * BRICKS, SMALL, SLICES, 0.2, deep});
  }
  return {scale("pixels", pixels, options.rounds), scale("slices", slices, options.rounds),
          scale("occupied bricks", bricks, options.rounds),
          scale("empty bricks", empty, options.rounds)};
}

Ordered measureSkips(const VolumeOptions& options) {
  Gpu gpu(options.validation);
  const Vec3 toLight = cloudLight(LIGHT_DEG);
  const Cloud cloud = makeCloud(1);
  Ordered result = Ordered::object();
  struct Kind {
    const char* name;
    const Cloud* cloud;
    bool empty;
    uint32_t views;
  };
  for (const Kind& kind :
       {Kind{"noVolume", nullptr, false, 1}, Kind{"emptyVolume", nullptr, true, 1},
        Kind{"cloud", &cloud, false, 1}, Kind{"cloudAndEmptyVolume", &cloud, true, 1},
        Kind{"twoViews", &cloud, false, 2}}) {
    WelkinVolumeOptions wanted;
    wanted.slices = SLICES;
    wanted.lightSize = LIGHT_SIZE;
    wanted.emptyVolume = kind.empty;
    wanted.views = kind.views;
    WelkinVolume frame(gpu, makeTarget(gpu, 64), kind.cloud, toLight, wanted);
    for (int i = 0; i < 2; ++i) {
      gpu.run([&](VkCommandBuffer c) { frame.record(c); });
    }
    Ordered& entry = result[kind.name];
    for (uint32_t view = 0; view < kind.views; ++view) {
      entry.push_back(
          {{"dispatches", frame.counts(view).dispatches}, {"commands", commandsOf(frame, view)}});
    }
  }
  return result;
}

Ordered measureHalfSky(const VolumeOptions& options) {
  Gpu gpu;
  const Cloud cloud = makeCloud(1);
  WelkinVolumeOptions wanted;
  wanted.underSky = true;
  WelkinVolume frame(gpu, makeTarget(gpu, options.size), &cloud, cloudLight(LIGHT_DEG), wanted);
  const RenderFrame render = [&] { return gpu.run([&](VkCommandBuffer c) { frame.record(c); }); };
  for (size_t i = 0; i < WARM_UPS; ++i) {
    render();
  }
  const auto before = threadTimes_ms();
  const Timing timing = interleave({{render}}, 0, 1, options.rounds).front();
  std::vector<double> spent;
  for (const auto& [thread, time] : threadTimes_ms()) {
    const auto old = before.find(thread);
    spent.push_back(time - (old == before.end() ? 0.0 : old->second));
  }
  // The two that work most work at once, all else by itself.
  std::sort(spent.rbegin(), spent.rend());
  const double sum = std::accumulate(spent.begin(), spent.end(), 0.0);
  const double shared = spent.size() > 1 ? spent[1] : 0.0;
  return {{"time_ms", timing.wall},
          {"timeMad_ms", timing.wallDeviation},
          {"cpu_ms", timing.cpu},
          {"cpuOverLongest", sum / (sum - shared)}};
}

}  // namespace bench
