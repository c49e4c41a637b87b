// SPDX-License-Identifier: MIT
#include "reference/monte_carlo.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "reference/path_tracer.hpp"

namespace welkin::reference {
namespace {

// Samples of one ray that one thread adds up; sums of blocks are added in order.
constexpr uint64_t BLOCK = 4096;

struct Sums {
  Rgb value{};
  Rgb square{};
  uint64_t events = 0;
};

bool isGrey(const Rgb& color) {
  return color[0] == color[1] && color[0] == color[2];
}

template <typename Medium>
bool isGreyMedium(const Medium& medium) {
  return isGrey(medium.extinction) && isGrey(medium.albedo) && medium.phase.grey();
}

void check(const Scene& scene, const RenderOptions& options) {
  if (scene.globe.radius != FAR && !scene.uniformLayers.empty()) {
    throw std::invalid_argument("monte carlo: uniform layers need a flat globe");
  }
  for (const AbsorbingLayer& layer : scene.absorbers) {
    if (!(layer.halfWidth > 0)) {
      throw std::invalid_argument("monte carlo: an absorbing layer needs a width");
    }
  }
  if (options.samples < 2) {
    throw std::invalid_argument("monte carlo: an error takes two samples");
  }
}

Sums sumBlock(const PathTracer& tracer, const EyeRay& ray, bool grey, uint64_t pixel,
              uint64_t begin, uint64_t end, uint64_t seed) {
  Sums sums;
  const PathTracer::FirstFlight first = tracer.firstFlight(ray);
  std::vector<PathTracer::Path> branches;
  for (uint64_t sample = begin; sample < end; ++sample) {
    Rgb value{};
    for (size_t c = 0; c < (grey ? 1 : 3); ++c) {
      const Random random(seed, pixel, sample, c);
      const Rgb part = tracer.sample(ray, first, c, random, sums.events, branches);
      if (grey) {
        value = part;
      } else {
        value[c] = part[c];
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      sums.value[c] += value[c];
      sums.square[c] += value[c] * value[c];
    }
  }
  return sums;
}

}  // namespace

bool Scene::grey() const {
  bool grey = isGrey(groundAlbedo);
  for (const ExponentialLayer& layer : layers) {
    grey = grey && isGreyMedium(layer);
  }
  for (const UniformLayer& layer : uniformLayers) {
    grey = grey && isGreyMedium(layer);
  }
  for (const AbsorbingLayer& layer : absorbers) {
    grey = grey && isGrey(layer.extinction);
  }
  for (const VoxelVolume& volume : volumes) {
    for (const ParticleField& field : volume.fields()) {
      grey = grey && isGrey(field.extinctionScale) && isGrey(field.albedo) && field.phase.grey();
    }
  }
  return grey;
}

RenderResult render(const Scene& scene, const std::vector<EyeRay>& rays,
                    const RenderOptions& options) {
  check(scene, options);
  const PathTracer tracer(scene, options);
  const bool grey = scene.grey();
  const uint64_t blocks = (options.samples + BLOCK - 1) / BLOCK;
  const uint64_t count = blocks * rays.size();
  std::vector<Sums> sums(count);
  RenderResult result;
  result.pixels.resize(rays.size());

  std::atomic<uint64_t> next{0};
  uint64_t done = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (uint64_t i = next++; i < count; i = next++) {
      const uint64_t pixel = i / blocks;
      const uint64_t begin = i % blocks * BLOCK;
      const uint64_t end = std::min(begin + BLOCK, options.samples);
      sums[i] = sumBlock(tracer, rays[pixel], grey, pixel, begin, end, options.seed);
      if (begin == 0) {
        result.pixels[pixel].radiance = tracer.direct(rays[pixel]);
        result.pixels[pixel].transmittance = tracer.transmittance(rays[pixel]);
      }
      if (options.progress) {
        const std::lock_guard lock(mutex);
        options.progress(static_cast<double>(++done) / static_cast<double>(count));
      }
    }
  };
  const unsigned wanted =
      options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::max(wanted, 1u); ++i) {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads) {
    thread.join();
  }

  const double n = static_cast<double>(options.samples);
  for (uint64_t pixel = 0; pixel < rays.size(); ++pixel) {
    Sums total;
    for (uint64_t b = 0; b < blocks; ++b) {
      const Sums& part = sums[pixel * blocks + b];
      for (size_t c = 0; c < 3; ++c) {
        total.value[c] += part.value[c];
        total.square[c] += part.square[c];
      }
      result.events += part.events;
    }
    Estimate& estimate = result.pixels[pixel];
    for (size_t c = 0; c < 3; ++c) {
      const double mean = total.value[c] / n;
      estimate.radiance[c] += mean;
      estimate.variance[c] = std::max(total.square[c] / n - mean * mean, 0.0) / (n - 1);
    }
  }
  result.paths = options.samples * rays.size() * (grey ? 1 : 3);
  return result;
}

}  // namespace welkin::reference
