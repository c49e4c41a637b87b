// SPDX-License-Identifier: MIT
// The light that reaches points of one altitude, for many directions of the light at once: model
// functions with what does not depend on the direction done once. From .cpp files only, like the
// model.
#pragma once

#include "model/model.hpp"
#include "tables/sky_fan.hpp"

namespace welkin {
namespace {

// An exponential layer at one altitude.
class LayerLight {
 public:
  LayerLight(double altitude, double base, double scaleHeight, double planetRadius)
      : scaleHeight_(scaleHeight),
        radius_(planetRadius + altitude),
        exponent_(model::f64::layerExponent(altitude, base, scaleHeight)),
        density_(model::f64::layerDensity(exponent_)),
        width_(std::sqrt(2 * radius_ * scaleHeight)) {}

  // layerColumn(), half of whose work is for lights below the horizontal only. m.
  double column(double mu) const {
    using namespace model::f64;
    return mu < 0 ? layerColumn(exponent_, density_, scaleHeight_, radius_, mu)
                  : SQRT_PI_HALF * width_ * density_ *
                        layerErfcx(radius_ * mu / width_, radius_, scaleHeight_);
  }

 private:
  double scaleHeight_;
  double radius_;
  double exponent_;
  double density_;
  double width_;
};

class LightAtAltitude {
 public:
  LightAtAltitude(const model::f64::Air& air, double altitude, double angularRadius)
      : air_(air),
        altitude_(altitude),
        angularRadius_(angularRadius),
        airLayer_(altitude, 0, air.airScaleHeight, air.planetRadius),
        fogLayer_(altitude, air.fogBaseAltitude, air.fogScaleHeight, air.planetRadius),
        absorbs_(air.absorption.x > 0 || air.absorption.y > 0 || air.absorption.z > 0) {
    // Sine of the height above the horizon from which lightVisibility() is 1 and below which, on
    // the other side, it is 0, with room for rounding. Above half a radian it has its own rules.
    const double edge = 1.01 * angularRadius + 1e-4;
    if (edge < 0.5) {
      const double horizon = std::acos(model::f64::horizonMu(altitude, air.planetRadius));
      dark_ = std::cos(std::min(horizon + std::asin(edge), std::numbers::pi));
      bright_ = std::cos(horizon - std::asin(edge));
    }
  }

  // Transmittance to the light times its visible part, for its cosines with the up.
  std::array<Lanes, SkyField::SUNS> at(const Suns& mu) const {
    std::array<Lanes, SkyField::SUNS> result{};
    std::array<size_t, SkyField::SUNS> lit;
    size_t count = 0;
    for (size_t s = 0; s < SkyField::SUNS; ++s) {
      lit[count] = s;
      count += static_cast<double>(mu[s]) < dark_ ? size_t{0} : size_t{1};
    }
    // Loops of their own, so that one light's chain of operations does not wait for another's.
    std::array<model::f64::vec3, SkyField::SUNS> columns;
    for (size_t i = 0; i < count; ++i) {
      columns[i].x = airLayer_.column(static_cast<double>(mu[lit[i]]));
      columns[i].y = 0;
      columns[i].z = 0;
    }
    if (air_.fogExtinction > 0) {
      for (size_t i = 0; i < count; ++i) {
        columns[i].y = fogLayer_.column(static_cast<double>(mu[lit[i]]));
      }
    }
    if (absorbs_) {
      for (size_t i = 0; i < count; ++i) {
        columns[i].z =
            model::f64::absorberColumnTo(altitude_, static_cast<double>(mu[lit[i]]),
                                         air_.planetRadius, air_.absorberPeak, air_.absorberWidth);
      }
    }
    for (size_t i = 0; i < count; ++i) {
      const auto one = static_cast<double>(mu[lit[i]]);
      const double visible =
          one > bright_ ? 1 : model::f64::lightVisibility(air_, altitude_, one, angularRadius_);
      const model::f64::vec3 depth = model::f64::depthOfColumns(air_, columns[i]);
      for (int c = 0; c < 3; ++c) {
        result[lit[i]][static_cast<size_t>(c)] =
            static_cast<float>(visible) * std::exp(static_cast<float>(-depth[c]));
      }
    }
    return result;
  }

 private:
  const model::f64::Air& air_;
  double altitude_;  // >= 0
  double angularRadius_;
  LayerLight airLayer_;
  LayerLight fogLayer_;
  bool absorbs_;
  // Cosines below and above which the light is hidden and seen as a whole.
  double dark_ = -2;
  double bright_ = 2;
};

}  // namespace
}  // namespace welkin
