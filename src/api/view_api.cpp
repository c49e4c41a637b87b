// SPDX-License-Identifier: MIT
// Views: size and targets, camera, quality, statistics.
#include <cmath>

#include "api/context.hpp"

namespace {

using namespace welkin;

// WLK_LAYER_ALL less some layers is told by its highest bit, which is no layer: what this library
// does not know of it is not asked for.
uint64_t knownLayers(uint64_t layers) {
  constexpr uint64_t KNOWN = WLK_LAYER_SKY | WLK_LAYER_FOG | WLK_LAYER_VOLUMES |
                             WLK_LAYER_SUN_DISK | WLK_LAYER_GROUND | WLK_LAYER_SURFACES;
  constexpr uint64_t OF_ALL = 1u << 30;
  const uint64_t allowed = (layers & OF_ALL) != 0 ? uint64_t{WLK_LAYER_ALL} : KNOWN;
  if ((layers & ~allowed) != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VIEW_INFO, "layers",
         "WlkViewInfo::layers has unknown bits");
  }
  return layers & KNOWN;
}

WlkViewInfo checkedView(const WlkContext_T& c, const WlkViewInfo* info) {
  WlkViewInfo v = copyStruct(info, WLK_STRUCT_VIEW_INFO);
  checkNoChain(info);
  checkRange(v.sType, "width", v.width, 1, 16384);
  checkRange(v.sType, "height", v.height, 1, 16384);
  checkRange(v.sType, "composite", v.composite, WLK_COMPOSITE_COMPUTE, WLK_COMPOSITE_SEPARATE);
  if (v.targetFormat < WLK_TARGET_RGBA16_FLOAT || v.targetFormat > WLK_TARGET_B10G11R11_FLOAT) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, v.sType, "targetFormat", "WlkViewInfo::targetFormat is %u",
         v.targetFormat);
  }
  checkRange(v.sType, "colorSpace", v.colorSpace, WLK_COLOR_WAVELENGTHS, WLK_COLOR_LINEAR_SRGB);
  v.layers = knownLayers(v.layers);
  if (v.composite == WLK_COMPOSITE_BLEND) {
    if (c.headless) {
      fail(WLK_ERROR_WRONG_STATE, v.sType, "composite",
           "headless contexts take WLK_COMPOSITE_COMPUTE and WLK_COMPOSITE_SEPARATE");
    }
    if (!c.device->info().blend) {
      fail(WLK_ERROR_MISSING_FEATURE, v.sType, "composite",
           "WLK_COMPOSITE_BLEND needs WLK_VULKAN_FEATURE_BLEND");
    }
  }
  // Headless targets are read back as floats: the one format that loses nothing.
  if (c.headless) {
    v.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  }
  const VkFormatFeatureFlags needed =
      v.composite == WLK_COMPOSITE_BLEND
          ? VkFormatFeatureFlags{VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT}
          : VkFormatFeatureFlags{VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT};
  if (!c.device->supports(targetFormat(v.targetFormat), needed)) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, v.sType, "targetFormat",
         "the device cannot %s WlkViewInfo::targetFormat %u",
         v.composite == WLK_COMPOSITE_BLEND ? "blend onto" : "store to", v.targetFormat);
  }
  return v;
}

struct CameraMatrices {
  glm::dmat4 clipFromView;
  glm::dmat4 eyeFromNdc;
  glm::dmat4 clipFromEye;
  double skyDepth;
};

// Inverts the camera and finds the depth value of infinity. Everything follows from the matrices.
CameraMatrices checkedCamera(const WlkCamera& camera) {
  for (const double x : camera.position) {
    checkRange(camera.sType, "position", x, -1e9, 1e9);
  }
  for (const float x : camera.viewFromWorld) {
    checkRange(camera.sType, "viewFromWorld", x, -1.01, 1.01);
  }
  for (const float x : camera.clipFromView) {
    checkRange(camera.sType, "clipFromView", x, -1e9, 1e9);
  }
  checkRange(camera.sType, "preExposure", camera.preExposure, 1e-9f, 1e9f);
  glm::dmat3 rotation;
  glm::dmat4 projection;
  for (int i = 0; i < 9; ++i) {
    rotation[i / 3][i % 3] = camera.viewFromWorld[i];
  }
  for (int i = 0; i < 16; ++i) {
    projection[i / 4][i % 4] = camera.clipFromView[i];
  }
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) > 1e-3) {
        fail(WLK_ERROR_INVALID_ARGUMENT, camera.sType, "viewFromWorld",
             "WlkCamera::viewFromWorld is not orthonormal");
      }
    }
  }
  const glm::dmat4 inverse = glm::inverse(projection);
  for (int i = 0; i < 16; ++i) {
    // The inverse becomes float on the GPU, where squares of its elements must stay finite.
    if (!(std::abs(inverse[i / 4][i % 4]) <= 1e18)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, camera.sType, "clipFromView",
           "WlkCamera::clipFromView is singular");
    }
  }
  // Clip w of a perspective matrix grows with distance; of an orthographic one it is constant.
  const glm::dvec4 atZero = inverse * glm::dvec4(0, 0, 0, 1);
  const glm::dvec4 atOne = inverse * glm::dvec4(0, 0, 1, 1);
  const double scale = std::max(std::abs(atZero.w), std::abs(atOne.w));
  if (!(std::abs(atZero.w - atOne.w) > 1e-9 * scale) || !(scale > 0)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, camera.sType, "clipFromView",
         "WlkCamera::clipFromView is not a perspective projection");
  }
  const glm::dmat4 worldFromView(glm::transpose(rotation));
  CameraMatrices result{};
  result.clipFromView = projection;
  result.eyeFromNdc = worldFromView * inverse;
  result.clipFromEye = projection * glm::dmat4(rotation);
  // The smaller w = reach / distance lies further away.
  result.skyDepth = std::abs(atZero.w) < std::abs(atOne.w) ? 0.0 : 1.0;
  return result;
}

void setCamera(ViewState& view, const WlkCamera& camera) {
  const CameraMatrices matrices = checkedCamera(camera);
  view.camera = camera;
  view.clipFromView = matrices.clipFromView;
  view.eyeFromNdc = matrices.eyeFromNdc;
  view.clipFromEye = matrices.clipFromEye;
  view.skyDepth = matrices.skyDepth;
}

WlkQuality checkedQuality(const WlkQuality* quality) {
  const WlkQuality q = copyStruct(quality, WLK_STRUCT_QUALITY);
  checkNoChain(quality);
  checkRange(q.sType, "level", q.level, WLK_QUALITY_LOW, WLK_QUALITY_ULTRA);
  if (q.sliceCount != 0) {
    checkRange(q.sType, "sliceCount", q.sliceCount, 8, 2048);
  }
  const uint32_t slices = resolveQuality(q).sliceCount;
  if (q.batchSize != 0) {
    checkRange(q.sType, "batchSize", q.batchSize, 1, slices);
  }
  if (q.lightBufferSize != 0) {
    checkRange(q.sType, "lightBufferSize", q.lightBufferSize, 16, 2048);
  }
  checkRange(q.sType, "slicing", q.slicing, 0, WLK_SLICING_LIGHT_ALIGNED);
  checkRange(q.sType, "scattering", q.scattering, 0, WLK_SCATTERING_ALL_ORDERS);
  if (q.volumeCells != 0) {
    checkRange(q.sType, "volumeCells", q.volumeCells, 8, 128);
  }
  checkRange(q.sType, "volumeResolution", q.volumeResolution, 0, WLK_VOLUME_RESOLUTION_HALF);
  checkRange(q.sType, "lightFrames", q.lightFrames, 0, 64);
  checkRange(q.sType, "control", q.control, WLK_CONTROL_LEVEL, WLK_CONTROL_ERROR);
  checkRange(q.sType, "lowestLevel", q.lowestLevel, WLK_QUALITY_LOW, q.level);
  const bool timed = q.control == WLK_CONTROL_TIME || q.control == WLK_CONTROL_REPORTED_TIME;
  const bool byError = q.control == WLK_CONTROL_ERROR;
  checkRange(q.sType, "timeBudget_ms", static_cast<double>(q.timeBudget_ms),
             timed ? static_cast<double>(0.01f) : 0, timed ? 1000 : 0);
  checkRange(q.sType, "errorTarget", static_cast<double>(q.errorTarget),
             byError ? static_cast<double>(1e-4f) : 0, byError ? 1 : 0);
  if (governed(q)) {
    checkRange(q.sType, "sliceCount", q.sliceCount, 0, 0);
    checkRange(q.sType, "batchSize", q.batchSize, 0, 0);
    checkRange(q.sType, "lightBufferSize", q.lightBufferSize, 0, 0);
  }
  constexpr uint64_t FLAGS =
      WLK_QUALITY_FLAG_NO_SKIP | WLK_QUALITY_FLAG_VOLUME_SHADOWS | WLK_QUALITY_FLAG_LIGHT_SHADOWS;
  if ((q.flags & ~FLAGS) != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, q.sType, "flags", "WlkQuality::flags has unknown bits");
  }
  return q;
}

// Whether only the budget or the target differ, which no resource depends on.
bool sameButGoal(const WlkQuality& a, const WlkQuality& b) {
  return a.control == b.control && a.level == b.level && a.lowestLevel == b.lowestLevel &&
         a.slicing == b.slicing && a.scattering == b.scattering && a.flags == b.flags &&
         a.volumeCells == b.volumeCells && a.volumeResolution == b.volumeResolution &&
         a.lightFrames == b.lightFrames;
}

}  // namespace

WlkResult wlkCreateView(WlkContext context, const WlkViewInfo* info, WlkView* view) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    checkPointer(view, "view");
    c.requireDevice("wlkCreateView");
    const WlkViewInfo value = checkedView(c, info);
    WlkCamera camera;
    wlkInitStruct(WLK_STRUCT_CAMERA, sizeof camera, &camera);
    const uint64_t id = c.views.create(&c.memory);
    ViewState& state = *c.views.find(id);
    state.info = value;
    setCamera(state, camera);
    wlkInitStruct(WLK_STRUCT_QUALITY, sizeof state.quality, &state.quality);
    view->id = id;
    return WLK_SUCCESS;
  });
}

WlkResult wlkUpdateView(WlkContext context, WlkView view, const WlkViewInfo* info) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ViewState& state = c.view(view);
    c.requireDevice("wlkUpdateView");
    state.info = checkedView(c, info);
    state.prepared = false;
    return WLK_SUCCESS;
  });
}

WlkResult wlkDestroyView(WlkContext context, WlkView view) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    c.retireView(c.view(view));
    c.views.destroy(view.id);
    c.collect();
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetCamera(WlkContext context, WlkView view, const WlkCamera* camera) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ViewState& state = c.view(view);
    const WlkCamera value = copyStruct(camera, WLK_STRUCT_CAMERA);
    checkNoChain(camera);
    setCamera(state, value);
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetQuality(WlkContext context, WlkView view, const WlkQuality* quality) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ViewState& state = c.view(view);
    const WlkQuality value = checkedQuality(quality);
    if (value.control == WLK_CONTROL_TIME && !c.device->timestamps()) {
      fail(WLK_ERROR_MISSING_FEATURE, value.sType, "control",
           "the queue has no timestamps: report times with WLK_CONTROL_REPORTED_TIME");
    }
    if (governed(value) && sameButGoal(value, state.quality)) {
      state.quality = value;
      state.governor.retarget();
      return WLK_SUCCESS;
    }
    state.quality = value;
    state.governor.start(rungRange(value));
    state.prepared = false;
    return WLK_SUCCESS;
  });
}

WlkResult wlkGetFrameStats(WlkContext context, WlkView view, WlkFrameStats* stats,
                           uint32_t* passCount, uint32_t stride, WlkPassStats* passes) {
  return guarded([&]() -> WlkResult {
    WlkContext_T& c = checkContext(context);
    ViewState& state = c.view(view);
    const WlkFrameStats head = startOutput(stats, WLK_STRUCT_FRAME_STATS);
    checkPointer(passCount, "passCount");
    if (passes != nullptr && stride < FIRST_SIZE<WlkPassStats>) {
      fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_FRAME_STATS, "stride",
           "stride is %u, expected at least %u", stride, FIRST_SIZE<WlkPassStats>);
    }
    if (state.lastFrame == 0) {
      return WLK_NOT_READY;
    }
    c.harvest(state);
    WlkFrameStats value = state.record.stats;
    value.sType = head.sType;
    value.structSize = head.structSize;
    value.next = nullptr;
    value.bytesUploaded = c.bytesUploaded;
    value.deviceMemory = c.device->memory().bytes();
    value.hostMemory = c.memory.bytes();
    value.nonFinitePixels = state.nonFinite;
    finishOutput(value, stats);
    const auto available = static_cast<uint32_t>(state.record.passes.size());
    const uint32_t room = passes == nullptr ? available : *passCount;
    *passCount = available;
    if (passes != nullptr) {
      for (uint32_t i = 0; i < std::min(room, available); ++i) {
        WlkPassStats pass = state.record.passes[i];
        for (const PassTime& time : state.record.times) {
          if (time.pass == pass.pass && time.objectId == (pass.volume.id | pass.surface.id)) {
            pass.gpuTime_ns = time.nanoseconds;
          }
        }
        std::memcpy(reinterpret_cast<char*>(passes) + size_t{i} * stride, &pass,
                    std::min<size_t>(stride, sizeof pass));
      }
    }
    return room < available ? WLK_INCOMPLETE : WLK_SUCCESS;
  });
}
