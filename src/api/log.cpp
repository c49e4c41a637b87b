// SPDX-License-Identifier: MIT
#include <cstdarg>
#include <cstdio>

#include "api/context.hpp"

void WlkContext_T::emit(uint32_t severity, uint32_t id, const char* format, ...) const {
  if (log == nullptr) {
    return;
  }
  char text[WLK_MESSAGE_SIZE] = {};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  const WlkLogMessage message{
      WLK_STRUCT_LOG_MESSAGE, sizeof(WlkLogMessage), nullptr, severity, id, text};
  log(logUser, &message);
}
