// SPDX-License-Identifier: MIT
#include "bench/surface_view_scene.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "common/camera.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr double TURN = 1e-6;  // rad

host::Vec3 vec(const rt::Point& p) {
  return {p[0], p[1], p[2]};
}

double processClock_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

// Exact along z, columns on a lattice of 4 x 4 per voxel.
BodyVoxels voxelsOf(const rt::MeshBody& body, uint32_t across) {
  constexpr uint32_t COLUMNS = 4;
  BodyVoxels voxels;
  const rt::Point extent = rt::minus(body.high(), body.low());
  const double voxel = *std::max_element(extent.begin(), extent.end()) / across;
  for (size_t k = 0; k < 3; ++k) {
    voxels.size[k] = static_cast<uint32_t>(std::ceil(extent[k] / voxel)) + 2;
    voxels.edge[k] = voxel * voxels.size[k];
    voxels.low[k] = body.low()[k] - 0.5 * (voxels.edge[k] - extent[k]);
  }
  const auto [nx, ny, nz] = voxels.size;
  voxels.cover.assign(size_t{nx} * ny * nz, 0.0F);
  std::vector<rt::MeshStretch> found;
  for (uint32_t row = 0; row < ny * COLUMNS; ++row) {
    for (uint32_t column = 0; column < nx * COLUMNS; ++column) {
      const rt::Point origin = {voxels.low[0] + (column + 0.5) * voxel / COLUMNS,
                                voxels.low[1] + (row + 0.5) * voxel / COLUMNS, voxels.low[2]};
      body.inside(origin, {0, 0, 1}, found);
      for (const rt::MeshStretch& stretch : found) {
        for (uint32_t z = 0; z < nz; ++z) {
          const double part = std::min(stretch.end / voxel, z + 1.0) -
                              std::max(stretch.begin / voxel, static_cast<double>(z));
          voxels.cover[(size_t{z} * ny + row / COLUMNS) * nx + column / COLUMNS] +=
              static_cast<float>(std::max(part, 0.0) / (COLUMNS * COLUMNS));
        }
      }
    }
  }
  return voxels;
}

SurfaceWorld::SurfaceWorld(const CanonicalCurve& curve)
    : context_(host::makeHeadlessContext(false, "", log_)) {
  std::vector<double> grey;
  for (const double value : curve.value) {
    grey.insert(grey.end(), 3, value);
  }
  auto info = host::make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_USER;
  info.userAngle = curve.angle.data();
  info.userPhase = grey.data();
  info.userCount = static_cast<uint32_t>(curve.angle.size());
  host::check(wlkCreateMedium(context_.get(), &info, &medium_), "wlkCreateMedium");
}

SurfaceWorld::~SurfaceWorld() {
  clear();
}

void SurfaceWorld::clear() {
  wlkDestroyView(context_.get(), shown_);
  wlkDestroySurface(context_.get(), surface_);
  wlkDestroyVolume(context_.get(), volume_);
  shown_ = {};
  surface_ = {};
  volume_ = {};
}

void SurfaceWorld::addSurface(const BodyMesh& mesh) {
  auto info = host::make<WlkSurfaceInfo>();
  info.medium = medium_;
  info.extinction = static_cast<float>(view_.extinction);
  info.vertexCount = static_cast<uint32_t>(mesh.positions.size() / 3);
  info.triangleCount = static_cast<uint32_t>(mesh.indices.size() / 3);
  info.positions = mesh.positions.data();
  info.indices = mesh.indices.data();
  host::check(wlkCreateSurface(context_.get(), &info, &surface_), "wlkCreateSurface");
}

void SurfaceWorld::addVolume(const BodyMesh& mesh, uint32_t across) {
  const BodyVoxels voxels = voxelsOf(referenceBody(mesh), across);
  const WlkVolumeField field{medium_, static_cast<float>(view_.extinction), 0};
  auto info = host::make<WlkVolumeInfo>();
  info.fieldCount = 1;
  info.fields = &field;
  std::fill_n(info.worldFromVolume, 12, 0.0);
  for (size_t k = 0; k < 3; ++k) {
    info.size[k] = voxels.size[k];
    info.worldFromVolume[5 * k] = voxels.edge[k];
    info.worldFromVolume[4 * k + 3] = voxels.low[k];
  }
  host::check(wlkCreateVolume(context_.get(), &info, &volume_), "wlkCreateVolume");
  auto upload = host::make<WlkVolumeUpload>();
  upload.format = WLK_FORMAT_R32_FLOAT;
  std::copy(voxels.size.begin(), voxels.size.end(), upload.extent);
  upload.data = voxels.cover.data();
  upload.dataSize = voxels.cover.size() * sizeof(float);
  host::check(wlkUploadVolume(context_.get(), volume_, &upload), "wlkUploadVolume");
}

void SurfaceWorld::show(const SurfaceView& view, const BodyMesh& mesh, const SurfaceMethod& method,
                        uint32_t rays) {
  clear();
  view_ = view;
  rays_ = rays;
  WlkContext context = context_.get();
  method.volume ? addVolume(mesh, method.voxels) : addSurface(mesh);
  auto info = host::make<WlkViewInfo>();
  info.width = static_cast<uint32_t>(view.width) * rays;
  info.height = static_cast<uint32_t>(view.height) * rays;
  info.layers = WLK_LAYER_VOLUMES | WLK_LAYER_SURFACES;
  host::check(wlkCreateView(context, &info, &shown_), "wlkCreateView");
  auto quality = host::make<WlkQuality>();
  quality.level = method.level;
  quality.scattering = method.scattering;
  quality.volumeResolution = method.resolution;
  host::check(wlkSetQuality(context, shown_, &quality), "wlkSetQuality");
  host::CameraDesc desc;
  desc.position = vec(view.eye);
  desc.forward = host::normalize(vec(view.target) - vec(view.eye));
  desc.verticalFovDeg = view.verticalFov_deg;
  desc.nearPlane = 1;
  auto camera = host::make<WlkCamera>();
  host::fillCamera(desc, info.width, info.height, camera);
  host::check(wlkSetCamera(context, shown_, &camera), "wlkSetCamera");
  turnLight(0);
  host::check(wlkPrepare(context), "wlkPrepare");
}

void SurfaceWorld::turnLight(int steps) {
  const host::Vec3 to = vec(view_.sun);
  const host::Vec3 across = host::normalize(host::cross(to, {0.1, 0.6, 0.8}));
  const host::Vec3 sun = host::normalize(to + across * (steps * TURN));
  auto light = host::make<WlkLight>();
  light.direction[0] = static_cast<float>(sun.x);
  light.direction[1] = static_cast<float>(sun.y);
  light.direction[2] = static_cast<float>(sun.z);
  light.angularDiameter = 0;
  host::check(wlkSetLights(context_.get(), 1, sizeof(WlkLight), &light), "wlkSetLights");
}

void SurfaceWorld::detail(double depth) {
  auto info = host::make<WlkSurfaceDetail>();
  info.depth = static_cast<float>(depth);
  info.size = static_cast<float>(3 * depth);
  host::check(wlkSetSurfaceDetail(context_.get(), surface_, &info), "wlkSetSurfaceDetail");
}

double SurfaceWorld::render() {
  const double begin = processClock_ms();
  host::check(wlkRenderHeadless(context_.get(), shown_, nullptr), "wlkRenderHeadless");
  return processClock_ms() - begin;
}

double SurfaceWorld::passTime(uint32_t pass) const {
  auto stats = host::make<WlkFrameStats>();
  uint32_t count = 0;
  const auto get = [&](WlkPassStats* passes) {
    host::check(
        wlkGetFrameStats(context_.get(), shown_, &stats, &count, sizeof(WlkPassStats), passes),
        "wlkGetFrameStats");
  };
  get(nullptr);
  std::vector<WlkPassStats> passes(count);
  get(passes.data());
  double time = 0;
  for (const WlkPassStats& one : passes) {
    time += one.pass == pass ? 1e-6 * static_cast<double>(one.gpuTime_ns) : 0;
  }
  return time;
}

std::vector<double> SurfaceWorld::picture() const {
  const auto width = static_cast<size_t>(view_.width);
  const auto height = static_cast<size_t>(view_.height);
  std::vector<float> rgba(4 * width * height * rays_ * rays_);
  auto data = host::make<WlkImageData>();
  data.data = rgba.data();
  data.dataSize = rgba.size() * sizeof(float);
  host::check(wlkReadback(context_.get(), shown_, &data), "wlkReadback");
  std::vector<double> means(width * height);
  for (size_t y = 0; y < height * rays_; ++y) {
    for (size_t x = 0; x < width * rays_; ++x) {
      means[y / rays_ * width + x / rays_] +=
          double{rgba[4 * (y * width * rays_ + x) + 1]} / (rays_ * rays_);
    }
  }
  return means;
}

SurfaceErrors surfaceErrorsIn(const std::vector<double>& picture, const SurfaceView& view,
                              const SurfaceTruthImage& truth, const SurfaceRegion* region) {
  SurfaceErrors errors;
  double shown = 0;
  double sum = 0;
  double squares = 0;
  double difference = 0;
  for (const SurfacePixel& p : truth.pixels) {
    if (region != nullptr && regionOf(p) != *region) {
      continue;
    }
    const double value = picture[static_cast<size_t>(p.y * view.width + p.x)];
    const double expected = p.once + p.rest;
    shown += value;
    sum += expected;
    squares += expected * expected;
    difference += (value - expected) * (value - expected) - p.onceError * p.onceError -
                  p.restError * p.restError;
    ++errors.pixels;
  }
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  errors.total = errors.pixels > 0 ? shown / sum : NONE;
  errors.rms = errors.pixels > 0 ? std::sqrt(std::max(difference, 0.0) / squares) : NONE;
  return errors;
}

}  // namespace bench
