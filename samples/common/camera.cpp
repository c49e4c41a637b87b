// SPDX-License-Identifier: MIT
#include "common/camera.hpp"

#include <algorithm>
#include <array>

namespace host {
namespace {

double tangentOfHalfFov(const CameraDesc& camera) {
  return std::tan(0.5 * camera.verticalFovDeg * RADIANS_PER_DEGREE);
}

}  // namespace

CameraAxes cameraAxes(const CameraDesc& camera) {
  // Straight up or down there is no horizon to align with: north becomes the top of the picture.
  const bool vertical = std::abs(camera.forward.y) > 1.0 - 1e-9;
  const Vec3 top = vertical ? Vec3{0.0, 0.0, -1.0} : Vec3{0.0, 1.0, 0.0};
  CameraAxes axes;
  axes.forward = camera.forward;
  axes.right = normalize(cross(camera.forward, top));
  axes.up = cross(axes.right, camera.forward);
  return axes;
}

Vec3 pixelRay(const CameraDesc& camera, const CameraAxes& axes, double x, double y, uint32_t width,
              uint32_t height) {
  // Square pixels: one pixel spans the same angle both ways.
  const double perPixel = 2.0 * tangentOfHalfFov(camera) / height;
  return axes.forward + axes.right * ((x - 0.5 * width) * perPixel) +
         axes.up * ((0.5 * height - y) * perPixel);
}

void fillCamera(const CameraDesc& desc, uint32_t width, uint32_t height, WlkCamera& camera) {
  const CameraAxes axes = cameraAxes(desc);
  camera.position[0] = desc.position.x;
  camera.position[1] = desc.position.y;
  camera.position[2] = desc.position.z;
  // Column-major: row i of the rotation is an axis of the view.
  const std::array<Vec3, 3> rows = {axes.right, axes.up, axes.forward * -1.0};
  for (size_t row = 0; row < 3; ++row) {
    camera.viewFromWorld[0 + row] = static_cast<float>(rows[row].x);
    camera.viewFromWorld[3 + row] = static_cast<float>(rows[row].y);
    camera.viewFromWorld[6 + row] = static_cast<float>(rows[row].z);
  }
  camera.preExposure = static_cast<float>(desc.preExposure);
  const double tangent = tangentOfHalfFov(desc);
  const double aspect = static_cast<double>(width) / height;
  std::fill(std::begin(camera.clipFromView), std::end(camera.clipFromView), 0.0f);
  camera.clipFromView[0] = static_cast<float>(1.0 / (aspect * tangent));
  camera.clipFromView[5] = static_cast<float>(-1.0 / tangent);  // Vulkan's clip space has y down
  camera.clipFromView[11] = -1.0f;
  camera.clipFromView[14] = static_cast<float>(desc.nearPlane);
}

}  // namespace host
