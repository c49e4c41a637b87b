// SPDX-License-Identifier: MIT
// Small dense matrices, double precision, for the slab solver: factors of symmetric positive
// matrices, singular values by one-sided Jacobi rotations, linear systems with pivoting.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace welkin::reference {

using Vector = std::vector<double>;

// Column by column: rotations and triangular solves walk down columns.
struct Matrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  Vector data;

  Matrix() = default;
  Matrix(std::size_t r, std::size_t c) : rows(r), columns(c), data(r * c) {}
  double* column(std::size_t j) { return data.data() + j * rows; }
  const double* column(std::size_t j) const { return data.data() + j * rows; }
  double& operator()(std::size_t i, std::size_t j) { return data[j * rows + i]; }
  double operator()(std::size_t i, std::size_t j) const { return data[j * rows + i]; }
};

inline double dot(const double* a, const double* b, std::size_t n) {
  return std::inner_product(a, a + n, b, 0.0);
}

inline Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows, b.columns);
  for (std::size_t j = 0; j < b.columns; ++j) {
    for (std::size_t k = 0; k < a.columns; ++k) {
      const double factor = b(k, j);
      const double* from = a.column(k);
      double* to = result.column(j);
      for (std::size_t i = 0; i < a.rows; ++i) {
        to[i] += factor * from[i];
      }
    }
  }
  return result;
}

// Transpose of a, times v.
inline Vector projections(const Matrix& a, const Vector& v) {
  Vector result(a.columns);
  for (std::size_t j = 0; j < a.columns; ++j) {
    result[j] = dot(a.column(j), v.data(), a.rows);
  }
  return result;
}

inline void addProduct(const Matrix& a, const Vector& v, double factor, Vector& to) {
  for (std::size_t j = 0; j < a.columns; ++j) {
    for (std::size_t i = 0; i < a.rows; ++i) {
      to[i] += factor * v[j] * a(i, j);
    }
  }
}

// Lower triangle L with a = L L^T. `singular`: the last pivot is known to be 0, not what rounding
// leaves of it.
inline Matrix cholesky(const Matrix& a, bool singular = false) {
  const std::size_t n = a.rows;
  Matrix l(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double sum = a(i, j);
      for (std::size_t k = 0; k < j; ++k) {
        sum -= l(i, k) * l(j, k);
      }
      if (i == j) {
        l(j, j) = singular && j + 1 == n ? 0 : std::sqrt(std::max(sum, 0.0));
      } else {
        l(i, j) = sum / l(j, j);
      }
    }
  }
  return l;
}

// Inverse of a lower triangle, transposed.
inline Matrix inverseTransposed(const Matrix& l) {
  const std::size_t n = l.rows;
  Matrix result(n, n);  // result(j, i) = inverse(i, j)
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double sum = i == j ? 1 : 0;
      for (std::size_t k = j; k < i; ++k) {
        sum -= l(i, k) * result(j, k);
      }
      result(j, i) = sum / l(i, i);
    }
  }
  return result;
}

// Rotates the columns of `g` until they are orthogonal; their lengths are its singular values,
// small ones as exact as large ones (Demmel and Veselic 1992). Returns the rotations V: g V.
inline Matrix orthogonalise(Matrix& g) {
  const std::size_t n = g.columns;
  Matrix v(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    v(j, j) = 1;
  }
  const auto rotate = [](double* a, double* b, std::size_t count, double c, double s) {
    for (std::size_t i = 0; i < count; ++i) {
      const double x = a[i];
      const double y = b[i];
      a[i] = c * x - s * y;
      b[i] = s * x + c * y;
    }
  };
  constexpr double ORTHOGONAL = 1e-15;
  for (int sweep = 0; sweep < 60; ++sweep) {
    bool turned = false;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        const double aa = dot(g.column(i), g.column(i), g.rows);
        const double bb = dot(g.column(j), g.column(j), g.rows);
        const double ab = dot(g.column(i), g.column(j), g.rows);
        if (std::fabs(ab) <= ORTHOGONAL * std::sqrt(aa * bb) || aa * bb == 0) {
          continue;
        }
        turned = true;
        const double zeta = (bb - aa) / (2 * ab);
        const double t = std::copysign(1 / (std::fabs(zeta) + std::hypot(1.0, zeta)), zeta);
        const double c = 1 / std::hypot(1.0, t);
        rotate(g.column(i), g.column(j), g.rows, c, c * t);
        rotate(v.column(i), v.column(j), n, c, c * t);
      }
    }
    if (!turned) {
      break;
    }
  }
  return v;
}

// Gauss elimination with row pivoting, kept for several right-hand sides.
class LinearSystem {
 public:
  LinearSystem() = default;
  explicit LinearSystem(Matrix a) : lu_(std::move(a)), pivot_(lu_.rows) {
    const std::size_t n = lu_.rows;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t best = k;
      for (std::size_t i = k + 1; i < n; ++i) {
        best = std::fabs(lu_(i, k)) > std::fabs(lu_(best, k)) ? i : best;
      }
      pivot_[k] = best;
      for (std::size_t j = 0; j < n && best != k; ++j) {
        std::swap(lu_(k, j), lu_(best, j));
      }
      for (std::size_t i = k + 1; i < n; ++i) {
        lu_(i, k) /= lu_(k, k);
      }
      for (std::size_t j = k + 1; j < n; ++j) {
        const double factor = lu_(k, j);
        for (std::size_t i = k + 1; i < n; ++i) {
          lu_(i, j) -= factor * lu_(i, k);
        }
      }
    }
  }

  Vector solve(Vector b) const {
    const std::size_t n = lu_.rows;
    for (std::size_t k = 0; k < n; ++k) {
      std::swap(b[k], b[pivot_[k]]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = k + 1; i < n; ++i) {
        b[i] -= b[k] * lu_(i, k);
      }
    }
    for (std::size_t k = n; k-- > 0;) {
      b[k] /= lu_(k, k);
      for (std::size_t i = 0; i < k; ++i) {
        b[i] -= b[k] * lu_(i, k);
      }
    }
    return b;
  }

 private:
  Matrix lu_;
  std::vector<std::size_t> pivot_;
};

}  // namespace welkin::reference
