// SPDX-License-Identifier: MIT
#include "reference/slab_monte_carlo.hpp"

#include <cmath>
#include <numbers>

namespace welkin::reference {
namespace {

Scene slabScene(double tau, double albedo, const PhaseFunction& phase, double mu0) {
  Scene scene;
  UniformLayer layer;
  layer.extinction = {tau, tau, tau};
  layer.albedo = {albedo, albedo, albedo};
  layer.phase = phase;
  scene.uniformLayers.push_back(layer);
  DistantLight light;
  light.direction = {-std::sqrt((1 - mu0) * (1 + mu0)), mu0, 0};
  scene.lights.push_back(light);
  return scene;
}

// An eye on the slab's face that looks against the light's direction.
EyeRay eyeRay(double mu, double phi) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  EyeRay ray;
  ray.origin = {0, mu > 0 ? 1.0 : 0.0, 0};
  ray.direction = {-sine * std::cos(phi), -mu, -sine * std::sin(phi)};
  return ray;
}

}  // namespace

SlabEstimate slabRadianceMonteCarlo(double tau, double albedo, const PhaseFunction& phase,
                                    double mu0, double mu, double phi, uint64_t samples,
                                    uint64_t seed, uint32_t firstOrder, uint32_t lastOrder) {
  RenderOptions options;
  options.samples = samples;
  options.seed = seed;
  options.firstOrder = firstOrder;
  options.lastOrder = lastOrder;
  const RenderResult result =
      render(slabScene(tau, albedo, phase, mu0), {eyeRay(mu, phi)}, options);
  // The first channel: a table may have three.
  return {result.pixels[0].radiance[0], std::sqrt(result.pixels[0].variance[0])};
}

SlabEstimate slabFluxMonteCarlo(double tau, double albedo, const PhaseFunction& phase, double mu0,
                                double mu, uint64_t samples, uint64_t seed) {
  // Cosine-distributed eye rays, one sample pair each: flux = pi * mean radiance.
  const Scene scene = slabScene(tau, albedo, phase, mu0);
  Random random(seed, 0, 0, 3);
  std::vector<EyeRay> rays;
  for (uint64_t i = 0; i < samples; ++i) {
    const double cosine = std::sqrt(random.uniform());
    rays.push_back(eyeRay(std::copysign(cosine, mu), 2 * std::numbers::pi * random.uniform()));
  }
  RenderOptions options;
  options.samples = 2;
  options.seed = seed;
  options.firstOrder = 1;
  const RenderResult result = render(scene, rays, options);
  double sum = 0;
  double square = 0;
  for (const Estimate& estimate : result.pixels) {
    const double flux = std::numbers::pi / mu0 * estimate.radiance[0];
    sum += flux;
    square += flux * flux;
  }
  const double n = static_cast<double>(samples);
  const double mean = sum / n;
  return {mean, std::sqrt((square / n - mean * mean) / (n - 1))};
}

}  // namespace welkin::reference
