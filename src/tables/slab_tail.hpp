// SPDX-License-Identifier: MIT
// Light of all further orders in a slab in one solution: F = f + K F, K one scattering. No Vulkan.
//
// In a thick slab K's largest eigenvalues are close to 1, and their fields are those of diffusion:
// few Legendre moments, smooth in depth. Those moments are solved by a dense matrix of the same
// discretisation, the others by the iteration itself, which shrinks them by chi_l each time.
#pragma once

#include <vector>

#include "tables/slab_medium.hpp"

namespace welkin {

class SlabTail {
 public:
  explicit SlabTail(const SlabMedium& medium, int modes = 5);
  const SlabMedium& medium() const { return medium_; }

  struct Result {
    SlabMoments sum;
    double residual = 0;  // |f + K F - F| over |F|, largest values, worst field and lane
    int steps = 0;
  };
  Result solve(const SlabMoments& first, double tolerance = 1e-7, int maxSteps = 200) const;

 private:
  struct Factors {
    std::vector<double> matrix;
    std::vector<size_t> pivot;
  };
  void factorise(int m);
  void correct(const SlabMoments& residual, SlabMoments& to) const;

  const SlabMedium& medium_;
  std::vector<Factors> factors_;  // of 1 - K among the lowest moments, [m]
};

}  // namespace welkin
