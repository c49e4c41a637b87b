// SPDX-License-Identifier: MIT
#include "tables/fog_light_solver.hpp"

#include <algorithm>
#include <cmath>

#include "model/air_input.hpp"
#include "model/model.hpp"
#include "tables/sky_table.hpp"

namespace welkin {
namespace {

using namespace model::f64;

constexpr size_t SUNS = FogLight::SUNS;
constexpr size_t HEIGHTS = FogLight::HEIGHTS;
constexpr size_t AZIMUTHS = FogLight::AZIMUTHS;
constexpr size_t VIEWS = FogLight::VIEWS;

// Lets 1e-5 of what comes in through; beside much deeper ones the streams' cosines would be lost in
// rounding.
constexpr double THICKEST_CELL = 1e5;

double nodeOf(size_t i, size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

double verticalDepth(const Air& air, double altitude, int colour) {
  return lightOpticalDepth(air, altitude, 1.0)[colour];
}

// Mean of a quantity that falls exponentially from one end to the other.
double meanBetween(double from, double to) {
  const double ratio = std::log(std::max(from, 1e-300) / std::max(to, 1e-300));
  return std::abs(ratio) > 1e-6 ? (from - to) / ratio : 0.5 * (from + to);
}

// What lies deeper is one cell.
constexpr double DEEPEST = 1e4;

// Depth of edge k of `count` cells: dense at both ends.
double edgeAt(double total, size_t k, size_t count) {
  const double x = 2 * nodeOf(k, count + 1) - 1;
  if (total < 100) {
    const double bend = std::log1p(2 * total);
    return 0.5 * total * (1 + std::asinh(std::sinh(bend) * x) / bend);
  }
  // Cells that grow from either end in the same proportion: the first has a depth of 0.1.
  const double growth = std::log1p(total);
  const double from = 0.5 * total * std::expm1(growth * (1 - std::abs(x))) / total;
  return x < 0 ? from : total - from;
}

// Edges of cells by the depth above them. More of them do not change fog of depths up to 8, 40 and
// 100 by more than 1 %. Light at the ground goes like x log x in the depth x above it: three more
// cells there.
std::vector<double> edgesOf(double total) {
  const size_t count = total < 8 ? 32 : (total < 40 ? 48 : 64);
  const double seen = std::min(total, DEEPEST);
  std::vector<double> edges;
  for (size_t k = 0; k <= count; ++k) {
    edges.push_back(edgeAt(seen, k, count));
  }
  edges.back() = total;
  for (int i = 0; i < 3; ++i) {
    edges.insert(edges.end() - 1, 0.5 * (edges[edges.size() - 2] + total));
  }
  return edges;
}

}  // namespace

class FogLightSolver::Maker {
 public:
  explicit Maker(const FogLightInput& input);
  void advance();
  [[nodiscard]] bool done() const { return step_ >= STEPS; }
  FogLight take() { return std::move(light_); }

 private:
  // Of a node of the table's heights: the cell above it, and the share of the next one.
  struct Place {
    size_t cell = 0;
    double share = 0;
  };
  void placeCells(double top);
  void placeHeights(double top);
  void placeBeams();
  std::vector<FogCell> cellsOf(size_t colour) const;
  void fill(size_t colour, size_t sun);

  FogLightInput input_;
  FogLight light_;
  size_t step_ = 0;
  Air all_;
  Air fog_;
  Air air_;
  std::vector<double> altitudes_;  // of the cells' edges, from the top down
  std::vector<double> depths_;     // above them, of all in green
  std::array<Place, HEIGHTS> places_{};
  std::vector<std::array<FogTermsOf, FOG_TERMS>> legendre_;  // [view][order]
  std::array<std::vector<FogBeam>, 3> beams_;                // [colour][sun]
  std::vector<FogSlab> slabs_;                               // by colour
  std::vector<FogSlab::Work> work_;                          // one
  FogFields fields_;                                         // of the colour in work
};

FogLightSolver::Maker::Maker(const FogLightInput& input)
    : input_(input), all_(airFrom(input.air)), fog_(all_), air_(all_) {
  if (!(input.air.fogExtinction > 0)) {
    step_ = STEPS;
    return;
  }
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
  light_.table_.resize(FogLight::VALUES);

  const double top = SkyAxes(input.air).top();
  placeCells(top);
  placeHeights(top);
  placeBeams();
  for (size_t v = 0; v < VIEWS; ++v) {
    legendre_.emplace_back();
    for (size_t m = 0; m < FOG_TERMS; ++m) {
      // Light travels towards the eye.
      legendre_.back()[m] = legendreOf(m, -FogLight::viewAt(v));
    }
  }
  for (size_t c = 0; c < 3; ++c) {
    slabs_.emplace_back(cellsOf(c), input.terms[c], input.groundAlbedo[c]);
  }
  const size_t cells = altitudes_.size() - 1;
  work_.emplace_back(cells, SUNS);
  fields_.assign(SUNS, std::vector<FogField>(cells));
}

void FogLightSolver::Maker::placeCells(double top) {
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
}

void FogLightSolver::Maker::placeHeights(double top) {
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

std::vector<FogCell> FogLightSolver::Maker::cellsOf(size_t colour) const {
  const auto k = static_cast<int>(colour);
  std::vector<FogCell> cells;
  for (size_t i = 0; i + 1 < altitudes_.size(); ++i) {
    const auto between = [&](const Air& air) {
      const double above = i > 0 ? verticalDepth(air, altitudes_[i], k) : 0;
      return std::max(verticalDepth(air, altitudes_[i + 1], k) - above, 0.0);
    };
    const double all = std::max(between(all_), 1e-12);
    cells.push_back({std::min(all, THICKEST_CELL), std::min(between(air_) / all, 1.0),
                     std::min(between(fog_) / all, 1.0) * input_.air.fogAlbedo[colour]});
  }
  return cells;
}

void FogLightSolver::Maker::placeBeams() {
  for (size_t sun = 0; sun < SUNS; ++sun) {
    for (std::vector<FogBeam>& beams : beams_) {
      beams.emplace_back().sunMu = FogLight::sunAt(sun);
    }
    const double mu = FogLight::sunAt(sun);
    std::array<double, 3> above{};
    for (size_t i = 0; i < altitudes_.size(); ++i) {
      const double visible = lightVisibility(all_, altitudes_[i], mu, input_.lightAngularRadius);
      const vec3 depth = lightOpticalDepth(all_, altitudes_[i], mu);
      for (size_t c = 0; c < 3; ++c) {
        const double below = visible * std::exp(-depth[static_cast<int>(c)]);
        if (i > 0) {
          beams_[c][sun].irradiance.push_back(meanBetween(above[c], below));
        }
        above[c] = below;
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      beams_[c][sun].atGround = above[c];
    }
  }
}

void FogLightSolver::Maker::advance() {
  if (done()) {
    return;
  }
  const size_t colour = step_ / (FOG_TERMS + SUNS);
  const size_t part = step_ % (FOG_TERMS + SUNS);
  if (part == 0) {
    for (std::vector<FogField>& field : fields_) {
      std::fill(field.begin(), field.end(), FogField{});
    }
  }
  if (part < FOG_TERMS) {
    slabs_[colour].addMode(part, beams_[colour], work_[0], fields_);
  } else {
    fill(colour, part - FOG_TERMS);
  }
  ++step_;
}

void FogLightSolver::Maker::fill(size_t colour, size_t sun) {
  const FogTermsOf& terms = input_.terms[colour];
  const double sunMu = FogLight::sunAt(sun);
  // cos(m azimuth)
  std::array<FogTermsOf, AZIMUTHS> waves{};
  for (size_t a = 0; a < AZIMUTHS; ++a) {
    for (size_t m = 0; m < FOG_TERMS; ++m) {
      waves[a][m] = std::cos(static_cast<double>(m) * FogLight::azimuthAt(a));
    }
  }
  for (size_t h = 0; h < HEIGHTS; ++h) {
    const Place& place = places_[h];
    const FogField& upper = fields_[sun][place.cell];
    const FogField& lower = fields_[sun][place.cell + 1];
    for (size_t v = 0; v < VIEWS; ++v) {
      FogTermsOf modes{};
      for (size_t m = 0; m < FOG_TERMS; ++m) {
        for (size_t l = m; l < FOG_TERMS; ++l) {
          const double light = (1 - place.share) * upper.at(l, m) + place.share * lower.at(l, m);
          modes[m] += (m > 0 ? 2 : 1) * static_cast<double>(2 * l + 1) * terms[l] *
                      legendre_[v][m][l - m] * light;
        }
      }
      const double viewMu = FogLight::viewAt(v);
      const double sines = std::sqrt((1 - viewMu * viewMu) * (1 - sunMu * sunMu));
      for (size_t a = 0; a < AZIMUTHS; ++a) {
        double sum = 0;
        for (size_t m = 0; m < FOG_TERMS; ++m) {
          sum += modes[m] * waves[a][m];
        }
        const double viewSun = viewMu * sunMu + sines * waves[a][1];
        const size_t at = ((sun * HEIGHTS + h) * AZIMUTHS + a) * VIEWS + v;
        // Sixteen terms may run below zero in the dark.
        light_.table_[FogLight::LANES * at + colour] =
            static_cast<float>(std::max(sum, 0.0) / light_.lobe(viewSun));
      }
    }
  }
}

FogLightSolver::FogLightSolver(const FogLightInput& input)
    : maker_(std::make_unique<Maker>(input)) {}
FogLightSolver::FogLightSolver(FogLightSolver&&) noexcept = default;
FogLightSolver& FogLightSolver::operator=(FogLightSolver&&) noexcept = default;
FogLightSolver::~FogLightSolver() = default;

void FogLightSolver::advance() {
  maker_->advance();
}

bool FogLightSolver::done() const {
  return maker_->done();
}

FogLight FogLightSolver::take() {
  return maker_->take();
}

FogLight solveFogLight(const FogLightInput& input) {
  FogLightSolver solver(input);
  while (!solver.done()) {
    solver.advance();
  }
  return solver.take();
}

}  // namespace welkin
