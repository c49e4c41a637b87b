// SPDX-License-Identifier: MIT
// welkin_sky_methods OUT.csv: multiple scattering of sky light by three methods beside Monte Carlo,
// for random rays in clear and in hazy air. Radiance per unit irradiance of the light, 1/sr; the
// error of a method counts as a share of the ray's whole radiance. Prints a table in Markdown.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/isotropic_sky.hpp"
#include "reference/monte_carlo.hpp"
#include "reference/planet.hpp"
#include "reference/random.hpp"
#include "tables/sky_field.hpp"

namespace {

namespace rt = welkin::reference;
using welkin::SkyColor;
using welkin::SkyField;

constexpr double PI = std::numbers::pi;
constexpr double DEGREE = PI / 180;
constexpr SkyColor RAYLEIGH{5.8e-6, 1.35e-5, 3.31e-5};
constexpr double GROUND_ALBEDO = 0.1;
constexpr double G = 0.76;
constexpr double HAZE_EXTINCTION = 1e-5;
constexpr double HAZE_ALBEDO = 0.95;
constexpr double HAZE_HEIGHT = 1200;
constexpr double SINGLE_TOLERANCE = 1e-5;
constexpr double LARGEST_NOISE = 0.01;

const char* const METHODS[] = {"moments", "isotropic", "single"};
constexpr size_t METHOD_COUNT = 3;

struct Atmosphere {
  const char* name;
  bool hazy;
};
constexpr Atmosphere ATMOSPHERES[] = {{"rayleigh", false}, {"earth", true}};

struct Group {
  const char* name;
  double sunLow_deg;
  double sunHigh_deg;
  bool aerial;  // the ray ends 1 to 50 km away or at the ground, else it leaves the air
};
constexpr Group GROUPS[] = {{"sky, sun 10..90", 10, 90, false},
                            {"sky, sun 2..10", 2, 10, false},
                            {"sky, sun -2", -2, -2, false},
                            {"aerial, sun 10..90", 10, 90, true}};

struct Ray {
  double sun_deg;
  double altitude;
  double view_deg;
  double azimuth_deg;  // from the sun's
  double length = rt::FAR;

  double viewMu() const { return std::sin(view_deg * DEGREE); }
  double sunMu() const { return std::sin(sun_deg * DEGREE); }
  double viewSun() const {
    return viewMu() * sunMu() + std::cos(view_deg * DEGREE) * std::cos(sun_deg * DEGREE) *
                                    std::cos(azimuth_deg * DEGREE);
  }
};

welkin::SkyFieldInput inputFor(const Atmosphere& atmosphere) {
  welkin::SkyFieldInput input;
  std::copy(RAYLEIGH.begin(), RAYLEIGH.end(), input.air.airScattering);
  input.groundAlbedo.fill(GROUND_ALBEDO);
  input.lightAngularRadius = 0;
  if (atmosphere.hazy) {
    input.air.fogExtinction = HAZE_EXTINCTION;
    input.air.fogScaleHeight = HAZE_HEIGHT;
    std::fill(std::begin(input.air.fogAlbedo), std::end(input.air.fogAlbedo), HAZE_ALBEDO);
    for (size_t l = 0; l < welkin::FOG_TERMS; ++l) {
      input.fogMoments[l].fill(std::pow(G, l + 1));
    }
  }
  return input;
}

rt::Scene sceneFor(const welkin::SkyFieldInput& input, const Ray& ray) {
  rt::Scene scene;
  scene.globe.radius = input.air.planetRadius;
  scene.ground = true;
  scene.groundAlbedo = input.groundAlbedo;
  rt::ExponentialLayer air;
  air.scaleHeight = input.air.airScaleHeight;
  air.extinction = RAYLEIGH;
  air.phase = rt::PhaseFunction::rayleigh();
  scene.layers.push_back(air);
  if (input.air.fogExtinction > 0) {
    rt::ExponentialLayer haze;
    haze.scaleHeight = input.air.fogScaleHeight;
    haze.extinction.fill(input.air.fogExtinction);
    haze.albedo.fill(HAZE_ALBEDO);
    haze.phase = rt::PhaseFunction::henyeyGreenstein(G);
    scene.layers.push_back(haze);
  }
  rt::DistantLight sun;
  sun.direction = {std::cos(ray.sun_deg * DEGREE), ray.sunMu(), 0};
  scene.lights = {sun};
  return scene;
}

Ray drawRay(const Group& group, double radius, rt::Random& random) {
  Ray ray{};
  ray.sun_deg = group.sunLow_deg + (group.sunHigh_deg - group.sunLow_deg) * random.uniform();
  const bool standing = random.uniform() < 0.5;
  ray.altitude = standing ? 2 : 2 * std::pow(6000, random.uniform());
  ray.azimuth_deg = 360 * random.uniform();
  const double u = random.uniform();
  if (group.aerial) {
    ray.view_deg = -30 + 60 * u;
    ray.length = 1000 * std::pow(50, random.uniform());
  } else {
    // From the horizon up, and more of them near it.
    const double dip_deg = std::acos(radius / (radius + ray.altitude)) / DEGREE;
    ray.view_deg = -dip_deg + (90 + dip_deg) * u * u;
  }
  return ray;
}

struct Truth {
  SkyColor single;
  SkyColor multiple;
  SkyColor error;  // standard error of `multiple`
  double length;   // to the end or to the ground
  bool grounded;
};

// Once-scattered light by quadrature, light reflected by the ground without scattering, and the
// rest by Monte Carlo.
Truth truthFor(const welkin::SkyFieldInput& input, const Ray& ray, uint64_t paths, uint64_t seed) {
  const rt::Scene scene = sceneFor(input, ray);
  rt::EyeRay eye;
  eye.origin = {0, ray.altitude, 0};
  const double flat = std::cos(ray.view_deg * DEGREE);
  eye.direction = {flat * std::cos(ray.azimuth_deg * DEGREE), ray.viewMu(),
                   flat * std::sin(ray.azimuth_deg * DEGREE)};
  eye.length = ray.length;
  rt::RenderOptions options;
  options.samples = paths;
  options.seed = seed;
  options.firstOrder = 2;
  const rt::Estimate estimate = rt::render(scene, {eye}, options).pixels[0];

  rt::Planet planet;
  planet.radius = input.air.planetRadius;
  planet.airScattering = RAYLEIGH;
  planet.airScaleHeight = input.air.airScaleHeight;
  planet.fogExtinction = input.air.fogExtinction;
  planet.fogScaleHeight = input.air.fogScaleHeight;
  planet.fogAlbedo.fill(HAZE_ALBEDO);
  const double ground = scene.globe.climb(eye.origin, eye.direction).ground();
  Truth truth{};
  truth.grounded = ground < ray.length;
  truth.length = std::min(ground, ray.length);
  const double y = 1 - ray.viewSun();
  truth.single =
      rt::inscatter(planet, {ray.altitude, ray.viewMu(), ray.sunMu(), ray.viewSun(), truth.length},
                    rt::PhaseFunction::rayleigh().value(0, y),
                    rt::PhaseFunction::henyeyGreenstein(G).value(0, y), 0, SINGLE_TOLERANCE);
  if (truth.grounded) {
    const double foot =
        ((planet.radius + ray.altitude) * ray.sunMu() + ground * ray.viewSun()) / planet.radius;
    const SkyColor eyeDepth =
        rt::depthOf(planet, rt::columns(planet, ray.altitude, ray.viewMu(), ground));
    const SkyColor sunDepth = rt::depthOf(planet, rt::columns(planet, 0, foot, rt::FAR));
    for (size_t c = 0; c < 3; ++c) {
      truth.single[c] += GROUND_ALBEDO / PI * std::max(foot, 0.0) *
                         (foot > 0 ? std::exp(-eyeDepth[c] - sunDepth[c]) : 0);
    }
  }
  truth.multiple = estimate.radiance;
  for (size_t c = 0; c < 3; ++c) {
    truth.error[c] = std::sqrt(estimate.variance[c]);
  }
  return truth;
}

double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

// Methods of one atmosphere and the time that their tables took.
struct Solved {
  welkin::SkyFieldInput input;
  SkyField field;
  bench::IsotropicSky isotropic;
};

Solved solve(const Atmosphere& atmosphere) {
  const welkin::SkyFieldInput input = inputFor(atmosphere);
  const double t0 = seconds();
  SkyField field = welkin::solveSkyField(input);
  const double t1 = seconds();
  bench::IsotropicSky isotropic(input);
  const double t2 = seconds();
  std::fprintf(stderr, "%s: moments %.2f s, isotropic %.2f s\n", atmosphere.name, t1 - t0, t2 - t1);
  return {input, std::move(field), std::move(isotropic)};
}

using Errors = std::array<std::vector<double>, METHOD_COUNT>;

void writeRay(std::FILE* file, const Atmosphere& atmosphere, const Group& group, uint32_t number,
              const Ray& ray, const Truth& truth, const Solved& solved, Errors& errors) {
  SkyColor phase{};
  phase.fill(rt::PhaseFunction::henyeyGreenstein(G).value(0, 1 - ray.viewSun()));
  const SkyColor moments = solved.field.higherOrdersAlong(ray.altitude, ray.viewMu(), ray.sunMu(),
                                                          ray.viewSun(), ray.length, phase);
  const SkyColor isotropic = solved.isotropic.radianceAlong(ray.altitude, ray.viewMu(), ray.sunMu(),
                                                            ray.viewSun(), ray.length);
  const char* end = truth.grounded ? "ground" : (group.aerial ? "air" : "space");
  for (size_t c = 0; c < 3; ++c) {
    const double total = truth.single[c] + truth.multiple[c];
    const bool used = truth.error[c] <= LARGEST_NOISE * total;
    const double values[METHOD_COUNT] = {moments[c], isotropic[c], 0};
    for (size_t m = 0; m < METHOD_COUNT && used; ++m) {
      errors[m].push_back(std::abs(values[m] - truth.multiple[c]) / total);
    }
    std::fprintf(file, "%s,\"%s\",%u,%c,%.4g,%.4g,%.4g,%.4g,%.4g,%s,%.4g,%.4g,%.4g,%.4g,%.4g,%d\n",
                 atmosphere.name, group.name, number, "rgb"[c], ray.sun_deg, ray.altitude,
                 ray.view_deg, ray.azimuth_deg, truth.length, end, truth.single[c],
                 truth.multiple[c], truth.error[c], values[0], values[1], used ? 1 : 0);
  }
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values.empty() ? 0 : values[static_cast<size_t>(std::lround(share * last))];
}

void printTable(const Atmosphere& atmosphere, const Group& group, const Errors& errors,
                size_t drawn) {
  std::printf("| %s | %s | %zu of %zu |", atmosphere.name, group.name, errors[0].size(), drawn);
  for (const std::vector<double>& of : errors) {
    std::printf(" %.2f / %.2f / %.2f |", 100 * quantile(of, 0.5), 100 * quantile(of, 0.9),
                100 * quantile(of, 1));
  }
  std::printf("\n");
  std::fflush(stdout);
}

int run(const std::string& path, uint32_t rays, uint64_t paths, uint64_t seed) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) {
    std::fprintf(stderr, "%s: cannot write\n", path.c_str());
    return 1;
  }
  std::fprintf(file,
               "atmosphere,group,ray,channel,sun_deg,altitude_m,view_deg,azimuth_deg,length_m,end,"
               "single,multiple,standard_error,moments,isotropic,used\n");
  std::printf("| atmosphere | rays | values |");
  for (const char* method : METHODS) {
    std::printf(" %s, %% |", method);
  }
  std::printf("\n|---|---|---|---|---|---|\n");
  for (const Atmosphere& atmosphere : ATMOSPHERES) {
    const Solved solved = solve(atmosphere);
    for (const Group& group : GROUPS) {
      const double begin = seconds();
      Errors errors;
      for (uint32_t i = 0; i < rays; ++i) {
        // The same rays in both atmospheres.
        rt::Random random(seed, static_cast<uint64_t>(&group - GROUPS), i, 0);
        const Ray ray = drawRay(group, solved.input.air.planetRadius, random);
        const Truth truth = truthFor(solved.input, ray, paths, i + 1);
        writeRay(file, atmosphere, group, i, ray, truth, solved, errors);
      }
      printTable(atmosphere, group, errors, size_t{3} * rays);
      std::fprintf(stderr, "%s, %s: %.1f s\n", atmosphere.name, group.name, seconds() - begin);
    }
  }
  return std::fclose(file) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Error of multiple scattering of sky light, by method"};
  std::string path;
  uint32_t rays = 32;
  uint64_t paths = 60000;
  uint64_t seed = 1;
  app.add_option("out", path, "CSV file to write")->required();
  app.add_option("--rays", rays, "rays per atmosphere and group")->check(CLI::Range(1, 100000));
  app.add_option("--paths", paths, "Monte Carlo paths per ray and channel")
      ->check(CLI::Range(2, 100000000));
  app.add_option("--seed", seed, "of the rays, default 1");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(path, rays, paths, seed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
