// SPDX-License-Identifier: MIT
// How a volume is cut into slabs for its light, and where light rays pass them. Lengths in m.
#pragma once

#include <glm/glm.hpp>

namespace welkin {

struct SliceQuality;

// Slabs through a volume and the light buffer beside them, all relative to the eye, in m.
struct SliceLayout {
  glm::dvec3 axis;  // slabs lie across it; it runs with the light
  double slabThickness;
  double eyeStep;     // thickness that slabs across the light would have
  glm::dvec4 plane;   // plane coordinate = dot(p, xyz) + w
  glm::dvec4 lightU;  // light-buffer coordinates likewise
  glm::dvec4 lightV;
  glm::dvec3 texelOrigin;  // point on the light ray (u, v) at plane coordinate c:
  glm::dvec3 texelU;       //   origin + u U + v V + c C
  glm::dvec3 texelV;
  glm::dvec3 texelC;
  double lightPath;  // length of a light ray inside a slab
};
// `box` maps the unit box to positions relative to the eye, `view` is the direction from the eye
// to the box (half-angle only).
SliceLayout layoutSlices(const glm::dmat4x3& box, const glm::dvec3& toLight, const glm::dvec3& view,
                         const SliceQuality& quality);

}  // namespace welkin
