// SPDX-License-Identifier: MIT
// What the tests of src/tables/transport_phase share: media, and peak and rest of a phase function
// (1/sr) from their definition.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "particles/catalogue.hpp"
#include "reference/phase_reference.hpp"
#include "tables/transport_phase.hpp"

namespace transport_test {

using namespace welkin;
using ::reference::Real;

constexpr double PI = std::numbers::pi;
constexpr double EPS_FLOAT = 0x1p-24;
constexpr Real EDGE = ::reference::PI / 9;
// The chord across the kink at 20 degrees: (cell of 1.5e-3 rad)^2 / 8 times the slope there, and
// the fit of the curve. Measured 5e-6.
constexpr double CHORD = 1e-5;

// 1/sr at y = 1 - cos.
using Phase = std::function<double(double y)>;

inline double yOf(Real theta) {
  const Real s = std::sin(theta / 2);
  return static_cast<double>(2 * s * s);
}

inline Phase henyeyGreenstein(double g) {
  return [g](double y) {
    const double square = (1 - g) * (1 - g) + 2 * g * y;
    return (1 - g * g) / (4 * PI * square * std::sqrt(square));
  };
}

inline PhaseCurve henyeyGreensteinCurve(double g) {
  return makePhaseCurve([&](size_t, double y) {
    return static_cast<double>(::reference::henyeyGreenstein(g, 1 - static_cast<Real>(y)));
  });
}

inline Phase curveAt(const PhaseCurve& curve, size_t channel) {
  return [&curve, channel](double y) { return evalPhaseCurve(curve, channel, y); };
}

struct Named {
  std::string name;
  PhaseCurve curve;
};

inline Named particle(const std::string& name, ParticleType type, double diameter_um,
                      double g = 0) {
  const ParticleKind& kind = particleKind(type);
  ParticleParams params;
  params.diameter_um = diameter_um;
  params.spread = kind.spread.initial;
  params.roughness = kind.roughness.initial;
  params.asymmetry = g;
  return {name, kind.make(params).curve};
}

inline std::vector<Named> media() {
  return {particle("5 um", ParticleType::Cloud, 5),
          particle("12 um", ParticleType::Cloud, 12),
          particle("50 um", ParticleType::Cloud, 50),
          particle("rain", ParticleType::Rain, 1000),
          particle("columns", ParticleType::IceColumn, 0),
          particle("plates", ParticleType::IcePlate, 0),
          particle("HG -0.9", ParticleType::HenyeyGreenstein, 0, -0.9),
          particle("HG 0", ParticleType::HenyeyGreenstein, 0, 0),
          particle("HG 0.85", ParticleType::HenyeyGreenstein, 0, 0.85),
          particle("HG 0.998", ParticleType::HenyeyGreenstein, 0, 0.998)};
}

// Peak and rest from the definition.
struct Truth {
  Phase p;
  double edge = yOf(EDGE);
  double level = p(edge);
  // Of the rest.
  double share = static_cast<double>(integral([this](Real t) { return kept(yOf(t)); }));

  double kept(double y) const { return y < edge ? std::min(p(y), level) : p(y); }
  double rest(double y) const { return kept(y) / share; }
  // Panels of 0.2 degrees, which resolve bows and halos.
  template <typename F>
  static Real integral(F f) {
    return ::reference::integrateSphere(f, 0, EDGE, 0.004L) +
           ::reference::integrateSphere(f, EDGE, ::reference::PI, 0.004L);
  }
};

inline Real legendre(int l, Real mu) {
  if (l == 4) {
    return ((35 * mu * mu - 30) * mu * mu + 3) / 8;
  }
  return l == 0 ? 1 : l == 1 ? mu : l == 2 ? (3 * mu * mu - 1) / 2 : (5 * mu * mu - 3) * mu / 2;
}

}  // namespace transport_test
