// SPDX-License-Identifier: MIT
// A scene file in memory; docs/scene-format.md describes every key.
#pragma once

#include <welkin/welkin.h>

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/camera.hpp"
#include "common/cloud_mesh.hpp"
#include "common/geometry.hpp"
#include "common/image.hpp"
#include "common/json.hpp"
#include "common/volume.hpp"

namespace host {

struct MediumDesc {
  std::string name;
  /// Without the pointers to the table, which move with this structure.
  WlkMediumInfo info;
  /// For WLK_PARTICLE_USER: rad, and 3 values for each.
  std::vector<double> userAngle;
  std::vector<double> userPhase;
};

/// `info` with its pointers; valid as long as `medium` is neither changed nor moved.
WlkMediumInfo mediumInfo(const MediumDesc& medium);

/// What a mesh fills.
struct MeshInfo {
  MeshShape shape;
  uint32_t resolution = 128;
};

/// Where a grid comes from.
struct SourceDesc {
  /// Empty for generated data.
  std::filesystem::path file;
  std::variant<RawInfo, LesInfo, VdbInfo, CumulusInfo, SlabInfo, GradientInfo, MeshInfo> info;
};

/// Loads or makes the grid. Throws InputError.
Grid loadSource(const SourceDesc& source);

/// What to do to the place that the source's own coordinates give.
struct PlacementDesc {
  /// Fit the axis-aligned bounding box to [min, min + size] instead of scale and origin.
  bool box = false;
  Vec3 min;
  Vec3 size{1.0, 1.0, 1.0};
  double scale = 1.0;
  Vec3 origin;
  /// Turns about +y, then +x, then +z (of the turned axes), about the box's middle.
  Vec3 rotationDeg;
};

/// The source's map, moved. Throws nothing: a flat box gives a singular matrix, which the library
/// rejects.
Affine placeVolume(const Affine& natural, const PlacementDesc& placement);

/// The map from a mesh's own frame to the world, which moves its bounding box as a volume's.
Affine placeMesh(const CloudMesh& mesh, const PlacementDesc& placement);

struct FieldDesc {
  /// Index into Scene::media.
  size_t medium = 0;
  double extinctionScale = 1.0;
  SourceDesc source;
  /// Diameter of the droplets per voxel, um.
  std::optional<SourceDesc> diameters;
};

struct VolumeDesc {
  std::vector<FieldDesc> fields;
  PlacementDesc placement;
};

/// As WlkSurfaceDetail, m.
struct DetailDesc {
  double depth = 0;
  double size = 0;
  double softness = 0.3;
  Vec3 offset{};
};

struct SurfaceDesc {
  /// Index into Scene::media.
  size_t medium = 0;
  /// 1/m.
  double extinction = 0.05;
  MeshShape shape;
  PlacementDesc placement;
  DetailDesc detail;
};

enum class DepthKind { Device, View };

struct OpaqueFiles {
  std::filesystem::path color;
  std::filesystem::path depth;
  DepthKind kind = DepthKind::Device;
};

struct PngDesc {
  double exposureStops = 0.0;
  ToneMap toneMap = ToneMap::Filmic;
};

struct Scene {
  /// Name for messages.
  std::string file;
  WlkPlanet planet{};
  std::optional<WlkSky> sky;
  std::optional<WlkAbsorber> absorber;
  WlkAmbient ambient{};
  std::vector<WlkLight> lights;
  /// Without its medium, which exists in a context only.
  std::optional<WlkFog> fog;
  std::optional<MediumDesc> fogMedium;
  std::vector<MediumDesc> media;
  std::vector<VolumeDesc> volumes;
  /// Without those that are drawn as volumes.
  std::vector<SurfaceDesc> surfaces;
  WlkQuality quality{};
  WlkViewInfo view{};
  CameraDesc camera;
  std::optional<GeometryDesc> geometry;
  std::optional<OpaqueFiles> opaqueFiles;
  PngDesc png;
};

/// Reads a scene file, merges it over its `base` files (RFC 7386) and applies assignments.
Json readSceneJson(const std::string& file, const std::vector<std::string>& assignments);

/// Turns JSON into a scene; relative paths start at the folder of `file`, else where the program
/// runs. Ranges of the library's own values are left to the library. Throws InputError.
Scene parseScene(const Json& root, const std::string& file);

/// A medium as in `media`, and its words on their own; for the phase command too.
MediumDesc parseMedium(const JsonNode& node);
uint32_t parseParticle(const JsonNode& node);
uint32_t parsePhaseModel(const JsonNode& node);

/// Reads a table of angle_deg, red, green, blue: rows rising from 0 to 180 degrees, any unit >= 0.
void readUserPhase(const std::string& file, MediumDesc& medium);

/// Parts of parseScene, one file each. The world may name media: parse the volumes before it.
void parseWorld(const JsonNode& root, Scene& scene);
void parseVolumes(const JsonNode& root, Scene& scene);
/// After the volumes, to which it adds.
void parseSurfaces(const JsonNode& root, Scene& scene);
void parseView(const JsonNode& root, Scene& scene);
PlacementDesc parsePlacement(const JsonNode& node);
/// Three positive lengths, m.
Vec3 positiveVec3(const JsonNode& node);
/// The index of the medium of that name.
size_t findMedium(const JsonNode& node, const Scene& scene);
std::filesystem::path resolvePath(const JsonNode& node);

}  // namespace host
