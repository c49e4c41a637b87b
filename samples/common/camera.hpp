// SPDX-License-Identifier: MIT
// A pinhole camera: right-handed world, y up, reversed infinite depth.
#pragma once

#include <welkin/welkin.h>

#include "common/vec.hpp"

namespace host {

struct CameraDesc {
  Vec3 position{0.0, 2.0, 0.0};
  /// Unit vector of the view.
  Vec3 forward{0.0, 0.0, -1.0};
  double verticalFovDeg = 60.0;
  /// Distance of depth value 1, in metres.
  double nearPlane = 0.1;
  double preExposure = 1.0;
};

/// Unit axes of the picture in the world; `up` is as near to +y as the view allows.
struct CameraAxes {
  Vec3 right;
  Vec3 up;
  Vec3 forward;
};
CameraAxes cameraAxes(const CameraDesc& camera);

/// Direction through the point (x, y) of the picture in pixels from its top left corner, scaled so
/// that its component along `forward` is 1: the eye plus d times it has view depth d.
Vec3 pixelRay(const CameraDesc& camera, const CameraAxes& axes, double x, double y, uint32_t width,
              uint32_t height);

/// Value of the depth buffer at a view depth in metres: near / depth; 0 is infinity.
inline double deviceDepth(const CameraDesc& camera, double viewDepth) {
  return camera.nearPlane / viewDepth;
}

/// The same camera for the API; `camera` keeps sType, structSize and next.
void fillCamera(const CameraDesc& desc, uint32_t width, uint32_t height, WlkCamera& camera);

}  // namespace host
