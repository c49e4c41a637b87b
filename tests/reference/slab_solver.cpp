// SPDX-License-Identifier: MIT
#include "reference/slab_solver.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "reference/quadrature.hpp"
#include "reference/slab_modes.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;

// Sum of (2 l + 1) / (4 pi) a_l P_l(1 - y).
double legendreSum(const Vector& a, double y) {
  const double c = 1 - y;
  double sum = 0;
  double p = 1;
  double before = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto l = static_cast<double>(i);
    sum += (2 * l + 1) * a[i] * p;
    const double next = ((2 * l + 1) * c * p - l * before) / (l + 1);
    before = p;
    p = next;
  }
  return sum / (4 * PI);
}

// 1 - cos of the angle between a beam that goes down and a view's direction of travel, as half the
// square of their difference: exact near the beam.
double separation(double mu0, const SlabView& view) {
  const double sine = std::sqrt((1 - view.mu) * (1 + view.mu));
  const double sine0 = std::sqrt((1 - mu0) * (1 + mu0));
  const double x = sine * std::cos(view.phi) - sine0;
  const double y = sine * std::sin(view.phi);
  const double z = view.mu + mu0;
  return (x * x + y * y + z * z) / 2;
}

double depthOf(const SlabView& view, double tau) {
  return view.depth == SlabView::FACE ? (view.mu > 0 ? 0 : tau) : view.depth;
}

// Order 1 over albedo and phase function, per irradiance.
double singlePath(double tau, double mu0, double mu, double depth) {
  const double q = 1 / std::fabs(mu);
  const double p = 1 / mu0;
  if (mu > 0) {
    const double length = tau - depth;
    return q * length * decayMean((q + p) * length) * std::exp(-p * depth);
  }
  return q * depth * decayDifference(q * depth, p * depth);
}

// a_l of chi_l = a_l + (-1)^l b_l: the moments without what the phase function has behind.
double forwardMoment(const Vector& chi, std::size_t l) {
  return (chi[l - 1] + 2 * chi[l] + chi[l + 1]) / 4;
}

constexpr std::array GRAZING{0.003, 0.04};

void addNodes(double begin, double end, int count, SlabNodes& nodes) {
  const GaussRule rule = gaussLegendre(count);
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    nodes.mu.push_back(begin + (end - begin) * static_cast<double>(rule.node[i]));
    nodes.weight.push_back((end - begin) * static_cast<double>(rule.weight[i]));
  }
}

}  // namespace

SlabPhase henyeyGreensteinSlabPhase(double g) {
  SlabPhase phase;
  for (double moment = 1; std::fabs(moment) > 1e-16; moment *= g) {
    phase.moments.push_back(moment);
  }
  phase.value = [g](double y) {
    const double base = (1 - g) * (1 - g) + 2 * g * y;
    return (1 - g) * (1 + g) / (4 * PI * base * std::sqrt(base));
  };
  return phase;
}

SlabPhase rayleighSlabPhase() {
  return {{1, 0, 0.1}, [](double y) { return 3 / (16 * PI) * (1 + (1 - y) * (1 - y)); }};
}

SlabPhase momentSlabPhase(std::vector<double> moments) {
  SlabPhase phase;
  phase.value = [moments](double y) { return legendreSum(moments, y); };
  phase.moments = std::move(moments);
  return phase;
}

SlabPhase tabulatedSlabPhase(const std::vector<double>& angle, std::vector<double> value,
                             int count) {
  const std::size_t nodes = angle.size();
  Vector y;
  for (const double one : angle) {
    const double s = std::sin(one / 2);
    y.push_back(2 * s * s);
  }
  y.back() = 2;
  double integral = 0;
  for (std::size_t i = 0; i + 1 < nodes; ++i) {
    integral += PI * (value[i] + value[i + 1]) * (y[i + 1] - y[i]);
  }
  for (double& one : value) {
    one /= integral;
  }
  // Five Gauss nodes on stretches over which P_l turns by at most 1 rad.
  const GaussRule rule = gaussLegendre(5);
  SlabPhase phase;
  phase.moments.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i + 1 < nodes; ++i) {
    const auto parts = static_cast<int>(std::ceil((angle[i + 1] - angle[i]) * count)) + 1;
    const double width = (y[i + 1] - y[i]) / parts;
    for (int part = 0; part < parts; ++part) {
      for (std::size_t g = 0; g < rule.node.size(); ++g) {
        const double at = part + static_cast<double>(rule.node[g]);
        const double c = 1 - (y[i] + width * at);
        const double weight = 2 * PI * width * static_cast<double>(rule.weight[g]) *
                              (value[i] + (value[i + 1] - value[i]) * at / parts);
        double p = 1;
        double before = 0;
        for (int l = 0; l < count; ++l) {
          phase.moments[static_cast<std::size_t>(l)] += weight * p;
          const double next = ((2 * l + 1) * c * p - l * before) / (l + 1);
          before = p;
          p = next;
        }
      }
    }
  }
  phase.value = [y, value = std::move(value)](double at) {
    const auto above = std::upper_bound(y.begin() + 1, y.end() - 1, at);
    const auto i = static_cast<std::size_t>(above - y.begin());
    const double t = std::clamp((at - y[i - 1]) / (y[i] - y[i - 1]), 0.0, 1.0);
    return value[i - 1] + (value[i] - value[i - 1]) * t;
  };
  return phase;
}

struct SlabSolver::Modes {
  SlabPhase phase;
  double albedo;
  double peak;       // f: part of the phase function that delta-M takes for unscattered
  double scaled;     // albedo without the peak
  std::size_t used;  // azimuth modes that are not 0
  SlabNodes nodes;
  Vector series;
  std::vector<std::unique_ptr<SlabMode>> mode;

  SlabMode& at(std::size_t m, double tau) {
    if (!mode[m]) {
      mode[m] =
          std::make_unique<SlabMode>(static_cast<int>(m), nodes, series, m == 0 && albedo == 1);
    }
    mode[m]->setThickness(tau);
    return *mode[m];
  }

  double depthScale() const { return 1 - albedo * peak; }

  // 2 pi times the sum of mu times radiance over a hemisphere.
  double flux(const Vector& radiance) const {
    double sum = 0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      sum += 2 * PI * nodes.weight[i] * nodes.mu[i] * radiance[i];
    }
    return sum;
  }

  std::pair<double, double> nodeFlux(double tau, const SlabSolution& solution, double depth) {
    Vector down;
    Vector up;
    at(0, tau).nodeRadiance(solution, depth, down, up);
    return {flux(down), flux(up)};
  }

  // Radiance that leaves a Lambertian surface below the scaled slab.
  double surfaceRadiance(double tau, double mu0, const SlabSolution& solution, double surface) {
    const double black = nodeFlux(tau, solution, tau).first + mu0 * std::exp(-tau / mu0);
    const double back = nodeFlux(tau, at(0, tau).diffuse(false), tau).first / PI;
    return surface * black / (PI * (1 - surface * back));
  }

  // Light scattered within the peak only, all orders in the small-angle limit, less what TMS has.
  double forwardPeak(double tau, double mu0, double y) const {
    if (peak == 0) {
      return 0;
    }
    Vector k;
    const double path = tau / mu0;
    for (std::size_t l = 0; l < phase.moments.size(); ++l) {
      const double c = albedo * (l < series.size() ? peak : phase.moments[l]);
      k.push_back(std::exp(-path) * std::expm1(c * path) -
                  c * path * std::exp(-depthScale() * path));
    }
    return legendreSum(k, y);
  }

  // Features of the phase function behind, such as a glory, that are finer than the series: TMS
  // shows them as the beam would, but light was also turned within the peak on its way in and out,
  // which widens them. With chi_l = a_l + (-1)^l b_l, moments b_l decay with the depth s as
  // e^(-(1 - albedo a_l) s) instead of e^(-(1 - albedo peak) s).
  double backwardPeak(double tau, double mu0, const SlabView& view, double depth, double y) const {
    if (peak == 0) {
      return 0;
    }
    const Vector& chi = phase.moments;
    const auto path = [&](double loss) {
      return singlePath(loss * tau, mu0, view.mu, loss * depth) / loss;
    };
    const double plain = path(depthScale());
    Vector k(chi.size());
    for (std::size_t l = series.size(); l + 1 < chi.size(); ++l) {
      const double forward = forwardMoment(chi, l);
      k[l] = albedo * (chi[l] - forward) * (path(1 - albedo * forward) - plain);
    }
    return legendreSum(k, y);
  }
};

SlabSolver::SlabSolver(SlabPhase phase, double albedo, int nodes)
    : modes_(std::make_unique<Modes>()) {
  Modes& m = *modes_;
  // No more moments than nodes: the rule must integrate products of any two of them, or light
  // turned often comes out wrong by up to 10 % beside the beam (20 um droplets, 64 to 128 nodes
  // with twice as many moments). What is left out goes to delta-M.
  const auto terms = static_cast<std::size_t>(nodes);
  m.phase = std::move(phase);
  m.albedo = albedo;
  m.peak = m.phase.moments.size() > terms + 1 ? std::max(forwardMoment(m.phase.moments, terms), 0.0)
                                              : 0.0;
  m.scaled = albedo == 1 ? 1 : albedo * (1 - m.peak) / m.depthScale();
  // In thin slabs radiance bends at mu = tau, which a rule over [0, 1] does not resolve: 4e-4 of
  // the radiance of tau 1e-3. Panels of their own cure it, and the last still integrates every
  // P_l kept, so that the sum over a sphere of directions is exact.
  addNodes(0, GRAZING[0], 6, m.nodes);
  addNodes(GRAZING[0], GRAZING[1], 8, m.nodes);
  addNodes(GRAZING[1], 1, nodes, m.nodes);
  m.used = 1;
  for (std::size_t l = 0; l < terms; ++l) {
    const double chi = l < m.phase.moments.size() ? m.phase.moments[l] : 0;
    const double value = l == 0 ? 1 : (chi - m.peak) / (1 - m.peak);
    m.series.push_back(m.scaled * static_cast<double>(2 * l + 1) * value);
    m.used = value != 0 ? l + 1 : m.used;
  }
  m.mode.resize(terms);
}

SlabSolver::~SlabSolver() = default;
SlabSolver::SlabSolver(SlabSolver&&) noexcept = default;

std::vector<SlabRadiance> SlabSolver::radiance(double tau, double mu0,
                                               std::span<const SlabView> views,
                                               double surface) const {
  Modes& modes = *modes_;
  const double scale = modes.depthScale();
  std::vector<SlabRadiance> result;
  for (const SlabView& view : views) {
    const double depth = depthOf(view, tau);
    const double y = separation(mu0, view);
    const double source = modes.albedo * modes.phase.value(y);
    SlabRadiance one{};
    one.single = source * singlePath(tau, mu0, view.mu, depth);
    one.total = source / scale * singlePath(scale * tau, mu0, view.mu, scale * depth);
    if (view.mu < 0) {
      one.total += modes.forwardPeak(depth, mu0, y);
    } else {
      one.total += modes.backwardPeak(tau, mu0, view, depth, y);
    }
    result.push_back(one);
  }
  // Modes until two in a row add nothing to any view.
  constexpr double NOTHING = 1e-10;
  int idle = 0;
  for (std::size_t m = 0; m < modes.used && idle < 2; ++m) {
    SlabMode& mode = modes.at(m, scale * tau);
    const SlabSolution beam = mode.beam(mu0);
    SlabSolution ground;
    double leaving = 0;
    if (m == 0 && surface > 0) {
      ground = mode.diffuse(false);
      leaving = modes.surfaceRadiance(scale * tau, mu0, beam, surface);
    }
    bool adds = false;
    double value = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double mu = std::fabs(views[i].mu);
      const bool up = views[i].mu > 0;
      const double depth = depthOf(views[i], tau);
      // Neighbours that differ in azimuth only share their modes.
      if (i == 0 || views[i].mu != views[i - 1].mu || depth != depthOf(views[i - 1], tau)) {
        value = (m == 0 ? 1 : 2) * mode.radiance(beam, mu, up, scale * depth);
        if (leaving > 0) {
          value += leaving * mode.radiance(ground, mu, up, scale * depth);
          value += up ? leaving * std::exp(-scale * (tau - depth) / mu) : 0;
        }
      }
      if (leaving > 0 && up) {
        result[i].single += surface / PI * mu0 * std::exp(-tau / mu0 - (tau - depth) / mu);
      }
      result[i].total += value * std::cos(static_cast<double>(m) * views[i].phi);
      adds = adds || std::fabs(value) > NOTHING * std::fabs(result[i].total);
    }
    idle = adds ? 0 : idle + 1;
  }
  return result;
}

SlabFlux SlabSolver::flux(double tau, double mu0, double depth, double surface) const {
  Modes& modes = *modes_;
  const double scale = modes.depthScale();
  SlabMode& mode = modes.at(0, scale * tau);
  const SlabSolution beam = mode.beam(mu0);
  auto [down, up] = modes.nodeFlux(scale * tau, beam, scale * depth);
  if (surface > 0) {
    const double leaving = modes.surfaceRadiance(scale * tau, mu0, beam, surface);
    const auto back = modes.nodeFlux(scale * tau, mode.diffuse(false), scale * depth);
    down += leaving * back.first;
    up += leaving * back.second;
  }
  const double direct = mu0 * std::exp(-depth / mu0);
  return {up, down + mu0 * std::exp(-scale * depth / mu0) - direct, direct};
}

std::vector<SlabRadiance> SlabSolver::diffuseRadiance(double tau,
                                                      std::span<const SlabView> views) const {
  const double scale = modes_->depthScale();
  SlabMode& mode = modes_->at(0, scale * tau);
  const SlabSolution above = mode.diffuse(true);
  std::vector<SlabRadiance> result;
  for (const SlabView& view : views) {
    const double depth = scale * depthOf(view, tau);
    const double mu = std::fabs(view.mu);
    const double direct = view.mu < 0 ? std::exp(-depth / mu) : 0;
    result.push_back({mode.radiance(above, mu, view.mu > 0, depth) + direct, 0});
  }
  return result;
}

SlabFlux SlabSolver::diffuseFlux(double tau, double depth) const {
  const double scale = modes_->depthScale();
  SlabMode& mode = modes_->at(0, scale * tau);
  const auto [down, up] = modes_->nodeFlux(scale * tau, mode.diffuse(true), scale * depth);
  return {up, down, 0};
}

}  // namespace welkin::reference
