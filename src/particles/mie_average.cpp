// SPDX-License-Identifier: MIT
#include "particles/mie_average.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <thread>

#include "particles/mie.hpp"
#include "particles/refractive_index.hpp"
#include "particles/solar_disk.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double GOLDEN = 0.6180339887498949;
constexpr size_t CHUNKS = 16;          // fixed, so that sums do not depend on the threads
constexpr double MIN_PER_SPREAD = 64;  // nodes of one wavelength
constexpr size_t BACK_ANGLES = 2 * MieAngles::LANES;

// Sums of weight times cross-section (um^2) over the nodes of one chunk, for one distribution.
struct Sums {
  std::vector<double> differential;  // per angle of the plan, um^2/sr
  double scattering = 0;
  double extinction = 0;
  double cosine = 0;
  double backward = 0;

  void add(const Sums& other) {
    for (size_t i = 0; i < differential.size(); ++i) {
      differential[i] += other.differential[i];
    }
    scattering += other.scattering;
    extinction += other.extinction;
    cosine += other.cosine;
    backward += other.backward;
  }
};

struct Node {
  double radius_um;
  size_t sample;
  size_t weight;  // index of the first of its weights
  bool alone;     // the only node of a monodisperse distribution
};

struct Job {
  std::span<const SpectralSample> spectrum;
  std::vector<Node> nodes;
  std::vector<double> weights;  // per node and distribution, the spectral weight included
  size_t distributions = 0;
  MieAngles angles;
  double largestX = 0;
};

// Integral of the intensity over the backward hemisphere by the midpoint rule in the angle. The
// rule's offset differs from node to node, so that the average resolves what one node does not.
double backwardIntensity(const MieSphere& sphere, size_t count, double offset, MieAngles& scratch) {
  std::vector<double> angles(count);
  std::vector<double> intensity(count);
  const double step = PI / 2 / static_cast<double>(count);
  for (size_t i = 0; i < count; ++i) {
    angles[i] = PI / 2 + (static_cast<double>(i) + offset) * step;
  }
  scratch.assign(angles);
  sphere.intensities(scratch, intensity);
  double sum = 0;
  for (size_t i = 0; i < count; ++i) {
    sum += intensity[i] * std::sin(angles[i]);
  }
  return 2 * PI * step * sum;
}

std::vector<Sums> runChunk(const Job& job, size_t chunk) {
  std::vector<Sums> sums(job.distributions);
  for (Sums& one : sums) {
    one.differential.resize(job.angles.size());
  }
  MieSphere sphere;
  MieAngles backAngles;
  std::vector<double> intensity(job.angles.size());
  for (size_t i = chunk; i < job.nodes.size(); i += CHUNKS) {
    const Node& node = job.nodes[i];
    const SpectralSample& sample = job.spectrum[node.sample];
    const double x = std::min(2 * PI / sample.wavelength_um * node.radius_um, job.largestX);
    const double k = x / node.radius_um;
    sphere.solve(x, sample.index);
    sphere.intensities(job.angles, intensity);
    const MieEfficiencies q = sphere.efficiencies();
    // A sphere alone has 2 x waves over 180 degrees; many resolve them together.
    const double needed = node.alone ? 8 * x : 40000 / static_cast<double>(job.nodes.size());
    const size_t backCount = std::max(BACK_ANGLES, static_cast<size_t>(needed));
    const double offset = std::fmod((static_cast<double>(i) + 0.5) * GOLDEN, 1.0);
    const double back = backwardIntensity(sphere, backCount, offset, backAngles) / (k * k);
    const double area = PI * node.radius_um * node.radius_um;
    for (size_t d = 0; d < job.distributions; ++d) {
      const double weight = job.weights[node.weight + d];
      if (weight == 0) {
        continue;
      }
      sums[d].scattering += weight * area * q.scattering;
      sums[d].extinction += weight * area * q.extinction;
      sums[d].cosine += weight * area * q.scattering * q.asymmetry;
      sums[d].backward += weight * back;
      for (size_t j = 0; j < intensity.size(); ++j) {
        sums[d].differential[j] += weight / (k * k) * intensity[j];
      }
    }
  }
  return sums;
}

std::vector<Sums> runChunks(const Job& job, unsigned threads) {
  std::vector<std::vector<Sums>> chunks(CHUNKS);
  std::atomic<size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failureLock;
  const auto work = [&] {
    try {
      for (size_t chunk = next++; chunk < CHUNKS; chunk = next++) {
        chunks[chunk] = runChunk(job, chunk);
      }
    } catch (...) {
      const std::lock_guard lock(failureLock);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threads; ++i) {
      helpers.emplace_back(work);
    }
    work();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  for (size_t chunk = 1; chunk < CHUNKS; ++chunk) {
    for (size_t d = 0; d < job.distributions; ++d) {
      chunks[0][d].add(chunks[chunk][d]);
    }
  }
  return std::move(chunks[0]);
}

Job makeJob(std::span<const SizeDistribution> sizes, std::span<const SpectralSample> spectrum,
            const AnglePlan& plan, const MieSettings& settings) {
  double narrowest = 1;
  for (const SizeDistribution& one : sizes) {
    const double spread = logSpread(one);
    narrowest = spread > 0 ? std::min(narrowest, spread) : narrowest;
  }
  const auto samples = static_cast<double>(spectrum.size());
  const double logStep = narrowest / std::max(settings.nodesPerSpread / samples, MIN_PER_SPREAD);
  const auto alone = static_cast<size_t>(std::count_if(
      sizes.begin(), sizes.end(), [](const auto& one) { return logSpread(one) == 0; }));
  Job job;
  job.spectrum = spectrum;
  job.distributions = sizes.size();
  job.angles.assign(plan.angles);
  job.largestX = settings.largestSizeParameter;
  for (size_t s = 0; s < spectrum.size(); ++s) {
    // Interleaved between the wavelengths: together a lattice rule over size and wavelength.
    const double offset = std::fmod((static_cast<double>(s) + 0.5) * GOLDEN, 1.0);
    const SizeNodes nodes = sizeNodes(sizes, logStep, offset);
    for (size_t i = 0; i < nodes.radius_um.size(); ++i) {
      job.nodes.push_back({nodes.radius_um[i], s, job.weights.size(), i < alone});
      for (size_t d = 0; d < sizes.size(); ++d) {
        job.weights.push_back(nodes.weight[i * sizes.size() + d] * spectrum[s].weight);
      }
    }
  }
  return job;
}

}  // namespace

std::vector<SpectralSample> waterSamples(double begin_um, double end_um, int count,
                                         double temperature_C) {
  std::vector<SpectralSample> samples;
  for (int i = 0; i < count; ++i) {
    const double wavelength = std::lerp(begin_um, end_um, (i + 0.5) / count);
    samples.push_back({wavelength, waterIndex(wavelength, temperature_C), 1.0 / count});
  }
  return samples;
}

std::vector<SpectralSample> waterSample(double wavelength_um, double temperature_C) {
  return waterSamples(wavelength_um, wavelength_um, 1, temperature_C);
}

std::vector<MieAverage> averageMie(std::span<const SizeDistribution> sizes,
                                   std::span<const SpectralSample> spectrum,
                                   std::span<const double> angles, const MieSettings& settings) {
  const AnglePlan plan = settings.solarDisk ? solarDiskPlan(angles) : pointPlan(angles);
  const Job job = makeJob(sizes, spectrum, plan, settings);
  const std::vector<Sums> sums = runChunks(job, settings.threads);
  double light = 0;
  for (const SpectralSample& sample : spectrum) {
    light += sample.weight;
  }
  std::vector<MieAverage> result(sizes.size());
  for (size_t d = 0; d < sizes.size(); ++d) {
    const Sums& sum = sums[d];
    MieAverage& mean = result[d];
    mean.scattering_um2 = sum.scattering / light;
    mean.extinction_um2 = sum.extinction / light;
    mean.efficiency = mean.scattering_um2 / (PI * meanPower(sizes[d], 2));
    mean.asymmetry = sum.cosine / sum.scattering;
    mean.forwardFraction = 1 - sum.backward / sum.scattering;
    mean.phase.assign(angles.size(), 0.0);
    for (size_t i = 0; i < angles.size(); ++i) {
      for (size_t j = plan.begin[i]; j < plan.begin[i + 1]; ++j) {
        mean.phase[i] += plan.weight[j] * sum.differential[j] / sum.scattering;
      }
    }
    if (settings.solarDisk) {  // first Legendre moment of a uniform disk: (1 + cos R) / 2
      mean.asymmetry *= (1 + std::cos(SUN_RADIUS)) / 2;
    }
  }
  return result;
}

MieAverage averageMie(const SizeDistribution& sizes, std::span<const SpectralSample> spectrum,
                      std::span<const double> angles, const MieSettings& settings) {
  return averageMie(std::span(&sizes, 1), spectrum, angles, settings).front();
}

}  // namespace welkin
