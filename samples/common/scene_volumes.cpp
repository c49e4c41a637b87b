// SPDX-License-Identifier: MIT
// The sections media and volumes.
#include <algorithm>
#include <cmath>

#include "common/api.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/scene.hpp"
#include "common/slab.hpp"

namespace host {

Vec3 positiveVec3(const JsonNode& node) {
  const Vec3 value = node.vec3();
  if (!(std::min({value.x, value.y, value.z}) > 0.0)) {
    node.fail("expected three positive lengths in m");
  }
  return value;
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

size_t findMedium(const JsonNode& node, const Scene& scene) {
  const std::string name = node.text();
  const auto found = std::find_if(scene.media.begin(), scene.media.end(),
                                  [&](const MediumDesc& medium) { return medium.name == name; });
  if (found == scene.media.end()) {
    node.fail("expected the name of one of media");
  }
  return static_cast<size_t>(found - scene.media.begin());
}

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
  node.onlyKeys({"type", "file", "indexBase", "up", "quantity"});
  LesInfo info;
  if (node.has("quantity")) {
    info.diameters = node.at("quantity").word({"extinction", "diameter"}) == 1;
  }
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

GradientInfo parseGradient(const JsonNode& node) {
  node.onlyKeys({"type", "size", "axis", "from", "to"});
  GradientInfo info;
  info.size = parseSize(node.at("size"));
  info.axis = node.has("axis") ? node.at("axis").word({"x", "y", "z"}) : 0;
  node.optional("from", info.from, 1e-6, 65504.0);
  node.optional("to", info.to, 1e-6, 65504.0);
  return info;
}

SlabInfo parseSlab(const JsonNode& node) {
  node.onlyKeys({"type", "size", "extent", "edge", "noise", "noiseSize", "seed"});
  SlabInfo info;
  if (node.has("size")) {
    info.size = parseSize(node.at("size"));
  }
  if (node.has("extent")) {
    info.extent = positiveVec3(node.at("extent"));
  }
  if (node.has("edge")) {
    info.edge = node.at("edge").vec3();
    if (!(std::min({info.edge.x, info.edge.y, info.edge.z}) >= 0.0)) {
      node.at("edge").fail("expected three lengths >= 0 in m");
    }
  }
  node.optional("noise", info.noise, 0.0, 1.0);
  node.optional("noiseSize", info.noiseSize, 1e-3, 1e9);
  node.optional("seed", info.seed);
  return info;
}

SourceDesc parseSource(const JsonNode& node) {
  SourceDesc source;
  const uint32_t type = node.at("type").word({"raw", "les", "vdb", "cumulus", "slab", "gradient"});
  if (type >= 3) {
    if (type == 3) {
      source.info = parseCumulus(node);
    } else if (type == 4) {
      source.info = parseSlab(node);
    } else {
      source.info = parseGradient(node);
    }
    return source;
  }
  if (type == 0) {
    source.info = parseRaw(node);
  } else if (type == 1) {
    source.info = parseLes(node);
  } else {
    source.info = parseVdb(node);
  }
  source.file = resolvePath(node.at("file"));
  return source;
}

FieldDesc parseField(const JsonNode& node, const std::optional<SourceDesc>& shared,
                     const Scene& scene) {
  node.onlyKeys({"medium", "extinctionScale", "source", "diameters"});
  FieldDesc field;
  field.medium = findMedium(node.at("medium"), scene);
  node.optional("extinctionScale", field.extinctionScale, 0.0, 1e6);
  if (node.has("source")) {
    field.source = parseSource(node.at("source"));
  } else if (shared) {
    field.source = *shared;
  } else {
    node.fail("expected a source here or in the volume");
  }
  if (node.has("diameters")) {
    field.diameters = parseSource(node.at("diameters"));
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
  if (std::count_if(volume.fields.begin(), volume.fields.end(),
                    [](const FieldDesc& field) { return field.diameters.has_value(); }) > 1) {
    fields.fail("expected diameters for one field");
  }
  if (node.has("transform")) {
    volume.placement = parsePlacement(node.at("transform"));
  }
  return volume;
}

}  // namespace

WlkMediumInfo mediumInfo(const MediumDesc& medium) {
  WlkMediumInfo info = medium.info;
  if (!medium.userAngle.empty()) {
    info.userAngle = medium.userAngle.data();
    info.userPhase = medium.userPhase.data();
    info.userCount = static_cast<uint32_t>(medium.userAngle.size());
  }
  return info;
}

// The words stand in the order of the API's values.
uint32_t parseParticle(const JsonNode& node) {
  return node.word({"cloud", "fog", "haze", "rain", "ice-column", "ice-plate", "snow", "air",
                    "henyey-greenstein", "user"});
}

uint32_t parsePhaseModel(const JsonNode& node) {
  return node.word({"default", "analytic", "table"});
}

void readUserPhase(const std::string& file, MediumDesc& medium) {
  constexpr size_t MAX_ROWS = 65536;  // the API's bound
  const std::vector<std::string> columns = {"angle_deg", "red", "green", "blue"};
  const CsvTable table = readCsv(file, {columns});
  if (table.columns != columns) {
    throw InputError(file, "line 1", "expected the columns angle_deg,red,green,blue");
  }
  const size_t rows = table.rowCount();
  if (rows < 2 || rows > MAX_ROWS) {
    throw InputError(file, "", "expected 2 to 65536 rows, got " + std::to_string(rows));
  }
  if (table.at(0, 0) != 0.0) {
    table.fail(0, columns[0], "expected 0 degrees in the first row");
  }
  if (table.at(rows - 1, 0) != 180.0) {
    table.fail(rows - 1, columns[0], "expected 180 degrees in the last row");
  }
  for (size_t row = 0; row < rows; ++row) {
    if (row > 0 && !(table.at(row, 0) > table.at(row - 1, 0))) {
      table.fail(row, columns[0], "expected more degrees than in the row before");
    }
    // 180 degrees must give pi itself, not its neighbour: divide first.
    medium.userAngle.push_back(table.at(row, 0) / 180.0 * PI);
    for (int i = 1; i < 4; ++i) {
      const double value = table.at(row, i);
      if (!(value >= 0.0 && std::isfinite(value))) {
        table.fail(row, columns[static_cast<size_t>(i)], "expected a finite number >= 0");
      }
      medium.userPhase.push_back(value);
    }
  }
}

MediumDesc parseMedium(const JsonNode& node) {
  node.onlyKeys({"particle", "model", "diameter_um", "spread", "roughness", "asymmetry",
                 "singleScatteringAlbedo", "wavelength_um", "file"});
  MediumDesc medium{"", make<WlkMediumInfo>(), {}, {}};
  WlkMediumInfo& info = medium.info;
  if (node.has("particle")) {
    info.particle = parseParticle(node.at("particle"));
  }
  if (node.has("model")) {
    info.phaseModel = parsePhaseModel(node.at("model"));
  }
  node.optional("diameter_um", info.diameter_um);
  node.optional("spread", info.spread);
  node.optional("roughness", info.roughness);
  node.optional("asymmetry", info.asymmetry);
  node.optional("singleScatteringAlbedo", info.singleScatteringAlbedo);
  node.optional("wavelength_um", info.wavelength_um);
  if (node.has("file")) {
    readUserPhase(resolvePath(node.at("file")).string(), medium);
  }
  return medium;
}

void parseVolumes(const JsonNode& root, Scene& scene) {
  if (root.has("media")) {
    for (const auto& [name, node] : root.at("media").members()) {
      MediumDesc medium = parseMedium(node);
      const bool user = medium.info.particle == WLK_PARTICLE_USER;
      if (user && !node.has("file")) {
        node.fail("expected file, the table of particle user");
      }
      if (!user && node.has("file")) {
        node.at("file").fail("expected only with particle user");
      }
      medium.name = name;
      scene.media.push_back(std::move(medium));
    }
  }
  if (root.has("volumes")) {
    for (const JsonNode& node : root.at("volumes").elements()) {
      scene.volumes.push_back(parseVolume(node, scene));
    }
  }
}

Grid makeGradient(const GradientInfo& info) {
  Grid grid;
  grid.size = info.size;
  grid.values.resize(checkedVoxelCount("gradient", {info.size[0], info.size[1], info.size[2]}));
  grid.worldFromVolume = affineFromEdges({}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  const size_t n = info.size[info.axis];
  const size_t step = info.axis == 0   ? 1
                      : info.axis == 1 ? size_t{info.size[0]}
                                       : size_t{info.size[0]} * info.size[1];
  for (size_t i = 0; i < grid.values.size(); ++i) {
    const double t = n == 1 ? 0.0 : static_cast<double>(i / step % n) / static_cast<double>(n - 1);
    grid.values[i] = static_cast<float>(info.from * std::pow(info.to / info.from, t));
  }
  return grid;
}

Grid loadSource(const SourceDesc& source) {
  struct Loader {
    const std::filesystem::path& file;
    Grid operator()(const RawInfo& info) const { return loadRaw(file, info); }
    Grid operator()(const LesInfo& info) const { return loadLes(file, info); }
    Grid operator()(const VdbInfo& info) const { return loadVdb(file, info); }
    Grid operator()(const CumulusInfo& info) const { return makeCumulus(info); }
    Grid operator()(const SlabInfo& info) const { return makeSlab(info); }
    Grid operator()(const GradientInfo& info) const { return makeGradient(info); }
    Grid operator()(const MeshInfo& info) const {
      return voxelise(makeMesh(info.shape), info.resolution);
    }
  };
  return std::visit(Loader{source.file}, source.info);
}

}  // namespace host
