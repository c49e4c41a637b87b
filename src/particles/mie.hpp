// SPDX-License-Identifier: MIT
// Lorenz-Mie scattering of a plane wave by a homogeneous sphere; amplitudes and efficiencies are
// dimensionless. No Vulkan.
// [BH83] Bohren and Huffman 1983, chapter 4; [W80] Wiscombe 1980, Appl. Opt. 19, 1505.
// Convention of [BH83]: time factor exp(-i omega t), refractive index m = n + i k relative to the
// surrounding medium, k >= 0 absorbs ([W80] writes n - i k and the conjugate amplitudes).
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace welkin {

struct MieEfficiencies {
  double extinction = 0;   // cross-section / (pi r^2)
  double scattering = 0;   // the same
  double backscatter = 0;  // 4 pi dC/dOmega at 180 degrees / (pi r^2), [BH83] section 4.6
  double asymmetry = 0;    // mean cosine; 0 when nothing is scattered
};

// Scattering angles, prepared for MieSphere: each is folded onto [0, pi/2] and kept as
// y = 1 - cos(angle) = 2 sin^2(angle / 2), exact at both ends. Angles in rad, [0, pi].
class MieAngles {
 public:
  static constexpr size_t LANES = 16;

  MieAngles() = default;
  explicit MieAngles(std::span<const double> angles) { assign(angles); }
  void assign(std::span<const double> angles);  // keeps its memory
  size_t size() const { return order_.size(); }

 private:
  friend class MieSphere;
  std::vector<double> folded_;  // y; forward angles, then backward ones, each padded to LANES
  std::vector<size_t> order_;   // position in folded_ of each angle
  size_t backward_ = 0;         // where the backward angles begin
};

// Coefficients (Re, Im) of p_n = pi_n + tau_n and of q_n = pi_n - tau_n in the two sums that make
// S1 + S2 and S1 - S2, then n and (n + 1) / n.
using MieTerm = std::array<double, 6>;

// The series of one sphere. solve() keeps its memory, so that one object serves many sizes.
class MieSphere {
 public:
  // x = 2 pi r / wavelength, tested from 0.01 to 20 000; m as above. a_n and b_n are those of an x
  // and an m within 64 roundings of the arguments, plus 16 (Mie.CoefficientsMatch...); the series
  // ends where |a_n| < 3e-7, which bounds the error of an intensity at any angle by 4e-6 of itself.
  void solve(double x, std::complex<double> m);

  MieEfficiencies efficiencies() const;

  // (|S1|^2 + |S2|^2) / 2 at each angle, unpolarised light: dC/dOmega = intensity / k^2 and the
  // phase function is intensity / (pi x^2 Qsca).
  void intensities(const MieAngles& angles, std::span<double> result) const;

  // S1 (perpendicular) and S2 (parallel) of [BH83] Eq. 4.74.
  void amplitudes(const MieAngles& angles, std::span<std::complex<double>> s1,
                  std::span<std::complex<double>> s2) const;

  // a_n = a()[n - 1], b likewise.
  const std::vector<std::complex<double>>& a() const { return a_; }
  const std::vector<std::complex<double>>& b() const { return b_; }

 private:
  void coefficients(std::complex<double> m);
  void sums(const MieAngles& angles, size_t block, double* result) const;

  double x_ = 0;
  std::vector<std::complex<double>> a_, b_;
  std::vector<MieTerm> forward_, backward_;
  std::vector<double> outside_;               // D_n(x)
  std::vector<std::complex<double>> inside_;  // D_n(m x)
};

}  // namespace welkin
