// SPDX-License-Identifier: MIT
#include "reference/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;

// Russian roulette: after so many events, paths that carry less than this.
constexpr uint64_t ROULETTE_ORDER = 32;
constexpr double ROULETTE_THROUGHPUT = 0.1;

// Draws of the first collision of a path.
constexpr int TRIES = 64;

// Branches towards the lights are kept at shares of 1 / (1 + this times the lobe's density). The
// number of paths grows by this over 4 pi.
constexpr double LOBE_IMPORTANCE = 3;

}  // namespace

// What a path meets next. Neither phase nor ground: nothing.
struct PathTracer::Collision {
  double distance = FAR;
  const PhaseFunction* phase = nullptr;
  double albedo = 1;
  bool ground = false;
};

// Where light turns.
struct PathTracer::Vertex {
  Point position;
  Point incoming;                        // direction of the path on arrival
  const PhaseFunction* phase = nullptr;  // null: the ground
  Point up{};                            // of the ground

  // Density per sr of the path's next direction, which is also the part of the light per sr that is
  // scattered from there, without the albedo.
  double density(size_t channel, const Point& direction) const {
    if (phase != nullptr) {
      return phase->value(channel, std::min(oneMinusCosine(incoming, direction), 2.0));
    }
    return std::max(dot(up, direction), 0.0) / PI;
  }
};

PathTracer::PathTracer(const Scene& scene, const RenderOptions& options)
    : scene_(scene), options_(options), lobe_(scene) {
  for (const DistantLight& light : scene.lights) {
    const double half = std::sin(light.angularDiameter / 4);
    diskEdge_.push_back(2 * half * half);
    seesOutside_ = seesOutside_ || (light.blurs && light.angularDiameter > 0);
  }
  for (const double radiance : scene.environment) {
    seesOutside_ = seesOutside_ || radiance != 0;
  }
}

PathTracer::Collision PathTracer::collide(const Point& origin, const Point& direction,
                                          size_t channel, double length, bool onGround,
                                          Random& random) const {
  Collision nearest;
  const Climb climb = scene_.globe.climb(origin, direction);
  double limit = length;
  if (scene_.ground && !onGround) {
    const double ground = climb.ground();
    if (ground < limit) {
      limit = ground;
      nearest.ground = true;
    }
  }
  nearest.distance = limit;
  const auto take = [&](double distance, const PhaseFunction& phase, double albedo) {
    if (distance < nearest.distance) {
      nearest = {distance, &phase, albedo, false};
    }
  };
  for (const ExponentialLayer& layer : scene_.layers) {
    take(layer.collision(climb, channel, nearest.distance, random), layer.phase,
         layer.albedo[channel]);
  }
  for (const UniformLayer& layer : scene_.uniformLayers) {
    take(layer.collision(climb, channel, nearest.distance, random), layer.phase,
         layer.albedo[channel]);
  }
  for (const VoxelVolume& volume : scene_.volumes) {
    const VoxelCollision hit =
        volume.collision(origin, direction, channel, nearest.distance, random);
    const ParticleField& field = volume.fields()[hit.field];
    take(hit.distance, field.phase, field.albedo[channel]);
  }
  return nearest;
}

double PathTracer::collisionDepth(const Point& origin, const Point& direction, size_t channel,
                                  double length) const {
  const Climb climb = scene_.globe.climb(origin, direction);
  double depth = 0;
  for (const ExponentialLayer& layer : scene_.layers) {
    depth += layer.opticalDepth(climb, channel, length);
  }
  for (const UniformLayer& layer : scene_.uniformLayers) {
    depth += layer.opticalDepth(climb, channel, length);
  }
  for (const VoxelVolume& volume : scene_.volumes) {
    depth += volume.opticalDepth(origin, direction, channel, length);
  }
  return depth;
}

double PathTracer::absorption(const Point& origin, const Point& direction, size_t channel,
                              double length) const {
  double depth = 0;
  for (const AbsorbingLayer& layer : scene_.absorbers) {
    depth += layer.opticalDepth(scene_.globe.climb(origin, direction), channel, length);
  }
  return depth;
}

double PathTracer::opticalDepth(const Point& origin, const Point& direction, size_t channel,
                                double length) const {
  return collisionDepth(origin, direction, channel, length) +
         absorption(origin, direction, channel, length);
}

// Estimate of the transmittance to infinity; 0 behind the ground.
double PathTracer::unshadowed(const Vertex& vertex, const Point& direction, size_t channel,
                              Random& random) const {
  const Climb climb = scene_.globe.climb(vertex.position, direction);
  if (scene_.ground && vertex.phase != nullptr && climb.ground() < FAR) {
    return 0;
  }
  const bool exact = options_.shadow == Shadow::EXACT;
  const double enough = SHADOW_DEPTH + random.exponential();
  double weight = 1;
  double depth = 0;
  for (const VoxelVolume& volume : scene_.volumes) {
    if (exact) {
      depth += volume.opticalDepth(vertex.position, direction, channel, FAR, enough - depth);
    } else {
      weight *= volume.ratioTracking(vertex.position, direction, channel, FAR, random);
    }
    if (exact && depth > enough) {
      return 0;
    }
  }
  for (const UniformLayer& layer : scene_.uniformLayers) {
    depth += layer.opticalDepth(climb, channel, FAR);
  }
  for (const ExponentialLayer& layer : scene_.layers) {
    depth += layer.opticalDepth(climb, channel, FAR);
  }
  depth += absorption(vertex.position, direction, channel, FAR);
  if (exact) {
    return depth > enough ? 0.0 : std::exp(-std::min(depth, SHADOW_DEPTH));
  }
  return weight * std::exp(-depth);
}

// Light of the lights that turns at a vertex, without albedo. A disk that blurs is hit by scattered
// paths too (`escaped`): the balance heuristic shares it out, and no peak of the phase function
// meets a direction that was drawn without regard to it.
Rgb PathTracer::lit(const Vertex& vertex, size_t channel, bool disksOnly, Random& random) const {
  Rgb sum{};
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const DistantLight& light = scene_.lights[i];
    const double edge = diskEdge_[i];
    Point direction = light.direction;
    if (blurs(i)) {
      const double y = edge * random.uniform();
      direction = deflected(light.direction, y, 2 * PI * random.uniform());
    } else if (disksOnly) {
      continue;
    }
    const double density = vertex.density(channel, direction);
    double share = 1;
    if (blurs(i)) {
      // Radiance E / (pi sin^2), solid angle 2 pi (1 - cos): their product is E 2 / (2 - (1 -
      // cos)).
      const double own = 1 / (2 * PI * edge);
      share = own / (own + density) * 2 / (2 - edge);
    }
    if (density <= 0) {
      continue;
    }
    const double value = density * share * unshadowed(vertex, direction, channel, random);
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += value * light.irradiance[c];
    }
  }
  return sum;
}

// Radiance of the lights' disks and the environment in a direction.
Rgb PathTracer::outside(const Point& direction) const {
  Rgb sum = scene_.environment;
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const double edge = diskEdge_[i];
    if (edge > 0 && oneMinusCosine(direction, scene_.lights[i].direction) < edge) {
      for (size_t c = 0; c < 3; ++c) {
        sum[c] += scene_.lights[i].irradiance[c] / (PI * edge * (2 - edge));
      }
    }
  }
  return sum;
}

// What a path that leaves after at least one event sees.
Rgb PathTracer::escaped(const Path& path) const {
  Rgb sum = scene_.environment;
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const DistantLight& light = scene_.lights[i];
    const double edge = diskEdge_[i];
    if (blurs(i) && oneMinusCosine(path.direction, light.direction) < edge) {
      const double other = 1 / (2 * PI * edge);
      const double share = path.density / (path.density + other);
      for (size_t c = 0; c < 3; ++c) {
        sum[c] += share * light.irradiance[c] / (PI * edge * (2 - edge));
      }
    }
  }
  return sum;
}

Rgb PathTracer::transmittance(const EyeRay& ray) const {
  if (scene_.ground && scene_.globe.climb(ray.origin, ray.direction).ground() < ray.length) {
    return {};
  }
  Rgb result{};
  for (size_t c = 0; c < 3; ++c) {
    result[c] = std::exp(-opticalDepth(ray.origin, ray.direction, c, ray.length));
  }
  return result;
}

Rgb PathTracer::direct(const EyeRay& ray) const {
  const double ground =
      scene_.ground ? scene_.globe.climb(ray.origin, ray.direction).ground() : FAR;
  Rgb sum{};
  if (ground < ray.length) {
    if (!counts(1)) {
      return sum;
    }
    Vertex vertex{along(ray.origin, ray.direction, ground), ray.direction, nullptr, {}};
    vertex.up = scene_.globe.upAt(vertex.position);
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
      const DistantLight& light = scene_.lights[i];
      const double cosine = std::max(dot(vertex.up, light.direction), 0.0);
      for (size_t c = 0; c < 3 && cosine > 0 && !blurs(i); ++c) {
        const double depth = opticalDepth(vertex.position, light.direction, c, FAR) +
                             opticalDepth(ray.origin, ray.direction, c, ground);
        sum[c] += scene_.groundAlbedo[c] / PI * cosine * light.irradiance[c] * std::exp(-depth);
      }
    }
    return sum;
  }
  if (counts(0)) {
    const Rgb through = transmittance(ray);
    const Rgb behind = ray.length < FAR ? ray.background : outside(ray.direction);
    for (size_t c = 0; c < 3; ++c) {
      sum[c] = through[c] * behind[c];
    }
  }
  return sum;
}

// False: the path has ended.
bool PathTracer::roulette(Path& path, Random& random) const {
  if (path.order > ROULETTE_ORDER && path.throughput < ROULETTE_THROUGHPUT) {
    if (random.uniform() * ROULETTE_THROUGHPUT > path.throughput) {
      return false;
    }
    path.throughput = ROULETTE_THROUGHPUT;
  }
  return path.throughput > 0;
}

// Takes over a direction with a share of what the path stands for, and ends shares that are too
// small for the light that the direction may bring.
bool PathTracer::keep(Path& path, double share, double lobe, Random& random) const {
  path.share *= share;
  const double wanted = 1 / (1 + LOBE_IMPORTANCE * lobe);
  if (path.share < wanted) {
    if (random.uniform() * wanted > path.share) {
      return false;
    }
    path.share = wanted;
  }
  return true;
}

// One path to its end. Each scattering goes on in a direction drawn from the phase function P and
// tries another one drawn from the lobe K around the lights; the balance heuristic gives them the
// shares P / (P + K), so that together they stand for P, and light times share stays of order 1.
Rgb PathTracer::follow(Path path, const Collision* first, size_t channel, Random& random,
                       uint64_t& events, std::vector<Path>& branches) const {
  Rgb sum{};
  const auto add = [&](const Rgb& light) {
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += path.weight * path.share * path.throughput * light[c];
    }
  };
  for (;;) {
    const Collision next = first != nullptr ? *first
                                            : collide(path.origin, path.direction, channel, FAR,
                                                      path.onGround, random);
    first = nullptr;
    path.throughput *= std::exp(-absorption(path.origin, path.direction, channel, next.distance));
    if (next.phase == nullptr && !next.ground) {
      if (path.order > 0 && counts(path.order)) {
        add(escaped(path));
      }
      return sum;
    }
    if (path.order >= options_.lastOrder) {
      return sum;
    }
    Vertex vertex{
        along(path.origin, path.direction, next.distance), path.direction, next.phase, {}};
    if (next.ground) {
      vertex.up = scene_.globe.upAt(vertex.position);
    }
    path.origin = vertex.position;
    path.onGround = next.ground;
    path.order += 1;
    path.throughput *= next.ground ? scene_.groundAlbedo[channel] : next.albedo;
    events += 1;
    if (path.throughput > 0 && counts(path.order)) {
      const bool known = next.ground && path.order == 1;  // `direct` has the points' light
      add(lit(vertex, channel, known, random));
    }
    if ((path.order >= options_.lastOrder && !seesOutside_) || !roulette(path, random)) {
      return sum;
    }
    if (!lobe_.empty(channel)) {
      Path branch = path;
      branch.direction = lobe_.sample(channel, random);
      branch.density = vertex.density(channel, branch.direction);
      const double lobe = lobe_.density(channel, branch.direction);
      if (keep(branch, branch.density / (branch.density + lobe), lobe, random)) {
        branches.push_back(branch);
      }
    }
    const double azimuth = 2 * PI * random.uniform();
    if (next.ground) {
      // Cosine distribution: cos^2 is uniform.
      path.direction = deflected(vertex.up, 1 - std::sqrt(random.uniform()), azimuth);
    } else {
      const double y = next.phase->sample(channel, random.uniform());
      path.direction = deflected(path.direction, y, azimuth);
    }
    path.density = vertex.density(channel, path.direction);
    const double lobe = lobe_.density(channel, path.direction);
    if (!keep(path, path.density / (path.density + lobe), lobe, random)) {
      return sum;
    }
  }
}

PathTracer::FirstFlight PathTracer::firstFlight(const EyeRay& ray) const {
  FirstFlight first;
  const double ground =
      scene_.ground ? scene_.globe.climb(ray.origin, ray.direction).ground() : FAR;
  first.ground = ground < ray.length ? ground : FAR;
  for (size_t c = 0; c < 3; ++c) {
    const double length = std::min(ground, ray.length);
    first.collides[c] = -std::expm1(-collisionDepth(ray.origin, ray.direction, c, length));
  }
  return first;
}

// In thin air most paths would meet nothing. So the first collision is drawn up to TRIES times,
// until one happens: with p the probability of one draw, that succeeds with 1 - (1 - p)^TRIES, and
// a path counts p over this. Light of the ground, on the rest of the paths, is added apart.
Rgb PathTracer::sample(const EyeRay& ray, const FirstFlight& first, size_t channel, Random random,
                       uint64_t& events, std::vector<Path>& branches) const {
  Rgb sum{};
  if (options_.lastOrder == 0) {
    return sum;
  }
  const auto add = [&](const Rgb& part) {
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += part[c];
    }
  };
  Path path;
  path.origin = ray.origin;
  path.direction = ray.direction;
  branches.clear();
  const double collides = first.collides[channel];
  for (int i = 0; i < TRIES && collides > 0; ++i) {
    const Collision hit = collide(ray.origin, ray.direction, channel, ray.length, false, random);
    if (hit.phase != nullptr) {
      path.weight = collides / -std::expm1(TRIES * std::log1p(-collides));
      add(follow(path, &hit, channel, random, events, branches));
      break;
    }
  }
  if (first.ground < FAR && collides < 1) {
    Collision hit;
    hit.distance = first.ground;
    hit.ground = true;
    path.weight = 1 - collides;
    add(follow(path, &hit, channel, random, events, branches));
  }
  while (!branches.empty()) {
    path = branches.back();
    branches.pop_back();
    add(follow(path, nullptr, channel, random, events, branches));
  }
  return sum;
}

}  // namespace welkin::reference
