// SPDX-License-Identifier: MIT
// welkin_surface_search TRUTH-FOLDER: the search for collectors of [B08] 6.1, which the library
// does not need, over light maps of a slab, of spheres and of the clouds of surface_views.hpp, as
// CSV on standard output: docs/results/surface-search.csv. `plain` is the iteration as printed, its
// steps at most a width long; `damped` goes half the way (collectorStep). Searches, of eight sets
// in each pixel, and pixels, all of whose eight do, count as converged if the next step after ten
// would be shorter than TOLERANCE widths. `lost`: searches that left the map's cloud. `light`,
// `rms`: what the damped search sees scattered more than once, ratio of totals and rms of the
// difference, against the shipped rule's for slab and spheres, against Monte Carlo for the clouds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <numbers>
#include <string>

#include "bench/surface_views.hpp"
#include "model/model.hpp"
#include "tables/canonical_phase.hpp"
#include "unit/surface_picture.hpp"

namespace {

using namespace welkin;
using namespace welkin::model::f64;
namespace rt = welkin::reference;
using rt::Point;
using test::LightMap;
using test::LightTexel;

constexpr int ITERATIONS = 10;
constexpr double TOLERANCE = 0.1;  // widths
constexpr size_t MAP_SIZE = 256;
constexpr int PIXELS = 40;  // of a sphere's picture
const vec3 TO_LIGHT(0, 0, 1);

vec3 vec(const Point& p) {
  return {p[0], p[1], p[2]};
}

// What a ray meets first and where it leaves for good; false where there is nothing.
struct Hit {
  double begin = 0, end = 0;
  Point normal{};
};
using Shape = std::function<bool(const Point&, const Point&, Hit&)>;

// Depth maps as [B08] 7 has them: between Zmin and Zmax all is cloud.
LightMap mapOf(const Shape& shape, double half) {
  std::vector<LightTexel> texels;
  const double texel = 2 * half / static_cast<double>(MAP_SIZE);
  const double above = 10 * half;
  for (size_t i = 0; i < MAP_SIZE * MAP_SIZE; ++i) {
    Hit hit;
    const double x = (static_cast<double>(i % MAP_SIZE) + 0.5) * texel - half;
    const double y = (static_cast<double>(i / MAP_SIZE) + 0.5) * texel - half;
    const bool there = shape({x, y, above}, {0, 0, -1}, hit);
    texels.push_back(there ? LightTexel{1, hit.end - hit.begin, above - hit.begin, hit.normal, {}}
                           : LightTexel{});
  }
  return {std::move(texels), half};
}

struct Collector {
  bool there = false;
  vec2 centre{0, 0};
  double width = 0;
  double light = 0;
};

// One step of 6.1: the collector of the slab that is tangent to the surface, filtered by `width`,
// under `centre`.
Collector collectorFrom(const CanonicalTable& table, const LightMap& map, size_t set, const vec3& p,
                        const vec3& toEye, const vec2& centre, double width) {
  Collector result;
  const LightTexel at =
      map.at(centre.x, centre.y, footprintLevel(width * std::numbers::sqrt2 / 2, map.texel()));
  if (!(at.coverage > COVERAGE_LEAST)) {
    return result;
  }
  const vec3 normal = directionOr(vec(at.lit), TO_LIGHT);
  const vec3 surface(centre.x, centre.y, footprintMean(at.top, at.coverage));
  const double mu = std::max(dot(normal, TO_LIGHT), CANONICAL_COSINE);
  const TangentSlab slab = tangentSlab(footprintMean(at.through, at.coverage),
                                       dot(surface - p, normal) / mu, normal, TO_LIGHT, toEye);
  const CanonicalTransport found = table.transport(
      set, {std::max(slab.thickness, 1e-6), slab.depth, slab.muView, slab.phi, slab.muLight});
  // x along the light's horizontal way, y to the view's side of it.
  const vec3 view = toEye + normal * slab.muView;
  const vec3 along =
      directionOr(normal * dot(normal, TO_LIGHT) - TO_LIGHT, directionOr(view, vec3(0, 0, 0)));
  const vec3 side = directionOr(view - along * dot(view, along), vec3(0, 0, 0));
  const vec3 entry = p + normal * slab.depth + along * found.x + side * found.y;
  result.there = true;
  result.centre = vec2(entry.x, entry.y);
  result.width = found.width;
  result.light = found.radiance;
  return result;
}

struct Search {
  bool converged = false;
  bool lost = false;
  double light = 0;
};

Search search(const CanonicalTable& table, const LightMap& map, size_t set, const vec3& p,
              const vec3& toEye, double whole, bool damped) {
  vec2 centre(p.x, p.y);
  Collector found = collectorFrom(table, map, set, p, toEye, centre, whole);
  for (int i = 0; i < ITERATIONS && found.there; ++i) {
    const double residual = collectorResidual(centre, found.centre, found.width);
    centre = damped ? collectorStep(centre, found.centre, found.width)
                    : centre + (found.centre - centre) * (1 / std::max(residual, 1.0));
    found = collectorFrom(table, map, set, p, toEye, centre, found.width);
  }
  if (!found.there) {
    return {false, true, 0};
  }
  return {collectorResidual(centre, found.centre, found.width) < TOLERANCE, false, found.light};
}

struct Counts {
  size_t searches = 0, pixels = 0;
  std::array<size_t, 2> converged{}, converging{}, lost{};  // plain, damped
  double light = 0, truth = 0, squares = 0, difference = 0;

  void add(double found, double expected, double noise) {
    light += found;
    truth += expected;
    squares += expected * expected;
    difference += (found - expected) * (found - expected) - noise * noise;
  }
  void print(const std::string& name) const {
    const auto per = [](size_t part, size_t of) {
      return 100 * static_cast<double>(part) / static_cast<double>(of);
    };
    std::printf("%s,%zu", name.c_str(), pixels);
    for (size_t i = 0; i < 2; ++i) {
      std::printf(",%.2f,%.2f,%.2f", per(converged[i], searches), per(converging[i], pixels),
                  per(lost[i], searches));
    }
    std::printf(",%.2f,%.2f\n", light / truth, std::sqrt(std::max(difference, 0.0) / squares));
    std::fflush(stdout);
  }
};

// Light of all sets by the damped search.
double searchPixel(const CanonicalTable& table, const LightMap& map, const Point& p,
                   const Point& direction, double whole, Counts& counts) {
  double light = 0;
  std::array<bool, 2> all = {true, true};
  for (size_t set = 0; set < CANONICAL_SETS; ++set) {
    ++counts.searches;
    for (const bool damped : {false, true}) {
      const Search found = search(table, map, set, vec(p), -vec(direction), whole, damped);
      const size_t i = damped ? 1 : 0;
      counts.converged[i] += found.converged ? 1 : 0;
      counts.lost[i] += found.lost ? 1 : 0;
      all[i] = all[i] && found.converged;
      light += damped ? found.light : 0;
    }
  }
  ++counts.pixels;
  counts.converging[0] += all[0] ? 1U : 0U;
  counts.converging[1] += all[1] ? 1U : 0U;
  return light;
}

// "slab", 20 deep and 20 times as wide: where the search must find the slab's own light.
rt::Body bodyOf(const std::string& name) {
  return name == "slab" ? rt::Body{{{true, {0, 0, 0}, {200, 200, 10}, 0}}, 210}
                        : rt::makeBody(name);
}

void searchBody(const CanonicalTable& table, const SurfaceSource& source, const std::string& name,
                int angle) {
  const rt::Body body = bodyOf(name);
  const Shape shape = [&](const Point& origin, const Point& direction, Hit& hit) {
    const std::vector<rt::Stretch> inside = body.inside(origin, direction);
    if (!inside.empty()) {
      hit = {inside.front().begin, inside.back().end, inside.front().beginNormal};
    }
    return !inside.empty();
  };
  const LightMap paper = mapOf(shape, body.half);
  const LightMap shipped(body, MAP_SIZE);
  const test::SurfaceCloud notOnce = {[](double) { return 0.0; }, 1};
  Counts counts;
  for (int i = 0; i < PIXELS * PIXELS; ++i) {
    const rt::BodyRay ray =
        rt::bodyRay(body, angle * std::numbers::pi / 180, 2 * (i % PIXELS + 0.5) / PIXELS - 1,
                    2 * (i / PIXELS + 0.5) / PIXELS - 1);
    Hit hit;
    if (shape(ray.origin, ray.direction, hit)) {
      const Point p = rt::along(ray.origin, ray.direction, hit.begin);
      counts.add(searchPixel(table, paper, p, ray.direction, body.half, counts),
                 test::surfaceRadiance(body, shipped, source, ray, notOnce), 0);
    }
  }
  counts.print(name + "-" + std::to_string(angle));
}

// Turned and scaled so that the light travels along -z and lengths are optical.
void searchCloud(const CanonicalTable& table, const bench::SurfaceView& view,
                 const std::string& folder) {
  bench::BodyMesh mesh = bench::bodyMesh(view.body);
  const double scale = view.extinction * (1 - canonicalPhase().removed);
  const Point z = rt::normalized(view.sun);
  const Point x = rt::normalized(rt::cross({0.1, 0.6, 0.8}, z));
  const Point y = rt::cross(z, x);
  const rt::MeshBody before = bench::referenceBody(mesh);
  Point middle{};
  for (size_t k = 0; k < 3; ++k) {
    middle[k] = (before.low()[k] + before.high()[k]) / 2;
  }
  const auto turned = [&](const Point& p, const Point& origin, double by) {
    const Point d = rt::minus(p, origin);
    return Point{by * rt::dot(d, x), by * rt::dot(d, y), by * rt::dot(d, z)};
  };
  double half = 0;
  for (size_t i = 0; i < mesh.positions.size(); i += 3) {
    const Point p = turned(
        {double{mesh.positions[i]}, double{mesh.positions[i + 1]}, double{mesh.positions[i + 2]}},
        middle, scale);
    for (size_t k = 0; k < 3; ++k) {
      mesh.positions[i + k] = static_cast<float>(p[k]);
      half = std::max(half, 1.02 * std::fabs(p[k]));
    }
  }
  const rt::MeshBody body = bench::referenceBody(mesh);
  std::vector<rt::MeshStretch> found;
  const Shape shape = [&](const Point& origin, const Point& direction, Hit& hit) {
    body.inside(origin, direction, found);
    if (!found.empty()) {
      hit = {found.front().begin, found.back().end, body.normal(found.front().front)};
    }
    return !found.empty();
  };
  const LightMap map = mapOf(shape, half);
  const bench::SurfaceTruthImage truth = bench::readSurfaceTruth(folder + "/" + view.name + ".csv");
  const Point origin = turned(view.eye, middle, scale);
  Counts counts;
  for (const bench::SurfacePixel& pixel : truth.pixels) {
    constexpr int RAYS = 2;
    double light = 0;
    for (int ray = 0; ray < RAYS * RAYS; ++ray) {
      const Point direction = turned(bench::pixelWay(view, pixel.x + (ray % RAYS + 0.5) / RAYS,
                                                     pixel.y + (ray / RAYS + 0.5) / RAYS),
                                     {}, 1);
      Hit hit;
      if (shape(origin, direction, hit)) {
        light += searchPixel(table, map, rt::along(origin, direction, hit.begin), direction, half,
                             counts) /
                 (RAYS * RAYS);
      }
    }
    counts.add(light, pixel.rest, pixel.restError);
  }
  counts.print(view.name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: welkin_surface_search TRUTH-FOLDER\n");
    return 2;
  }
  try {
    const CanonicalTable table = decodeCanonical(shippedCanonical());
    const SurfaceSource source = surfaceSource(table);
    std::printf(
        "view,pixels,plain_searches,plain_pixels,plain_lost,damped_searches,damped_pixels,"
        "damped_lost,light,rms\n");
    for (const char* name : {"sphere-2", "sphere-10", "sphere-30"}) {
      for (const int angle : {180, 120, 90, 60, 20}) {
        searchBody(table, source, name, angle);
      }
    }
    for (const int angle : {180, 120, 60, 20}) {
      searchBody(table, source, "slab", angle);
    }
    for (const bench::SurfaceView& view : bench::surfaceViews()) {
      searchCloud(table, view, argv[1]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
