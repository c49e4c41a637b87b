// SPDX-License-Identifier: MIT
#include "reference/phase_function.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;

// Number of bins in which a cell is looked up; only speed depends on it.
constexpr size_t BINS = 8192;

// [0, 2] to [0, 1], with fine steps at both ends: about the root of the angle to the nearer one.
double stretched(double y) {
  return y < 1 ? 0.5 * std::sqrt(std::sqrt(y))
               : 1 - 0.5 * std::sqrt(std::sqrt(std::max(2 - y, 0.0)));
}

size_t binOf(double position) {
  return std::min(static_cast<size_t>(position * BINS), BINS - 1);
}

// For each bin of [0, 1] a cell at or before that of every position in it.
template <typename Position>
std::vector<uint32_t> guideOf(size_t cells, Position position) {
  std::vector<uint32_t> guide(BINS);
  size_t cell = 0;
  for (size_t bin = 0; bin < BINS; ++bin) {
    // A bin earlier, against rounding of the position.
    const double start = (static_cast<double>(bin) - 1) / BINS;
    while (cell + 1 < cells && position(cell + 1) <= start) {
      ++cell;
    }
    guide[bin] = static_cast<uint32_t>(cell);
  }
  return guide;
}

}  // namespace

struct PhaseFunction::Table {
  struct Channel {
    std::vector<double> value;   // 1/sr at the nodes
    std::vector<double> energy;  // within [0, y of the node], 0 .. 1
    std::vector<uint32_t> energyGuide;
  };
  std::vector<double> y;
  std::vector<uint32_t> yGuide;
  std::array<Channel, 3> channels;
  bool grey = true;
};

PhaseFunction PhaseFunction::rayleigh() {
  PhaseFunction phase;
  phase.kind_ = Kind::RAYLEIGH;
  return phase;
}

PhaseFunction PhaseFunction::henyeyGreenstein(double g) {
  PhaseFunction phase;
  phase.g_ = g;
  return phase;
}

PhaseFunction PhaseFunction::table(const std::vector<double>& angles,
                                   const std::vector<Rgb>& values) {
  if (angles.size() < 2 || angles.size() != values.size() || angles.front() != 0 ||
      std::fabs(angles.back() - PI) > 1e-9) {
    throw std::invalid_argument("phase function: angles must rise from 0 to pi");
  }
  const auto table = std::make_shared<Table>();
  std::vector<double>& y = table->y;
  for (const double angle : angles) {
    const double sine = std::sin(angle / 2);
    y.push_back(2 * sine * sine);
    if (y.size() > 1 && y.back() <= y[y.size() - 2]) {
      throw std::invalid_argument("phase function: two angles are too near to each other");
    }
  }
  y.back() = 2;
  const size_t cells = y.size() - 1;
  table->yGuide = guideOf(cells, [&](size_t i) { return stretched(y[i]); });
  for (size_t c = 0; c < 3; ++c) {
    Table::Channel& channel = table->channels[c];
    channel.energy.push_back(0);
    channel.value.push_back(values[0][c]);
    for (size_t i = 0; i < cells; ++i) {
      channel.value.push_back(values[i + 1][c]);
      channel.energy.push_back(channel.energy[i] +
                               PI * (values[i][c] + values[i + 1][c]) * (y[i + 1] - y[i]));
    }
    const double whole = channel.energy.back();
    if (!(whole > 0)) {
      throw std::invalid_argument("phase function: nothing is scattered");
    }
    for (size_t i = 0; i <= cells; ++i) {
      channel.value[i] /= whole;
      channel.energy[i] /= whole;
    }
    channel.energyGuide = guideOf(cells, [&](size_t i) { return channel.energy[i]; });
    table->grey = table->grey && channel.value == table->channels[0].value;
  }
  PhaseFunction phase;
  phase.kind_ = Kind::TABLE;
  phase.table_ = table;
  return phase;
}

double PhaseFunction::value(size_t channel, double y) const {
  if (kind_ == Kind::HENYEY_GREENSTEIN) {
    // 1 + g^2 - 2 g cos = (1 - g)^2 + 2 g y.
    const double d = (1 - g_) * (1 - g_) + 2 * g_ * y;
    return (1 - g_) * (1 + g_) / (4 * PI * d * std::sqrt(d));
  }
  if (kind_ == Kind::RAYLEIGH) {
    return 3 / (16 * PI) * (1 + (1 - y) * (1 - y));
  }
  const std::vector<double>& nodes = table_->y;
  size_t i = table_->yGuide[binOf(stretched(y))];
  while (i + 2 < nodes.size() && nodes[i + 1] < y) {
    ++i;
  }
  const std::vector<double>& value = table_->channels[channel].value;
  const double part = std::min((y - nodes[i]) / (nodes[i + 1] - nodes[i]), 1.0);
  return value[i] + (value[i + 1] - value[i]) * part;
}

double PhaseFunction::sample(size_t channel, double u) const {
  if (kind_ == Kind::HENYEY_GREENSTEIN) {
    // The textbook's inversion, counted from the forward direction and freed of its differences.
    const double d = 1 + g_ - 2 * g_ * u;
    const double root = (1 - g_) * (1 + g_) / d;
    return std::min((1 - g_) * u * (root + 1 - g_) / d, 2.0);
  }
  if (kind_ == Kind::RAYLEIGH) {
    // c^3 + 3 c = 2 w by Cardano.
    const double w = 2 - 4 * u;
    const double root = std::cbrt(w + std::sqrt(w * w + 1));
    return std::clamp(1 - (root - 1 / root), 0.0, 2.0);
  }
  const std::vector<double>& nodes = table_->y;
  const Table::Channel& table = table_->channels[channel];
  size_t i = table.energyGuide[binOf(u)];
  while (i + 2 < nodes.size() && table.energy[i + 1] < u) {
    ++i;
  }
  // The energy within the cell is a parabola: 2 pi (a s + (b - a) s^2 / (2 width)) = rest.
  const double width = nodes[i + 1] - nodes[i];
  const double a = table.value[i];
  const double slope = (table.value[i + 1] - a) / width;
  const double rest = std::max(u - table.energy[i], 0.0) / (2 * PI);
  const double root = a + std::sqrt(std::max(a * a + 2 * slope * rest, 0.0));
  return nodes[i] + (root > 0 ? std::min(2 * rest / root, width) : 0.0);
}

bool PhaseFunction::grey() const {
  return kind_ != Kind::TABLE || table_->grey;
}

}  // namespace welkin::reference
