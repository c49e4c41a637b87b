// SPDX-License-Identifier: MIT
// Radiance of a homogeneous slab in the multiple-scattering model of [R04] 4.2, as printed and as
// corrected, for any phase function: per unit irradiance normal to the beam, as slab_solver.hpp.
//
// Both follow light that goes forward. n = albedo times the optical depth that the light has come
// through; Ams_n, with moments chi_l^n, is its distribution after n scatterings and F_n the part of
// that in the forward hemisphere.
//   printed (Eq. 24 to 26): whole numbers of scatterings, ceil(n + 1), at most 26; intensity and
//     radiance by sums over `slices` slices; xi, which the paper leaves to the user, is 0.
//   corrected: a Poisson count of mean n, so that moments become chi_l e^(-n (1 - chi_l)),
//     dI/dtau = -(1 - albedo F(n)) I, and the integral along the view ray instead of a sum.
// Quadrature here; the corrected one is what forward_slab.hpp has for Henyey-Greenstein.
#pragma once

#include <array>
#include <vector>

#include "reference/slab_solver.hpp"

namespace welkin::reference {

class SlabModel {
 public:
  static constexpr int ORDERS = 26;  // [R04] 4.2.1: the last convolution that it keeps

  // `deepest`: largest optical depth of any light path that will be asked for.
  SlabModel(SlabPhase phase, double albedo, double deepest);

  // F_n of exactly n scatterings, 1 <= n <= ORDERS.
  double forwardInteger(int n) const { return forwardInteger_[static_cast<std::size_t>(n - 1)]; }

  // Ams_n(y) and the corrected source P(n, y) at every depth node, for one scattering angle.
  struct Angle {
    std::array<double, ORDERS> integer;
    std::vector<double> logSource;
  };
  Angle prepare(double y) const;

  // Views as in slab_solver.hpp, at the faces.
  double corrected(double tau, double mu0, double mu, const Angle& angle) const;
  enum class Attenuation { EQ_24, EQ_25 };
  // Slices cut the longer one of the light's and the view's way into `slices` steps, the same
  // optical depth along both, as half-angle slices do.
  double printed(double tau, double mu0, double mu, const Angle& angle, Attenuation attenuation,
                 int slices) const;

  // Intensity in the light buffer after the depth `path`, in steps of `step`.
  std::vector<double> lightBuffer(double path, double step, Attenuation attenuation) const;

 private:
  double intensity(double path) const;
  double source(double path, const Angle& angle) const;

  SlabPhase phase_;
  double albedo_;
  std::array<double, ORDERS> forwardInteger_{};
  // Nodes even in ln(1 + depth), between which ln P is linear.
  double nodesPerLog_;
  std::vector<double> depth_;
  std::vector<double> logIntensity_;
  std::vector<double> loss_;              // 1 - albedo F at the nodes
  std::vector<double> scatteredMoments_;  // node by node: of the source without e^-n P
};

}  // namespace welkin::reference
