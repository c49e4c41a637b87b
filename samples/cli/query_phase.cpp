// SPDX-License-Identifier: MIT
// welkin phase: phase function of a medium at given angles, angles drawn from it, and what one of
// its particles does to light.
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.hpp"
#include "common/api.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/scene.hpp"
#include "common/text.hpp"

namespace cli {
namespace {

struct PhaseOptions {
  std::string in;
  std::string angles;
  std::string samples;
  std::string out;
  std::string channel = "green";
  std::string scene;
  std::string medium;
  std::vector<std::string> assignments;
  std::optional<std::string> particle;
  std::optional<std::string> model;
  std::optional<float> diameter_um;
  std::optional<float> spread;
  std::optional<float> roughness;
  std::optional<float> asymmetry;
  std::optional<float> wavelength_um;
  std::string file;
  std::optional<uint32_t> order;
  std::optional<double> opticalDepth;
  bool optics = false;
};

constexpr size_t MAX_ANGLES = 10'000'000;

constexpr const char* PHASE_HELP = R"(
One of --in, --angles and --samples, with --out; --optics alone or with one of them.

Column of --in, named by its first line (angle_deg if the first line holds a number):
  angle_deg        scattering angle, 0 is forward, degrees in [0, 180]
  angle_rad        the same in radians, [0, pi]
Columns of --out: that of --in (angle_deg with --angles), then
  red, green, blue phase function at 680, 550, 440 nm, 1/sr; each integrates to 1 over the sphere

Column of --samples:
  random           numbers in [0, 1)
Columns of --out with --samples:
  angle_deg        the scattering angle that belongs to it in --channel, by inversion, degrees
  density          the phase function there, 1/sr

--order N gives the angles after exactly N scatterings ([R04] Eq. 20), --optical-depth T those of
light scattered at least once over the depth T (Poisson counts). Both are of --in and --angles.

--optics prints JSON: extinctionEfficiency, extinctionCrossSection_m2, asymmetry, forwardFraction,
deltaFraction (each [red, green, blue]) and effectiveRadius_um, as WlkMediumOptics.

The medium is {"particle": "cloud", "model": "default"}, or the one called --medium of --scene;
--set changes it (key=value, or media.NAME.key=value with --scene), then the options named as its
keys do. Keys, ranges and defaults: docs/scene-format.md, media. Table of --file: columns
angle_deg (rising from 0 to 180), red, green, blue (>= 0, any unit).)";

host::MediumDesc readMedium(const PhaseOptions& options) {
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
  WlkMediumInfo& info = medium.info;
  if (options.particle) {
    const host::Json word = *options.particle;
    info.particle = host::parseParticle(host::JsonNode(word, "command line", "--particle"));
  }
  if (options.model) {
    const host::Json word = *options.model;
    info.phaseModel = host::parsePhaseModel(host::JsonNode(word, "command line", "--model"));
  }
  info.diameter_um = options.diameter_um.value_or(info.diameter_um);
  info.spread = options.spread.value_or(info.spread);
  info.roughness = options.roughness.value_or(info.roughness);
  info.asymmetry = options.asymmetry.value_or(info.asymmetry);
  info.wavelength_um = options.wavelength_um.value_or(info.wavelength_um);
  if (!options.file.empty()) {
    medium.userAngle.clear();
    medium.userPhase.clear();
    host::readUserPhase(options.file, medium);
  }
  const bool user = info.particle == WLK_PARTICLE_USER;
  if (user == medium.userAngle.empty()) {
    throw host::InputError("command line", user ? "--file" : "--particle",
                           user ? "expected the table (CSV) of particle user"
                                : "expected user, the only one with a file");
  }
  return medium;
}

// Angles as the user wrote them, and in rad.
struct Angles {
  std::string column = "angle_deg";
  std::vector<double> written;
  std::vector<double> radians;
};

// 180 degrees must give pi itself, not its neighbour: divide first.
double radiansOf(double degrees) {
  return degrees / 180.0 * host::PI;
}

Angles readAngles(const std::string& file) {
  const host::CsvTable table = host::readCsv(file, {{"angle_deg"}});
  const bool degrees = table.find("angle_deg") >= 0;
  if (table.columns.size() != 1 || (!degrees && table.find("angle_rad") < 0)) {
    throw host::InputError(table.file, "line 1", "expected one column angle_deg or angle_rad");
  }
  Angles angles;
  angles.column = table.columns[0];
  for (size_t row = 0; row < table.rowCount(); ++row) {
    const double value = table.at(row, 0);
    const double angle = degrees ? radiansOf(value) : value;
    if (!(angle >= 0.0 && angle <= host::PI)) {
      table.fail(row, angles.column,
                 degrees ? "expected degrees in [0, 180]" : "expected radians in [0, pi]");
    }
    angles.written.push_back(value);
    angles.radians.push_back(angle);
  }
  return angles;
}

// BEGIN:END:STEP in degrees; END belongs to it if a whole number of steps leads there.
Angles parseAngles(const std::string& text) {
  const auto refuse = [](const std::string& expected) -> host::InputError {
    return {"command line", "--angles", "expected " + expected};
  };
  std::vector<double> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    const std::optional<double> number = host::parseNumber(text.substr(begin, end - begin));
    if (!number) {
      throw refuse("BEGIN:END:STEP in degrees, for example 0:180:0.5");
    }
    parts.push_back(*number);
    begin = end + 1;
  }
  if (parts.size() != 3) {
    throw refuse("BEGIN:END:STEP in degrees, for example 0:180:0.5");
  }
  if (!(parts[0] >= 0.0 && parts[1] >= parts[0] && parts[1] <= 180.0)) {
    throw refuse("0 <= BEGIN <= END <= 180 degrees");
  }
  // A millionth of a step makes up for the rounding of decimal steps such as 0.1.
  const double steps = std::floor((parts[1] - parts[0]) / parts[2] + 1e-6);
  if (!(parts[2] > 0.0 && steps < static_cast<double>(MAX_ANGLES))) {
    throw refuse("STEP > 0 and at most 10000000 angles");
  }
  Angles angles;
  for (size_t i = 0; i <= static_cast<size_t>(steps); ++i) {
    const double degrees = std::min(parts[0] + static_cast<double>(i) * parts[2], parts[1]);
    angles.written.push_back(degrees);
    angles.radians.push_back(radiansOf(degrees));
  }
  return angles;
}

void evaluate(const PhaseOptions& options, WlkContext context, WlkMedium medium) {
  const Angles angles = options.in.empty() ? parseAngles(options.angles) : readAngles(options.in);
  auto query = host::make<WlkPhaseQuery>();
  query.medium = medium;
  query.orderKind = options.order          ? uint32_t{WLK_ORDER_INTEGER}
                    : options.opticalDepth ? uint32_t{WLK_ORDER_POISSON}
                                           : uint32_t{WLK_ORDER_SINGLE};
  query.order = options.order.value_or(query.order);
  query.opticalDepth = options.opticalDepth.value_or(query.opticalDepth);
  query.count = static_cast<uint32_t>(angles.radians.size());
  query.scatteringAngle = angles.radians.data();
  std::vector<double> phase(angles.radians.size() * 3);
  host::check(wlkEvalPhase(context, &query, phase.data()), "command line", "");
  std::vector<double> values;
  for (size_t i = 0; i < angles.written.size(); ++i) {
    values.insert(values.end(),
                  {angles.written[i], phase[3 * i], phase[3 * i + 1], phase[3 * i + 2]});
  }
  host::writeCsv(options.out, {angles.column, "red", "green", "blue"}, values);
}

void sample(const PhaseOptions& options, WlkContext context, WlkMedium medium) {
  const host::Json word = options.channel;
  const uint32_t channel =
      host::JsonNode(word, "command line", "--channel").word({"red", "green", "blue"});
  const host::CsvTable table = host::readCsv(options.samples, {{"random"}});
  if (table.columns != std::vector<std::string>{"random"}) {
    throw host::InputError(table.file, "line 1", "expected one column random");
  }
  for (size_t row = 0; row < table.rowCount(); ++row) {
    if (!(table.at(row, 0) >= 0.0 && table.at(row, 0) < 1.0)) {
      table.fail(row, "random", "expected a number in [0, 1)");
    }
  }
  std::vector<double> angle(table.rowCount());
  std::vector<double> density(table.rowCount());
  host::check(wlkSamplePhase(context, medium, channel, static_cast<uint32_t>(angle.size()),
                             table.values.data(), angle.data(), density.data()),
              options.samples, "");
  std::vector<double> values;
  for (size_t i = 0; i < angle.size(); ++i) {
    values.insert(values.end(), {angle[i] / host::PI * 180.0, density[i]});
  }
  host::writeCsv(options.out, {"angle_deg", "density"}, values);
}

void printOptics(WlkContext context, WlkMedium medium) {
  auto optics = host::make<WlkMediumOptics>();
  host::check(wlkGetMediumOptics(context, medium, &optics), "wlkGetMediumOptics");
  const host::Json json = {{"extinctionEfficiency", optics.extinctionEfficiency},
                           {"extinctionCrossSection_m2", optics.extinctionCrossSection},
                           {"asymmetry", optics.asymmetry},
                           {"forwardFraction", optics.forwardFraction},
                           {"deltaFraction", optics.deltaFraction},
                           {"effectiveRadius_um", optics.effectiveRadius_um}};
  std::printf("%s\n", json.dump(2).c_str());
}

// What must not be combined, and what must.
void checkCombination(const PhaseOptions& options) {
  const auto refuse = [](const char* key, const char* expected) {
    throw host::InputError("command line", key, expected);
  };
  const bool evaluates = !options.in.empty() || !options.angles.empty();
  const bool samples = !options.samples.empty();
  if (options.scene.empty() != options.medium.empty()) {
    refuse("--medium", "expected together with --scene");
  }
  if ((!options.in.empty() && !options.angles.empty()) || (evaluates && samples)) {
    refuse(samples ? "--samples" : "--angles", "expected one of --in, --angles and --samples");
  }
  if (!evaluates && !samples && !options.optics) {
    refuse("--in", "expected one of --in, --angles, --samples and --optics");
  }
  if ((evaluates || samples) == options.out.empty()) {
    refuse("--out", "expected a file with --in, --angles or --samples, and only then");
  }
  if (options.order && options.opticalDepth) {
    refuse("--optical-depth", "expected --order or --optical-depth, not both");
  }
  if ((options.order || options.opticalDepth) && !evaluates) {
    refuse(options.order ? "--order" : "--optical-depth", "expected with --in or --angles");
  }
}

void run(const PhaseOptions& options) {
  checkCombination(options);
  const host::MediumDesc desc = readMedium(options);
  const WlkMediumInfo info = host::mediumInfo(desc);
  const host::ContextPtr context = host::makeCpuContext();
  WlkMedium medium{};
  host::check(wlkCreateMedium(context.get(), &info, &medium),
              options.scene.empty() ? "command line" : options.scene,
              options.scene.empty() ? "medium" : "media." + options.medium);
  if (!options.samples.empty()) {
    sample(options, context.get(), medium);
  } else if (!options.out.empty()) {
    evaluate(options, context.get(), medium);
  }
  if (options.optics) {
    printOptics(context.get(), medium);
  }
}

}  // namespace

void addPhase(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("phase", "Phase function of a medium: values, samples, optics");
  const auto options = std::make_shared<PhaseOptions>();
  command->footer(PHASE_HELP);
  command->add_option("--in", options->in, "Angles (CSV)");
  command->add_option("--angles", options->angles, "BEGIN:END:STEP, degrees in [0, 180]");
  command->add_option("--samples", options->samples, "Random numbers (CSV)");
  command->add_option("--out", options->out, "Results (CSV)");
  command->add_option("--channel", options->channel,
                      "red, green or blue, for --samples; default green");
  command->add_option("--order", options->order, "Exactly this many scatterings, [1, 1000]");
  command->add_option("--optical-depth", options->opticalDepth,
                      "Poisson counts over this depth, [0, 1e4]");
  command->add_flag("--optics", options->optics, "Print what one particle does to light (JSON)");
  command->add_option("--particle", options->particle,
                      "cloud, fog, haze, rain, ice-column, ice-plate, snow, air, "
                      "henyey-greenstein or user");
  command->add_option("--model", options->model, "default, analytic or table");
  command->add_option("--diameter", options->diameter_um, "Median diameter, um");
  command->add_option("--spread", options->spread, "Standard deviation of ln(diameter)");
  command->add_option("--roughness", options->roughness,
                      "Standard deviation of the slope of crystals' facets");
  command->add_option("--asymmetry", options->asymmetry,
                      "Mean cosine for henyey-greenstein, [-0.999, 0.999]");
  command->add_option("--wavelength", options->wavelength_um,
                      "One wavelength for all channels, um in [0.4, 0.7]");
  command->add_option("--file", options->file, "Table (CSV) for particle user");
  command->add_option("--scene", options->scene, "Scene (JSON)");
  command->add_option("--medium", options->medium, "Name in the scene's media");
  command->add_option("--set", options->assignments, "key.path=value, over the scene or medium")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([options] { run(*options); });
}

}  // namespace cli
