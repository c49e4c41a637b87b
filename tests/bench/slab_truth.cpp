// SPDX-License-Identifier: MIT
// welkin_slab_truth SAMPLES: Monte Carlo truth of the canonical slab transport on standard output,
// columns as in its first line. tests/unit/canonical_truth.csv is
//   welkin_slab_truth 6000000 >tests/unit/canonical_truth.csv
#include <cstdio>
#include <cstdlib>

#include "reference/slab_collector.hpp"
#include "tables/canonical_phase.hpp"

namespace {

using namespace welkin;

constexpr double SUNS[] = {1, 0.85, 0.6, 0.35, 0.15, 0.05};
constexpr int ORDERS[] = {2, 3, 5, 7, 9, 13, 19, 31};
constexpr reference::CollectorView VIEWS[] = {
    {0.7, 0, -0.8, 2.2}, {0.7, 0.7, 0.6, 0.4}, {3, 0, -0.95, 1},   {3, 1, 0.7, 0.5},
    {3, 2, -0.3, 2.6},   {3, 3, 0.9, 1.7},     {10, 0, -0.5, 0.3}, {10, 2, 0.9, 0.8},
    {10, 5, 0.4, 1.2},   {10, 10, 0.8, 0.6},   {30, 0, -0.9, 1.5}, {30, 8, 0.6, 0.9},
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: welkin_slab_truth SAMPLES\n");
    return 2;
  }
  const CanonicalPhase cloud = canonicalPhase();
  std::vector<double> angle;
  std::vector<reference::Rgb> value;
  for (size_t i = 0; i < cloud.y.size(); ++i) {
    angle.push_back(2 * std::asin(std::sqrt(cloud.y[i] / 2)));
    value.push_back({cloud.value[i], cloud.value[i], cloud.value[i]});
  }
  const auto phase = reference::PhaseFunction::table(angle, value);
  std::printf(
      "thickness,depth,mu,phi,muLight,set,radiance,error,x,y,shiftError,width,widthError\n");
  uint64_t seed = 1;
  for (const reference::CollectorView& view : VIEWS) {
    const auto estimates = reference::slabCollectors(view, phase, SUNS, ORDERS,
                                                     std::strtoull(argv[1], nullptr, 10), seed++);
    for (size_t i = 0; i < estimates.size(); ++i) {
      const reference::CollectorEstimate& e = estimates[i];
      std::printf("%g,%g,%g,%g,%g,%zu,%.5g,%.2g,%.5g,%.5g,%.2g,%.5g,%.2g\n", view.thickness,
                  view.depth, view.mu, view.phi, SUNS[i / std::size(ORDERS)], i % std::size(ORDERS),
                  e.radiance, e.radianceError, e.x, e.y, e.shiftError, e.width, e.widthError);
    }
    std::fflush(stdout);
  }
  return 0;
}
