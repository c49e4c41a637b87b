// SPDX-License-Identifier: MIT
// The model text of shaders/model as C++, in float (model::f32) and in double (model::f64).
// Include from .cpp files only: the functions stand in an unnamed namespace of each unit.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#pragma GCC diagnostic ignored "-Wshadow"
#endif

namespace welkin::model::f64 {
namespace {
#define precise  // of GLSL; here nothing is contracted
#define WELKIN_REAL double
#include "model/glsl.hpp"
#include "model/model.glsl"
#undef WELKIN_REAL
}  // namespace
}  // namespace welkin::model::f64

#if defined(__GNUC__)
#pragma GCC diagnostic error "-Wdouble-promotion"
#endif

namespace welkin::model::f32 {
namespace {
#define WELKIN_REAL float
#include "model/glsl.hpp"
#include "model/model.glsl"
#undef WELKIN_REAL
#undef precise
}  // namespace
}  // namespace welkin::model::f32

#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
