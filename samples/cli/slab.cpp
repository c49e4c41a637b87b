// SPDX-License-Identifier: MIT
// welkin slab: exact radiance and fluxes of homogeneous plane-parallel slabs, row by row, with the
// reference solvers of the tests.
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "common/api.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/scene.hpp"
#include "common/vec.hpp"
#include "reference/slab_monte_carlo.hpp"
#include "reference/slab_solver.hpp"

namespace cli {
namespace {

namespace rt = welkin::reference;

struct SlabOptions {
  std::string in;
  std::string out;
  std::string method = "ordinates";
  int nodes = 48;
  uint64_t samples = 100'000;
  uint64_t seed = 1;
  std::string scene;
  std::string medium;
  std::vector<std::string> assignments;
  std::optional<std::string> particle;
  std::optional<float> diameter_um;
  std::optional<float> wavelength_um;
};

constexpr const char* SLAB_HELP = R"(
Columns of IN, named by its first line, or in this order if the first line holds numbers:
  tau              optical thickness across the slab, [1e-6, 1e6]
  albedo           single-scattering albedo, [0, 1]
  g                mean cosine of Henyey-Greenstein, [-0.999, 0.999]; only without a medium
  sunZenith_deg    degrees in [0, 89.999]
  viewZenith_deg   between the zenith and the light's direction of travel, degrees in [0, 180] but
                   90: below 90 it leaves the top (reflected), above the bottom (transmitted)
  azimuth_deg      between the directions of travel of the light and of the beam; 0 is forward, so
                   that viewZenith = 180 - sunZenith with azimuth 0 looks into the sun
  surfaceAlbedo    of a Lambertian surface below, [0, 1]; may be absent: 0
Columns of OUT: those of IN, then, per unit irradiance on a surface that faces the beam,
  radiance         of all orders, without the beam itself, 1/sr
  single           the part that was scattered or reflected once
  fluxUp           through the top; fluxDown: diffuse, through the bottom; fluxDirect: what is left
                   of the beam there. Without absorption their sum is the cosine of sunZenith
With a medium (--particle, or --medium of --scene; --set as in welkin phase) each comes as _r, _g,
_b. Light that goes straight on (WlkMediumOptics::deltaFraction) counts as unscattered: it is taken
off tau and albedo, and is in fluxDirect.

--method ordinates is exact to six digits where the phase function is smooth; --nodes are directions
per hemisphere, 8 to 256. --method montecarlo gives radiance and its standardError instead, with
--samples and --seed, over a black surface.)";

using SlabColumns = std::vector<std::string>;

SlabColumns slabColumns(bool medium) {
  SlabColumns columns = {"tau", "albedo", "sunZenith_deg", "viewZenith_deg", "azimuth_deg"};
  if (!medium) {
    columns.insert(columns.begin() + 2, "g");
  }
  return columns;
}

struct SlabRow {
  double tau;
  double albedo;
  double g;
  double mu0;
  rt::SlabView view;
  double surface;
};

double cosineOf(double degrees) {
  // 60 degrees and the like must not depend on how pi rounds at 90.
  return std::sin((90.0 - degrees) / 180.0 * host::PI);
}

SlabRow slabRowOf(const host::CsvTable& table, size_t row) {
  const auto value = [&](const char* column, double low, double high, const char* expected) {
    const int index = table.find(column);
    const double v = index < 0 ? 0.0 : table.at(row, index);
    if (!(v >= low && v <= high)) {
      table.fail(row, column, expected);
    }
    return v;
  };
  SlabRow result{};
  result.tau = value("tau", 1e-6, 1e6, "expected an optical thickness in [1e-6, 1e6]");
  result.albedo = value("albedo", 0.0, 1.0, "expected a number in [0, 1]");
  result.g = value("g", -0.999, 0.999, "expected a number in [-0.999, 0.999]");
  const double sun = value("sunZenith_deg", 0.0, 89.999, "expected degrees in [0, 89.999]");
  const double view = value("viewZenith_deg", 0.0, 180.0, "expected degrees in [0, 180]");
  if (std::abs(view - 90.0) < 1e-6) {
    table.fail(row, "viewZenith_deg", "expected degrees in [0, 180] but 90");
  }
  const double azimuth = value("azimuth_deg", -1e6, 1e6, "expected degrees");
  result.surface = value("surfaceAlbedo", 0.0, 1.0, "expected a number in [0, 1]");
  result.mu0 = cosineOf(sun);
  result.view = {cosineOf(view), azimuth / 180.0 * host::PI};
  return result;
}

// A medium in one colour.
struct SlabColour {
  std::vector<double> angle;
  std::vector<double> value;
  double straight = 0.0;  // delta fraction
  rt::SlabPhase phase;
};

// Angles dense around both ends, where peaks and glories are; 5e-4 rad in between.
std::vector<double> slabAngles() {
  std::vector<double> angles{0.0};
  while (angles.back() < host::PI) {
    const double end = std::min(angles.back(), host::PI - angles.back());
    angles.push_back(angles.back() + std::clamp(0.01 * end, 1e-5, 5e-4));
  }
  angles.back() = host::PI;
  return angles;
}

host::MediumDesc slabMediumDesc(const SlabOptions& options) {
  host::Json root = host::Json::object();
  if (!options.scene.empty()) {
    root = host::readSceneJson(options.scene, options.assignments);
  } else {
    for (const std::string& assignment : options.assignments) {
      host::setJsonValue(root, assignment);
    }
  }
  const host::JsonNode whole(root, options.scene.empty() ? "--set" : options.scene);
  host::MediumDesc medium = host::parseMedium(
      options.scene.empty() ? whole : whole.at("media").at(options.medium.c_str()));
  if (options.particle) {
    const host::Json word = *options.particle;
    medium.info.particle = host::parseParticle(host::JsonNode(word, "command line", "--particle"));
  }
  medium.info.diameter_um = options.diameter_um.value_or(medium.info.diameter_um);
  medium.info.wavelength_um = options.wavelength_um.value_or(medium.info.wavelength_um);
  return medium;
}

std::vector<SlabColour> slabColours(const SlabOptions& options) {
  constexpr int MOMENTS = 1500;  // droplets of 50 um: 8e-6 at the end
  const host::MediumDesc desc = slabMediumDesc(options);
  const WlkMediumInfo info = host::mediumInfo(desc);
  const host::ContextPtr context = host::makeCpuContext();
  WlkMedium medium{};
  host::check(wlkCreateMedium(context.get(), &info, &medium),
              options.scene.empty() ? "command line" : options.scene,
              options.scene.empty() ? "medium" : "media." + options.medium);
  const std::vector<double> angles = slabAngles();
  auto query = host::make<WlkPhaseQuery>();
  query.medium = medium;
  query.count = static_cast<uint32_t>(angles.size());
  query.scatteringAngle = angles.data();
  std::vector<double> phase(angles.size() * 3);
  host::check(wlkEvalPhase(context.get(), &query, phase.data()), "wlkEvalPhase");
  auto optics = host::make<WlkMediumOptics>();
  host::check(wlkGetMediumOptics(context.get(), medium, &optics), "wlkGetMediumOptics");
  std::vector<SlabColour> colours(3);
  for (size_t c = 0; c < 3; ++c) {
    colours[c].angle = angles;
    for (size_t i = 0; i < angles.size(); ++i) {
      colours[c].value.push_back(phase[3 * i + c]);
    }
    colours[c].straight = double{optics.deltaFraction[c]};
    // Moments take most of a second: grey media need them once.
    colours[c].phase = c > 0 && colours[c].value == colours[c - 1].value
                           ? colours[c - 1].phase
                           : rt::tabulatedSlabPhase(angles, colours[c].value, MOMENTS);
  }
  return colours;
}

// Solvers by colour (or g) and albedo: what they prepare serves all rows.
class SlabMethods {
 public:
  SlabMethods(const SlabOptions& options, std::vector<SlabColour> colours)
      : options_(options), colours_(std::move(colours)) {}

  size_t channels() const { return std::max<size_t>(colours_.size(), 1); }

  // Values per channel, in the order of names().
  std::vector<double> evaluate(SlabRow row, size_t channel, size_t index) {
    if (!colours_.empty()) {
      const double unscattered = colours_[channel].straight * row.albedo;
      row.tau *= 1.0 - unscattered;
      if (row.albedo < 1.0) {
        row.albedo = (row.albedo - unscattered) / (1.0 - unscattered);
      }
    }
    return options_.method == "ordinates" ? ordinates(row, channel)
                                          : monteCarlo(row, channel, index);
  }

  static SlabColumns names(bool monteCarlo) {
    return monteCarlo ? SlabColumns{"radiance", "standardError"}
                      : SlabColumns{"radiance", "single", "fluxUp", "fluxDown", "fluxDirect"};
  }

 private:
  std::vector<double> ordinates(const SlabRow& row, size_t channel) {
    const double key = colours_.empty() ? row.g : static_cast<double>(channel);
    auto found = solvers_.find({key, row.albedo});
    if (found == solvers_.end()) {
      rt::SlabPhase phase =
          colours_.empty() ? rt::henyeyGreensteinSlabPhase(row.g) : colours_[channel].phase;
      found = solvers_
                  .emplace(std::pair(key, row.albedo),
                           rt::SlabSolver(std::move(phase), row.albedo, options_.nodes))
                  .first;
    }
    const rt::SlabSolver& solver = found->second;
    const rt::SlabRadiance radiance = solver.radiance(row.tau, row.mu0, row.view, row.surface);
    const rt::SlabFlux bottom = solver.flux(row.tau, row.mu0, row.tau, row.surface);
    return {radiance.total, radiance.single, solver.flux(row.tau, row.mu0, 0.0, row.surface).up,
            bottom.down, bottom.direct};
  }

  std::vector<double> monteCarlo(const SlabRow& row, size_t channel, size_t index) {
    auto phase = rt::PhaseFunction::henyeyGreenstein(row.g);
    if (!colours_.empty()) {
      if (sampled_.empty()) {
        for (const SlabColour& colour : colours_) {
          std::vector<rt::Rgb> values;
          for (const double one : colour.value) {
            values.push_back({one, one, one});
          }
          sampled_.push_back(rt::PhaseFunction::table(colour.angle, values));
        }
      }
      phase = sampled_[channel];
    }
    const rt::SlabEstimate estimate =
        rt::slabRadianceMonteCarlo(row.tau, row.albedo, phase, row.mu0, row.view.mu, row.view.phi,
                                   options_.samples, options_.seed + 3 * index + channel);
    return {estimate.value, estimate.standardError};
  }

  const SlabOptions& options_;
  std::vector<SlabColour> colours_;
  std::vector<rt::PhaseFunction> sampled_;
  std::map<std::pair<double, double>, rt::SlabSolver> solvers_;
};

host::CsvTable readSlabTable(const SlabOptions& options, bool medium) {
  const SlabColumns columns = slabColumns(medium);
  SlabColumns withSurface = columns;
  withSurface.emplace_back("surfaceAlbedo");
  host::CsvTable table = host::readCsv(options.in, {columns, withSurface});
  for (const std::string& name : columns) {
    if (table.find(name) < 0) {
      throw host::InputError(table.file, "line 1", "expected a column " + name);
    }
  }
  const size_t expected = columns.size() + (table.find("surfaceAlbedo") >= 0 ? 1 : 0);
  if (table.columns.size() != expected) {
    throw host::InputError(table.file, "line 1",
                           medium ? "expected no other columns than tau, albedo, sunZenith_deg, "
                                    "viewZenith_deg, azimuth_deg, surfaceAlbedo"
                                  : "expected no other columns than tau, albedo, g, sunZenith_deg, "
                                    "viewZenith_deg, azimuth_deg, surfaceAlbedo");
  }
  return table;
}

void runSlab(const SlabOptions& options) {
  const auto refuse = [](const char* key, const char* expected) {
    throw host::InputError("command line", key, expected);
  };
  if (options.method != "ordinates" && options.method != "montecarlo") {
    refuse("--method", "expected ordinates or montecarlo");
  }
  if (options.nodes < 8 || options.nodes > 256) {
    refuse("--nodes", "expected a number in [8, 256]");
  }
  if (options.scene.empty() != options.medium.empty()) {
    refuse("--medium", "expected together with --scene");
  }
  const bool medium = options.particle || options.diameter_um || options.wavelength_um ||
                      !options.scene.empty() || !options.assignments.empty();
  checkFolders({options.out});
  const bool random = options.method == "montecarlo";
  const host::CsvTable table = readSlabTable(options, medium);
  SlabMethods methods(options, medium ? slabColours(options) : std::vector<SlabColour>{});
  SlabColumns columns = table.columns;
  const SlabColumns names = SlabMethods::names(random);
  for (const std::string& name : names) {
    if (medium) {
      columns.insert(columns.end(), {name + "_r", name + "_g", name + "_b"});
    } else {
      columns.push_back(name);
    }
  }
  std::vector<double> values;
  values.reserve(table.rowCount() * columns.size());
  for (size_t i = 0; i < table.rowCount(); ++i) {
    const SlabRow row = slabRowOf(table, i);
    if (random && row.surface > 0.0) {
      table.fail(i, "surfaceAlbedo", "expected 0 with --method montecarlo");
    }
    std::vector<std::vector<double>> results;
    for (size_t c = 0; c < methods.channels(); ++c) {
      results.push_back(methods.evaluate(row, c, i));
    }
    for (size_t column = 0; column < table.columns.size(); ++column) {
      values.push_back(table.at(i, static_cast<int>(column)));
    }
    for (size_t name = 0; name < names.size(); ++name) {
      for (const std::vector<double>& channel : results) {
        values.push_back(channel[name]);
      }
    }
  }
  host::writeCsv(options.out, columns, values);
}

}  // namespace

void addSlab(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("slab", "Exact radiance and fluxes of plane-parallel slabs");
  const auto options = std::make_shared<SlabOptions>();
  command->footer(SLAB_HELP);
  command->add_option("--in", options->in, "Slabs and directions (CSV)")->required();
  command->add_option("--out", options->out, "Results (CSV)")->required();
  command->add_option("--method", options->method, "ordinates (default) or montecarlo");
  command->add_option("--nodes", options->nodes, "Directions per hemisphere; default 48");
  command->add_option("--samples", options->samples, "Paths per value; default 100000")
      ->check(CLI::Range(uint64_t{2}, uint64_t{1} << 40));
  command->add_option("--seed", options->seed, "Of the random numbers; default 1")
      ->check(CLI::Range(uint64_t{0}, uint64_t{1} << 63));
  command->add_option("--particle", options->particle, "As in welkin phase");
  command->add_option("--diameter", options->diameter_um, "Median diameter, um");
  command->add_option("--wavelength", options->wavelength_um,
                      "One wavelength for all channels, um in [0.4, 0.7]");
  command->add_option("--scene", options->scene, "Scene (JSON)");
  command->add_option("--medium", options->medium, "Name in the scene's media");
  command->add_option("--set", options->assignments, "key.path=value, over the scene or medium")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([options] { runSlab(*options); });
}

}  // namespace cli
