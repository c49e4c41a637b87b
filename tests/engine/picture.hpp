// SPDX-License-Identifier: MIT
// Comparison of RGBA pictures, and what the target formats may lose.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <span>
#include <vector>

namespace engine {

// |actual - expected| <= relative * |expected| + absolute, per colour.
struct Tolerance {
  std::array<double, 3> relative;
  double absolute;
};
// A sum of tolerances' worth: `factor` roundings instead of one.
Tolerance operator*(const Tolerance& tolerance, double factor);
Tolerance operator+(const Tolerance& a, const Tolerance& b);

// The same shader, compiled for two pipelines of one driver: 16 operations may round differently.
inline constexpr Tolerance SAME_SHADER{{16 * 0x1p-24, 16 * 0x1p-24, 16 * 0x1p-24}, 1e-9};
// Two shaders over the same model text: the model's float accuracy bounds how far a driver's two
// compilations may lie apart (3e-5, tests/parity), and each may err.
inline constexpr Tolerance SAME_MODEL{{6e-5, 6e-5, 6e-5}, 1e-7};

// Rounding to nearest in the format: half a unit in the last place, or half the subnormal step.
Tolerance roundingOf(VkFormat format);

// Fails at the worst pixel.
void expectClose(std::span<const float> actual, std::span<const float> expected,
                 const Tolerance& tolerance, const char* what);
// Alphas are equal, up to the format's rounding of the expected ones.
void expectSameAlpha(std::span<const float> actual, std::span<const float> expected);
// The picture is not flat: it could not tell a wrong one from a right one.
void expectStructure(std::span<const float> picture);

}  // namespace engine
