// SPDX-License-Identifier: MIT
#include "tables/canonical_builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "model/model.hpp"
#include "tables/slab_orders.hpp"

namespace welkin {
namespace {

using namespace model::f64;

constexpr double PI = std::numbers::pi;
constexpr double FACE = 1e-4;  // in thicknesses or 1: the mean source at a face is that just inside
constexpr double LEAST = 1e-7;  // of the brightest depth: what noise and dropped modes leave
// Columns weigh as the root of their light, at least this; what is darker may be cut by 8 bits.
constexpr double LEAST_WEIGHT = 0.02;
// Allowed rms of what a low rank leaves: of ln radiance, and of a collector's width.
constexpr std::array<double, CANONICAL_PARTS> ALLOWED = {0.003, 0.02, 0.02, 0.015};

const CanonicalGrid& gridOf(size_t part) {
  return part == 0 ? RADIANCE_GRID : COLLECTOR_GRID;
}

size_t pairOf(size_t set, bool up) {
  return set * 2 + (up ? 1 : 0);
}

// Vectors with the largest sums of squares: subspace iteration on a symmetric matrix.
std::vector<std::vector<double>> leadingVectors(const std::vector<double>& matrix, size_t n,
                                                size_t count) {
  std::vector<std::vector<double>> u(count, std::vector<double>(n));
  for (size_t k = 0; k < count; ++k) {
    for (size_t i = 0; i < n; ++i) {
      u[k][i] = std::cos(static_cast<double>((k + 1) * (2 * i + 1)) * PI /
                         (2.0 * static_cast<double>(n)));
    }
  }
  std::vector<double> product(n);
  for (int step = 0; step < 80; ++step) {
    for (size_t k = 0; k < count; ++k) {
      for (size_t i = 0; i < n; ++i) {
        product[i] = 0;
        for (size_t j = 0; j < n; ++j) {
          product[i] += matrix[i * n + j] * u[k][j];
        }
      }
      for (size_t before = 0; before < k; ++before) {
        double dot = 0;
        for (size_t i = 0; i < n; ++i) {
          dot += u[before][i] * product[i];
        }
        for (size_t i = 0; i < n; ++i) {
          product[i] -= dot * u[before][i];
        }
      }
      double norm = 0;
      for (const double value : product) {
        norm += value * value;
      }
      norm = std::sqrt(norm);
      for (size_t i = 0; i < n; ++i) {
        u[k][i] = norm > 0 ? product[i] / norm : 0;
      }
    }
  }
  return u;
}

// Weight of each column of a part's grid, of the brightest at the same thickness and light.
std::vector<double> columnWeights(const CanonicalDraft& draft, size_t pair, size_t part) {
  const CanonicalGrid& fine = RADIANCE_GRID;
  const CanonicalGrid& grid = gridOf(part);
  const size_t every = part == 0 ? 1 : 2;
  const size_t set = pair / 2;
  std::vector<double> weight(grid.columns());
  for (size_t t = 0; t < grid.thickness; ++t) {
    for (size_t l = 0; l < grid.light; ++l) {
      const auto light = [&](size_t which, size_t d) {
        return static_cast<double>(
            draft.weight[which * fine.columns() + (t * every * fine.depth + d) * fine.light +
                         l * every]);
      };
      double most = 0;
      for (size_t d = 0; d < fine.depth; ++d) {
        most = std::max({most, light(set * 2, d), light(set * 2 + 1, d)});
      }
      for (size_t d = 0; d < grid.depth; ++d) {
        weight[(t * grid.depth + d) * grid.light + l] =
            std::max(std::sqrt(light(pair, d * every) / most), LEAST_WEIGHT);
      }
    }
  }
  return weight;
}

void compressMatrix(std::vector<float> a, const std::vector<double>& weight,
                    const CanonicalGrid& grid, double allowed, CanonicalMatrix& result) {
  const size_t rows = grid.rows();
  const size_t columns = grid.columns();
  std::vector<float> mean(columns);
  for (size_t c = 0; c < columns; ++c) {
    double sum = 0;
    for (size_t r = 0; r < rows; ++r) {
      sum += static_cast<double>(a[r * columns + c]);
    }
    mean[c] = static_cast<float>(sum / static_cast<double>(rows));
  }
  std::vector<double> scaled(rows * columns);
  double total = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    a[i] -= mean[i % columns];
    scaled[i] = weight[i % columns] * static_cast<double>(a[i]);
    total += scaled[i] * scaled[i];
  }
  double weights = 0;
  for (const double w : weight) {
    weights += w * w * static_cast<double>(rows);
  }
  std::vector<double> gram(rows * rows);
  for (size_t i = 0; i < rows; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double lanes[4] = {};
      for (size_t c = 0; c < columns; ++c) {
        lanes[c % 4] += scaled[i * columns + c] * scaled[j * columns + c];
      }
      gram[i * rows + j] = gram[j * rows + i] = lanes[0] + lanes[1] + lanes[2] + lanes[3];
    }
  }
  const auto vectors = leadingVectors(gram, rows, std::min(CANONICAL_MOST, rows - 1));
  result = {};
  result.column.push_back(std::move(mean));
  for (const std::vector<double>& u : vectors) {
    if (std::sqrt(std::max(total, 0.0) / weights) < allowed) {
      break;
    }
    std::vector<float> row(rows);
    std::vector<double> v(columns);
    for (size_t r = 0; r < rows; ++r) {
      row[r] = static_cast<float>(u[r]);
      for (size_t c = 0; c < columns; ++c) {
        v[c] += u[r] * static_cast<double>(a[r * columns + c]);
      }
    }
    double most = 0;  // of columns with light
    for (size_t c = 0; c < columns; ++c) {
      total -= weight[c] * weight[c] * v[c] * v[c];
      most = std::max(most, weight[c] > 2 * LEAST_WEIGHT ? std::abs(v[c]) : 0);
    }
    std::vector<float> column(columns);
    for (size_t c = 0; c < columns; ++c) {
      column[c] = static_cast<float>(result.row.empty() ? v[c] : std::clamp(v[c], -most, most));
    }
    result.row.push_back(std::move(row));
    result.column.push_back(std::move(column));
  }
}

}  // namespace

CanonicalDraft emptyCanonicalDraft() {
  CanonicalDraft draft;
  for (size_t part = 0; part < CANONICAL_PARTS; ++part) {
    draft.value[part].resize(CANONICAL_SETS * 2 * gridOf(part).rows() * gridOf(part).columns());
  }
  draft.weight.resize(CANONICAL_SETS * 2 * RADIANCE_GRID.columns());
  return draft;
}

double canonicalNodeThickness(size_t i) {
  const double x = static_cast<double>(i) / (RADIANCE_GRID.thickness - 1);
  return CANONICAL_THINNEST * std::pow(CANONICAL_THICKEST / CANONICAL_THINNEST, x);
}

// Inverse of canonicalDepth: (1 + d / a) / (1 + (t - d) / a) = (1 + t / a)^(2 x - 1).
double canonicalNodeDepth(size_t i, double thickness) {
  const double x = static_cast<double>(i) / (RADIANCE_GRID.depth - 1);
  const double q = std::pow(1 + thickness / CANONICAL_FACE, 2 * x - 1);
  return std::clamp((q * (CANONICAL_FACE + thickness) - CANONICAL_FACE) / (1 + q), 0.0, thickness);
}

double canonicalNodeCosine(size_t i, size_t count) {
  const double least = std::sqrt(CANONICAL_COSINE);
  const double root = least + (1 - least) * static_cast<double>(i) / static_cast<double>(count - 1);
  return std::min(root * root, 1.0);
}

void canonicalPhaseCurves(const std::vector<double>& moments, CanonicalTable& table) {
  table.asymmetry = moments[1];
  std::vector<double> legendre(moments.size());
  for (size_t angle = 0; angle < CANONICAL_ANGLES; ++angle) {
    slabLegendre(0, std::cos(PI * static_cast<double>(angle) / (CANONICAL_ANGLES - 1)), legendre);
    for (size_t set = 0; set < CANONICAL_SETS; ++set) {
      double sum = 0;
      for (size_t l = 0; l < moments.size(); ++l) {
        sum += (2 * static_cast<double>(l) + 1) / (4 * PI) *
               std::pow(moments[l], SLAB_ORDERS[set]) * legendre[l];
      }
      table.logPhase[set][angle] = static_cast<float>(std::log(std::max(sum, 1e-6)));
    }
  }
}

void computeCanonical(size_t thickness, const std::vector<double>& moments,
                      const CanonicalTable& table, CanonicalDraft& draft) {
  const CanonicalGrid& grid = RADIANCE_GRID;
  const double t = canonicalNodeThickness(thickness);
  const SlabMedium medium(moments, t);
  const SlabTail tail(medium);
  std::vector<double> mu;
  for (size_t i = 0; i < grid.mu; ++i) {
    mu.push_back(canonicalNodeCosine(i, grid.mu));
  }
  const SlabDirections views = medium.directions(mu, std::vector<double>(grid.mu));
  // Depths, and as close to a face as its light begins.
  const double inside = FACE * std::min(t, 1.0);
  std::vector<double> depths;
  for (size_t i = 0; i < grid.depth; ++i) {
    depths.push_back(std::clamp(canonicalNodeDepth(i, t), inside, t - inside));
  }
  std::vector<double> suns;
  for (size_t i = 0; i < grid.light; ++i) {
    suns.push_back(canonicalNodeCosine(i, grid.light));
  }
  for (size_t sun = 0; sun < grid.light; ++sun) {
    if (sun % SLAB_LANES != 0) {
      continue;
    }
    const SlabOrders orders(tail,
                            std::span(suns).subspan(sun, std::min(SLAB_LANES, grid.light - sun)));
    for (size_t set = 0; set < CANONICAL_SETS; ++set) {
      const SlabLight light = orders.light(set, views, depths);
      for (size_t l = sun; l < std::min(sun + SLAB_LANES, grid.light); ++l) {
        std::vector<SlabTransport> found;  // [up][depth][mu][phi]
        double most = 0;
        for (size_t i = 0; i < 2 * grid.depth * grid.rows(); ++i) {
          const size_t row = i % grid.rows();
          const size_t d = i / grid.rows() % grid.depth;
          const bool up = i >= grid.depth * grid.rows();
          const double phi =
              PI * static_cast<double>(row % grid.phi) / static_cast<double>(grid.phi - 1);
          found.push_back(light.at(l - sun, row / grid.phi, up, d, phi));
          most = std::max(most, found.back().radiance);
        }
        for (size_t i = 0; i < found.size(); ++i) {
          const size_t row = i % grid.rows();
          const size_t d = i / grid.rows() % grid.depth;
          const bool up = i >= grid.depth * grid.rows();
          const double phi =
              PI * static_cast<double>(row % grid.phi) / static_cast<double>(grid.phi - 1);
          const double cosine = mu[row / grid.phi];
          const SlabTransport& here = found[i];
          const double sines =
              std::sqrt((1 - cosine) * (1 + cosine) * (1 - suns[l]) * (1 + suns[l]));
          const double angle = std::acos(
              std::clamp((up ? -cosine : cosine) * suns[l] + sines * std::cos(phi), -1.0, 1.0));
          const double length = canonicalLength(depths[d], t, up ? -1.0 : 1.0) / cosine;
          const double radiance = std::max(here.radiance, LEAST * most);
          const size_t pair = pairOf(set, up);
          const size_t column = (thickness * grid.depth + d) * grid.light + l;
          draft.value[0][(pair * grid.rows() + row) * grid.columns() + column] =
              static_cast<float>(std::log(radiance / (suns[l] * oneMinusExp(length))) -
                                 canonicalLogPhase(table, set, angle));
          float& weight = draft.weight[pair * grid.columns() + column];
          weight = std::max(weight, static_cast<float>(radiance));
          const size_t v = row / grid.phi;
          const size_t a = row % grid.phi;
          if (thickness % 2 + d % 2 + l % 2 + v % 2 + a % 2 == 0) {
            const CanonicalGrid& coarse = COLLECTOR_GRID;
            const size_t at =
                (pair * coarse.rows() + v / 2 * coarse.phi + a / 2) * coarse.columns() +
                (thickness / 2 * coarse.depth + d / 2) * coarse.light + l / 2;
            const double width = std::max(here.width, 1e-12);
            const bool dark = here.radiance < LEAST * most;
            draft.value[1][at] = static_cast<float>(dark ? 0 : here.x / width);
            draft.value[2][at] = static_cast<float>(dark ? 0 : here.y / width);
            draft.value[3][at] = static_cast<float>(std::log(dark ? t : width));
          }
        }
      }
    }
  }
}

void compressCanonical(const CanonicalDraft& draft, CanonicalTable& table) {
  for (size_t part = 0; part < CANONICAL_PARTS; ++part) {
    const CanonicalGrid& grid = gridOf(part);
    const size_t size = grid.rows() * grid.columns();
    for (size_t pair = 0; pair < CANONICAL_SETS * 2; ++pair) {
      const std::vector<float>& all = draft.value[part];
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(pair * size);
      compressMatrix({begin, begin + static_cast<std::ptrdiff_t>(size)},
                     columnWeights(draft, pair, part), grid, ALLOWED[part],
                     table.at(static_cast<CanonicalPart>(part), pair / 2, pair % 2 == 1));
    }
  }
}

}  // namespace welkin
