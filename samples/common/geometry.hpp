// SPDX-License-Identifier: MIT
// Opaque geometry simple enough to ray cast on the host: a terrain, spheres and boxes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/camera.hpp"
#include "common/image.hpp"
#include "common/vec.hpp"

namespace host {

struct TerrainInfo {
  /// Height of the highest mountains over sea level, in metres.
  double amplitude = 1200.0;
  /// Full edge of the square, in metres.
  double extent = 40000.0;
  /// Distance from one range to the next, in metres.
  double featureSize = 9000.0;
  /// Middle of the square; y is added to the heights.
  Vec3 centre;
  uint32_t seed = 1;
  /// Edge of the baked height field in cells.
  uint32_t resolution = 1024;
  Rgb albedo{0.10f, 0.13f, 0.06f};
  /// Where the slope is steep.
  Rgb rockAlbedo{0.16f, 0.14f, 0.12f};
  Rgb snowAlbedo{0.8f, 0.82f, 0.85f};
  /// Altitude over which snow lies, in metres.
  double snowLine = 1e9;
};

struct SphereInfo {
  Vec3 centre;
  double radius = 1.0;
  Rgb albedo{0.5f, 0.5f, 0.5f};
};

struct BoxInfo {
  /// Least corner, and edges along x, y and z, in metres.
  Vec3 min;
  Vec3 size{1.0, 1.0, 1.0};
  Rgb albedo{0.5f, 0.5f, 0.5f};
};

struct GeometryDesc {
  std::optional<TerrainInfo> terrain;
  std::vector<SphereInfo> spheres;
  std::vector<BoxInfo> boxes;
  /// Whether it shades itself, and by a shadow map the air.
  bool shadows = false;
};

/// Heights over the terrain's square, baked once and interpolated bilinearly.
class HeightField {
 public:
  /// The rim falls below the sea so that the square's edge never shows.
  explicit HeightField(const TerrainInfo& info);
  /// Height over sea level at a horizontal position relative to the centre; the rim's outside.
  [[nodiscard]] double height(double x, double z) const;
  /// Unit normal there.
  [[nodiscard]] Vec3 normal(double x, double z) const;
  [[nodiscard]] double lowest() const { return lowest_; }
  [[nodiscard]] double highest() const { return highest_; }

 private:
  double extent_;
  uint32_t resolution_;
  std::vector<float> heights_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
};

/// Light on the geometry: what a surface at an altitude receives.
struct SunLight {
  Vec3 direction;
  /// Irradiance facing the light, at evenly spaced altitudes from `lowest` to `highest`.
  std::vector<std::array<double, 3>> irradiance;
};
struct Illumination {
  double lowest = 0.0;
  double highest = 1.0;
  std::vector<SunLight> lights;
  /// Irradiance of the whole sky on a horizontal surface.
  std::array<double, 3> ambient{};
};

/// The sea-level sphere, to which the terrain clings.
struct PlanetShape {
  Vec3 seaLevelPoint;
  double radius = 6.371e6;
};

struct RasterResult {
  Image color;
  DepthImage depth;
};

/// Draws what the camera sees: reflected radiance albedo / pi (E max(cos, 0) + ambient part),
/// with shadows if `geometry` says so, and reversed depth; 0 and 0 where nothing is. Terrain under
/// sea level is left out: the planet's own ground shows there.
RasterResult rasterise(const GeometryDesc& geometry, const HeightField* field,
                       const PlanetShape& planet, const Illumination& light,
                       const CameraDesc& camera, uint32_t width, uint32_t height);

/// Distance to the nearest surface along a unit vector, farther than `nearest`; infinite if there
/// is none.
double castGeometry(const GeometryDesc& geometry, const HeightField* field,
                    const PlanetShape& planet, Vec3 origin, Vec3 direction, double nearest);

}  // namespace host
