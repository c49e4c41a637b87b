// SPDX-License-Identifier: MIT
// A homogeneous slab that absorbs nothing, and one scattering in it: from Legendre moments of the
// radiance in azimuth modes to the source, from there to the radiance along given directions.
// Depths and lengths optical. No Vulkan.
//
// With displacement z = x + i y of the light since it came in through the top, three fields obey
// the same transport: I; M = integral of z over I, whose source has sin e^(i phi) I besides; and R
// = integral of |z|^2, whose source has 2 Re(conj(sin e^(i phi)) M). The two extra sources are
// integrated in closed form along each stretch. Modes: I = sum over all m of I_m e^(i m phi), I_-m
// = I_m, R likewise, M_m and M_-m differ; all real, since the slab is a mirror image of itself.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "tables/slab_steps.hpp"

namespace welkin {

constexpr size_t SLAB_LANES = 4;  // suns that are followed together

// Directions of one hemisphere with all that a sweep needs; downwards first.
struct SlabDirections {
  std::vector<double> mu;                      // > 0
  std::vector<double> weight;                  // of the integral over [0, 1]; 0 for a view
  std::vector<std::vector<double>> legendre;   // [m][(l - m) * mu.size() + i], normalised
  std::vector<std::array<SlabStep, 2>> steps;  // [i * cells + cell][first half, second half]
};

// Moments f_l of each mode, [l - m][depth][lane].
struct SlabMoments {
  int modes = -1;                              // highest m
  std::vector<std::vector<double>> intensity;  // [m]
  std::vector<std::vector<double>> shift;      // [modes + m], m from -modes
  std::vector<std::vector<double>> spread;     // [m]
};

// One mode's source and radiance in all directions, [down, up][direction][depth][lane].
struct SlabRays {
  std::vector<double> source;
  std::vector<double> light;
};

enum class SlabField { Intensity, Shift, Spread };
// Light arrives mode by mode. `before` are the fields that its extra source is made of, in order:
// for Shift that of I; for Spread the sum of two of M, and of I. Null where there is none.
struct SlabModeRays {
  SlabField field;
  int m;
  const SlabRays* rays;
  std::array<const SlabRays*, 3> before;
};
using SlabVisitor = std::function<void(const SlabModeRays&)>;

class SlabMedium {
 public:
  // `moments`: chi_l of a phase function of integral 1. `nodes` directions per hemisphere, Gauss.
  SlabMedium(std::vector<double> moments, double thickness, size_t nodes = 32, double fineness = 1);

  double thickness() const { return depth_.back(); }
  const std::vector<double>& depth() const { return depth_; }
  const std::vector<double>& moments() const { return moments_; }
  const SlabDirections& nodes() const { return nodes_; }
  SlabDirections directions(std::vector<double> mu, std::vector<double> weight) const;

  // Light of the next order along `directions`, for modes up to those of `from`.
  void sweep(const SlabMoments& from, const SlabDirections& directions,
             const SlabVisitor& visit) const;
  // Its moments.
  SlabMoments scatter(const SlabMoments& from) const;
  // Adds the moments of one mode's light in the nodes.
  void project(const SlabModeRays& mode, SlabMoments& to) const;

  SlabMoments zeros(int modes) const;
  std::vector<double>& part(SlabMoments& moments, SlabField field, int m) const;
  const std::vector<double>& part(const SlabMoments& moments, SlabField field, int m) const;

 private:
  void sources(const SlabMoments& from, SlabField field, int m, const SlabDirections& directions,
               SlabRays& rays) const;
  void integrate(const SlabDirections& directions, const SlabModeRays& mode, SlabRays& rays) const;

  std::vector<double> moments_;
  std::vector<double> depth_;
  SlabDirections nodes_;
};

// out[r] = sum over c of coefficient[r * columns + c] in[c], rows of `count` numbers, a multiple of
// 4, `stride` apart in `in` and `outStride` in `out`.
void combineRows(std::span<const double> coefficient, size_t columns, const double* in,
                 size_t stride, double* out, size_t outStride, size_t count);

// sqrt((l - m)! / (l + m)!) P_l^m(mu), l = m .. m + result.size() - 1, without the sign (-1)^m.
void slabLegendre(int m, double mu, std::span<double> result);

}  // namespace welkin
