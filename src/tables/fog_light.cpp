// SPDX-License-Identifier: MIT
#include "tables/fog_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/air_input.hpp"
#include "model/model.hpp"
#include "tables/sky_table.hpp"

namespace welkin {
namespace {

using namespace model::f64;

constexpr double PI = std::numbers::pi;
constexpr size_t SUNS = FogLight::SUNS;
constexpr size_t HEIGHTS = FogLight::HEIGHTS;
constexpr size_t AZIMUTHS = FogLight::AZIMUTHS;
constexpr size_t VIEWS = FogLight::VIEWS;

double nodeOf(size_t i, size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

// 1 degree apart at the horizon, 6 at the zenith.
double sunAt(size_t s) {
  const double x = nodeOf(s, SUNS);
  return std::sin(0.5 * PI * x * std::sqrt(x));
}

double viewAt(size_t v) {
  return std::cos(PI * nodeOf(v, VIEWS));
}

double azimuthAt(size_t a) {
  return PI * nodeOf(a, AZIMUTHS) * nodeOf(a, AZIMUTHS);
}

double verticalDepth(const Air& air, double altitude, int colour) {
  return lightOpticalDepth(air, altitude, 1.0)[colour];
}

// Mean of a quantity that falls exponentially from one end to the other.
double meanBetween(double from, double to) {
  const double ratio = std::log(std::max(from, 1e-300) / std::max(to, 1e-300));
  return std::abs(ratio) > 1e-6 ? (from - to) / ratio : 0.5 * (from + to);
}

// Edges of cells by the depth above them: dense at both ends. More of them do not change fog of
// depths up to 8, 40 and 100 by more than 1 %. Light at the ground goes like x log x in the depth x
// above it: three more cells there.
std::vector<double> edgesOf(double total) {
  const size_t count = total < 8 ? 32 : (total < 40 ? 48 : 64);
  const double bend = std::log1p(2 * total);
  std::vector<double> edges;
  for (size_t k = 0; k <= count; ++k) {
    const double x = 2 * nodeOf(k, count + 1) - 1;
    edges.push_back(0.5 * total * (1 + std::asinh(std::sinh(bend) * x) / bend));
  }
  for (int i = 0; i < 3; ++i) {
    edges.insert(edges.end() - 1, 0.5 * (edges[edges.size() - 2] + total));
  }
  return edges;
}

}  // namespace

class FogLight::Maker {
 public:
  Maker(const FogLightInput& input, FogLight& light);
  void make(size_t colour);

 private:
  // Of a node of the table's heights: cells beside it, and the share of the lower one.
  struct Place {
    size_t cell = 0;
    double share = 0;
  };
  void placeHeights(double top);
  std::vector<FogCell> cellsOf(size_t colour) const;
  FogBeam beamOf(size_t sun, int colour) const;
  void fill(size_t colour, size_t sun, const std::vector<FogField>& field);

  const FogLightInput& input_;
  FogLight& light_;
  Air all_;
  Air fog_;
  Air air_;
  std::vector<double> altitudes_;  // of the cells' edges, from the top down
  std::vector<double> depths_;     // above them, of all in green
  std::array<Place, HEIGHTS> places_{};
  std::vector<std::array<FogTermsOf, FOG_TERMS>> legendre_;  // [view][order]
};

FogLight::Maker::Maker(const FogLightInput& input, FogLight& light)
    : input_(input), light_(light), all_(airFrom(input.air)) {
  AirInput one = input.air;
  std::fill(std::begin(one.absorption), std::end(one.absorption), 0.0);
  one.fogExtinction = 0;
  air_ = airFrom(one);
  one.fogExtinction = input.air.fogExtinction;
  std::fill(std::begin(one.airScattering), std::end(one.airScattering), 0.0);
  fog_ = airFrom(one);
  light_.scaleHeight_ = input.air.fogScaleHeight;
  light_.depth_ = verticalDepth(fog_, 0, 1);
  double asymmetry = 0;
  for (const FogTermsOf& terms : input.terms) {
    asymmetry += terms[1] * terms[1] / 3;
  }
  light_.asymmetry_ = std::clamp(asymmetry, 0.0, 0.9);

  const double top = SkyAxes(input.air).top();
  for (const double depth : edgesOf(verticalDepth(all_, 0, 1))) {
    double low = 0;
    double high = top;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (verticalDepth(all_, middle, 1) > depth ? low : high) = middle;
    }
    altitudes_.push_back(0.5 * (low + high));
  }
  altitudes_.back() = 0;
  for (const double altitude : altitudes_) {
    depths_.push_back(verticalDepth(all_, altitude, 1));
  }
  placeHeights(top);
  for (size_t v = 0; v < VIEWS; ++v) {
    legendre_.emplace_back();
    for (size_t m = 0; m < FOG_TERMS; ++m) {
      legendre_.back()[m] = legendreOf(m, -viewAt(v));  // light travels towards the eye
    }
  }
}

void FogLight::Maker::placeHeights(double top) {
  for (size_t h = 0; h < HEIGHTS; ++h) {
    double low = 0;
    double high = top;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (light_.heightCoordinate(middle) > nodeOf(h, HEIGHTS) ? low : high) = middle;
    }
    const double depth = verticalDepth(all_, 0.5 * (low + high), 1);
    const auto centre = [&](size_t k) { return 0.5 * (depths_[k] + depths_[k + 1]); };
    size_t k = 0;
    while (k + 3 < depths_.size() && centre(k + 1) < depth) {
      ++k;
    }
    const double range = std::max(centre(k + 1) - centre(k), 1e-300);
    // On to the ground beyond the last cell's centre.
    places_[h] = {k, std::clamp((depth - centre(k)) / range, 0.0, 1.5)};
  }
}

std::vector<FogCell> FogLight::Maker::cellsOf(size_t colour) const {
  const auto k = static_cast<int>(colour);
  std::vector<FogCell> cells;
  for (size_t i = 0; i + 1 < altitudes_.size(); ++i) {
    const auto between = [&](const Air& air) {
      const double above = i > 0 ? verticalDepth(air, altitudes_[i], k) : 0;
      return std::max(verticalDepth(air, altitudes_[i + 1], k) - above, 0.0);
    };
    const double all = std::max(between(all_), 1e-12);
    cells.push_back({all, std::min(between(air_) / all, 1.0),
                     std::min(between(fog_) / all, 1.0) * input_.air.fogAlbedo[colour]});
  }
  return cells;
}

FogBeam FogLight::Maker::beamOf(size_t sun, int colour) const {
  FogBeam beam;
  beam.sunMu = sunAt(sun);
  double above = 1;
  for (size_t i = 1; i < altitudes_.size(); ++i) {
    const double below =
        lightVisibility(all_, altitudes_[i], beam.sunMu, input_.lightAngularRadius) *
        std::exp(-lightOpticalDepth(all_, altitudes_[i], beam.sunMu)[colour]);
    beam.irradiance.push_back(meanBetween(above, below));
    above = below;
  }
  beam.atGround = above;
  return beam;
}

void FogLight::Maker::make(size_t colour) {
  std::vector<FogBeam> beams;
  for (size_t s = 0; s < SUNS; ++s) {
    beams.push_back(beamOf(s, static_cast<int>(colour)));
  }
  const FogSlab slab(cellsOf(colour), input_.terms[colour], input_.groundAlbedo[colour]);
  const std::vector<std::vector<FogField>> fields = slab.solve(beams);
  for (size_t s = 0; s < SUNS; ++s) {
    fill(colour, s, fields[s]);
  }
}

void FogLight::Maker::fill(size_t colour, size_t sun, const std::vector<FogField>& field) {
  const FogTermsOf& terms = input_.terms[colour];
  const double sunMu = sunAt(sun);
  for (size_t h = 0; h < HEIGHTS; ++h) {
    const Place& place = places_[h];
    const FogField& upper = field[place.cell];
    const FogField& lower = field[place.cell + 1];
    for (size_t v = 0; v < VIEWS; ++v) {
      FogTermsOf modes{};
      for (size_t m = 0; m < FOG_TERMS; ++m) {
        for (size_t l = m; l < FOG_TERMS; ++l) {
          const double light = (1 - place.share) * upper.at(l, m) + place.share * lower.at(l, m);
          modes[m] += (m > 0 ? 2 : 1) * static_cast<double>(2 * l + 1) * terms[l] *
                      legendre_[v][m][l - m] * light;
        }
      }
      const double viewMu = viewAt(v);
      const double sines = std::sqrt((1 - viewMu * viewMu) * (1 - sunMu * sunMu));
      for (size_t a = 0; a < AZIMUTHS; ++a) {
        double sum = 0;
        for (size_t m = 0; m < FOG_TERMS; ++m) {
          sum += modes[m] * std::cos(static_cast<double>(m) * azimuthAt(a));
        }
        const double viewSun = viewMu * sunMu + sines * std::cos(azimuthAt(a));
        const size_t at = ((sun * HEIGHTS + h) * AZIMUTHS + a) * VIEWS + v;
        // Sixteen terms may run below zero in the dark.
        light_.table_[3 * at + colour] =
            static_cast<float>(std::max(sum, 0.0) / light_.lobe(viewSun));
      }
    }
  }
}

FogLight::FogLight(const FogLightInput& input) : table_(VALUES) {
  if (input.air.fogExtinction > 0) {
    Maker maker(input, *this);
    for (size_t c = 0; c < 3; ++c) {
      maker.make(c);
    }
  }
}

double FogLight::heightCoordinate(double altitude) const {
  const double above = depth_ * std::exp(-std::clamp(altitude / scaleHeight_, 0.0, 30.0));
  return depth_ > 0 ? std::log1p(above) / std::log1p(depth_) : 0;
}

double FogLight::sunCoordinate(double mu) {
  const double x = std::cbrt(2 / PI * std::asin(std::clamp(mu, 0.0, 1.0)));
  return x * x;
}

double FogLight::viewCoordinate(double mu) {
  return std::acos(std::clamp(mu, -1.0, 1.0)) / PI;
}

double FogLight::azimuthCoordinate(double cosine) {
  return std::sqrt(viewCoordinate(cosine));
}

double FogLight::lobe(double viewSun) const {
  constexpr double PEAKED = 0.75;
  const double g = asymmetry_;
  const double apart = (1 - g) * (1 - g) + 2 * g * (1 - std::clamp(viewSun, -1.0, 1.0));
  return (1 - PEAKED) + PEAKED * (1 - g * g) / (apart * std::sqrt(apart));
}

std::array<double, 3> FogLight::sourceAt(double altitude, double sunMu,
                                         const Direction& view) const {
  const std::array<SkyNode, 4> nodes = {nodeAt(sunCoordinate(sunMu), SUNS),
                                        nodeAt(heightCoordinate(altitude), HEIGHTS),
                                        nodeAt(azimuthCoordinate(view.azimuth), AZIMUTHS),
                                        nodeAt(viewCoordinate(view.viewMu), VIEWS)};
  constexpr std::array<size_t, 4> COUNTS = {SUNS, HEIGHTS, AZIMUTHS, VIEWS};
  std::array<double, 3> sum{};
  for (size_t corner = 0; corner < 16; ++corner) {
    double weight = lobe(view.viewSun);
    size_t at = 0;
    for (size_t n = 0; n < 4; ++n) {
      const size_t next = corner >> n & 1;
      weight *= next == 1 ? nodes[n].share : 1 - nodes[n].share;
      at = at * COUNTS[n] + nodes[n].index + next;
    }
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += weight * static_cast<double>(table_[3 * at + c]);
    }
  }
  return sum;
}

}  // namespace welkin
