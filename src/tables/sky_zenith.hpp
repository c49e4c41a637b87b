// SPDX-License-Identifier: MIT
// Zenith angles by which light from all directions is summed. Cosines; weights sum to 2.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace welkin {

struct Zenith {
  double cosine;
  double weight;
};

// Gauss-Legendre nodes on 0 to 1, by Newton's iteration from the usual guess.
inline std::vector<Zenith> gaussNodes(int count) {
  std::vector<Zenith> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int k = 0; k < 50; ++k) {
      double p0 = 1;
      double p1 = x;
      for (int l = 2; l <= count; ++l) {
        const double p2 = ((2 * l - 1) * x * p1 - (l - 1) * p0) / l;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    nodes.push_back({0.5 + 0.5 * x, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

// Above and below the horizon, nodes in the square root of the distance from it: radiance changes
// fastest there.
inline std::vector<Zenith> zenithNodes(double horizon, const std::vector<Zenith>& gauss) {
  std::vector<Zenith> nodes;
  for (const Zenith& node : gauss) {
    const double s = node.cosine;
    for (const double end : {1.0, -1.0}) {
      const double span = end - horizon;
      nodes.push_back({horizon + span * s * s, node.weight * 2 * s * std::abs(span)});
    }
  }
  return nodes;
}

}  // namespace welkin
