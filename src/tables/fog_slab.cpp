// SPDX-License-Identifier: MIT
#include "tables/fog_slab.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr size_t HALF = FOG_TERMS / 2;  // streams of a hemisphere
constexpr size_t STREAMS = 2 * HALF;
// Air scatters by its terms 0 and 2.
constexpr double AIR_SECOND = 0.1;

using Block = std::array<double, STREAMS * STREAMS>;

// Gauss nodes of (0, 1), used for either hemisphere: orders up to 15 are integrated exactly, so
// that scattering keeps energy.
struct Nodes {
  std::array<double, HALF> mu{};
  std::array<double, HALF> weight{};
};

const Nodes& nodesOf() {
  static const Nodes all = [] {
    Nodes nodes;
    for (size_t i = 0; i < HALF; ++i) {
      double x = std::cos(PI * (static_cast<double>(i) + 0.75) / (HALF + 0.5));
      double slope = 1;
      for (int k = 0; k < 60; ++k) {
        double before = 1;
        double value = x;
        for (size_t l = 2; l <= HALF; ++l) {
          const auto n = static_cast<double>(l);
          const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
          before = value;
          value = next;
        }
        slope = HALF * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      nodes.mu[i] = 0.5 * (1 + x);
      nodes.weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    return nodes;
  }();
  return all;
}

// Stream s: 0 to 7 travel down, 8 to 15 up.
double cosineOf(size_t s) {
  return s < HALF ? -nodesOf().mu[s] : nodesOf().mu[s - HALF];
}

// Solves M x = b for several b at once; M is destroyed. Rows of x: `columns` long.
struct Factors {
  Block lu{};
  std::array<uint8_t, STREAMS> pivot{};

  void factor() {
    for (size_t k = 0; k < STREAMS; ++k) {
      size_t best = k;
      for (size_t i = k + 1; i < STREAMS; ++i) {
        best = std::abs(lu[i * STREAMS + k]) > std::abs(lu[best * STREAMS + k]) ? i : best;
      }
      pivot[k] = static_cast<uint8_t>(best);
      if (best != k) {
        std::swap_ranges(lu.begin() + static_cast<long>(k * STREAMS),
                         lu.begin() + static_cast<long>((k + 1) * STREAMS),
                         lu.begin() + static_cast<long>(best * STREAMS));
      }
      const double inverse = 1 / lu[k * STREAMS + k];
      for (size_t i = k + 1; i < STREAMS; ++i) {
        const double f = lu[i * STREAMS + k] *= inverse;
        for (size_t j = k + 1; j < STREAMS; ++j) {
          lu[i * STREAMS + j] -= f * lu[k * STREAMS + j];
        }
      }
    }
  }
  void solve(double* x, size_t columns) const {
    for (size_t k = 0; k < STREAMS; ++k) {
      if (pivot[k] != k) {
        std::swap_ranges(x + k * columns, x + (k + 1) * columns, x + pivot[k] * columns);
      }
    }
    for (size_t k = 0; k < STREAMS; ++k) {
      for (size_t i = k + 1; i < STREAMS; ++i) {
        subtract(x + i * columns, x + k * columns, lu[i * STREAMS + k], columns);
      }
    }
    for (size_t k = STREAMS; k-- > 0;) {
      const double inverse = 1 / lu[k * STREAMS + k];
      for (size_t c = 0; c < columns; ++c) {
        x[k * columns + c] *= inverse;
      }
      for (size_t i = 0; i < k; ++i) {
        subtract(x + i * columns, x + k * columns, lu[i * STREAMS + k], columns);
      }
    }
  }
  static void subtract(double* to, const double* from, double factor, size_t count) {
    for (size_t c = 0; c < count; ++c) {
      to[c] -= factor * from[c];
    }
  }
};

}  // namespace

FogTermsOf legendreOf(size_t m, double mu) {
  FogTermsOf p{};
  double start = 1;
  const double sine = std::sqrt(std::max((1 - mu) * (1 + mu), 0.0));
  for (size_t k = 1; k <= m; ++k) {
    start *= sine * std::sqrt((2.0 * static_cast<double>(k) - 1) / (2.0 * static_cast<double>(k)));
  }
  const auto order = static_cast<double>(m);
  p[0] = start;
  for (size_t l = m + 1; l < FOG_TERMS; ++l) {
    const auto n = static_cast<double>(l);
    const double below = l > m + 1 ? p[l - m - 2] : 0;
    p[l - m] =
        ((2 * n - 1) * mu * p[l - m - 1] - std::sqrt((n - 1) * (n - 1) - order * order) * below) /
        std::sqrt(n * n - order * order);
  }
  return p;
}

// One azimuth's equations. Unknown are the radiances at the edges of cells, 16 each; a cell's mean
// is that of its two edges. (The diamond scheme keeps the limit of diffusion in thick cells, which
// characteristics with a linear source do not.) At an edge stand the equations of streams that come
// down through the cell above it and up through the cell below it.
struct FogSlab::Mode {
  size_t m;
  std::array<FogTermsOf, STREAMS> legendre{};  // [stream][l - m]
  // Eliminated from the top: psi_l = solved(R_l) - next_l psi_{l+1}.
  std::vector<Factors> own;   // by edge
  std::vector<Block> next;    // by edge
  std::vector<Block> before;  // A_l: of the edge above, rows of streams that come down

  Mode(size_t order, const FogSlab& slab);
  // Share of a cell's extinction that scatters from P_l^m `from` into a stream; isotropic: 1.
  double kernel(const FogSlab& slab, const FogCell& cell, size_t to, const FogTermsOf& from) const;
  // Half of a cell's equation: (+-) mu / depth psi + psi / 2 - scattered / 2, times depth.
  double coefficient(const FogSlab& slab, const FogCell& cell, size_t i, size_t j, bool out) const;
};

double FogSlab::Mode::kernel(const FogSlab& slab, const FogCell& cell, size_t to,
                             const FogTermsOf& from) const {
  double sum = 0;
  for (size_t l = m; l < FOG_TERMS; ++l) {
    const double air = l == 0 ? 1 : (l == 2 ? AIR_SECOND : 0);
    sum += static_cast<double>(2 * l + 1) * (cell.air * air + cell.fog * slab.fog_[l]) *
           legendre[to][l - m] * from[l - m];
  }
  return sum;
}

double FogSlab::Mode::coefficient(const FogSlab& slab, const FogCell& cell, size_t i, size_t j,
                                  bool out) const {
  const Nodes& nodes = nodesOf();
  double result = -0.25 * nodes.weight[j % HALF] * kernel(slab, cell, i, legendre[j]) * cell.depth;
  if (i == j) {
    result += 0.5 * cell.depth + (out ? 1 : -1) * nodes.mu[i % HALF];
  }
  return result;
}

FogSlab::Mode::Mode(size_t order, const FogSlab& slab) : m(order) {
  for (size_t s = 0; s < STREAMS; ++s) {
    legendre[s] = legendreOf(m, cosineOf(s));
  }
  const Nodes& nodes = nodesOf();
  const size_t last = slab.cells_.size();
  own.resize(last + 1);
  next.resize(last + 1);
  before.resize(last + 1);
  for (size_t l = 0; l <= last; ++l) {
    Block& a = before[l];
    Block& b = own[l].lu;
    Block& c = next[l];
    for (size_t i = 0; i < STREAMS; ++i) {
      const bool down = i < HALF;
      for (size_t j = 0; j < STREAMS; ++j) {
        const size_t at = i * STREAMS + j;
        if (down && l > 0) {
          a[at] = coefficient(slab, slab.cells_[l - 1], i, j, false);
          b[at] = coefficient(slab, slab.cells_[l - 1], i, j, true);
        } else if (!down && l < last) {
          b[at] = coefficient(slab, slab.cells_[l], i, j, true);
          c[at] = coefficient(slab, slab.cells_[l], i, j, false);
        } else {
          b[at] = i == j ? 1 : 0;
          if (!down && m == 0 && j < HALF) {  // the ground
            b[at] -= 2 * slab.groundAlbedo_ * nodes.weight[j] * nodes.mu[j];
          }
        }
      }
    }
    if (l > 0) {
      // next[l - 1] is by now the solved one.
      for (size_t i = 0; i < HALF; ++i) {
        for (size_t k = 0; k < STREAMS; ++k) {
          Factors::subtract(b.data() + i * STREAMS, next[l - 1].data() + k * STREAMS,
                            a[i * STREAMS + k], STREAMS);
        }
      }
    }
    own[l].factor();
    own[l].solve(c.data(), STREAMS);
  }
}

FogSlab::FogSlab(const std::vector<FogCell>& cells, const FogTermsOf& fog, double groundAlbedo)
    : cells_(cells), fog_(fog), groundAlbedo_(groundAlbedo) {
  for (size_t m = 0; m < FOG_TERMS; ++m) {
    modes_.emplace_back(m, *this);
  }
}

FogSlab::~FogSlab() = default;
FogSlab::FogSlab(FogSlab&&) noexcept = default;

std::vector<std::vector<FogField>> FogSlab::solve(const std::vector<FogBeam>& beams) const {
  const Nodes& nodes = nodesOf();
  const size_t columns = beams.size();
  const size_t last = cells_.size();
  std::vector<std::vector<FogField>> fields(columns, std::vector<FogField>(last));
  std::vector<double> psi((last + 1) * STREAMS * columns);
  for (const Mode& mode : modes_) {
    const size_t m = mode.m;
    std::fill(psi.begin(), psi.end(), 0.0);
    const auto rowOf = [&](size_t l, size_t s) { return psi.data() + (l * STREAMS + s) * columns; };
    for (size_t n = 0; n < columns; ++n) {
      const FogBeam& beam = beams[n];
      const auto p = legendreOf(m, -beam.sunMu);
      for (size_t k = 0; k < last; ++k) {
        const FogCell& cell = cells_[k];
        for (size_t s = 0; s < STREAMS; ++s) {
          rowOf(s < HALF ? k + 1 : k, s)[n] =
              mode.kernel(*this, cell, s, p) * beam.irradiance[k] / (4 * PI) * cell.depth;
        }
      }
      if (m == 0) {
        for (size_t s = HALF; s < STREAMS; ++s) {
          rowOf(last, s)[n] = groundAlbedo_ * beam.sunMu * beam.atGround / PI;
        }
      }
    }
    for (size_t l = 0; l <= last; ++l) {
      if (l > 0) {
        for (size_t i = 0; i < HALF; ++i) {
          for (size_t k = 0; k < STREAMS; ++k) {
            Factors::subtract(rowOf(l, i), rowOf(l - 1, k), mode.before[l][i * STREAMS + k],
                              columns);
          }
        }
      }
      mode.own[l].solve(rowOf(l, 0), columns);
    }
    for (size_t l = last; l-- > 0;) {
      for (size_t i = 0; i < STREAMS; ++i) {
        for (size_t k = 0; k < STREAMS; ++k) {
          Factors::subtract(rowOf(l, i), rowOf(l + 1, k), mode.next[l][i * STREAMS + k], columns);
        }
      }
    }
    for (size_t k = 0; k < last; ++k) {
      for (size_t s = 0; s < STREAMS; ++s) {
        const double* upper = rowOf(k, s);
        const double* lower = rowOf(k + 1, s);
        const double weight = 0.25 * nodes.weight[s % HALF];
        for (size_t l = m; l < FOG_TERMS; ++l) {
          const double factor = weight * mode.legendre[s][l - m];
          for (size_t n = 0; n < columns; ++n) {
            fields[n][k].at(l, m) += factor * (upper[n] + lower[n]);
          }
        }
      }
    }
  }
  return fields;
}

}  // namespace welkin
