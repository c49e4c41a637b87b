// SPDX-License-Identifier: MIT
// Paths from the point against the light, at each collision the light of all suns.
#include "reference/slab_collector.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "reference/random.hpp"
#include "reference/vector.hpp"

namespace welkin::reference {
namespace {

constexpr size_t BATCHES = 32;  // errors are those of their means

struct Sums {
  double light = 0, x = 0, y = 0, square = 0;
};

Sums total(const std::vector<Sums>& sums, size_t first, size_t step) {
  Sums all;
  for (size_t i = first; i < sums.size(); i += step) {
    all.light += sums[i].light;
    all.x += sums[i].x;
    all.y += sums[i].y;
    all.square += sums[i].square;
  }
  return all;
}

CollectorEstimate meansOf(const Sums& sums, double samples) {
  CollectorEstimate result{};
  result.radiance = sums.light / samples;
  if (sums.light > 0) {
    result.x = sums.x / sums.light;
    result.y = sums.y / sums.light;
    result.width = std::sqrt(
        std::fmax(sums.square / sums.light - result.x * result.x - result.y * result.y, 0));
  }
  return result;
}

}  // namespace

std::vector<CollectorEstimate> slabCollectors(const CollectorView& view, const PhaseFunction& phase,
                                              std::span<const double> suns,
                                              std::span<const int> orders, uint64_t samples,
                                              uint64_t seed) {
  const size_t cells = suns.size() * orders.size();
  std::vector<Sums> sums(BATCHES * cells);
  const double sine = std::sqrt((1 - view.mu) * (1 + view.mu));
  // z downwards; the path runs against the light.
  const Point start = {-sine * std::cos(view.phi), -sine * std::sin(view.phi), -view.mu};
  const double reach =
      (view.mu > 0 ? view.depth : view.thickness - view.depth) / std::fabs(view.mu);
  const double meets = -std::expm1(-reach);
  std::vector<Point> beam;
  for (const double mu0 : suns) {
    beam.push_back({std::sqrt((1 - mu0) * (1 + mu0)), 0, mu0});
  }
  for (uint64_t sample = 0; sample < samples; ++sample) {
    Random random(seed, 0, sample, 9);
    Sums* const batch = &sums[sample % BATCHES * cells];
    Point direction = start;
    // The first collision lies within the slab, at a weight.
    Point at = along({0, 0, view.depth}, start, -std::log1p(-random.uniform() * meets));
    size_t set = 0;
    for (int order = 1; at[2] >= 0 && at[2] <= view.thickness; ++order) {
      while (set + 1 < orders.size() && order >= orders[set + 1]) {
        ++set;
      }
      if (order >= orders[set]) {
        const Point travels = {-direction[0], -direction[1], -direction[2]};
        for (size_t s = 0; s < suns.size(); ++s) {
          const double value =
              meets * phase.value(0, oneMinusCosine(travels, beam[s])) * std::exp(-at[2] / suns[s]);
          const double x = at[0] - at[2] * beam[s][0] / suns[s];
          Sums& sum = batch[s * orders.size() + set];
          sum.light += value;
          sum.x += value * x;
          sum.y += value * at[1];
          sum.square += value * (x * x + at[1] * at[1]);
        }
      }
      const double y = phase.sample(0, random.uniform());
      direction = deflected(direction, y, 2 * std::numbers::pi * random.uniform());
      at = along(at, direction, random.exponential());
    }
  }
  std::vector<CollectorEstimate> result;
  for (size_t cell = 0; cell < cells; ++cell) {
    CollectorEstimate mean = meansOf(total(sums, cell, cells), static_cast<double>(samples));
    double light = 0;
    double shift = 0;
    double width = 0;
    for (size_t b = 0; b < BATCHES; ++b) {
      const CollectorEstimate one =
          meansOf(sums[b * cells + cell], static_cast<double>(samples) / BATCHES);
      light += (one.radiance - mean.radiance) * (one.radiance - mean.radiance);
      shift += (one.x - mean.x) * (one.x - mean.x) + (one.y - mean.y) * (one.y - mean.y);
      width += (one.width - mean.width) * (one.width - mean.width);
    }
    const double scale = 1.0 / (BATCHES * (BATCHES - 1));
    mean.radianceError = std::sqrt(light * scale);
    mean.shiftError = std::sqrt(shift * scale);
    mean.widthError = std::sqrt(width * scale);
    result.push_back(mean);
  }
  return result;
}

}  // namespace welkin::reference
