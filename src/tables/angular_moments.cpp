// SPDX-License-Identifier: MIT
// Moments of a piecewise linear curve, dimensionless. Integrated by parts twice, the moments see
// only the kinks of the curve:
//   chi_l = 2 pi sum_j K_j J_l(y_j),  K_j = change of slope dp/dy at node j, J_l'' = P_l,
//   J_l = (1 - mu^2)^2 P_l''(mu) / ((l - 1) l (l + 1) (l + 2)) = (y (2 - y))^2 / 8 R_(l-2)(mu)
// for l >= 2, which vanishes at both ends with its slope. R_n is the Gegenbauer polynomial
// C_n^(5/2) / C_n^(5/2)(1), [DLMF 18.9.1] with that normalisation:
//   (n + 4) R_n = (2 n + 3) mu R_(n-1) - (n - 1) R_(n-2),  |R_n| <= 1,
// stepped by differences, (n + 4) (R_n - R_(n-1)) = (n - 1) (R_(n-1) - R_(n-2)) - (2 n + 3) y
// R_(n-1), because rounding 1 - y would cost n^2 2^-54; P_l likewise.
// Rewritten, why: P_(l+1) - P_(l-1) per cell, as textbooks integrate P_l, cancels at tiny cells:
// its rounding is divided by the cell's width, 3e-11. Here a kink near either end meets its own
// y^2, and there is no small cell to be treated apart.
#include "tables/angular_moments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double TWO_PI = 2 * std::numbers::pi;
constexpr size_t LANES = 16;   // angles side by side: what the compiler vectorises
constexpr size_t CHUNK = 128;  // orders of 16 angles in 16 KB: they stay in the first cache

// Moments one after the other, from l = 2.
class MomentSequence {
 public:
  MomentSequence(std::span<const double> y, std::span<const double> p);
  double next();

 private:
  std::vector<double> y_, weight_, r_, step_;  // per kink, padded to LANES
  double order_ = 0;                           // n = l - 2
};

MomentSequence::MomentSequence(std::span<const double> y, std::span<const double> p) {
  const size_t kinks = y.size() < 2 ? 0 : y.size() - 2;
  const size_t padded = (kinks + LANES - 1) / LANES * LANES;
  y_.assign(padded, 0.0);
  weight_.assign(padded, 0.0);
  r_.assign(padded, 1.0);
  step_.assign(padded, 0.0);
  for (size_t i = 0; i < kinks; ++i) {
    const double left = (p[i + 1] - p[i]) / (y[i + 1] - y[i]);
    const double right = (p[i + 2] - p[i + 1]) / (y[i + 2] - y[i + 1]);
    const double square = y[i + 1] * (2 - y[i + 1]);
    y_[i] = y[i + 1];
    weight_[i] = TWO_PI / 8 * (right - left) * square * square;
  }
}

double MomentSequence::next() {
  const double n = order_ + 1;
  const double a = (2 * n + 3) / (n + 4);
  const double b = (n - 1) / (n + 4);
  double sums[LANES] = {};
  for (size_t i = 0; i < y_.size(); i += LANES) {
    double* const r = &r_[i];
    double* const step = &step_[i];
    const double* const y = &y_[i];
    const double* const weight = &weight_[i];
    for (size_t k = 0; k < LANES; ++k) {
      const double now = r[k];
      sums[k] += weight[k] * now;
      step[k] = b * step[k] - a * y[k] * now;
      r[k] = now + step[k];
    }
  }
  order_ = n;
  double sum = 0;
  for (const double one : sums) {
    sum += one;
  }
  return sum;
}

// Integral of the curve over y from 0 to `end`, times 2 pi.
double integral(std::span<const double> y, std::span<const double> p, double end) {
  double sum = 0;
  for (size_t i = 0; i + 1 < y.size() && y[i] < end; ++i) {
    const double width = std::min(y[i + 1], end) - y[i];
    const double slope = (p[i + 1] - p[i]) / (y[i + 1] - y[i]);
    const double last = y[i + 1] <= end ? p[i + 1] : p[i] + slope * width;
    sum += width * (p[i] + last);
  }
  return TWO_PI / 2 * sum;
}

double firstMoment(std::span<const double> y, std::span<const double> p) {
  double loss = 0;  // of y p, which keeps the digits of 1 - g
  for (size_t i = 0; i + 1 < y.size(); ++i) {
    loss +=
        (y[i + 1] - y[i]) / 6 * (p[i] * (2 * y[i] + y[i + 1]) + p[i + 1] * (y[i] + 2 * y[i + 1]));
  }
  return sphereIntegral(y, p) - TWO_PI * loss;
}

// P_l of 16 angles in the order they are asked for.
struct LegendreBlock {
  double y[LANES];
  double p[LANES];
  double step[LANES];
  double order = 0;

  void next(double* values) {
    const double a = (2 * order + 1) / (order + 1);
    const double b = order / (order + 1);
    for (size_t k = 0; k < LANES; ++k) {
      const double now = p[k];
      values[k] = now;
      step[k] = b * step[k] - a * y[k] * now;
      p[k] = now + step[k];
    }
    order += 1;
  }
};

void addChunk(const double* values, std::span<const double> terms, double* sums) {
  double local[LANES];
  std::copy_n(sums, LANES, local);
  for (size_t l = 0; l < terms.size(); ++l) {
    for (size_t k = 0; k < LANES; ++k) {
      local[k] += terms[l] * values[l * LANES + k];
    }
  }
  std::copy_n(local, LANES, sums);
}

}  // namespace

double sphereIntegral(std::span<const double> y, std::span<const double> p) {
  return integral(y, p, 2);
}

double hemisphereIntegral(std::span<const double> y, std::span<const double> p) {
  return integral(y, p, 1);
}

double cutLevel(std::span<const double> y, std::span<const double> p, double share) {
  // What lies above a level, exact for straight pieces.
  const auto above = [&](double level) {
    double sum = 0;
    for (size_t i = 0; i + 1 < y.size(); ++i) {
      const double a = p[i] - level;
      const double b = p[i + 1] - level;
      const double length = y[i + 1] - y[i];
      if (a > 0 && b > 0) {
        sum += 0.5 * length * (a + b);
      } else if (a > 0 || b > 0) {
        const double high = std::max(a, b);
        sum += 0.5 * length * high * high / (std::max(a, b) - std::min(a, b));
      }
    }
    return 2 * std::numbers::pi * sum;
  };
  double low = 0;
  double high = *std::max_element(p.begin(), p.end());
  if (above(low) < share) {
    return 0;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (above(middle) > share ? low : high) = middle;
  }
  return low;
}

double curveValue(std::span<const double> y, std::span<const double> p, double at) {
  const auto above = std::upper_bound(y.begin() + 1, y.end() - 1, at);
  const auto i = static_cast<size_t>(above - y.begin()) - 1;
  const double t = std::clamp((at - y[i]) / (y[i + 1] - y[i]), 0.0, 1.0);
  return (1 - t) * p[i] + t * p[i + 1];
}

void legendreMoments(std::span<const double> y, std::span<const double> p, std::span<double> chi) {
  MomentSequence sequence(y, p);
  for (size_t l = 0; l < chi.size(); ++l) {
    chi[l] = l == 0 ? sphereIntegral(y, p) : l == 1 ? firstMoment(y, p) : sequence.next();
  }
}

std::vector<double> scatteringMoments(std::span<const double> y, std::span<const double> p,
                                      size_t maxTerms) {
  constexpr double END = 1e-7;
  constexpr double SMOOTHED = 13.8;  // -ln 1e-6, what is left of the last moment
  MomentSequence sequence(y, p);
  std::vector<double> chi = {sphereIntegral(y, p), firstMoment(y, p)};
  double energy = 0;
  for (size_t l = 2; l < maxTerms; ++l) {
    chi.push_back(sequence.next());
    energy += static_cast<double>(2 * l + 1) * chi[l] * chi[l];
    if (l % CHUNK == CHUNK - 1) {
      if (energy < END) {
        return chi;
      }
      energy = 0;
    }
  }
  for (size_t l = 0; l < chi.size(); ++l) {
    const auto order = static_cast<double>(l);
    const auto end = static_cast<double>(chi.size());
    chi[l] *= std::exp(-SMOOTHED * order * (order + 1) / (end * end));
  }
  return chi;
}

void legendreSums(std::span<const double> y, std::span<const std::vector<double>> series,
                  std::span<double> sums) {
  size_t terms = 0;
  for (const std::vector<double>& one : series) {
    terms = std::max(terms, one.size());
  }
  std::vector<double> values(CHUNK * LANES);
  std::vector<double> local(series.size() * LANES);
  for (size_t first = 0; first < y.size(); first += LANES) {
    const size_t count = std::min(LANES, y.size() - first);
    LegendreBlock block;
    for (size_t k = 0; k < LANES; ++k) {
      block.y[k] = y[first + std::min(k, count - 1)];
      block.p[k] = 1;
      block.step[k] = 0;
    }
    std::fill(local.begin(), local.end(), 0.0);
    for (size_t begin = 0; begin < terms; begin += CHUNK) {
      const size_t end = std::min(begin + CHUNK, terms);
      for (size_t l = begin; l < end; ++l) {
        block.next(&values[(l - begin) * LANES]);
      }
      for (size_t s = 0; s < series.size(); ++s) {
        if (series[s].size() > begin) {
          const size_t here = std::min(end, series[s].size()) - begin;
          addChunk(values.data(), std::span(series[s]).subspan(begin, here), &local[s * LANES]);
        }
      }
    }
    for (size_t s = 0; s < series.size(); ++s) {
      std::copy_n(&local[s * LANES], count, &sums[s * y.size() + first]);
    }
  }
}

}  // namespace welkin
