// SPDX-License-Identifier: MIT
// The sky at night: the engine's stars through the air, and the disks of moon and sun at high zoom.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

using Vector = std::array<double, 3>;

constexpr double DEGREE = std::numbers::pi / 180;
constexpr double BEYOND_AIR = 1e7;  // m
// Of the optical depth: the query's columns and the pixel's segments each follow the sphere to
// 0.05 %, and float follows double to 1e-4.
constexpr double DEPTH = 0.001;
constexpr double FLOAT = 1e-4;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Looks along -z, turned up by `pitch`.
struct Eye {
  Vector position;
  double pitch_deg;
  double tangent;  // of half the vertical field of view; pixels are square

  Vector right() const { return {1, 0, 0}; }
  Vector up() const { return {0, std::cos(pitch_deg * DEGREE), std::sin(pitch_deg * DEGREE)}; }
  Vector forward() const {
    return {0, std::sin(pitch_deg * DEGREE), -std::cos(pitch_deg * DEGREE)};
  }
  // Offsets from the picture's centre to the right and up, as tangents.
  static std::array<double, 2> offset(double tangent, double x, double y, double w, double h) {
    return {(2 * (x + 0.5) - w) / h * tangent, (h - 2 * (y + 0.5)) / h * tangent};
  }
  Vector ray(double x, double y, double w, double h) const {
    const auto [a, b] = offset(tangent, x, y, w, h);
    Vector d{};
    for (size_t k = 0; k < 3; ++k) {
      d[k] = forward()[k] + a * right()[k] + b * up()[k];
    }
    const double length = std::sqrt(dot(d, d));
    for (double& one : d) {
      one /= length;
    }
    return d;
  }
};

void look(const HeadlessScene& scene, const Eye& eye) {
  auto camera = make<WlkCamera>();
  std::copy(eye.position.begin(), eye.position.end(), camera.position);
  const Vector rows[3] = {eye.right(), eye.up(), eye.forward()};
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      const double sign = row == 2 ? -1 : 1;
      camera.viewFromWorld[3 * column + row] = static_cast<float>(sign * rows[row][column]);
    }
  }
  const SceneOptions& o = scene.options();
  camera.clipFromView[0] = static_cast<float>(1 / eye.tangent * o.height / o.width);
  camera.clipFromView[5] = static_cast<float>(-1 / eye.tangent);
  check(wlkSetCamera(scene.context, scene.view, &camera));
}

Vector transmittance(WlkContext context, const Vector& from, const Vector& direction) {
  Vector to{};
  for (size_t k = 0; k < 3; ++k) {
    to[k] = from[k] + BEYOND_AIR * direction[k];
  }
  Vector result{};
  check(wlkEvalTransmittance(context, from.data(), to.data(), result.data()));
  return result;
}

// ---- Stars: what the engine drew where nothing is near.

constexpr uint32_t STAR_WIDTH = 48;
constexpr uint32_t STAR_HEIGHT = 36;

// Coloured stars of many magnitudes on black.
std::vector<float> starField() {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> color(size_t{STAR_WIDTH} * STAR_HEIGHT * 4, 0.0f);
  for (size_t i = 0; i < color.size(); i += 4) {
    if (uniform(random) < 0.3f) {
      const float brightness = std::pow(10.0f, -6 * uniform(random));
      for (size_t c = 0; c < 3; ++c) {
        color[i + c] = brightness * (0.5f + uniform(random));
      }
    }
  }
  return color;
}

class Stars : public ::testing::Test {
 protected:
  static SceneOptions optionsOf(uint64_t layers) {
    SceneOptions options;
    options.width = STAR_WIDTH;
    options.height = STAR_HEIGHT;
    options.layers = layers;
    return options;
  }
  // Every star must come back with the query's transmittance. Rays closer to the horizon than a
  // float tells apart are left out.
  static void expectAttenuated(const HeadlessScene& scene, const Eye& eye, bool ground) {
    look(scene, eye);
    const std::vector<float> color = starField();
    const std::vector<float> sky(size_t{STAR_WIDTH} * STAR_HEIGHT, 0.0f);  // reversed depth: far
    WlkHeadlessInputs targets = make<WlkHeadlessInputs>();
    targets.color = color.data();
    targets.colorSize = color.size() * sizeof(float);
    const Image open = scene.render(&targets);
    targets.depth = sky.data();
    targets.depthSize = sky.size() * sizeof(float);
    const Image image = scene.render(&targets);
    EXPECT_TRUE(image == open) << "depth of the sky is as no depth";
    EXPECT_EQ(image.badValues(), 0u);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
    const double dip = std::acos(6.371e6 / (6.371e6 + eye.position[1]));
    int seen = 0;
    int hidden = 0;
    double worst = 0;
    for (uint32_t y = 0; y < STAR_HEIGHT; ++y) {
      for (uint32_t x = 0; x < STAR_WIDTH; ++x) {
        const Vector ray = eye.ray(x, y, STAR_WIDTH, STAR_HEIGHT);
        const double height = std::asin(ray[1]) + dip;
        if (std::abs(height) < 0.02 * DEGREE || (height < 0 && !ground)) {
          continue;
        }
        const Vector expected = transmittance(scene.context, eye.position, ray);
        for (size_t c = 0; c < 3; ++c) {
          const double star = static_cast<double>(color[(y * STAR_WIDTH + x) * 4 + c]);
          const double value = static_cast<double>(image.at(x, y)[c]);
          if (height < 0) {
            EXPECT_EQ(value, 0.0) << "behind the planet at " << x << " " << y;
            hidden += star > 0 ? 1 : 0;
          } else if (star > 0) {
            const double error = std::abs(value / star - expected[c]);
            const double depth = -std::log(std::max(expected[c], 1e-30));
            worst = std::max(worst, error);
            EXPECT_LE(error, expected[c] * (DEPTH * depth + FLOAT) + FLOAT) << x << " " << y;
            ++seen;
          } else {
            EXPECT_EQ(value, 0.0) << x << " " << y;
          }
        }
      }
    }
    std::printf("%8.0f m: %d stars' colours within %.1e of the query, %d hidden\n", eye.position[1],
                seen, worst, hidden);
    EXPECT_GT(seen, 100);
    EXPECT_TRUE(!ground || hidden > 100);
  }
};

TEST_F(Stars, AreAttenuatedByTheTransmittanceOfTheAir) {
  const HeadlessScene scene(optionsOf(WLK_LAYER_SKY | WLK_LAYER_FOG));
  scene.setSky();
  for (const bool fog : {false, true}) {
    if (fog) {
      scene.setFog(2e-5f, 1200);
    }
    for (const Eye& eye :
         {Eye{{200, 2, -400}, 15, 0.5}, {{0, 9000, 0}, 5, 0.3}, {{0, 4e5, 0}, -15, 0.5}}) {
      expectAttenuated(scene, eye, false);
    }
  }
}

TEST_F(Stars, ThePlanetHidesThem) {
  const HeadlessScene scene(optionsOf(WLK_LAYER_ALL));
  scene.setSky();
  for (const Eye& eye :
       {Eye{{0, 2, 0}, 2, 0.5}, {{0, 9000, 0}, -3, 0.3}, {{0, 4e5, 0}, -18, 0.3}}) {
    expectAttenuated(scene, eye, true);
  }
}

// ---- Disks of moon and sun, the field of view 1 degree wide.

constexpr uint32_t SIZE = 256;
constexpr double KEPT = 0.96;  // of the disk's area, by its soft rim
const Eye ZOOM{{0, 500, 0}, 30, std::tan(0.5 * DEGREE)};

// One light in the middle of the picture, in air; with and without its disk.
class Disk {
 public:
  Disk() : scene_(optionsOf(WLK_LAYER_SKY | WLK_LAYER_SUN_DISK)), bare_(optionsOf(WLK_LAYER_SKY)) {}

  // Radiance of the disk alone over transmittance, per channel and pixel.
  std::array<std::vector<double>, 3> picture(const WlkLight& light) {
    std::array<Image, 2> images;
    for (size_t i = 0; i < 2; ++i) {
      const HeadlessScene& scene = i == 0 ? scene_ : bare_;
      scene.setSky();
      check(wlkSetLights(scene.context, 1, sizeof light, &light));
      look(scene, ZOOM);
      images[i] = scene.render();
      EXPECT_EQ(images[i].badValues(), 0u);
      EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
    }
    const Vector clear = transmittance(scene_.context, ZOOM.position, ZOOM.forward());
    std::array<std::vector<double>, 3> result;
    for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
      for (size_t c = 0; c < 3; ++c) {
        const double with = static_cast<double>(images[0].rgba[4 * i + c]);
        const double without = static_cast<double>(images[1].rgba[4 * i + c]);
        result[c].push_back((with - without) / clear[c]);
      }
    }
    return result;
  }

  static WlkLight centred() {
    auto light = make<WlkLight>();
    for (size_t k = 0; k < 3; ++k) {
      light.direction[k] = static_cast<float>(ZOOM.forward()[k]);
    }
    return light;
  }
  static std::array<double, 2> offset(uint32_t pixel) {
    return Eye::offset(ZOOM.tangent, pixel % SIZE, pixel / SIZE, SIZE, SIZE);
  }
  static double flux(const std::vector<double>& channel) {
    const double pixel = std::pow(2 * ZOOM.tangent / SIZE, 2);  // sr, to 1e-4
    double sum = 0;
    for (const double one : channel) {
      sum += one * pixel;
    }
    return sum;
  }

 private:
  static SceneOptions optionsOf(uint64_t layers) {
    SceneOptions options;
    options.width = options.height = SIZE;
    options.layers = layers;
    return options;
  }
  HeadlessScene scene_;
  HeadlessScene bare_;
};

// Of the flux: pixels across the rim or the horns of a crescent (1 of 66 in radius, signs alternate
// around the circle: a third of 1 / 66); blue's transmittance a quarter degree from the centre.
constexpr double PIXELS = 0.005;
constexpr double HEIGHT = 0.005;
constexpr double FLUX = PIXELS + HEIGHT + FLOAT;

// A point of the disk in radii of the body, whose disk keeps 0.96 of the area: towards the sun and
// across.
struct DiskPoint {
  double along;
  double aside;
};

TEST(NightDisk, MoonIsLitFromTheSunsSideAndCarriesItsIrradiance) {
  Disk disk;
  struct Case {
    double phase_deg;
    double side_deg;  // of the sun, from the picture's right upwards
  };
  for (const auto& [phase_deg, side_deg] : {Case{0, 0}, {40, 70}, {90, 0}, {90, 200}, {135, 70}}) {
    SCOPED_TRACE(std::to_string(phase_deg) + " from " + std::to_string(side_deg));
    const double cosPhase = std::cos(phase_deg * DEGREE);
    const std::array<double, 2> side{std::cos(side_deg * DEGREE), std::sin(side_deg * DEGREE)};
    float toSun[3];
    for (size_t k = 0; k < 3; ++k) {
      const double sideways = side[0] * ZOOM.right()[k] + side[1] * ZOOM.up()[k];
      toSun[k] = static_cast<float>(std::sin(phase_deg * DEGREE) * sideways -
                                    cosPhase * ZOOM.forward()[k]);
    }
    WlkLight moon = Disk::centred();
    const float sunlight[3] = {1.0f, 1.2f, 1.4f};
    check(wlkInitMoon(toSun, moon.direction, sunlight, &moon));
    const std::array<std::vector<double>, 3> picture = disk.picture(moon);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(Disk::flux(picture[c]) / static_cast<double>(moon.irradiance[c]), 1, FLUX) << c;
    }
    const double radius = static_cast<double>(moon.angularDiameter) / 2 * std::sqrt(KEPT);
    DiskPoint centre{};
    double sum = 0;
    double dark = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
      const std::array<double, 2> at = Disk::offset(i);
      const DiskPoint p{(at[0] * side[0] + at[1] * side[1]) / radius,
                        (at[1] * side[0] - at[0] * side[1]) / radius};
      const double light = picture[1][i];
      sum += light;
      centre.along += light * p.along;
      centre.aside += light * p.aside;
      // The terminator is an ellipse of half axes 1 and |cos| of the phase angle; 1 pixel is 0.015.
      const bool inside = std::hypot(p.along, p.aside) < 0.97;
      const double terminator = -cosPhase * std::sqrt(std::max(0.0, 1 - p.aside * p.aside));
      dark += inside && p.along < terminator - 0.015 ? light : 0;
    }
    std::printf("moon at phase %3.0f: flux %.4f, centre of light %+.3f towards the sun, %+.3f\n",
                phase_deg, Disk::flux(picture[1]) / static_cast<double>(moon.irradiance[1]),
                centre.along / sum, centre.aside / sum);
    // Transmittance that rises with the height, and pixels.
    constexpr double SHIFT = 0.01;
    EXPECT_NEAR(centre.aside / sum, 0, SHIFT);
    EXPECT_LE(dark, 1e-5 * sum);
    if (phase_deg > 0) {
      EXPECT_GT(centre.along / sum, 0.1 + SHIFT);
    } else {
      EXPECT_NEAR(centre.along / sum, 0, SHIFT);
    }
  }
}

TEST(NightDisk, LimbDarkenedSunCarriesItsIrradiance) {
  Disk disk;
  WlkLight sun = Disk::centred();
  const std::array<std::vector<double>, 3> uniform = disk.picture(sun);
  const float exponent[3] = {0.36f, 0.47f, 0.62f};
  std::copy(std::begin(exponent), std::end(exponent), std::begin(sun.limbDarkening));
  const std::array<std::vector<double>, 3> darkened = disk.picture(sun);
  const double radius = static_cast<double>(sun.angularDiameter) / 2;
  const double level = 1 / (std::numbers::pi * radius * radius * KEPT);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(Disk::flux(uniform[c]), 1, FLUX) << c;
    EXPECT_NEAR(Disk::flux(darkened[c]), 1, FLUX) << c;
    const double a = static_cast<double>(exponent[c]);
    double worst = 0;
    double worstUniform = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
      const std::array<double, 2> at = Disk::offset(i);
      const double share = (at[0] * at[0] + at[1] * at[1]) / (radius * radius);
      if (share < 0.9) {
        const double mu = std::sqrt(1 - share / KEPT);
        const double expected = level * (a + 2) / 2 * std::pow(mu, a);
        worst = std::max(worst, std::abs(darkened[c][i] / expected - 1));
        worstUniform = std::max(worstUniform, std::abs(uniform[c][i] / level - 1));
      }
    }
    std::printf("sun, colour %zu: radiance within %.2f %%, uniform disk within %.2f %%\n", c,
                100 * worst, 100 * worstUniform);
    // Directions in float, 6e-8 of 0.0047, times the slope a / mu^2 of the law's logarithm.
    constexpr double DIRECTION = 6e-8 / 0.00465 * 0.62 / 0.06 * 2;
    EXPECT_LE(worst, HEIGHT + DIRECTION + FLOAT) << c;
    EXPECT_LE(worstUniform, HEIGHT + FLOAT) << c;
  }
}

}  // namespace
}  // namespace welkin::test
