// SPDX-License-Identifier: MIT
#include "tables/slab_medium.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tables/gauss_rule.hpp"

namespace welkin {
namespace {

constexpr size_t BLOCK = 4 * SLAB_LANES;
constexpr size_t LANES = SLAB_LANES;

}  // namespace

void combineRows(std::span<const double> coefficient, size_t columns, const double* in,
                 size_t stride, double* out, size_t outStride, size_t count) {
  const size_t rows = columns > 0 ? coefficient.size() / columns : 0;
  size_t at = 0;
  for (; at + BLOCK <= count; at += BLOCK) {
    for (size_t r = 0; r < rows; ++r) {
      double sum[BLOCK] = {};
      for (size_t c = 0; c < columns; ++c) {
        const double factor = coefficient[r * columns + c];
        const double* const row = in + c * stride + at;
        for (size_t i = 0; i < BLOCK; ++i) {
          sum[i] += factor * row[i];
        }
      }
      std::copy_n(sum, BLOCK, out + r * outStride + at);
    }
  }
  for (; at < count; ++at) {
    for (size_t r = 0; r < rows; ++r) {
      double sum = 0;
      for (size_t c = 0; c < columns; ++c) {
        sum += coefficient[r * columns + c] * in[c * stride + at];
      }
      out[r * outStride + at] = sum;
    }
  }
}

void slabLegendre(int m, double mu, std::span<double> result) {
  const double sine = std::sqrt(std::max((1 - mu) * (1 + mu), 0.0));
  double first = 1;
  for (int k = 1; k <= m; ++k) {
    first *= sine * std::sqrt((2.0 * k - 1) / (2.0 * k));
  }
  for (size_t i = 0; i < result.size(); ++i) {
    const double l = m + static_cast<double>(i);
    if (i == 0) {
      result[i] = first;
      continue;
    }
    const double before = i > 1 ? std::sqrt((l - 1) * (l - 1) - m * m) * result[i - 2] : 0;
    result[i] = ((2 * l - 1) * mu * result[i - 1] - before) / std::sqrt(l * l - m * m);
  }
}

SlabMedium::SlabMedium(std::vector<double> moments, double thickness, size_t nodes, double fineness)
    : moments_(std::move(moments)), depth_(slabDepths(thickness, fineness)) {
  GaussRule rule = gaussRule(nodes);
  nodes_ = directions(std::move(rule.node), std::move(rule.weight));
}

SlabDirections SlabMedium::directions(std::vector<double> mu, std::vector<double> weight) const {
  SlabDirections result;
  const size_t count = mu.size();
  for (size_t m = 0; m < moments_.size(); ++m) {
    const size_t terms = moments_.size() - m;
    std::vector<double> values(terms);
    std::vector<double>& table = result.legendre.emplace_back(terms * count);
    for (size_t i = 0; i < count; ++i) {
      slabLegendre(static_cast<int>(m), mu[i], values);
      for (size_t l = 0; l < terms; ++l) {
        table[l * count + i] = values[l];
      }
    }
  }
  const size_t cells = depth_.size() / 2;
  for (const double cosine : mu) {
    for (size_t cell = 0; cell < cells; ++cell) {
      const double length = (depth_[2 * cell + 2] - depth_[2 * cell]) / (2 * cosine);
      result.steps.push_back({slabStep(length, {0, 1, -1}), slabStep(length, {0, 1, 2})});
    }
  }
  result.mu = std::move(mu);
  result.weight = std::move(weight);
  return result;
}

SlabMoments SlabMedium::zeros(int modes) const {
  SlabMoments result;
  result.modes = modes;
  const auto size = [&](int m) {
    return (moments_.size() - static_cast<size_t>(std::abs(m))) * depth_.size() * LANES;
  };
  for (int m = -modes; m <= modes; ++m) {
    result.shift.emplace_back(size(m));
    if (m >= 0) {
      result.intensity.emplace_back(size(m));
      result.spread.emplace_back(size(m));
    }
  }
  return result;
}

std::vector<double>& SlabMedium::part(SlabMoments& moments, SlabField field, int m) const {
  if (field == SlabField::Shift) {
    const int turn = m + moments.modes;
    return moments.shift[static_cast<size_t>(turn)];
  }
  return (field == SlabField::Intensity ? moments.intensity
                                        : moments.spread)[static_cast<size_t>(m)];
}

const std::vector<double>& SlabMedium::part(const SlabMoments& moments, SlabField field,
                                            int m) const {
  return part(const_cast<SlabMoments&>(moments), field, m);
}

// J_m = 1/2 sum over l of (2 l + 1) chi_l Lambda_l f_l; terms of odd l - m change sign upwards.
void SlabMedium::sources(const SlabMoments& from, SlabField field, int m,
                         const SlabDirections& directions, SlabRays& rays) const {
  const size_t directionCount = directions.mu.size();
  const size_t row = depth_.size() * LANES;
  const auto order = static_cast<size_t>(std::abs(m));
  const size_t terms = moments_.size() - order;
  const std::vector<double>& f = part(from, field, m);
  rays.source.resize(2 * directionCount * row);
  rays.light.resize(2 * directionCount * row);
  std::vector<double> coefficient;
  for (size_t parity = 0; parity < 2; ++parity) {
    const size_t columns = (terms + 1 - parity) / 2;
    coefficient.assign(directionCount * columns, 0);
    for (size_t i = 0; i < directionCount; ++i) {
      for (size_t c = 0; c < columns; ++c) {
        const size_t l = order + 2 * c + parity;
        coefficient[i * columns + c] = (static_cast<double>(l) + 0.5) * moments_[l] *
                                       directions.legendre[order][(l - order) * directionCount + i];
      }
    }
    double* const out = rays.source.data() + parity * directionCount * row;
    if (columns == 0) {
      std::fill_n(out, directionCount * row, 0.0);
    } else {
      combineRows(coefficient, columns, f.data() + parity * row, 2 * row, out, row, row);
    }
  }
  double* const down = rays.source.data();
  double* const up = down + directionCount * row;
  for (size_t i = 0; i < directionCount * row; ++i) {
    const double even = down[i];
    const double odd = up[i];
    down[i] = even + odd;
    up[i] = even - odd;
  }
}

void SlabMedium::integrate(const SlabDirections& directions, const SlabModeRays& mode,
                           SlabRays& rays) const {
  const size_t count = directions.mu.size();
  const size_t depths = depth_.size();
  const size_t cells = depths / 2;
  for (size_t ray = 0; ray < 2 * count; ++ray) {
    const bool up = ray >= count;
    const double mu = directions.mu[ray % count];
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    const size_t base = ray * depths * LANES;
    const auto node = [&](size_t k) { return base + (up ? depths - 1 - k : k) * LANES; };
    std::fill_n(rays.light.data() + node(0), LANES, 0.0);
    for (size_t k = 0; k + 1 < depths; ++k) {
      const size_t cell = up ? cells - 1 - k / 2 : k / 2;
      const SlabStep& step = directions.steps[(ray % count) * cells + cell][k % 2];
      const size_t end = node(k + 1);
      const size_t start = node(k);
      const size_t third = k % 2 == 0 ? node(k + 2) : node(k - 1);
      double value[LANES];
      const auto add = [&](const SlabRays* other, size_t p, double factor) {
        if (other == nullptr) {
          return;
        }
        const double carried = step.decay * factor *
                               (p == 0   ? 1
                                : p == 1 ? step.length
                                         : step.length * step.length);
        const double w0 = factor * step.weight[p][0];
        const double w1 = factor * step.weight[p][1];
        const double w2 = factor * step.weight[p][2];
        const double* const source = other->source.data();
        const double* const light = other->light.data();
        for (size_t lane = 0; lane < LANES; ++lane) {
          value[lane] += carried * light[start + lane] + w0 * source[end + lane] +
                         w1 * source[start + lane] + w2 * source[third + lane];
        }
      };
      std::fill_n(value, LANES, 0.0);
      add(&rays, 0, 1);
      if (mode.field == SlabField::Shift) {
        add(mode.before[0], 1, sine);
      } else if (mode.field == SlabField::Spread) {
        add(mode.before[0], 1, sine);
        add(mode.before[1], 1, sine);
        add(mode.before[2], 2, sine * sine);
      }
      std::copy_n(value, LANES, rays.light.data() + end);
    }
  }
}

void SlabMedium::sweep(const SlabMoments& from, const SlabDirections& directions,
                       const SlabVisitor& visit) const {
  // The last four modes of each kind: intensity, shift of m >= 0, shift of m <= 0.
  std::array<std::array<SlabRays, 4>, 3> kept;
  SlabRays spread;
  const int last = from.modes;
  const auto slot = [&](size_t kind, int m) -> SlabRays* {
    return &kept[kind][static_cast<size_t>(std::abs(m)) % 4];
  };
  const auto intensityOf = [&](int m) { return std::abs(m) <= last ? slot(0, m) : nullptr; };
  const auto shiftOf = [&](int m) {
    return std::abs(m) > last ? nullptr : m >= 0 ? slot(1, m) : slot(2, m);
  };
  const auto follow = [&](SlabField field, int m, SlabRays* rays,
                          const std::array<const SlabRays*, 3>& before) {
    if (std::abs(m) > last) {
      return;
    }
    sources(from, field, m, directions, *rays);
    const SlabModeRays mode = {field, m, rays, before};
    integrate(directions, mode, *rays);
    visit(mode);
  };
  const auto intensity = [&](int m) { follow(SlabField::Intensity, m, slot(0, m), {}); };
  const auto shift = [&](int m) {
    follow(SlabField::Shift, m, m >= 0 ? slot(1, m) : slot(2, m), {intensityOf(m - 1)});
  };
  intensity(0);
  intensity(1);
  shift(0);
  for (int m = 0; m <= last; ++m) {
    if (m > 0) {
      intensity(m + 1);
      shift(-m);
    }
    shift(m + 1);
    follow(SlabField::Spread, m, &spread, {shiftOf(m + 1), shiftOf(1 - m), intensityOf(m)});
  }
}

void SlabMedium::project(const SlabModeRays& mode, SlabMoments& to) const {
  const size_t count = nodes_.mu.size();
  const size_t row = depth_.size() * LANES;
  const auto order = static_cast<size_t>(std::abs(mode.m));
  const size_t terms = moments_.size() - order;
  std::vector<double>& f = part(to, mode.field, mode.m);
  std::vector<double> sum(count * row);
  std::vector<double> coefficient;
  const double* const down = mode.rays->light.data();
  const double* const up = down + count * row;
  for (size_t parity = 0; parity < 2; ++parity) {
    const size_t rows = (terms + 1 - parity) / 2;
    if (rows == 0) {
      continue;
    }
    const double sign = parity == 0 ? 1 : -1;
    for (size_t i = 0; i < sum.size(); ++i) {
      sum[i] = down[i] + sign * up[i];
    }
    coefficient.resize(rows * count);
    for (size_t r = 0; r < rows; ++r) {
      for (size_t i = 0; i < count; ++i) {
        coefficient[r * count + i] =
            nodes_.weight[i] * nodes_.legendre[order][(2 * r + parity) * count + i];
      }
    }
    combineRows(coefficient, count, sum.data(), row, f.data() + parity * row, 2 * row, row);
  }
}

SlabMoments SlabMedium::scatter(const SlabMoments& from) const {
  SlabMoments result = zeros(from.modes);
  sweep(from, nodes_, [&](const SlabModeRays& mode) { project(mode, result); });
  return result;
}

}  // namespace welkin
