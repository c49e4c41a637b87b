// SPDX-License-Identifier: MIT
#include "cli/reference_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "cli/droplet_phase.hpp"
#include "common/error.hpp"

namespace cli {
namespace {

namespace truth = welkin::reference;

truth::Point pointOf(host::Vec3 v) {
  return {v.x, v.y, v.z};
}

truth::Rgb rgbOf(const float (&v)[3]) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

// A medium after what goes straight on has been taken off its extinction.
struct TruthMedium {
  truth::PhaseFunction phase = truth::PhaseFunction::isotropic();
  truth::Rgb extinction{1, 1, 1};  // factor
  truth::Rgb albedo{1, 1, 1};
};

// Scattering angles, dense around both ends: the library's curves are linear in 1 - cos between
// 2048 nodes at even steps of this coordinate, so that 4095 meet them all.
std::vector<double> phaseAngles() {
  constexpr int COUNT = 4095;
  std::vector<double> angles{0.0};
  for (int i = 1; i + 1 < COUNT; ++i) {
    const double wanted = static_cast<double>(i) / (COUNT - 1);
    double low = angles.back();
    double high = host::PI;
    for (int k = 0; k < 60; ++k) {
      const double t = 0.5 * (low + high);
      const double s = 0.5 * (std::sqrt(std::sin(0.5 * t)) + 1.0 - std::sqrt(std::cos(0.5 * t)));
      (s < wanted ? low : high) = t;
    }
    angles.push_back(0.5 * (low + high));
  }
  angles.push_back(host::PI);
  return angles;
}

truth::PhaseFunction phaseOf(WlkContext context, WlkMedium medium) {
  static const std::vector<double> angles = phaseAngles();
  auto query = host::make<WlkPhaseQuery>();
  query.medium = medium;
  query.count = static_cast<uint32_t>(angles.size());
  query.scatteringAngle = angles.data();
  std::vector<double> phase(angles.size() * 3);
  host::check(wlkEvalPhase(context, &query, phase.data()), "wlkEvalPhase");
  std::vector<truth::Rgb> values;
  for (size_t i = 0; i < angles.size(); ++i) {
    values.push_back({phase[3 * i], phase[3 * i + 1], phase[3 * i + 2]});
  }
  return truth::PhaseFunction::table(angles, values);
}

// Makes media, each kind of droplets only once.
class MediaTruth {
 public:
  MediaTruth(WlkContext context, const host::Scene& scene, const ReferenceSettings& settings,
             const host::Progress& progress)
      : context_(context), scene_(scene), settings_(settings), progress_(progress) {}

  // The best phase function that there is, whatever the scene's choice of model.
  TruthMedium make(WlkMediumInfo info, const std::string& key) {
    info.phaseModel = WLK_PHASE_DEFAULT;
    WlkMedium medium{};
    host::check(wlkCreateMedium(context_, &info, &medium), scene_.file, key);
    TruthMedium result;
    result.albedo = rgbOf(info.singleScatteringAlbedo);
    if (info.particle == WLK_PARTICLE_AIR) {
      result.phase = truth::PhaseFunction::rayleigh();
    } else if (info.particle == WLK_PARTICLE_HENYEY_GREENSTEIN) {
      result.phase = truth::PhaseFunction::henyeyGreenstein(double{info.asymmetry});
    } else if (settings_.mie) {
      result.phase = droplets(info, key);
    } else {
      result.phase = phaseOf(context_, medium);
      takeOffStraight(medium, result);
    }
    host::check(wlkDestroyMedium(context_, medium), "wlkDestroyMedium");
    return result;
  }

 private:
  truth::PhaseFunction droplets(const WlkMediumInfo& info, const std::string& key) {
    // Defaults as in welkin/scene.h.
    const std::map<uint32_t, double> diameters = {
        {WLK_PARTICLE_CLOUD, 20.0}, {WLK_PARTICLE_FOG, 10.0}, {WLK_PARTICLE_HAZE, 0.6}};
    const auto found = diameters.find(info.particle);
    if (found == diameters.end()) {
      throw host::InputError(scene_.file, key,
                             "expected cloud, fog, haze, air or henyey-greenstein with --mie");
    }
    Droplets wanted;
    wanted.diameter_um = info.diameter_um > 0.0f ? double{info.diameter_um} : found->second;
    wanted.spread = info.spread > 0.0f ? double{info.spread} : wanted.spread;
    if (info.wavelength_um > 0.0f) {
      wanted.wavelength_um.fill(double{info.wavelength_um});
    }
    const std::array<double, 3> same = {wanted.diameter_um, wanted.spread, wanted.wavelength_um[0]};
    auto known = known_.find(same);
    if (known == known_.end()) {
      progress_("Mie theory");
      known = known_.emplace(same, dropletPhase(wanted, settings_.threads)).first;
    }
    return known->second;
  }

  // What goes straight on counts as unscattered.
  void takeOffStraight(WlkMedium medium, TruthMedium& result) const {
    auto optics = host::make<WlkMediumOptics>();
    host::check(wlkGetMediumOptics(context_, medium, &optics), "wlkGetMediumOptics");
    for (size_t c = 0; c < 3; ++c) {
      const double albedo = result.albedo[c];
      const double straight = double{optics.deltaFraction[c]};
      result.extinction[c] = 1.0 - straight * albedo;
      result.albedo[c] = albedo > 0.0 ? (1.0 - straight) * albedo / result.extinction[c] : 0.0;
    }
  }

  WlkContext context_;
  const host::Scene& scene_;
  const ReferenceSettings& settings_;
  const host::Progress& progress_;
  std::map<std::array<double, 3>, truth::PhaseFunction> known_;
};

truth::ExponentialLayer airLayer(const WlkSky& sky) {
  truth::ExponentialLayer layer;
  layer.scaleHeight = double{sky.scaleHeight};
  layer.extinction = rgbOf(sky.rayleighScattering);
  layer.phase = truth::PhaseFunction::rayleigh();
  return layer;
}

truth::AbsorbingLayer absorbingLayer(const WlkAbsorber& absorber) {
  truth::AbsorbingLayer layer;
  layer.peak = double{absorber.peakAltitude};
  layer.halfWidth = double{absorber.halfWidth};
  layer.extinction = rgbOf(absorber.absorption);
  return layer;
}

// `medium` instead of droplets, if there is one; the albedo is the layer's own.
truth::ExponentialLayer fogLayer(MediaTruth& media, const WlkFog& fog,
                                 const std::optional<host::MediumDesc>& medium) {
  auto info = host::make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_FOG;
  info.diameter_um = fog.dropletDiameter_um;
  if (medium) {
    info = host::mediumInfo(*medium);
  }
  std::copy_n(fog.singleScatteringAlbedo, 3, info.singleScatteringAlbedo);
  const TruthMedium particles = media.make(info, medium ? "media." + medium->name : "fog");
  truth::ExponentialLayer layer;
  layer.base = double{fog.baseAltitude};
  layer.scaleHeight = double{fog.scaleHeight};
  for (size_t c = 0; c < 3; ++c) {
    layer.extinction[c] = double{fog.extinction} * particles.extinction[c];
  }
  layer.albedo = particles.albedo;
  layer.phase = particles.phase;
  return layer;
}

// As the library cleans what it is given.
std::vector<float> cleaned(std::vector<float> values) {
  for (float& value : values) {
    value = value > 0.0f && std::isfinite(value) ? std::min(value, 65504.0f) : 0.0f;
  }
  return values;
}

truth::VoxelVolume volumeOf(const host::Scene& scene, size_t index,
                            const std::vector<TruthMedium>& media) {
  const host::VolumeDesc& desc = scene.volumes[index];
  const std::string key = "volumes." + std::to_string(index);
  std::vector<truth::ParticleField> fields;
  std::array<int, 3> size{};
  host::Affine place{};
  for (size_t i = 0; i < desc.fields.size(); ++i) {
    if (desc.fields[i].diameters) {
      throw host::InputError(scene.file, key + ".fields." + std::to_string(i) + ".diameters",
                             "the reference renderer has one diameter per field");
    }
    host::Grid grid = host::loadSource(desc.fields[i].source);
    if (i == 0) {
      std::copy(grid.size.begin(), grid.size.end(), size.begin());
      place = host::placeVolume(grid.worldFromVolume, desc.placement);
    } else if (!std::equal(grid.size.begin(), grid.size.end(), size.begin())) {
      throw host::InputError(scene.file, key + ".fields." + std::to_string(i) + ".source",
                             "expected as many voxels as in field 0");
    }
    const TruthMedium& medium = media[desc.fields[i].medium];
    truth::ParticleField field;
    field.values = cleaned(std::move(grid.values));
    for (size_t c = 0; c < 3; ++c) {
      field.extinctionScale[c] = desc.fields[i].extinctionScale * medium.extinction[c];
    }
    field.albedo = medium.albedo;
    field.phase = medium.phase;
    fields.push_back(std::move(field));
  }
  try {
    return {size, place, std::move(fields)};
  } catch (const std::exception& e) {
    throw host::InputError(scene.file, key, e.what());
  }
}

std::vector<truth::EyeRay> raysOf(const host::Scene& scene, const host::RasterResult& opaque) {
  const uint32_t width = scene.view.width;
  const uint32_t height = scene.view.height;
  const host::CameraAxes axes = host::cameraAxes(scene.camera);
  const bool separate = scene.view.composite == WLK_COMPOSITE_SEPARATE;
  std::vector<truth::EyeRay> rays;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const host::Vec3 through =
          host::pixelRay(scene.camera, axes, x + 0.5, y + 0.5, width, height);
      truth::EyeRay ray;
      ray.origin = pointOf(scene.camera.position);
      ray.direction = truth::normalized(pointOf(through));
      const size_t pixel = size_t{y} * width + x;
      const float depth = opaque.depth.values.empty() ? 0.0f : opaque.depth.values[pixel];
      if (depth > 0.0f) {
        ray.length = scene.camera.nearPlane / double{depth} * host::length(through);
        for (size_t c = 0; c < 3 && !separate; ++c) {
          ray.background[c] = double{opaque.color.rgba[4 * pixel + c]} / scene.camera.preExposure;
        }
      }
      rays.push_back(ray);
    }
  }
  return rays;
}

}  // namespace

ReferenceScene makeReferenceScene(WlkContext context, const host::Scene& scene,
                                  const ReferenceSettings& settings,
                                  const host::Progress& progress) {
  ReferenceScene result;
  truth::Scene& out = result.scene;
  const auto layer = [&](uint64_t bit) { return (scene.view.layers & bit) != 0; };
  const bool air = scene.sky && layer(WLK_LAYER_SKY);
  const bool fog = scene.fog && layer(WLK_LAYER_FOG);
  for (size_t i = 0; i < 3; ++i) {
    out.globe.seaLevelPoint[i] = scene.planet.seaLevelPoint[i];
  }
  out.globe.up = truth::normalized(rgbOf(scene.planet.up));
  out.globe.radius = double{scene.planet.radius};
  // As a layer, the ground belongs to the sky; black, it still ends the fog.
  out.ground = air || fog;
  if (air && layer(WLK_LAYER_GROUND)) {
    out.groundAlbedo = rgbOf(scene.planet.groundAlbedo);
  }
  for (const WlkLight& light : scene.lights) {
    truth::DistantLight to;
    to.direction = truth::normalized(rgbOf(light.direction));
    to.irradiance = rgbOf(light.irradiance);
    const bool drawn = air && layer(WLK_LAYER_SUN_DISK);
    to.angularDiameter = drawn || settings.disk ? double{light.angularDiameter} : 0.0;
    to.blurs = settings.disk;
    out.lights.push_back(to);
  }
  progress("phase functions");
  MediaTruth truths(context, scene, settings, progress);
  if (air) {
    out.layers.push_back(airLayer(*scene.sky));
    if (scene.absorber) {
      out.absorbers.push_back(absorbingLayer(*scene.absorber));
    }
  }
  if (fog) {
    out.layers.push_back(fogLayer(truths, *scene.fog, scene.fogMedium));
  }
  if (layer(WLK_LAYER_SURFACES) && !scene.surfaces.empty()) {
    throw host::InputError(scene.file, "surfaces",
                           "expected each with \"as\": \"volume\": the reference has no meshes");
  }
  if (layer(WLK_LAYER_VOLUMES)) {
    std::vector<TruthMedium> media;
    for (const host::MediumDesc& medium : scene.media) {
      media.push_back(truths.make(host::mediumInfo(medium), "media." + medium.name));
    }
    for (size_t i = 0; i < scene.volumes.size(); ++i) {
      progress("volume " + std::to_string(i + 1) + " of " + std::to_string(scene.volumes.size()));
      out.volumes.push_back(volumeOf(scene, i, media));
    }
  }
  result.rays = raysOf(scene, host::makeOpaque(context, scene, progress));
  return result;
}

}  // namespace cli
