// SPDX-License-Identifier: MIT
// A procedural cumulus: metaballs for the towers, inverted Worley noise for the cauliflower, a
// plane for the base. Idea of the noise: A. Schneider, "The real-time volumetric cloudscapes of
// Horizon Zero Dawn", 2015; the metaballs make it one cloud instead of a layer.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "common/noise.hpp"
#include "common/parallel.hpp"
#include "common/volume.hpp"

namespace host {
namespace {

struct Ball {
  Vec3 centre;
  double radius = 0.0;
};

// Lengths as parts of the box, found by eye; density falls to 0 across EDGE.
constexpr double BASE_HEIGHT = 0.08;
constexpr double BASE_SOFTNESS = 0.025;
constexpr double EDGE = 0.022;
constexpr double BILLOW = 0.10;
constexpr double BLEND = 0.05;
constexpr uint32_t BLOCK = 8;

class Random {
 public:
  explicit Random(uint32_t seed) : seed_(seed) {}
  double next(double low, double high) {
    return low + (high - low) * unitFromHash(hashLattice(count_++, 0, 0, seed_));
  }

 private:
  uint32_t seed_;
  int32_t count_ = 0;
};

// Towers on a common base, then smaller balls on their upper sides, in units of the box height.
std::vector<Ball> growBalls(uint32_t seed) {
  Random random(seed);
  std::vector<Ball> balls;
  const double main = random.next(0.0, 2.0 * PI);
  for (int tower = 0; tower < 6; ++tower) {
    const double angle = main + tower * 2.0 * PI / 5.0 + random.next(-0.4, 0.4);
    const double away = tower == 0 ? random.next(0.0, 0.1) : random.next(0.26, 0.44);
    const double top = tower == 0 ? 1.0 : random.next(0.38, 0.78);
    Ball ball{{std::cos(angle) * away, 0.0, std::sin(angle) * away}, random.next(0.22, 0.29)};
    ball.centre.y = 0.6 * ball.radius;
    while (ball.centre.y + ball.radius < top) {
      balls.push_back(ball);
      ball.centre = ball.centre + Vec3{random.next(-0.5, 0.5) * ball.radius,
                                       random.next(0.55, 0.8) * ball.radius,
                                       random.next(-0.5, 0.5) * ball.radius};
      ball.radius *= random.next(0.78, 0.92);
    }
    balls.push_back(ball);
  }
  const size_t parents = balls.size();
  for (size_t parent = 0; parent < parents; ++parent) {
    for (int child = 0; child < 9; ++child) {
      const Ball& from = balls[parent];
      const double up = random.next(-0.25, 1.0);
      const double angle = random.next(0.0, 2.0 * PI);
      const double side = std::sqrt(1.0 - up * up);
      const double radius = from.radius * random.next(0.28, 0.5);
      balls.push_back({from.centre + Vec3{std::cos(angle) * side, up, std::sin(angle) * side} *
                                         (from.radius * random.next(0.75, 0.95)),
                       radius});
    }
  }
  return balls;
}

// Scales the balls so that they and their billows just stay inside the box.
void fitBalls(std::vector<Ball>& balls, Vec3 extent) {
  double reach = 0.0;
  double top = 0.0;
  for (const Ball& ball : balls) {
    reach = std::max(
        {reach, std::abs(ball.centre.x) + ball.radius, std::abs(ball.centre.z) + ball.radius});
    top = std::max(top, ball.centre.y + ball.radius);
  }
  const double room = 0.5 * std::min(extent.x, extent.z) - 0.5 * BILLOW * extent.y;
  const double height = (1.0 - BASE_HEIGHT - 0.5 * BILLOW) * extent.y;
  const double scale = std::max(std::min(0.96 * room / reach, height / top), 0.0);
  for (Ball& ball : balls) {
    ball.centre = ball.centre * scale + Vec3{0.0, BASE_HEIGHT * extent.y, 0.0};
    ball.radius *= scale;
  }
}

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Signed distance to the balls, blended where they meet (I. Quilez's polynomial smooth minimum).
double distanceToBalls(const std::vector<Ball>& balls, Vec3 p, double blend) {
  double distance = std::numeric_limits<double>::max();
  for (const Ball& ball : balls) {
    const double d = length(p - ball.centre) - ball.radius;
    const double h = std::max(blend - std::abs(distance - d), 0.0) / blend;
    distance = std::min(distance, d) - 0.25 * h * h * blend;
  }
  return distance;
}

// Three octaves of bumps that swell outwards, in about [-0.5, 0.5].
double billows(Vec3 p, uint32_t seed) {
  double sum = 0.0;
  double weight = 0.57;
  for (uint32_t octave = 0; octave < 3; ++octave) {
    sum += weight * (0.62 - worley(p, seed + octave));
    weight *= 0.5;
    p = p * 2.1;
  }
  return sum;
}

double densityAt(const std::vector<Ball>& balls, Vec3 p, const CumulusInfo& info) {
  const double height = info.extent.y;
  const double far = distanceToBalls(balls, p, BLEND * height);
  if (far > BILLOW * height) {
    return 0.0;
  }
  const double noiseScale = 9.0 / (height * info.puffScale);
  const Vec3 warp{fbm(p * noiseScale * 0.5, 2, info.seed + 11),
                  fbm(p * noiseScale * 0.5, 2, info.seed + 13),
                  fbm(p * noiseScale * 0.5, 2, info.seed + 17)};
  const double altitude = p.y - BASE_HEIGHT * height;
  // Billows grow with height: air that rises entrains, air at the base has just condensed.
  const double strength = 0.35 + 0.65 * smoothstep(0.0, 0.35 * height, altitude);
  const double surface =
      far - BILLOW * height * strength * billows(p * noiseScale + warp * 0.35, info.seed);
  const double inside = smoothstep(0.0, -EDGE * height, surface);
  const double base = smoothstep(-0.5 * BASE_SOFTNESS * height, BASE_SOFTNESS * height,
                                 altitude + 0.3 * BASE_SOFTNESS * height * warp.y);
  // Liquid water grows about linearly over the base (adiabatic ascent); never below a third.
  const double water = 0.35 + 0.65 * std::clamp(altitude / (0.6 * height), 0.0, 1.0);
  return inside * base * water;
}

// The balls that can matter in a sphere around `centre`: nearer than the nearest surface's reach.
std::vector<Ball> ballsNear(const std::vector<Ball>& balls, Vec3 centre, double halfDiagonal,
                            double blend) {
  double nearest = std::numeric_limits<double>::max();
  for (const Ball& ball : balls) {
    nearest = std::min(nearest, length(centre - ball.centre) - ball.radius);
  }
  std::vector<Ball> near;
  for (const Ball& ball : balls) {
    if (length(centre - ball.centre) - ball.radius < nearest + 2.0 * halfDiagonal + blend) {
      near.push_back(ball);
    }
  }
  return near;
}

}  // namespace

Grid makeCumulus(const CumulusInfo& info) {
  const uint64_t count = checkedVoxelCount("cumulus", {info.size[0], info.size[1], info.size[2]});
  std::vector<Ball> balls = growBalls(info.seed);
  fitBalls(balls, info.extent);

  Grid grid;
  grid.size = info.size;
  grid.values.assign(count, 0.0f);
  grid.worldFromVolume = affineFromEdges({}, {info.extent.x, 0.0, 0.0}, {0.0, info.extent.y, 0.0},
                                         {0.0, 0.0, info.extent.z});
  const Vec3 voxel{info.extent.x / info.size[0], info.extent.y / info.size[1],
                   info.extent.z / info.size[2]};
  const auto position = [&](double x, double y, double z) {
    return Vec3{x * voxel.x - 0.5 * info.extent.x, y * voxel.y, z * voxel.z - 0.5 * info.extent.z};
  };
  const auto blocks = [](uint32_t edge) { return (edge + BLOCK - 1) / BLOCK; };
  const double halfDiagonal = 0.5 * BLOCK * length(voxel);
  const uint32_t rows = blocks(info.size[1]);

  parallelFor(rows * blocks(info.size[2]), [&](uint32_t row) {
    const uint32_t y0 = row % rows * BLOCK;
    const uint32_t z0 = row / rows * BLOCK;
    for (uint32_t x0 = 0; x0 < info.size[0]; x0 += BLOCK) {
      const Vec3 centre = position(x0 + 0.5 * BLOCK, y0 + 0.5 * BLOCK, z0 + 0.5 * BLOCK);
      const std::vector<Ball> near = ballsNear(balls, centre, halfDiagonal, BLEND * info.extent.y);
      if (distanceToBalls(near, centre, BLEND * info.extent.y) >
          halfDiagonal + BILLOW * info.extent.y) {
        continue;
      }
      // The outermost voxels stay 0, so that the box's faces don't show.
      for (uint32_t z = std::max(z0, 1u); z < std::min(z0 + BLOCK, info.size[2] - 1); ++z) {
        for (uint32_t y = std::max(y0, 1u); y < std::min(y0 + BLOCK, info.size[1] - 1); ++y) {
          for (uint32_t x = std::max(x0, 1u); x < std::min(x0 + BLOCK, info.size[0] - 1); ++x) {
            const size_t index = x + size_t{info.size[0]} * (y + size_t{info.size[1]} * z);
            grid.values[index] =
                static_cast<float>(densityAt(near, position(x + 0.5, y + 0.5, z + 0.5), info));
          }
        }
      }
    }
  });
  return grid;
}

}  // namespace host
