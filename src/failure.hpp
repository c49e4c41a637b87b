// SPDX-License-Identifier: MIT
// The one exception that carries an error to the C boundary. Allocates nothing.
#pragma once

#include <welkin/welkin.h>

#include <cstdarg>
#include <cstdio>

namespace welkin {

struct Failure {
  WlkResult result = WLK_ERROR_INTERNAL;
  uint32_t structType = 0;
  int32_t vkResult = 0;
  char field[WLK_NAME_SIZE] = {};
  char message[WLK_MESSAGE_SIZE] = {};
};

// `field` names what is at fault ("" if nothing does), `format` makes one sentence.
[[noreturn]] __attribute__((format(printf, 4, 5))) inline void fail(WlkResult result,
                                                                    uint32_t structType,
                                                                    const char* field,
                                                                    const char* format, ...) {
  Failure failure;
  failure.result = result;
  failure.structType = structType;
  std::snprintf(failure.field, sizeof failure.field, "%s", field);
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(failure.message, sizeof failure.message, format, arguments);
  va_end(arguments);
  throw failure;
}

}  // namespace welkin
