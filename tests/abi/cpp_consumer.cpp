// SPDX-License-Identifier: MIT
// A C++11 program over welkin.hpp: sType of every structure, ownership, errors. Compiled a second
// time with WELKIN_NO_EXCEPTIONS and -fno-exceptions.
#include <welkin/welkin_vulkan.h>

#include <cstdint>
#include <cstdio>
#include <set>
#include <type_traits>
#include <utility>
#include <welkin/welkin.hpp>

static int failures = 0;
static std::set<std::uint32_t> seenTypes;
#define REQUIRE(condition) require((condition), #condition, __LINE__)

static void require(bool condition, const char* text, int line) {
  if (!condition) {
    std::fprintf(stderr, "line %d: not true: %s\n", line, text);
    ++failures;
  }
}

template <class T>
static void makeSetsTheHead() {
  const T structure = welkin::make<T>();
  REQUIRE(structure.sType == welkin::StructType<T>::VALUE);
  REQUIRE(structure.structSize == sizeof(T) && structure.next == nullptr);
  REQUIRE(seenTypes.insert(structure.sType).second);  // no two structures share an sType
}

template <class First, class Second, class... Rest>
static void makeSetsTheHead() {
  makeSetsTheHead<First>();
  makeSetsTheHead<Second, Rest...>();
}

template <class T>
static void movesOnly() {
  static_assert(!std::is_copy_constructible<T>::value && !std::is_copy_assignable<T>::value, "");
  static_assert(std::is_nothrow_move_constructible<T>::value, "");
  static_assert(std::is_nothrow_move_assignable<T>::value, "");
}

static void ownersDestroyOnce() {
  welkin::Context context;
  REQUIRE(context.create(welkin::make<WlkContextInfo>()) == WLK_SUCCESS);
  welkin::Medium medium;
  REQUIRE(medium.create(context, welkin::make<WlkMediumInfo>()) == WLK_SUCCESS);
  const WlkMedium handle = medium;

  welkin::Medium moved(std::move(medium));
  REQUIRE(medium.get().id == 0 && moved.get().id == handle.id);
  moved = welkin::Medium();
  REQUIRE(wlkDestroyMedium(context, handle) == WLK_ERROR_INVALID_HANDLE);

  // On failure the object that was held stays.
  REQUIRE(moved.create(context, welkin::make<WlkMediumInfo>()) == WLK_SUCCESS);
  const WlkMedium kept = moved;
  WlkMediumInfo wrong = welkin::make<WlkMediumInfo>();
  wrong.diameter_um = -1.0f;
  REQUIRE(moved.create(context, wrong) == WLK_ERROR_INVALID_ARGUMENT);
  REQUIRE(moved.get().id == kept.id);

  const WlkMedium given = moved.release();
  moved.reset();
  REQUIRE(wlkDestroyMedium(context, given) == WLK_SUCCESS);

  welkin::Context other(std::move(context));
  REQUIRE(context.get() == nullptr && other.get() != nullptr);
}

#ifndef WELKIN_NO_EXCEPTIONS
static void errorsNameTheField() {
  welkin::Context context(welkin::make<WlkContextInfo>());
  WlkMediumInfo info = welkin::make<WlkMediumInfo>();
  info.diameter_um = -1.0f;
  bool thrown = false;
  try {
    const welkin::Medium medium(context, info);
  } catch (const welkin::Error& error) {
    thrown = true;
    REQUIRE(error.result() == WLK_ERROR_INVALID_ARGUMENT);
    REQUIRE(std::string(error.info().field).find("diameter_um") != std::string::npos);
    REQUIRE(std::string(error.what()).find("WLK_ERROR_INVALID_ARGUMENT") == 0);
  }
  REQUIRE(thrown);
  REQUIRE(welkin::check(WLK_NOT_READY) == WLK_NOT_READY);
}
#endif

int main() {
  makeSetsTheHead<WlkErrorInfo, WlkContextInfo, WlkHeadlessInfo, WlkCapabilities, WlkPlanet, WlkSky,
                  WlkLight, WlkFog, WlkAbsorber, WlkAmbient, WlkMediumInfo, WlkMediumOptics,
                  WlkVolumeInfo, WlkVolumeUpload, WlkVolumeBricks, WlkVolumeState, WlkViewInfo,
                  WlkCamera, WlkQuality, WlkQualityState, WlkFrameInfo, WlkHeadlessInputs,
                  WlkImageData, WlkFrameStats, WlkRayBatch, WlkPhaseQuery, WlkSkyMapQuery,
                  WlkLogMessage, WlkLightShadow, WlkErrorEstimate, WlkSurfaceInfo, WlkSurfaceDetail,
                  WlkAerialPerspective, WlkCloudShadowInfo, WlkCloudShadowState,
                  WlkVulkanDeviceInfo, WlkVulkanRequirements, WlkVulkanImage,
                  WlkVulkanViewTargets>();
  movesOnly<welkin::Context>();
  movesOnly<welkin::Medium>();
  movesOnly<welkin::Volume>();
  movesOnly<welkin::View>();
  ownersDestroyOnce();
#ifndef WELKIN_NO_EXCEPTIONS
  errorsNameTheField();
#endif
  return failures == 0 ? 0 : 1;
}
