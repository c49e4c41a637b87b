// SPDX-License-Identifier: MIT
#include "particles/phase_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particles/refractive_index.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;
constexpr double GREEN_um = 0.55;
constexpr double WATER_TEMPERATURE_C = 10;

// Angles that stay, and angles that move with the index of refraction.
constexpr size_t MARKS = 6;
using Marks = std::array<double, MARKS>;

Marks marksOf(Features features, double index) {
  if (features == Features::Bows) {
    return {0, 110 * DEGREE, bowAngle(index, 3), bowAngle(index, 2), 160 * DEGREE, PI};
  }
  return {0,           minimumDeviation(index, PI / 3),
          34 * DEGREE, minimumDeviation(index, PI / 2),
          70 * DEGREE, PI};
}

double stretch(const Marks& from, const Marks& to, double angle) {
  size_t i = 0;
  while (i + 2 < MARKS && angle > from[i + 1]) {
    ++i;
  }
  const double t = (angle - from[i]) / (from[i + 1] - from[i]);
  return to[i] + (to[i + 1] - to[i]) * t;
}

// Coordinate s of shaders/model/volume/forward_scattering.glsl, of an angle.
double coordinate(double angle) {
  const double half = std::clamp(angle, 0.0, PI) / 2;
  return 0.5 * (std::sqrt(std::sin(half)) + 1 - std::sqrt(std::max(std::cos(half), 0.0)));
}

}  // namespace

double bowAngle(double index, int p) {
  const double n2 = index * index;
  const double incidence = std::acos(std::sqrt((n2 - 1) / (p * p - 1.0)));
  const double refraction = std::asin(std::sin(incidence) / index);
  const double turned = 2 * (incidence - refraction) + (p - 1) * (PI - 2 * refraction);
  const double wrapped = std::fmod(turned, 2 * PI);
  return wrapped > PI ? 2 * PI - wrapped : wrapped;
}

double minimumDeviation(double index, double apex) {
  return 2 * std::asin(index * std::sin(apex / 2)) - apex;
}

double greenIndex(Features features) {
  return features == Features::Halos ? iceIndex(GREEN_um)
                                     : waterIndex(GREEN_um, WATER_TEMPERATURE_C);
}

double knotAngle(Features features, double index, double angle) {
  if (features == Features::None) {
    return angle;
  }
  return stretch(marksOf(features, index), marksOf(features, greenIndex(features)), angle);
}

double featureAngle(Features features, double index, double knot) {
  if (features == Features::None) {
    return knot;
  }
  return stretch(marksOf(features, greenIndex(features)), marksOf(features, index), knot);
}

PhaseColumn::PhaseColumn(const PhaseTable& table, size_t column, size_t channel) {
  const size_t knots = table.knot.size();
  const size_t first = (column * kTableChannels + channel) * knots;
  for (size_t i = 0; i < knots; ++i) {
    s_.push_back(coordinate(static_cast<double>(table.knot[i])));
    log_.push_back(static_cast<double>(table.logMin) +
                   static_cast<double>(table.logStep) * table.code[first + i]);
  }
  fit();
}

PhaseColumn::PhaseColumn(std::span<const double> knot, std::span<const double> logPhase)
    : log_(logPhase.begin(), logPhase.end()) {
  for (const double angle : knot) {
    s_.push_back(coordinate(angle));
  }
  fit();
}

// Slopes of the parabola through each knot and its neighbours. In s the ends are flat: P is even
// about 0 and pi.
void PhaseColumn::fit() {
  slope_.assign(s_.size(), 0.0);
  for (size_t i = 1; i + 1 < s_.size(); ++i) {
    const double before = s_[i] - s_[i - 1];
    const double after = s_[i + 1] - s_[i];
    const double left = (log_[i] - log_[i - 1]) / before;
    const double right = (log_[i + 1] - log_[i]) / after;
    slope_[i] = (left * after + right * before) / (before + after);
  }
}

double PhaseColumn::operator()(double knotAngle) const {
  const double s = coordinate(knotAngle);
  const auto after = std::upper_bound(s_.begin() + 1, s_.end() - 1, s);
  const auto i = static_cast<size_t>(after - s_.begin()) - 1;
  const double width = s_[i + 1] - s_[i];
  const double t = std::clamp((s - s_[i]) / width, 0.0, 1.0);
  const double u = 1 - t;
  return std::exp(u * u * ((1 + 2 * t) * log_[i] + t * width * slope_[i]) +
                  t * t * ((1 + 2 * u) * log_[i + 1] - u * width * slope_[i + 1]));
}

TablePlace placeIn(const PhaseTable& table, double axisValue, size_t channel) {
  TablePlace place;
  const std::span<const float> axis = table.axis;
  if (axis.size() < 2) {
    return place;
  }
  while (place.low + 2 < axis.size() && axisValue > static_cast<double>(axis[place.low + 1])) {
    ++place.low;
  }
  place.high = place.low + 1;
  const auto low = static_cast<double>(axis[place.low]);
  const auto high = static_cast<double>(axis[place.high]);
  place.t = std::clamp((axisValue - low) / (high - low), 0.0, 1.0);
  const auto scattered = [&](size_t column) {
    return 1 - static_cast<double>(table.delta[column * kTableChannels + channel]);
  };
  const double second = place.t * scattered(place.high);
  place.share = second / ((1 - place.t) * scattered(place.low) + second);
  return place;
}

TableFunction::TableFunction(const PhaseTable& table, double axisValue, size_t channel)
    : place_(placeIn(table, axisValue, channel)),
      column_{PhaseColumn(table, place_.low, channel), PhaseColumn(table, place_.high, channel)} {}

double TableFunction::operator()(double knotAngle) const {
  return (1 - place_.share) * column_[0](knotAngle) + place_.share * column_[1](knotAngle);
}

namespace {

double along(std::span<const float> values, const TablePlace& place, double t, size_t channel) {
  return std::lerp(static_cast<double>(values[place.low * kTableChannels + channel]),
                   static_cast<double>(values[place.high * kTableChannels + channel]), t);
}

}  // namespace

double tableAsymmetry(const PhaseTable& table, double axisValue, size_t channel) {
  const TablePlace place = placeIn(table, axisValue, channel);
  return along(table.asymmetry, place, place.share, channel);
}

double tableEfficiency(const PhaseTable& table, double axisValue, size_t channel) {
  // Geometric: small droplets scatter as the fourth power of their size.
  const TablePlace place = placeIn(table, axisValue, channel);
  const double low = along(table.efficiency, place, 0, channel);
  return low * std::pow(along(table.efficiency, place, 1, channel) / low, place.t);
}

double tableDelta(const PhaseTable& table, double axisValue, size_t channel) {
  const TablePlace place = placeIn(table, axisValue, channel);
  return along(table.delta, place, place.t, channel);
}

}  // namespace welkin
