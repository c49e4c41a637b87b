// SPDX-License-Identifier: MIT
#include "tables/fog_slab.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tables/gauss_rule.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr size_t HALF = FOG_TERMS / 2;  // streams of a hemisphere
constexpr size_t STREAMS = 2 * HALF;
// Air scatters by its terms 0 and 2.
constexpr double AIR_SECOND = 0.1;

using Block = std::array<double, STREAMS * STREAMS>;

// Used for either hemisphere: orders up to 15 are integrated exactly, so that scattering keeps
// energy.
const GaussRule& nodesOf() {
  static const GaussRule rule = gaussRule(HALF);
  return rule;
}

// Stream s: 0 to 7 travel down, 8 to 15 up.
double cosineOf(size_t s) {
  return s < HALF ? -nodesOf().node[s] : nodesOf().node[s - HALF];
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

// Equations at the edge between two cells, of which there is one more than cells. Eliminated from
// the top: psi_l = solved(R_l) - next_l psi_{l+1}.
struct FogSlab::Work::Edge {
  Factors own;
  Block next;
  Block before;  // of the edge above, rows of streams that come down
};

FogSlab::Work::Work(size_t cells, size_t beams)
    : edges_(cells + 1), radiance_((cells + 1) * STREAMS * beams) {}
FogSlab::Work::~Work() = default;
FogSlab::Work::Work(Work&&) noexcept = default;
FogSlab::Work& FogSlab::Work::operator=(Work&&) noexcept = default;

// One azimuth's equations. Unknown are the radiances at the edges of cells, 16 each; a cell's mean
// is that of its two edges. (The diamond scheme keeps the limit of diffusion in thick cells, which
// characteristics with a linear source do not.) At an edge stand the equations of streams that come
// down through the cell above it and up through the cell below it.
class FogSlab::Mode {
 public:
  Mode(size_t order, const FogSlab& slab, size_t beams, Work& work);
  void factor();
  void solve(const std::vector<FogBeam>& beams);
  void addTo(FogFields& fields) const;

 private:
  using Edge = Work::Edge;
  // Share of a cell's extinction that scatters from P_l^m `from` into a stream; isotropic: 1.
  double kernel(const FogCell& cell, size_t to, const FogTermsOf& from) const;
  // Half of a cell's equation: (+-) mu / depth psi + psi / 2 - scattered / 2, times depth.
  double coefficient(const FogCell& cell, size_t i, size_t j, bool out) const;
  void fillEdge(size_t l);
  void fillSources(const std::vector<FogBeam>& beams);
  double* row(size_t l, size_t s) const {
    return work_.radiance_.data() + (l * STREAMS + s) * beams_;
  }

  size_t m_;
  const FogSlab& slab_;
  size_t beams_;
  Work& work_;
  const GaussRule& nodes_;
  size_t last_;                                 // edge
  std::array<FogTermsOf, STREAMS> legendre_{};  // [stream][l - m]
};

FogSlab::Mode::Mode(size_t order, const FogSlab& slab, size_t beams, Work& work)
    : m_(order),
      slab_(slab),
      beams_(beams),
      work_(work),
      nodes_(nodesOf()),
      last_(slab.cells_.size()) {
  for (size_t s = 0; s < STREAMS; ++s) {
    legendre_[s] = legendreOf(m_, cosineOf(s));
  }
}

double FogSlab::Mode::kernel(const FogCell& cell, size_t to, const FogTermsOf& from) const {
  double sum = 0;
  for (size_t l = m_; l < FOG_TERMS; ++l) {
    const double air = l == 0 ? 1 : (l == 2 ? AIR_SECOND : 0);
    sum += static_cast<double>(2 * l + 1) * (cell.air * air + cell.fog * slab_.fog_[l]) *
           legendre_[to][l - m_] * from[l - m_];
  }
  return sum;
}

double FogSlab::Mode::coefficient(const FogCell& cell, size_t i, size_t j, bool out) const {
  double result = -0.25 * nodes_.weight[j % HALF] * kernel(cell, i, legendre_[j]) * cell.depth;
  if (i == j) {
    result += 0.5 * cell.depth + (out ? 1 : -1) * nodes_.node[i % HALF];
  }
  return result;
}

void FogSlab::Mode::fillEdge(size_t l) {
  Edge& edge = work_.edges_[l];
  edge.own.lu.fill(0);
  edge.next.fill(0);
  edge.before.fill(0);
  for (size_t i = 0; i < STREAMS; ++i) {
    const bool down = i < HALF;
    for (size_t j = 0; j < STREAMS; ++j) {
      const size_t at = i * STREAMS + j;
      if (down && l > 0) {
        edge.before[at] = coefficient(slab_.cells_[l - 1], i, j, false);
        edge.own.lu[at] = coefficient(slab_.cells_[l - 1], i, j, true);
      } else if (!down && l < last_) {
        edge.own.lu[at] = coefficient(slab_.cells_[l], i, j, true);
        edge.next[at] = coefficient(slab_.cells_[l], i, j, false);
      } else {
        edge.own.lu[at] = i == j ? 1 : 0;
        if (!down && m_ == 0 && j < HALF) {  // the ground
          edge.own.lu[at] -= 2 * slab_.groundAlbedo_ * nodes_.weight[j] * nodes_.node[j];
        }
      }
    }
  }
}

void FogSlab::Mode::factor() {
  for (size_t l = 0; l <= last_; ++l) {
    fillEdge(l);
    Edge& edge = work_.edges_[l];
    if (l > 0) {
      for (size_t i = 0; i < HALF; ++i) {
        for (size_t k = 0; k < STREAMS; ++k) {
          Factors::subtract(edge.own.lu.data() + i * STREAMS,
                            work_.edges_[l - 1].next.data() + k * STREAMS,
                            edge.before[i * STREAMS + k], STREAMS);
        }
      }
    }
    edge.own.factor();
    edge.own.solve(edge.next.data(), STREAMS);
  }
}

void FogSlab::Mode::fillSources(const std::vector<FogBeam>& beams) {
  std::fill(work_.radiance_.begin(), work_.radiance_.end(), 0.0);
  for (size_t n = 0; n < beams_; ++n) {
    const FogBeam& beam = beams[n];
    const auto p = legendreOf(m_, -beam.sunMu);
    for (size_t k = 0; k < last_; ++k) {
      const FogCell& cell = slab_.cells_[k];
      for (size_t s = 0; s < STREAMS; ++s) {
        row(s < HALF ? k + 1 : k, s)[n] =
            kernel(cell, s, p) * beam.irradiance[k] / (4 * PI) * cell.depth;
      }
    }
    for (size_t s = HALF; s < STREAMS && m_ == 0; ++s) {
      row(last_, s)[n] = slab_.groundAlbedo_ * beam.sunMu * beam.atGround / PI;
    }
  }
}

void FogSlab::Mode::solve(const std::vector<FogBeam>& beams) {
  fillSources(beams);
  for (size_t l = 0; l <= last_; ++l) {
    const Edge& edge = work_.edges_[l];
    if (l > 0) {
      for (size_t i = 0; i < HALF; ++i) {
        for (size_t k = 0; k < STREAMS; ++k) {
          Factors::subtract(row(l, i), row(l - 1, k), edge.before[i * STREAMS + k], beams_);
        }
      }
    }
    edge.own.solve(row(l, 0), beams_);
  }
  for (size_t l = last_; l-- > 0;) {
    for (size_t i = 0; i < STREAMS; ++i) {
      for (size_t k = 0; k < STREAMS; ++k) {
        Factors::subtract(row(l, i), row(l + 1, k), work_.edges_[l].next[i * STREAMS + k], beams_);
      }
    }
  }
}

void FogSlab::Mode::addTo(FogFields& fields) const {
  for (size_t k = 0; k < last_; ++k) {
    for (size_t s = 0; s < STREAMS; ++s) {
      const double* upper = row(k, s);
      const double* lower = row(k + 1, s);
      const double weight = 0.25 * nodes_.weight[s % HALF];
      for (size_t n = 0; n < beams_; ++n) {
        const double mean = weight * (upper[n] + lower[n]);
        for (size_t l = m_; l < FOG_TERMS; ++l) {
          fields[n][k].at(l, m_) += legendre_[s][l - m_] * mean;
        }
      }
    }
  }
}

FogSlab::FogSlab(std::vector<FogCell> cells, const FogTermsOf& fog, double groundAlbedo)
    : cells_(std::move(cells)), fog_(fog), groundAlbedo_(groundAlbedo) {}

void FogSlab::addMode(size_t m, const std::vector<FogBeam>& beams, Work& work,
                      FogFields& fields) const {
  Mode mode(m, *this, beams.size(), work);
  mode.factor();
  mode.solve(beams);
  mode.addTo(fields);
}

FogFields FogSlab::solve(const std::vector<FogBeam>& beams) const {
  FogFields fields(beams.size(), std::vector<FogField>(cells_.size()));
  Work work(cells_.size(), beams.size());
  for (size_t m = 0; m < FOG_TERMS; ++m) {
    addMode(m, beams, work, fields);
  }
  return fields;
}

}  // namespace welkin
