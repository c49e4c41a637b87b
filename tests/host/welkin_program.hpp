// SPDX-License-Identifier: MIT
// Runs the welkin program in a folder.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "common/text.hpp"
#include "temp_folder.hpp"

namespace host_test {

struct Outcome {
  int code = -1;
  std::string error;
};

/// `welkin ARGUMENTS`, with the folder as the current one.
inline Outcome runWelkin(const TempFolder& folder, const std::string& arguments) {
  const std::string log = folder.file("stderr.txt");
  const std::string command = "cd '" + folder.file("") + "' && '" + WELKIN_PROGRAM + "' " +
                              arguments + " >stdout.txt 2>'" + log + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, host::readTextFile(log, 1 << 20, "log")};
}

inline void expectSuccess(const TempFolder& folder, const std::string& arguments) {
  const Outcome outcome = runWelkin(folder, arguments);
  EXPECT_EQ(outcome.code, 0) << arguments << '\n' << outcome.error;
}

/// Exit code 2 and one line that holds `part`.
inline void expectBadInput(const TempFolder& folder, const std::string& arguments,
                           const std::string& part) {
  const Outcome outcome = runWelkin(folder, arguments);
  EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  EXPECT_NE(outcome.error.find(part), std::string::npos) << outcome.error;
}

}  // namespace host_test
