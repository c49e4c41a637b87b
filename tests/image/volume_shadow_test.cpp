// SPDX-License-Identifier: MIT
// Shadows of volumes on the air (WLK_QUALITY_FLAG_VOLUME_SHADOWS): what they take from a picture
// against a quadrature of single scattering in an exponential atmosphere on a sphere, written anew
// here.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "support/headless_scene.hpp"
#include "support/tolerance.hpp"

namespace welkin::test {
namespace {

using Vec = std::array<double, 3>;

constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180;
constexpr double RADIUS = 6.371e6;
constexpr double SCALE_HEIGHT = 8000;
constexpr Vec SCATTERING{5.8e-6, 1.35e-5, 3.31e-5};
constexpr Vec EYE{0, 100, 0};

Vec along(const Vec& origin, const Vec& direction, double t) {
  return {origin[0] + t * direction[0], origin[1] + t * direction[1], origin[2] + t * direction[2]};
}
double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Relative density of the air; sea level is the origin.
double density(const Vec& p) {
  const double up = p[1] + RADIUS;
  return std::exp(-(std::sqrt(p[0] * p[0] + up * up + p[2] * p[2]) - RADIUS) / SCALE_HEIGHT);
}

// Column of air to the light, by Simpson's rule with steps that grow.
double columnTo(const Vec& from, const Vec& toSun) {
  constexpr int STEPS = 64;
  double sum = 0;
  double begin = 0;
  for (int i = 1; i <= STEPS; ++i) {
    const double end = 4e5 * std::pow(static_cast<double>(i) / STEPS, 2);
    const double middle = 0.5 * (begin + end);
    sum += (end - begin) / 6 *
           (density(along(from, toSun, begin)) + 4 * density(along(from, toSun, middle)) +
            density(along(from, toSun, end)));
    begin = end;
  }
  return sum;
}

struct Box {
  Vec lo;
  Vec edges;
  double extinction;
  // Optical depth of the first `length` metres.
  double depth(const Vec& origin, const Vec& direction, double length) const {
    double begin = 0;
    double end = length;
    for (size_t i = 0; i < 3; ++i) {
      const double a = (lo[i] - origin[i]) / direction[i];
      const double b = (lo[i] + edges[i] - origin[i]) / direction[i];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return std::max(end - begin, 0.0) * extinction;
  }
};

struct Case {
  const char* name;
  double elevation_deg;
  double azimuth_deg;
  double pitch_deg;
  Box box;
};
const std::array CASES{
    Case{"deck", 40, 20, 35, {{-30000, 3000, -40000}, {60000, 500, 45000}, 0.002}},
    Case{"cloud", 30, 70, 30, {{-3000, 1500, -9000}, {5000, 2000, 4000}, 0.003}},
    Case{"behind", 15, 175, 32, {{-8000, 2000, -2000}, {16000, 1500, 9000}, 0.002}}};

constexpr uint32_t WIDTH = 32;
constexpr uint32_t HEIGHT = 24;

// Radiance that the shadow takes away, per unit irradiance, RGB.
Vec takenAway(const Box& box, const Vec& view, const Vec& toSun) {
  constexpr int STEPS = 600;
  const double cosine = dot(view, toSun);
  const double phase = 3 / (16 * PI) * (1 + cosine * cosine);
  Vec sum{};
  double column = 0;
  double begin = 0;
  for (int i = 1; i <= STEPS; ++i) {
    const double end = 3e5 * std::pow(static_cast<double>(i) / STEPS, 2);
    const Vec p = along(EYE, view, 0.5 * (begin + end));
    const double part = density(p) * (end - begin);
    const double shadow = 1 - std::exp(-box.depth(p, toSun, 1e9));
    if (shadow > 0) {
      const double path = column + 0.5 * part + columnTo(p, toSun);
      const double volume = std::exp(-box.depth(EYE, view, 0.5 * (begin + end)));
      for (size_t c = 0; c < 3; ++c) {
        sum[c] += SCATTERING[c] * part * phase * std::exp(-SCATTERING[c] * path) * shadow * volume;
      }
    }
    column += part;
    begin = end;
  }
  return sum;
}

// Direction of a pixel of a camera that looks along -z, turned up; 60 degrees high.
Vec directionOf(uint32_t x, uint32_t y, double pitch_deg) {
  const double half = std::tan(30 * DEGREE);
  const double right = (2 * (x + 0.5) / WIDTH - 1) * half * WIDTH / HEIGHT;
  const double up = (1 - 2 * (y + 0.5) / HEIGHT) * half;
  const double c = std::cos(pitch_deg * DEGREE);
  const double s = std::sin(pitch_deg * DEGREE);
  const Vec v{right, up * c + s, up * s - c};
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

Image renderCase(const HeadlessScene& scene, uint64_t flags) {
  auto quality = make<WlkQuality>();
  quality.scattering = WLK_SCATTERING_SINGLE;
  quality.flags = flags;
  check(wlkSetQuality(scene.context, scene.view, &quality));
  return scene.render();
}

TEST(VolumeShadow, TakesFromTheAirWhatAQuadratureSays) {
  for (const Case& test : CASES) {
    SCOPED_TRACE(test.name);
    SceneOptions options;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.layers = WLK_LAYER_SKY | WLK_LAYER_VOLUMES;
    const HeadlessScene scene(options);
    scene.setSky();
    check(wlkSetAbsorber(scene.context, nullptr));
    scene.setSun(test.elevation_deg, test.azimuth_deg);
    scene.setCamera(EYE, 0, test.pitch_deg);
    const WlkVolume volume = scene.addVolume(scene.addHenyeyGreenstein(0.3f), {2, 2, 2},
                                             boxTransform(test.box.lo, test.box.edges),
                                             static_cast<float>(test.box.extinction));
    scene.upload(volume, {2, 2, 2}, std::vector<float>(8, 1.0f));
    const Image lit = renderCase(scene, 0);
    const Image shaded = renderCase(scene, WLK_QUALITY_FLAG_VOLUME_SHADOWS);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    const double level = std::cos(test.elevation_deg * DEGREE);
    const Vec toSun{level * std::sin(test.azimuth_deg * DEGREE),
                    std::sin(test.elevation_deg * DEGREE),
                    -level * std::cos(test.azimuth_deg * DEGREE)};
    double errors = 0;
    double truths = 0;
    double squares = 0;
    double worst = 0;
    double part = 0;
    for (uint32_t y = 0; y < HEIGHT; ++y) {
      for (uint32_t x = 0; x < WIDTH; ++x) {
        const Vec truth = takenAway(test.box, directionOf(x, y, test.pitch_deg), toSun);
        for (size_t c = 0; c < 3; ++c) {
          const double taken = double{lit.at(x, y)[c]} - double{shaded.at(x, y)[c]};
          errors += (taken - truth[c]) * (taken - truth[c]);
          squares += truth[c] * truth[c];
          truths += taken - truth[c];
          worst = std::max(worst, std::abs(taken - truth[c]) / double{lit.at(x, y)[c]});
          part = std::max(part, truth[c] / double{lit.at(x, y)[c]});
        }
      }
    }
    const double relative = std::sqrt(errors / squares);
    std::printf(
        "%s: shadows take up to %.3f of a pixel; rms error %.4f of what they take, at most "
        "%.4f of a pixel, bias %.4f\n",
        test.name, part, relative, worst,
        truths / (3.0 * WIDTH * HEIGHT) / std::sqrt(squares / (3.0 * WIDTH * HEIGHT)));
    EXPECT_GT(part, 0.05) << "nothing to see";
    EXPECT_LT(relative, 0.1);
    EXPECT_LT(worst, 0.05);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
}

Image renderDeck(const HeadlessScene& scene, uint32_t scattering, uint64_t flags) {
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = scattering;
  quality.flags = flags;
  check(wlkSetQuality(scene.context, scene.view, &quality));
  return scene.render();
}

// What a deck scatters comes through it: behind it the air lacks what the deck turns back, not what
// it scatters once.
TEST(VolumeShadow, OfADeckIsWhatItTurnsBack) {
  struct Deck {
    double depth;
    double elevation_deg;
    double through;  // all light through the slab, `welkin slab`, Henyey-Greenstein 0.76
  };
  constexpr std::array DECKS{Deck{1, 50, 0.876}, Deck{4, 50, 0.609}, Deck{1, 30, 0.766},
                             Deck{4, 30, 0.489}};
  constexpr double EDDINGTON = 0.05;  // of the light, volume_shadow.glsl
  constexpr double HEIGHT_M = 500;
  for (const Deck& deck : DECKS) {
    SCOPED_TRACE(::testing::Message() << deck.depth << " at " << deck.elevation_deg);
    SceneOptions options;
    options.layers = WLK_LAYER_SKY | WLK_LAYER_VOLUMES;
    const HeadlessScene scene(options);
    scene.setSky();
    scene.setSun(deck.elevation_deg, 20);
    scene.setCamera(EYE, 180, 25);
    const WlkVolume volume =
        scene.addVolume(scene.addHenyeyGreenstein(0.76f), {2, 2, 2},
                        boxTransform({-60000, 4000, -60000}, {120000, HEIGHT_M, 120000}),
                        static_cast<float>(deck.depth / HEIGHT_M));
    scene.upload(volume, {2, 2, 2}, std::vector<float>(8, 1.0f));
    double taken[2] = {};
    for (const bool first : {false, true}) {
      const uint32_t scattering = first ? WLK_SCATTERING_SINGLE : WLK_SCATTERING_FORWARD;
      const Image lit = renderDeck(scene, scattering, 0);
      const Image shaded = renderDeck(scene, scattering, WLK_QUALITY_FLAG_VOLUME_SHADOWS);
      for (uint32_t y = 0; y < lit.height; ++y) {
        for (uint32_t x = 0; x < lit.width; ++x) {
          taken[first ? 1 : 0] += double{lit.at(x, y)[1]} - double{shaded.at(x, y)[1]};
        }
      }
    }
    const double met = -std::expm1(-deck.depth / std::sin(deck.elevation_deg * DEGREE));
    EXPECT_NEAR(met * taken[0] / taken[1], 1 - deck.through, EDDINGTON);
    EXPECT_GT(taken[1], 0.0);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
}

// No volume, none with density, none that the light reaches: the picture is as without the flag.
TEST(VolumeShadow, ChangesNothingWhereThereIsNoShadow) {
  const HeadlessScene scene;
  scene.setSky();
  scene.setSun(30, 40);
  EXPECT_TRUE(renderCase(scene, WLK_QUALITY_FLAG_VOLUME_SHADOWS) == renderCase(scene, 0))
      << "no volume";
  const WlkVolume volume = scene.addBall(0.01f);
  scene.upload(volume, {8, 8, 8}, std::vector<float>(512, 0.0f));
  EXPECT_TRUE(renderCase(scene, WLK_QUALITY_FLAG_VOLUME_SHADOWS) == renderCase(scene, 0))
      << "empty";
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

}  // namespace
}  // namespace welkin::test
