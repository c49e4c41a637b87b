// SPDX-License-Identifier: MIT
#include "bench/volume_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <utility>

#include "bench/volume_tracer.hpp"

namespace bench {
namespace {

using welkin::reference::Point;
using welkin::reference::Random;

constexpr double RADIANS = std::numbers::pi / 180;

// The pixel that is traced for a pixel of a sphere: a picture is symmetric about y, and with the
// sun behind the eye about both axes and the diagonal.
int tracedPixel(int x, int y, bool behind) {
  const int last = SPHERE_PIXELS - 1;
  int v = std::min(y, last - y);
  int u = behind ? std::min(x, last - x) : x;
  if (behind && u > v) {
    std::swap(u, v);
  }
  return v * SPHERE_PIXELS + u;
}

// As in the scenes: azimuth from -z over +x.
Point sunAt(double elevation_deg, double azimuth_deg) {
  const double c = std::cos(elevation_deg * RADIANS);
  return welkin::reference::normalized({std::sin(azimuth_deg * RADIANS) * c,
                                        std::sin(elevation_deg * RADIANS),
                                        -std::cos(azimuth_deg * RADIANS) * c});
}

std::vector<CloudCase> withSuns(const CloudCase& cloud) {
  std::vector<CloudCase> cases;
  for (const bool droplets : {false, true}) {
    const std::string end = droplets ? "-droplets" : "-hg";
    for (const auto& [name, sun] :
         {std::pair{"-front", sunAt(35, 195)}, std::pair{"-side", sunAt(35, 90)},
          std::pair{"-back", sunAt(28, 8)}}) {
      cases.push_back(cloud);
      cases.back().name += name + end;
      cases.back().sun = sun;
      cases.back().droplets = droplets;
    }
  }
  return cases;
}

}  // namespace

std::vector<float> sphereVoxels() {
  constexpr int N = SPHERE_VOXELS;
  constexpr int SUB = SPHERE_SUBSAMPLES;
  std::vector<double> square;  // of the subsamples' coordinates along an axis
  for (int i = 0; i < N * SUB; ++i) {
    const double x = ((i + 0.5) / (N * SUB) - 0.5) * SPHERE_BOX;
    square.push_back(x * x);
  }
  std::vector<int> count(size_t{N} * N * N);
  for (size_t z = 0; z < square.size(); ++z) {
    for (size_t y = 0; y < square.size(); ++y) {
      for (size_t x = 0; x < square.size(); ++x) {
        count[(z / SUB * N + y / SUB) * N + x / SUB] += square[x] + square[y] + square[z] < 1;
      }
    }
  }
  std::vector<float> values;
  for (const int one : count) {
    values.push_back(static_cast<float>(one) / (SUB * SUB * SUB));
  }
  return values;
}

std::string sphereName(int opticalRadius, int angle_deg) {
  return "sphere-" + std::to_string(opticalRadius) + "-" + std::to_string(angle_deg);
}

std::vector<CloudCase> cumulusCases() {
  CloudCase cloud;
  cloud.name = "cumulus";
  cloud.voxels = {96, 72, 96};
  cloud.min = {-1200, 900, -1200};
  cloud.extent = {2400, 1800, 2400};
  cloud.eye = {0, 1100, 4200};
  cloud.target = {0, 1750, 0};
  cloud.verticalFov_deg = 42;
  cloud.width = 48;
  cloud.height = 27;
  return withSuns(cloud);
}

std::vector<CloudCase> lesCases() {
  CloudCase cloud;
  cloud.name = "les";
  cloud.voxels = {32, 26, 37};
  cloud.min = {-320, 420, -370};
  cloud.extent = {640, 1040, 740};
  cloud.eye = {0, 700, 1700};
  cloud.target = {0, 950, 0};
  cloud.verticalFov_deg = 36;
  cloud.width = 32;
  cloud.height = 32;
  return withSuns(cloud);
}

std::vector<CloudCase> lesSingleCases() {
  const CloudCase cloud = lesCases().front();
  const Point view =
      welkin::reference::normalized(welkin::reference::minus(cloud.target, cloud.eye));
  // Above the horizon, along no axis of the box.
  const Point right = welkin::reference::normalized(welkin::reference::cross(view, {-0.3, 1, 0}));
  const Point side = welkin::reference::cross(right, view);
  std::vector<CloudCase> cases;
  for (const double angle : LES_SINGLE_ANGLES) {
    CloudCase one = cloud;
    char name[32];
    std::snprintf(name, sizeof name, "les-single-%g", angle);
    one.name = name;
    one.droplets = false;
    for (size_t k = 0; k < 3; ++k) {
      one.sun[k] = std::cos(angle * RADIANS) * view[k] + std::sin(angle * RADIANS) * side[k];
    }
    cases.push_back(one);
  }
  return cases;
}

double TruthImage::mean() const {
  return std::accumulate(radiance.begin(), radiance.end(), 0.0) /
         static_cast<double>(radiance.size());
}

TruthImage traceSphere(int opticalRadius, int angle_deg, uint64_t paths, uint64_t seed) {
  std::vector<float> extinction = sphereVoxels();
  for (float& value : extinction) {
    value *= static_cast<float>(opticalRadius);
  }
  constexpr int N = SPHERE_VOXELS;
  const VoxelBox box({N, N, N}, {SPHERE_BOX, SPHERE_BOX, SPHERE_BOX}, std::move(extinction));
  const auto phase = welkin::reference::PhaseFunction::henyeyGreenstein(TRUTH_G);
  const VolumeTracer tracer(box, phase, {0, 0, 1});

  const bool behind = angle_deg == 180;
  const double sine = behind ? 0 : std::sin(angle_deg * RADIANS);
  const double cosine = behind ? -1 : std::cos(angle_deg * RADIANS);
  const Point eye{-SPHERE_DISTANCE * sine, 0, -SPHERE_DISTANCE * cosine};
  TruthImage image;
  image.paths = paths;
  image.width = image.height = SPHERE_PIXELS;
  std::vector<Sample> traced(size_t{SPHERE_PIXELS} * SPHERE_PIXELS);
  for (int y = 0; y < SPHERE_PIXELS; ++y) {
    for (int x = 0; x < SPHERE_PIXELS; ++x) {
      const auto pixel = static_cast<size_t>(y * SPHERE_PIXELS + x);
      const auto from = static_cast<size_t>(tracedPixel(x, y, behind));
      if (from == pixel) {
        const auto ray = [&](Random& random) {
          const double u = ((x + random.uniform()) / SPHERE_PIXELS - 0.5) * SPHERE_BOX;
          const double v = (0.5 - (y + random.uniform()) / SPHERE_PIXELS) * SPHERE_BOX;
          const Point target{-cosine * u, v, sine * u};
          return TracerRay{eye,
                           welkin::reference::normalized(welkin::reference::minus(target, eye))};
        };
        traced[pixel] = tracer.trace(ray, paths, seed, pixel);
      }
    }
  }
  for (int y = 0; y < SPHERE_PIXELS; ++y) {
    for (int x = 0; x < SPHERE_PIXELS; ++x) {
      const Sample& sample = traced[static_cast<size_t>(tracedPixel(x, y, behind))];
      image.radiance.push_back(sample.mean());
      image.error.push_back(sample.error());
    }
  }
  return image;
}

TruthImage traceCloud(const CloudCase& one, std::vector<float> extinction,
                      const welkin::reference::PhaseFunction& phase, uint64_t paths,
                      uint64_t seed) {
  const VoxelBox box(one.voxels, one.extent, std::move(extinction));
  const VolumeTracer tracer(box, phase, one.sun);
  const Point origin =
      welkin::reference::minus(one.eye, welkin::reference::along(one.min, one.extent, 0.5));
  const Point forward =
      welkin::reference::normalized(welkin::reference::minus(one.target, one.eye));
  const Point right = welkin::reference::normalized(welkin::reference::cross(forward, {0, 1, 0}));
  const Point up = welkin::reference::cross(right, forward);
  const double half = std::tan(0.5 * one.verticalFov_deg * RADIANS);
  TruthImage image;
  image.paths = paths;
  image.width = one.width;
  image.height = one.height;
  for (int y = 0; y < one.height; ++y) {
    for (int x = 0; x < one.width; ++x) {
      const auto ray = [&](Random& random) {
        const double u = ((x + random.uniform()) - 0.5 * one.width) * 2 * half / one.height;
        const double v = (0.5 * one.height - (y + random.uniform())) * 2 * half / one.height;
        Point d{};
        for (size_t k = 0; k < 3; ++k) {
          d[k] = forward[k] + u * right[k] + v * up[k];
        }
        return TracerRay{origin, welkin::reference::normalized(d)};
      };
      const Sample sample =
          tracer.trace(ray, paths, seed, static_cast<uint64_t>(y * one.width + x));
      image.radiance.push_back(sample.mean());
      image.error.push_back(sample.error());
    }
  }
  return image;
}

}  // namespace bench
