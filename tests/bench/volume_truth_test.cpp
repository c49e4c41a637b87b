// SPDX-License-Identifier: MIT
// The tracer of the volumes' truth against the path tracer of tests/reference and the conservation
// of energy, the kept files against both.
#include "bench/volume_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "bench/volume_tracer.hpp"
#include "reference/monte_carlo.hpp"
#include "reference/slab_solver.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;
using rt::Point;

constexpr double PI = std::numbers::pi;
constexpr double RADIANS = PI / 180;
constexpr double ERRORS = 3.5;  // standard errors; seeds are fixed

std::string fileOf(const std::string& name) {
  return std::string(WELKIN_BENCH_FOLDER) + "/reference/volumes/" + name;
}

constexpr std::array<int, 3> SIZE{7, 5, 6};
constexpr Point EXTENT{2, 1.5, 2.5};

// Extinctions from 0 to 6 per unit of length, a third of the voxels empty.
std::vector<float> patches() {
  std::vector<float> values;
  rt::Random random(5, 0, 0, 0);
  for (int i = 0; i < SIZE[0] * SIZE[1] * SIZE[2]; ++i) {
    values.push_back(static_cast<float>(std::max(9 * random.uniform() - 3, 0.0)));
  }
  return values;
}

rt::VoxelVolume referenceVolume(const std::array<int, 3>& size, const Point& e,
                                const std::vector<float>& values, const rt::PhaseFunction& phase) {
  rt::ParticleField field;
  field.values = values;
  field.extinctionScale.fill(1);
  field.phase = phase;
  return {size, {e[0], 0, 0, -e[0] / 2, 0, e[1], 0, -e[1] / 2, 0, 0, e[2], -e[2] / 2}, {field}};
}

rt::PhaseFunction droplets() {
  const PhaseCurve curve = readPhaseCurve(fileOf(DROPLET_FILE));
  std::vector<rt::Rgb> values;
  for (const double value : curve.value) {
    values.push_back({value, value, value});
  }
  return rt::PhaseFunction::table(curve.angle, values);
}

TEST(VolumeTracer, DepthAlongAnAxisIsThatOfTheReference) {
  constexpr double ROUNDING = 1e-15 * 1e2;  // sums of some 20 terms of order 5
  const VoxelBox box(SIZE, EXTENT, patches());
  const rt::VoxelVolume volume =
      referenceVolume(SIZE, EXTENT, patches(), rt::PhaseFunction::isotropic());
  rt::Random random(1, 2, 3, 4);
  for (int i = 0; i < 3000; ++i) {
    Point p{};
    for (size_t k = 0; k < 3; ++k) {
      p[k] = (random.uniform() - 0.5) * EXTENT[k];
    }
    EXPECT_NEAR(box.depthAlongZ(box.voxelsFrom(p)), volume.opticalDepth(p, {0, 0, 1}, 0, rt::FAR),
                ROUNDING);
  }
}

TEST(VolumeTracer, AgreesWithThePathTracer) {
  const VoxelBox box(SIZE, EXTENT, patches());
  constexpr uint64_t PATHS = 15000;
  double squares = 0;
  int count = 0;
  for (const Point& sun : {Point{0, 0, 1}, rt::normalized({-0.3, 0.7, 0.5})}) {
    for (const bool peaked : {false, true}) {
      const rt::PhaseFunction phase =
          peaked ? droplets() : rt::PhaseFunction::henyeyGreenstein(TRUTH_G);
      const VolumeTracer tracer(box, phase, sun);
      rt::Scene scene;
      scene.volumes.push_back(referenceVolume(SIZE, EXTENT, patches(), phase));
      rt::DistantLight light;
      light.direction = sun;
      scene.lights = {light};
      for (const Point& direction : {Point{0.2, 0.1, -1}, Point{1, 0.3, 0.2}, Point{-0.4, 0, 1}}) {
        rt::EyeRay ray;
        ray.direction = rt::normalized(direction);
        ray.origin = rt::along({0.2, -0.1, 0.1}, ray.direction, -5);
        rt::RenderOptions options;
        options.samples = PATHS;
        options.firstOrder = 1;
        const rt::Estimate estimate = rt::render(scene, {ray}, options).pixels[0];
        const Sample sample = tracer.trace(
            [&](rt::Random&) {
              return TracerRay{ray.origin, ray.direction};
            },
            PATHS, 2, 0);
        const double error = std::hypot(sample.error(), std::sqrt(estimate.variance[0]));
        const double z = (sample.mean() - estimate.radiance[0]) / error;
        EXPECT_LT(std::fabs(z), ERRORS) << sun[2] << ' ' << peaked << ' ' << direction[0];
        EXPECT_LT(error, 0.08 * sample.mean());
        squares += z * z;
        ++count;
      }
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.62);  // 3 sigma of the root of a mean of 12 squares
}

// All directions, all rays that may meet the box: what comes out is what the beam loses.
TEST(VolumeTracer, LosesNoEnergy) {
  const VoxelBox box(SIZE, EXTENT, patches());
  const rt::PhaseFunction phase = rt::PhaseFunction::henyeyGreenstein(0.7);
  const VolumeTracer tracer(box, phase, {0, 0, 1});
  const double radius = 0.5 * std::sqrt(rt::dot(EXTENT, EXTENT));
  const auto ray = [&](rt::Random& random) {
    const double z = 2 * random.uniform() - 1;
    const double azimuth = 2 * PI * random.uniform();
    const double sine = std::sqrt(1 - z * z);
    const Point d{sine * std::cos(azimuth), sine * std::sin(azimuth), z};
    const Point u =
        rt::normalized(rt::cross(d, std::fabs(d[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0}));
    const Point v = rt::cross(d, u);
    const double r = radius * std::sqrt(random.uniform());
    const double turn = 2 * PI * random.uniform();
    Point origin = rt::along({0, 0, 0}, d, -2 * radius);
    origin = rt::along(rt::along(origin, u, r * std::cos(turn)), v, r * std::sin(turn));
    return TracerRay{origin, d};
  };
  const Sample sample = tracer.trace(ray, 400000, 3, 0);
  const double scattered = 4 * PI * PI * radius * radius * sample.mean();
  const double error = 4 * PI * PI * radius * radius * sample.error();
  // By midpoints; 400 along an edge against 200: 1e-5.
  constexpr int POINTS = 400;
  double lost = 0;
  for (int y = 0; y < POINTS; ++y) {
    for (int x = 0; x < POINTS; ++x) {
      const Point p{((x + 0.5) / POINTS - 0.5) * EXTENT[0], ((y + 0.5) / POINTS - 0.5) * EXTENT[1],
                    -EXTENT[2] / 2};
      lost -= std::expm1(-box.depthAlongZ(box.voxelsFrom(p)));
    }
  }
  lost *= EXTENT[0] * EXTENT[1] / (POINTS * POINTS);
  EXPECT_NEAR(scattered, lost, ERRORS * error);
  EXPECT_LT(error, 0.01 * lost);
}

TEST(VolumeTruth, SphereHasTheVolumeOfASphere) {
  double sum = 0;
  for (const float value : sphereVoxels()) {
    sum += double{value};
  }
  const double voxel = std::pow(SPHERE_BOX / SPHERE_VOXELS, 3);
  // Points on a lattice of 512 along an edge.
  EXPECT_NEAR(sum * voxel / (4 * PI / 3), 1, 1e-4);
}

// Totals do not feel the noise; that of the pixels is to be taken off the errors of pictures.
TEST(VolumeTruth, PicturesAreCompleteAndQuiet) {
  std::vector<std::string> names;
  for (const int radius : SPHERE_RADII) {
    for (const int angle : SPHERE_ANGLES) {
      names.push_back(sphereName(radius, angle));
    }
  }
  for (const CloudCase& one : cumulusCases()) {
    names.push_back(one.name);
  }
  for (const std::string& name : names) {
    const TruthImage image = readTruthImage(fileOf(name + ".csv"));
    const bool sphere = name[0] == 's';
    EXPECT_EQ(image.width, sphere ? SPHERE_PIXELS : 48) << name;
    EXPECT_EQ(image.height, sphere ? SPHERE_PIXELS : 27) << name;
    double square = 0;
    for (size_t i = 0; i < image.radiance.size(); ++i) {
      EXPECT_GE(image.radiance[i], 0) << name;
      EXPECT_TRUE(std::isfinite(image.radiance[i]) && std::isfinite(image.error[i])) << name;
      square += image.error[i] * image.error[i];
    }
    const double count = static_cast<double>(image.radiance.size());
    const double rms = std::sqrt(square / count) / image.mean();
    // Measured: 3.0 % and 8.4 %. A pixel of a sphere may stand for eight.
    EXPECT_LT(rms, sphere ? 0.033 : 0.09) << name;
    EXPECT_LT(rms * std::sqrt((sphere ? 8 : 1) / count), 0.003) << name;
  }
}

// Pixels here and there by the path tracer of tests/reference, over their areas.
TEST(VolumeTruth, SpheresAreThoseOfThePathTracer) {
  constexpr int RADIUS = 10;
  constexpr int EDGE = 12;  // rays along a pixel's edge
  std::vector<float> values = sphereVoxels();
  for (float& value : values) {
    value *= RADIUS;
  }
  constexpr int N = SPHERE_VOXELS;
  rt::Scene scene;
  scene.volumes.push_back(referenceVolume({N, N, N}, {SPHERE_BOX, SPHERE_BOX, SPHERE_BOX}, values,
                                          rt::PhaseFunction::henyeyGreenstein(TRUTH_G)));
  rt::DistantLight sun;
  sun.direction = {0, 0, 1};
  scene.lights = {sun};
  rt::RenderOptions options;
  options.samples = 72;
  options.firstOrder = 1;
  for (const int angle : {120, 60}) {
    const TruthImage image = readTruthImage(fileOf(sphereName(RADIUS, angle) + ".csv"));
    const double s = std::sin(angle * RADIANS);
    const double c = std::cos(angle * RADIANS);
    for (const auto& [x, y] : {std::pair{13, 6}, std::pair{24, 20}}) {
      std::vector<rt::EyeRay> rays;
      for (int i = 0; i < EDGE * EDGE; ++i) {
        const double u = ((x + (i % EDGE + 0.5) / EDGE) / SPHERE_PIXELS - 0.5) * SPHERE_BOX;
        const double v = (0.5 - (y + (i / EDGE + 0.5) / EDGE) / SPHERE_PIXELS) * SPHERE_BOX;
        rt::EyeRay ray;
        ray.origin = {-SPHERE_DISTANCE * s, 0, -SPHERE_DISTANCE * c};
        ray.direction = rt::normalized(rt::minus({-c * u, v, s * u}, ray.origin));
        rays.push_back(ray);
      }
      double sum = 0;
      double variance = 0;
      for (const rt::Estimate& estimate : rt::render(scene, rays, options).pixels) {
        sum += estimate.radiance[0] / (EDGE * EDGE);
        variance += estimate.variance[0] / (EDGE * EDGE) / (EDGE * EDGE);
      }
      const auto pixel = static_cast<size_t>(y * SPHERE_PIXELS + x);
      EXPECT_NEAR(sum, image.radiance[pixel],
                  ERRORS * std::hypot(std::sqrt(variance), image.error[pixel]))
          << angle << ' ' << x;
      EXPECT_LT(std::sqrt(variance), 0.05 * sum) << angle << ' ' << x;
    }
  }
}

TEST(VolumeTruth, SlabsAreThoseOfTheSolverAndOfMonteCarlo) {
  constexpr double NODES = 2e-3;  // 48 against 192 of them
  const std::vector<SlabTruth> rows = readSlabTruth(fileOf("slabs.csv"));
  ASSERT_EQ(rows.size(), 2u * 5 * 3 * 6);
  const PhaseCurve curve = readPhaseCurve(fileOf(DROPLET_FILE));
  const rt::SlabSolver solvers[] = {
      {rt::henyeyGreensteinSlabPhase(TRUTH_G), 1, 48},
      {rt::tabulatedSlabPhase(curve.angle, curve.value, 1500), 1, 48}};
  double squares = 0;
  int count = 0;
  for (const SlabTruth& row : rows) {
    const double mu = std::cos(row.viewZenith_deg * RADIANS) * (row.reflected ? 1 : -1);
    const rt::SlabRadiance radiance = solvers[row.droplets ? 1 : 0].radiance(
        row.tau, std::cos(row.sunZenith_deg * RADIANS), {mu, row.azimuth_deg * RADIANS});
    EXPECT_NEAR(radiance.total / row.radiance, 1, NODES) << row.tau << ' ' << row.sunZenith_deg;
    if (row.error > 0) {
      const double z = (row.monteCarlo - row.radiance) / row.error;
      EXPECT_LT(std::fabs(z), ERRORS) << row.tau << ' ' << row.sunZenith_deg;
      squares += z * z;
      ++count;
    }
  }
  EXPECT_EQ(count, 36);
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.36);  // 3 sigma of the root of a mean of 36 squares
}

TEST(VolumeTruth, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW(readTruthImage("no such file"), std::runtime_error);
  EXPECT_THROW(readTruthImage(fileOf("slabs.csv")), std::runtime_error);
  EXPECT_THROW(readSlabTruth(fileOf(DROPLET_FILE)), std::runtime_error);
  EXPECT_THROW(readPhaseCurve(fileOf("slabs.csv")), std::runtime_error);
  TruthImage image;
  image.paths = 8;
  image.width = 2;
  image.height = 3;
  image.radiance = {1, 2, 3, 4, 5, 6};
  image.error = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
  const std::string file = ::testing::TempDir() + "volume_truth.csv";
  writeTruthImage(file, image, 5);
  const TruthImage same = readTruthImage(file);
  EXPECT_EQ(same.radiance, image.radiance);
  EXPECT_EQ(same.error, image.error);
  EXPECT_EQ(same.paths, image.paths);
  std::ofstream(file, std::ios::app) << "1,3,7,0.1\n";
  EXPECT_THROW(readTruthImage(file), std::runtime_error);
  image.radiance.pop_back();
  writeTruthImage(file, image, 5);
  EXPECT_THROW(readTruthImage(file), std::runtime_error);
  std::remove(file.c_str());
}

}  // namespace
}  // namespace bench
