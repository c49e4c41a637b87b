// SPDX-License-Identifier: MIT
// Zenith angles by which light from all directions is summed. Cosines; weights sum to 2.
#pragma once

#include <cmath>
#include <vector>

#include "tables/gauss_rule.hpp"

namespace welkin {

struct Zenith {
  double cosine;
  double weight;
};

inline std::vector<Zenith> gaussNodes(int count) {
  const GaussRule rule = gaussRule(static_cast<size_t>(count));
  std::vector<Zenith> nodes;
  for (size_t i = 0; i < rule.node.size(); ++i) {
    nodes.push_back({rule.node[i], rule.weight[i]});
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
