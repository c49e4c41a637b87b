// SPDX-License-Identifier: MIT
// Volumes with surfaces, with each other, with several fields, and moved about.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "cloud_scene.hpp"

namespace {

using namespace image_test;

constexpr int SIZE = 32;
constexpr double SLICING_BOUND = 0.01;  // a third of the bound at 128 slices: angles away from 90

std::vector<double> redTransmittance(const Picture& picture) {
  std::vector<double> values;
  for (const std::array<double, 3>& t : picture.transmittance) {
    values.push_back(t[0]);
  }
  return values;
}

double worstOf(const Picture& a, const Picture& b) {
  const double scale = mean(b.red());
  double worst = 0;
  for (size_t i = 0; i < a.radiance.size(); ++i) {
    worst = std::max(worst, std::abs(a.radiance[i][0] - b.radiance[i][0]) / scale);
    worst = std::max(worst, std::abs(a.transmittance[i][0] - b.transmittance[i][0]));
  }
  return worst;
}

struct Stage {
  explicit Stage(double angle = 60) : scene(SIZE), light(lightAtAngle(angle)) {
    medium = scene.henyeyGreenstein(CLOUD_G);
    scene.setCamera(camera);
    scene.setLight(light);
    scene.setQuality({});
  }
  SlicingScene scene;
  Point light;
  Camera camera = cloudCamera();
  WlkMedium medium{};
};

TEST(Compositing, PixelsStopAtTheSurface) {
  Stage s;
  const VoxelField field = noiseCloudField();
  s.scene.addVolume(field, s.medium);
  const RayMarch march(field);
  // A wall that recedes to the right through the cloud, a hole in it, and a ball before it.
  std::vector<float> depth;
  std::vector<double> lengths;
  for (int y = 0; y < SIZE; ++y) {
    for (int x = 0; x < SIZE; ++x) {
      const bool hole = y > 24;
      const bool ball = (x - 9) * (x - 9) + (y - 9) * (y - 9) < 40;
      const double distance = ball ? 1450 : 1250 + 15 * x;
      lengths.push_back(hole ? 1e30 : distance);
      depth.push_back(hole ? 0.0f : s.camera.depthAt(x, y, SIZE, distance));
    }
  }
  const Picture picture = s.scene.render(depth);
  const std::vector<double> truth =
      marchPicture(march, s.camera, SIZE, s.light, CLOUD_G, 1, lengths);
  std::vector<double> clear;
  for (int i = 0; i < SIZE * SIZE; ++i) {
    clear.push_back(
        std::exp(-march.opticalDepth(s.camera.position, s.camera.ray(i % SIZE, i / SIZE, SIZE),
                                     lengths[static_cast<size_t>(i)])));
  }
  const double error = relativeRms(picture.red(), truth);
  const double clearError = relativeRms(redTransmittance(picture), clear);
  std::printf("cut by surfaces: radiance %.2f %%, transmittance %.2f %%\n", 100 * error,
              100 * clearError);
  EXPECT_LE(error, SLICING_BOUND);
  EXPECT_LE(clearError, SLICING_BOUND);
  EXPECT_GT(relativeRms(s.scene.render().red(), truth), 5 * SLICING_BOUND);  // depth matters
}

TEST(Compositing, CameraMayStandInsideTheCloud) {
  Stage s(110);
  const VoxelField field = noiseCloudField();
  s.scene.addVolume(field, s.medium);
  s.camera.position = CLOUD_CENTRE + Point{60, -90, 110};
  s.camera.tangent = 0.8;
  s.scene.setCamera(s.camera);
  for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
    s.scene.setQuality({slicing});
    const double error = relativeRms(
        s.scene.render().red(), marchPicture(RayMarch(field), s.camera, SIZE, s.light, CLOUD_G));
    std::printf("camera inside, slicing %u: %.2f %%\n", slicing, 100 * error);
    EXPECT_LE(error, SLICING_BOUND);
  }
}

TEST(Compositing, NearerVolumeCoversFartherOneWhateverTheOrderOfCreation) {
  // Volumes do not shade each other: the truth is the march of each, one over the other.
  VoxelField front = noiseCloudField();
  for (double& x : front.extinction) {
    x *= 0.125;  // lets the other one through
  }
  VoxelField back = steepCloudField();
  for (double& x : back.extinction) {
    x *= 0.0625;
  }
  back.worldFromBox[3] += 100;
  back.worldFromBox[11] -= 700;
  std::vector<Picture> pictures;
  for (const bool frontFirst : {true, false}) {
    Stage s;
    s.scene.addVolume(frontFirst ? front : back, s.medium);
    s.scene.addVolume(frontFirst ? back : front, s.medium);
    pictures.push_back(s.scene.render());
  }
  EXPECT_EQ(worstOf(pictures[0], pictures[1]), 0.0);
  const Camera camera = cloudCamera();
  const Point light = lightAtAngle(60);
  const RayMarch frontMarch(front);
  std::vector<double> truth = marchPicture(frontMarch, camera, SIZE, light, CLOUD_G);
  const std::vector<double> behind = marchPicture(RayMarch(back), camera, SIZE, light, CLOUD_G);
  for (size_t i = 0; i < truth.size(); ++i) {
    const int pixel = static_cast<int>(i);
    truth[i] += behind[i] * std::exp(-frontMarch.opticalDepth(
                                camera.position, camera.ray(pixel % SIZE, pixel / SIZE, SIZE)));
  }
  const double error = relativeRms(pictures[0].red(), truth);
  std::printf("two volumes: %.2f %%\n", 100 * error);
  EXPECT_LE(error, SLICING_BOUND);
}

// Sums in another order: 2^-24 for each of some 100 slabs' optical depths, depth 12 at most, and
// pixels up to 10 times the mean.
constexpr double ROUNDING = 100 * 0x1p-24 * 12 * 10 / 8;

TEST(Compositing, FieldsOfOneMediumAddUp) {
  const VoxelField whole = noiseCloudField();
  for (const uint32_t scattering : {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD}) {
    std::vector<Picture> pictures;
    for (const size_t count : {1u, 2u, 4u}) {
      Stage s;
      Quality quality;
      quality.scattering = scattering;
      quality.slices = 64;
      s.scene.setQuality(quality);
      // Parts that vary from voxel to voxel and add up exactly: multiples of 1/8 of the value.
      std::mt19937 random(1);
      std::vector<VoxelField> parts(count, whole);
      for (size_t v = 0; v < whole.extinction.size(); ++v) {
        double left = 1;
        for (size_t f = 0; f < count; ++f) {
          const double most = 8 * left;
          const double part =
              f + 1 == count ? left : std::floor(most * static_cast<double>(random() % 8) / 8) / 8;
          parts[f].extinction[v] *= part;
          left -= part;
        }
      }
      s.scene.addVolume(parts, std::vector<WlkMedium>(count, s.medium));
      pictures.push_back(s.scene.render());
    }
    const double two = worstOf(pictures[1], pictures[0]);
    const double four = worstOf(pictures[2], pictures[0]);
    std::printf("fields, scattering %u: two %.1e, four %.1e of the mean\n", scattering, two, four);
    EXPECT_LE(two, ROUNDING);
    EXPECT_LE(four, ROUNDING);
  }
}

TEST(Compositing, OpticalDepthAloneMatters) {
  Stage s;
  VoxelField field = noiseCloudField();
  const WlkVolume volume = s.scene.addVolume(field, s.medium);
  const Picture full = s.scene.render();
  s.scene.removeVolume(volume);
  // Half the size at half the distance, twice the density.
  for (double& x : field.extinction) {
    x *= 2;
  }
  for (size_t k = 0; k < 12; ++k) {
    const double eye = k % 4 == 3 ? s.camera.position[k / 4] : 0;
    field.worldFromBox[k] = eye + (field.worldFromBox[k] - eye) / 2;
  }
  s.scene.addVolume(field, s.medium);
  const double difference = worstOf(s.scene.render(), full);
  std::printf("half the size, twice the density: %.1e of the mean\n", difference);
  EXPECT_LE(difference, ROUNDING);
}

TEST(Compositing, TurningEverythingTurnsNothingInThePicture) {
  Stage s;
  const VoxelField field = noiseCloudField();
  const WlkVolume volume = s.scene.addVolume(field, s.medium);
  const Picture straight = s.scene.render();
  s.scene.removeVolume(volume);
  const Point axis = normalized({0.1, 1, 0.05});
  const auto turn = [&](const Point& p) { return turned(p, axis, 0.7); };
  VoxelField turnedField = field;
  for (size_t column = 0; column < 4; ++column) {
    const auto& m = field.worldFromBox;
    const Point p = turn({m[column], m[4 + column], m[8 + column]});
    for (size_t k = 0; k < 3; ++k) {
      turnedField.worldFromBox[4 * k + column] = p[k];
    }
  }
  s.scene.addVolume(turnedField, s.medium);
  s.camera.position = turn(s.camera.position);
  s.camera.forward = turn(s.camera.forward);
  s.camera.up = turn(s.camera.up);
  s.scene.setCamera(s.camera);
  s.scene.setLight(turn(s.light));
  const double difference = worstOf(s.scene.render(), straight);
  std::printf("everything turned: %.1e of the mean\n", difference);
  // Directions are floats: 2^-24 of 2 km against 10 m voxels whose value changes by its whole.
  EXPECT_LE(difference, ROUNDING + 10 * 2000.0 / 10 * 0x1p-24 * 12);
}

TEST(Compositing, TurnedVolumeMatchesTheMarch) {
  Stage s;
  VoxelField field = noiseCloudField();
  const Point axis = normalized({1, 2, -0.5});
  for (size_t column = 0; column < 3; ++column) {
    Point edge{};
    edge[column] = CLOUD_EDGE * (column == 1 ? 0.6 : 0.9);
    const Point p = turned(edge, axis, 0.9);
    for (size_t k = 0; k < 3; ++k) {
      field.worldFromBox[4 * k + column] = p[k];
      field.worldFromBox[4 * k + 3] -= 0.5 * (p[k] - (column == k ? CLOUD_EDGE : 0));
    }
  }
  s.scene.addVolume(field, s.medium);
  for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
    s.scene.setQuality({slicing});
    const double error = relativeRms(
        s.scene.render().red(), marchPicture(RayMarch(field), s.camera, SIZE, s.light, CLOUD_G));
    std::printf("volume turned and squeezed, slicing %u: %.2f %%\n", slicing, 100 * error);
    EXPECT_LE(error, SLICING_BOUND);
  }
}

TEST(Compositing, HomogeneousBoxIsExactAndKeepsEnergy) {
  Stage s(130);
  for (const double depth : {0.0625, 1.0, 8.0, 64.0, 4096.0}) {
    const VoxelField box =
        cubeField(2, std::vector<float>(8, 1.0f), depth / CLOUD_EDGE, CLOUD_EDGE, CLOUD_CENTRE);
    const WlkVolume volume = s.scene.addVolume(box, s.medium);
    const RayMarch march(box);
    for (const uint32_t scattering : {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD}) {
      s.scene.setQuality({WLK_SLICING_DEFAULT, scattering});
      const Picture picture = s.scene.render();
      EXPECT_EQ(picture.nonFinite, 0u);
      for (int i = 0; i < SIZE * SIZE; ++i) {
        const auto k = static_cast<size_t>(i);
        const Point ray = s.camera.ray(i % SIZE, i / SIZE, SIZE);
        const double clear = std::exp(-march.opticalDepth(s.camera.position, ray));
        EXPECT_NEAR(picture.transmittance[k][0], clear, 1e-4);
        // Scattered light comes from the forward peak of the phase function at most.
        const double peak = (1 + CLOUD_G) / (1 - CLOUD_G) / (1 - CLOUD_G) / 12.566;
        EXPECT_LE(picture.radiance[k][0], peak * (1 - clear) + 1e-6);
        EXPECT_GE(picture.radiance[k][0], 0);
      }
    }
    s.scene.removeVolume(volume);
  }
}

}  // namespace
