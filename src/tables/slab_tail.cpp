// SPDX-License-Identifier: MIT
#include "tables/slab_tail.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace welkin {
namespace {

constexpr size_t LOW = 4;  // Legendre moments of the dense matrix

// In place, rows of `n`.
void factoriseMatrix(std::vector<double>& a, std::vector<size_t>& pivot) {
  const size_t n = pivot.size();
  for (size_t k = 0; k < n; ++k) {
    size_t best = k;
    for (size_t i = k + 1; i < n; ++i) {
      best = std::abs(a[i * n + k]) > std::abs(a[best * n + k]) ? i : best;
    }
    pivot[k] = best;
    if (best != k) {
      std::swap_ranges(&a[k * n], &a[k * n] + n, &a[best * n]);
    }
    const double* const row = &a[k * n];
    for (size_t i = k + 1; i < n; ++i) {
      double* const here = &a[i * n];
      const double factor = here[k] / row[k];
      here[k] = factor;
      for (size_t j = k + 1; j < n; ++j) {
        here[j] -= factor * row[j];
      }
    }
  }
}

void solveFactorised(const std::vector<double>& a, const std::vector<size_t>& pivot,
                     std::vector<double>& x) {
  const size_t n = pivot.size();
  for (size_t k = 0; k < n; ++k) {
    std::swap(x[k], x[pivot[k]]);
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < i; ++j) {
      x[i] -= a[i * n + j] * x[j];
    }
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t j = i + 1; j < n; ++j) {
      x[i] -= a[i * n + j] * x[j];
    }
    x[i] /= a[i * n + i];
  }
}

template <typename Visit>
void forEachPart(int modes, Visit visit) {
  for (int m = -modes; m <= modes; ++m) {
    visit(SlabField::Shift, m);
    if (m >= 0) {
      visit(SlabField::Intensity, m);
      visit(SlabField::Spread, m);
    }
  }
}

}  // namespace

SlabTail::SlabTail(const SlabMedium& medium, int modes) : medium_(medium) {
  const int most = std::min(modes, static_cast<int>(medium.moments().size()) - 1);
  for (int m = 0; m <= most; ++m) {
    factorise(m);
  }
}

void SlabTail::factorise(int m) {
  const auto order = static_cast<size_t>(m);
  const auto& chi = medium_.moments();
  const SlabDirections& nodes = medium_.nodes();
  const size_t depths = medium_.depth().size();
  const size_t cells = depths / 2;
  const size_t count = nodes.mu.size();
  const size_t low = std::min(LOW, chi.size() - order);
  const size_t size = low * depths;
  Factors& factors = factors_.emplace_back();
  std::vector<double>& a = factors.matrix;
  a.assign(size * size, 0);
  factors.pivot.resize(size);
  std::vector<double> response(depths * depths);  // downward light at k of a source 1 at j
  for (size_t i = 0; i < count; ++i) {
    std::fill(response.begin(), response.end(), 0.0);
    for (size_t k = 0; k + 1 < depths; ++k) {
      const SlabStep& step = nodes.steps[i * cells + k / 2][k % 2];
      double* const end = &response[(k + 1) * depths];
      for (size_t j = 0; j < depths; ++j) {
        end[j] = step.decay * response[k * depths + j];
      }
      end[k + 1] += step.weight[0][0];
      end[k] += step.weight[0][1];
      end[k % 2 == 0 ? k + 2 : k - 1] += step.weight[0][2];
    }
    for (size_t l = 0; l < low; ++l) {
      for (size_t n = 0; n < low; ++n) {
        const double down = nodes.weight[i] * nodes.legendre[order][l * count + i] *
                            (static_cast<double>(n + order) + 0.5) * chi[n + order] *
                            nodes.legendre[order][n * count + i];
        const double up = (l + n) % 2 == 0 ? down : -down;
        for (size_t k = 0; k < depths; ++k) {
          double* const row = &a[(l * depths + k) * size + n * depths];
          const double* const below = &response[k * depths];
          const double* const above = &response[(depths - 1 - k) * depths];
          for (size_t j = 0; j < depths; ++j) {  // upwards: the mirror image
            row[j] -= down * below[j] + up * above[depths - 1 - j];
          }
        }
      }
    }
  }
  for (size_t i = 0; i < size; ++i) {
    a[i * size + i] += 1;
  }
  factoriseMatrix(a, factors.pivot);
}

// Adds what the residual asks for.
void SlabTail::correct(const SlabMoments& residual, SlabMoments& to) const {
  forEachPart(to.modes, [&](SlabField field, int m) {
    const std::vector<double>& r = medium_.part(residual, field, m);
    std::vector<double>& sum = medium_.part(to, field, m);
    const auto order = static_cast<size_t>(std::abs(m));
    size_t solved = 0;
    if (order < factors_.size()) {
      const Factors& factors = factors_[order];
      solved = factors.pivot.size() * SLAB_LANES;
      std::vector<double> x(factors.pivot.size());
      for (size_t lane = 0; lane < SLAB_LANES; ++lane) {
        for (size_t i = 0; i < x.size(); ++i) {
          x[i] = r[i * SLAB_LANES + lane];
        }
        solveFactorised(factors.matrix, factors.pivot, x);
        for (size_t i = 0; i < x.size(); ++i) {
          sum[i * SLAB_LANES + lane] += x[i];
        }
      }
    }
    for (size_t i = solved; i < r.size(); ++i) {
      sum[i] += r[i];
    }
  });
}

SlabTail::Result SlabTail::solve(const SlabMoments& first, double tolerance, int maxSteps) const {
  Result result;
  result.sum = medium_.zeros(first.modes);
  SlabMoments residual = first;
  for (result.steps = 0; result.steps < maxSteps; ++result.steps) {
    correct(residual, result.sum);
    residual = medium_.scatter(result.sum);
    result.residual = 0;
    std::array<std::array<double, SLAB_LANES>, 3> wrong{};
    std::array<std::array<double, SLAB_LANES>, 3> most{};
    forEachPart(first.modes, [&](SlabField field, int m) {
      std::vector<double>& r = medium_.part(residual, field, m);
      const std::vector<double>& f = medium_.part(first, field, m);
      const std::vector<double>& sum = medium_.part(result.sum, field, m);
      auto& worst = wrong[static_cast<size_t>(field)];
      auto& largest = most[static_cast<size_t>(field)];
      for (size_t i = 0; i < r.size(); ++i) {
        r[i] += f[i] - sum[i];
        const size_t lane = i % SLAB_LANES;
        worst[lane] = std::max(worst[lane], std::abs(r[i]));
        largest[lane] = std::max(largest[lane], std::abs(sum[i]));
      }
    });
    for (size_t field = 0; field < 3; ++field) {
      for (size_t lane = 0; lane < SLAB_LANES; ++lane) {
        if (most[field][lane] > 0) {
          result.residual = std::max(result.residual, wrong[field][lane] / most[field][lane]);
        }
      }
    }
    if (result.residual < tolerance) {
      ++result.steps;
      break;
    }
  }
  return result;
}

}  // namespace welkin
