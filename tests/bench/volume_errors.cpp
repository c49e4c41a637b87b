// SPDX-License-Identifier: MIT
// welkin_volume_errors: error of thick volumes against volume_truth.hpp, and CPU times of the light
// inside them and of a frame, for quality levels and forms of scattering. Rows of a result file
// that are not measured again stay as they are, so that a run may be done in parts.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>

#include "bench/front_methods.hpp"
#include "bench/front_report.hpp"
#include "bench/front_timing.hpp"
#include "bench/volume_errors_report.hpp"
#include "bench/volume_errors_scene.hpp"

namespace bench {
namespace {

struct Options {
  std::string truth;
  std::string les;
  std::string json;
  std::string csv;
  std::string page;
  std::string commit;
  std::vector<std::string> names;
  std::vector<std::string> levels;
  std::vector<std::string> forms;
  uint32_t rounds = 3;
  uint32_t light = 0;
  uint32_t cells = 0;
  bool quick = false;
};

struct Form {
  const char* name;
  uint32_t scattering;
};
constexpr Form FORMS[] = {{"all-orders", WLK_SCATTERING_ALL_ORDERS},
                          {"forward", WLK_SCATTERING_FORWARD},
                          {"forward-integer", WLK_SCATTERING_FORWARD_INTEGER},
                          {"single", WLK_SCATTERING_SINGLE}};

// Truth of light scattered once is for that form alone, and all other truth for the others.
bool fits(const VolumeGroup& group, const Form& form) {
  return (group.kind == "les-single") == (form.scattering == WLK_SCATTERING_SINGLE);
}

bool chosen(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& start) {
           return name.rfind(start, 0) == 0;
         });
}

bool named(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

// Of a quick run: one of each kind.
bool isQuick(const VolumeGroup& group) {
  return group.name == "sphere-10" || group.name == "cumulus-side-hg" ||
         group.name == "slab-hg-4-50";
}

struct Times {
  std::vector<double> computing;  // frames that compute the volume's light, ms
  std::vector<double> keeping;
  void add(const VolumeFrame& frame) {
    (frame.lightComputed ? computing : keeping).push_back(frame.cpu_ms);
  }
};

// Rows of one volume in one light. The frames that keep its light are timed in each round, and one
// that computes it.
Ordered measure(VolumeWorld& world, const VolumeGroup& group, uint32_t level, const Form& form,
                uint32_t rounds) {
  world.show(group, level, form.scattering);
  Ordered rows = Ordered::array();
  Times times;
  for (const VolumeShot& shot : group.shots) {
    const VolumeFrame frame = world.render(shot);
    const VolumeErrors errors = volumeErrors(world.picture(), shot.truth);
    // The first frame of all copies and makes things once; later rounds do not.
    if (!rows.empty() || rounds == 1) {
      times.add(frame);
    }
    rows.push_back({{"case", shot.name},
                    {"kind", group.kind},
                    {"level", levelName(level)},
                    {"form", form.name},
                    {"total", errors.total},
                    {"rms", nullptr},
                    {"rmsCovered", nullptr}});
    if (shot.truth.radiance.size() > 1) {
      rows.back()["rms"] = errors.rms;
      rows.back()["rmsCovered"] = errors.rmsCovered;
    }
  }
  for (uint32_t round = 1; round < rounds; ++round) {
    world.turnLight(static_cast<int>(round));
    times.add(world.render(group.shots[0]));
    times.add(world.render(group.shots[0]));
  }
  if (times.keeping.empty()) {
    times.add(world.render(group.shots[0]));
  }
  const double frame = medianOf(times.keeping);
  for (Ordered& row : rows) {
    row["light_ms"] = nullptr;
    if (!times.computing.empty()) {
      row["light_ms"] = medianOf(times.computing) - frame;
    }
    row["frame_ms"] = frame;
    row["rounds"] = rounds;
  }
  return rows;
}

void print(const Ordered& rows) {
  for (const Ordered& row : rows) {
    const auto percent = [&](const char* key) {
      return row.at(key).is_null() ? 0.0 : 100 * row.at(key).get<double>();
    };
    std::printf(
        "%-34s %-7s %-10s total %.3f rms %5.1f %% covered %5.1f %% light %.0f frame %.0f\n",
        row.at("case").get<std::string>().c_str(), row.at("level").get<std::string>().c_str(),
        row.at("form").get<std::string>().c_str(), row.at("total").get<double>(), percent("rms"),
        percent("rmsCovered"), percent("light_ms") / 100, percent("frame_ms") / 100);
  }
  std::fflush(stdout);
}

Ordered deviceOf(const WlkCapabilities& device) {
  return {{"name", std::string(device.deviceName)},
          {"driver", "Vulkan " + std::to_string(device.vulkanVersion >> 22 & 0x7fu) + "." +
                         std::to_string(device.vulkanVersion >> 12 & 0x3ffu) + "." +
                         std::to_string(device.vulkanVersion & 0xfffu)}};
}

void save(const Options& options, const Ordered& report) {
  if (!options.json.empty()) {
    writeJson(options.json, report);
  }
  if (!options.csv.empty()) {
    writeCsv(options.csv, report["rows"]);
  }
}

void run(const Options& options) {
  Ordered report = reportHead(options.commit, options.quick);
  report.erase("rows");
  report["rounds"] = options.rounds;
  report["rows"] = Ordered::array();
  if (!options.json.empty()) {
    report["rows"] = readRows(options.json);
  }
  const std::vector<VolumeGroup> groups = volumeGroups(options.truth, options.les);
  VolumeWorld world(options.light, options.cells);
  report["device"] = deviceOf(world.capabilities());
  const Form* warm = nullptr;
  for (const Form& form : FORMS) {
    for (uint32_t level = 0; level < LEVEL_COUNT; ++level) {
      for (const VolumeGroup& group : groups) {
        if (!chosen(options.names, group.name) || !chosen(options.levels, levelName(level)) ||
            !named(options.forms, form.name) || !fits(group, form) ||
            (options.quick && !isQuick(group))) {
          continue;
        }
        if (warm != &form) {  // the driver compiles when a pipeline is used first
          world.show(group, WLK_QUALITY_LOW, form.scattering);
          world.render(group.shots[0]);
          warm = &form;
        }
        Ordered rows = measure(world, group, level, form, options.quick ? 1 : options.rounds);
        print(rows);
        for (Ordered& row : rows) {
          row["commit"] = options.commit;
          putRow(report["rows"], row);
        }
        save(options, report);  // a run that is cut short leaves what it has
      }
    }
  }
  save(options, report);
  if (!options.page.empty()) {
    writeTables(options.page, report["rows"]);
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  CLI::App app("Errors of thick volumes against Monte Carlo, and their times");
  bench::Options options;
  const auto several = [&](const char* name, std::vector<std::string>& target, const char* text) {
    app.add_option(name, target, text)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  app.add_option("--truth", options.truth, "Folder of the truth, tests/bench/reference/volumes")
      ->required();
  app.add_option("--les", options.les, "Data of the cloud of samples/scenes/les-cloud.json");
  app.add_option("--out", options.json, "JSON file; its rows stay unless measured again");
  app.add_option("--csv", options.csv, "The same rows as CSV");
  app.add_option("--docs", options.page, "Page whose tables are written from all rows");
  app.add_option("--commit", options.commit, "Name of the source's state, for the results");
  several("--case", options.names, "Volumes whose names begin with this; may be repeated");
  several("--level", options.levels, "low, medium, high or ultra; may be repeated");
  several("--form", options.forms,
          "all-orders, forward, forward-integer or single; may be repeated");
  app.add_option("--light", options.light,
                 "Texels along the light buffer's edge (default: the level's)");
  app.add_option("--cells", options.cells,
                 "Cells along the edge of the grid of light (default: the level's)");
  app.add_option("--rounds", options.rounds, "Of timing (default 3)")->check(CLI::Range(1, 1000));
  app.add_flag("--quick", options.quick, "One volume of each kind, one round");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
