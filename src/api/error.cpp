// SPDX-License-Identifier: MIT
#include "api/error.hpp"

#include <cstring>

#include "api/validate.hpp"

namespace welkin {
namespace {

thread_local Failure lastFailure{WLK_SUCCESS, 0, 0, {}, {}};
thread_local bool* lostFlag = nullptr;

}  // namespace

void enterContext(bool* deviceLost) noexcept {
  lostFlag = deviceLost;
}

WlkResult reportFailure(const Failure& failure) noexcept {
  if (failure.result == WLK_ERROR_DEVICE_LOST && lostFlag != nullptr) {
    *lostFlag = true;
  }
  lastFailure = failure;
  return failure.result;
}

WlkResult reportOutOfMemory() noexcept {
  Failure failure;
  failure.result = WLK_ERROR_OUT_OF_HOST_MEMORY;
  std::snprintf(failure.message, sizeof failure.message, "the host allocator returned null");
  return reportFailure(failure);
}

WlkResult reportInternal(const char* what) noexcept {
  Failure failure;
  failure.result = WLK_ERROR_INTERNAL;
  std::snprintf(failure.message, sizeof failure.message, "unexpected exception: %s", what);
  return reportFailure(failure);
}

}  // namespace welkin

using namespace welkin;

WlkResult wlkGetLastError(WlkErrorInfo* info) {
  // Must not overwrite what it reports: works on a copy.
  const Failure failure = lastFailure;
  return guarded([&] {
    WlkErrorInfo value = startOutput(info, WLK_STRUCT_ERROR_INFO);
    value.result = failure.result;
    value.structType = failure.structType;
    value.vkResult = failure.vkResult;
    std::memcpy(value.field, failure.field, sizeof value.field);
    std::memcpy(value.message, failure.message, sizeof value.message);
    finishOutput(value, info);
    return WLK_SUCCESS;
  });
}

const char* wlkResultName(WlkResult result) {
  switch (result) {
#define WELKIN_NAME(name) \
  case name:              \
    return #name
    WELKIN_NAME(WLK_SUCCESS);
    WELKIN_NAME(WLK_NOT_READY);
    WELKIN_NAME(WLK_INCOMPLETE);
    WELKIN_NAME(WLK_ERROR_INVALID_ARGUMENT);
    WELKIN_NAME(WLK_ERROR_INVALID_HANDLE);
    WELKIN_NAME(WLK_ERROR_UNKNOWN_STRUCT);
    WELKIN_NAME(WLK_ERROR_STRUCT_TOO_NEW);
    WELKIN_NAME(WLK_ERROR_VERSION);
    WELKIN_NAME(WLK_ERROR_OUT_OF_HOST_MEMORY);
    WELKIN_NAME(WLK_ERROR_OUT_OF_DEVICE_MEMORY);
    WELKIN_NAME(WLK_ERROR_DEVICE_LOST);
    WELKIN_NAME(WLK_ERROR_UNSUPPORTED_FORMAT);
    WELKIN_NAME(WLK_ERROR_MISSING_FEATURE);
    WELKIN_NAME(WLK_ERROR_FRAMES_IN_FLIGHT);
    WELKIN_NAME(WLK_ERROR_NOT_PREPARED);
    WELKIN_NAME(WLK_ERROR_WRONG_STATE);
    WELKIN_NAME(WLK_ERROR_LIMIT_EXCEEDED);
    WELKIN_NAME(WLK_ERROR_NO_DEVICE);
    WELKIN_NAME(WLK_ERROR_INTERNAL);
    default:
      return "WLK_UNKNOWN_RESULT";
  }
}

const char* wlkReasonName(uint32_t reason) {
  switch (reason) {
    WELKIN_NAME(WLK_REASON_NEEDED);
    WELKIN_NAME(WLK_REASON_LAYER_OFF);
    WELKIN_NAME(WLK_REASON_NOTHING_TO_DRAW);
    WELKIN_NAME(WLK_REASON_ZERO_DENSITY);
    WELKIN_NAME(WLK_REASON_OUTSIDE_VIEW);
    WELKIN_NAME(WLK_REASON_NO_LIGHT);
    WELKIN_NAME(WLK_REASON_NO_SKIP_FLAG);
    WELKIN_NAME(WLK_REASON_UNCHANGED);
    WELKIN_NAME(WLK_REASON_SPREAD);
#undef WELKIN_NAME
    default:
      return "WLK_UNKNOWN_REASON";
  }
}

uint32_t wlkGetVersion(void) {
  return WLK_API_VERSION;
}
