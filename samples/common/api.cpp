// SPDX-License-Identifier: MIT
#include "common/api.hpp"

#include <cstdio>

#include "common/error.hpp"

namespace host {
namespace {

WlkErrorInfo lastError() {
  WlkErrorInfo info{};
  info.sType = WLK_STRUCT_ERROR_INFO;
  info.structSize = sizeof info;
  // A failure leaves the zeros: an empty message.
  static_cast<void>(wlkGetLastError(&info));
  return info;
}

}  // namespace

void check(WlkResult result, const std::string& file, const std::string& key) {
  if (result >= WLK_SUCCESS) {
    return;
  }
  const WlkErrorInfo info = lastError();
  const std::string text = std::string(wlkResultName(result)) + ": " + info.message;
  switch (result) {
    case WLK_ERROR_INVALID_ARGUMENT:
    case WLK_ERROR_LIMIT_EXCEEDED:
    case WLK_ERROR_UNSUPPORTED_FORMAT: {
      const std::string field = info.field;
      throw InputError(file, field.empty() || key.empty() ? key + field : key + "." + field, text);
    }
    default:
      throw HostError(file + (key.empty() ? "" : ": " + key) + ": " + text);
  }
}

void check(WlkResult result, const char* call) {
  if (result < WLK_SUCCESS) {
    const WlkErrorInfo info = lastError();
    throw HostError(std::string(call) + ": " + wlkResultName(result) + ": " + info.message);
  }
}

void LogCounter::receive(void* user, const WlkLogMessage* message) {
  if (message->severity == WLK_LOG_INFO) {
    return;
  }
  const bool error = message->severity == WLK_LOG_ERROR;
  static_cast<LogCounter*>(user)->problems += message->id == WLK_LOG_ID_VALIDATION ? 1 : 0;
  std::fprintf(stderr, "%s: %s\n", error ? "error" : "warning", message->text);
}

ContextPtr makeCpuContext() {
  const auto info = make<WlkContextInfo>();
  WlkContext context = nullptr;
  check(wlkCreateContext(WLK_API_VERSION, &info, &context), "wlkCreateContext");
  return ContextPtr(context);
}

ContextPtr makeHeadlessContext(bool validation, const std::string& deviceName, LogCounter& log) {
  auto headless = make<WlkHeadlessInfo>();
  headless.flags = validation ? uint64_t{WLK_HEADLESS_VALIDATION} : 0u;
  headless.deviceName = deviceName.empty() ? nullptr : deviceName.c_str();
  auto info = make<WlkContextInfo>();
  info.next = &headless;
  info.log = &LogCounter::receive;
  info.logUser = &log;
  WlkContext context = nullptr;
  check(wlkCreateContext(WLK_API_VERSION, &info, &context), "wlkCreateContext");
  return ContextPtr(context);
}

}  // namespace host
