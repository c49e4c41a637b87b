/* SPDX-License-Identifier: MIT
 *
 * Welkin for C++: owners that destroy what they hold, initialised structures, errors with their
 * cause. Header only, C++11, no ABI of its own: everything is an inline call of the C API.
 *
 *   welkin::Context context(welkin::make<WlkContextInfo>());
 *   WlkSky sky = welkin::make<WlkSky>();
 *   welkin::check(wlkSetSky(context, &sky));
 *
 * Owners move and do not copy. A context must outlive what was made from it; declaring it first is
 * enough. Constructors and check() throw welkin::Error; each owner's create() returns the WlkResult
 * instead, and with WELKIN_NO_EXCEPTIONS defined only these remain.
 */
#ifndef WELKIN_WELKIN_HPP
#define WELKIN_WELKIN_HPP

#include <cstdint>
#ifndef WELKIN_NO_EXCEPTIONS
#include <stdexcept>
#include <string>
#endif

#include "welkin.h"

// Named here so that make() knows their sType whether or not welkin_vulkan.h was included.
struct WlkVulkanDeviceInfo;
struct WlkVulkanRequirements;
struct WlkVulkanImage;
struct WlkVulkanViewTargets;

namespace welkin {

/** sType of a structure, as StructType<WlkSky>::VALUE. */
template <class T>
struct StructType;

#define WELKIN_STRUCT_TYPE(type, sType)          \
  template <>                                    \
  struct StructType<type> {                      \
    static constexpr std::uint32_t VALUE{sType}; \
  }
WELKIN_STRUCT_TYPE(::WlkErrorInfo, WLK_STRUCT_ERROR_INFO);
WELKIN_STRUCT_TYPE(::WlkContextInfo, WLK_STRUCT_CONTEXT_INFO);
WELKIN_STRUCT_TYPE(::WlkHeadlessInfo, WLK_STRUCT_HEADLESS_INFO);
WELKIN_STRUCT_TYPE(::WlkCapabilities, WLK_STRUCT_CAPABILITIES);
WELKIN_STRUCT_TYPE(::WlkLogMessage, WLK_STRUCT_LOG_MESSAGE);
WELKIN_STRUCT_TYPE(::WlkPlanet, WLK_STRUCT_PLANET);
WELKIN_STRUCT_TYPE(::WlkSky, WLK_STRUCT_SKY);
WELKIN_STRUCT_TYPE(::WlkLight, WLK_STRUCT_LIGHT);
WELKIN_STRUCT_TYPE(::WlkFog, WLK_STRUCT_FOG);
WELKIN_STRUCT_TYPE(::WlkAbsorber, WLK_STRUCT_ABSORBER);
WELKIN_STRUCT_TYPE(::WlkAmbient, WLK_STRUCT_AMBIENT);
WELKIN_STRUCT_TYPE(::WlkMediumInfo, WLK_STRUCT_MEDIUM_INFO);
WELKIN_STRUCT_TYPE(::WlkMediumOptics, WLK_STRUCT_MEDIUM_OPTICS);
WELKIN_STRUCT_TYPE(::WlkVolumeInfo, WLK_STRUCT_VOLUME_INFO);
WELKIN_STRUCT_TYPE(::WlkSurfaceInfo, WLK_STRUCT_SURFACE_INFO);
WELKIN_STRUCT_TYPE(::WlkSurfaceDetail, WLK_STRUCT_SURFACE_DETAIL);
WELKIN_STRUCT_TYPE(::WlkVolumeUpload, WLK_STRUCT_VOLUME_UPLOAD);
WELKIN_STRUCT_TYPE(::WlkVolumeBricks, WLK_STRUCT_VOLUME_BRICKS);
WELKIN_STRUCT_TYPE(::WlkVolumeState, WLK_STRUCT_VOLUME_STATE);
WELKIN_STRUCT_TYPE(::WlkViewInfo, WLK_STRUCT_VIEW_INFO);
WELKIN_STRUCT_TYPE(::WlkCamera, WLK_STRUCT_CAMERA);
WELKIN_STRUCT_TYPE(::WlkQuality, WLK_STRUCT_QUALITY);
WELKIN_STRUCT_TYPE(::WlkQualityState, WLK_STRUCT_QUALITY_STATE);
WELKIN_STRUCT_TYPE(::WlkFrameInfo, WLK_STRUCT_FRAME_INFO);
WELKIN_STRUCT_TYPE(::WlkLightShadow, WLK_STRUCT_LIGHT_SHADOW);
WELKIN_STRUCT_TYPE(::WlkHeadlessInputs, WLK_STRUCT_HEADLESS_INPUTS);
WELKIN_STRUCT_TYPE(::WlkImageData, WLK_STRUCT_IMAGE_DATA);
WELKIN_STRUCT_TYPE(::WlkFrameStats, WLK_STRUCT_FRAME_STATS);
WELKIN_STRUCT_TYPE(::WlkErrorEstimate, WLK_STRUCT_ERROR_ESTIMATE);
WELKIN_STRUCT_TYPE(::WlkRayBatch, WLK_STRUCT_RAY_BATCH);
WELKIN_STRUCT_TYPE(::WlkPhaseQuery, WLK_STRUCT_PHASE_QUERY);
WELKIN_STRUCT_TYPE(::WlkSkyMapQuery, WLK_STRUCT_SKY_MAP_QUERY);
WELKIN_STRUCT_TYPE(::WlkVulkanDeviceInfo, WLK_STRUCT_VULKAN_DEVICE_INFO);
WELKIN_STRUCT_TYPE(::WlkVulkanRequirements, WLK_STRUCT_VULKAN_REQUIREMENTS);
WELKIN_STRUCT_TYPE(::WlkVulkanImage, WLK_STRUCT_VULKAN_IMAGE);
WELKIN_STRUCT_TYPE(::WlkVulkanViewTargets, WLK_STRUCT_VULKAN_VIEW_TARGETS);
WELKIN_STRUCT_TYPE(::WlkCloudShadowInfo, WLK_STRUCT_CLOUD_SHADOW_INFO);
WELKIN_STRUCT_TYPE(::WlkCloudShadowState, WLK_STRUCT_CLOUD_SHADOW_STATE);
WELKIN_STRUCT_TYPE(::WlkAerialPerspective, WLK_STRUCT_AERIAL_PERSPECTIVE);
#undef WELKIN_STRUCT_TYPE

/** A structure with sType, structSize, next and the defaults of the C header. */
template <class T>
T make() {
  T structure = T();
  // It cannot fail: type and size match. Of an older library a newer structure would stay zero.
  (void)wlkInitStruct(StructType<T>::VALUE, static_cast<std::uint32_t>(sizeof(T)), &structure);
  return structure;
}

/** A part of an atmosphere, WLK_ATMOSPHERE_*: makePreset<WlkSky>(WLK_ATMOSPHERE_MARS). With another
 *  number all stays zero. */
template <class T>
T makePreset(std::uint32_t preset) {
  T structure = T();
  (void)wlkInitPresetStruct(preset, StructType<T>::VALUE, static_cast<std::uint32_t>(sizeof(T)),
                            &structure);
  return structure;
}

#ifndef WELKIN_NO_EXCEPTIONS
/** A failed call: what() is "WLK_ERROR_...: field: message". */
class Error : public std::runtime_error {
 public:
  Error(WlkResult result, const WlkErrorInfo& info)
      : std::runtime_error(text(result, info)), result_(result), info_(info) {}
  WlkResult result() const noexcept { return result_; }
  /** wlkGetLastError at the time of the failure. */
  const WlkErrorInfo& info() const noexcept { return info_; }

 private:
  static std::string text(WlkResult result, const WlkErrorInfo& info) {
    std::string line = wlkResultName(result);
    if (info.field[0] != '\0') {
      line += std::string(": ") + info.field;
    }
    if (info.message[0] != '\0') {
      line += std::string(": ") + info.message;
    }
    return line;
  }

  WlkResult result_;
  WlkErrorInfo info_;
};

/** Throws Error for a negative result; passes states such as WLK_NOT_READY through. */
inline WlkResult check(WlkResult result) {
  if (result < 0) {
    WlkErrorInfo info = make<WlkErrorInfo>();
    (void)wlkGetLastError(&info);
    throw Error(result, info);
  }
  return result;
}
#endif

/** Owner of a context. */
class Context {
 public:
  Context() noexcept = default;
#ifndef WELKIN_NO_EXCEPTIONS
  explicit Context(const WlkContextInfo& info) {
    check(wlkCreateContext(WLK_API_VERSION, &info, &handle_));
  }
#endif
  Context(Context&& other) noexcept : handle_(other.release()) {}
  Context& operator=(Context&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = other.release();
    }
    return *this;
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    reset();
  }

  /** Makes a context in place of the one held; on failure the old one stays. */
  WlkResult create(const WlkContextInfo& info) {
    WlkContext made = nullptr;
    const WlkResult result = wlkCreateContext(WLK_API_VERSION, &info, &made);
    if (result >= 0) {
      reset();
      handle_ = made;
    }
    return result;
  }
  WlkContext get() const noexcept {
    return handle_;
  }
  operator WlkContext() const noexcept {
    return handle_;
  }
  /** Gives the handle up without destroying it. */
  WlkContext release() noexcept {
    WlkContext handle = handle_;
    handle_ = nullptr;
    return handle;
  }
  void reset() noexcept {
    if (handle_ != nullptr) {
      wlkDestroyContext(release());
    }
  }

 private:
  WlkContext handle_ = nullptr;
};

namespace detail {
struct MediumCalls {
  typedef WlkMedium Handle;
  typedef WlkMediumInfo Info;
  static WlkResult create(WlkContext context, const Info* info, Handle* handle) {
    return wlkCreateMedium(context, info, handle);
  }
  static void destroy(WlkContext context, Handle handle) {
    (void)wlkDestroyMedium(context, handle);
  }
};
struct VolumeCalls {
  typedef WlkVolume Handle;
  typedef WlkVolumeInfo Info;
  static WlkResult create(WlkContext context, const Info* info, Handle* handle) {
    return wlkCreateVolume(context, info, handle);
  }
  static void destroy(WlkContext context, Handle handle) {
    (void)wlkDestroyVolume(context, handle);
  }
};
struct SurfaceCalls {
  typedef WlkSurface Handle;
  typedef WlkSurfaceInfo Info;
  static WlkResult create(WlkContext context, const Info* info, Handle* handle) {
    return wlkCreateSurface(context, info, handle);
  }
  static void destroy(WlkContext context, Handle handle) {
    (void)wlkDestroySurface(context, handle);
  }
};
struct ViewCalls {
  typedef WlkView Handle;
  typedef WlkViewInfo Info;
  static WlkResult create(WlkContext context, const Info* info, Handle* handle) {
    return wlkCreateView(context, info, handle);
  }
  static void destroy(WlkContext context, Handle handle) { (void)wlkDestroyView(context, handle); }
};
}  // namespace detail

/** Owner of a medium, volume, surface or view. Converts to the C handle. */
template <class Calls>
class Owner {
 public:
  typedef typename Calls::Handle Handle;
  typedef typename Calls::Info Info;

  Owner() noexcept = default;
#ifndef WELKIN_NO_EXCEPTIONS
  Owner(WlkContext context, const Info& info) : context_(context) {
    check(Calls::create(context, &info, &handle_));
  }
#endif
  Owner(Owner&& other) noexcept : context_(other.context_), handle_(other.release()) {}
  Owner& operator=(Owner&& other) noexcept {
    if (this != &other) {
      reset();
      context_ = other.context_;
      handle_ = other.release();
    }
    return *this;
  }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() {
    reset();
  }

  /** Makes an object in place of the one held; on failure the old one stays. */
  WlkResult create(WlkContext context, const Info& info) {
    Handle made = Handle();
    const WlkResult result = Calls::create(context, &info, &made);
    if (result >= 0) {
      reset();
      context_ = context;
      handle_ = made;
    }
    return result;
  }
  Handle get() const noexcept {
    return handle_;
  }
  operator Handle() const noexcept {
    return handle_;
  }
  /** Gives the handle up without destroying it. */
  Handle release() noexcept {
    const Handle handle = handle_;
    handle_ = Handle();
    return handle;
  }
  void reset() noexcept {
    if (handle_.id != 0) {
      Calls::destroy(context_, release());
    }
  }

 private:
  WlkContext context_ = nullptr;
  Handle handle_ = Handle();
};

typedef Owner<detail::MediumCalls> Medium;
typedef Owner<detail::VolumeCalls> Volume;
typedef Owner<detail::SurfaceCalls> Surface;
typedef Owner<detail::ViewCalls> View;

}  // namespace welkin

#endif
