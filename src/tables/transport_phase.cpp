// SPDX-License-Identifier: MIT
// Phase functions in 1/sr for the transport of light in thick volumes, by Legendre moments. With
// this normalisation of Y_lm (sum over m of Y_lm(a) Y_lm(b) = (2 l + 1) P_l(a b)) the pair of two
// phase functions is
//   sum over L of chi'_L b_L Y_Lm(v),  b_L = integral of P'(w s) Y_lm(w) Y_Lm(w),
// and products of harmonics of l <= 2 take b_L from chi'_(L-2) .. chi'_(L+2): [DLMF 14.10.3] for
// mu P_L and, with 14.10.5, (1 - mu^2) P_L' = L (L + 1) / (2 L + 1) (P_(L-1) - P_(L+1)).
#include "tables/transport_phase.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tables/angular_moments.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double INV_4PI = 0.25 * std::numbers::inv_pi;
constexpr double PEAK_EDGE = PI / 9;   // 20 degrees
constexpr double LEAST_REST = 1e-9;    // share of the light that still has a shape
constexpr double DROPPED = 1e-7;       // 1/sr, the sum of all terms left out
constexpr double FLOOR = 1e-20;        // 1/sr, as sourceRows
constexpr double PAIR_DROPPED = 1e-5;  // of isotropic light
// Halos end at 2304; what has not ended is smoothed by 0.12 degrees, a tenth of the nodes'
// distance.
constexpr size_t PAIR_TERMS = 2560;

using Moments = std::vector<double>;

double squared(double value) {
  return value * value;
}

// min(P, P(20 degrees)) within 20 degrees, P beyond.
std::vector<double> withoutPeak(const PhaseCurve& curve, size_t channel) {
  const double edge = 2 * squared(std::sin(PEAK_EDGE / 2));
  const double level = evalPhaseCurve(curve, channel, edge);
  std::vector<double> rest = curve.value[channel];
  for (size_t i = 0; i < rest.size() && curve.y[i] < edge; ++i) {
    rest[i] = std::min(rest[i], level);
  }
  return rest;
}

std::vector<double> peakOf(const PhaseCurve& curve, size_t channel) {
  std::vector<double> peak = withoutPeak(curve, channel);
  std::transform(curve.value[channel].begin(), curve.value[channel].end(), peak.begin(),
                 peak.begin(), std::minus<>());
  return peak;
}

// Of k = 1, 2, ... turns by the peak, each with weight x^k / (k + 1)!.
double severalTurns(double x, double peak, double f) {
  const double turns = x * peak;
  if (std::abs(turns) < 1e-2) {
    return std::exp(-x * f) * peak * turns * (1.0 / 2 + turns * (1.0 / 6 + turns / 24));
  }
  return -std::exp(-x * (f - peak)) * std::expm1(-turns) / x - std::exp(-x * f) * peak;
}

// Of the blurred light without what no peak has turned, e^(-x f) P.
Moments turnedMoments(const Moments& chi, const Moments& peak, double x) {
  Moments result = chi;
  for (size_t l = 0; l < chi.size(); ++l) {
    const double f = peak[0];
    result[l] = (chi[l] - peak[l]) * -std::exp(-x * (f - peak[l])) * std::expm1(-x * peak[l]) +
                severalTurns(x, peak[l], f);
  }
  return result;
}

// Coefficients of P_l in 1/sr. |P_l| <= 1: the terms dropped add up to less than DROPPED.
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

// ln of once P + series, the series clamped (it is positive but for rounding) and scaled to its
// integral between the nodes, as sourceRows does.
void writeRow(std::span<const double> y, std::span<const double> p, double once, double integral,
              std::span<double> series, float* result) {
  for (double& value : series) {
    value = std::max(value, 0.0);
  }
  const double total = sphereIntegral(y, series);
  const double scale = total > 0 ? integral / total : 0;
  for (size_t j = 0; j < p.size(); ++j) {
    result[j] = static_cast<float>(std::log(std::max(once * p[j] + scale * series[j], FLOOR)));
  }
}

void channelRows(const PhaseCurve& curve, size_t channel, float* result) {
  const std::vector<double>& p = curve.value[channel];
  const Moments chi = scatteringMoments(curve.y, p);
  Moments peak(chi.size());
  legendreMoments(curve.y, peakOf(curve, channel), peak);
  std::vector<std::vector<double>> series;
  std::vector<double> once;
  std::vector<double> integral;
  for (size_t row = 0; row < kPhaseDepths; ++row) {
    const double x = depthNode(static_cast<double>(row) / (kPhaseDepths - 1));
    once.push_back(std::exp(-x * peak[0]));
    Moments turned = turnedMoments(chi, peak, x);
    integral.push_back(turned[0]);
    series.push_back(seriesOf(std::move(turned)));
  }
  const size_t angles = curve.y.size();
  std::vector<double> sums(series.size() * angles);
  legendreSums(curve.y, series, sums);
  for (size_t row = 0; row < kPhaseDepths; ++row) {
    writeRow(curve.y, p, once[row], integral[row], std::span(sums).subspan(row * angles, angles),
             result + row * angles);
  }
}

// Moments of mu P, and integrals of P (1 - mu^2) P_L' over the sphere.
Moments timesCosine(const Moments& chi) {
  Moments result(chi.size());
  for (size_t l = 0; l < chi.size(); ++l) {
    const auto order = static_cast<double>(l);
    const double above = l + 1 < chi.size() ? chi[l + 1] : 0;
    const double below = l > 0 ? chi[l - 1] : 0;
    result[l] = ((order + 1) * above + order * below) / (2 * order + 1);
  }
  return result;
}

Moments timesSlope(const Moments& chi) {
  Moments result(chi.size());
  for (size_t l = 1; l < chi.size(); ++l) {
    const auto order = static_cast<double>(l);
    const double above = l + 1 < chi.size() ? chi[l + 1] : 0;
    result[l] = order * (order + 1) / (2 * order + 1) * (chi[l - 1] - above);
  }
  return result;
}

// Y_lm = harmonicNorm P_l^m cos(m azimuth).
double harmonicNorm(size_t l, size_t m) {
  double ratio = static_cast<double>(2 * l + 1) * (m > 0 ? 2 : 1);
  for (size_t k = l - m + 1; k <= l + m; ++k) {
    ratio /= static_cast<double>(k);
  }
  return std::sqrt(ratio);
}

// Integrals of P P_l^m P_L^m over polar angles for all L, l <= 2. (1 - mu^2)^2 P_L'' is (1 - mu^2)
// (2 mu P_L' - L (L + 1) P_L), Legendre's equation.
Moments polarProducts(const Moments& chi, size_t l, size_t m) {
  const Moments first = timesCosine(chi);
  Moments result = l == 0 ? chi : m == 1 ? timesSlope(l == 1 ? chi : first) : first;
  if (l < 2) {
    return result;
  }
  const Moments second = timesCosine(first);
  const Moments slope = timesSlope(first);
  for (size_t k = 0; k < chi.size(); ++k) {
    const auto order = static_cast<double>(k);
    result[k] = m == 0   ? 1.5 * second[k] - 0.5 * chi[k]
                : m == 1 ? 3 * result[k]
                         : 3 * (2 * slope[k] - order * (order + 1) * (chi[k] - second[k]));
  }
  return result;
}

// b_L of all L; 0 for L < m.
Moments productMoments(const Moments& chi, size_t l, size_t m) {
  Moments result = polarProducts(chi, l, m);
  const double mean = m > 0 ? 0.5 : 1;  // of cos^2(m azimuth)
  for (size_t k = 0; k < result.size(); ++k) {
    result[k] = k < m ? 0 : result[k] * mean * harmonicNorm(l, m) * harmonicNorm(k, m);
  }
  return result;
}

// Steps Y_Lm of azimuth 0 upwards from L = m, where they are stable: Y_L = a_L (mu Y_(L-1) -
// Y_(L-2) / a_(L-1)), a_L^2 = (4 L^2 - 1) / (L^2 - m^2).
std::vector<double> recurrenceOf(size_t m, size_t count) {
  std::vector<double> a(count);
  for (size_t l = m + 1; l < count; ++l) {
    const double square = squared(static_cast<double>(l));
    a[l] = std::sqrt((4 * square - 1) / (square - squared(static_cast<double>(m))));
  }
  return a;
}

void harmonics(size_t m, double theta, const std::vector<double>& a, std::vector<double>& values) {
  const double mu = std::cos(theta);
  const double sine = std::sin(theta);
  std::fill(values.begin(), values.end(), 0.0);
  values[m] = m == 0 ? 1 : m == 1 ? std::sqrt(3.0) * sine : std::sqrt(15.0) / 2 * sine * sine;
  for (size_t l = m + 1; l < values.size(); ++l) {
    const double before = l > m + 1 ? values[l - 2] / a[l - 1] : 0;
    values[l] = a[l] * (mu * values[l - 1] - before);
  }
}

std::vector<double> mixture(std::span<const TransportPhase* const> media,
                            std::span<const double> weights, size_t channel) {
  std::vector<double> result(media[0]->y.size());
  for (size_t k = 0; k < media.size(); ++k) {
    for (size_t i = 0; i < result.size(); ++i) {
      result[i] += weights[k] * media[k]->rest[channel][i];
    }
  }
  return result;
}

// chi'_L b_L, the coefficients of Y_Lm, b_L with the moments of what came before. |Y_Lm|^2 <= 2 L +
// 1, so that what is dropped adds up to less than PAIR_DROPPED.
Moments pairSeries(const Moments& chi, const Moments& before, size_t l, size_t m) {
  Moments series = productMoments(before, l, m);
  std::transform(chi.begin(), chi.end(), series.begin(), series.begin(), std::multiplies<>());
  double rest = 0;
  while (!series.empty() &&
         (rest += std::abs(series.back()) * std::sqrt(static_cast<double>(2 * series.size() - 1))) <
             PAIR_DROPPED) {
    series.pop_back();
  }
  return series;
}

// Of one function for all channels.
void writeResponse(size_t l, size_t m, const std::array<Moments, SOURCE_CHANNELS>& chi,
                   const std::array<Moments, SOURCE_CHANNELS>& before, float* response) {
  std::array<Moments, SOURCE_CHANNELS> series;
  size_t count = m + 1;
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    series[c] = pairSeries(chi[c], before[c], l, m);
    count = std::max(count, series[c].size());
  }
  for (Moments& one : series) {
    one.resize(count);
  }
  const std::vector<double> a = recurrenceOf(m, count);
  std::vector<double> values(count);
  for (size_t node = 0; node < PAIR_NODES; ++node) {
    harmonics(m, PI * static_cast<double>(node) / (PAIR_NODES - 1), a, values);
    double sums[SOURCE_CHANNELS] = {};
    for (size_t k = m; k < count; ++k) {
      for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
        sums[c] += series[c][k] * values[k];
      }
    }
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      response[node * 4 + c] = static_cast<float>(sums[c]);
    }
  }
}

void firstMoments(const Moments& before, TransportPairs::Products& result) {
  for (size_t i = 0; i < TRANSPORT_FIRST; ++i) {
    for (size_t m = 0; m <= i; ++m) {
      const Moments product = productMoments(before, i, m);
      for (size_t l = m; l < TRANSPORT_MOMENTS; ++l) {
        result[l][i][m] = static_cast<float>(product[l]);
      }
    }
  }
}

// 4 pi P', linear in y, around the pair table's nodes: mean over samples between their neighbours'
// middles.
void writeOnce(const std::vector<double>& y, const std::vector<double>& p, float* result) {
  constexpr int SAMPLES = 16;
  for (size_t node = 0; node < PAIR_NODES; ++node) {
    double sum = 0;
    for (int i = 0; i < SAMPLES; ++i) {
      const double place = static_cast<double>(node) + (i + 0.5) / SAMPLES - 0.5;
      const double at = 2 * squared(std::sin(PI / 2 * place / (PAIR_NODES - 1)));
      const auto above = std::clamp<ptrdiff_t>(std::upper_bound(y.begin(), y.end(), at) - y.begin(),
                                               1, static_cast<ptrdiff_t>(y.size()) - 1);
      const auto k = static_cast<size_t>(above);
      const double part = (at - y[k - 1]) / (y[k] - y[k - 1]);
      sum += (1 - part) * p[k - 1] + part * p[k];
    }
    result[node * 4] = static_cast<float>(sum / (SAMPLES * INV_4PI));
  }
}

// Moments of the mean over the channels of P', which stands in `phase` already.
void fillMoments(TransportPhase& phase) {
  for (const std::vector<double>& rest : phase.rest) {
    Moments chi(TRANSPORT_MOMENTS + 1);
    legendreMoments(phase.y, rest, chi);
    for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
      phase.moments[l] += chi[l] / SOURCE_CHANNELS;
    }
    phase.fourth += chi[TRANSPORT_MOMENTS] / SOURCE_CHANNELS;
  }
}

// The part 1 - f that no peak has turned keeps its shape, so that no series has to follow it.
std::vector<double> turnedRest(const PhaseCurve& curve, size_t channel,
                               const std::vector<double>& rest) {
  Moments series = scatteringMoments(curve.y, rest, PAIR_TERMS);
  Moments peak(series.size());
  legendreMoments(curve.y, peakOf(curve, channel), peak);
  const double sharp = std::max(1 - peak[0], LEAST_REST);
  for (size_t l = 0; l < series.size(); ++l) {
    series[l] *= sharp * peak[l] / std::max(1 - peak[l], LEAST_REST);
  }
  const double integral = series[0];
  const std::vector<std::vector<double>> one = {seriesOf(std::move(series))};
  std::vector<double> result(rest.size());
  legendreSums(curve.y, one, result);
  for (double& value : result) {
    value = std::max(value, 0.0);
  }
  const double total = sphereIntegral(curve.y, result);
  const double scale = total > 0 ? integral / total : 0;
  for (size_t i = 0; i < rest.size(); ++i) {
    result[i] = sharp * rest[i] + scale * result[i];
  }
  return result;
}

}  // namespace

TransportPhase transportPhase(const PhaseCurve& curve) {
  TransportPhase result;
  result.y = curve.y;
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    std::vector<double>& rest = result.rest[c];
    rest = withoutPeak(curve, c);
    const double share = sphereIntegral(curve.y, rest);
    result.peak += sphereIntegral(curve.y, peakOf(curve, c)) / SOURCE_CHANNELS;
    for (double& value : rest) {
      value = share > LEAST_REST ? value / share : INV_4PI;
    }
  }
  fillMoments(result);
  return result;
}

TransportPhase turnedPhase(const PhaseCurve& curve, const TransportPhase& phase) {
  TransportPhase result;
  result.peak = phase.peak;
  result.y = phase.y;
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    const bool same = c > 0 && curve.value[c] == curve.value[c - 1];
    result.rest[c] = same ? result.rest[c - 1] : turnedRest(curve, c, phase.rest[c]);
  }
  fillMoments(result);
  return result;
}

SourceRows peakRows(const PhaseCurve& curve) {
  SourceRows rows;
  rows.angles = curve.y.size();
  const size_t size = kPhaseDepths * rows.angles;
  rows.logSource.resize(SOURCE_CHANNELS * size);
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    float* const here = &rows.logSource[c * size];
    if (c > 0 && curve.value[c] == curve.value[c - 1]) {
      std::copy_n(here - size, size, here);
    } else {
      channelRows(curve, c, here);
    }
  }
  return rows;
}

TransportPairs transportPairs(std::span<const TransportPhase* const> media,
                              std::span<const double> weights) {
  TransportPairs pairs;
  pairs.response.resize(2 * PAIR_FUNCTIONS * PAIR_NODES * 4);
  const std::vector<double>& y = media[0]->y;
  std::array<std::vector<double>, SOURCE_CHANNELS> p;
  std::array<Moments, SOURCE_CHANNELS> chi;
  Moments mean(TRANSPORT_MOMENTS + TRANSPORT_FIRST);
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    p[c] = mixture(media, weights, c);
    chi[c] = c > 0 && p[c] == p[c - 1] ? chi[c - 1] : scatteringMoments(y, p[c], PAIR_TERMS);
    Moments exact(mean.size());  // not smoothed
    legendreMoments(y, p[c], exact);
    for (size_t l = 0; l < mean.size(); ++l) {
      mean[l] += exact[l] / SOURCE_CHANNELS;
    }
  }
  pairs.once.resize(PAIR_NODES * 4);
  for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
    writeOnce(y, p[c], &pairs.once[c]);
  }
  std::array<Moments, SOURCE_CHANNELS> twice = chi;
  for (Moments& moments : twice) {
    std::transform(moments.begin(), moments.end(), moments.begin(), squared);
  }
  size_t function = 0;
  for (size_t l = 0; l < TRANSPORT_FIRST; ++l) {
    for (size_t m = 0; m <= l; ++m, ++function) {
      writeResponse(l, m, chi, chi, &pairs.response[function * PAIR_NODES * 4]);
      writeResponse(l, m, chi, twice,
                    &pairs.response[(PAIR_FUNCTIONS + function) * PAIR_NODES * 4]);
    }
  }
  // The mean of the squares is not the square of the mean where colours differ: a few 1e-4 of it.
  Moments square = mean;
  std::transform(mean.begin(), mean.end(), square.begin(), squared);
  firstMoments(mean, pairs.first);
  firstMoments(square, pairs.second);
  return pairs;
}

}  // namespace welkin
