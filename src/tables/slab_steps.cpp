// SPDX-License-Identifier: MIT
#include "tables/slab_steps.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr double FIRST_WIDTH = 0.002;  // light with cosine 0.01 falls by 1/5 in the first half cell
constexpr double GROWTH = 0.3;         // of the width per depth below the face
constexpr double WIDEST = 0.5;         // where the nearer face is not far
constexpr double DEEP_GROWTH = 0.05;   // there light is nearly linear in depth
constexpr double SERIES = 1.5;         // below it the series, above it the recurrence

}  // namespace

std::array<double, 5> decayMoments(double x) {
  std::array<double, 5> result{};
  if (x < SERIES) {
    for (size_t p = 0; p < result.size(); ++p) {
      double term = 1;
      for (int k = 0; k < 30; ++k) {
        result[p] += term / static_cast<double>(p + 1 + static_cast<size_t>(k));
        term *= -x / (k + 1);
      }
    }
    return result;
  }
  const double last = std::exp(-x);
  result[0] = -std::expm1(-x) / x;
  for (size_t p = 1; p < result.size(); ++p) {
    result[p] = (static_cast<double>(p) * result[p - 1] - last) / x;
  }
  return result;
}

std::vector<double> slabDepths(double thickness, double fineness) {
  // Widths from the face to the middle, then scaled to fit.
  std::vector<double> edges = {0};
  const double half = thickness / 2;
  const double first = std::min(FIRST_WIDTH, half / 4);
  while (edges.back() < half) {
    const double x = edges.back();
    const double width = std::min(first + GROWTH * x, WIDEST + DEEP_GROWTH * x);
    edges.push_back(x + width / fineness);
  }
  const double scale = half / edges.back();
  std::vector<double> cells;
  cells.reserve(2 * edges.size());
  for (const double edge : edges) {
    cells.push_back(edge * scale);
  }
  for (size_t i = edges.size() - 1; i-- > 0;) {
    cells.push_back(thickness - edges[i] * scale);
  }
  std::vector<double> depths = {0};
  for (size_t i = 1; i < cells.size(); ++i) {
    depths.push_back((cells[i - 1] + cells[i]) / 2);
    depths.push_back(cells[i]);
  }
  return depths;
}

SlabStep slabStep(double length, const std::array<double, 3>& node) {
  SlabStep step;
  step.length = length;
  step.decay = std::exp(-length);
  const std::array<double, 5> phi = decayMoments(length);
  // Lagrange's parabolas.
  double power = length;
  for (size_t p = 0; p < 3; ++p, power *= length) {
    for (size_t j = 0; j < 3; ++j) {
      const double a = node[(j + 1) % 3];
      const double b = node[(j + 2) % 3];
      const double scale = 1 / ((node[j] - a) * (node[j] - b));
      step.weight[p][j] = power * scale * (a * b * phi[p] - (a + b) * phi[p + 1] + phi[p + 2]);
    }
  }
  return step;
}

}  // namespace welkin
