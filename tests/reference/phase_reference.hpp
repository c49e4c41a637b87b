// SPDX-License-Identifier: MIT
// Independent truth for phase functions and their convolutions: the papers' formulas as printed, in
// terms of cos(theta), in long double, and plain quadrature. Slow and simple on purpose.
// [J23] Jendersie and d'Eon 2023; [R04] Riley et al. 2004; [D03] Draine 2003.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace reference {

using Real = long double;
constexpr Real PI = std::numbers::pi_v<Real>;

// [R04] Eq. 1, normalised over the sphere.
inline Real rayleigh(Real c) {
  return 3 / (16 * PI) * (1 + c * c);
}

// [J23] Eq. 2.
inline Real draine(Real alpha, Real g, Real c) {
  const Real peak = (1 - g * g) / std::pow(1 + g * g - 2 * g * c, Real(1.5));
  return peak * (1 + alpha * c * c) / (1 + alpha * (1 + 2 * g * g) / 3) / (4 * PI);
}

inline Real henyeyGreenstein(Real g, Real c) {
  return draine(0, g, c);
}

// Cornette and Shanks 1992, Eq. 8, as a phase function over the sphere.
inline Real cornetteShanks(Real g, Real c) {
  return 3 * (1 - g * g) * (1 + c * c) /
         (8 * PI * (2 + g * g) * std::pow(1 + g * g - 2 * g * c, Real(1.5)));
}

// [J23] Eq. 4-7, diameter in um.
struct Fog {
  Real gHg;
  Real gD;
  Real alpha;
  Real weight;

  explicit Fog(Real d)
      : gHg(std::exp(-0.0990567L / (d - 1.67154L))),
        gD(std::exp(-2.20679L / (d + 3.91029L) - 0.428934L)),
        alpha(std::exp(3.62489L - 8.29288L / (d + 5.52825L))),
        weight(std::exp(-0.599085L / (d - 0.641583L) - 0.665888L)) {}

  // [J23] Eq. 3.
  Real operator()(Real c) const {
    return (1 - weight) * henyeyGreenstein(gHg, c) + weight * draine(alpha, gD, c);
  }
};

// Points and weights over theta in [begin, end], with weight 2 pi sin(theta): Gauss-Legendre with
// 8 points on panels whose width grows with theta from 1e-5, so that any forward peak down to
// 1e-4 rad is resolved, and never exceeds `widest` (rad), for oscillating integrands.
struct AnglePoint {
  Real theta;
  Real weight;
};

inline std::vector<AnglePoint> anglePoints(Real begin, Real end, Real widest) {
  constexpr int ORDER = 8;
  Real node[ORDER];
  Real weight[ORDER];
  for (int i = 0; i < ORDER; ++i) {  // Newton on P_8 from Tricomi's estimate
    Real x = std::cos(PI * (static_cast<Real>(i) + 0.75L) / (ORDER + 0.5L));
    Real slope = 1;
    for (int k = 0; k < 20; ++k) {
      Real p = 1;
      Real q = 0;
      for (int l = 0; l < ORDER; ++l) {
        const Real next = ((2 * l + 1) * x * p - l * q) / (l + 1);
        q = p;
        p = next;
      }
      slope = ORDER * (x * p - q) / (x * x - 1);
      x -= p / slope;
    }
    node[i] = x;
    weight[i] = 2 / ((1 - x * x) * slope * slope);
  }
  std::vector<AnglePoint> points;
  Real left = begin;
  while (left < end) {
    const Real width = std::min({end - left, widest, std::max(Real(1e-5L), left * 0.3L)});
    for (int i = 0; i < ORDER; ++i) {
      const Real theta = left + width * (node[i] + 1) / 2;
      points.push_back({theta, weight[i] * width / 2 * 2 * PI * std::sin(theta)});
    }
    left += width;
  }
  return points;
}

// Integral over the sphere (or the cone of directions with theta in [begin, end]) of f(theta).
template <typename F>
Real integrateSphere(F f, Real begin = 0, Real end = PI, Real widest = 0.05L) {
  Real sum = 0;
  for (const AnglePoint& p : anglePoints(begin, end, widest)) {
    sum += p.weight * f(p.theta);
  }
  return sum;
}

// chi_l = integral of P P_l over the sphere, l < count, for P(cos theta).
template <typename F>
std::vector<Real> moments(F phase, int count) {
  std::vector<Real> chi(static_cast<size_t>(count));
  const Real widest = std::min(Real(0.05L), 4 / static_cast<Real>(count));
  for (const AnglePoint& point : anglePoints(0, PI, widest)) {
    const Real c = std::cos(point.theta);
    const Real value = point.weight * phase(c);
    Real p = 1;
    Real before = 0;
    for (int l = 0; l < count; ++l) {
      chi[static_cast<size_t>(l)] += value * p;
      const Real next = ((2 * l + 1) * c * p - l * before) / (l + 1);
      before = p;
      p = next;
    }
  }
  return chi;
}

// Sum of (2 l + 1) / (4 pi) a_l P_l(c).
inline Real legendreSum(const std::vector<Real>& a, Real c) {
  Real sum = 0;
  Real p = 1;
  Real before = 0;
  for (size_t l = 0; l < a.size(); ++l) {
    const Real order = static_cast<Real>(l);
    sum += (2 * order + 1) * a[l] * p;
    const Real next = ((2 * order + 1) * c * p - order * before) / (order + 1);
    before = p;
    p = next;
  }
  return sum / (4 * PI);
}

// Distribution of light scattered k + 1 times, k Poisson distributed with mean n: every order's
// moments chi^(k+1), weighted and added up one by one (no closed form of the exponential).
inline std::vector<Real> poissonMoments(const std::vector<Real>& chi, Real n) {
  std::vector<Real> result(chi.size());
  for (size_t l = 0; l < chi.size(); ++l) {
    Real term = std::exp(-n) * chi[l];
    for (int k = 1; k < 400; ++k) {
      result[l] += term;
      term *= n * chi[l] / k;
    }
  }
  return result;
}

// Cosines, with the first direction, of `samples` random walks on the sphere of directions: each
// takes 1 + Poisson(n) turns drawn from Henyey-Greenstein g by inversion of its distribution.
inline std::vector<double> randomWalks(double g, double n, int samples, unsigned seed) {
  std::mt19937 generator(seed);
  std::poisson_distribution<int> orders(n);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> cosines;
  cosines.reserve(static_cast<size_t>(samples));
  for (int s = 0; s < samples; ++s) {
    // Only the polar angle matters: with a turn by t in a random azimuth, the new cosine is
    // c cos t + sqrt(1 - c^2) sin t cos(azimuth).
    double c = 1;
    for (int k = orders(generator); k >= 0; --k) {
      const double f = (1 - g * g) / (1 - g + 2 * g * uniform(generator));
      const double t = std::clamp((1 + g * g - f * f) / (2 * g), -1.0, 1.0);
      const double azimuth = 2 * std::numbers::pi * uniform(generator);
      const double side = std::sqrt(std::max((1 - c * c) * (1 - t * t), 0.0));
      c = std::clamp(c * t + side * std::cos(azimuth), -1.0, 1.0);
    }
    cosines.push_back(c);
  }
  return cosines;
}

}  // namespace reference
