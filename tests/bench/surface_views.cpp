// SPDX-License-Identifier: MIT
#include "bench/surface_views.hpp"

#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

#include "reference/mesh_tracer.hpp"
#include "tables/canonical_phase.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;
using rt::Point;

constexpr double RADIANS = std::numbers::pi / 180;

// As in the scenes: azimuth from -z over +x.
Point sunAt(double elevation_deg, double azimuth_deg) {
  const double c = std::cos(elevation_deg * RADIANS);
  return rt::normalized({std::sin(azimuth_deg * RADIANS) * c, std::sin(elevation_deg * RADIANS),
                         -std::cos(azimuth_deg * RADIANS) * c});
}

// A ray through a random point of the pixel.
rt::MeshRay pixelRay(const SurfaceView& view, int x, int y, rt::Random& random) {
  const double u = x + random.uniform();
  const double v = y + random.uniform();
  return {view.eye, pixelWay(view, u, v)};
}

}  // namespace

// Three suns each: behind the eye, beside it, and behind the cloud.
std::vector<SurfaceView> surfaceViews() {
  SurfaceView cumulus;
  cumulus.body = "cumulus";
  cumulus.extinction = 0.025;  // optical radius about 15
  cumulus.eye = {300, 900, 3600};
  cumulus.target = {0, 1370, 0};
  cumulus.verticalFov_deg = 26;
  cumulus.width = 64;
  cumulus.height = 56;
  SurfaceView layer;
  layer.body = "stratocumulus";
  layer.extinction = 0.05;  // optical thickness about 10
  layer.eye = {200, 2000, 2900};
  layer.target = {0, 800, 150};
  layer.verticalFov_deg = 25;
  layer.width = 96;
  layer.height = 48;
  std::vector<SurfaceView> views;
  for (const SurfaceView& body : {cumulus, layer}) {
    for (const auto& [name, sun] :
         {std::pair{"-front", sunAt(35, 195)}, std::pair{"-side", sunAt(35, 90)},
          std::pair{"-back", sunAt(28, 8)}}) {
      views.push_back(body);
      views.back().name = body.body + name;
      views.back().sun = sun;
    }
  }
  return views;
}

Point pixelWay(const SurfaceView& view, double x, double y) {
  const Point forward = rt::normalized(rt::minus(view.target, view.eye));
  const Point right = rt::normalized(rt::cross(forward, {0, 1, 0}));
  const Point up = rt::cross(right, forward);
  const double pixel = 2 * std::tan(0.5 * view.verticalFov_deg * RADIANS) / view.height;
  const double u = (x - 0.5 * view.width) * pixel;
  const double v = (0.5 * view.height - y) * pixel;
  return rt::normalized(rt::along(rt::along(forward, right, u), up, v));
}

rt::MeshBody referenceBody(const BodyMesh& mesh) {
  std::vector<Point> positions;
  for (size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    positions.push_back(
        {double{mesh.positions[i]}, double{mesh.positions[i + 1]}, double{mesh.positions[i + 2]}});
  }
  std::vector<std::array<uint32_t, 3>> triangles;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return {std::move(positions), std::move(triangles)};
}

CanonicalCurve canonicalCurve() {
  const welkin::CanonicalPhase cloud = welkin::canonicalPhase();
  CanonicalCurve curve;
  for (const double y : cloud.y) {
    curve.angle.push_back(2 * std::asin(std::sqrt(y / 2)));
  }
  curve.angle.back() = std::numbers::pi;
  curve.value = cloud.value;
  return curve;
}

SurfaceTruthImage traceView(const SurfaceView& view, const BodyMesh& mesh, uint64_t paths,
                            uint64_t seed, unsigned threads, int every) {
  const rt::MeshBody body = referenceBody(mesh);
  const CanonicalCurve curve = canonicalCurve();
  std::vector<rt::Rgb> grey;
  for (const double value : curve.value) {
    grey.push_back({value, value, value});
  }
  const rt::MeshMedium medium = {view.extinction, 1, rt::PhaseFunction::table(curve.angle, grey)};
  const rt::MeshTracer tracer(body, medium);
  const int count = view.width * view.height;
  std::vector<rt::MeshEstimate> found(static_cast<size_t>(count));
  std::atomic<int> next = 0;  // pixel over `every`
  const auto work = [&] {
    for (int pixel = every * next++; pixel < count; pixel = every * next++) {
      const auto draw = [&](rt::Random& random) {
        return rt::MeshTracer::Start{pixelRay(view, pixel % view.width, pixel / view.width, random),
                                     view.sun};
      };
      found[static_cast<size_t>(pixel)] =
          tracer.trace(draw, paths, seed, static_cast<uint64_t>(pixel));
    }
  };
  std::vector<std::thread> helpers;
  for (unsigned i = 1; i < threads; ++i) {
    helpers.emplace_back(work);
  }
  work();
  for (std::thread& helper : helpers) {
    helper.join();
  }
  SurfaceTruthImage image{paths, body.volume(), mesh.indices.size() / 3, {}};
  for (int pixel = 0; pixel < count; pixel += every) {
    const rt::MeshEstimate& e = found[static_cast<size_t>(pixel)];
    if (e.opacity > 0) {
      image.pixels.push_back({pixel % view.width, pixel / view.width, e.once,
                              std::sqrt(e.onceVariance), e.rest, std::sqrt(e.restVariance),
                              e.opacity, e.facing});
    }
  }
  return image;
}

SurfaceRegion regionOf(const SurfacePixel& pixel) {
  if (pixel.opacity < SILHOUETTE_OPACITY) {
    return SurfaceRegion::SILHOUETTE;
  }
  return pixel.facing > 0 ? SurfaceRegion::LIT : SurfaceRegion::SHADOW;
}

}  // namespace bench
