// SPDX-License-Identifier: MIT
// wlkEvalAmbient: the moments of SkyField as spherical harmonics in the world's axes.
#include <algorithm>
#include <cmath>

#include "api/air_query.hpp"
#include "api/context.hpp"
#include "api/validate.hpp"
#include "particles/phase_curve.hpp"
#include "tables/angular_moments.hpp"
#include "tables/sky_field.hpp"

namespace {

using namespace welkin;

SkyFieldInput fieldInputOf(const AirState& state, const AirQuery& query) {
  SkyFieldInput input;
  input.air = query.air;
  input.lightAngularRadius = query.angularRadius;
  for (size_t c = 0; c < 3; ++c) {
    input.groundAlbedo[c] = static_cast<double>(state.planet.groundAlbedo[c]);
  }
  if (query.air.fogExtinction > 0) {
    const Particle& droplets = *query.droplets;
    const PhaseCurve closed =
        droplets.analytic
            ? makePhaseCurve([&](size_t, double y) { return evalPhase(droplets.phase, y); })
            : PhaseCurve{};
    const PhaseCurve& curve = droplets.analytic ? closed : droplets.curve;
    for (size_t c = 0; c < 3; ++c) {
      std::array<double, 4> chi{};
      legendreMoments(curve.y, curve.value[c], chi);
      for (size_t l = 0; l < 3; ++l) {
        input.fogMoments[l][c] = chi[l + 1];
      }
    }
  }
  return input;
}

const SkyField& fieldOf(WlkContext_T& c, const AirQuery& query) {
  const SkyFieldInput input = fieldInputOf(c.air, query);
  if (!c.skyField || !(c.skyField->input == input)) {
    c.skyField = std::make_unique<SkyFieldEntry>(SkyFieldEntry{input, solveSkyField(input)});
  }
  return c.skyField->field;
}

// Integrals over all directions w: of L, of L w, of L w w^T.
struct Tensors {
  double light = 0;
  glm::dvec3 first{0};
  glm::dmat3 second{0};
};

void addOuter(glm::dmat3& sum, double value, const glm::dvec3& a, const glm::dvec3& b) {
  sum += value * glm::outerProduct(a, b);
}

// Sloan, Stupid Spherical Harmonics Tricks, 2008.
void storeHarmonics(const Tensors& t, size_t channel, double* coefficients) {
  const glm::dmat3& m = t.second;
  const double values[WLK_AMBIENT_VALUES / 3] = {0.28209479177387814 * t.light,
                                                 0.48860251190291992 * t.first.y,
                                                 0.48860251190291992 * t.first.z,
                                                 0.48860251190291992 * t.first.x,
                                                 1.0925484305920792 * m[0][1],
                                                 1.0925484305920792 * m[1][2],
                                                 0.31539156525252005 * (3 * m[2][2] - t.light),
                                                 1.0925484305920792 * m[0][2],
                                                 0.54627421529603959 * (m[0][0] - m[1][1])};
  for (size_t i = 0; i < WLK_AMBIENT_VALUES / 3; ++i) {
    coefficients[3 * i + channel] = values[i];
  }
}

}  // namespace

WlkResult wlkEvalAmbient(WlkContext context, const double position[3],
                         double coefficients[WLK_AMBIENT_VALUES]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    checkPointer(position, "position");
    checkPointer(coefficients, "coefficients");
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(position[i]) <= 1e9)) {
        fail(WLK_ERROR_INVALID_ARGUMENT, 0, "position", "position holds %g", position[i]);
      }
    }
    const AirQuery query = airQueryOf(c.air);
    const PlanetFrame frame =
        planetFrameAt(c.air.planet, glm::dvec3(position[0], position[1], position[2]));
    if (!query.light) {
      std::fill_n(coefficients, WLK_AMBIENT_VALUES, 0.0);
      return WLK_SUCCESS;
    }
    const SkyField& field = fieldOf(c, query);
    if (frame.altitude > field.top()) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "position",
           "position is %g m high, ambient light is known up to %g m", frame.altitude, field.top());
    }
    const double altitude = std::max(frame.altitude, 0.0);
    const double sunMu = std::clamp(glm::dot(query.toLight, frame.up), -1.0, 1.0);
    const SkyField::Moments moments = field.momentsAt(altitude, sunMu);
    const SkyColor peak = field.peakIrradianceAt(altitude, sunMu);
    // The frame of the moments; with the light overhead any azimuth will do.
    const glm::dvec3 flat = query.toLight - sunMu * frame.up;
    const glm::dvec3 other = std::abs(frame.up.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 along = glm::length(flat) > 1e-9 ? glm::normalize(flat)
                                                      : glm::normalize(glm::cross(frame.up, other));
    const glm::dvec3 across = glm::cross(along, frame.up);
    for (size_t k = 0; k < 3; ++k) {
      const auto at = [&](size_t moment) { return moments[moment][k]; };
      Tensors sum;
      sum.light = at(0) + at(1) + at(2) + peak[k];
      sum.first = at(4) * along + at(5) * frame.up + peak[k] * query.toLight;
      addOuter(sum.second, at(0), along, along);
      addOuter(sum.second, at(1), frame.up, frame.up);
      addOuter(sum.second, at(2), across, across);
      addOuter(sum.second, at(3), along, frame.up);
      addOuter(sum.second, at(3), frame.up, along);
      addOuter(sum.second, peak[k], query.toLight, query.toLight);
      storeHarmonics(sum, k, coefficients);
      for (size_t i = 0; i < WLK_AMBIENT_VALUES / 3; ++i) {
        coefficients[3 * i + k] *= query.irradiance[k];
      }
    }
    return WLK_SUCCESS;
  });
}
