// SPDX-License-Identifier: MIT
#include "particles/solar_disk.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;

// Rings of radius t about the direction seen at theta from the sun's centre, theta in [0, pi / 2],
// each with the half arc phi inside the disk: hav R = hav(t - theta) + sin t sin theta hav phi.
// Whole rings (theta < R) in u, t = (R - theta) u^2, dense at t = 0 where diffraction peaks; the
// others in v, t = middle - half cos v, which takes up the square roots at both ends. Both by the
// midpoint rule.
void addRings(double theta, const std::function<void(double t, double weight)>& add) {
  constexpr int WHOLE = 48;
  for (int i = 0; theta < SUN_RADIUS && i < WHOLE; ++i) {
    const double u = (i + 0.5) / WHOLE;
    const double t = (SUN_RADIUS - theta) * u * u;
    add(t, PI * std::sin(t) * 2 * (SUN_RADIUS - theta) * u / WHOLE);
  }
  const double low = std::abs(theta - SUN_RADIUS);
  const double middle = (theta + SUN_RADIUS + low) / 2;
  const double half = (theta + SUN_RADIUS - low) / 2;
  const double havRadius = std::pow(std::sin(SUN_RADIUS / 2), 2);
  const int arcs = theta < 4 * SUN_RADIUS ? 48 : 8;
  for (int i = 0; half > 0 && i < arcs; ++i) {
    const double v = (i + 0.5) * PI / arcs;
    const double t = middle - half * std::cos(v);
    const double away = std::sin((t - theta) / 2);
    const double havArc = (havRadius - away * away) / (std::sin(t) * std::sin(theta));
    const double arc = 2 * std::asin(std::sqrt(std::clamp(havArc, 0.0, 1.0)));
    add(t, arc * std::sin(t) * half * std::sin(v) * PI / arcs);
  }
}

}  // namespace

AnglePlan pointPlan(std::span<const double> angles) {
  AnglePlan plan;
  plan.angles.assign(angles.begin(), angles.end());
  plan.weight.assign(angles.size(), 1.0);
  for (size_t i = 0; i <= angles.size(); ++i) {
    plan.begin.push_back(i);
  }
  return plan;
}

AnglePlan solarDiskPlan(std::span<const double> angles) {
  AnglePlan plan;
  for (const double angle : angles) {
    const size_t first = plan.weight.size();
    plan.begin.push_back(first);
    const bool mirrored = angle > PI / 2;
    addRings(mirrored ? PI - angle : angle, [&](double t, double weight) {
      plan.angles.push_back(mirrored ? PI - t : t);
      plan.weight.push_back(weight);
    });
    double total = 0;  // the disk's area up to the rules' error: the shares shall add up to 1
    for (size_t i = first; i < plan.weight.size(); ++i) {
      total += plan.weight[i];
    }
    for (size_t i = first; i < plan.weight.size(); ++i) {
      plan.weight[i] /= total;
    }
  }
  plan.begin.push_back(plan.weight.size());
  return plan;
}

}  // namespace welkin
