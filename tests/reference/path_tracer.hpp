// SPDX-License-Identifier: MIT
// One path of the Monte Carlo integration, and the parts of a ray's light that need none.
#pragma once

#include <vector>

#include "reference/light_lobe.hpp"
#include "reference/monte_carlo.hpp"

namespace welkin::reference {

class PathTracer {
 public:
  // A path on its way, or a branch of it.
  struct Path {
    Point origin;
    Point direction;
    double throughput = 1;  // albedos, absorbing layers, roulette
    double share = 1;       // of what the path stands for, after branching
    double weight = 1;      // of the path's first stretch
    double density = 0;     // per sr, of the direction when it scattered last
    uint64_t order = 0;
    bool onGround = false;
  };

  // The stretch of an eye ray that is the same for all its paths.
  struct FirstFlight {
    Rgb collides{};       // probability that a particle is hit
    double ground = FAR;  // distance to the ground, FAR if that is not what the ray sees
  };

  PathTracer(const Scene& scene, const RenderOptions& options);

  FirstFlight firstFlight(const EyeRay& ray) const;

  // Light of order 0, and order 1 of the ground seen directly from lights that do not blur.
  Rgb direct(const EyeRay& ray) const;
  Rgb transmittance(const EyeRay& ray) const;

  // One path of a channel. Adds to `events`. All three values count if the scene is grey, else that
  // of the channel. `branches`: memory for reuse.
  Rgb sample(const EyeRay& ray, const FirstFlight& first, size_t channel, Random random,
             uint64_t& events, std::vector<Path>& branches) const;

 private:
  struct Collision;
  struct Vertex;

  Collision collide(const Point& origin, const Point& direction, size_t channel, double length,
                    bool onGround, Random& random) const;
  double opticalDepth(const Point& origin, const Point& direction, size_t channel,
                      double length) const;
  // Of what paths may hit, and of what absorbs only.
  double collisionDepth(const Point& origin, const Point& direction, size_t channel,
                        double length) const;
  double absorption(const Point& origin, const Point& direction, size_t channel,
                    double length) const;
  double unshadowed(const Vertex& vertex, const Point& direction, size_t channel,
                    Random& random) const;
  Rgb lit(const Vertex& vertex, size_t channel, bool disksOnly, Random& random) const;
  Rgb outside(const Point& direction) const;
  Rgb escaped(const Path& path) const;
  Rgb follow(Path path, const Collision* first, size_t channel, Random& random, uint64_t& events,
             std::vector<Path>& branches) const;
  bool roulette(Path& path, Random& random) const;
  bool keep(Path& path, double share, double lobe, Random& random) const;
  bool blurs(size_t light) const {
    return scene_.lights[light].blurs && scene_.lights[light].angularDiameter > 0;
  }
  bool counts(uint64_t order) const {
    return order >= options_.firstOrder && order <= options_.lastOrder;
  }

  const Scene& scene_;
  const RenderOptions& options_;
  LightLobe lobe_;
  std::vector<double> diskEdge_;  // 1 - cos of each light's angular radius
  bool seesOutside_ = false;      // whether a scattered path that leaves may see anything
};

}  // namespace welkin::reference
