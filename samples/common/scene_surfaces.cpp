// SPDX-License-Identifier: MIT
// The section surfaces.
#include <utility>

#include "common/error.hpp"
#include "common/scene.hpp"

namespace host {
namespace {

constexpr double MAX_LENGTH = 1e6;  // m

void optionalCount(const JsonNode& node, const char* key, uint32_t& target, uint32_t low,
                   uint32_t high) {
  if (node.has(key)) {
    target = node.at(key).count(low, high);
  }
}

void optionalExtent(const JsonNode& node, Vec3& target) {
  if (node.has("extent")) {
    target = positiveVec3(node.at("extent"));
    if (!(target.x <= MAX_LENGTH && target.y <= MAX_LENGTH && target.z <= MAX_LENGTH)) {
      node.at("extent").fail("expected three lengths of at most 1e6 m");
    }
  }
}

SphereMesh parseSphere(const JsonNode& node) {
  node.onlyKeys({"radius", "subdivisions"});
  SphereMesh shape;
  node.optional("radius", shape.radius, 1e-3, MAX_LENGTH);
  optionalCount(node, "subdivisions", shape.subdivisions, 1, 9);
  return shape;
}

BoxMesh parseBox(const JsonNode& node) {
  node.onlyKeys({"extent", "cells"});
  BoxMesh shape;
  optionalExtent(node, shape.extent);
  if (node.has("cells")) {
    const std::vector<JsonNode> cells = node.at("cells").elements();
    if (cells.size() != 3) {
      node.at("cells").fail("expected [nx, ny, nz]");
    }
    shape.cells = {cells[0].count(1, 512), cells[1].count(1, 512), cells[2].count(1, 512)};
  }
  return shape;
}

StratocumulusMesh parseStratocumulus(const JsonNode& node) {
  node.onlyKeys({"extent", "cells", "bumpSize", "relief", "seed"});
  StratocumulusMesh shape;
  optionalExtent(node, shape.extent);
  optionalCount(node, "cells", shape.cells, 4, 1024);
  node.optional("bumpSize", shape.bumpSize, 1.0, MAX_LENGTH);
  node.optional("relief", shape.relief, 0.0, 0.95);
  node.optional("seed", shape.seed);
  return shape;
}

CumulusMesh parseCumulus(const JsonNode& node) {
  node.onlyKeys({"extent", "lobes", "billows", "detail", "seed"});
  CumulusMesh shape;
  optionalExtent(node, shape.extent);
  optionalCount(node, "lobes", shape.lobes, 1, 64);
  node.optional("billows", shape.billows, 0.0, 0.4);
  optionalCount(node, "detail", shape.detail, 8, 256);
  node.optional("seed", shape.seed);
  return shape;
}

MeshShape parseMesh(const JsonNode& node) {
  node.onlyKeys({"sphere", "box", "stratocumulus", "cumulus", "file"});
  const auto members = node.members();
  if (members.size() != 1) {
    node.fail("expected one of sphere, box, stratocumulus, cumulus, file");
  }
  const auto& [name, shape] = members.front();
  if (name == "sphere") {
    return parseSphere(shape);
  }
  if (name == "box") {
    return parseBox(shape);
  }
  if (name == "stratocumulus") {
    return parseStratocumulus(shape);
  }
  if (name == "file") {
    return MeshFile{resolvePath(shape)};
  }
  return parseCumulus(shape);
}

DetailDesc parseDetail(const JsonNode& node) {
  node.onlyKeys({"depth", "size", "softness", "offset"});
  DetailDesc detail;
  node.optional("depth", detail.depth, 0.0, 1e6);
  node.optional("size", detail.size, 0.0, 1e6);
  node.optional("softness", detail.softness, 0.05, 1.0);
  node.optional("offset", detail.offset);
  return detail;
}

void parseSurface(const JsonNode& node, Scene& scene) {
  node.onlyKeys(
      {"mesh", "medium", "extinction", "transform", "time", "as", "resolution", "detail"});
  SurfaceDesc surface;
  surface.medium = findMedium(node.at("medium"), scene);
  node.optional("extinction", surface.extinction, 0.0, 1e6);
  surface.shape = parseMesh(node.at("mesh"));
  if (node.has("transform")) {
    surface.placement = parsePlacement(node.at("transform"));
  }
  if (node.has("time")) {
    auto* sheet = std::get_if<StratocumulusMesh>(&surface.shape);
    if (sheet == nullptr) {
      node.at("time").fail("expected only with a stratocumulus");
    }
    sheet->time = node.at("time").number(0.0, 1e6);
  }
  if (node.has("detail")) {
    surface.detail = parseDetail(node.at("detail"));
  }
  const bool volume = node.has("as") && node.at("as").word({"surface", "volume"}) == 1;
  if (!volume) {
    if (node.has("resolution")) {
      node.at("resolution").fail("expected only with \"as\": \"volume\"");
    }
    scene.surfaces.push_back(std::move(surface));
    return;
  }
  MeshInfo voxels{std::move(surface.shape)};
  optionalCount(node, "resolution", voxels.resolution, 8, 512);
  FieldDesc field;
  field.medium = surface.medium;
  field.extinctionScale = surface.extinction;
  field.source.info = std::move(voxels);
  scene.volumes.push_back({{std::move(field)}, surface.placement});
}

}  // namespace

void parseSurfaces(const JsonNode& root, Scene& scene) {
  if (root.has("surfaces")) {
    for (const JsonNode& node : root.at("surfaces").elements()) {
      parseSurface(node, scene);
    }
  }
}

}  // namespace host
