// SPDX-License-Identifier: MIT
#include "bench/sky_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "reference/monte_carlo.hpp"
#include "reference/planet.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr double SINGLE_TOLERANCE = 1e-5;
// The depth image has single precision, the file nine digits.
constexpr double SAME_DISTANCE = 1e-6;
constexpr const char* HEADER =
    "case,x,y,distance_m,radiance_r,radiance_g,radiance_b,error_r,error_g,error_b,"
    "transmittance_r,transmittance_g,transmittance_b";

rt::Scene referenceScene(const SkyCase& one) {
  rt::Scene scene;
  scene.globe.radius = SKY_PLANET_RADIUS;
  scene.ground = true;
  scene.groundAlbedo.fill(SKY_GROUND_ALBEDO);
  rt::ExponentialLayer air;
  air.scaleHeight = SKY_SCALE_HEIGHT;
  air.extinction = SKY_SCATTERING;
  air.phase = rt::PhaseFunction::rayleigh();
  scene.layers.push_back(air);
  rt::DistantLight sun;
  const host::Vec3 direction = sunDirection(one);
  sun.direction = {direction.x, direction.y, direction.z};
  scene.lights = {sun};
  return scene;
}

bool samePixel(const SkyPixel& pixel, uint32_t x, uint32_t y, double distance) {
  const bool open = !(pixel.distance < rt::FAR);
  const bool near = std::abs(distance - pixel.distance) <= SAME_DISTANCE * pixel.distance;
  return pixel.x == x && pixel.y == y && (open ? !(distance < rt::FAR) : near);
}

}  // namespace

std::vector<SkyTruth> skyTruth(const SkyCase& one, const std::vector<SkyPixel>& pixels,
                               uint64_t paths, uint64_t seed) {
  std::vector<rt::EyeRay> rays;
  for (const SkyPixel& pixel : pixels) {
    rt::EyeRay ray;
    ray.origin = {0, one.altitude, 0};
    ray.direction = {pixel.direction.x, pixel.direction.y, pixel.direction.z};
    ray.length = pixel.distance;
    rays.push_back(ray);
  }
  rt::RenderOptions options;
  options.samples = paths;
  options.seed = seed;
  options.firstOrder = 2;
  const rt::Scene scene = referenceScene(one);
  const rt::RenderResult multiple = rt::render(scene, rays, options);

  const host::Vec3 sun = sunDirection(one);
  rt::Planet planet;
  planet.radius = SKY_PLANET_RADIUS;
  planet.airScattering = SKY_SCATTERING;
  planet.airScaleHeight = SKY_SCALE_HEIGHT;
  std::vector<SkyTruth> truths;
  for (size_t i = 0; i < rays.size(); ++i) {
    // The eye is above the sea-level point: its up is y.
    const double viewSun = host::dot(pixels[i].direction, sun);
    const SkyRgb single = rt::inscatter(
        planet, {one.altitude, pixels[i].direction.y, sun.y, viewSun, pixels[i].distance},
        rt::PhaseFunction::rayleigh().value(0, 1 - viewSun), 0, 0, SINGLE_TOLERANCE);
    SkyTruth truth;
    for (size_t c = 0; c < 3; ++c) {
      truth.radiance[c] = single[c] + multiple.pixels[i].radiance[c];
      truth.error[c] = std::sqrt(multiple.pixels[i].variance[c]);
    }
    truth.transmittance = multiple.pixels[i].transmittance;
    truths.push_back(truth);
  }
  return truths;
}

void appendTruth(const std::string& file, const SkyCase& one, const std::vector<SkyPixel>& pixels,
                 const std::vector<SkyTruth>& truths) {
  const bool empty = std::ifstream(file).peek() == std::ifstream::traits_type::eof();
  std::ofstream stream(file, std::ios::app);
  if (empty) {
    stream << HEADER << '\n';
  }
  stream.precision(9);
  for (size_t i = 0; i < pixels.size(); ++i) {
    stream << one.name << ',' << pixels[i].x << ',' << pixels[i].y << ',' << pixels[i].distance;
    for (const SkyRgb& values : {truths[i].radiance, truths[i].error, truths[i].transmittance}) {
      stream << ',' << values[0] << ',' << values[1] << ',' << values[2];
    }
    stream << '\n';
  }
  stream.flush();
  if (!stream) {
    throw std::runtime_error(file + ": cannot write");
  }
}

std::vector<SkyTruth> readTruth(const std::string& file, const SkyCase& one,
                                const std::vector<SkyPixel>& pixels) {
  std::ifstream stream(file);
  std::string line;
  std::vector<SkyTruth> truths;
  while (std::getline(stream, line)) {
    if (line.compare(0, one.name.size() + 1, one.name + ",") != 0) {
      continue;
    }
    uint32_t x = 0;
    uint32_t y = 0;
    double distance = 0;  // strtod and scanf read "inf", streams do not
    SkyTruth t;
    const int read = std::sscanf(
        line.c_str() + one.name.size(), ",%u,%u,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &x, &y,
        &distance, &t.radiance[0], &t.radiance[1], &t.radiance[2], &t.error[0], &t.error[1],
        &t.error[2], &t.transmittance[0], &t.transmittance[1], &t.transmittance[2]);
    if (read != 12 || truths.size() == pixels.size() ||
        !samePixel(pixels[truths.size()], x, y, distance)) {
      throw std::runtime_error(file + ": made for other pixels of " + one.name);
    }
    truths.push_back(t);
  }
  if (truths.size() != pixels.size()) {
    throw std::runtime_error(file + ": has " + std::to_string(truths.size()) + " pixels of " +
                             one.name + ", expected " + std::to_string(pixels.size()));
  }
  return truths;
}

double noiseOf(const std::vector<SkyTruth>& truths) {
  std::vector<double> values;
  for (const SkyTruth& truth : truths) {
    for (size_t c = 0; c < 3; ++c) {
      values.push_back(truth.error[c] / truth.radiance[c]);
    }
  }
  return quantile(values, 0.5);
}

void SkyErrors::add(const SkyErrors& other) {
  sky.insert(sky.end(), other.sky.begin(), other.sky.end());
  aerial.insert(aerial.end(), other.aerial.begin(), other.aerial.end());
  aerialFar.insert(aerialFar.end(), other.aerialFar.begin(), other.aerialFar.end());
  transmittance.insert(transmittance.end(), other.transmittance.begin(), other.transmittance.end());
}

SkyErrors errorsOf(const std::vector<float>& black, const std::vector<float>& white, uint32_t width,
                   double far, const std::vector<SkyPixel>& pixels,
                   const std::vector<SkyTruth>& truths) {
  SkyErrors result;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const size_t at = 4 * (size_t{pixels[i].y} * width + pixels[i].x);
    const bool open = !(pixels[i].distance < rt::FAR);
    std::vector<double>& air = pixels[i].distance > far ? result.aerialFar : result.aerial;
    std::vector<double>& part = open ? result.sky : air;
    for (size_t c = 0; c < 3; ++c) {
      const double radiance = double{black[at + c]};
      const double truth = truths[i].radiance[c];
      part.push_back(std::abs(radiance - truth) / truth);
      if (!open) {
        const double left = truths[i].transmittance[c];
        result.transmittance.push_back(std::abs(double{white[at + c]} - radiance - left) / left);
      }
    }
  }
  return result;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size()) - 1;
  return values.empty() ? 0 : values[static_cast<size_t>(std::lround(share * last))];
}

}  // namespace bench
