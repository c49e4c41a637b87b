// SPDX-License-Identifier: MIT
#include "common/apply.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace host {
namespace {

void uploadField(WlkContext context, const Scene& scene, WlkVolume volume, uint32_t field,
                 const Grid& grid, const std::string& key) {
  auto upload = make<WlkVolumeUpload>();
  upload.field = field;
  upload.format = WLK_FORMAT_R32_FLOAT;
  std::copy(grid.size.begin(), grid.size.end(), upload.extent);
  upload.data = grid.values.data();
  upload.dataSize = grid.values.size() * sizeof(float);
  check(wlkUploadVolume(context, volume, &upload), scene.file, key);
}

void uploadDiameters(WlkContext context, const Scene& scene, WlkVolume volume, uint32_t field,
                     const Grid& grid, const std::string& key) {
  auto upload = make<WlkVolumeUpload>();
  upload.field = field;
  upload.format = WLK_FORMAT_R32_FLOAT;
  std::copy(grid.size.begin(), grid.size.end(), upload.extent);
  upload.data = grid.values.data();
  upload.dataSize = grid.values.size() * sizeof(float);
  check(wlkUploadVolumeDiameters(context, volume, &upload), scene.file, key + ".diameters");
}

// Voxels of bricks; 0 where there is none.
Grid denseOf(const BrickField& field, const std::array<uint32_t, 3>& size) {
  constexpr uint32_t EDGE = 8;
  constexpr size_t VOXELS = size_t{EDGE} * EDGE * EDGE;
  Grid grid;
  grid.size = size;
  grid.values.assign(checkedVoxelCount("diameters", {size[0], size[1], size[2]}), 0.0f);
  for (size_t i = 0; i < field.values.size(); ++i) {
    const uint32_t* brick = &field.coordinates[3 * (i / VOXELS)];
    const auto inside = static_cast<uint32_t>(i % VOXELS);
    const std::array<uint32_t, 3> at{EDGE * brick[0] + inside % EDGE,
                                     EDGE * brick[1] + inside / EDGE % EDGE,
                                     EDGE * brick[2] + inside / EDGE / EDGE};
    if (at[0] < size[0] && at[1] < size[1] && at[2] < size[2]) {
      grid.values[at[0] + size[0] * (at[1] + size_t{size[1]} * at[2])] = field.values[i];
    }
  }
  return grid;
}

void applyFog(WlkContext context, const Scene& scene) {
  if (!scene.fog || !scene.fogMedium) {
    check(wlkSetFog(context, scene.fog ? &*scene.fog : nullptr), scene.file, "fog");
    return;
  }
  const WlkMediumInfo info = mediumInfo(*scene.fogMedium);
  WlkFog fog = *scene.fog;
  check(wlkCreateMedium(context, &info, &fog.medium), scene.file, "media." + scene.fogMedium->name);
  const WlkResult result = wlkSetFog(context, &fog);
  // The layer has a copy of the phase function. Destroying cannot fail, and keeps the last error.
  static_cast<void>(wlkDestroyMedium(context, fog.medium));
  check(result, scene.file, "fog");
}

WlkVolume createVolume(WlkContext context, const Scene& scene, size_t index,
                       const std::vector<WlkMedium>& media, const std::array<uint32_t, 3>& size,
                       const Affine& place) {
  std::vector<WlkVolumeField> fields;
  for (const FieldDesc& field : scene.volumes[index].fields) {
    fields.push_back({media[field.medium], static_cast<float>(field.extinctionScale), 0});
  }
  auto info = make<WlkVolumeInfo>();
  std::copy(size.begin(), size.end(), info.size);
  info.fieldCount = static_cast<uint32_t>(fields.size());
  info.fieldStride = sizeof(WlkVolumeField);
  info.fields = fields.data();
  std::copy(place.begin(), place.end(), info.worldFromVolume);
  WlkVolume volume{};
  check(wlkCreateVolume(context, &info, &volume), scene.file, "volumes." + std::to_string(index));
  return volume;
}

// Whether all fields are grids of OpenVDB, whose bricks need not become voxels.
bool sparse(const VolumeDesc& desc) {
  return std::all_of(desc.fields.begin(), desc.fields.end(), [](const FieldDesc& field) {
    return std::holds_alternative<VdbInfo>(field.source.info);
  });
}

void applyBricks(WlkContext context, const Scene& scene, size_t index,
                 const std::vector<WlkMedium>& media) {
  const VolumeDesc& desc = scene.volumes[index];
  std::vector<VdbSource> sources;
  for (const FieldDesc& field : desc.fields) {
    sources.push_back({field.source.file, std::get<VdbInfo>(field.source.info)});
  }
  const std::string key = "volumes." + std::to_string(index) + ".fields.";
  for (uint32_t i = 0; i < desc.fields.size(); ++i) {
    if (desc.fields[i].diameters) {
      const SourceDesc& source = *desc.fields[i].diameters;
      if (!std::holds_alternative<VdbInfo>(source.info)) {
        throw InputError(scene.file, key + std::to_string(i) + ".diameters",
                         "expected a grid of OpenVDB as the fields are");
      }
      sources.push_back({source.file, std::get<VdbInfo>(source.info)});
    }
  }
  const BrickVolume bricks = loadVdbBricks(sources);
  // The scene places the active voxels; the volume reaches to whole bricks.
  const Affine place = placeVolume(bricks.worldFromActive, desc.placement);
  const auto moved = [&](Vec3 p) {
    return transformPoint(place, transformPoint(bricks.activeFromVolume, p));
  };
  const Vec3 origin = moved({});
  const WlkVolume volume = createVolume(
      context, scene, index, media, bricks.size,
      affineFromEdges(origin, moved({1.0, 0.0, 0.0}) - origin, moved({0.0, 1.0, 0.0}) - origin,
                      moved({0.0, 0.0, 1.0}) - origin));
  for (uint32_t i = 0; i < desc.fields.size(); ++i) {
    const BrickField& field = bricks.fields[i];
    auto upload = make<WlkVolumeBricks>();
    upload.field = i;
    upload.count = static_cast<uint32_t>(field.coordinates.size() / 3);
    upload.coordinates = field.coordinates.data();
    upload.data = field.values.data();
    upload.dataSize = field.values.size() * sizeof(float);
    check(wlkUploadVolumeBricks(context, volume, &upload), scene.file, key + std::to_string(i));
    if (desc.fields[i].diameters) {
      uploadDiameters(context, scene, volume, i, denseOf(bricks.fields.back(), bricks.size),
                      key + std::to_string(i));
    }
  }
}

void applyVolume(WlkContext context, const Scene& scene, size_t index,
                 const std::vector<WlkMedium>& media) {
  const VolumeDesc& desc = scene.volumes[index];
  const std::string key = "volumes." + std::to_string(index);
  const Grid grid = loadSource(desc.fields[0].source);
  const WlkVolume volume = createVolume(context, scene, index, media, grid.size,
                                        placeVolume(grid.worldFromVolume, desc.placement));
  uploadField(context, scene, volume, 0, grid, key);
  for (uint32_t i = 1; i < desc.fields.size(); ++i) {
    const Grid other = loadSource(desc.fields[i].source);
    if (other.size != grid.size) {
      throw InputError(scene.file, key + ".fields." + std::to_string(i) + ".source",
                       "expected as many voxels as in field 0");
    }
    uploadField(context, scene, volume, i, other, key);
  }
  for (uint32_t i = 0; i < desc.fields.size(); ++i) {
    if (desc.fields[i].diameters) {
      const std::string name = key + ".fields." + std::to_string(i);
      const Grid diameters = loadSource(*desc.fields[i].diameters);
      if (diameters.size != grid.size) {
        throw InputError(scene.file, name + ".diameters", "expected as many voxels as in field 0");
      }
      uploadDiameters(context, scene, volume, i, diameters, name);
    }
  }
}

void applySurface(WlkContext context, const Scene& scene, size_t index, WlkMedium medium) {
  const SurfaceDesc& desc = scene.surfaces[index];
  const CloudMesh mesh = makeMesh(desc.shape);
  auto info = make<WlkSurfaceInfo>();
  info.medium = medium;
  info.extinction = static_cast<float>(desc.extinction);
  info.vertexCount = static_cast<uint32_t>(mesh.positions.size());
  info.triangleCount = static_cast<uint32_t>(mesh.triangles.size());
  info.positions = mesh.positions.data()->data();
  info.indices = mesh.triangles.data()->data();
  const Affine place = placeMesh(mesh, desc.placement);
  std::copy(place.begin(), place.end(), info.worldFromSurface);
  WlkSurface surface{};
  check(wlkCreateSurface(context, &info, &surface), scene.file,
        "surfaces." + std::to_string(index));
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = static_cast<float>(desc.detail.depth);
  detail.size = static_cast<float>(desc.detail.size);
  detail.softness = static_cast<float>(desc.detail.softness);
  detail.offset[0] = static_cast<float>(desc.detail.offset.x);
  detail.offset[1] = static_cast<float>(desc.detail.offset.y);
  detail.offset[2] = static_cast<float>(desc.detail.offset.z);
  check(wlkSetSurfaceDetail(context, surface, &detail), scene.file,
        "surfaces." + std::to_string(index) + ".detail");
}

DepthImage readDepth(const Scene& scene) {
  DepthImage depth = readExrDepth(scene.opaqueFiles->depth);
  if (scene.opaqueFiles->kind == DepthKind::View) {
    for (float& value : depth.values) {
      // 0 or less and infinity mean "nothing here" in files of view depth.
      const bool there = value > 0.0f && std::isfinite(value);
      value = there ? static_cast<float>(deviceDepth(scene.camera, double{value})) : 0.0f;
    }
  }
  return depth;
}

RasterResult readOpaque(const Scene& scene) {
  RasterResult opaque{readExr(scene.opaqueFiles->color), readDepth(scene)};
  const auto checkSize = [&](uint32_t width, uint32_t height, const std::filesystem::path& file) {
    if (width != scene.view.width || height != scene.view.height) {
      throw InputError(file.string(), "",
                       "expected the view's " + std::to_string(scene.view.width) + " x " +
                           std::to_string(scene.view.height) + " pixels, got " +
                           std::to_string(width) + " x " + std::to_string(height));
    }
  };
  checkSize(opaque.color.width, opaque.color.height, scene.opaqueFiles->color);
  checkSize(opaque.depth.width, opaque.depth.height, scene.opaqueFiles->depth);
  const auto finite = [](float value) { return std::isfinite(value); };
  if (!std::all_of(opaque.color.rgba.begin(), opaque.color.rgba.end(), finite)) {
    throw InputError(scene.opaqueFiles->color.string(), "", "expected finite values");
  }
  if (!std::all_of(opaque.depth.values.begin(), opaque.depth.values.end(), finite)) {
    throw InputError(scene.opaqueFiles->depth.string(), "", "expected finite values");
  }
  return opaque;
}

}  // namespace

void applyWorld(WlkContext context, const Scene& scene) {
  check(wlkSetPlanet(context, &scene.planet), scene.file, "planet");
  check(wlkSetSky(context, scene.sky ? &*scene.sky : nullptr), scene.file, "sky");
  check(wlkSetAbsorber(context, scene.absorber ? &*scene.absorber : nullptr), scene.file,
        "absorber");
  check(wlkSetAmbient(context, &scene.ambient), scene.file, "ambient");
  check(wlkSetLights(context, static_cast<uint32_t>(scene.lights.size()), sizeof(WlkLight),
                     scene.lights.data()),
        scene.file, "lights");
  applyFog(context, scene);
}

void applyBodies(WlkContext context, const Scene& scene, const Progress& progress) {
  std::vector<WlkMedium> media(scene.media.size());
  for (size_t i = 0; i < media.size(); ++i) {
    const WlkMediumInfo info = mediumInfo(scene.media[i]);
    check(wlkCreateMedium(context, &info, &media[i]), scene.file, "media." + scene.media[i].name);
  }
  for (size_t i = 0; i < scene.volumes.size(); ++i) {
    progress("volume " + std::to_string(i + 1) + " of " + std::to_string(scene.volumes.size()));
    if (sparse(scene.volumes[i])) {
      applyBricks(context, scene, i, media);
    } else {
      applyVolume(context, scene, i, media);
    }
  }
  for (size_t i = 0; i < scene.surfaces.size(); ++i) {
    progress("surface " + std::to_string(i + 1) + " of " + std::to_string(scene.surfaces.size()));
    applySurface(context, scene, i, media[scene.surfaces[i].medium]);
  }
}

WlkView applyView(WlkContext context, const Scene& scene) {
  WlkView view{};
  check(wlkCreateView(context, &scene.view, &view), scene.file, "view");
  auto camera = make<WlkCamera>();
  fillCamera(scene.camera, scene.view.width, scene.view.height, camera);
  check(wlkSetCamera(context, view, &camera), scene.file, "camera");
  check(wlkSetQuality(context, view, &scene.quality), scene.file, "quality");
  return view;
}

Illumination sampleIllumination(WlkContext context, const Scene& scene, double lowest,
                                double highest) {
  constexpr uint32_t ALTITUDES = 24;
  constexpr uint32_t RINGS = 8;
  constexpr uint32_t SPOKES = 16;
  Illumination light;
  light.lowest = lowest;
  light.highest = std::max(highest, lowest + 1.0);
  // Under the camera: the sun's path through the air differs little over the picture.
  const Vec3 eye = scene.camera.position;
  const Vec3 dip = eye - Vec3{scene.planet.seaLevelPoint[0], 0.0, scene.planet.seaLevelPoint[2]};
  const double fall = (dip.x * dip.x + dip.z * dip.z) / (2.0 * double{scene.planet.radius});
  const auto atAltitude = [&](double altitude) {
    return Vec3{eye.x, scene.planet.seaLevelPoint[1] + altitude - fall, eye.z};
  };
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    const float* d = scene.lights[i].direction;
    SunLight sun{{double{d[0]}, double{d[1]}, double{d[2]}}, {}};
    for (uint32_t k = 0; k < ALTITUDES; ++k) {
      const Vec3 p =
          atAltitude(light.lowest + (light.highest - light.lowest) * k / (ALTITUDES - 1));
      const double position[3] = {p.x, p.y, p.z};
      std::array<double, 3> irradiance{};
      check(wlkEvalLight(context, i, position, irradiance.data()), "wlkEvalLight");
      sun.irradiance.push_back(irradiance);
    }
    light.lights.push_back(std::move(sun));
  }
  // Midpoints in sin^2 of the elevation weigh every ray the same: E = pi * mean radiance.
  std::vector<WlkRay> rays;
  const Vec3 from = atAltitude(0.5 * (light.lowest + light.highest));
  for (uint32_t ring = 0; ring < RINGS; ++ring) {
    const double elevation = std::asin(std::sqrt((ring + 0.5) / RINGS));
    for (uint32_t spoke = 0; spoke < SPOKES; ++spoke) {
      const Vec3 d =
          directionFromAngles(elevation / RADIANS_PER_DEGREE, (spoke + 0.5) * 360.0 / SPOKES);
      rays.push_back({{from.x, from.y, from.z}, {d.x, d.y, d.z}, INFINITY});
    }
  }
  auto batch = make<WlkRayBatch>();
  batch.count = static_cast<uint32_t>(rays.size());
  batch.stride = sizeof(WlkRay);
  batch.rays = rays.data();
  std::vector<double> radiance(rays.size() * 3);
  check(wlkEvalSky(context, &batch, radiance.data(), nullptr), "wlkEvalSky");
  for (size_t i = 0; i < radiance.size(); ++i) {
    light.ambient[i % 3] += PI * radiance[i] / (RINGS * SPOKES);
  }
  return light;
}

RasterResult makeOpaque(WlkContext context, const Scene& scene, const Progress& progress) {
  if (scene.opaqueFiles) {
    progress("opaque picture");
    return readOpaque(scene);
  }
  if (!scene.geometry) {
    return {};
  }
  progress("terrain");
  std::optional<HeightField> field;
  double lowest = scene.camera.position.y - scene.planet.seaLevelPoint[1];
  double highest = lowest;
  if (scene.geometry->terrain) {
    field.emplace(*scene.geometry->terrain);
    lowest = std::max(field->lowest(), 0.0);
    highest = field->highest();
  }
  for (const SphereInfo& sphere : scene.geometry->spheres) {
    const double y = sphere.centre.y - scene.planet.seaLevelPoint[1];
    lowest = std::min(lowest, y - sphere.radius);
    highest = std::max(highest, y + sphere.radius);
  }
  const Illumination light = sampleIllumination(context, scene, lowest, highest);
  const double* sea = scene.planet.seaLevelPoint;
  const PlanetShape planet{{sea[0], sea[1], sea[2]}, double{scene.planet.radius}};
  progress("opaque picture");
  return rasterise(*scene.geometry, field ? &*field : nullptr, planet, light, scene.camera,
                   scene.view.width, scene.view.height);
}

}  // namespace host
