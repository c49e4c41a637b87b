// SPDX-License-Identifier: MIT
#include "reference/light_lobe.hpp"

#include <cmath>
#include <numbers>

namespace welkin::reference {
namespace {

constexpr double PEAK = 1.0;  // 1/sr; what is below makes no noise worth branching for

}  // namespace

LightLobe::LightLobe(const Scene& scene) {
  double sum = 0;
  for (const DistantLight& light : scene.lights) {
    const double power = light.irradiance[0] + light.irradiance[1] + light.irradiance[2];
    if (power > 0) {
      lights_.push_back({light.direction, power});
      sum += power;
    }
  }
  for (Light& light : lights_) {
    light.share /= sum;
  }
  if (lights_.empty()) {
    return;
  }
  for (const ExponentialLayer& layer : scene.layers) {
    add(layer.phase);
  }
  for (const UniformLayer& layer : scene.uniformLayers) {
    add(layer.phase);
  }
  for (const VoxelVolume& volume : scene.volumes) {
    for (const ParticleField& field : volume.fields()) {
      add(field.phase);
    }
  }
}

void LightLobe::add(const PhaseFunction& phase) {
  for (size_t c = 0; c < 3; ++c) {
    // Outermost angle above the bound, among 0.5 % steps from 1e-4 rad.
    double edge = 0;
    for (double y = 5e-9; y < 1; y *= 1.01) {
      edge = phase.value(c, y) > PEAK ? y : edge;
    }
    if (edge == 0) {
      continue;
    }
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (phase.sample(c, middle) < edge ? low : high) = middle;
    }
    peaks_[c].push_back({&phase, phase.sample(c, low), low});
  }
}

double LightLobe::density(size_t channel, const Point& direction) const {
  double sum = 0;
  for (const Light& light : lights_) {
    const double y = oneMinusCosine(light.direction, direction);
    for (const Peak& peak : peaks_[channel]) {
      if (y < peak.edge) {
        sum += light.share * peak.phase->value(channel, y) / peak.energy;
      }
    }
  }
  return sum > 0 ? sum / static_cast<double>(peaks_[channel].size()) : 0.0;
}

Point LightLobe::sample(size_t channel, Random& random) const {
  double rest = random.uniform();
  size_t i = 0;
  while (i + 1 < lights_.size() && rest >= lights_[i].share) {
    rest -= lights_[i++].share;
  }
  const std::vector<Peak>& peaks = peaks_[channel];
  const auto which = static_cast<size_t>(random.uniform() * static_cast<double>(peaks.size()));
  const Peak& peak = peaks[which];
  const double y = peak.phase->sample(channel, random.uniform() * peak.energy);
  return deflected(lights_[i].direction, y, 2 * std::numbers::pi * random.uniform());
}

}  // namespace welkin::reference
