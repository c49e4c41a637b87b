// SPDX-License-Identifier: MIT
#include "reference/slab_modes.hpp"

#include <array>
#include <numbers>

namespace welkin::reference {
namespace {

// -d/dx of decayMean: (1 - e^-x (1 + x)) / x^2, a series where that cancels.
double decayMeanSlope(double x) {
  if (std::fabs(x) < 0.5) {
    double sum = 0;
    double term = 1;  // (-x)^(n - 1) / (n + 1)!
    for (int n = 1; n < 20; ++n) {
      term *= (n == 1 ? 1 : -x) / (n + 1);
      sum += n * term;
    }
    return sum;
  }
  return (1 - std::exp(-x) * (1 + x)) / (x * x);
}

// tanh(k tau / 2) / k.
double halfTangent(double k, double tau) {
  const double h = k * tau / 2;
  return h < 1e-4 ? tau / 2 * (1 - h * h / 3) : std::tanh(h) / k;
}

}  // namespace

double decayMean(double x) {
  return x == 0 ? 1 : -std::expm1(-x) / x;
}

double decayDifference(double a, double b) {
  return std::exp(-std::min(a, b)) * decayMean(std::fabs(b - a));
}

double decayDifference(double a, double b, double c) {
  const double low = std::min({a, b, c});
  const double high = std::max({a, b, c}) - low;
  const double middle = a + b + c - 3 * low - high;
  const double width = high - middle;
  // Gauss-Legendre with 5 nodes: 1e-14 of the mean slope over at most half a unit.
  constexpr std::array NODE{0.0, 0.53846931010568309, 0.90617984593866399};
  constexpr std::array WEIGHT{128.0 / 225, 0.47862867049936647, 0.23692688505618909};
  double value = 0;
  if (width > 0.5) {
    value = (decayMean(middle) - decayMean(high)) / width;
  } else {
    for (std::size_t i = 0; i < NODE.size(); ++i) {
      const double centre = middle + width / 2;
      const double offset = width / 2 * NODE[i];
      value += WEIGHT[i] / 2 *
               (i == 0 ? decayMeanSlope(centre)
                       : decayMeanSlope(centre - offset) + decayMeanSlope(centre + offset));
    }
  }
  return std::exp(-low) * value;
}

void legendreFunctions(int m, double mu, Vector& result) {
  double first = 1;
  for (int i = 1; i <= m; ++i) {
    first *= std::sqrt((1 - mu) * (1 + mu) * (2 * i - 1) / (2 * i));
  }
  double before = 0;
  double value = first;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = value;
    const double l = m + static_cast<double>(i);
    const double square = static_cast<double>(m) * m;
    const double next = ((2 * l + 1) * mu * value - std::sqrt(l * l - square) * before) /
                        std::sqrt((l + 1) * (l + 1) - square);
    before = value;
    value = next;
  }
}

SlabMode::SlabMode(int m, const SlabNodes& nodes, const Vector& series, bool conservative)
    : m_(m), nodes_(nodes), series_(series) {
  const std::size_t n = nodes.mu.size();
  const std::size_t terms = series.size() - static_cast<std::size_t>(m);
  // Legendre functions in the nodes, those of even l - m, then odd: node by term.
  std::array<Matrix, 2> function{Matrix(n, (terms + 1) / 2), Matrix(n, terms / 2)};
  Vector values(terms);
  for (std::size_t i = 0; i < n; ++i) {
    legendreFunctions(m, nodes.mu[i], values);
    for (std::size_t l = 0; l < terms; ++l) {
      function[l % 2](i, l / 2) = values[l];
    }
  }
  std::array<Matrix, 2> a{Matrix(n, n), Matrix(n, n)};  // A+, A-
  for (std::size_t odd = 0; odd < 2; ++odd) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t l = 0; l < function[odd].columns; ++l) {
        const double factor =
            series[static_cast<std::size_t>(m) + 2 * l + odd] * function[odd](j, l);
        for (std::size_t i = 0; i < n; ++i) {
          a[odd](i, j) += factor * function[odd](i, l);
        }
      }
      for (std::size_t i = 0; i < n; ++i) {
        const double scale =
            std::sqrt(nodes.weight[i] * nodes.weight[j] / (nodes.mu[i] * nodes.mu[j]));
        a[odd](i, j) = (i == j ? 1 / nodes.mu[i] : 0) - scale * a[odd](i, j);
      }
    }
  }
  const Matrix l = cholesky(a[1]);
  const Matrix r = cholesky(a[0], conservative);
  Matrix rl(n, n);  // R is the transpose of a lower triangle
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      rl(i, j) = dot(r.column(i), l.column(j), n);
    }
  }
  const Matrix v = orthogonalise(rl);
  for (std::size_t j = 0; j < n; ++j) {
    k_.push_back(std::sqrt(dot(rl.column(j), rl.column(j), n)));
  }
  x_ = product(l, v);
  y_ = product(inverseTransposed(l), v);
  for (std::size_t odd = 0; odd < 2; ++odd) {
    Matrix& moments = odd == 0 ? evenMoments_ : oddMoments_;
    const Matrix& from = odd == 0 ? x_ : y_;
    moments = Matrix(function[odd].columns, n);
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t t = 0; t < function[odd].columns; ++t) {
        for (std::size_t i = 0; i < n; ++i) {
          moments(t, j) +=
              function[odd](i, t) * std::sqrt(nodes.weight[i] / nodes.mu[i]) * from(i, j);
        }
      }
    }
  }
}

void SlabMode::setThickness(double tau) {
  if (tau == tau_) {
    return;
  }
  tau_ = tau;
  const std::size_t n = k_.size();
  Matrix even = x_;
  Matrix odd = y_;
  for (std::size_t j = 0; j < n; ++j) {
    const double tangent = halfTangent(k_[j], tau);
    for (std::size_t i = 0; i < n; ++i) {
      even(i, j) += k_[j] * k_[j] * tangent * y_(i, j);
      odd(i, j) += tangent * x_(i, j);
    }
  }
  evenSystem_ = LinearSystem(std::move(even));
  oddSystem_ = LinearSystem(std::move(odd));
}

// x + y at the top and x - y at the bottom, from the homogeneous solution.
SlabSolution SlabMode::solve(const Vector& top, const Vector& bottom) const {
  Vector sum = top;
  Vector difference = bottom;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = (top[i] + bottom[i]) / 2;
    difference[i] = (bottom[i] - top[i]) / 2;
  }
  SlabSolution solution;
  solution.even = evenSystem_.solve(std::move(sum));
  solution.odd = oddSystem_.solve(std::move(difference));
  solution.beamZ.resize(k_.size());
  solution.beamT.resize(k_.size());
  return solution;
}

SlabSolution SlabMode::diffuse(bool above) const {
  Vector inside(k_.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = 2 * std::sqrt(nodes_.mu[i] * nodes_.weight[i]);
  }
  const Vector nothing(k_.size());
  return above ? solve(inside, nothing) : solve(nothing, inside);
}

// Terms of the phase function between mu and the nodes' moments: even or odd l - m.
Vector SlabMode::sources(double mu, bool odd) const {
  Vector values(series_.size() - static_cast<std::size_t>(m_));
  legendreFunctions(m_, mu, values);
  Vector result;
  for (std::size_t l = odd ? 1 : 0; l < values.size(); l += 2) {
    result.push_back(series_[static_cast<std::size_t>(m_) + l] * values[l]);
  }
  return result;
}

SlabSolution SlabMode::beam(double mu0) const {
  const std::size_t n = k_.size();
  const double p = 1 / mu0;
  // Light scattered once enters the moments as q_s, q_d do: / (2 pi).
  std::array<Vector, 2> source{Vector(n), Vector(n)};
  Vector at(series_.size() - static_cast<std::size_t>(m_));
  const std::array<Vector, 2> term{sources(mu0, false), sources(mu0, true)};
  for (std::size_t i = 0; i < n; ++i) {
    legendreFunctions(m_, nodes_.mu[i], at);
    for (std::size_t l = 0; l < at.size(); ++l) {
      source[l % 2][i] += at[l] * term[l % 2][l / 2] / (2 * std::numbers::pi);
    }
    for (Vector& one : source) {
      one[i] *= std::sqrt(nodes_.weight[i] / nodes_.mu[i]);
    }
  }
  const Vector b = projections(x_, source[0]);
  const Vector a = projections(y_, source[1]);
  Vector top(n);
  Vector bottom(n);
  Vector z(n);
  Vector tTop(n);
  Vector tBottom(n);
  Vector factor(n);
  for (std::size_t j = 0; j < n; ++j) {
    factor[j] = (b[j] + a[j] * p) / (p + k_[j]);
    const double e = tau_ * decayDifference(k_[j] * tau_, p * tau_);
    z[j] = factor[j] * e;
    tTop[j] = a[j] - factor[j];
    tBottom[j] = tTop[j] * std::exp(-p * tau_) + k_[j] * z[j];
  }
  addProduct(y_, tTop, -1, top);
  addProduct(x_, z, -1, bottom);
  addProduct(y_, tBottom, 1, bottom);
  SlabSolution solution = solve(top, bottom);
  solution.beamZ = std::move(factor);
  solution.beamT = a;
  solution.p = p;
  return solution;
}

// Integrals over the way to the view of e^(-q s) times the solutions' functions of depth.
struct SlabMode::Parts {
  double even;      // cosh(k t) / cosh(k tau / 2)
  double odd;       // sinh(k t) / (k cosh(k tau / 2))
  double resonant;  // E
  double beam;      // e^(-p depth)
};

SlabMode::Parts SlabMode::integrate(double k, double p, double q, bool up, double depth) const {
  const double length = up ? tau_ - depth : depth;
  const double outside = tau_ - length;  // the rest of the slab, behind the view
  const double qs = q * length;
  const double ks = k * length;
  const double ps = p * length;
  const double near = length * decayMean(qs + ks);      // of e^(-k s)
  const double far = length * decayDifference(qs, ks);  // of e^(-k (length - s))
  const double norm = 1 + std::exp(-k * tau_);
  const double rest = std::exp(-k * outside);
  // (far - near) / k, regular for small k: e^(-k (length - s)) - e^(-k s) =
  // e^(-k length) (e^(k s) - e^(-k s)) - (1 - e^(-k length)) e^(-k s).
  const double slope = ks > 1 ? (far - near) / k
                              : length * length *
                                    (2 * std::exp(-ks) * decayDifference(0, qs - ks, qs + ks) -
                                     decayMean(ks) * decayMean(qs + ks));
  Parts parts{};
  parts.even = (far + rest * near) / norm;
  parts.odd = (slope + outside * decayMean(k * outside) * near) / norm;
  if (up) {
    // Depth grows with s: E(depth + s) = e^(-k depth) E(s) + E(depth) e^(-p s).
    const double beam = length * decayMean(qs + ps);
    parts.resonant = rest * length * length * decayDifference(0, qs + ks, qs + ps) +
                     outside * decayDifference(k * outside, p * outside) * beam;
    parts.beam = std::exp(-p * outside) * beam;
  } else {
    parts.odd = -parts.odd;
    parts.resonant = length * length * decayDifference(qs, ks, ps);
    parts.beam = length * decayDifference(qs, ps);
  }
  return parts;
}

double SlabMode::radiance(const SlabSolution& solution, double mu, bool up, double depth) const {
  const Vector fromZ = projections(evenMoments_, sources(mu, false));
  const Vector fromT = projections(oddMoments_, sources(mu, true));
  const double q = 1 / mu;
  const double sign = up ? -1 : 1;
  double sum = 0;
  for (std::size_t j = 0; j < k_.size(); ++j) {
    const double k = k_[j];
    Parts part = integrate(k, solution.p, q, up, depth);
    if (solution.p == 0) {
      part.resonant = 0;
      part.beam = 0;
    }
    const double z = solution.even[j] * part.even + solution.odd[j] * part.odd +
                     solution.beamZ[j] * part.resonant;
    const double t = -k * k * solution.even[j] * part.odd - solution.odd[j] * part.even +
                     (solution.beamT[j] - solution.beamZ[j]) * part.beam +
                     solution.beamZ[j] * k * part.resonant;
    sum += fromZ[j] * z + sign * fromT[j] * t;
  }
  return q * sum / 2;
}

void SlabMode::nodeRadiance(const SlabSolution& solution, double depth, Vector& down,
                            Vector& up) const {
  const std::size_t n = k_.size();
  Vector z(n);
  Vector t(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double k = k_[j];
    const double norm = 1 + std::exp(-k * tau_);
    const double high = std::exp(-k * depth);
    const double low = std::exp(-k * (tau_ - depth));
    const double even = (low + high) / norm;
    // (low - high) / k from the side whose exponent is smaller.
    const double offset = 2 * depth - tau_;
    const double odd = std::copysign(std::fabs(offset) * decayMean(k * std::fabs(offset)), offset) *
                       std::max(low, high) / norm;
    const double p = solution.p;
    const double e = p == 0 ? 0 : depth * decayDifference(k * depth, p * depth);
    z[j] = solution.even[j] * even + solution.odd[j] * odd + solution.beamZ[j] * e;
    t[j] = -k * k * solution.even[j] * odd - solution.odd[j] * even + solution.beamZ[j] * k * e +
           (solution.beamT[j] - solution.beamZ[j]) * std::exp(-p * depth);
  }
  Vector x(n);
  Vector y(n);
  addProduct(x_, z, 1, x);
  addProduct(y_, t, 1, y);
  down.resize(n);
  up.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = 2 * std::sqrt(nodes_.mu[i] * nodes_.weight[i]);
    down[i] = (x[i] + y[i]) / scale;
    up[i] = (x[i] - y[i]) / scale;
  }
}

}  // namespace welkin::reference
