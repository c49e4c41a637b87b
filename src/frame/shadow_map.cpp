// SPDX-License-Identifier: MIT
#include "frame/shadow_map.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

// The axis of the world that is farthest from `up`, made perpendicular to it.
glm::dvec3 levelAxis(const glm::dvec3& up) {
  const glm::dvec3 size = glm::abs(up);
  const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                          : size.z <= size.y                   ? glm::dvec3(0, 0, 1)
                                                               : glm::dvec3(0, 1, 0);
  return glm::normalize(axis - up * glm::dot(axis, up));
}

// `v` turned by the shortest rotation that takes unit vector `from` to `to`.
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) {
  const double cosine = glm::dot(from, to);
  const glm::dvec3 axis = glm::cross(from, to);
  if (cosine < -1 + 1e-12) {
    return -v;  // for v across `from`: half a turn about the third axis
  }
  return v * cosine + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + cosine));
}

// How much of the light that a volume scatters goes on behind it as if there were more of it at its
// sides: in a wide layer all; what a body as high as it is wide scatters spreads, and little of it
// meets what lies in its shadow. Never 0, since the map's depths are weighted by it.
float keptSideways(const VolumeState& volume) {
  const glm::dmat4x3& box = volume.worldFromBox;
  const auto edges = std::minmax({glm::length(box[0]), glm::length(box[1]), glm::length(box[2])});
  return static_cast<float>(std::clamp(1 - 2 * edges.first / edges.second, 0.05, 1.0));
}

}  // namespace

ShadowLayout layoutShadowMap(const WlkCloudShadowInfo& info, const glm::dvec3& toLight,
                             const glm::dvec3& up) {
  ShadowLayout s;
  s.along = -toLight;
  s.acrossU = glm::normalize(turned(levelAxis(up), up, toLight));
  s.acrossU = glm::normalize(s.acrossU - s.along * glm::dot(s.acrossU, s.along));
  s.acrossV = glm::cross(s.along, s.acrossU);
  s.width = info.extent[0];
  s.height = info.extent[1];
  const glm::dvec3 center(info.center[0], info.center[1], info.center[2]);
  // Whole texels from the world's origin: what lies between two frames of a moving camera keeps its
  // texels. Depths need no such care, but a map that does not change need not be recorded.
  const auto snapped = [](double x, double step) { return std::floor(x / step + 0.5) * step; };
  const double texelU = s.width / info.width;
  const double texelV = s.height / info.height;
  const double u = snapped(glm::dot(center, s.acrossU) - 0.5 * s.width, texelU);
  const double v = snapped(glm::dot(center, s.acrossV) - 0.5 * s.height, texelV);
  const double d = snapped(glm::dot(center, s.along), std::max(s.width, s.height) / 16);
  s.corner = s.acrossU * u + s.acrossV * v + s.along * d;
  return s;
}

std::array<double, 12> mapFromWorld(const ShadowLayout& s) {
  const std::array rows{s.acrossU / s.width, s.acrossV / s.height, s.along};
  std::array<double, 12> m{};
  for (size_t i = 0; i < 3; ++i) {
    m[4 * i] = rows[i].x;
    m[4 * i + 1] = rows[i].y;
    m[4 * i + 2] = rows[i].z;
    m[4 * i + 3] = -glm::dot(rows[i], s.corner);
  }
  return m;
}

interface_::ShadowVolume shadowVolume(const ShadowLayout& s, const WlkCloudShadowInfo& info,
                                      const VolumeState& volume, bool scattered) {
  const glm::dmat4x3& box = volume.worldFromBox;
  const glm::dvec3 middle = box * glm::dvec4(0.5, 0.5, 0.5, 1.0) - s.corner;
  glm::dvec3 reach(0);  // half extents along u, v, d
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = box[i];
    reach += 0.5 * glm::abs(glm::dvec3(glm::dot(edge, s.acrossU), glm::dot(edge, s.acrossV),
                                       glm::dot(edge, s.along)));
  }
  interface_::ShadowVolume out{};
  const auto first = [](double x, double texels) {
    return static_cast<int>(std::clamp(std::floor(x * texels), 0.0, texels));
  };
  const auto end = [](double x, double texels) {
    return static_cast<int>(std::clamp(std::ceil(x * texels), 0.0, texels));
  };
  const double u = glm::dot(middle, s.acrossU);
  const double v = glm::dot(middle, s.acrossV);
  out.rect = {first((u - reach.x) / s.width, info.width),
              first((v - reach.y) / s.height, info.height),
              end((u + reach.x) / s.width, info.width), end((v + reach.y) / s.height, info.height)};
  // The plane from which the box begins, a little before it for the rounding of floats.
  const double start = glm::dot(middle, s.along) - 1.01 * reach.z;
  const glm::dmat3 boxFromWorld = glm::inverse(glm::dmat3(box));
  const glm::dvec3 origin = boxFromWorld * (s.corner + s.along * start - box[3]);
  const glm::dvec3 along = boxFromWorld * s.along;
  // Voxels that a metre of the light's way crosses along the axis on which it crosses most.
  const glm::dvec3 voxels =
      glm::abs(along) * glm::dvec3(volume.size[0], volume.size[1], volume.size[2]);
  const double rate = std::max({voxels.x, voxels.y, voxels.z});
  out.origin = glm::vec4(glm::vec3(origin), static_cast<float>(rate));
  out.acrossU = glm::vec4(glm::vec3(boxFromWorld * (s.acrossU * s.width)),
                          static_cast<float>(info.maxSamples));
  out.acrossV =
      glm::vec4(glm::vec3(boxFromWorld * (s.acrossV * s.height)), static_cast<float>(start));
  out.along = glm::vec4(glm::vec3(along), 0.0f);
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    if (field.external || field.image) {
      out.extinctionScale[static_cast<int>(i)] =
          field.extinctionScale * static_cast<float>(field.medium.extinctionFactor());
    }
    const float kept = scattered ? keptSideways(volume) : 1.0f;
    out.weight[static_cast<int>(i)] = scattered ? kept * field.transportShare : 1.0f;
    out.absorbed[static_cast<int>(i)] =
        scattered ? 1.0f - kept + kept * 0.5f * field.absorbedShare : 0.0f;
  }
  fillBricks(volume, out);
  return out;
}

}  // namespace welkin
