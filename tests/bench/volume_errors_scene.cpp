// SPDX-License-Identifier: MIT
#include "bench/volume_errors_scene.hpp"

#include <cmath>
#include <ctime>
#include <numbers>

#include "bench/volume_clouds.hpp"

namespace bench {
namespace {

constexpr double RADIANS = std::numbers::pi / 180;
constexpr double TURN = 1e-6;  // rad

constexpr double SPHERE_RADIUS = 100;     // m
constexpr double SPHERE_ALTITUDE = 1000;  // m

constexpr double SLAB_WIDTH = 40e3;    // m; light that enters at its edges is far from its middle
constexpr double SLAB_HEIGHT = 1e3;    // m
constexpr double SLAB_ALTITUDE = 5e3;  // m, of its middle
constexpr double SLAB_DISTANCE = 2e3;  // from the face to the eye, m
constexpr double SLAB_VIEW_deg = 0.2;  // field of view
constexpr uint32_t SLAB_VOXELS = 32;   // along an edge
constexpr uint32_t SLAB_RAYS = 8;      // along the picture's edge
constexpr uint32_t SPHERE_RAYS = 3;    // along a pixel's edge
constexpr uint32_t CLOUD_RAYS = 8;     // along a pixel's edge

host::Vec3 vec(const welkin::reference::Point& p) {
  return {p[0], p[1], p[2]};
}

host::Affine boxAt(host::Vec3 min, host::Vec3 extent) {
  return host::affineFromEdges(min, {extent.x, 0, 0}, {0, extent.y, 0}, {0, 0, extent.z});
}

host::CameraDesc cameraAt(host::Vec3 eye, host::Vec3 target, double verticalFov_deg) {
  host::CameraDesc camera;
  camera.position = eye;
  camera.forward = host::normalize(target - eye);
  camera.verticalFovDeg = verticalFov_deg;
  camera.nearPlane = 1;
  return camera;
}

VolumeGroup sphereGroup(const std::string& folder, int opticalRadius) {
  VolumeGroup group;
  group.kind = "sphere";
  group.name = "sphere-" + std::to_string(opticalRadius);
  group.size.fill(SPHERE_VOXELS);
  group.extinction = [opticalRadius] {
    std::vector<float> values = sphereVoxels();
    for (float& value : values) {
      value *= static_cast<float>(opticalRadius / SPHERE_RADIUS);
    }
    return values;
  };
  constexpr double EDGE = SPHERE_BOX * SPHERE_RADIUS;
  const host::Vec3 middle{0, SPHERE_ALTITUDE, 0};
  group.place = boxAt(middle - host::Vec3{EDGE / 2, EDGE / 2, EDGE / 2}, {EDGE, EDGE, EDGE});
  group.sun = {0, 0, 1};
  group.perPixel = SPHERE_RAYS;
  for (const int angle : SPHERE_ANGLES) {
    const double s = angle == 180 ? 0 : std::sin(angle * RADIANS);
    const double c = angle == 180 ? -1 : std::cos(angle * RADIANS);
    const double fov = 2 * std::atan(SPHERE_BOX / 2 / SPHERE_DISTANCE) / RADIANS;
    const host::Vec3 eye = middle - host::Vec3{s, 0, c} * (SPHERE_DISTANCE * SPHERE_RADIUS);
    const std::string name = sphereName(opticalRadius, angle);
    group.shots.push_back(
        {name, cameraAt(eye, middle, fov), readTruthImage(folder + "/" + name + ".csv")});
  }
  return group;
}

VolumeGroup cloudGroup(const std::string& folder, const CloudCase& one, const char* kind,
                       const std::function<std::vector<float>()>& extinction) {
  VolumeGroup group;
  group.kind = kind;
  group.name = one.name;
  for (size_t k = 0; k < 3; ++k) {
    group.size[k] = static_cast<uint32_t>(one.voxels[k]);
  }
  group.extinction = extinction;
  group.place = boxAt(vec(one.min), vec(one.extent));
  group.droplets = one.droplets;
  group.sun = vec(one.sun);
  group.perPixel = CLOUD_RAYS;
  group.shots.push_back({one.name, cameraAt(vec(one.eye), vec(one.target), one.verticalFov_deg),
                         readTruthImage(folder + "/" + one.name + ".csv")});
  return group;
}

std::string shortNumber(double value) {
  return value == std::floor(value) ? std::to_string(static_cast<int>(value))
                                    : std::to_string(value).substr(0, 3);
}

// "slab-hg-0.5-50": phase function, optical depth, the sun's zenith angle.
std::string slabName(const SlabTruth& row) {
  return std::string("slab-") + (row.droplets ? "droplets-" : "hg-") + shortNumber(row.tau) + "-" +
         shortNumber(row.sunZenith_deg);
}

VolumeGroup slabGroup(const SlabTruth& row) {
  VolumeGroup group;
  group.kind = "slab";
  group.name = slabName(row);
  group.size.fill(SLAB_VOXELS);
  group.extinction = [tau = row.tau] {
    return std::vector<float>(size_t{SLAB_VOXELS} * SLAB_VOXELS * SLAB_VOXELS,
                              static_cast<float>(tau / SLAB_HEIGHT));
  };
  group.place = boxAt({-SLAB_WIDTH / 2, SLAB_ALTITUDE - SLAB_HEIGHT / 2, -SLAB_WIDTH / 2},
                      {SLAB_WIDTH, SLAB_HEIGHT, SLAB_WIDTH});
  group.droplets = row.droplets;
  // The beam travels towards +x.
  group.sun = {-std::sin(row.sunZenith_deg * RADIANS), std::cos(row.sunZenith_deg * RADIANS), 0};
  group.perPixel = SLAB_RAYS;
  return group;
}

VolumeShot slabShot(const SlabTruth& row) {
  const double side = row.reflected ? 1 : -1;
  const double sine = std::sin(row.viewZenith_deg * RADIANS);
  const host::Vec3 travel{sine * std::cos(row.azimuth_deg * RADIANS),
                          side * std::cos(row.viewZenith_deg * RADIANS),
                          sine * std::sin(row.azimuth_deg * RADIANS)};
  const host::Vec3 face{0, SLAB_ALTITUDE + side * SLAB_HEIGHT / 2, 0};
  VolumeShot shot;
  shot.name = slabName(row) + (row.reflected ? "-reflected-" : "-transmitted-") +
              shortNumber(row.viewZenith_deg) + "-" + shortNumber(row.azimuth_deg);
  shot.camera = cameraAt(face + travel * SLAB_DISTANCE, face, SLAB_VIEW_deg);
  shot.truth.width = shot.truth.height = 1;
  shot.truth.radiance = {row.radiance};
  shot.truth.error = {0};
  return shot;
}

double processClock_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

WlkMediumInfo mediumOf(const VolumeGroup& group) {
  auto info = host::make<WlkMediumInfo>();
  if (group.droplets) {  // DROPLET_FILE
    info.particle = WLK_PARTICLE_CLOUD;
    info.diameter_um = 12;
    info.wavelength_um = 0.55F;
  } else {
    info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
    info.asymmetry = static_cast<float>(TRUTH_G);
  }
  return info;
}

}  // namespace

std::vector<VolumeGroup> volumeGroups(const std::string& folder, const std::string& les) {
  std::vector<VolumeGroup> groups;
  for (const int radius : SPHERE_RADII) {
    groups.push_back(sphereGroup(folder, radius));
  }
  for (const CloudCase& one : cumulusCases()) {
    groups.push_back(cloudGroup(folder, one, "cumulus", cumulusExtinction));
  }
  for (const CloudCase& one : les.empty() ? std::vector<CloudCase>() : lesCases()) {
    groups.push_back(cloudGroup(folder, one, "les", [les] { return lesExtinction(les); }));
  }
  for (const CloudCase& one : les.empty() ? std::vector<CloudCase>() : lesSingleCases()) {
    groups.push_back(cloudGroup(folder, one, "les-single", [les] { return lesExtinction(les); }));
    groups.back().perPixel = LES_SINGLE_RAYS;
  }
  for (const SlabTruth& row : readSlabTruth(folder + "/slabs.csv")) {
    if (groups.back().name != slabName(row)) {
      groups.push_back(slabGroup(row));
    }
    groups.back().shots.push_back(slabShot(row));
  }
  return groups;
}

VolumeWorld::VolumeWorld(uint32_t lightBufferSize, uint32_t cells)
    : context_(host::makeHeadlessContext(false, "", log_)),
      lightBufferSize_(lightBufferSize),
      cells_(cells) {}

void VolumeWorld::clear() {
  if (group_ == nullptr) {
    return;
  }
  host::check(wlkDestroyView(context_.get(), view_), "wlkDestroyView");
  host::check(wlkDestroyVolume(context_.get(), volume_), "wlkDestroyVolume");
  host::check(wlkDestroyMedium(context_.get(), medium_), "wlkDestroyMedium");
  group_ = nullptr;
}

void VolumeWorld::show(const VolumeGroup& group, uint32_t level, uint32_t scattering) {
  clear();
  WlkContext context = context_.get();
  const WlkMediumInfo medium = mediumOf(group);
  host::check(wlkCreateMedium(context, &medium, &medium_), "wlkCreateMedium");
  const WlkVolumeField field{medium_, 1, 0};
  auto info = host::make<WlkVolumeInfo>();
  std::copy(group.size.begin(), group.size.end(), info.size);
  info.fieldCount = 1;
  info.fields = &field;
  std::copy(group.place.begin(), group.place.end(), info.worldFromVolume);
  host::check(wlkCreateVolume(context, &info, &volume_), "wlkCreateVolume");
  const std::vector<float> values = group.extinction();
  auto upload = host::make<WlkVolumeUpload>();
  upload.format = WLK_FORMAT_R32_FLOAT;
  std::copy(group.size.begin(), group.size.end(), upload.extent);
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  host::check(wlkUploadVolume(context, volume_, &upload), "wlkUploadVolume");

  auto view = host::make<WlkViewInfo>();
  const TruthImage& truth = group.shots[0].truth;
  width_ = view.width = static_cast<uint32_t>(truth.width) * group.perPixel;
  height_ = view.height = static_cast<uint32_t>(truth.height) * group.perPixel;
  view.layers = WLK_LAYER_VOLUMES;
  host::check(wlkCreateView(context, &view, &view_), "wlkCreateView");
  auto quality = host::make<WlkQuality>();
  quality.level = level;
  quality.scattering = scattering;
  quality.lightBufferSize = lightBufferSize_;
  quality.volumeCells = cells_;
  quality.volumeResolution = WLK_VOLUME_RESOLUTION_FULL;
  host::check(wlkSetQuality(context, view_, &quality), "wlkSetQuality");
  group_ = &group;
  turnLight(0);
  host::check(wlkPrepare(context), "wlkPrepare");
}

void VolumeWorld::turnLight(int steps) {
  const host::Vec3 across = host::normalize(host::cross(group_->sun, {0, 0.6, 0.8}));
  const host::Vec3 sun = host::normalize(group_->sun + across * (steps * TURN));
  auto light = host::make<WlkLight>();
  light.direction[0] = static_cast<float>(sun.x);
  light.direction[1] = static_cast<float>(sun.y);
  light.direction[2] = static_cast<float>(sun.z);
  light.angularDiameter = 0;
  host::check(wlkSetLights(context_.get(), 1, sizeof(WlkLight), &light), "wlkSetLights");
}

VolumeFrame VolumeWorld::render(const VolumeShot& shot) {
  auto camera = host::make<WlkCamera>();
  host::fillCamera(shot.camera, width_, height_, camera);
  host::check(wlkSetCamera(context_.get(), view_, &camera), "wlkSetCamera");
  const double begin = processClock_ms();
  host::check(wlkRenderHeadless(context_.get(), view_, nullptr), "wlkRenderHeadless");
  VolumeFrame frame;
  frame.cpu_ms = processClock_ms() - begin;
  auto stats = host::make<WlkFrameStats>();
  uint32_t count = 0;
  host::check(
      wlkGetFrameStats(context_.get(), view_, &stats, &count, sizeof(WlkPassStats), nullptr),
      "wlkGetFrameStats");
  std::vector<WlkPassStats> passes(count);
  host::check(
      wlkGetFrameStats(context_.get(), view_, &stats, &count, sizeof(WlkPassStats), passes.data()),
      "wlkGetFrameStats");
  for (const WlkPassStats& pass : passes) {
    frame.lightComputed |= pass.pass == WLK_PASS_VOLUME_LIGHT && pass.recorded != 0 &&
                           pass.reason != WLK_REASON_UNCHANGED;
  }
  return frame;
}

std::vector<double> VolumeWorld::picture() const {
  std::vector<float> rgba(size_t{4} * width_ * height_);
  auto data = host::make<WlkImageData>();
  data.data = rgba.data();
  data.dataSize = rgba.size() * sizeof(float);
  host::check(wlkReadback(context_.get(), view_, &data), "wlkReadback");
  const uint32_t n = group_->perPixel;
  std::vector<double> means(size_t{width_ / n} * (height_ / n));
  for (uint32_t y = 0; y < height_; ++y) {
    for (uint32_t x = 0; x < width_; ++x) {
      means[size_t{y / n} * (width_ / n) + x / n] +=
          double{rgba[4 * (size_t{y} * width_ + x) + 1]} / (n * n);
    }
  }
  return means;
}

WlkCapabilities VolumeWorld::capabilities() const {
  auto capabilities = host::make<WlkCapabilities>();
  host::check(wlkGetCapabilities(context_.get(), &capabilities), "wlkGetCapabilities");
  return capabilities;
}

}  // namespace bench
