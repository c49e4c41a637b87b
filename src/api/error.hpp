// SPDX-License-Identifier: MIT
// The C boundary: no exception leaves it; the thread's last error is set before an error returns.
#pragma once

#include <new>

#include "failure.hpp"

namespace welkin {

// The calling thread works on a context from here on: a failure by a lost device sets the flag.
// Null for none.
void enterContext(bool* deviceLost) noexcept;

WlkResult reportFailure(const Failure& failure) noexcept;
WlkResult reportOutOfMemory() noexcept;
WlkResult reportInternal(const char* what) noexcept;

template <typename Body>
WlkResult guarded(Body&& body) noexcept {
  enterContext(nullptr);
  try {
    return body();
  } catch (const Failure& failure) {
    return reportFailure(failure);
  } catch (const std::bad_alloc&) {
    return reportOutOfMemory();
  } catch (const std::exception& error) {
    return reportInternal(error.what());
  } catch (...) {
    return reportInternal("unknown exception");
  }
}

}  // namespace welkin
