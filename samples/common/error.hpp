// SPDX-License-Identifier: MIT
// The two failures that the host knows; the program turns them into one line and an exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace host {

/// The user's input is at fault: exit code 2. Says which file, which key and what was expected.
class InputError : public std::runtime_error {
 public:
  /// `key` may be empty when the file as a whole is at fault.
  InputError(const std::string& file, const std::string& key, const std::string& expected)
      : std::runtime_error(file + (key.empty() ? "" : ": " + key) + ": " + expected) {}
};

/// Anything else that the host can report (the library, the device, the disk): exit code 1.
class HostError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace host
