// SPDX-License-Identifier: MIT
// welkin sky: radiance and transmittance of air, absorber and fog along rays.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "common/apply.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"

namespace cli {
namespace {

struct SkyOptions {
  std::string in;
  std::string out;
  std::string scene;
  std::vector<std::string> assignments;
  uint32_t maxOrder = 0;
  bool orders = false;
};

constexpr const char* SKY_HELP = R"(
Columns of IN, named by its first line, or in this order if the first line holds numbers:
  x,y,z,dx,dy,dz,length   or   x,y,z,elevation_deg,azimuth_deg,length
    x, y, z          origin of the ray in the world, m
    dx, dy, dz       direction, any length but 0
    elevation_deg    direction over the horizon, degrees in [-90, 90]
    azimuth_deg      clockwise from -z over +x, degrees
    length           m, > 0, "inf" allowed; the ground ends the ray in any case
Columns of OUT: those of IN, then
  radiance_r, _g, _b        in-scattered radiance (no sun disk, no ground), unit of the lights'
                            irradiance per steradian; all orders of scattering, or with
                            --max-order 1 light that is scattered once
  first_r, _g, _b           with --orders: light that is scattered once
  transmittance_r, _g, _b   [0, 1]
r, g, b are 680, 550, 440 nm. Without --scene: clear air, one light of irradiance 1 overhead, no
ozone, no fog. --set changes either, for example
  --set lights.0.elevation_deg=5 --set fog.extinction=0.001
  --set atmosphere=mars --set planet.groundAlbedo=0 --set absorber={} --set fog=null)";

using Columns = std::vector<std::string>;
const Columns& vectorColumns() {
  static const Columns columns = {"x", "y", "z", "dx", "dy", "dz", "length"};
  return columns;
}
const Columns& angleColumns() {
  static const Columns columns = {"x", "y", "z", "elevation_deg", "azimuth_deg", "length"};
  return columns;
}

void checkColumns(const host::CsvTable& table, bool angles) {
  const Columns& expected = angles ? angleColumns() : vectorColumns();
  for (const std::string& name : expected) {
    if (table.find(name) < 0) {
      throw host::InputError(table.file, "line 1", "expected a column " + name);
    }
  }
  if (table.columns.size() != expected.size()) {
    throw host::InputError(table.file, "line 1",
                           "expected " + std::to_string(expected.size()) + " columns, got " +
                               std::to_string(table.columns.size()));
  }
}

double finiteAt(const host::CsvTable& table, size_t row, const char* column) {
  const double value = table.at(row, table.find(column));
  if (!std::isfinite(value)) {
    table.fail(row, column, "expected a finite number");
  }
  return value;
}

WlkRay rayOf(const host::CsvTable& table, size_t row, bool angles) {
  WlkRay ray{};
  constexpr double MAX_COORDINATE = 1e9;  // the API's bound on world points
  const char* const names[3] = {"x", "y", "z"};
  for (size_t i = 0; i < 3; ++i) {
    ray.origin[i] = finiteAt(table, row, names[i]);
    if (std::abs(ray.origin[i]) > MAX_COORDINATE) {
      table.fail(row, names[i], "expected a coordinate in [-1e9, 1e9] m");
    }
  }
  host::Vec3 direction;
  if (angles) {
    const double elevation = finiteAt(table, row, "elevation_deg");
    if (std::abs(elevation) > 90.0) {
      table.fail(row, "elevation_deg", "expected degrees in [-90, 90]");
    }
    direction = host::directionFromAngles(elevation, finiteAt(table, row, "azimuth_deg"));
  } else {
    direction = {finiteAt(table, row, "dx"), finiteAt(table, row, "dy"),
                 finiteAt(table, row, "dz")};
    const double size = host::length(direction);
    if (!(size > 0.0) || !std::isfinite(1.0 / size) || !std::isfinite(size)) {
      table.fail(row, "dx", "expected a direction that is not 0");
    }
    direction = host::normalize(direction);
  }
  ray.direction[0] = direction.x;
  ray.direction[1] = direction.y;
  ray.direction[2] = direction.z;
  ray.length = table.at(row, table.find("length"));
  if (!(ray.length > 0.0)) {
    table.fail(row, "length", "expected a length > 0 in m");
  }
  return ray;
}

host::Scene readScene(const SkyOptions& options) {
  if (!options.scene.empty()) {
    return host::parseScene(host::readSceneJson(options.scene, options.assignments), options.scene);
  }
  host::Json root = {{"sky", host::Json::object()},
                     {"lights", host::Json::array({host::Json::object()})}};
  for (const std::string& assignment : options.assignments) {
    host::setJsonValue(root, assignment);
  }
  return host::parseScene(root, "--set");
}

// Three columns of the output, by ray.
struct SkyColumns {
  std::string name;
  std::vector<double> values;
};

void run(const SkyOptions& options) {
  const host::Scene scene = readScene(options);
  const host::CsvTable table = host::readCsv(options.in, {vectorColumns(), angleColumns()});
  const bool angles = table.find("elevation_deg") >= 0 || table.find("azimuth_deg") >= 0;
  checkColumns(table, angles);
  std::vector<WlkRay> rays;
  rays.reserve(table.rowCount());
  for (size_t row = 0; row < table.rowCount(); ++row) {
    rays.push_back(rayOf(table, row, angles));
  }
  const host::ContextPtr context = host::makeCpuContext();
  host::applyWorld(context.get(), scene);
  auto batch = host::make<WlkRayBatch>();
  batch.count = static_cast<uint32_t>(rays.size());
  batch.stride = sizeof(WlkRay);
  batch.rays = rays.data();
  std::vector<SkyColumns> results{{"radiance", {}}};
  if (options.orders) {
    results.push_back({"first", {}});
  }
  std::vector<double> transmittance(rays.size() * 3);
  for (SkyColumns& result : results) {
    result.values.resize(rays.size() * 3);
    batch.maxOrder = result.name == "first" ? 1 : options.maxOrder;
    if (!rays.empty()) {
      host::check(wlkEvalSky(context.get(), &batch, result.values.data(), transmittance.data()),
                  options.in, "");
    }
  }
  results.push_back({"transmittance", std::move(transmittance)});
  std::vector<std::string> columns = table.columns;
  for (const SkyColumns& result : results) {
    for (const char* const channel : {"_r", "_g", "_b"}) {
      columns.push_back(result.name + channel);
    }
  }
  std::vector<double> values;
  values.reserve(rays.size() * columns.size());
  for (size_t row = 0; row < rays.size(); ++row) {
    for (size_t i = 0; i < table.columns.size(); ++i) {
      values.push_back(table.at(row, static_cast<int>(i)));
    }
    for (const SkyColumns& result : results) {
      values.insert(values.end(), &result.values[row * 3], &result.values[row * 3] + 3);
    }
  }
  host::writeCsv(options.out, columns, values);
}

}  // namespace

void addSky(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("sky", "Radiance and transmittance of air and fog along rays");
  const auto options = std::make_shared<SkyOptions>();
  command->footer(SKY_HELP);
  command->add_option("--in", options->in, "Rays (CSV)")->required();
  command->add_option("--out", options->out, "Results (CSV)")->required();
  command->add_option("--scene", options->scene, "Scene (JSON)");
  command->add_option("--set", options->assignments, "key.path=value, over the scene")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--max-order", options->maxOrder,
                   "Highest order of scattering: 0 for all (default), 1 for the first alone")
      ->check(CLI::IsMember({0U, 1U}));
  command->add_flag("--orders", options->orders, "Also columns of the first order");
  command->callback([options] { run(*options); });
}

}  // namespace cli
