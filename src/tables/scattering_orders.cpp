// SPDX-License-Identifier: MIT
// Distributions of light scattered many times, in 1/sr, as Legendre series of the moments chi_l of
// one scattering (Funk-Hecke: n scatterings have chi_l^n).
//
// Rewritten, why: the series of light scattered once needs the most terms, and truncated it rings
// below zero at half of all angles. So the curve itself stands for it, and the series only holds
// what was scattered twice or more, whose moments fall like chi_l^2:
//   source at depth n   e^-n P + sum (2 l + 1) / (4 pi) chi_l (e^(-n (1 - chi_l)) - e^-n) P_l
//   scattered at tau    w P + sum (2 l + 1) / (4 pi) (e^(tau chi_l) - 1 - tau chi_l) / (e^tau - 1)
//                       P_l,  w = tau / (e^tau - 1), the share of one scattering
// Both sums are positive functions; what rounding leaves below zero is set to it.
#include "tables/scattering_orders.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tables/angular_moments.hpp"

namespace welkin {
namespace {

constexpr double INV_4PI = 0.25 * std::numbers::inv_pi;
constexpr double DROPPED = 1e-9;  // 1/sr, the sum of all terms left out
constexpr double FLOOR = 1e-20;   // 1/sr

using Curve = std::span<const double>;
using Moments = std::vector<double>;

// The series of given moments in 1/sr: |P_l| <= 1, so that the terms dropped at its end add up to
// less than DROPPED at any angle.
std::vector<double> seriesOf(Moments moments) {
  for (size_t l = 0; l < moments.size(); ++l) {
    moments[l] *= INV_4PI * static_cast<double>(2 * l + 1);
  }
  double rest = 0;
  while (!moments.empty() && (rest += std::abs(moments.back())) < DROPPED) {
    moments.pop_back();
  }
  return moments;
}

Moments powers(const Moments& chi, int n) {
  Moments result = chi;
  for (double& one : result) {
    one = std::pow(one, n);
  }
  return result;
}

// Of the source at depth n without its first part, e^-n P.
Moments sourceMoments(const Moments& chi, double n) {
  Moments result = chi;
  for (double& one : result) {
    one *= -std::exp(-n * (1 - one)) * std::expm1(-n * one);
  }
  return result;
}

// (e^x - 1 - x) e^-tau, x = tau chi.
double twiceOrMore(double x, double tau) {
  if (std::abs(x) < 0.01) {  // the next term of the series is below 1e-12 of it
    return std::exp(-tau) * x * x / 2 *
           (1 + x / 3 * (1 + x / 4 * (1 + x / 5 * (1 + x / 6 * (1 + x / 7)))));
  }
  return std::exp(x - tau) - std::exp(-tau) * (1 + x);
}

// Of the light scattered twice or more, over all scattered light.
Moments poissonMoments(const Moments& chi, double tau) {
  Moments result = chi;
  for (double& one : result) {
    one = twiceOrMore(tau * one, tau) / -std::expm1(-tau);
  }
  return result;
}

// tau / (e^tau - 1) without overflow.
double onceOf(double tau) {
  return tau > 0 ? tau * std::exp(-tau) / -std::expm1(-tau) : 1;
}

// The part of given moments in the forward hemisphere.
double forwardPart(const Moments& moments) {
  return forwardFractionInteger(std::span<const double>(moments), 1);
}

std::vector<double> sums(Curve at, const std::vector<double>& series) {
  std::vector<double> result(at.size());
  legendreSums(at, std::span(&series, 1), result);
  return result;
}

// A row before it is summed up.
struct Row {
  double once = 0;      // share of the curve
  double multiple = 0;  // integral of the series
};

double clampedIntegral(Curve y, std::span<const double> values) {
  std::vector<double> positive(values.begin(), values.end());
  for (double& one : positive) {
    one = std::max(one, 0.0);
  }
  return sphereIntegral(y, positive);
}

// A series known at the nodes and linear in between has a little more energy than its first moment
// says, 2e-4 for droplets of 50 um. Divided out, as the caller did with the curve.
void writeRow(Curve y, Curve p, const Row& row, std::span<const double> series, float* result) {
  const double scale = row.multiple > 0 ? row.multiple / clampedIntegral(y, series) : 0;
  for (size_t j = 0; j < p.size(); ++j) {
    const double value = row.once * p[j] + scale * std::max(series[j], 0.0);
    result[j] = static_cast<float>(std::log(std::max(value, FLOOR)));
  }
}

// Scatterings of the source at depth n, [R04]'s count. Depths are rounded: 64 + 1e-14 is 64.
int integerCount(double n) {
  return static_cast<int>(std::ceil(n - 1e-9)) + 1;
}

}  // namespace

void scatteredInteger(std::span<const double> y, std::span<const double> p, int n,
                      std::span<const double> at, std::span<double> result) {
  if (n <= 1) {
    std::transform(at.begin(), at.end(), result.begin(),
                   [&](double one) { return curveValue(y, p, one); });
    return;
  }
  const std::vector<double> series = seriesOf(powers(scatteringMoments(y, p), n));
  // The series has integral 1; clamping adds to it, no more than it drops. Compared at the nodes.
  const std::vector<double> plain = sums(y, series);
  const double total = clampedIntegral(y, plain) / sphereIntegral(y, plain);
  const std::vector<double> values = sums(at, series);
  for (size_t i = 0; i < at.size(); ++i) {
    result[i] = std::max(values[i], 0.0) / total;
  }
}

double forwardFractionInteger(std::span<const double> y, std::span<const double> p, int n) {
  return n <= 1 ? hemisphereIntegral(y, p) : forwardPart(powers(scatteringMoments(y, p), n));
}

void scatteredPoisson(std::span<const double> y, std::span<const double> p, double tau,
                      std::span<const double> at, std::span<double> result) {
  std::vector<double> values(at.size());
  if (tau > 0) {
    values = sums(at, seriesOf(poissonMoments(scatteringMoments(y, p), tau)));
  }
  const double once = onceOf(tau);
  for (size_t i = 0; i < at.size(); ++i) {
    result[i] = once * curveValue(y, p, at[i]) + std::max(values[i], 0.0);
  }
}

double forwardFractionPoisson(std::span<const double> y, std::span<const double> p, double tau) {
  const double once = hemisphereIntegral(y, p);
  return tau > 0 ? onceOf(tau) * once + forwardPart(poissonMoments(scatteringMoments(y, p), tau))
                 : once;
}

SourceRows sourceRows(std::span<const double> y,
                      const std::array<std::span<const double>, SOURCE_CHANNELS>& p,
                      SourceForm form) {
  SourceRows rows;
  rows.angles = y.size();
  rows.logSource.resize(SOURCE_CHANNELS * kPhaseDepths * y.size());
  std::vector<std::vector<double>> series;
  std::vector<Row> parts;
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    const Moments chi = scatteringMoments(y, p[c]);
    const double once = hemisphereIntegral(y, p[c]);
    for (size_t i = 0; i < kPhaseDepths; ++i) {
      const double n = depthNode(static_cast<double>(i) / (kPhaseDepths - 1));
      const int count = integerCount(n);
      Moments moments;
      Row row{1};
      if (form == SourceForm::Poisson) {
        row.once = std::exp(-n);
        moments = sourceMoments(chi, n);
      } else if (count > 1) {
        row.once = 0;
        moments = powers(chi, count);
      }
      rows.forwardFraction[c][i] = static_cast<float>(row.once * once + forwardPart(moments));
      row.multiple = moments.empty() ? 0 : moments.front();
      series.push_back(seriesOf(std::move(moments)));
      parts.push_back(row);
    }
  }
  std::vector<double> values(series.size() * y.size());
  legendreSums(y, series, values);
  for (size_t i = 0; i < series.size(); ++i) {
    const auto value = std::span(values).subspan(i * y.size(), y.size());
    writeRow(y, p[i / kPhaseDepths], parts[i], value, &rows.logSource[i * y.size()]);
  }
  return rows;
}

SourceRows closedSourceRows(std::span<const double> y, const FogPhaseParams& phase) {
  SourceRows rows;
  rows.angles = y.size();
  rows.logSource.resize(SOURCE_CHANNELS * kPhaseDepths * rows.angles);
  std::vector<double> source(rows.angles);
  for (size_t row = 0; row < kPhaseDepths; ++row) {
    const double n = depthNode(static_cast<double>(row) / (kPhaseDepths - 1));
    const double forward = sourceDistributions(phase, n, y, source);
    for (size_t channel = 0; channel < SOURCE_CHANNELS; ++channel) {
      rows.forwardFraction[channel][row] = static_cast<float>(forward);
      for (size_t i = 0; i < rows.angles; ++i) {
        rows.logSource[(channel * kPhaseDepths + row) * rows.angles + i] =
            static_cast<float>(std::log(std::max(source[i], 1e-20)));
      }
    }
  }
  return rows;
}

}  // namespace welkin
