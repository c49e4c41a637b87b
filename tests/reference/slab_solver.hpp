// SPDX-License-Identifier: MIT
// Radiance and fluxes of a homogeneous plane-parallel slab that scatters light any number of
// times, by discrete ordinates: per unit irradiance normal to the beam, depths optical.
//
// Directions: mu0 > 0 is the cosine of the sun's zenith angle, the beam travels down. A view has
// the cosine mu of its direction of travel with the upward normal: mu > 0 is light that leaves
// upwards through the top (depth 0), mu < 0 light that leaves downwards through the bottom. phi is
// the azimuth between the view's direction of travel and the beam's, radians: phi = 0 with
// mu = -mu0 looks into the sun, and cos(scattering angle) = -mu mu0 + sin sin cos(phi).
// Order 1 is light scattered once, or reflected once by the surface.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace welkin::reference {

// A phase function normalised to 1 over the sphere, twice: chi_l = integral of P P_l, and 1/sr at
// y = 1 - cos(scattering angle).
struct SlabPhase {
  std::vector<double> moments;
  std::function<double(double)> value;
};

// Henyey and Greenstein 1941; g = 0 is isotropic. Moments down to 1e-16.
SlabPhase henyeyGreensteinSlabPhase(double g);
// 3 / (16 pi) (1 + cos^2).
SlabPhase rayleighSlabPhase();
// The series of the moments is the phase function.
SlabPhase momentSlabPhase(std::vector<double> moments);
// Lines in 1 - cos between the angles (rad, 0 first, pi last), divided by their integral.
// `count` moments, to 1e-10 or better.
SlabPhase tabulatedSlabPhase(const std::vector<double>& angle, std::vector<double> value,
                             int count);

struct SlabView {
  static constexpr double FACE = -1;  // top for mu > 0, bottom for mu < 0
  double mu;
  double phi;
  double depth = FACE;
};

struct SlabRadiance {
  double total;   // all orders, without the direct beam
  double single;  // order 1
};

// Through a horizontal plane, over the irradiance normal to the beam: for a slab that absorbs
// nothing over a black surface, up(0) + down(tau) + direct(tau) = mu0.
struct SlabFlux {
  double up;
  double down;  // diffuse
  double direct;
};

class SlabSolver {
 public:
  // `nodes` directions per hemisphere (double Gauss, and 14 more near the horizon) and as many
  // moments. Phase functions with more lose their forward peak to delta-M (Wiscombe 1977); order 1
  // is exact then too (Nakajima and Tanaka 1988, TMS), and the peak's own multiple scattering is
  // added in the small-angle limit (their IMS, to all orders, and for light that comes back). Error
  // for droplets of 20 um with 16 nodes 2e-3, with 64 1e-3, in the beam's direction too.
  SlabSolver(SlabPhase phase, double albedo, int nodes = 48);
  ~SlabSolver();
  SlabSolver(SlabSolver&&) noexcept;

  // tau in [1e-6, 1e6]; surface: albedo of a Lambertian surface below.
  std::vector<SlabRadiance> radiance(double tau, double mu0, std::span<const SlabView> views,
                                     double surface = 0) const;
  SlabRadiance radiance(double tau, double mu0, const SlabView& view, double surface = 0) const {
    return radiance(tau, mu0, std::span(&view, 1), surface).front();
  }
  SlabFlux flux(double tau, double mu0, double depth, double surface = 0) const;

  // The same lit by radiance 1 from all directions above, over a black surface. `total` and `down`
  // include what passes without scattering; `single` and `direct` are 0.
  std::vector<SlabRadiance> diffuseRadiance(double tau, std::span<const SlabView> views) const;
  SlabFlux diffuseFlux(double tau, double depth) const;

 private:
  struct Modes;
  std::unique_ptr<Modes> modes_;
};

}  // namespace welkin::reference
