// SPDX-License-Identifier: MIT
// The sections quality, view, camera, opaque, png.
#include "common/api.hpp"
#include "common/scene.hpp"

namespace host {
namespace {

WlkQuality parseQuality(const JsonNode& node) {
  node.onlyKeys({"level", "sliceCount", "batchSize", "lightBufferSize", "slicing", "scattering",
                 "volumeCells", "volumeResolution", "lightFrames", "noSkip", "volumeShadows"});
  auto quality = make<WlkQuality>();
  // The words stand in the order of the API's values.
  if (node.has("level")) {
    quality.level = node.at("level").word({"low", "medium", "high", "ultra"});
  }
  node.optional("sliceCount", quality.sliceCount);
  node.optional("batchSize", quality.batchSize);
  node.optional("lightBufferSize", quality.lightBufferSize);
  node.optional("volumeCells", quality.volumeCells);
  node.optional("lightFrames", quality.lightFrames);
  if (node.has("volumeResolution")) {
    quality.volumeResolution = node.at("volumeResolution").word({"default", "full", "half"});
  }
  if (node.has("slicing")) {
    quality.slicing = node.at("slicing").word({"default", "half-angle", "light-aligned"});
  }
  if (node.has("scattering")) {
    quality.scattering =
        node.at("scattering")
            .word({"default", "single", "forward", "forward-integer", "all-orders"});
  }
  if (node.has("noSkip") && node.at("noSkip").boolean()) {
    quality.flags |= WLK_QUALITY_FLAG_NO_SKIP;
  }
  if (node.has("volumeShadows") && node.at("volumeShadows").boolean()) {
    quality.flags |= WLK_QUALITY_FLAG_VOLUME_SHADOWS;
  }
  return quality;
}

WlkViewInfo parseViewInfo(const JsonNode& node) {
  node.onlyKeys({"size", "layers", "composite", "color"});
  auto view = make<WlkViewInfo>();
  if (node.has("size")) {
    const std::vector<JsonNode> edges = node.at("size").elements();
    if (edges.size() != 2) {
      node.at("size").fail("expected [width, height]");
    }
    view.width = edges[0].count(1, MAX_IMAGE_EDGE);
    view.height = edges[1].count(1, MAX_IMAGE_EDGE);
  }
  if (node.has("layers")) {
    view.layers = 0;
    constexpr std::array<uint64_t, 7> LAYERS = {
        WLK_LAYER_SKY,    WLK_LAYER_FOG, WLK_LAYER_VOLUMES, WLK_LAYER_SUN_DISK,
        WLK_LAYER_GROUND, WLK_LAYER_ALL, WLK_LAYER_SURFACES};
    for (const JsonNode& layer : node.at("layers").elements()) {
      view.layers |=
          LAYERS[layer.word({"sky", "fog", "volumes", "sunDisk", "ground", "all", "surfaces"})];
    }
  }
  if (node.has("composite")) {
    view.composite = node.at("composite").word({"compute", "separate"}) == 0
                         ? uint32_t{WLK_COMPOSITE_COMPUTE}
                         : uint32_t{WLK_COMPOSITE_SEPARATE};
  }
  if (node.has("color")) {
    view.colorSpace = node.at("color").word({"wavelengths", "srgb"}) == 0
                          ? uint32_t{WLK_COLOR_WAVELENGTHS}
                          : uint32_t{WLK_COLOR_LINEAR_SRGB};
  }
  return view;
}

CameraDesc parseCamera(const JsonNode& node) {
  node.onlyKeys(
      {"position", "target", "yaw_deg", "pitch_deg", "verticalFov_deg", "near", "preExposure"});
  CameraDesc camera;
  node.optional("position", camera.position);
  if (node.has("target")) {
    if (node.has("yaw_deg") || node.has("pitch_deg")) {
      node.fail("expected target, or yaw_deg and pitch_deg, not both");
    }
    const Vec3 to = node.at("target").vec3() - camera.position;
    if (!(length(to) > 0.0)) {
      node.at("target").fail("expected a point away from camera.position");
    }
    camera.forward = normalize(to);
  } else {
    double yaw = 0.0;
    double pitch = 0.0;
    node.optional("yaw_deg", yaw, -1e6, 1e6);
    node.optional("pitch_deg", pitch, -90.0, 90.0);
    camera.forward = directionFromAngles(pitch, yaw);
  }
  node.optional("verticalFov_deg", camera.verticalFovDeg, 0.1, 170.0);
  node.optional("near", camera.nearPlane, 1e-3, 1e3);
  node.optional("preExposure", camera.preExposure, 1e-9, 1e9);
  return camera;
}

TerrainInfo parseTerrain(const JsonNode& node) {
  node.onlyKeys({"type", "amplitude", "extent", "featureSize", "centre", "seed", "resolution",
                 "albedo", "rockAlbedo", "snowAlbedo", "snowLine"});
  TerrainInfo info;
  node.optional("amplitude", info.amplitude, 0.0, 1e5);
  node.optional("extent", info.extent, 1.0, 1e6);
  node.optional("featureSize", info.featureSize, 1.0, 1e6);
  node.optional("centre", info.centre);
  node.optional("seed", info.seed);
  if (node.has("resolution")) {
    info.resolution = node.at("resolution").count(2, 8192);
  }
  node.optional("albedo", info.albedo, 0.0, 1.0);
  node.optional("rockAlbedo", info.rockAlbedo, 0.0, 1.0);
  node.optional("snowAlbedo", info.snowAlbedo, 0.0, 1.0);
  node.optional("snowLine", info.snowLine, -1e9, 1e9);
  return info;
}

SphereInfo parseSphere(const JsonNode& node) {
  node.onlyKeys({"type", "centre", "radius", "albedo"});
  SphereInfo info;
  info.centre = node.at("centre").vec3();
  node.optional("radius", info.radius, 1e-3, 1e7);
  node.optional("albedo", info.albedo, 0.0, 1.0);
  return info;
}

BoxInfo parseBox(const JsonNode& node) {
  node.onlyKeys({"type", "min", "size", "albedo"});
  BoxInfo info;
  info.min = node.at("min").vec3();
  info.size = node.at("size").vec3();
  if (!(info.size.x > 0.0 && info.size.y > 0.0 && info.size.z > 0.0)) {
    node.at("size").fail("expected edges > 0");
  }
  node.optional("albedo", info.albedo, 0.0, 1.0);
  return info;
}

void parseOpaque(const JsonNode& node, Scene& scene) {
  node.onlyKeys({"color", "depth", "depthKind", "geometry", "shadows"});
  if (node.has("geometry")) {
    if (node.has("color") || node.has("depth")) {
      node.fail("expected color and depth, or geometry, not both");
    }
    scene.geometry.emplace();
    for (const JsonNode& item : node.at("geometry").elements()) {
      const uint32_t type = item.at("type").word({"terrain", "sphere", "box"});
      if (type == 1) {
        scene.geometry->spheres.push_back(parseSphere(item));
      } else if (type == 2) {
        scene.geometry->boxes.push_back(parseBox(item));
      } else if (scene.geometry->terrain) {
        item.fail("expected at most one terrain");
      } else {
        scene.geometry->terrain = parseTerrain(item);
      }
    }
    if (node.has("shadows") && node.at("shadows").boolean()) {
      scene.geometry->shadows = true;
      scene.quality.flags |= WLK_QUALITY_FLAG_LIGHT_SHADOWS;
    }
    return;
  }
  if (node.has("shadows")) {
    node.at("shadows").fail("expected geometry, which casts them");
  }
  OpaqueFiles files;
  files.color = resolvePath(node.at("color"));
  files.depth = resolvePath(node.at("depth"));
  if (node.has("depthKind") && node.at("depthKind").word({"device", "view"}) == 1) {
    files.kind = DepthKind::View;
  }
  scene.opaqueFiles = files;
}

}  // namespace

void parseView(const JsonNode& root, Scene& scene) {
  scene.quality = root.has("quality") ? parseQuality(root.at("quality")) : make<WlkQuality>();
  scene.view = root.has("view") ? parseViewInfo(root.at("view")) : make<WlkViewInfo>();
  scene.view.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  if (root.has("camera")) {
    scene.camera = parseCamera(root.at("camera"));
  }
  if (root.has("opaque")) {
    parseOpaque(root.at("opaque"), scene);
  }
  if (root.has("png")) {
    const JsonNode png = root.at("png");
    png.onlyKeys({"exposure_stops", "toneMap"});
    png.optional("exposure_stops", scene.png.exposureStops, -60.0, 60.0);
    if (png.has("toneMap") && png.at("toneMap").word({"linear", "filmic"}) == 0) {
      scene.png.toneMap = ToneMap::Linear;
    }
  }
}

}  // namespace host
