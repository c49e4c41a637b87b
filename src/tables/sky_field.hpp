// SPDX-License-Identifier: MIT
// Light in air and fog over a round planet that has been scattered or reflected at least once: its
// directional moments by altitude and sun, per unit irradiance of the light. They are all that a
// phase function of two Legendre terms needs for the source of every further scattering, so one
// small table serves every camera and every sun. Successive orders; no Vulkan.
//
// Frame of the moments at a point: y up, x horizontal towards the light's azimuth. Directions point
// to where light comes from.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/evaluate.hpp"

namespace welkin {

using SkyColor = std::array<double, 3>;

struct SkyFieldInput {
  AirInput air;
  // Legendre moments 1 to 3 of the fog's phase function. The third is taken for its forward peak,
  // which counts as unscattered (delta-M, Wiscombe 1977): what is left has no more than two terms.
  std::array<SkyColor, 3> fogMoments{};
  SkyColor groundAlbedo{};
  double lightAngularRadius = 0.00466;

  bool operator==(const SkyFieldInput&) const = default;
};

// How finely the orders are gathered. In clear air with suns from 10 degrees up, twice the zenith
// nodes change the result by at most 0.6 %, three times the steps by 0.8 %, more azimuths by less.
struct SkyFieldSteps {
  int zenithNodes = 6;  // above and below the horizon each
  int azimuths = 8;     // around the whole circle, even
  int steps = 20;       // along a ray
  int maxOrders = 64;
};

class SkyField {
 public:
  static constexpr size_t ALTITUDES = 32;
  static constexpr size_t SUNS = 48;
  // xx, yy, zz, xy: integral of L w w^T over the sphere; x, y: of L w. 1/sr times sr.
  static constexpr size_t MOMENTS = 6;
  using Moments = std::array<SkyColor, MOMENTS>;

  // `air` as the moments see it, with the fog's forward peak taken out.
  const AirInput& air() const { return air_; }
  Moments momentsAt(double altitude, double sunMu) const;
  // Diffuse light on horizontal ground at sea level.
  SkyColor irradianceAt(double sunMu) const;
  int orders() const { return orders_; }
  // Highest altitude of the moments.
  double top() const;
  // Of the light's irradiance, what the fog turns within its peak on the way: it is not in the
  // moments, and comes from the light's direction as near as they can tell.
  SkyColor peakIrradianceAt(double altitude, double sunMu) const;

  // Radiance, 1/sr, of light scattered or reflected at least twice that comes along a ray of
  // `distance` m (may be infinite), and from the ground if the ray ends there. fogPhase: RGB, 1/sr,
  // at the ray's angle with the light.
  SkyColor higherOrdersAlong(double altitude, double viewMu, double sunMu, double viewSun,
                             double distance, const SkyColor& fogPhase) const;
  // The same from the moments alone: without light that the fog turned only within its peak but
  // once, neither on its way to the ray nor on the ray.
  SkyColor radianceAlong(double altitude, double viewMu, double sunMu, double viewSun,
                         double distance, int steps = 48) const;

 private:
  friend SkyField solveSkyField(const SkyFieldInput& input, const SkyFieldSteps& steps);

  // First order and light of the ground along a ray that ends at `distance`, in air of which
  // `peak` is taken off the fog's phase function.
  struct Once {
    SkyColor radiance;
    SkyColor depth;
  };
  Once onceAlong(const AirInput& air, double altitude, double viewMu, double sunMu, double viewSun,
                 double distance, const SkyColor& phase) const;

  AirInput air_;  // without the peak
  // Along a ray that is looked at, only a part of the peak counts as unscattered: eyeShare().
  AirInput eye_;
  AirInput attenuated_;  // scatters like eye_, attenuates by all of the fog
  double lightAngularRadius_ = 0;
  double peak_ = 0;
  double eyePeak_ = 0;
  std::array<SkyColor, 2> fogMoments_{};  // without the peak
  std::array<SkyColor, 2> eyeMoments_{};
  SkyColor groundAlbedo_{};
  int orders_ = 0;
  std::vector<float> moments_;     // [altitude][sun][moment][channel]
  std::vector<float> irradiance_;  // [sun][channel]
};

SkyField solveSkyField(const SkyFieldInput& input, const SkyFieldSteps& steps = {});

}  // namespace welkin
