// SPDX-License-Identifier: MIT
// Gauss-Legendre nodes and weights on [0, 1]: exact for polynomials of degree 2 count - 1.
#pragma once

#include <cstddef>
#include <vector>

namespace welkin {

struct GaussRule {
  std::vector<double> node;  // rising
  std::vector<double> weight;
};

GaussRule gaussRule(size_t count);

}  // namespace welkin
