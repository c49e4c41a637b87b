// SPDX-License-Identifier: MIT
// Light in air and fog over a round planet that has been scattered or reflected at least once: its
// directional moments by altitude and sun, per unit irradiance of the light. They are all that a
// phase function of two Legendre terms needs for the source of every further scattering, so one
// small table serves every camera and every sun. Successive orders; no Vulkan. Along a ray that is
// looked at, fog scatters with sixteen terms: FogLight.
//
// Frame of the moments at a point: y up, x horizontal towards the light's azimuth. Directions point
// to where light comes from.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "model/evaluate.hpp"
#include "tables/fog_light.hpp"

namespace welkin {

using SkyColor = std::array<double, 3>;

struct SkyFieldInput {
  AirInput air;
  // Legendre moments 1 to 16 of the fog's phase function. For the moments of light the third is
  // taken for its forward peak, which counts as unscattered (delta-M, Wiscombe 1977), so that two
  // terms are left; along a ray that is looked at the sixteenth.
  std::array<SkyColor, FOG_TERMS> fogMoments{};
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

struct SkyPlace;

class SkyField {
 public:
  static constexpr size_t ALTITUDES = 32;
  static constexpr size_t SUNS = 48;
  // xx, yy, zz, xy: integral of L w w^T over the sphere; x, y: of L w. 1/sr times sr.
  static constexpr size_t MOMENTS = 6;
  using Moments = std::array<SkyColor, MOMENTS>;
  // Along a ray that is looked at.
  static constexpr int EYE_STEPS = 48;

  // `air` as the moments see it, with the fog's forward peak taken out.
  const AirInput& air() const { return air_; }
  Moments momentsAt(double altitude, double sunMu) const;
  // Diffuse light on horizontal ground at sea level.
  SkyColor irradianceAt(double sunMu) const;
  int orders() const { return orders_; }
  // What GPU passes gather by: the air as the eye sees it, the share of the fog's peak that it does
  // not see, what fog scatters (null without fog), and the tables themselves:
  // [altitude][sun][moment][4 colours] and [sun][4 colours].
  const AirInput& eyeAir() const { return eye_; }
  double eyePeak() const { return eyePeak_; }
  const FogLight* fogLight() const { return fogLight_.get(); }
  // Largest value of the fog's phase function without the eye's part of its peak, RGB, 1/sr.
  const SkyColor& fogBound() const { return fogBound_; }
  void boundFogPhase(const SkyColor& bound) { fogBound_ = bound; }
  const std::vector<float>& moments() const { return moments_; }
  const std::vector<float>& irradiance() const { return irradiance_; }
  // Highest altitude of the moments.
  double top() const;
  // Of the light's irradiance, what the fog turns within its peak on the way: it is not in the
  // moments, and comes from the light's direction as near as they can tell.
  SkyColor peakIrradianceAt(double altitude, double sunMu) const;

  // What a ray brings, 1/sr: light that air and fog send along it on the way, and what its end on
  // the ground sends through them.
  struct Parts {
    SkyColor air{};
    SkyColor ground{};
  };
  // Of light scattered or reflected at least twice that comes along a ray of `distance` m (may be
  // infinite). fogPhase: RGB, 1/sr, at the ray's angle with the light. Light of the ground that the
  // fog turns within its peak is the air's part.
  Parts higherOrders(double altitude, double viewMu, double sunMu, double viewSun, double distance,
                     const SkyColor& fogPhase) const;
  // Both parts.
  SkyColor higherOrdersAlong(double altitude, double viewMu, double sunMu, double viewSun,
                             double distance, const SkyColor& fogPhase) const;
  // The same without light that the fog turned only within its peak but once, neither on its way to
  // the ray nor on the ray.
  SkyColor radianceAlong(double altitude, double viewMu, double sunMu, double viewSun,
                         double distance, int steps = EYE_STEPS) const;

 private:
  friend class SkyFieldSolver;

  Parts gatheredAlong(double altitude, double viewMu, double sunMu, double viewSun, double distance,
                      int steps) const;
  SkyColor fogSourceAt(double altitude, const SkyPlace& place, double viewSun) const;
  // First order along a ray that ends at `distance`.
  struct Once {
    SkyColor radiance;
    SkyColor depth;
  };
  Once onceAlong(const AirInput& air, double altitude, double viewMu, double sunMu, double viewSun,
                 double distance, const SkyColor& phase) const;
  // What the ground sends where the cosine of the light is sunMu: all but diffuse light, which the
  // fog may have turned within its peak, and the part that nothing has turned.
  struct Lit {
    SkyColor straight;
    SkyColor unscattered;
  };
  Lit groundAt(double sunMu) const;

  AirInput air_;  // without the peak
  AirInput eye_;  // without the part of the peak that counts as unscattered where it is looked at
  AirInput attenuated_;  // scatters like eye_, attenuates by all of the fog
  double lightAngularRadius_ = 0;
  double peak_ = 0;
  double eyePeak_ = 0;
  SkyColor fogBound_{};
  std::array<SkyColor, 2> fogMoments_{};  // without the peak
  std::shared_ptr<const FogLight> fogLight_;
  SkyColor groundAlbedo_{};
  int orders_ = 0;
  std::vector<float> moments_;     // [altitude][sun][moment][channel]
  std::vector<float> irradiance_;  // [sun][channel]
};

SkyField solveSkyField(const SkyFieldInput& input, const SkyFieldSteps& steps = {});

}  // namespace welkin
