// SPDX-License-Identifier: MIT
// Source distribution at scattering depth n: moments chi_l exp(-n (1 - chi_l)), in 1/sr.
//
// Rewritten, why: the Legendre series needs thousands of terms at g = 0.998, and truncated it rings
// below zero. With chi_l = (1 - w) h_l + w d_l (Henyey-Greenstein and Draine parts) the series
// splits exactly into three sums of positive functions:
//   exp(-n) P                                                          nothing scattered before
//   + (1 - w) sum_k>0 exp(-n) (n (1 - w))^k / k! HG(g^(k+1))           only the HG part took part
//   + sum_l (2 l + 1) / (4 pi) c_l P_l                                 the Draine part took part
//   c_l = w d_l (e^(-n (1 - chi_l)) - e^-n) +
//         (1 - w) h_l (e^(-n (1 - chi_l)) - e^(-n (1 - (1 - w) h_l)))
// HG convolves with itself in closed form, HG(a) * HG(b) = HG(a b), and c_l decays like d_l: some
// 150 terms. Held by Multiscatter.SourceMatchesLongLegendreSums.
#include "tables/multiscatter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/model.hpp"

namespace welkin {
namespace {

namespace text = model::f64;

constexpr double INV_4PI = 0.25 * std::numbers::inv_pi;
constexpr int MAX_LOBES = 1024;  // Poisson terms; reached beyond n = 700 only
constexpr int MAX_TERMS = 1024;  // Legendre terms; reached beyond gD = 0.94 only

// Moments of mu^2 HG(g): mu^2 P_l = A P_(l+2) + B P_l + C P_(l-2), from (2 l + 1) mu P_l =
// (l + 1) P_(l+1) + l P_(l-1) applied twice.
double drainePart(double g, double alpha, int order, double power, double powerTwoBelow) {
  const double l = order;
  const double a = (l + 1) * (l + 2) / ((2 * l + 1) * (2 * l + 3));
  const double b = (2 * l * l + 2 * l - 1) / ((2 * l - 1) * (2 * l + 3));
  const double c = l * (l - 1) / ((2 * l - 1) * (2 * l + 1));
  const double squared = (a * g * g + b) * power + c * powerTwoBelow;
  return (power + alpha * squared) / (1 + alpha * (1 + 2 * g * g) / 3);
}

// Part of HG(g) in the forward hemisphere: (1 - g^2) / (2 g) (1 / gap - 1 / sqrt(1 + g^2)),
// rewritten because that is 0 / 0 at g = 0.
double forwardPartOfHg(double g, double gap) {
  const double root = std::sqrt(1 + g * g);
  return (1 + g) / (root * (root + gap));
}

// The three sums for one medium at one depth, ready for any angle.
class Source {
 public:
  Source(const FogPhaseParams& phase, double n);
  double ratio(double y) const;  // to the phase function
  double forwardFraction() const;

 private:
  struct Lobe {
    double weight;
    double g;
    double gap;
  };
  FogPhaseParams phase_;
  double unscattered_;  // exp(-n)
  int lobeCount_ = 0;
  int termCount_ = 0;
  std::array<Lobe, MAX_LOBES> lobes_;
  std::array<double, MAX_TERMS> terms_;   // c_l
  std::array<double, MAX_TERMS> draine_;  // d_l
};

Source::Source(const FogPhaseParams& phase, double n) : phase_(phase), unscattered_(std::exp(-n)) {
  const double w = phase.weightD;
  const double g = phase.gHg;
  const double mean = n * (1 - w);
  if (mean > 0) {
    // 10 standard deviations and 30: what is left out is below 1e-20 of the whole.
    const int count = static_cast<int>(std::min(mean + 10 * std::sqrt(mean) + 30, 1.0 * MAX_LOBES));
    const double logG = g > 0 ? std::log1p(-phase.gapHg) : (g < 0 ? std::log(-g) : 0);
    double weight = unscattered_ * (1 - w);
    for (int k = 1; k <= count; ++k) {
      weight *= mean / k;
      // gap of g^(k+1) by expm1, since 1 - g^(k+1) would cancel.
      const double size = g == 0 ? 0 : std::exp((k + 1) * logG);
      const double gap = g == 0 ? 1 : -std::expm1((k + 1) * logG);
      const bool flipped = g < 0 && k % 2 == 0;
      lobes_[static_cast<size_t>(lobeCount_++)] = {weight, flipped ? -size : size,
                                                   flipped ? 1 + size : gap};
    }
  }
  if (w > 0) {
    // gD^l < 1e-26 at the end; the factors l^2 alpha (2 l + 1) leave that below 1e-18.
    const double decay = -std::log(std::max(std::abs(phase.gD), 1e-3));
    termCount_ = static_cast<int>(std::min(8 + 60 / decay, 1.0 * MAX_TERMS));
    double h = 1;
    double power = 1;
    double below = 0;
    double twoBelow = 0;
    for (int l = 0; l < termCount_; ++l) {
      const double d = drainePart(phase.gD, phase.alpha, l, power, twoBelow);
      const double chi = (1 - w) * h + w * d;
      const double scattered = std::exp(-n * (1 - chi));
      const size_t i = static_cast<size_t>(l);
      draine_[i] = d;
      terms_[i] =
          -scattered * (w * d * std::expm1(-n * chi) + (1 - w) * h * std::expm1(-n * w * d));
      h *= g;
      twoBelow = below;
      below = power;
      power *= phase.gD;
    }
  }
}

double Source::ratio(double y) const {
  double sum = 0;
  for (int k = 0; k < lobeCount_; ++k) {
    const Lobe& lobe = lobes_[static_cast<size_t>(k)];
    sum += lobe.weight * text::henyeyGreenstein(lobe.g, lobe.gap, y);
  }
  const double mu = 1 - y;
  double series = 0;
  double p = 1;
  double before = 0;
  for (int l = 0; l < termCount_; ++l) {
    series += (2 * l + 1) * terms_[static_cast<size_t>(l)] * p;
    const double next = ((2 * l + 1) * mu * p - l * before) / (l + 1);
    before = p;
    p = next;
  }
  // All three sums are positive functions, so exp(-n) is the least the ratio can be; rounding in
  // the series is kept from going below.
  return unscattered_ + std::max(sum + INV_4PI * series, 0.0) / evalPhase(phase_, y);
}

double Source::forwardFraction() const {
  const double w = phase_.weightD;
  double sum = unscattered_ * (1 - w) * forwardPartOfHg(phase_.gHg, phase_.gapHg);
  for (int k = 0; k < lobeCount_; ++k) {
    const Lobe& lobe = lobes_[static_cast<size_t>(k)];
    sum += lobe.weight * forwardPartOfHg(lobe.g, lobe.gap);
  }
  std::array<double, MAX_TERMS> moments;
  for (size_t l = 0; l < static_cast<size_t>(termCount_); ++l) {
    moments[l] = terms_[l] + unscattered_ * w * draine_[l];
  }
  return sum +
         forwardFractionInteger(std::span(moments.data(), static_cast<size_t>(termCount_)), 1);
}

}  // namespace

double phaseNode(double s) {
  // With a = sqrt(sin(t/2)), b = sqrt(cos(t/2)): a - b = c, a^4 + b^4 = 1, and a + b by a
  // quadratic.
  const double c = 2 * s - 1;
  const double c2 = c * c;
  const double sum = std::sqrt(std::sqrt(8 * (1 + c2 * c2)) - 3 * c2);
  const double a = std::max(0.5 * (sum + c), 0.0);
  return std::min(2 * (a * a) * (a * a), 2.0);
}

double depthNode(double s) {
  const double ratio = text::SCATTERING_DEPTH_NMAX / text::SCATTERING_DEPTH_N0;
  return text::SCATTERING_DEPTH_N0 * std::expm1(s * std::log1p(ratio));
}

void legendreMoments(const FogPhaseParams& phase, std::span<double> chi) {
  const double w = phase.weightD;
  double h = 1;
  double power = 1;
  double below = 0;
  double twoBelow = 0;
  for (size_t l = 0; l < chi.size(); ++l) {
    chi[l] =
        (1 - w) * h + w * drainePart(phase.gD, phase.alpha, static_cast<int>(l), power, twoBelow);
    h *= phase.gHg;
    twoBelow = below;
    below = power;
    power *= phase.gD;
  }
}

double sourceDistribution(const FogPhaseParams& phase, double n, double y) {
  return Source(phase, n).ratio(y) * evalPhase(phase, y);
}

double forwardFraction(const FogPhaseParams& phase, double n) {
  return Source(phase, n).forwardFraction();
}

double sourceDistributions(const FogPhaseParams& phase, double n, std::span<const double> y,
                           std::span<double> source) {
  const Source one(phase, n);
  for (size_t i = 0; i < y.size(); ++i) {
    source[i] = one.ratio(y[i]) * evalPhase(phase, y[i]);
  }
  return one.forwardFraction();
}

double forwardFractionInteger(std::span<const double> chi, int n) {
  // Integral of P_l over [0, 1] is (P_(l-1)(0) - P_(l+1)(0)) / (2 l + 1); zero for even l > 0.
  double sum = chi.empty() ? 0 : 0.5 * std::pow(chi[0], n);
  double atZero = 1;  // P_(l-1)(0)
  for (size_t l = 1; l < chi.size(); l += 2) {
    const double next = -atZero * static_cast<double>(l) / static_cast<double>(l + 1);
    sum += 0.5 * std::pow(chi[l], n) * (atZero - next);
    atZero = next;
  }
  return sum;
}

double scatteredInteger(std::span<const double> chi, int n, double mu) {
  double sum = 0;
  double p = 1;
  double before = 0;
  double l = 0;
  for (const double moment : chi) {
    sum += (2 * l + 1) * std::pow(moment, n) * p;
    const double next = ((2 * l + 1) * mu * p - l * before) / (l + 1);
    before = p;
    p = next;
    l += 1;
  }
  return INV_4PI * sum;
}

}  // namespace welkin
