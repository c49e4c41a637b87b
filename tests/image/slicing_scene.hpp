// SPDX-License-Identifier: MIT
// The scene of the image tests of the volumes: square pictures of radiance and transmittance, a
// camera whose rays the reference can march, volumes from the reference's fields.
#pragma once

#include <welkin/welkin.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "reference/raymarch.hpp"
#include "support/headless_scene.hpp"

namespace image_test {

using welkin::reference::MarchResult;
using welkin::reference::Point;
using welkin::reference::RayMarch;
using welkin::reference::VoxelField;

Point operator+(const Point& a, const Point& b);
Point operator-(const Point& a, const Point& b);
Point operator*(double s, const Point& a);
double dot(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
Point normalized(const Point& a);
Point turned(const Point& p, const Point& axis, double angle);  // by Rodrigues' formula

constexpr double DEGREE = 0.017453292519943295;
constexpr double NEAR_PLANE = 0.1;  // m

struct Camera {
  Point position{0, 0, 0};
  Point forward{0, 0, -1};
  Point up{0, 1, 0};
  double tangent = 0.5;  // of half the field of view

  Point right() const { return normalized(cross(forward, up)); }
  // Direction through the middle of a pixel, row 0 on top.
  Point ray(int x, int y, int size) const;
  // Value of the depth buffer (infinite, reversed) for a surface at a distance along that ray.
  float depthAt(int x, int y, int size, double distance) const;
};

struct Quality {
  uint32_t slicing = WLK_SLICING_DEFAULT;
  uint32_t scattering = WLK_SCATTERING_SINGLE;
  uint32_t slices = 128;
  uint32_t batch = 0;
  uint32_t lightSize = 256;
  uint32_t level = WLK_QUALITY_HIGH;
  uint32_t resolution = WLK_VOLUME_RESOLUTION_FULL;
  uint32_t cells = 0;  // 0: the level's
};

// Square image: premultiplied radiance and transmittance, RGB.
struct Picture {
  int size = 0;
  std::vector<std::array<double, 3>> radiance;
  std::vector<std::array<double, 3>> transmittance;
  uint64_t nonFinite = 0;
  double eye_ms = 0;  // GPU time of the passes
  double light_ms = 0;

  std::vector<double> red() const;
};

class SlicingScene {
 public:
  explicit SlicingScene(int size, bool validation = false);

  WlkMedium henyeyGreenstein(double g) { return scene_.addHenyeyGreenstein(static_cast<float>(g)); }
  // A volume of `fields`, all of one size and place, with the medium of each.
  WlkVolume addVolume(const std::vector<VoxelField>& fields, const std::vector<WlkMedium>& media);
  WlkVolume addVolume(const VoxelField& field, WlkMedium medium);
  void removeVolume(WlkVolume volume);
  void setLight(const Point& direction);  // irradiance 1
  void setCamera(const Camera& camera);
  void setQuality(const Quality& quality);
  void setSky(bool on);
  void setFog(double extinction);  // 1/m at altitude 0; 0: none

  // Renders; `depth` has size * size values or is empty.
  Picture render(const std::vector<float>& depth = {});

  WlkContext context() const { return scene_.context; }
  WlkFrameStats stats() const { return scene_.stats(); }
  const std::vector<std::string>& messages() const { return scene_.messages(); }

 private:
  welkin::test::HeadlessScene scene_;
  int size_;
};

// A field of `values` on a cube of edge `edge` m around a centre, `scale` 1/m at value 1.
VoxelField cubeField(int n, const std::vector<float>& values, double scale, double edge,
                     const Point& centre);

// Root mean square of a - b over the mean of b.
double relativeRms(const std::vector<double>& a, const std::vector<double>& b);
double mean(const std::vector<double>& a);

// Runs task(0) ... task(count - 1) on the machine's threads.
void parallelFor(int count, const std::function<void(int)>& task);

// Single scattering of a Henyey-Greenstein medium by ray march. `lengths`: where each ray ends.
std::vector<double> marchPicture(const RayMarch& march, const Camera& camera, int size,
                                 const Point& toLight, double g, int refinement = 1,
                                 const std::vector<double>& lengths = {});

}  // namespace image_test
