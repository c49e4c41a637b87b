// SPDX-License-Identifier: MIT
// WLK_SCATTERING_ALL_ORDERS against path-traced spheres (tests/bench/reference/volumes), in 1/sr
// per unit irradiance: total and root mean square of the pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "slicing_scene.hpp"

namespace {

using namespace image_test;

// The scene of tests/bench/volume_truth.hpp, in radii of 1 km.
constexpr double RADIUS = 1000;  // m
constexpr int VOXELS = 64;
constexpr int SUBSAMPLES = 8;     // along a voxel's edge
constexpr double BOX = 2.5;       // radii
constexpr double DISTANCE = 100;  // radii
constexpr int TRUTH_PIXELS = 32;
constexpr int PER_PIXEL = 3;  // rays along a pixel's edge: the truth has means over areas
constexpr double TRUTH_G = 0.85;

std::vector<float> coveredParts() {
  std::vector<double> square;
  for (int i = 0; i < VOXELS * SUBSAMPLES; ++i) {
    const double x = ((i + 0.5) / (VOXELS * SUBSAMPLES) - 0.5) * BOX;
    square.push_back(x * x);
  }
  std::vector<float> parts(size_t{VOXELS} * VOXELS * VOXELS);
  for (size_t z = 0; z < square.size(); ++z) {
    for (size_t y = 0; y < square.size(); ++y) {
      for (size_t x = 0; x < square.size(); ++x) {
        parts[(z / SUBSAMPLES * VOXELS + y / SUBSAMPLES) * VOXELS + x / SUBSAMPLES] +=
            square[x] + square[y] + square[z] < 1 ? 1.0f / (SUBSAMPLES * SUBSAMPLES * SUBSAMPLES)
                                                  : 0.0f;
      }
    }
  }
  return parts;
}

// Rows x,y,radiance,error after two lines of header.
std::vector<double> truthOf(const std::string& name) {
  const std::string file = std::string(WELKIN_BENCH_FOLDER) + "/reference/volumes/" + name + ".csv";
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::getline(stream, line);
  std::vector<double> values;
  while (std::getline(stream, line)) {
    double radiance = 0;
    if (std::sscanf(line.c_str(), "%*d,%*d,%lf", &radiance) != 1) {
      throw std::runtime_error(file + ": unexpected row '" + line + "'");
    }
    values.push_back(radiance);
  }
  if (values.size() != size_t{TRUTH_PIXELS} * TRUTH_PIXELS) {
    throw std::runtime_error(file + ": pixels are missing");
  }
  return values;
}

std::vector<double> perPixel(const std::vector<double>& fine) {
  constexpr size_t N = TRUTH_PIXELS;
  std::vector<double> means(N * N);
  for (size_t i = 0; i < fine.size(); ++i) {
    const size_t x = i % (N * PER_PIXEL) / PER_PIXEL;
    const size_t y = i / (N * PER_PIXEL) / PER_PIXEL;
    means[y * N + x] += fine[i] / (PER_PIXEL * PER_PIXEL);
  }
  return means;
}

struct Errors {
  double total;  // of the mean, relative, signed
  double rms;    // over the truth's mean
};

class Sphere : public ::testing::Test {
 protected:
  Sphere() : scene_(TRUTH_PIXELS * PER_PIXEL) {
    scene_.setLight({0, 0, 1});
    Quality quality;
    quality.scattering = WLK_SCATTERING_ALL_ORDERS;
    quality.slices = quality.lightSize = 0;  // of the level
    scene_.setQuality(quality);
  }
  ~Sphere() override { EXPECT_TRUE(scene_.messages().empty()) << scene_.messages().front(); }

  void expectNear(int opticalRadius, int angle_deg, const Errors& bound) {
    static const std::vector<float> parts = coveredParts();
    const WlkVolume volume =
        scene_.addVolume(cubeField(VOXELS, parts, opticalRadius / RADIUS, BOX * RADIUS, {0, 0, 0}),
                         scene_.henyeyGreenstein(TRUTH_G));
    const double sine = angle_deg == 180 ? 0 : std::sin(angle_deg * DEGREE);
    const double cosine = angle_deg == 180 ? -1 : std::cos(angle_deg * DEGREE);
    Camera camera;
    camera.position = -DISTANCE * RADIUS * Point{sine, 0, cosine};
    camera.forward = {sine, 0, cosine};
    camera.tangent = BOX / 2 / DISTANCE;
    scene_.setCamera(camera);
    const Picture picture = scene_.render();
    scene_.removeVolume(volume);
    EXPECT_EQ(picture.nonFinite, 0u);
    const std::string name =
        "sphere-" + std::to_string(opticalRadius) + "-" + std::to_string(angle_deg);
    const std::vector<double> truth = truthOf(name);
    const std::vector<double> values = perPixel(picture.red());
    const Errors errors{mean(values) / mean(truth) - 1, relativeRms(values, truth)};
    std::printf("%s: total %+.1f %%, rms %.1f %%\n", name.c_str(), 100 * errors.total,
                100 * errors.rms);
    EXPECT_NEAR(errors.total, 0, bound.total) << name;
    EXPECT_LT(errors.rms, bound.rms) << name;
  }

  SlicingScene scene_;
};

// At HIGH; the others are measured by the benchmark. Bounds are half as much again as was measured.
TEST_F(Sphere, FrontLit) {
  expectNear(10, 180, {.total = 0.038, .rms = 0.077});  // -2.3 %, 4.5 %
  expectNear(10, 120, {.total = 0.023, .rms = 0.062});  // -1.4 %, 3.8 %
}

TEST_F(Sphere, LitFromTheSideAndFromBehind) {
  expectNear(2, 60, {.total = 0.015, .rms = 0.05});    // -1.2 %, 3.3 %
  expectNear(10, 60, {.total = 0.012, .rms = 0.078});  // +0.6 %, 5.1 %
  expectNear(30, 20, {.total = 0.026, .rms = 0.2});    // +1.7 %, 13.6 %
}

}  // namespace
