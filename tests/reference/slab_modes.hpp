// SPDX-License-Identifier: MIT
// One azimuth mode of the slab solver: the discrete-ordinate equations of a homogeneous slab in
// closed form, and integrals of their solutions along any direction. Radiance, depths optical.
//
// Sum s and difference d of the radiances that travel down and up in the nodes mu_i > 0 obey
// mu s' = -(1 - D-) d + q_d, mu d' = -(1 - D+) s + q_s, D+ and D- holding even and odd l - m. With
// x = sqrt(mu w) s and y = sqrt(mu w) d both matrices become symmetric, A- = L L^T, A+ = R^T R, and
// the singular values k of R L = U k V^T separate the equations: x = L V z, y = L^-T V t,
//   z' = -t + a e^(-p tau),  t' = -k^2 z + b e^(-p tau).
// Solutions are written with cosh(k t) and sinh(k t) / k around the slab's middle and with divided
// differences of exponentials, so that neither k = 0 (no absorption) nor p = k, nor a view along
// the beam, is a special case. Own derivation from the equation of transfer (Chandrasekhar 1950,
// VI); the symmetric form follows Nakajima and Tanaka 1986.
#pragma once

#include "reference/slab_matrix.hpp"

namespace welkin::reference {

// (1 - e^-x) / x.
double decayMean(double x);
// Divided differences of e^-x, positive: over two and three points, in any order and equal or not.
double decayDifference(double a, double b);
double decayDifference(double a, double b, double c);

// sqrt((l - m)! / (l + m)!) P_l^m(mu) for l = m .. m + result.size() - 1.
void legendreFunctions(int m, double mu, Vector& result);

// Directions of one hemisphere.
struct SlabNodes {
  Vector mu;
  Vector weight;
};

// What enters a slab from outside, and its coefficients in one mode.
struct SlabSolution {
  Vector even;
  Vector odd;
  Vector beamZ;  // factor of E(tau) = (e^(-k tau) - e^(-p tau)) / (p - k) in z
  Vector beamT;  // a
  double p = 0;  // 1 / mu0; 0 without a beam
};

class SlabMode {
 public:
  // `series`: albedo (2 l + 1) chi_l for l = 0 .. 2 nodes - 1; conservative: m = 0 and albedo 1.
  SlabMode(int m, const SlabNodes& nodes, const Vector& series, bool conservative);

  // Prepares for this thickness; kept until another is asked for.
  void setThickness(double tau);

  SlabSolution beam(double mu0) const;
  // Radiance 1 from all directions above, or below; m = 0.
  SlabSolution diffuse(bool above) const;

  // Radiance at `depth` that travels up or down along mu > 0, without what enters the slab from
  // outside and without the beam's first scattering.
  double radiance(const SlabSolution& solution, double mu, bool up, double depth) const;
  // Radiances in the nodes, first scattering and what enters included.
  void nodeRadiance(const SlabSolution& solution, double depth, Vector& down, Vector& up) const;

 private:
  struct Parts;
  Parts integrate(double k, double p, double q, bool up, double depth) const;
  SlabSolution solve(const Vector& top, const Vector& bottom) const;
  Vector sources(double mu, bool odd) const;

  int m_;
  const SlabNodes& nodes_;
  const Vector& series_;
  double tau_ = -1;
  Vector k_;
  Matrix x_;            // L V
  Matrix y_;            // L^-T V
  Matrix evenMoments_;  // of z in the terms l - m = 0, 2, ...
  Matrix oddMoments_;   // of t in the terms l - m = 1, 3, ...
  LinearSystem evenSystem_;
  LinearSystem oddSystem_;
};

}  // namespace welkin::reference
