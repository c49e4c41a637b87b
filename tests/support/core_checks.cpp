// SPDX-License-Identifier: MIT
// Which tests of an executable run under all of the validation layer. Its core checks read the
// SPIR-V of every pipeline of every context anew, three fifths of a test's time where contexts
// prepare a hundred: the first test of each suite has them, those of suites with parameters, and
// those that name the validation or images' layouts and states.
// What is checked of parameters, lifetimes and synchronisation all have. WELKIN_CORE_CHECKS=1 in
// the environment: all have all.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

namespace {

constexpr const char* DISABLES = "VK_LAYER_DISABLES";  // read by the layer with each instance

bool names(const testing::TestInfo& test, const char* what) {
  return std::strstr(test.name(), what) != nullptr;
}

class CoreChecks : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    const testing::TestSuite* suite = testing::UnitTest::GetInstance()->current_test_suite();
    const bool chosen = test.value_param() != nullptr || names(test, "Validation") ||
                        names(test, "Layout") || names(test, "States");
    if (chosen || suite == nullptr || suite->GetTestInfo(0) == &test) {
      unsetenv(DISABLES);
    } else {
      setenv(DISABLES, "VK_VALIDATION_FEATURE_DISABLE_CORE_CHECKS_EXT", 1);
    }
  }
};

[[maybe_unused]] const bool LISTENS = [] {
  if (std::getenv("WELKIN_CORE_CHECKS") == nullptr && std::getenv(DISABLES) == nullptr) {
    testing::UnitTest::GetInstance()->listeners().Append(new CoreChecks);
  }
  return true;
}();

}  // namespace
