// SPDX-License-Identifier: MIT
// Moves a volume from where its source puts it to where the scene wants it.
#include <algorithm>
#include <limits>

#include "common/scene.hpp"

namespace host {
namespace {

struct Bounds {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = low * -1.0;
};

Bounds aroundBox(const Affine& m) {
  Bounds bounds;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p =
        transformPoint(m, {static_cast<double>(corner & 1), static_cast<double>((corner >> 1) & 1),
                           static_cast<double>(corner >> 2)});
    bounds.low = {std::min(bounds.low.x, p.x), std::min(bounds.low.y, p.y),
                  std::min(bounds.low.z, p.z)};
    bounds.high = {std::max(bounds.high.x, p.x), std::max(bounds.high.y, p.y),
                   std::max(bounds.high.z, p.z)};
  }
  return bounds;
}

// Ry Rx Rz v.
Vec3 rotate(Vec3 v, Vec3 degrees) {
  const auto turn = [](double angleDeg, double& a, double& b) {
    const double c = std::cos(angleDeg * RADIANS_PER_DEGREE);
    const double s = std::sin(angleDeg * RADIANS_PER_DEGREE);
    const double turned = c * a - s * b;
    b = s * a + c * b;
    a = turned;
  };
  turn(degrees.z, v.x, v.y);
  turn(degrees.x, v.y, v.z);
  turn(degrees.y, v.z, v.x);
  return v;
}

}  // namespace

Affine placeVolume(const Affine& natural, const PlacementDesc& placement) {
  const Bounds bounds = aroundBox(natural);
  const Vec3 edges = bounds.high - bounds.low;
  const auto factor = [](double size, double edge) { return edge > 0.0 ? size / edge : 0.0; };
  Vec3 scale{placement.scale, placement.scale, placement.scale};
  Vec3 shift = placement.origin;
  if (placement.box) {
    scale = {factor(placement.size.x, edges.x), factor(placement.size.y, edges.y),
             factor(placement.size.z, edges.z)};
    shift = placement.min - bounds.low * scale;
  }
  const Vec3 middle = (bounds.low + edges * 0.5) * scale + shift;
  const auto move = [&](Vec3 p) {
    return middle +
           rotate(transformPoint(natural, p) * scale + shift - middle, placement.rotationDeg);
  };
  const Vec3 origin = move({});
  return affineFromEdges(origin, move({1.0, 0.0, 0.0}) - origin, move({0.0, 1.0, 0.0}) - origin,
                         move({0.0, 0.0, 1.0}) - origin);
}

Affine placeMesh(const CloudMesh& mesh, const PlacementDesc& placement) {
  const Affine box = boundsOf(mesh);
  Affine place = placeVolume(box, placement);
  // The box's axes are the mesh's: undoing its size and corner takes a division and a difference.
  for (size_t row = 0; row < 12; row += 4) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double edge = box[5 * axis];
      place[row + axis] = edge > 0.0 ? place[row + axis] / edge : 0.0;
      place[row + 3] -= place[row + axis] * box[4 * axis + 3];
    }
  }
  return place;
}

}  // namespace host
