// SPDX-License-Identifier: MIT
#include "particles/table_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/model.hpp"
#include "particles/ice_crystal.hpp"
#include "particles/mie_average.hpp"
#include "particles/refractive_index.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;
constexpr double SPREAD = 0.25;  // [J23] 1.1
constexpr double WATER_TEMPERATURE_C = 10;
// Light that drops turn by less than this goes straight on: it stays within the sun's own width.
constexpr double STRAIGHT = 0.5 * DEGREE;

std::vector<double> evenly(double first, double last, size_t count) {
  std::vector<double> values;
  for (size_t i = 0; i < count; ++i) {
    values.push_back(
        std::lerp(first, last, static_cast<double>(i) / static_cast<double>(count - 1)));
  }
  return values;
}

// Angles at even steps of the coordinate s.
std::vector<double> warpedAngles(size_t count) {
  std::vector<double> angles;
  for (const double s : evenly(0, 1, count)) {
    angles.push_back(2 * std::asin(std::sqrt(std::min(model::f64::curveNode(s) / 2, 1.0))));
  }
  angles.back() = PI;
  return angles;
}

// The same with other steps (degrees) in zones: {begin, end, step}.
struct Zone {
  double begin, end, step;
};
std::vector<double> zonedAngles(size_t count, std::initializer_list<Zone> zones) {
  std::vector<double> angles;
  for (const double angle : warpedAngles(count)) {
    const bool outside = std::none_of(zones.begin(), zones.end(), [&](const Zone& zone) {
      return angle > (zone.begin - zone.step) * DEGREE && angle < (zone.end + zone.step) * DEGREE;
    });
    if (outside) {
      angles.push_back(angle);
    }
  }
  for (const Zone& zone : zones) {
    const auto steps = static_cast<size_t>(std::lround((zone.end - zone.begin) / zone.step));
    for (const double angle : evenly(zone.begin, zone.end, steps + 1)) {
      angles.push_back(angle * DEGREE);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

// Droplets: dense about the rings of corona and glory, whose radii go with 1 / diameter (even steps
// of ln of the distance from 0 and 180 degrees), and about the fogbow.
std::vector<double> dropletAngles() {
  constexpr double RING_BEGIN = 0.15;
  constexpr double CORONA_END = 6;
  constexpr double GLORY_END = 4;
  std::vector<double> angles;
  for (const double angle : zonedAngles(58, {{118, 150.3, 0.85}})) {
    const double fromBack = 180 - angle / DEGREE;
    const bool corona = angle > RING_BEGIN * DEGREE && angle < CORONA_END * DEGREE;
    if (!corona && !(fromBack > RING_BEGIN && fromBack < GLORY_END)) {
      angles.push_back(angle);
    }
  }
  for (const double ln : evenly(std::log(RING_BEGIN), std::log(CORONA_END), 31)) {
    angles.push_back(std::exp(ln) * DEGREE);
  }
  for (const double ln : evenly(std::log(RING_BEGIN), std::log(GLORY_END), 12)) {
    angles.push_back(PI - std::exp(ln) * DEGREE);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

double indexOf(const TableDraft& draft, size_t channel) {
  const double wavelength_um = RGB_WAVELENGTH_UM[channel];
  return draft.features == Features::Halos ? iceIndex(wavelength_um)
                                           : waterIndex(wavelength_um, WATER_TEMPERATURE_C);
}

// Integral over the sphere from `begin` on, of a column without features' stretching.
double energyBeyond(const PhaseColumn& column, Features features, double index, double begin) {
  constexpr int STEPS = 20000;
  double sum = 0;
  for (int i = 0; i < STEPS; ++i) {
    const double angle = std::lerp(begin, PI, (i + 0.5) / STEPS);
    sum += column(knotAngle(features, index, angle)) * std::sin(angle);
  }
  return 2 * PI * sum * (PI - begin) / STEPS;
}

// Takes the peak narrower than STRAIGHT out of a column of ln P; the part of the energy that it is.
double removePeak(std::span<const double> knot, std::span<double> logPhase, Features features,
                  double index) {
  const PhaseColumn whole(knot, logPhase);
  const double level = whole(STRAIGHT);
  const double rest = energyBeyond(whole, features, index, STRAIGHT) +
                      level * 4 * PI * std::pow(std::sin(STRAIGHT / 2), 2);
  for (size_t i = 0; i < knot.size(); ++i) {
    logPhase[i] = (knot[i] < STRAIGHT ? std::log(level) : logPhase[i]) - std::log(rest);
  }
  return 1 - rest;
}

void computeDroplets(TableKind kind, TableDraft& draft, size_t first, size_t end, size_t channel,
                     unsigned threads) {
  const double index = indexOf(draft, channel);
  std::vector<SizeDistribution> sizes;
  for (size_t column = first; column < end; ++column) {
    sizes.push_back({SizeKind::LogNormal, std::exp(draft.axis[column]) / 2, SPREAD});
  }
  std::vector<double> angles;
  for (const double knot : draft.knot) {
    angles.push_back(featureAngle(draft.features, index, knot));
  }
  MieSettings settings;
  settings.threads = threads;
  if (kind == TableKind::Rain) {
    settings.solarDisk = true;
    settings.nodesPerSpread = 128;
    settings.largestSizeParameter = 20000;
  }
  const std::vector<MieAverage> means = averageMie(
      sizes, waterSample(RGB_WAVELENGTH_UM[channel], WATER_TEMPERATURE_C), angles, settings);
  for (size_t i = 0; i < means.size(); ++i) {
    const size_t cell = (first + i) * kTableChannels + channel;
    const size_t knots = draft.knot.size();
    const std::span<double> out(&draft.logPhase[cell * knots], knots);
    std::transform(means[i].phase.begin(), means[i].phase.end(), out.begin(),
                   [](double p) { return std::log(p); });
    draft.asymmetry[cell] = means[i].asymmetry;
    draft.efficiency[cell] = means[i].extinction_um2 / (PI * meanPower(sizes[i], 2));
    if (kind == TableKind::Rain) {
      draft.delta[cell] = removePeak(draft.knot, out, draft.features, index);
      // What goes straight on has a cosine of 1 to 4e-5.
      draft.asymmetry[cell] = (means[i].asymmetry - draft.delta[cell]) / (1 - draft.delta[cell]);
    }
  }
}

double aspectOf(TableKind kind) {
  return kind == TableKind::IceColumn ? 2.5 : kind == TableKind::IcePlate ? 0.25 : 1.0;
}

void computeIce(TableKind kind, TableDraft& draft, size_t first, size_t end, size_t channel) {
  const double index = indexOf(draft, channel);
  std::vector<double> angles;
  for (const double knot : draft.knot) {
    angles.push_back(featureAngle(draft.features, index, knot));
  }
  for (size_t column = first; column < end; ++column) {
    const IcePhase ice = icePhase({aspectOf(kind), draft.axis[column]}, index, angles, {});
    const size_t cell = column * kTableChannels + channel;
    for (size_t i = 0; i < angles.size(); ++i) {
      draft.logPhase[cell * angles.size() + i] = std::log(std::max(ice.phase[i], 1e-6));
    }
    draft.asymmetry[cell] = ice.asymmetry;
    draft.efficiency[cell] = 2;  // half of it diffraction
    draft.delta[cell] = 0.5 + 0.5 * ice.deltaTransmission;
  }
}

}  // namespace

TableDraft emptyDraft(TableKind kind) {
  TableDraft draft;
  const Zone halos[] = {{20.5, 27, 0.15}, {43, 52, 0.2}};
  switch (kind) {
    case TableKind::Haze:
      draft.name = "haze";
      draft.knot = warpedAngles(96);
      draft.axis = evenly(std::log(0.08), std::log(6.0), 25);
      break;
    case TableKind::Droplet:
      draft.name = "droplet";
      draft.features = Features::Bows;
      draft.knot = dropletAngles();
      draft.axis = evenly(std::log(4.0), std::log(62.5), 20);
      break;
    case TableKind::Rain:
      draft.name = "rain";
      draft.features = Features::Bows;
      draft.knot = zonedAngles(116, {{124, 145, 0.15}});
      draft.axis = evenly(std::log(100.0), std::log(2000.0), 10);
      break;
    case TableKind::IceColumn:
    case TableKind::IcePlate:
      draft.name = kind == TableKind::IceColumn ? "ice_column" : "ice_plate";
      draft.features = Features::Halos;
      draft.knot = zonedAngles(180, {halos[0], halos[1]});
      draft.axis = {0, 0.01, 0.02, 0.05, 0.1, 0.2};
      break;
    case TableKind::Snow:
      draft.name = "snow";
      draft.knot = warpedAngles(128);
      draft.axis = {0.3, 0.45, 0.6};
      break;
  }
  const size_t cells = draft.axis.size() * kTableChannels;
  draft.logPhase.assign(cells * draft.knot.size(), 0.0);
  draft.asymmetry.assign(cells, 0.0);
  draft.efficiency.assign(cells, 0.0);
  draft.delta.assign(cells, 0.0);
  return draft;
}

void computeColumns(TableKind kind, TableDraft& draft, size_t first, size_t end, size_t channel,
                    unsigned threads) {
  if (kind == TableKind::Haze || kind == TableKind::Droplet || kind == TableKind::Rain) {
    computeDroplets(kind, draft, first, end, channel, threads);
  } else {
    computeIce(kind, draft, first, end, channel);
  }
}

StoredTable store(const TableDraft& draft) {
  StoredTable table;
  table.name = draft.name;
  table.features = draft.features;
  const auto rounded = [](const std::vector<double>& values) {
    std::vector<float> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(),
                   [](double value) { return static_cast<float>(value); });
    return result;
  };
  table.knot = rounded(draft.knot);
  table.axis = rounded(draft.axis);
  table.asymmetry = rounded(draft.asymmetry);
  table.efficiency = rounded(draft.efficiency);
  table.delta = rounded(draft.delta);
  const auto [low, high] = std::minmax_element(draft.logPhase.begin(), draft.logPhase.end());
  constexpr double CODES = std::numeric_limits<uint16_t>::max();
  table.logMin = static_cast<float>(*low);
  table.logStep = static_cast<float>((*high - *low) / CODES);
  for (const double value : draft.logPhase) {
    const double code = (value - static_cast<double>(table.logMin)) /
                        std::max(static_cast<double>(table.logStep), 1e-30);
    table.code.push_back(static_cast<uint16_t>(std::clamp(std::round(code), 0.0, CODES)));
  }
  return table;
}

PhaseTable StoredTable::view() const {
  return {name.c_str(), features, knot, axis, logMin, logStep, code, asymmetry, efficiency, delta};
}

size_t StoredTable::bytes() const {
  return (knot.size() + axis.size() + asymmetry.size() + efficiency.size() + delta.size()) *
             sizeof(float) +
         code.size() * sizeof(uint16_t) + 2 * sizeof(float);
}

}  // namespace welkin
