// SPDX-License-Identifier: MIT
#include "reference/slab_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "reference/quadrature.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;

// Forward hemisphere of a distribution with these moments: the integral of P_l over [0, 1] is
// (P_(l-1)(0) - P_(l+1)(0)) / (2 l + 1), 0 for even l > 0.
template <typename Moment>
double hemisphere(std::size_t count, Moment moment) {
  double sum = 0.5 * moment(0);
  double low = 1;  // P_(l-1)(0)
  for (std::size_t l = 1; l < count; l += 2) {
    const double high = -low * static_cast<double>(l) / static_cast<double>(l + 1);
    sum += 0.5 * moment(l) * (low - high);
    low = high;
  }
  return sum;
}

}  // namespace

SlabModel::SlabModel(SlabPhase phase, double albedo, double deepest)
    : phase_(std::move(phase)), albedo_(albedo) {
  const std::vector<double>& chi = phase_.moments;
  for (int n = 1; n <= ORDERS; ++n) {
    forwardInteger_[static_cast<std::size_t>(n - 1)] =
        hemisphere(chi.size(), [&](std::size_t l) { return std::pow(chi[l], n); });
  }
  const auto lossAt = [&](double depth) {
    return 1 - albedo_ * hemisphere(chi.size(), [&](std::size_t l) {
                 return chi[l] * std::exp(-albedo_ * depth * (1 - chi[l]));
               });
  };
  constexpr int NODES = 300;  // the source between them: 1e-4
  nodesPerLog_ = (NODES - 1) / std::log1p(deepest);
  for (int i = 0; i < NODES; ++i) {
    depth_.push_back(std::expm1(i / nodesPerLog_));
    loss_.push_back(lossAt(depth_.back()));
    double log = 0;
    if (i > 0) {  // Simpson's rule
      const double width = depth_.back() - depth_[depth_.size() - 2];
      const double middle = lossAt(depth_.back() - width / 2);
      log =
          logIntensity_.back() - width / 6 * (loss_[loss_.size() - 2] + 4 * middle + loss_.back());
    }
    logIntensity_.push_back(log);
    // What was not scattered before keeps the phase function itself; the series holds the rest,
    // whose moments fall faster.
    const double n = albedo_ * depth_.back();
    for (const double one : chi) {
      scatteredMoments_.push_back(one * (std::exp(-n * (1 - one)) - std::exp(-n)));
    }
  }
}

SlabModel::Angle SlabModel::prepare(double y) const {
  const std::vector<double>& chi = phase_.moments;
  const double c = 1 - y;
  std::vector<double> term;  // (2 l + 1) / (4 pi) P_l
  double p = 1;
  double before = 0;
  for (std::size_t i = 0; i < chi.size(); ++i) {
    const auto l = static_cast<double>(i);
    term.push_back((2 * l + 1) / (4 * PI) * p);
    const double next = ((2 * l + 1) * c * p - l * before) / (l + 1);
    before = p;
    p = next;
  }
  const double once = phase_.value(y);
  Angle angle{};
  angle.integer[0] = once;
  std::vector<double> power = chi;
  for (std::size_t n = 1; n < angle.integer.size(); ++n) {
    double sum = 0;
    for (std::size_t l = 0; l < chi.size(); ++l) {
      power[l] *= chi[l];
      sum += term[l] * power[l];
    }
    angle.integer[n] = std::max(sum, 0.0);
  }
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    const auto row = scatteredMoments_.begin() + static_cast<std::ptrdiff_t>(i * chi.size());
    const double sum = std::exp(-albedo_ * depth_[i]) * once +
                       std::inner_product(term.begin(), term.end(), row, 0.0);
    angle.logSource.push_back(std::log(std::max(sum, 1e-30)));
  }
  return angle;
}

// Cubic through values and slopes of the two nodes.
double SlabModel::intensity(double path) const {
  const auto node = static_cast<std::size_t>(std::log1p(path) * nodesPerLog_);
  const std::size_t i = std::min(node, depth_.size() - 2);
  const double width = depth_[i + 1] - depth_[i];
  const double t = (path - depth_[i]) / width;
  const double s = 1 - t;
  return std::exp(s * s * (1 + 2 * t) * logIntensity_[i] +
                  t * t * (1 + 2 * s) * logIntensity_[i + 1] -
                  s * t * width * (s * loss_[i] - t * loss_[i + 1]));
}

double SlabModel::source(double path, const Angle& angle) const {
  const double at = std::log1p(path) * nodesPerLog_;
  const std::size_t i = std::min(static_cast<std::size_t>(at), depth_.size() - 2);
  const double t = at - static_cast<double>(i);
  return std::exp((1 - t) * angle.logSource[i] + t * angle.logSource[i + 1]);
}

double SlabModel::corrected(double tau, double mu0, double mu, const Angle& angle) const {
  static const GaussRule rule = gaussLegendre(6);
  const double slope = std::fabs(mu);
  const double path = tau / slope;
  // Panels of optical depth 1/2 along the faster way, which grow from the view's end outwards.
  const double scale = std::min(1.0, mu0 / slope);
  double sum = 0;
  double begin = 0;
  while (begin < path) {
    const double fromEnd = std::min(begin, path - begin);
    const double end = std::min(path, begin + scale * std::clamp(fromEnd, 0.05, 0.5));
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double x = begin + (end - begin) * static_cast<double>(rule.node[i]);
      const double z = mu > 0 ? x * slope : tau - x * slope;
      sum += (end - begin) * static_cast<double>(rule.weight[i]) * std::exp(-x) *
             intensity(z / mu0) * source(z / mu0, angle);
    }
    begin = end;
  }
  return albedo_ * sum;
}

std::vector<double> SlabModel::lightBuffer(double path, double step,
                                           Attenuation attenuation) const {
  const auto order = [](double n) {
    return std::clamp(static_cast<int>(std::ceil(n - 1e-9)), 1, ORDERS);
  };
  std::vector<double> buffer{1.0};
  const double through = std::exp(-step);
  const auto steps = static_cast<int>(std::ceil(path / step)) + 1;
  for (int k = 0; k < steps; ++k) {
    const double n = albedo_ * step * k;
    double forward = 1;
    if (attenuation == Attenuation::EQ_25) {
      forward = std::pow(albedo_ * forwardInteger(order(n + 1 + step)), step);
    } else {
      for (int i = 0; i < static_cast<int>(std::ceil(step)); ++i) {
        forward *= albedo_ * forwardInteger(order(n + 1 + i));
      }
    }
    buffer.push_back(buffer.back() * (through + (1 - through) * forward));
  }
  return buffer;
}

double SlabModel::printed(double tau, double mu0, double mu, const Angle& angle,
                          Attenuation attenuation, int slices) const {
  const double slope = std::fabs(mu);
  const double path = tau / slope;
  const double step = std::max(path, tau / mu0) / slices;
  const std::vector<double> buffer = lightBuffer(tau / mu0, step, attenuation);
  double sum = 0;
  const auto samples = static_cast<int>(std::ceil(path / step - 1e-9));
  for (int i = 0; i < samples; ++i) {
    const double x = step * i;
    const double light = (mu > 0 ? x * slope : tau - x * slope) / mu0;
    // The slice through the sample, and the light's ways through it that end on this ray.
    const double at = light / step;
    const auto k = std::min(static_cast<std::size_t>(at), buffer.size() - 2);
    const double t = at - static_cast<double>(k);
    const double intensity = buffer[k] + t * (buffer[k + 1] - buffer[k]);
    const int order =
        std::clamp(static_cast<int>(std::ceil(albedo_ * light + 1 - 1e-9)), 1, ORDERS);
    sum += std::exp(-x) * intensity * angle.integer[static_cast<std::size_t>(order - 1)];
  }
  return albedo_ * step * sum;
}

}  // namespace welkin::reference
