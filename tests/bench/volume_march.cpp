// SPDX-License-Identifier: MIT
#include "bench/volume_march.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace bench {
namespace {

constexpr double MARCH_STEP = 0.75;  // in slabs, at most; whole steps per slab
constexpr uint32_t BATCH = 64;       // slabs whose light is kept
constexpr size_t PADDING = 1;        // values behind the last one, which pairs read

template <typename Row>
void eachRow(uint32_t rows, uint32_t threads, const Row& row) {
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    for (uint32_t i = next++; i < rows; i = next++) {
      row(i);
    }
  };
  std::vector<std::thread> others;
  for (uint32_t t = 1; t < threads; ++t) {
    others.emplace_back(work);
  }
  work();
  for (std::thread& other : others) {
    other.join();
  }
}

}  // namespace

CloudMarch::CloudMarch(const Cloud& cloud, const Vec3& toLight, uint32_t size, uint32_t slices,
                       uint32_t lightSize, uint32_t threads)
    : density_(cloud.halves),
      toLight_(toLight),
      slabs_(cloudSlabs(toLight * -1.0, toLight, slices, lightSize)),
      size_(size),
      slices_(slices),
      batch_(std::min(slices, BATCH)),
      lightSize_(lightSize),
      threads_(threads),
      light_(size_t{batch_ + 1} * lightSize * lightSize),
      radiance_(size_t{size} * size),
      through_(size_t{size} * size) {
  density_.resize(density_.size() + PADDING);
}

void CloudMarch::render() {
  for (uint32_t slab = 0; slab < slices_; slab += batch_) {
    eachRow(lightSize_, threads_, [&](uint32_t row) { lightRow(row, slab); });
    eachRow(size_, threads_, [&](uint32_t row) { eyeRow(row, slab, slab == 0); });
  }
}

std::vector<float> CloudMarch::picture() const {
  std::vector<float> picture;
  picture.reserve(4 * radiance_.size());
  for (uint32_t y = 0; y < size_; ++y) {
    for (uint32_t x = 0; x < size_; ++x) {
      const size_t i = size_t{y} * size_ + x;
      const double cosine = dot(cloudRay(x + 0.5, y + 0.5, size_), toLight_);
      const double base = 1 + CLOUD_G * CLOUD_G - 2 * CLOUD_G * cosine;
      const double phase = (1 - CLOUD_G * CLOUD_G) / (4 * host::PI * base * std::sqrt(base));
      const float value = radiance_[i] * static_cast<float>(phase);
      picture.insert(picture.end(), {value, value, value, through_[i]});
    }
  }
  return picture;
}

#ifdef __x86_64__
#pragma GCC push_options
#pragma GCC target("avx2,fma,f16c")

namespace {

constexpr int LANES = 8;
using Floats = __m256;
using Ints = __m256i;

Floats all(double x) {
  return _mm256_set1_ps(static_cast<float>(x));
}

// e^-x for x >= 0, relative error 3e-7 up to x = 87, where it stays.
Floats expMinus(Floats x) {
  const Floats y = _mm256_max_ps(_mm256_mul_ps(x, all(-1.4426950408889634)), all(-126));
  const Floats whole = _mm256_round_ps(y, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  const Floats f = _mm256_sub_ps(y, whole);
  // ln(2)^k / k!
  Floats p = all(0.00015403530393381608);
  p = _mm256_fmadd_ps(p, f, all(0.0013333558146428443));
  p = _mm256_fmadd_ps(p, f, all(0.009618129107628477));
  p = _mm256_fmadd_ps(p, f, all(0.05550410866482158));
  p = _mm256_fmadd_ps(p, f, all(0.24022650695910072));
  p = _mm256_fmadd_ps(p, f, all(0.6931471805599453));
  p = _mm256_fmadd_ps(p, f, all(1));
  const Ints exponent = _mm256_slli_epi32(_mm256_cvtps_epi32(whole), 23);
  return _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(p), exponent));
}

struct Cell {
  Ints low;
  Floats part;
};

// Of a coordinate in texels whose middles are whole numbers; constant beyond the outermost.
Cell cellOf(Floats x, uint32_t count) {
  const Floats clamped = _mm256_min_ps(_mm256_max_ps(x, _mm256_setzero_ps()), all(count - 1.0));
  const Floats low = _mm256_min_ps(_mm256_floor_ps(clamped), all(count - 2.0));
  return {_mm256_cvtps_epi32(low), _mm256_sub_ps(clamped, low)};
}

Floats mix(Floats a, Floats b, Floats t) {
  return _mm256_fmadd_ps(t, _mm256_sub_ps(b, a), a);
}

// Along x between a voxel and the next: one gather of 4 bytes has both.
Floats pairOf(const uint16_t* values, Ints at, Floats part) {
  const Ints both = _mm256_i32gather_epi32(reinterpret_cast<const int*>(values), at, 2);
  const Ints low = _mm256_and_si256(both, _mm256_set1_epi32(0xffff));
  const Ints packed =
      _mm256_permute4x64_epi64(_mm256_packus_epi32(low, _mm256_srli_epi32(both, 16)), 0xd8);
  const Floats a = _mm256_cvtph_ps(_mm256_castsi256_si128(packed));
  const Floats b = _mm256_cvtph_ps(_mm256_extracti128_si256(packed, 1));
  return mix(a, b, part);
}

// Density at voxel coordinates.
Floats densityAt(const uint16_t* values, Floats x, Floats y, Floats z) {
  const Cell cx = cellOf(x, CLOUD_VOXELS);
  const Cell cy = cellOf(y, CLOUD_VOXELS);
  const Cell cz = cellOf(z, CLOUD_VOXELS);
  const Ints row = _mm256_set1_epi32(CLOUD_VOXELS);
  const Ints layer = _mm256_set1_epi32(CLOUD_VOXELS * CLOUD_VOXELS);
  Ints at = _mm256_add_epi32(_mm256_mullo_epi32(cz.low, row), cy.low);
  at = _mm256_add_epi32(_mm256_mullo_epi32(at, row), cx.low);
  const Floats near =
      mix(pairOf(values, at, cx.part), pairOf(values, _mm256_add_epi32(at, row), cx.part), cy.part);
  at = _mm256_add_epi32(at, layer);
  const Floats far =
      mix(pairOf(values, at, cx.part), pairOf(values, _mm256_add_epi32(at, row), cx.part), cy.part);
  return mix(near, far, cz.part);
}

Floats edgeOf(const float* values, Ints at, Floats part) {
  return mix(_mm256_i32gather_ps(values, at, 4), _mm256_i32gather_ps(values + 1, at, 4), part);
}

Floats lightAt(const float* values, uint32_t size, uint32_t planes, Floats x, Floats y, Floats z) {
  const Cell cx = cellOf(x, size);
  const Cell cy = cellOf(y, size);
  const Cell cz = cellOf(z, planes);
  const Ints row = _mm256_set1_epi32(static_cast<int>(size));
  const Ints layer = _mm256_set1_epi32(static_cast<int>(size * size));
  Ints at = _mm256_add_epi32(_mm256_mullo_epi32(cz.low, row), cy.low);
  at = _mm256_add_epi32(_mm256_mullo_epi32(at, row), cx.low);
  const Floats near =
      mix(edgeOf(values, at, cx.part), edgeOf(values, _mm256_add_epi32(at, row), cx.part), cy.part);
  at = _mm256_add_epi32(at, layer);
  const Floats far =
      mix(edgeOf(values, at, cx.part), edgeOf(values, _mm256_add_epi32(at, row), cx.part), cy.part);
  return mix(near, far, cz.part);
}

// Not std::array: a template argument would lose the vector's alignment.
struct Triple {
  Floats at[3];
  Floats& operator[](size_t i) { return at[i]; }
  const Floats& operator[](size_t i) const { return at[i]; }
};

// origin + t direction per lane.
struct Rays {
  Triple origin;
  Triple direction;
};

struct Stretch {
  Floats begin;
  Floats end;
};

Triple pointAt(const Rays& rays, Floats t) {
  return Triple{_mm256_fmadd_ps(rays.direction[0], t, rays.origin[0]),
                _mm256_fmadd_ps(rays.direction[1], t, rays.origin[1]),
                _mm256_fmadd_ps(rays.direction[2], t, rays.origin[2])};
}

// Stretch inside [0, edge]^3; empty if the end is not behind the beginning.
Stretch insideOf(const Rays& rays, double edge) {
  Floats begin = all(-1e30);
  Floats end = all(1e30);
  for (size_t k = 0; k < 3; ++k) {
    const Floats inverse = _mm256_div_ps(all(1), rays.direction[k]);
    const Floats a = _mm256_mul_ps(_mm256_sub_ps(_mm256_setzero_ps(), rays.origin[k]), inverse);
    const Floats b = _mm256_mul_ps(_mm256_sub_ps(all(edge), rays.origin[k]), inverse);
    begin = _mm256_max_ps(begin, _mm256_min_ps(a, b));
    end = _mm256_min_ps(end, _mm256_max_ps(a, b));
  }
  return {begin, end};
}

Floats lanes() {
  return _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
}

}  // namespace

void CloudMarch::lightRow(uint32_t row, uint32_t firstSlab) {
  const Vec3 travel = toLight_ * -1.0;
  const double uWidth = 1 / length(slabs_.u);
  const double vWidth = 1 / length(slabs_.v);
  const Vec3 alongU = slabs_.u * (uWidth * uWidth / lightSize_);  // a texel
  const Vec3 corner = cloudCorner();
  const double perVoxel = CLOUD_VOXELS / CLOUD_EDGE;
  const Vec3 step = travel * (slabs_.thickness * perVoxel);  // a slab, in voxels
  const Vec3 base = slabs_.u * (uWidth * uWidth * (0.5 / lightSize_ - slabs_.uAt)) +
                    slabs_.v * (vWidth * vWidth * ((row + 0.5) / lightSize_ - slabs_.vAt)) +
                    travel * ((firstSlab - slabs_.offset) * slabs_.thickness) - corner;
  const Floats scale = all(CLOUD_EXTINCTION * slabs_.lightPath);
  const size_t plane = size_t{lightSize_} * lightSize_;
  for (uint32_t column = 0; column < lightSize_; column += LANES) {
    const Floats at = _mm256_add_ps(lanes(), all(column));
    Rays rays{};
    const std::array<double, 3> from{base.x, base.y, base.z};
    const std::array<double, 3> across{alongU.x, alongU.y, alongU.z};
    const std::array<double, 3> forward{step.x, step.y, step.z};
    for (size_t k = 0; k < 3; ++k) {
      rays.origin[k] = _mm256_fmadd_ps(at, all(across[k] * perVoxel), all(from[k] * perVoxel));
      rays.direction[k] = all(forward[k]);
    }
    const auto [begin, end] = insideOf(rays, CLOUD_VOXELS);
    float* out = &light_[size_t{row} * lightSize_ + column];
    Floats depth = firstSlab == 0 ? _mm256_setzero_ps() : _mm256_loadu_ps(out + batch_ * plane);
    _mm256_storeu_ps(out, depth);
    for (uint32_t k = 0; k < batch_; ++k) {
      const Floats a = _mm256_max_ps(all(k), begin);
      const Floats b = _mm256_max_ps(_mm256_min_ps(all(k + 1.0), end), a);
      const Floats stretch = _mm256_sub_ps(b, a);
      if (_mm256_movemask_ps(_mm256_cmp_ps(stretch, _mm256_setzero_ps(), _CMP_GT_OQ)) != 0) {
        const auto p = pointAt(rays, _mm256_mul_ps(all(0.5), _mm256_add_ps(a, b)));
        const Floats half = all(0.5);
        const Floats value = densityAt(density_.data(), _mm256_sub_ps(p[0], half),
                                       _mm256_sub_ps(p[1], half), _mm256_sub_ps(p[2], half));
        depth = _mm256_fmadd_ps(_mm256_mul_ps(value, scale), stretch, depth);
      }
      out += plane;
      _mm256_storeu_ps(out, depth);
    }
  }
}

void CloudMarch::eyeRow(uint32_t row, uint32_t firstSlab, bool first) {
  const Vec3 corner = cloudCorner();
  const double perVoxel = CLOUD_VOXELS / CLOUD_EDGE;
  const double longest = MARCH_STEP * slabs_.thickness;
  for (uint32_t column = 0; column < size_; column += LANES) {
    std::array<std::array<float, LANES>, 8> lane{};  // directions of voxel and light; step; planes
    for (uint32_t i = 0; i < LANES; ++i) {
      const Vec3 d = cloudRay(column + i + 0.5, row + 0.5, size_);
      const double rate = dot(d, slabs_.axis) / slabs_.thickness;
      const std::array<double, 8> values{
          d.x * perVoxel,
          d.y * perVoxel,
          d.z * perVoxel,
          dot(d, slabs_.u) * lightSize_,
          dot(d, slabs_.v) * lightSize_,
          rate,
          1 / (std::abs(rate) * std::ceil(1 / (std::abs(rate) * longest))),
          0};
      for (size_t k = 0; k < values.size(); ++k) {
        lane[k][i] = static_cast<float>(values[k]);
      }
    }
    Rays voxels{};
    Rays light{};
    const std::array<double, 3> from{-corner.x, -corner.y, -corner.z};
    for (size_t k = 0; k < 3; ++k) {
      voxels.origin[k] = all(from[k] * perVoxel);
      voxels.direction[k] = _mm256_loadu_ps(lane[k].data());
      light.direction[k] = _mm256_loadu_ps(lane[k + 3].data());
    }
    light.origin = Triple{all(slabs_.uAt * lightSize_ - 0.5), all(slabs_.vAt * lightSize_ - 0.5),
                          all(slabs_.offset - firstSlab)};
    const auto [enter, leave] = insideOf(voxels, CLOUD_VOXELS);
    for (Floats& x : voxels.origin.at) {
      x = _mm256_sub_ps(x, all(0.5));
    }
    // The part within the batch's planes.
    const Floats inverse = _mm256_div_ps(all(1), light.direction[2]);
    const Floats a = _mm256_mul_ps(_mm256_sub_ps(_mm256_setzero_ps(), light.origin[2]), inverse);
    const Floats b = _mm256_mul_ps(_mm256_sub_ps(all(batch_), light.origin[2]), inverse);
    Floats t = _mm256_max_ps(enter, _mm256_min_ps(a, b));
    const Floats last = _mm256_min_ps(leave, _mm256_max_ps(a, b));
    const Floats wanted = _mm256_loadu_ps(lane[6].data());
    const Floats reach = _mm256_max_ps(_mm256_sub_ps(last, t), _mm256_setzero_ps());
    const Floats steps = _mm256_ceil_ps(_mm256_sub_ps(_mm256_div_ps(reach, wanted), all(1e-3)));
    const Floats dt = _mm256_div_ps(reach, _mm256_max_ps(steps, all(1)));
    Floats left = steps;
    Floats radiance = _mm256_setzero_ps();
    Floats through = all(1);
    t = _mm256_fmadd_ps(all(0.5), dt, t);
    Floats active = _mm256_cmp_ps(left, _mm256_setzero_ps(), _CMP_GT_OQ);
    while (_mm256_movemask_ps(active) != 0) {
      const auto p = pointAt(voxels, t);
      const auto l = pointAt(light, t);
      const Floats beta =
          _mm256_mul_ps(densityAt(density_.data(), p[0], p[1], p[2]), all(CLOUD_EXTINCTION));
      const Floats tau = lightAt(light_.data(), lightSize_, batch_ + 1, l[0], l[1], l[2]);
      const Floats passed = expMinus(_mm256_and_ps(_mm256_mul_ps(beta, dt), active));
      const Floats seen = _mm256_mul_ps(_mm256_sub_ps(all(1), passed), expMinus(tau));
      radiance = _mm256_fmadd_ps(through, seen, radiance);
      through = _mm256_mul_ps(through, passed);
      t = _mm256_add_ps(t, dt);
      left = _mm256_sub_ps(left, all(1));
      active = _mm256_cmp_ps(left, _mm256_setzero_ps(), _CMP_GT_OQ);
    }
    float* outRadiance = &radiance_[size_t{row} * size_ + column];
    float* outThrough = &through_[size_t{row} * size_ + column];
    const Floats old = first ? _mm256_setzero_ps() : _mm256_loadu_ps(outRadiance);
    const Floats oldThrough = first ? all(1) : _mm256_loadu_ps(outThrough);
    // Rays that run with the light meet their batches nearest first.
    const Floats ahead = _mm256_cmp_ps(light.direction[2], _mm256_setzero_ps(), _CMP_GT_OQ);
    const Floats under = _mm256_fmadd_ps(oldThrough, radiance, old);
    const Floats over = _mm256_fmadd_ps(through, old, radiance);
    _mm256_storeu_ps(outRadiance, _mm256_blendv_ps(over, under, ahead));
    _mm256_storeu_ps(outThrough, _mm256_mul_ps(through, oldThrough));
  }
}

#pragma GCC pop_options

bool marchRuns() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
         __builtin_cpu_supports("f16c") != 0;
}
#else
void CloudMarch::lightRow(uint32_t, uint32_t) {}
void CloudMarch::eyeRow(uint32_t, uint32_t, bool) {}
bool marchRuns() {
  return false;
}
#endif

}  // namespace bench
