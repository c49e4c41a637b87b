// SPDX-License-Identifier: MIT
#include "bench/volume_scene.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "reference/noise_volume.hpp"
#include "reference/phase_reference.hpp"
#include "reference/raymarch.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr double DEGREE = host::RADIANS_PER_DEGREE;
constexpr int BRICKS = CLOUD_VOXELS / CLOUD_BRICK;
constexpr double FADE_VOXELS = 6;  // to 0 on the faces of the box

// Exact: values are 0 or multiples of 1/1024, normal in half precision.
uint16_t halfOf(float value) {
  if (value <= 0) {
    return 0;
  }
  int exponent = 0;
  const float mantissa = std::frexp(value, &exponent);
  const auto bits = static_cast<uint32_t>(std::lround(2048.0 * static_cast<double>(mantissa)));
  return static_cast<uint16_t>(static_cast<uint32_t>(exponent + 14) * 1024u + (bits - 1024u));
}

size_t brickOf(size_t voxel) {
  constexpr auto N = static_cast<size_t>(CLOUD_VOXELS);
  constexpr auto B = static_cast<size_t>(BRICKS);
  constexpr auto EDGE = static_cast<size_t>(CLOUD_BRICK);
  return (voxel / (N * N) / EDGE * B + voxel / N % N / EDGE) * B + voxel % N / EDGE;
}

// Largest value in each brick.
std::vector<double> brickPeaks(const std::vector<double>& values) {
  std::vector<double> peaks(static_cast<size_t>(BRICKS * BRICKS * BRICKS), 0);
  for (size_t i = 0; i < values.size(); ++i) {
    double& peak = peaks[brickOf(i)];
    peak = std::max(peak, values[i]);
  }
  return peaks;
}

double fade(double x) {
  return std::clamp(std::min(x, 1 - x) * CLOUD_VOXELS / FADE_VOXELS, 0.0, 1.0);
}

std::vector<double> noise() {
  std::vector<double> values;
  values.reserve(static_cast<size_t>(CLOUD_VOXELS) * CLOUD_VOXELS * CLOUD_VOXELS);
  const auto at = [](int i) { return (i + 0.5) / CLOUD_VOXELS; };
  for (int z = 0; z < CLOUD_VOXELS; ++z) {
    for (int y = 0; y < CLOUD_VOXELS; ++y) {
      for (int x = 0; x < CLOUD_VOXELS; ++x) {
        values.push_back(rt::fractalNoise(at(x), at(y), at(z), 5, 4) * fade(at(x)) * fade(at(y)) *
                         fade(at(z)));
      }
    }
  }
  return values;
}

// Runs task(0) ... task(count - 1), every `threads`-th on one thread.
template <typename Task>
void spread(uint32_t count, const Task& task) {
  const uint32_t threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> workers;
  for (uint32_t t = 0; t < threads; ++t) {
    workers.emplace_back([&, t] {
      for (uint32_t i = t; i < count; i += threads) {
        task(i);
      }
    });
  }
  for (std::thread& worker : workers) {
    worker.join();
  }
}

// Box that a ray from the eye crosses.
std::array<double, 2> crossing(const Vec3& d) {
  const Vec3 low = cloudCorner();
  const std::array<double, 3> corner{low.x, low.y, low.z};
  const std::array<double, 3> direction{d.x, d.y, d.z};
  std::array<double, 2> span{0, 1e30};
  for (size_t k = 0; k < 3; ++k) {
    const double a = corner[k] / direction[k];
    const double b = (corner[k] + CLOUD_EDGE) / direction[k];
    span[0] = std::max(span[0], std::min(a, b));
    span[1] = std::min(span[1], std::max(a, b));
  }
  return span;
}

}  // namespace

Cloud makeCloud(double occupied) {
  static const std::vector<double> field = noise();
  double threshold = 0.0;
  if (occupied < 1) {
    std::vector<double> peaks = brickPeaks(field);
    std::sort(peaks.begin(), peaks.end());
    threshold = peaks[static_cast<size_t>((1 - occupied) * static_cast<double>(peaks.size()))];
    threshold -= 0.004;  // what is less than one unit of 1/1024 rounds to 0
  }
  Cloud cloud{};
  std::vector<double> kept;
  for (const double x : field) {
    // Thin where it is everywhere, dense where it is not.
    const double value = occupied < 1 ? 4 * std::max(x - threshold, 0.0) : 1.5 * x * x + 0.2 * x;
    const auto rounded = static_cast<float>(std::round(std::clamp(value, 0.0, 1.0) * 1024) / 1024);
    cloud.values.push_back(rounded);
    cloud.halves.push_back(halfOf(rounded));
    kept.push_back(static_cast<double>(rounded));
  }
  const std::vector<double> peaks = brickPeaks(kept);
  const auto count = std::count_if(peaks.begin(), peaks.end(), [](double x) { return x > 0; });
  cloud.occupied = static_cast<double>(count) / static_cast<double>(peaks.size());
  double sum = 0;
  for (const double x : kept) {
    sum += x;
  }
  cloud.meanDepth = CLOUD_EXTINCTION * CLOUD_EDGE * sum / static_cast<double>(kept.size());
  return cloud;
}

std::vector<VolumeCase> volumeCases() {
  return {{"full-45", 1.0, 45}, {"full-120", 1.0, 120}, {"sparse-45", 0.2, 45}};
}

Vec3 cloudLight(double degrees) {
  const Vec3 side = normalize(Vec3{0.3, 1, 0});
  return Vec3{0, 0, -1} * std::cos(degrees * DEGREE) + side * std::sin(degrees * DEGREE);
}

Vec3 cloudCorner() {
  return {-0.5 * CLOUD_EDGE, -0.5 * CLOUD_EDGE, -CLOUD_DISTANCE - 0.5 * CLOUD_EDGE};
}

Vec3 cloudRay(double x, double y, uint32_t size) {
  return normalize(
      Vec3{(2 * x / size - 1) * CLOUD_TANGENT, (1 - 2 * y / size) * CLOUD_TANGENT, -1});
}

CloudTruth cloudTruth(const Cloud& cloud, const Vec3& toLight, uint32_t size, uint32_t edge) {
  rt::VoxelField field;
  field.size = {CLOUD_VOXELS, CLOUD_VOXELS, CLOUD_VOXELS};
  for (const float value : cloud.values) {
    field.extinction.push_back(CLOUD_EXTINCTION * static_cast<double>(value));
  }
  const Vec3 corner = cloudCorner();
  field.worldFromBox = {CLOUD_EDGE, 0,        0, corner.x, 0,          CLOUD_EDGE,
                        0,          corner.y, 0, 0,        CLOUD_EDGE, corner.z};
  const rt::RayMarch march(field);
  CloudTruth truth{};
  truth.pixels.resize(size_t{edge} * edge);
  truth.radiance.resize(truth.pixels.size());
  const double cell = static_cast<double>(size) / edge;
  spread(edge, [&](uint32_t row) {
    for (uint32_t column = 0; column < edge; ++column) {
      const auto jitter = [&](int axis) {
        return rt::latticeValue(static_cast<int>(column), static_cast<int>(row), axis);
      };
      const auto x = static_cast<uint32_t>(cell * (column + jitter(0)));
      const auto y = static_cast<uint32_t>(cell * (row + jitter(1)));
      const Vec3 d = cloudRay(x + 0.5, y + 0.5, size);
      const auto phase = static_cast<double>(reference::henyeyGreenstein(
          static_cast<long double>(CLOUD_G), static_cast<long double>(dot(d, toLight))));
      const size_t i = size_t{row} * edge + column;
      truth.pixels[i] = {x, y};
      truth.radiance[i] =
          phase * march.march({0, 0, 0}, {d.x, d.y, d.z}, 1e30, {toLight.x, toLight.y, toLight.z})
                      .scattered;
    }
  });
  for (const double x : truth.radiance) {
    truth.mean += x / static_cast<double>(truth.radiance.size());
  }
  return truth;
}

namespace {

template <typename Term>
double meanOver(const CloudTruth& truth, const std::vector<float>& picture, uint32_t size,
                const Term& term) {
  double sum = 0;
  for (size_t i = 0; i < truth.pixels.size(); ++i) {
    const auto [x, y] = truth.pixels[i];
    const auto seen = static_cast<double>(picture[4 * (size_t{y} * size + x)]);
    sum += term(seen - truth.radiance[i]);
  }
  return sum / static_cast<double>(truth.pixels.size());
}

}  // namespace

double cloudError(const CloudTruth& truth, const std::vector<float>& picture, uint32_t size) {
  return std::sqrt(meanOver(truth, picture, size, [](double x) { return x * x; })) / truth.mean;
}

double cloudBias(const CloudTruth& truth, const std::vector<float>& picture, uint32_t size) {
  return meanOver(truth, picture, size, [](double x) { return x; }) / truth.mean;
}

CloudSlabs cloudSlabs(const Vec3& axis, const Vec3& toLight, uint32_t count, uint32_t lightSize) {
  const Vec3 travel = toLight * -1.0;
  // An edge of the box that lies well across the light.
  const std::array<Vec3, 3> edges{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Vec3 side =
      *std::min_element(edges.begin(), edges.end(), [&](const Vec3& a, const Vec3& b) {
        return std::abs(dot(a, travel)) < std::abs(dot(b, travel));
      });
  const Vec3 u = normalize(side - travel * dot(side, travel));
  const Vec3 v = cross(travel, u);
  const auto extent = [](const Vec3& a) {
    return CLOUD_EDGE * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
  };
  const Vec3 centre = cloudCorner() + Vec3{0.5, 0.5, 0.5} * CLOUD_EDGE;
  CloudSlabs slabs{};
  slabs.axis = axis;
  slabs.thickness = extent(axis) / count;
  slabs.offset = 0.5 * count - dot(centre, axis) / slabs.thickness;
  slabs.lightPath = slabs.thickness / dot(travel, axis);
  const double margin = lightSize / (lightSize - 2.0);  // a texel, for filtering at the edge
  slabs.u = u * (1 / (extent(u) * margin));
  slabs.v = v * (1 / (extent(v) * margin));
  slabs.uAt = 0.5 - dot(centre, slabs.u);
  slabs.vAt = 0.5 - dot(centre, slabs.v);
  return slabs;
}

uint64_t eyeSamples(const Vec3& toLight, uint32_t size, uint32_t slices) {
  const double step = EYE_STEP * cloudSlabs(toLight * -1.0, toLight, slices, 64).thickness;
  const Vec3 middle = cloudCorner() + Vec3{0.5, 0.5, 0.5} * CLOUD_EDGE;
  std::vector<uint64_t> rows(size, 0);
  spread(size, [&](uint32_t y) {
    for (uint32_t x = 0; x < size; ++x) {
      const Vec3 d = cloudRay(x + 0.5, y + 0.5, size);
      const auto [begin, end] = crossing(d);
      if (begin < end) {
        const double nearest = dot(middle, d);
        rows[y] += static_cast<uint64_t>(std::ceil((end - nearest) / step) -
                                         std::floor((begin - nearest) / step));
      }
    }
  });
  uint64_t sum = 0;
  for (const uint64_t row : rows) {
    sum += row;
  }
  return sum;
}

}  // namespace bench
