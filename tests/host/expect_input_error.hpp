// SPDX-License-Identifier: MIT
// Expects an InputError whose one line names what the user must look at.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "common/error.hpp"

namespace host_test {

template <class Action>
void expectInputError(const std::string& part, const Action& action) {
  try {
    action();
    ADD_FAILURE() << "no error; expected one with '" << part << "'";
  } catch (const host::InputError& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

}  // namespace host_test
