// SPDX-License-Identifier: MIT
// Where bows, halos, coronas and glories stand in the pictures: angles from the sun or from the
// point opposite to it, against Descartes, Airy, minimum deviation and Mie theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/headless_scene.hpp"

namespace {

using namespace welkin::test;

constexpr double DEGREE = std::numbers::pi / 180;
constexpr uint32_t WIDTH = 1024;

// Radiance of each colour along the middle row, from the picture's centre to the right.
struct Profile {
  std::vector<double> angle_deg;  // from the picture's centre
  std::array<std::vector<double>, 3> value;
};

// A wide sheet of particles 1 km ahead, of optical depth 0.05 across, lit from the front (the sun
// in the picture's centre) or from behind the camera.
class Sheet : public HeadlessScene {
 public:
  Sheet(const WlkMediumInfo& info, double halfWidth_deg, bool towardsSun)
      : HeadlessScene(optionsOf()), tangent_(std::tan(halfWidth_deg * DEGREE)) {
    WlkMedium medium{};
    welkin::check(wlkCreateMedium(context, &info, &medium));
    const double half = 1.2e3 * std::max(tangent_, 1.0);
    const WlkVolume volume = addVolume(
        medium, {2, 2, 2}, boxTransform({-half, -half, -1100}, {2 * half, 2 * half, 100}), 1);
    upload(volume, {2, 2, 2}, std::vector<float>(8, 0.05f / 100));
    auto light = welkin::make<WlkLight>();
    light.direction[1] = 0;
    light.direction[2] = towardsSun ? -1.0f : 1.0f;
    welkin::check(wlkSetLights(context, 1, sizeof light, &light));
    auto camera = welkin::make<WlkCamera>();
    std::fill(std::begin(camera.position), std::end(camera.position), 0.0);
    std::fill(std::begin(camera.clipFromView), std::end(camera.clipFromView), 0.0f);
    camera.clipFromView[0] = static_cast<float>(1 / tangent_);
    camera.clipFromView[5] = static_cast<float>(-1 / tangent_ * WIDTH / 8);
    camera.clipFromView[11] = -1;
    camera.clipFromView[14] = 0.1f;
    welkin::check(wlkSetCamera(context, view, &camera));
  }

  Profile profile() const {
    const Image image = render();
    EXPECT_EQ(image.badValues(), 0u);
    EXPECT_TRUE(messages().empty()) << messages().front();
    Profile result;
    for (uint32_t x = WIDTH / 2; x < WIDTH; ++x) {
      const double ndc = (x + 0.5) / WIDTH * 2 - 1;
      result.angle_deg.push_back(std::atan(ndc * tangent_) / DEGREE);
      for (size_t c = 0; c < 3; ++c) {
        result.value[c].push_back(static_cast<double>(image.at(x, 4)[c]));
      }
    }
    return result;
  }

 private:
  static SceneOptions optionsOf() {
    SceneOptions options;
    options.width = WIDTH;
    options.height = 8;
    options.layers = WLK_LAYER_VOLUMES;
    return options;
  }
  double tangent_;
};

// [R04] 4.2.4: the disk's radiance over its solid angle is the light's irradiance, and its edge
// stands at half the angular diameter. Air that does not scatter, a picture 2 degrees wide.
TEST(SunDisk, CarriesTheLightsIrradiance) {
  SceneOptions options;
  options.width = options.height = 256;
  const HeadlessScene scene(options);
  auto sky = welkin::make<WlkSky>();
  std::fill(std::begin(sky.rayleighScattering), std::end(sky.rayleighScattering), 0.0f);
  welkin::check(wlkSetSky(scene.context, &sky));
  constexpr float IRRADIANCE[3] = {3, 2, 1};
  for (const double diameter : {0.0093, 0.02}) {
    auto light = welkin::make<WlkLight>();
    light.direction[1] = 0;
    light.direction[2] = -1;
    light.angularDiameter = static_cast<float>(diameter);
    std::copy(std::begin(IRRADIANCE), std::end(IRRADIANCE), std::begin(light.irradiance));
    welkin::check(wlkSetLights(scene.context, 1, sizeof light, &light));
    auto camera = welkin::make<WlkCamera>();
    const double tangent = std::tan(1 * DEGREE);
    camera.position[1] = 1000;  // the horizon lies below the picture's middle by 1 degree
    camera.clipFromView[0] = static_cast<float>(1 / tangent);
    camera.clipFromView[5] = static_cast<float>(-1 / tangent);
    welkin::check(wlkSetCamera(scene.context, scene.view, &camera));
    const Image image = scene.render();
    const double pixel = std::pow(2 * tangent / options.width, 2);  // sr, to 2e-4
    for (size_t c = 0; c < 3; ++c) {
      double sum = 0;
      double edge = 0;  // radius of a disk of the same area as the pixels over half the maximum
      for (uint32_t y = 0; y < options.height / 2 + 90; ++y) {
        for (uint32_t x = 0; x < options.width; ++x) {
          const double value = static_cast<double>(image.at(x, y)[c]);
          sum += value * pixel;
          edge += value > 0.5 * static_cast<double>(image.at(128, 128)[c]) ? pixel : 0;
        }
      }
      // The rim's pixels: 1 of 68 in radius at most, alternating in sign around the circle.
      EXPECT_NEAR(sum / static_cast<double>(IRRADIANCE[c]), 1, 0.01) << diameter;
      // The rim is soft over the last 4 % of the radius.
      EXPECT_NEAR(std::sqrt(edge / std::numbers::pi) / (diameter / 2), 0.98, 0.01) << diameter;
    }
  }
}

WlkMediumInfo mediumOf(uint32_t particle, float diameter_um = 0, float spread = 0) {
  auto info = welkin::make<WlkMediumInfo>();
  info.particle = particle;
  info.diameter_um = diameter_um;
  info.spread = spread;
  return info;
}

// Where `sign` times the profile is largest within a range of angles, by a parabola.
double extremum(const Profile& profile, size_t channel, double begin_deg, double end_deg,
                double sign) {
  const std::vector<double>& value = profile.value[channel];
  size_t best = 0;
  for (size_t i = 1; i + 1 < value.size(); ++i) {
    const bool inside = profile.angle_deg[i] >= begin_deg && profile.angle_deg[i] <= end_deg;
    if (inside && (best == 0 || sign * value[i] > sign * value[best])) {
      best = i;
    }
  }
  const double left = value[best] - value[best - 1];
  const double right = value[best] - value[best + 1];
  const double shift = left + right == 0 ? 0 : (left - right) / (2 * (left + right));
  const double step = profile.angle_deg[best + 1] - profile.angle_deg[best];
  return profile.angle_deg[best] + shift * step;
}

double valueAt(const Profile& profile, size_t channel, double angle_deg) {
  const auto at = std::lower_bound(profile.angle_deg.begin(), profile.angle_deg.end(), angle_deg);
  return profile.value[channel][static_cast<size_t>(at - profile.angle_deg.begin())];
}

// Where the profile first crosses the middle between its least and largest value of a range.
double halfRise(const Profile& profile, size_t channel, double begin_deg, double end_deg) {
  const std::vector<double>& value = profile.value[channel];
  const auto index = [&](double angle) {
    return static_cast<size_t>(
        std::lower_bound(profile.angle_deg.begin(), profile.angle_deg.end(), angle) -
        profile.angle_deg.begin());
  };
  const auto begin = value.begin() + static_cast<long>(index(begin_deg));
  const auto end = value.begin() + static_cast<long>(index(end_deg));
  const double middle = (*std::min_element(begin, end) + *std::max_element(begin, end)) / 2;
  const auto above = std::find_if(begin, end, [&](double v) { return v > middle; });
  const size_t i = static_cast<size_t>(above - value.begin());
  const double t = (middle - value[i - 1]) / (value[i] - value[i - 1]);
  return profile.angle_deg[i - 1] + t * (profile.angle_deg[i] - profile.angle_deg[i - 1]);
}

constexpr double IN_THE_PICTURE_deg = 0.3;
constexpr double WAVELENGTH_um[3] = {0.68, 0.55, 0.44};

// Water at 10 C relative to air: Descartes angles of red, green, blue, and the shift of
// the Airy peak.
TEST(Optics, RainbowsStandAtDescartesAndAirysAngles) {
  constexpr double PRIMARY_deg[3] = {137.673, 138.216, 139.022};
  constexpr double SECONDARY_deg[3] = {129.558, 128.578, 127.124};
  constexpr float DIAMETER_um = 1000;
  const Profile rain = Sheet(mediumOf(WLK_PARTICLE_RAIN, DIAMETER_um), 60, false).profile();
  for (size_t c = 0; c < 3; ++c) {
    const double x = std::numbers::pi * DIAMETER_um / WAVELENGTH_um[c];
    const double primary = PRIMARY_deg[c] + 99.14 * std::pow(x, -2.0 / 3);
    const double secondary = SECONDARY_deg[c] - 177.06 * std::pow(x, -2.0 / 3);
    EXPECT_NEAR(extremum(rain, c, 37, 45, 1), 180 - primary, IN_THE_PICTURE_deg) << c;
    EXPECT_NEAR(extremum(rain, c, 48, 56, 1), 180 - secondary, IN_THE_PICTURE_deg) << c;
    // Alexander's band: Mie theory with the sun's disk gives 64-90 and 10-14.
    const double band = valueAt(rain, c, 46);
    EXPECT_GT(valueAt(rain, c, 180 - primary) / band, 50) << c;
    EXPECT_GT(valueAt(rain, c, 180 - secondary) / band, 7) << c;
  }
  // Red outside in the primary, inside in the secondary.
  EXPECT_GT(extremum(rain, 0, 37, 45, 1), extremum(rain, 2, 37, 45, 1) + 1);
  EXPECT_LT(extremum(rain, 0, 48, 56, 1), extremum(rain, 2, 48, 56, 1) - 1);
}

// Minimum deviation 2 asin(n sin(A / 2)) - A through 60 and 90 degrees; n of ice by Warren and
// Brandt 2008.
TEST(Optics, HalosBeginAtMinimumDeviation) {
  constexpr double SMALL_deg[3] = {21.635, 21.915, 22.318};
  constexpr double LARGE_deg[3] = {45.156, 45.949, 47.109};
  for (const uint32_t particle : {WLK_PARTICLE_ICE_COLUMN, WLK_PARTICLE_ICE_PLATE}) {
    const Profile ice = Sheet(mediumOf(particle), 56, true).profile();
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(halfRise(ice, c, 20, 23.5), SMALL_deg[c], IN_THE_PICTURE_deg) << c;
      EXPECT_NEAR(halfRise(ice, c, 44, 48.5), LARGE_deg[c], IN_THE_PICTURE_deg) << c;
    }
  }
}

// Droplets of 10 um radius, spread 0.1: x theta of the corona's first minimum 3.75 and maximum
// 4.83, of the glory's first maximum 3.0, within 5 % of the angle.
TEST(Optics, CoronaAndGloryRingsFollowTheDropletsSize) {
  const WlkMediumInfo droplets = mediumOf(WLK_PARTICLE_CLOUD, 20, 0.1f);
  const Profile corona = Sheet(droplets, 8, true).profile();
  const Profile glory = Sheet(droplets, 8, false).profile();
  for (size_t c = 0; c < 3; ++c) {
    const double x = std::numbers::pi * 20 / WAVELENGTH_um[c];
    const double degrees = 1 / (x * DEGREE);
    EXPECT_NEAR(extremum(corona, c, 3.0 * degrees, 4.3 * degrees, -1), 3.75 * degrees,
                0.05 * 3.75 * degrees)
        << c;
    EXPECT_NEAR(extremum(corona, c, 4.2 * degrees, 5.6 * degrees, 1), 4.83 * degrees,
                0.05 * 4.83 * degrees)
        << c;
    EXPECT_NEAR(extremum(glory, c, 2 * degrees, 4.5 * degrees, 1), 3.0 * degrees,
                0.05 * 3.0 * degrees)
        << c;
  }
}

// Mie: 141.91, 141.95, 142.27 degrees for red, green, blue.
TEST(Optics, FogbowStandsWhereMieTheoryPutsIt) {
  constexpr double FOGBOW_deg[3] = {141.91, 141.95, 142.27};
  const Profile fog = Sheet(mediumOf(WLK_PARTICLE_FOG, 20, 0.1f), 55, false).profile();
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(extremum(fog, c, 33, 43, 1), 180 - FOGBOW_deg[c], IN_THE_PICTURE_deg) << c;
  }
}

}  // namespace
