// SPDX-License-Identifier: MIT
// welkin phase: the phase function of a medium at given angles.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.hpp"
#include "common/api.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/scene.hpp"

namespace cli {
namespace {

struct PhaseOptions {
  std::string in;
  std::string out;
  std::string scene;
  std::string medium;
  std::vector<std::string> assignments;
  std::optional<std::string> type;
  std::optional<float> diameter_um;
  std::optional<float> asymmetry;
};

constexpr const char* PHASE_HELP = R"(
Column of IN, named by its first line (angle_deg if the first line holds a number):
  angle_deg   scattering angle, 0 is forward, degrees in [0, 180]
  angle_rad   the same in radians, [0, pi]
Columns of OUT: that of IN, then
  phase       phase function, 1/sr; integrates to 1 over the sphere
The medium is {"phase": "hg-draine", "dropletDiameter_um": 20, "asymmetry": 0.85}, or the one
called --medium of --scene; --set changes it (key=value, or media.NAME.key=value with --scene),
then --type, --diameter-um and --asymmetry do.)";

WlkMediumInfo readMedium(const PhaseOptions& options) {
  host::Json root = host::Json::object();
  std::string key;
  if (!options.scene.empty()) {
    root = host::readSceneJson(options.scene, options.assignments);
  } else {
    for (const std::string& assignment : options.assignments) {
      host::setJsonValue(root, assignment);
    }
  }
  const host::JsonNode whole(root, options.scene.empty() ? "--set" : options.scene);
  WlkMediumInfo info = host::parseMedium(
      options.scene.empty() ? whole : whole.at("media").at(options.medium.c_str()));
  if (options.type) {
    const host::Json type = *options.type;
    constexpr std::array<uint32_t, 3> PHASES = {WLK_PHASE_HG_DRAINE, WLK_PHASE_HENYEY_GREENSTEIN,
                                                WLK_PHASE_RAYLEIGH};
    info.phase = PHASES[host::JsonNode(type, "--type").word({"hg-draine", "hg", "rayleigh"})];
  }
  info.dropletDiameter_um = options.diameter_um.value_or(info.dropletDiameter_um);
  info.asymmetry = options.asymmetry.value_or(info.asymmetry);
  return info;
}

std::vector<double> readAngles(const host::CsvTable& table) {
  const int degrees = table.find("angle_deg");
  const int radians = table.find("angle_rad");
  if (table.columns.size() != 1 || (degrees < 0 && radians < 0)) {
    throw host::InputError(table.file, "line 1", "expected one column angle_deg or angle_rad");
  }
  std::vector<double> angles;
  for (size_t row = 0; row < table.rowCount(); ++row) {
    const double value = table.at(row, 0);
    // 180 degrees must give pi itself, not its neighbour: divide first.
    const double angle = degrees >= 0 ? value / 180.0 * host::PI : value;
    if (!(angle >= 0.0 && angle <= host::PI)) {
      table.fail(row, table.columns[0],
                 degrees >= 0 ? "expected degrees in [0, 180]" : "expected radians in [0, pi]");
    }
    angles.push_back(angle);
  }
  return angles;
}

void run(const PhaseOptions& options) {
  if (options.scene.empty() != options.medium.empty()) {
    throw host::InputError("command line", "--medium", "expected together with --scene");
  }
  const WlkMediumInfo medium = readMedium(options);
  const host::CsvTable table = host::readCsv(options.in, {{"angle_deg"}});
  const std::vector<double> angles = readAngles(table);
  std::vector<double> phase(angles.size());
  if (!angles.empty()) {
    host::check(
        wlkEvalPhase(&medium, static_cast<uint32_t>(angles.size()), angles.data(), phase.data()),
        options.scene.empty() ? "command line" : options.scene, "medium");
  }
  std::vector<double> values;
  for (size_t row = 0; row < angles.size(); ++row) {
    values.insert(values.end(), {table.at(row, 0), phase[row]});
  }
  host::writeCsv(options.out, {table.columns[0], "phase"}, values);
}

}  // namespace

void addPhase(CLI::App& app) {
  CLI::App* command = app.add_subcommand("phase", "Phase function of a medium at given angles");
  const auto options = std::make_shared<PhaseOptions>();
  command->footer(PHASE_HELP);
  command->add_option("--in", options->in, "Angles (CSV)")->required();
  command->add_option("--out", options->out, "Results (CSV)")->required();
  command->add_option("--type", options->type, "hg-draine, hg or rayleigh");
  command->add_option("--diameter-um", options->diameter_um,
                      "Droplet diameter for hg-draine, um in [5, 50]");
  command->add_option("--asymmetry", options->asymmetry, "Mean cosine for hg, [-0.999, 0.999]");
  command->add_option("--scene", options->scene, "Scene (JSON)");
  command->add_option("--medium", options->medium, "Name in the scene's media");
  command->add_option("--set", options->assignments, "key.path=value, over the scene or medium")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([options] { run(*options); });
}

}  // namespace cli
