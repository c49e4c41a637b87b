// SPDX-License-Identifier: MIT
// Radiance of a homogeneous body bounded by a mesh in a parallel beam, by Monte Carlo: all orders
// of scattering, light scattered once apart from the rest. Per unit irradiance on a surface facing
// the beam; around the body is nothing.
#pragma once

#include <cstdint>
#include <functional>

#include "reference/mesh_body.hpp"
#include "reference/phase_function.hpp"
#include "reference/random.hpp"

namespace welkin::reference {

struct MeshMedium {
  double extinction = 1;  // per unit length
  double albedo = 1;
  PhaseFunction phase = PhaseFunction::isotropic();
};

struct MeshRay {
  Point origin;
  Point direction;  // unit vector
};

// Mean and squared standard error, of light scattered once and of all other.
struct MeshEstimate {
  double once = 0, onceVariance = 0;
  double rest = 0, restVariance = 0;
  double opacity = 0;  // mean of 1 - transmittance
  double facing = 0;   // mean of the cosine between the light and the normal where rays enter
};

class MeshTracer {
 public:
  MeshTracer(const MeshBody& body, const MeshMedium& medium) : body_(body), medium_(medium) {}

  // `draw` gives each path its ray and the unit vector towards its light.
  struct Start {
    MeshRay ray;
    Point toLight;
  };
  MeshEstimate trace(const std::function<Start(Random&)>& draw, uint64_t paths, uint64_t seed,
                     uint64_t pixel) const;

 private:
  struct Light {
    double once = 0, rest = 0;
    double opacity = 0;
    double facing = 0;
  };
  Light path(const Start& start, Random& random) const;

  const MeshBody& body_;
  const MeshMedium& medium_;
};

}  // namespace welkin::reference
