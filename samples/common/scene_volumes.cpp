// SPDX-License-Identifier: MIT
// The sections media and volumes, and where a volume ends up in the world.
#include <algorithm>
#include <limits>

#include "common/api.hpp"
#include "common/scene.hpp"

namespace host {
namespace {

UpAxis parseUp(const JsonNode& node, UpAxis preset) {
  if (!node.has("up")) {
    return preset;
  }
  return node.at("up").word({"y", "z"}) == 0 ? UpAxis::Y : UpAxis::Z;
}

std::array<uint32_t, 3> parseSize(const JsonNode& node) {
  const std::vector<JsonNode> edges = node.elements();
  if (edges.size() != 3) {
    node.fail("expected [nx, ny, nz]");
  }
  return {edges[0].count(1, 1u << 20), edges[1].count(1, 1u << 20), edges[2].count(1, 1u << 20)};
}

Vec3 positiveVec3(const JsonNode& node) {
  const Vec3 value = node.vec3();
  if (!(std::min({value.x, value.y, value.z}) > 0.0)) {
    node.fail("expected three positive lengths in m");
  }
  return value;
}

RawInfo parseRaw(const JsonNode& node) {
  node.onlyKeys({"type", "file", "size", "format", "voxelSize", "up"});
  RawInfo info;
  info.size = parseSize(node.at("size"));
  if (node.has("format")) {
    constexpr std::array<RawFormat, 3> FORMATS = {RawFormat::R32Float, RawFormat::R16Float,
                                                  RawFormat::R8Unorm};
    info.format = FORMATS[node.at("format").word({"r32f", "r16f", "r8"})];
  }
  if (node.has("voxelSize")) {
    info.voxelSize = positiveVec3(node.at("voxelSize"));
  }
  info.up = parseUp(node, info.up);
  return info;
}

LesInfo parseLes(const JsonNode& node) {
  node.onlyKeys({"type", "file", "indexBase", "up"});
  LesInfo info;
  if (node.has("indexBase")) {
    info.indexBase = static_cast<int>(node.at("indexBase").count(0, 1));
  }
  info.up = parseUp(node, info.up);
  return info;
}

VdbInfo parseVdb(const JsonNode& node) {
  node.onlyKeys({"type", "file", "grid", "up"});
  VdbInfo info;
  if (node.has("grid")) {
    info.grid = node.at("grid").text();
  }
  info.up = parseUp(node, info.up);
  return info;
}

CumulusInfo parseCumulus(const JsonNode& node) {
  node.onlyKeys({"type", "size", "seed", "extent", "puffScale"});
  CumulusInfo info;
  if (node.has("size")) {
    info.size = parseSize(node.at("size"));
  }
  node.optional("seed", info.seed);
  if (node.has("extent")) {
    info.extent = positiveVec3(node.at("extent"));
  }
  node.optional("puffScale", info.puffScale, 0.3, 3.0);
  return info;
}

SourceDesc parseSource(const JsonNode& node) {
  SourceDesc source;
  const uint32_t type = node.at("type").word({"raw", "les", "vdb", "cumulus"});
  if (type == 0) {
    source.info = parseRaw(node);
  } else if (type == 1) {
    source.info = parseLes(node);
  } else if (type == 2) {
    source.info = parseVdb(node);
  } else {
    source.info = parseCumulus(node);
    return source;
  }
  source.file = resolvePath(node.at("file"));
  return source;
}

PlacementDesc parsePlacement(const JsonNode& node) {
  node.onlyKeys({"min", "size", "origin", "scale", "rotation_deg"});
  PlacementDesc placement;
  placement.box = node.has("min") || node.has("size");
  if (placement.box) {
    if (node.has("origin") || node.has("scale")) {
      node.fail("expected min and size, or origin and scale, not both");
    }
    placement.min = node.at("min").vec3();
    placement.size = positiveVec3(node.at("size"));
  }
  node.optional("origin", placement.origin);
  node.optional("scale", placement.scale, 1e-6, 1e6);
  node.optional("rotation_deg", placement.rotationDeg);
  return placement;
}

FieldDesc parseField(const JsonNode& node, const std::optional<SourceDesc>& shared,
                     const Scene& scene) {
  node.onlyKeys({"medium", "extinctionScale", "source"});
  FieldDesc field;
  const std::string name = node.at("medium").text();
  const auto found = std::find_if(scene.media.begin(), scene.media.end(),
                                  [&](const MediumDesc& medium) { return medium.name == name; });
  if (found == scene.media.end()) {
    node.at("medium").fail("expected the name of one of media");
  }
  field.medium = static_cast<size_t>(found - scene.media.begin());
  node.optional("extinctionScale", field.extinctionScale, 0.0, 1e6);
  if (node.has("source")) {
    field.source = parseSource(node.at("source"));
  } else if (shared) {
    field.source = *shared;
  } else {
    node.fail("expected a source here or in the volume");
  }
  return field;
}

VolumeDesc parseVolume(const JsonNode& node, const Scene& scene) {
  node.onlyKeys({"source", "fields", "transform"});
  VolumeDesc volume;
  std::optional<SourceDesc> shared;
  if (node.has("source")) {
    shared = parseSource(node.at("source"));
  }
  const JsonNode fields = node.at("fields");
  for (const JsonNode& field : fields.elements()) {
    volume.fields.push_back(parseField(field, shared, scene));
  }
  if (volume.fields.empty() || volume.fields.size() > WLK_MAX_FIELDS) {
    fields.fail("expected 1 to 4 fields");
  }
  if (node.has("transform")) {
    volume.placement = parsePlacement(node.at("transform"));
  }
  return volume;
}

}  // namespace

WlkMediumInfo parseMedium(const JsonNode& node) {
  node.onlyKeys({"phase", "dropletDiameter_um", "asymmetry", "singleScatteringAlbedo"});
  auto info = make<WlkMediumInfo>();
  if (node.has("phase")) {
    constexpr std::array<uint32_t, 3> PHASES = {WLK_PHASE_HG_DRAINE, WLK_PHASE_HENYEY_GREENSTEIN,
                                                WLK_PHASE_RAYLEIGH};
    info.phase = PHASES[node.at("phase").word({"hg-draine", "hg", "rayleigh"})];
  }
  node.optional("dropletDiameter_um", info.dropletDiameter_um);
  node.optional("asymmetry", info.asymmetry);
  node.optional("singleScatteringAlbedo", info.singleScatteringAlbedo);
  return info;
}

void parseVolumes(const JsonNode& root, Scene& scene) {
  if (root.has("media")) {
    for (const auto& [name, node] : root.at("media").members()) {
      scene.media.push_back({name, parseMedium(node)});
    }
  }
  if (root.has("volumes")) {
    for (const JsonNode& node : root.at("volumes").elements()) {
      scene.volumes.push_back(parseVolume(node, scene));
    }
  }
}

Grid loadSource(const SourceDesc& source) {
  struct Loader {
    const std::filesystem::path& file;
    Grid operator()(const RawInfo& info) const { return loadRaw(file, info); }
    Grid operator()(const LesInfo& info) const { return loadLes(file, info); }
    Grid operator()(const VdbInfo& info) const { return loadVdb(file, info); }
    Grid operator()(const CumulusInfo& info) const { return makeCumulus(info); }
  };
  return std::visit(Loader{source.file}, source.info);
}

}  // namespace host
