// SPDX-License-Identifier: MIT
// welkin_volume_cost OUT.json: time of a frame of one cloud, single scattering, beside its error
// against quadrature, of the library, of per-slice half-angle slicing ([R04], Kniss et al.) in its
// best form and of a march vectorised by hand; the library's sample rate beside that of a bare
// loop; how its cost grows; what a second core gains. Prints the tables of
// docs/accuracy-and-performance.md, and writes them there with --docs.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/front_timing.hpp"
#include "bench/volume_report.hpp"
#include "common/error.hpp"

namespace {

using namespace bench;

constexpr const char* THREADS = "LP_NUM_THREADS=";

struct Options {
  std::string out;
  std::string commit;
  std::string docs;
  VolumeOptions volume;
  std::string from;
  uint32_t children = 3;  // per number of threads
  bool halfSky = false;
  bool scaling = false;  // a child that measures that alone
};

// The driver reads its thread count once, so that every one needs a process of its own.
Ordered runChild(const Options& options, uint32_t threads) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string out = options.out + ".child";
  std::vector<std::string> words{self,
                                 out,
                                 "--half-sky",
                                 "--rounds",
                                 std::to_string(options.volume.rounds),
                                 "--size",
                                 std::to_string(options.volume.size)};
  std::vector<std::string> settings;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string(*entry).starts_with(THREADS)) {
      settings.emplace_back(*entry);
    }
  }
  settings.push_back(THREADS + std::to_string(threads));
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (std::string& text : texts) {
      list.push_back(text.data());
    }
    list.push_back(nullptr);
    return list;
  };
  pid_t child = 0;
  const int failed = posix_spawn(&child, self.c_str(), nullptr, nullptr, pointers(words).data(),
                                 pointers(settings).data());
  int status = -1;
  if (failed != 0 || waitpid(child, &status, 0) != child || status != 0) {
    throw host::HostError("the child with " + std::to_string(threads) + " threads failed");
  }
  std::ifstream file(out);
  Ordered result = Ordered::parse(file);
  std::filesystem::remove(out);
  return result;
}

// Medians over processes that take turns.
Ordered compareThreads(const Options& options) {
  std::array<std::vector<Ordered>, 2> runs;
  for (size_t i = 0; i < options.children; ++i) {
    for (uint32_t threads = 1; threads <= runs.size(); ++threads) {
      runs[threads - 1].push_back(runChild(options, threads));
    }
  }
  Ordered result = Ordered::object();
  for (size_t i = 0; i < runs.size(); ++i) {
    Ordered& entry = result[std::to_string(i + 1)];
    for (const auto& [key, unused] : runs[i].front().items()) {
      std::vector<double> values;
      for (const Ordered& run : runs[i]) {
        values.push_back(run[key].get<double>());
      }
      entry[key] = medianOf(values);
    }
  }
  return result;
}

int run(const Options& options) {
  if (options.scaling) {
    VolumeResults results;
    results.scalings = measureScaling(options.volume);
    writeJson(options.out, volumeJson(results));
    return 0;
  }
  if (options.halfSky) {
    writeJson(options.out, measureHalfSky(options.volume));
    return 0;
  }
  Ordered report = reportHead(options.commit, false);
  report["rounds"] = options.volume.rounds;
  report.erase("rows");
  VolumeResults results;
  if (options.from.empty()) {
    results.studies = studyVolumes(options.volume, report["device"]);
    if (options.volume.only.empty()) {
      results.scalings = measureScaling(options.volume);
      results.skips = measureSkips(options.volume);
    }
  } else {
    std::ifstream file(options.from);
    report = Ordered::parse(file);
    results = readVolumeJson(report);
  }
  if (options.children > 0) {
    results.halfSky = compareThreads(options);
  }
  report["size"] = {options.volume.size, options.volume.size};
  report.update(volumeJson(results));
  writeJson(options.out, report);
  const std::string tables = volumeTables(results);
  std::printf("%s", tables.c_str());
  if (!options.docs.empty()) {
    writeBlock(options.docs, tables);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Time and error of volumes beside those of per-slice slicing"};
  Options options;
  app.add_option("out", options.out, "JSON file to write")->required();
  app.add_option("--commit", options.commit, "what the report says was built");
  app.add_option("--docs", options.docs, "file whose volume-cost block is renewed");
  app.add_option("--from", options.from, "results of which only the threads are measured anew");
  app.add_option("--children", options.children,
                 "processes with one and with two threads each, default 3; 0: threads not compared")
      ->check(CLI::Range(0, 100));
  app.add_option("--case", options.volume.only, "the only one to run");
  app.add_option("--size", options.volume.size, "pixels along the picture's edge, default 1024")
      ->check(CLI::Range(64, 4096));
  app.add_option("--truth", options.volume.truth, "compared pixels along the edge, default 32")
      ->check(CLI::Range(2, 512));
  app.add_option("--rounds", options.volume.rounds, "of timing, at least, default 5")
      ->check(CLI::Range(1, 1000));
  app.add_flag("--validation", options.volume.validation, "under the Vulkan validation layer");
  app.add_flag("--scaling", options.scaling, "measures how cost grows, and nothing else");
  app.add_flag("--half-sky", options.halfSky, "measures sky above, cloud below, and nothing else");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "welkin_volume_cost: %s\n", error.what());
    return 1;
  }
}
