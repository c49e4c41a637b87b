// SPDX-License-Identifier: MIT
// What the benchmark compares: the quality levels, and one setting varied at a time.
#pragma once

#include <welkin/welkin.h>

#include <string>
#include <vector>

#include "bench/front_cases.hpp"

namespace bench {

/// The method whose time is in every round.
constexpr const char* ANCHOR = "high";
constexpr uint32_t LEVEL_COUNT = 4;

/// What a level or an override comes to.
struct Settings {
  uint32_t level = WLK_QUALITY_HIGH;
  uint32_t sliceCount = 0;
  uint32_t batchSize = 0;  // 0: the light of all slabs is kept
  uint32_t lightBufferSize = 0;
  bool halfAngle = false;
  uint32_t scattering = WLK_SCATTERING_FORWARD;
  bool analytic = false;
  uint32_t volumeCells = 0;  // 0: the level's
  /// The scene's light of sky and ground on volumes, on its grid; without it slabs and texels alone
  /// are left.
  bool ambient = true;
  /// Rays in every second pixel (WLK_VOLUME_RESOLUTION_HALF).
  bool halfResolution = false;
};

struct Method {
  std::string name;
  /// One of the four levels as they are.
  bool isLevel = false;
  Settings settings;
};

const char* levelName(uint32_t level);
const char* scatteringName(uint32_t scattering);

/// What the library makes of a bare level; a test holds this copy against its pictures.
Settings levelSettings(uint32_t level);

/// Every setting spelled out.
WlkQuality explicitQuality(const Settings& settings);

/// The level alone for levels, else explicitQuality.
WlkQuality qualityOf(const Method& method);

/// What the method converges to as slabs and texels become many.
Settings convergedSettings(const Settings& settings);

/// The four levels, and what else differs in a scene: nothing about slabs without volumes. `quick`
/// leaves out what is costly, what repeats badly on machines that do other work, and what fills the
/// curves except where the case asks for it.
std::vector<Method> methodsFor(const Case& one, bool quick);

/// The four levels.
std::vector<Method> levelMethods();

/// The four levels with volumes at the other resolution than their own: half for full and back.
std::vector<Method> otherResolution();

/// Slabs and texels of the four levels with forward scattering.
std::vector<Method> forwardMethods();

}  // namespace bench
