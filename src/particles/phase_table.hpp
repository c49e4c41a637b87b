// SPDX-License-Identifier: MIT
// Shipped phase functions: ln P in 16 bits over scattering angle, an axis (ln of the diameter in
// um, or roughness) and the three wavelengths. Made by table_builder.hpp, one table at most 16 KB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace welkin {

constexpr size_t kTableChannels = 3;

// Angles at which a table's features stand, so that wavelengths can be mixed feature on feature:
// the rainbows' Descartes angles, the halos' minimum deviations.
enum class Features : uint32_t { None, Bows, Halos };

// One table. Knots are angles (rad) at the features of GREEN; another index of refraction stretches
// them piecewise (featureAngle).
struct PhaseTable {
  const char* name;
  Features features;
  std::span<const float> knot;     // rad, rising, 0 .. pi
  std::span<const float> axis;     // rising
  float logMin;                    // ln P of code 0
  float logStep;                   // ln P of one code
  std::span<const uint16_t> code;  // [axis][channel][knot]
  // [axis][channel]: mean cosine of P, to which a curve is calibrated; extinction cross-section
  // over mean geometric cross-section; the part of the scattered light that goes straight on, not
  // in P.
  std::span<const float> asymmetry;
  std::span<const float> efficiency;
  std::span<const float> delta;
};

// Index of the green light that knots stand for: of water or ice as the features have it.
double greenIndex(Features features);

// The knot angle that belongs to `angle` at an index of refraction: identity without features.
double knotAngle(Features features, double index, double angle);

// Its inverse.
double featureAngle(Features features, double index, double knot);

// Scattering angle of the rainbow of p internal chords (2: primary) and of the minimum deviation
// through a prism of that apex, rad. [Descartes: cos i = sqrt((n^2 - 1) / (p^2 - 1))].
double bowAngle(double index, int p);
double minimumDeviation(double index, double apex);

// One column of a table's channel as a smooth function of the angle: ln P by cubics in the
// coordinate s of phaseCoordinate.
class PhaseColumn {
 public:
  PhaseColumn(const PhaseTable& table, size_t column, size_t channel);
  PhaseColumn(std::span<const double> knot, std::span<const double> logPhase);
  // P in 1/sr at a knot angle in rad.
  double operator()(double knotAngle) const;

 private:
  void fit();
  std::vector<double> s_;
  std::vector<double> log_;
  std::vector<double> slope_;
};

// Where a value stands between two columns; `share` is the second one's part of the light that does
// not go straight on, which is what P is the distribution of.
struct TablePlace {
  size_t low = 0;
  size_t high = 0;
  double t = 0;
  double share = 0;
};
TablePlace placeIn(const PhaseTable& table, double axisValue, size_t channel);

// P of a table at an axis value: linear in P between columns, which keeps the integral.
class TableFunction {
 public:
  TableFunction(const PhaseTable& table, double axisValue, size_t channel);
  double operator()(double knotAngle) const;

 private:
  TablePlace place_;
  std::array<PhaseColumn, 2> column_;
};

// Asymmetry as P, delta linear along the axis, efficiency geometric.
double tableAsymmetry(const PhaseTable& table, double axisValue, size_t channel);
double tableEfficiency(const PhaseTable& table, double axisValue, size_t channel);
double tableDelta(const PhaseTable& table, double axisValue, size_t channel);

// The tables that come with the library.
extern const PhaseTable HAZE_TABLE;        // droplets of 0.1 to 6 um, spread 0.25
extern const PhaseTable DROPLET_TABLE;     // droplets of 4 to 62.5 um, spread 0.25
extern const PhaseTable RAIN_TABLE;        // drops of 100 to 2000 um, spread 0.25
extern const PhaseTable ICE_COLUMN_TABLE;  // aspect 2.5, roughness 0 to 0.2
extern const PhaseTable ICE_PLATE_TABLE;   // aspect 0.25, roughness 0 to 0.2
extern const PhaseTable SNOW_TABLE;        // aspect 1, roughness 0.3 to 0.6

}  // namespace welkin
