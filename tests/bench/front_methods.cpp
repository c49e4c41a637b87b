// SPDX-License-Identifier: MIT
#include "bench/front_methods.hpp"

#include <algorithm>
#include <array>

#include "common/api.hpp"

namespace bench {
namespace {

constexpr std::array<const char*, LEVEL_COUNT> LEVEL_NAMES = {"low", "medium", "high", "ultra"};

// Which runs measure a method: quick ones, quick ones of cases with `curves`, or full ones only.
// Quick runs share little time: what takes much of it (slabs one by one, ultra's without the light
// that others share) would leave the rest with few samples. And they leave out what differed more
// than others between runs on a loud machine (few slabs of single scattering, half-way slicing).
enum class Run { Quick, Curves, Full };

// Of forwardMethods.
constexpr std::array<Run, LEVEL_COUNT> FORWARD_RUNS = {Run::Curves, Run::Curves, Run::Quick,
                                                       Run::Full};

// One change to a level; 0 keeps the level's value.
struct Variation {
  const char* name;
  uint32_t level;
  uint32_t sliceCount;
  uint32_t batchSize;
  uint32_t lightBufferSize;
  uint32_t slicing;
  uint32_t scattering;
  Run run;
};

constexpr uint32_t HIGH = WLK_QUALITY_HIGH;
constexpr uint32_t ALIGNED = WLK_SLICING_LIGHT_ALIGNED;
constexpr uint32_t HALF = WLK_SLICING_HALF_ANGLE;
constexpr uint32_t SINGLE = WLK_SCATTERING_SINGLE;
constexpr uint32_t FORWARD = WLK_SCATTERING_FORWARD;
constexpr uint32_t INTEGER = WLK_SCATTERING_FORWARD_INTEGER;

constexpr std::array<Variation, 26> VARIATIONS = {{
    {"slices-16", HIGH, 16, 0, 0, ALIGNED, FORWARD, Run::Curves},
    {"slices-32", HIGH, 32, 0, 0, ALIGNED, FORWARD, Run::Full},
    {"slices-64", HIGH, 64, 0, 0, ALIGNED, FORWARD, Run::Curves},
    {"slices-256", HIGH, 256, 0, 0, ALIGNED, FORWARD, Run::Full},
    {"slices-512", HIGH, 512, 0, 0, ALIGNED, FORWARD, Run::Full},
    {"batch-1", HIGH, 0, 1, 0, ALIGNED, FORWARD, Run::Full},
    {"batch-16", HIGH, 0, 16, 0, ALIGNED, FORWARD, Run::Full},
    {"batch-all", HIGH, 0, 128, 0, ALIGNED, FORWARD, Run::Full},
    {"light-64", HIGH, 0, 0, 64, ALIGNED, FORWARD, Run::Curves},
    {"light-128", HIGH, 0, 0, 128, ALIGNED, FORWARD, Run::Full},
    {"light-512", HIGH, 0, 0, 512, ALIGNED, FORWARD, Run::Full},
    {"32-64", HIGH, 32, 0, 64, ALIGNED, FORWARD, Run::Full},
    {"64-64", HIGH, 64, 0, 64, ALIGNED, FORWARD, Run::Full},
    {"64-128", HIGH, 64, 0, 128, ALIGNED, FORWARD, Run::Full},
    {"256-128", HIGH, 256, 0, 128, ALIGNED, FORWARD, Run::Full},
    {"512-256", HIGH, 512, 0, 256, ALIGNED, FORWARD, Run::Full},
    {"256-512", HIGH, 256, 0, 512, ALIGNED, FORWARD, Run::Full},
    {"512-512", HIGH, 512, 64, 512, ALIGNED, FORWARD, Run::Full},
    {"half-angle", HIGH, 0, 64, 0, HALF, FORWARD, Run::Full},
    {"half-angle-512", HIGH, 512, 64, 0, HALF, FORWARD, Run::Full},
    {"integer", HIGH, 0, 0, 0, ALIGNED, INTEGER, Run::Curves},
    {"single", HIGH, 0, 0, 0, ALIGNED, SINGLE, Run::Quick},
    {"single-low", WLK_QUALITY_LOW, 0, 0, 0, ALIGNED, SINGLE, Run::Full},
    {"single-medium", WLK_QUALITY_MEDIUM, 0, 0, 0, ALIGNED, SINGLE, Run::Full},
    {"single-ultra", WLK_QUALITY_ULTRA, 0, 0, 0, ALIGNED, SINGLE, Run::Full},
    {"single-half-angle", HIGH, 0, 64, 0, HALF, SINGLE, Run::Full},
}};

bool wanted(Run run, bool quick, bool curves) {
  return !quick || run == Run::Quick || (run == Run::Curves && curves);
}

Method vary(const Variation& variation) {
  Method method{variation.name, false, levelSettings(variation.level)};
  Settings& settings = method.settings;
  const auto replace = [](uint32_t& value, uint32_t by) { value = by != 0 ? by : value; };
  replace(settings.sliceCount, variation.sliceCount);
  replace(settings.batchSize, variation.batchSize);
  replace(settings.lightBufferSize, variation.lightBufferSize);
  settings.batchSize = std::min(settings.batchSize, settings.sliceCount);
  settings.halfAngle = variation.slicing == HALF;
  settings.scattering = variation.scattering;
  settings.ambient = false;
  return method;
}

}  // namespace

const char* levelName(uint32_t level) {
  return LEVEL_NAMES.at(level);
}

const char* scatteringName(uint32_t scattering) {
  switch (scattering) {
    case WLK_SCATTERING_SINGLE:
      return "single";
    case WLK_SCATTERING_FORWARD_INTEGER:
      return "integer";
    case WLK_SCATTERING_ALL_ORDERS:
      return "all-orders";
    default:
      return "forward";
  }
}

Settings levelSettings(uint32_t level) {
  constexpr std::array<std::array<uint32_t, 2>, LEVEL_COUNT> LEVELS = {
      {{32, 96}, {64, 160}, {128, 256}, {256, 448}}};
  const auto& [slices, light] = LEVELS.at(level);
  return {level, slices,
          0,     light,
          false, WLK_SCATTERING_ALL_ORDERS,
          false, 0,
          true,  level != WLK_QUALITY_ULTRA};
}

WlkQuality explicitQuality(const Settings& settings) {
  auto quality = host::make<WlkQuality>();
  quality.level = settings.level;
  quality.sliceCount = settings.sliceCount;
  quality.batchSize = settings.batchSize;
  quality.lightBufferSize = settings.lightBufferSize;
  quality.slicing = settings.halfAngle ? HALF : ALIGNED;
  quality.scattering = settings.scattering;
  quality.volumeCells = settings.volumeCells;
  quality.volumeResolution =
      settings.halfResolution ? WLK_VOLUME_RESOLUTION_HALF : WLK_VOLUME_RESOLUTION_FULL;
  return quality;
}

WlkQuality qualityOf(const Method& method) {
  if (!method.isLevel) {
    return explicitQuality(method.settings);
  }
  auto quality = host::make<WlkQuality>();
  quality.level = method.settings.level;
  return quality;
}

Settings convergedSettings(const Settings& settings) {
  // Four times the slabs and 2.3 times the texels of the finest level: at second order its own
  // error is a tenth of that level's or less.
  Settings converged = settings;
  converged.sliceCount = 1024;
  converged.batchSize = 64;
  converged.lightBufferSize = 1024;
  converged.halfResolution = false;
  converged.halfAngle = false;  // both arrangements have one limit
  converged.volumeCells = 64;   // the finest level's: what is left of it, other solvers tell
  return converged;
}

std::vector<Method> levelMethods() {
  std::vector<Method> methods;
  for (uint32_t level = 0; level < LEVEL_COUNT; ++level) {
    methods.push_back({levelName(level), true, levelSettings(level)});
  }
  return methods;
}

std::vector<Method> otherResolution() {
  std::vector<Method> methods;
  for (const Method& level : levelMethods()) {
    Method method{(level.settings.halfResolution ? "full-" : "half-") + level.name, false,
                  level.settings};
    method.settings.halfResolution = !level.settings.halfResolution;
    methods.push_back(method);
  }
  return methods;
}

std::vector<Method> forwardMethods() {
  std::vector<Method> methods;
  for (uint32_t level = 0; level < LEVEL_COUNT; ++level) {
    Method method{std::string("forward-") + levelName(level), false, levelSettings(level)};
    method.settings.scattering = FORWARD;
    method.settings.ambient = false;
    methods.push_back(method);
  }
  return methods;
}

std::vector<Method> methodsFor(const Case& one, bool quick) {
  const bool cloudy = hasVolumes(one);
  std::vector<Method> methods = levelMethods();
  if (cloudy) {
    for (Method& forward : forwardMethods()) {
      if (wanted(FORWARD_RUNS.at(forward.settings.level), quick, one.curves)) {
        methods.push_back(std::move(forward));
      }
    }
    if (!quick) {
      const std::vector<Method> other = otherResolution();
      methods.insert(methods.end(), other.begin(), other.end());
    }
  }
  for (const Variation& variation : VARIATIONS) {
    // Of a sky alone only the orders of scattering make a difference. Its single scattering is
    // arithmetic, the rest reads tables: on a core that others work on it takes up to 8 % less of
    // the scene's yardstick than on a quiet one, so that quick runs would not repeat.
    const bool tells = cloudy || variation.name == std::string_view("single");
    if (tells && wanted(cloudy ? variation.run : Run::Full, quick, one.curves)) {
      methods.push_back(vary(variation));
    }
  }
  if (!one.analytic.empty() && (!cloudy || wanted(Run::Curves, quick, one.curves))) {
    Method method{"analytic", false, levelSettings(HIGH)};
    method.settings.analytic = true;
    methods.push_back(method);
  }
  return methods;
}

}  // namespace bench
