// SPDX-License-Identifier: MIT
// A table of the caller's own: ln P linear in the angle between its rows.
#include <algorithm>
#include <cmath>

#include "particles/types/spectrum.hpp"

namespace welkin {
namespace {

constexpr double LEAST = 1e-20;  // stands for 0 under the logarithm

Particle makeUser(const ParticleParams& params) {
  const std::span<const double> angles = params.userAngle;
  Particle particle;
  std::array<double, RGB> most{};
  const auto phase = [&](size_t channel, double y) {
    const double angle = angleOf(y);
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto i = static_cast<size_t>(above - angles.begin());
    const double width = angles[i] - angles[i - 1];
    const double t = std::clamp((angle - angles[i - 1]) / width, 0.0, 1.0);
    const double p0 = params.userPhase[(i - 1) * RGB + channel];
    const double p1 = params.userPhase[i * RGB + channel];
    const double scale = std::max(p0, p1);  // any unit: only ratios count
    if (scale <= 0) {
      return 0.0;
    }
    return scale * std::exp((1 - t) * std::log(std::max(p0 / scale, LEAST)) +
                            t * std::log(std::max(p1 / scale, LEAST)));
  };
  particle.curve = makePhaseCurve([&](size_t channel, double y) {
    const double p = phase(channel, y);
    most[channel] = std::max(most[channel], p);
    return p;
  });
  particle.empty = std::any_of(most.begin(), most.end(), [](double p) { return !(p > 0); });
  return particle;
}

}  // namespace

const ParticleKind USER = {"user", {}, {}, {}, true, false, makeUser};

}  // namespace welkin
