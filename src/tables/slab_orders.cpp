// SPDX-License-Identifier: MIT
#include "tables/slab_orders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "tables/slab_first.hpp"

namespace welkin {
namespace {

std::array<double, SLAB_LANES> fullLanes(std::span<const double> suns) {
  std::array<double, SLAB_LANES> result{};
  for (size_t i = 0; i < SLAB_LANES; ++i) {
    result[i] = suns[std::min(i, suns.size() - 1)];
  }
  return result;
}

// Highest mode with light that counts, and one more: the shift has it.
int lastMode(const SlabMoments& moments, double dropped) {
  std::array<double, SLAB_LANES> whole{};
  for (int m = 0; m <= moments.modes; ++m) {
    std::array<double, SLAB_LANES> most{};
    const std::vector<double>& f = moments.intensity[static_cast<size_t>(m)];
    for (size_t i = 0; i < f.size(); ++i) {
      most[i % SLAB_LANES] = std::max(most[i % SLAB_LANES], std::abs(f[i]));
    }
    if (m == 0) {
      whole = most;
    }
    bool counts = false;
    for (size_t lane = 0; lane < SLAB_LANES; ++lane) {
      counts = counts || most[lane] > dropped * whole[lane];
    }
    if (!counts) {
      return m;
    }
  }
  return moments.modes;
}

void dropModes(SlabMoments& moments, int modes) {
  while (moments.modes > std::max(modes, 1)) {
    moments.intensity.pop_back();
    moments.spread.pop_back();
    moments.shift.pop_back();
    moments.shift.erase(moments.shift.begin());
    --moments.modes;
  }
}

void addTo(SlabMoments& sum, const SlabMoments& more, const SlabMedium& medium) {
  if (sum.modes < 0) {
    sum = more;
    return;
  }
  for (int m = -more.modes; m <= more.modes; ++m) {
    for (const SlabField field : {SlabField::Intensity, SlabField::Shift, SlabField::Spread}) {
      if (m < 0 && field != SlabField::Shift) {
        continue;
      }
      std::vector<double>& to = medium.part(sum, field, m);
      const std::vector<double>& from = medium.part(more, field, m);
      for (size_t i = 0; i < to.size(); ++i) {
        to[i] += from[i];
      }
    }
  }
}

}  // namespace

SlabOrders::SlabOrders(const SlabTail& tail, std::span<const double> suns, double dropped)
    : medium_(tail.medium()), suns_(fullLanes(suns)) {
  SlabMoments moments = firstOrder(medium_, suns_);
  size_t set = 0;
  for (int order = 2; order < SLAB_ORDERS.back(); ++order) {
    dropModes(moments, lastMode(moments, dropped));
    set += order == SLAB_ORDERS[set + 1] ? 1U : 0U;
    addTo(sources_[set], moments, medium_);
    moments = medium_.scatter(moments);
  }
  dropModes(moments, lastMode(moments, dropped));
  SlabTail::Result rest = tail.solve(moments);
  sources_.back() = std::move(rest.sum);
  residual_ = rest.residual;
  steps_ = rest.steps;
}

SlabLight SlabOrders::light(size_t set, const SlabDirections& directions,
                            std::span<const double> depths) const {
  const SlabMoments& from = sources_[set];
  const std::vector<double>& node = medium_.depth();
  const size_t nodes = node.size();
  const size_t count = directions.mu.size();
  SlabLight light;
  light.directions_ = count;
  light.depths_ = depths.size();
  const size_t size = 2 * count * depths.size() * SLAB_LANES;
  const auto modes = static_cast<size_t>(from.modes);
  light.intensity_.assign(modes + 1, std::vector<double>(size));
  light.spread_ = light.intensity_;
  light.shift_.assign(2 * modes + 1, std::vector<double>(size));
  // The last stretch of each ray, from a node to the depth.
  struct Last {
    std::array<size_t, 3> node;  // two of the stretch, the cell's third
    SlabStep step;
  };
  std::vector<Last> last;
  for (size_t ray = 0; ray < 2 * count; ++ray) {
    const bool up = ray >= count;
    for (const double depth : depths) {
      const double tau = std::clamp(depth, 0.0, node.back());
      size_t cell =
          static_cast<size_t>(std::upper_bound(node.begin(), node.end(), tau) - node.begin());
      cell = (std::clamp<size_t>(cell, 1, nodes - 1) - 1) / 2;
      const size_t middle = 2 * cell + 1;
      const size_t enter = up ? middle + 1 : middle - 1;
      const size_t leave = up ? middle - 1 : middle + 1;
      const bool second = up ? tau < node[middle] : tau > node[middle];
      const size_t start = second ? middle : enter;
      const double length = std::abs(tau - node[start]) / directions.mu[ray % count];
      Last& here = last.emplace_back();
      here.node = {start, second ? enter : middle, leave};
      if (length > 0) {
        std::array<double, 3> at{};
        for (size_t i = 0; i < 3; ++i) {
          at[i] = (tau - node[here.node[i]]) / (tau - node[start]);
        }
        here.step = slabStep(length, at);
      }
    }
  }
  medium_.sweep(from, directions, [&](const SlabModeRays& mode) {
    const int turn = mode.field == SlabField::Shift ? mode.m + from.modes : mode.m;
    std::vector<double>& to =
        (mode.field == SlabField::Intensity ? light.intensity_
         : mode.field == SlabField::Shift   ? light.shift_
                                            : light.spread_)[static_cast<size_t>(turn)];
    for (size_t i = 0; i < last.size(); ++i) {
      const size_t ray = i / depths.size();
      const double mu = directions.mu[ray % count];
      const double sine = std::sqrt((1 - mu) * (1 + mu));
      const Last& here = last[i];
      const auto add = [&](const SlabRays* rays, size_t power, double factor) {
        if (rays == nullptr) {
          return;
        }
        const double carried =
            factor * here.step.decay * std::pow(here.step.length, static_cast<double>(power));
        for (size_t lane = 0; lane < SLAB_LANES; ++lane) {
          const auto place = [&](size_t k) { return (ray * nodes + k) * SLAB_LANES + lane; };
          double value = carried * rays->light[place(here.node[0])];
          for (size_t j = 0; j < 3; ++j) {
            value += factor * here.step.weight[power][j] * rays->source[place(here.node[j])];
          }
          to[i * SLAB_LANES + lane] += value;
        }
      };
      add(mode.rays, 0, 1);
      if (mode.field == SlabField::Shift) {
        add(mode.before[0], 1, sine);
      } else if (mode.field == SlabField::Spread) {
        add(mode.before[0], 1, sine);
        add(mode.before[1], 1, sine);
        add(mode.before[2], 2, sine * sine);
      }
    }
  });
  return light;
}

double SlabOrders::firstOrderMean(size_t lane, double mu, bool up, double depth) const {
  const auto& chi = medium_.moments();
  std::vector<double> view(chi.size());
  std::vector<double> sun(chi.size());
  slabLegendre(0, up ? -mu : mu, view);
  slabLegendre(0, suns_[lane], sun);
  double phase = 0;
  for (size_t l = 0; l < chi.size(); ++l) {
    phase += (2 * static_cast<double>(l) + 1) * chi[l] * view[l] * sun[l];
  }
  const double length = (up ? medium_.thickness() - depth : depth) / mu;
  const double far = (up ? medium_.thickness() : 0.0) / suns_[lane] + length;
  const double near = depth / suns_[lane];
  return length > 0 ? phase * 0.25 * std::numbers::inv_pi *
                          twoEndedMoments(far / length, near / length, length)[0]
                    : 0;
}

size_t SlabLight::place(size_t lane, size_t direction, bool up, size_t depth) const {
  return (((up ? directions_ : 0) + direction) * depths_ + depth) * SLAB_LANES + lane;
}

double SlabLight::mean(size_t lane, size_t direction, bool up, size_t depth) const {
  return intensity_[0][place(lane, direction, up, depth)];
}

SlabTransport SlabLight::at(size_t lane, size_t direction, bool up, size_t depth,
                            double phi) const {
  const size_t i = place(lane, direction, up, depth);
  const size_t modes = intensity_.size() - 1;
  double radiance = 0;
  double x = 0;
  double y = 0;
  double spread = 0;
  const double turnC = std::cos(phi);
  const double turnS = std::sin(phi);
  double c = 1;  // of m phi
  double s = 0;
  for (size_t m = 0; m <= modes; ++m) {
    const double twice = m == 0 ? 1 : 2;
    radiance += twice * c * intensity_[m][i];
    spread += twice * c * spread_[m][i];
    x += c * shift_[modes + m][i];
    y += s * shift_[modes + m][i];
    if (m > 0) {
      x += c * shift_[modes - m][i];
      y -= s * shift_[modes - m][i];
    }
    const double next = c * turnC - s * turnS;
    s = s * turnC + c * turnS;
    c = next;
  }
  SlabTransport result;
  result.radiance = radiance;
  if (radiance > 0) {
    result.x = -x / radiance;
    result.y = -y / radiance;
    result.width =
        std::sqrt(std::max(spread / radiance - result.x * result.x - result.y * result.y, 0.0));
  }
  return result;
}

}  // namespace welkin
