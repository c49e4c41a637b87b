// SPDX-License-Identifier: MIT
// Pictures of cloud surfaces through the API against truth that shares nothing with them: slabs by
// discrete ordinates, spheres, a stratocumulus and a cumulus by Monte Carlo.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bench/surface_view_scene.hpp"
#include "reference/mesh_shapes.hpp"
#include "reference/slab_solver.hpp"
#include "support/on_gpu.hpp"
#include "tables/surface_source.hpp"
#include "unit/surface_picture.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;
using welkin::test::FILTER_STEP;
using welkin::test::onGpu;

constexpr double PI = std::numbers::pi;
constexpr double RADIANS = PI / 180;
constexpr double HEIGHT = 3000;  // m, of the bodies' middles

const CanonicalCurve& curve() {
  static const CanonicalCurve made = canonicalCurve();
  return made;
}

SurfaceWorld& world() {
  static SurfaceWorld shared(curve());
  return shared;
}

BodyMesh meshOf(const rt::MeshShape& shape, const rt::Point& scale) {
  BodyMesh mesh;
  for (const rt::Point& p : shape.position) {
    for (size_t k = 0; k < 3; ++k) {
      mesh.positions.push_back(static_cast<float>(p[k] * scale[k] + (k == 1 ? HEIGHT : 0.0)));
    }
  }
  for (const auto& triangle : shape.triangle) {
    mesh.indices.insert(mesh.indices.end(), triangle.begin(), triangle.end());
  }
  return mesh;
}

std::string fileOf(const SurfaceView& view) {
  return WELKIN_BENCH_FOLDER "/reference/surfaces/" + view.name + ".csv";
}

// Light in a slab of optical thickness tau, sun and view by their angles with the normal, degrees.
struct SlabView {
  double tau, sun, view, azimuth;
  bool top;
};

// Mean of a picture of the middle of a wide box.
double slabPicture(const SlabView& slab) {
  constexpr double THICK = 1000;  // m
  constexpr double WIDE = 200e3;  // m: light from the edges does not reach the middle
  constexpr double AWAY = 2000;   // m from the face to the eye
  static const BodyMesh mesh = meshOf(rt::boxShape(), {WIDE / 2, THICK / 2, WIDE / 2});
  SurfaceView view;
  view.extinction = slab.tau / THICK;
  view.width = view.height = 4;
  view.verticalFov_deg = 0.5;
  // The beam travels towards +x.
  view.sun = {-std::sin(slab.sun * RADIANS), std::cos(slab.sun * RADIANS), 0};
  const double side = slab.top ? 1 : -1;
  const double sine = std::sin(slab.view * RADIANS);
  const rt::Point travel = {sine * std::cos(slab.azimuth * RADIANS),
                            side * std::cos(slab.view * RADIANS),
                            sine * std::sin(slab.azimuth * RADIANS)};
  view.target = {0, HEIGHT + side * THICK / 2, 0};
  view.eye = rt::along(view.target, travel, AWAY);
  world().show(view, mesh, {}, 1);
  world().render();
  const std::vector<double> picture = world().picture();
  double sum = 0;
  for (const double value : picture) {
    sum += value;
  }
  return sum / static_cast<double>(picture.size());
}

// Light scattered at least twice as the rule has it, in double: the table's source at one point.
double slabRule(const SlabView& slab) {
  static const welkin::SurfaceSource source =
      welkin::surfaceSource(welkin::decodeCanonical(welkin::shippedCanonical()));
  constexpr double SAMPLE = 0.7;  // of the opacity: docs/models.md
  const double mu = std::cos(slab.view * RADIANS);
  const double opacity = -std::expm1(-slab.tau / mu);
  const double below = -std::log1p(-SAMPLE * opacity) * mu;
  double sum = 0;
  for (size_t set = 0; set < welkin::CANONICAL_SETS; ++set) {
    sum += opacity * welkin::surfaceSourceAt(source, set,
                                             {slab.tau, slab.top ? below : slab.tau - below,
                                              std::cos(slab.sun * RADIANS), slab.top ? -mu : mu,
                                              slab.azimuth * RADIANS});
  }
  return sum;
}

TEST(SurfaceView, MiddleOfASlabIsTheCanonicalSlab) {
  // Float, light maps of 16-bit parts and six stretches of the chord; measured 2e-3.
  // Filters of a GPU take ln J in steps of 1/256 of its difference between nodes, which is up to 7
  // in depth; measured 0.022.
  const double picture = onGpu() ? 0.01 + 0.5 * 7 * FILTER_STEP : 0.01;
  // Of the rule's source: linear filters of 0.02 to 0.06 rms in each of five axes (docs/models.md),
  // which lie one way where ln J is curved.
  constexpr double SOURCE = 0.07;
  // J at one point of a chord: in thin slabs, where P is at its least, light that was scattered
  // twice varies along it.
  constexpr double THIN = 0.25;
  const rt::SlabSolver solver(rt::tabulatedSlabPhase(curve().angle, curve().value, 700), 1, 48);
  double worst = 0;
  for (const double tau : {2.0, 10.0, 40.0}) {
    for (const double sun : {20.0, 60.0}) {
      for (const bool top : {true, false}) {
        for (const auto& [zenith, azimuth] : {std::pair{10.0, 30.0}, {45.0, 120.0}, {60.0, 60.0}}) {
          const SlabView slab = {tau, sun, zenith, azimuth, top};
          const double found = slabPicture(slab);
          const rt::SlabRadiance truth =
              solver.radiance(tau, std::cos(sun * RADIANS),
                              {(top ? 1 : -1) * std::cos(zenith * RADIANS), azimuth * RADIANS});
          const double rule = truth.single + slabRule(slab);
          const auto text = "slab-" + std::to_string(tau) + " sun " + std::to_string(sun) +
                            (top ? " top " : " bottom ") + std::to_string(zenith);
          EXPECT_NEAR(found / rule, 1, picture) << text;
          EXPECT_NEAR(found / truth.total, 1, tau < 10 ? THIN : SOURCE) << text;
          worst = std::max(worst, std::fabs(found / rule - 1));
          std::printf("%s: %.3f of the truth, %.4f of the rule\n", text.c_str(),
                      found / truth.total, found / rule);
        }
      }
    }
  }
  std::printf("worst against the rule %.4f\n", worst);
}

// The truth's rows are those of the upper half, its x the other way round than the camera's.
void showSphere(const std::string& name, int angle,
                const std::vector<welkin::test::SurfaceTruth>& truth, double& total, double& rms) {
  constexpr int PIXELS = 20;
  constexpr double RADIUS = 500;  // m
  constexpr double HALF = 1.02;   // of the picture, radii: reference::makeBody
  constexpr double AWAY = 200;    // radii
  const double optical = std::stod(name.substr(name.find('-') + 1));
  SurfaceView view;
  view.extinction = optical / RADIUS;
  view.width = view.height = PIXELS;
  view.verticalFov_deg = 2 * std::atan(HALF / AWAY) / RADIANS;
  view.sun = {0, 0, 1};
  view.target = {0, HEIGHT, 0};
  view.eye = rt::along(view.target, {std::sin(angle * RADIANS), 0, -std::cos(angle * RADIANS)},
                       AWAY * RADIUS);
  world().show(view, meshOf(rt::sphereShape(48), {RADIUS, RADIUS, RADIUS}), {}, 4);
  world().render();
  const std::vector<double> picture = world().picture();
  double shown = 0;
  double sum = 0;
  double squares = 0;
  double difference = 0;
  for (const welkin::test::SurfaceTruth& row : truth) {
    if (row.body == name && row.angle == angle) {
      const auto pixel = static_cast<size_t>((PIXELS - 1 - row.y) * PIXELS + (PIXELS - 1 - row.x));
      shown += picture[pixel];
      sum += row.radiance;
      squares += row.radiance * row.radiance;
      difference += std::pow(picture[pixel] - row.radiance, 2) - row.error * row.error;
    }
  }
  total = shown / sum;
  rms = std::sqrt(std::max(difference, 0.0) / squares);
}

TEST(SurfaceView, SpheresAgreeWithMonteCarlo) {
  constexpr double TOTAL = 0.15;
  constexpr double FRONT_RMS = 0.20;
  constexpr double OTHER_RMS = 0.40;
  constexpr double NOISE = 0.001;  // of the truth's noise, which is taken off
  const auto truth =
      welkin::test::readSurfaceTruth(WELKIN_BENCH_FOLDER "/../unit/surface_truth.csv");
  for (const char* name : {"sphere-2", "sphere-10", "sphere-30"}) {
    for (const int angle : {180, 120, 90, 60, 20}) {
      double total = 0;
      double rms = 0;
      showSphere(name, angle, truth, total, rms);
      std::printf("%-10s %3d  total %.3f  rms %.3f\n", name, angle, total, rms);
      EXPECT_NEAR(total, 1, TOTAL) << name << ' ' << angle;
      EXPECT_LE(rms, NOISE + (angle >= 120 ? FRONT_RMS : OTHER_RMS)) << name << ' ' << angle;
    }
  }
}

// Bars of a body's pictures: of 1 against the ratio of totals, and of the rms.
struct ViewBars {
  const char* body;
  double total, rms;
};

TEST(SurfaceView, CloudsAgreeWithMonteCarlo) {
  // Measured, and a fifth more. What is beside a hill is known by its mean only (docs/models.md).
  constexpr ViewBars BARS[] = {{"cumulus", 0.15, 0.26}, {"stratocumulus", 0.13, 0.33}};
  constexpr uint32_t RAYS = 4;  // along a pixel's edge
  for (const SurfaceView& view : surfaceViews()) {
    const SurfaceTruthImage truth = readSurfaceTruth(fileOf(view));
    world().show(view, bodyMesh(view.body), {}, RAYS);
    world().render();
    const std::vector<double> picture = world().picture();
    constexpr SurfaceRegion LIT = SurfaceRegion::LIT;
    const SurfaceErrors all = surfaceErrorsIn(picture, view, truth, nullptr);
    const SurfaceErrors lit = surfaceErrorsIn(picture, view, truth, &LIT);
    std::printf("%-20s total %.3f, rms %.3f; lit %.3f, %.3f\n", view.name.c_str(), all.total,
                all.rms, lit.total, lit.rms);
    for (const ViewBars& bars : BARS) {
      if (view.body == bars.body) {
        EXPECT_NEAR(all.total, 1, bars.total) << view.name;
        EXPECT_LE(all.rms, bars.rms) << view.name;
      }
    }
  }
}

// The picture is a voxelised body's too: what it holds is the mesh's volume.
TEST(SurfaceView, VoxelsHoldTheBody) {
  const rt::MeshBody body = referenceBody(bodyMesh("cumulus"));
  const BodyVoxels voxels = voxelsOf(body, 48);
  double sum = 0;
  for (const float cover : voxels.cover) {
    EXPECT_GE(cover, 0.0F);
    EXPECT_LE(cover, 1.0F + 1e-5F);
    sum += double{cover};
  }
  const double voxel = voxels.edge[0] / voxels.size[0];
  EXPECT_NEAR(sum * voxel * voxel * voxel / body.volume(), 1, 2e-3);  // columns of a quarter voxel
}

// The truth is that of these very meshes.
TEST(SurfaceViewTruth, IsThatOfTheBodies) {
  for (const SurfaceView& view : surfaceViews()) {
    const SurfaceTruthImage truth = readSurfaceTruth(fileOf(view));
    const BodyMesh mesh = bodyMesh(view.body);
    EXPECT_EQ(truth.triangles, mesh.indices.size() / 3) << view.name;
    // Nine digits in the file; places are floats of libm's numbers.
    EXPECT_NEAR(referenceBody(mesh).volume() / truth.volume_m3, 1, 1e-6) << view.name;
    EXPECT_GT(truth.pixels.size(), 1000U) << view.name;
    // Some pixels again, with other paths.
    constexpr uint64_t PATHS = 300;
    SurfaceView part = view;
    double sum = 0;
    double expected = 0;
    double variance = 0;
    const SurfaceTruthImage again = traceView(part, mesh, PATHS, 99, 2, 23);
    for (const SurfacePixel& p : again.pixels) {
      for (const SurfacePixel& q : truth.pixels) {
        if (p.x == q.x && p.y == q.y) {
          sum += p.once + p.rest;
          expected += q.once + q.rest;
          variance += p.onceError * p.onceError + p.restError * p.restError +
                      q.onceError * q.onceError + q.restError * q.restError;
        }
      }
    }
    EXPECT_NEAR(sum, expected, 3.5 * std::sqrt(variance)) << view.name;
    EXPECT_LT(std::sqrt(variance), 0.05 * expected) << view.name;
  }
}

}  // namespace
}  // namespace bench
