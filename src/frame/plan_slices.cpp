// SPDX-License-Identifier: MIT
#include "frame/plan_slices.hpp"

#include <algorithm>
#include <cmath>

#include "frame/plan.hpp"
#include "model/model.hpp"

namespace welkin {

// Across which slabs lie whose light is kept: the light's direction; of a box much wider than high
// the normal of its wide faces, wherever light passes such slabs in shorter stretches. Optical
// depth has a kink where light enters; slabs across a light that is 15 degrees high cut a layer 40
// times as wide as high into 13, and interpolation over the kinks at its faces hides a tenth of its
// light.
static glm::dvec3 storedAxis(const glm::dmat4x3& box, const glm::dvec3& travel) {
  constexpr double LAYER = 0.1;  // as in transportShape
  int thin = 0;
  double longest = 0;
  double aligned = 0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = box[i];
    thin = glm::length(edge) < glm::length(box[thin]) ? i : thin;
    longest = std::max(longest, glm::length(edge));
    aligned += std::abs(glm::dot(edge, travel));
  }
  const glm::dvec3 across = glm::cross(box[(thin + 1) % 3], box[(thin + 2) % 3]);
  const glm::dvec3 normal = glm::normalize(glm::dot(across, travel) < 0 ? -across : across);
  const double height = std::abs(glm::dot(glm::dvec3(box[thin]), normal));
  const bool layer = glm::length(box[thin]) < LAYER * longest;
  return layer && height < aligned * glm::dot(normal, travel) ? normal : travel;
}

SliceLayout layoutSlices(const glm::dmat4x3& box, const glm::dvec3& toLight, const glm::dvec3& view,
                         const SliceQuality& quality) {
  namespace model = model::f64;
  SliceLayout s{};
  const glm::dvec3 travel = -toLight;
  s.axis = quality.halfAngle ? model::halfAngleAxis(travel, view)
           : quality.stored  ? storedAxis(box, travel)
                             : travel;
  // Light-buffer axes across the light, tied to the box so that they turn only with the light.
  glm::dvec3 side = box[0];
  for (int i = 1; i < 3; ++i) {
    const glm::dvec3 other = box[i];
    if (std::abs(glm::dot(glm::normalize(other), travel)) <
        std::abs(glm::dot(glm::normalize(side), travel))) {
      side = other;
    }
  }
  const glm::dvec3 u = glm::normalize(side - travel * glm::dot(side, travel));
  const glm::dvec3 v = glm::cross(travel, u);

  const glm::dvec3 centre = box * glm::dvec4(0.5, 0.5, 0.5, 1.0);
  glm::dvec3 reach(0);  // half extents of the box along axis, u, v
  double length = 0;    // of the box along the light, or along the axis that turns with the view
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = box[i];
    reach +=
        0.5 * glm::abs(glm::dvec3(glm::dot(edge, s.axis), glm::dot(edge, u), glm::dot(edge, v)));
    length += std::abs(glm::dot(edge, quality.halfAngle ? s.axis : travel));
  }
  const double count = quality.sliceCount;
  s.slabThickness = 2.0 * reach.x / count;
  s.eyeStep = length / count;
  s.plane = glm::dvec4(s.axis / s.slabThickness,
                       0.5 * count - glm::dot(centre, s.axis) / s.slabThickness);
  // One texel of margin, so that linear filtering at the silhouette stays inside the buffer.
  const double margin = quality.lightSize / (quality.lightSize - 2.0);
  const double width = 2.0 * reach.y * margin;
  const double height = 2.0 * reach.z * margin;
  s.lightU = glm::dvec4(u / width, 0.5 - glm::dot(centre, u) / width);
  s.lightV = glm::dvec4(v / height, 0.5 - glm::dot(centre, v) / height);

  // A light ray through (u, v) meets plane c at foot + travel * (d(c) - foot.axis) / travel.axis.
  const double slope = glm::dot(travel, s.axis);
  const auto onPlane = [&](const glm::dvec3& p) {
    return p - travel * (glm::dot(p, s.axis) / slope);
  };
  s.texelU = onPlane(u * width);
  s.texelV = onPlane(v * height);
  s.texelC = travel * (s.slabThickness / slope);
  s.texelOrigin = centre - 0.5 * s.texelU - 0.5 * s.texelV - 0.5 * count * s.texelC;
  s.lightPath = s.slabThickness / slope;
  return s;
}

}  // namespace welkin
