// SPDX-License-Identifier: MIT
// Quadrature in long double, and the flat-Earth integral of [R04] Eq. 14 by it.
#pragma once

#include <vector>

namespace welkin::reference {

// Gauss-Legendre rule on [0, 1].
struct GaussRule {
  std::vector<long double> node;
  std::vector<long double> weight;
};

// Nodes by Newton's method on the Legendre recurrence; exact to a few 1e-19.
GaussRule gaussLegendre(int count);

// Arguments of [R04] Eq. 14, in 1/m and m.
struct FlatRay {
  long double extinction;          // beta at the eye
  long double inverseScaleHeight;  // gamma
  long double viewSlope;           // p
  long double lightSlope;          // l > 0
  long double distance;            // K, may be infinite
};

// beta e^(-gamma p t) integrated over [0, K].
long double flatOpticalDepth(const FlatRay& ray);

// Integral over t in [0, K] of beta e^(-gamma p t) exp(-tau(t)) exp(-beta e^(-gamma p t) /
// (gamma l)). Panels graded towards both ends and at every scale height along the ray, 8 or 22
// nodes each; relative error about 1e-15 (1e-16 against the closed form where that is regular).
long double flatInscatter(const FlatRay& ray);

}  // namespace welkin::reference
