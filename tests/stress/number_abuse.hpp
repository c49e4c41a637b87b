// SPDX-License-Identifier: MIT
// Every float and double that goes in: NaN, infinities, the largest and smallest numbers, -1, 0.
// A value is either refused, naming the field and changing nothing, or the picture stays finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stress/abuse.hpp"

namespace welkin::test {

struct NumberField {
  const char* name;
  size_t offset;
  uint32_t count;
  bool isDouble;
};

#define FLOATS(type, field, count) \
  { #field, offsetof(type, field), count, false }
#define DOUBLES(type, field, count) \
  { #field, offsetof(type, field), count, true }

inline const std::vector<double>& poisons(bool isDouble) {
  using F = std::numeric_limits<float>;
  using D = std::numeric_limits<double>;
  static const std::vector<double> floats{
      F::quiet_NaN(),   F::infinity(), -F::infinity(), F::max(), -F::max(), -1.0, F::denorm_min(),
      -F::denorm_min(), F::min(),      -0.0,           0.0,      1e-30,     1e30, 2.0};
  static const std::vector<double> doubles{
      D::quiet_NaN(),   D::infinity(), -D::infinity(), D::max(), -D::max(), -1.0,  D::denorm_min(),
      -D::denorm_min(), D::min(),      -0.0,           0.0,      1e-300,    1e300, 2.0};
  return isDouble ? doubles : floats;
}

template <typename T>
T poisoned(const T& valid, const NumberField& field, uint32_t index, double value) {
  T bad = valid;
  auto* bytes = reinterpret_cast<unsigned char*>(&bad) + field.offset;
  if (field.isDouble) {
    std::memcpy(bytes + index * sizeof(double), &value, sizeof value);
  } else {
    const auto narrow = static_cast<float>(value);
    std::memcpy(bytes + index * sizeof(float), &narrow, sizeof narrow);
  }
  return bad;
}

// `other` differs from the victim's scene in every field, so that a half-made change shows. `undo`
// takes back an accepted value that VictimScene::restore does not know.
template <typename T>
void abuseNumbers(const T& other, const std::vector<NumberField>& fields,
                  const std::function<WlkResult(const T&)>& call,
                  const std::function<void()>& undo = nullptr) {
  VictimScene& victim = VictimScene::get();
  // What an accepted value left is taken back before a call that changes nothing, which would not
  // show after; the next accepted value replaces it.
  bool changed = false;
  const auto takeBack = [&] {
    if (std::exchange(changed, false)) {
      victim.restore();
    }
  };
  for (const NumberField& field : fields) {
    bool refused = false;
    for (uint32_t i = 0; i < field.count; ++i) {
      const std::vector<double>& values = poisons(field.isDouble);
      for (size_t k = 0; k < values.size(); ++k) {
        // All in a field's first number, which its others are checked like: those take turns.
        if (i > 0 && (k + i) % 3 != 0) {
          continue;
        }
        const double value = values[k];
        SCOPED_TRACE(std::string(field.name) + "[" + std::to_string(i) +
                     "] = " + std::to_string(value));
        WlkResult result = call(poisoned(other, field, i, value));
        if (result == WLK_SUCCESS) {
          EXPECT_TRUE(std::isfinite(value)) << "a number that is not finite was accepted";
          ASSERT_EQ(wlkPrepare(victim.scene.context), WLK_SUCCESS);
          ASSERT_EQ(wlkRenderHeadless(victim.scene.context, victim.scene.view, nullptr),
                    WLK_SUCCESS);
          EXPECT_EQ(victim.scene.read(WLK_IMAGE_COLOR).badValues(), 0u);
          EXPECT_EQ(victim.scene.stats().nonFinitePixels, 0u);
          changed = undo == nullptr;
          if (undo != nullptr) {
            undo();
          }
          continue;
        }
        refused = true;
        if (changed) {
          takeBack();
          result = call(poisoned(other, field, i, value));
        }
        EXPECT_FAILS(result, WLK_ERROR_INVALID_ARGUMENT, field.name);
        EXPECT_EQ(lastError().structType, other.sType);
      }
    }
    EXPECT_TRUE(refused) << field.name << " was never checked";
  }
  takeBack();
  victim.expectUnchanged();
}

}  // namespace welkin::test
