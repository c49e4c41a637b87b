// SPDX-License-Identifier: MIT
// welkin_front: error against time, in ms, of every method in every case; writes and checks the
// contract of the quality levels.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "bench/front_contract.hpp"
#include "bench/front_report.hpp"
#include "common/error.hpp"

namespace bench {
namespace {

struct Options {
  std::string cases;
  std::vector<std::string> names;
  std::string references;
  std::string json;
  std::string csv;
  std::string check;
  std::string writeContract;
  std::string commit;
  std::vector<std::string> pack;
  size_t rounds = 0;
  uint32_t timedWidth = 0;
  bool quick = false;
  bool levelsOnly = false;
  bool keepConverged = false;
  bool listReferences = false;
};

// Bits of the mantissas of what is written next to the tests. References carry noise of 0.4 % and
// more and are rounded by 0.05 %; variances are themselves only known to several per cent; the
// finest level is some 1e-3 away from its limit, which is rounded by 6e-5.
constexpr int REFERENCE_BITS = 10;
constexpr int VARIANCE_BITS = 3;
constexpr int CONVERGED_BITS = 13;

std::vector<Case> chosenCases(const Options& options) {
  std::vector<Case> cases = readCases(options.cases);
  for (Case& one : cases) {
    one.timedWidth = std::max(one.timedWidth, options.timedWidth);
  }
  if (options.names.empty()) {
    return cases;
  }
  std::vector<Case> chosen;
  for (const std::string& name : options.names) {
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const Case& one) { return one.name == name; });
    if (found == cases.end()) {
      throw host::InputError("command line", "--case", "no case " + name + " in " + options.cases);
    }
    chosen.push_back(*found);
  }
  return chosen;
}

// One line for each reference, fields separated by tabs, for tools/bench.
void listReferences(const Options& options) {
  for (const Case& one : chosenCases(options)) {
    for (const char* kind : {"all", "single"}) {
      const bool all = kind == std::string("all");
      std::printf("%s\t%s\t%u", one.name.c_str(), kind, all ? one.samplesAll : one.samplesSingle);
      std::printf("\t%s", one.scene.c_str());
      for (const std::string& assignment : assignmentsOf(one)) {
        std::printf("\t%s", assignment.c_str());
      }
      std::printf("\n");
    }
  }
}

void packReferences(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const bool variance = file.find(".variance.") != std::string::npos;
    writePacked(file, host::readExr(file), variance ? VARIANCE_BITS : REFERENCE_BITS);
  }
}

void writeContract(const Options& options) {
  Ordered contract = {{"schema", 1}, {"rows", Ordered::array()}};
  for (const Case& one : chosenCases(options)) {
    std::fprintf(stderr, "%s\n", one.name.c_str());
    if (!options.keepConverged && !sceneOf(one, false).volumes.empty()) {
      writePacked(referenceFile(options.references, one, "converged"), convergedPicture(one),
                  CONVERGED_BITS);
    }
    for (Measured& measured : measureLevels(one, readReferences(options.references, one))) {
      contract["rows"].push_back(std::move(measured.row));
    }
  }
  writeJson(options.writeContract, contract);
}

// Number of figures that are worse than the contract.
size_t checkContract(const Options& options) {
  const Ordered contract = readContract(options.check);
  size_t worse = 0;
  for (const Case& one : chosenCases(options)) {
    const std::vector<Measured> levels =
        measureLevels(one, readReferences(options.references, one));
    for (const Measured& measured : levels) {
      const Ordered& row = measured.row;
      for (const std::string& text : violations(row, findRow(contract, row))) {
        std::printf("%s\n", text.c_str());
        ++worse;
      }
    }
  }
  return worse;
}

void print(const Case& one, const Study& result) {
  std::printf("%-16s %-18s %9s %8s %8s %8s %12s %10s %10s %10s\n", one.name.c_str(), "method", "ms",
              "ratio", "med low", "med high", "invocations", "truth", "single", "converged");
  for (const Row& row : result.rows) {
    const auto figure = [](const Ordered& errors) {
      return errors.is_null() ? NAN : errors.at("rmseOverMean").get<double>();
    };
    std::printf("%-16s %-18s %9.3f %8.4f %8.4f %8.4f %12llu %10.3g %10.3g %10.3g\n", "",
                row.method.name.c_str(), row.timing.wall, row.timing.relative,
                row.timing.medianRatioLow, row.timing.medianRatioHigh,
                static_cast<unsigned long long>(row.counts.invocations), figure(row.truth),
                figure(row.single), figure(row.converged));
  }
  std::fflush(stdout);
}

void measure(const Options& options) {
  constexpr size_t ROUNDS = 30;
  constexpr size_t QUICK_ROUNDS = 10;
  StudyOptions study;
  study.rounds = options.rounds != 0 ? options.rounds : (options.quick ? QUICK_ROUNDS : ROUNDS);
  study.quick = options.quick;
  study.levelsOnly = options.levelsOnly;
  study.referenceFolder = options.references;
  Ordered report = reportHead(options.commit, study.rounds, options.quick);
  const auto start = std::chrono::steady_clock::now();
  const auto spent_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const std::vector<Case> cases = chosenCases(options);
  std::vector<Study> studies(cases.size());
  const auto visit = [&](size_t index, const Study* before) {
    const auto tell = [&](const std::string& step) {
      std::fprintf(stderr, "%5.0f s %s: %s\n", spent_s(), cases[index].name.c_str(), step.c_str());
    };
    Study result = studyCase(cases[index], study, tell, before);
    if (before != nullptr && quietRows(result) < quietRows(*before)) {
      result = *before;
    }
    report["device"] = result.device;
    print(cases[index], result);
    studies[index] = std::move(result);
    // After every case: a run that is cut short leaves what it has.
    report["rows"] = Ordered::array();
    for (size_t i = 0; i < cases.size(); ++i) {
      for (const Row& row : studies[i].rows) {
        report["rows"].push_back(reportRow(cases[i], row));
      }
    }
    if (!options.json.empty()) {
      writeJson(options.json, report);
    }
    if (!options.csv.empty()) {
      writeCsv(options.csv, report["rows"]);
    }
  };
  for (size_t i = 0; i < cases.size(); ++i) {
    visit(i, nullptr);
  }
  // Cores are loud for seconds to minutes: times of scenes that found them so are taken again, of
  // the worst first and of each once before any is taken a third time. The rest of tools/bench
  // takes two minutes and a half.
  constexpr double QUICK_UNTIL_s = 420.0;
  constexpr size_t MOST_VISITS = 4;
  std::vector<size_t> visits(cases.size(), 1);
  const auto loud = [&](size_t i) {
    const auto rows = static_cast<double>(studies[i].rows.size());
    return 1.0 - static_cast<double>(quietRows(studies[i])) / rows;
  };
  for (;;) {
    size_t next = cases.size();
    for (size_t i = 0; i < cases.size(); ++i) {
      const bool timely = !options.quick || spent_s() + studies[i].again_s < QUICK_UNTIL_s;
      const bool worse = next == cases.size() || visits[i] < visits[next] ||
                         (visits[i] == visits[next] && loud(i) > loud(next));
      if (timely && loud(i) > 0.0 && visits[i] < MOST_VISITS && worse) {
        next = i;
      }
    }
    if (next == cases.size()) {
      break;
    }
    ++visits[next];
    const Study before = studies[next];
    visit(next, &before);
  }
}

int run(const Options& options) {
  if (!options.pack.empty()) {
    packReferences(options.pack);
  } else if (options.listReferences) {
    listReferences(options);
  } else if (!options.writeContract.empty()) {
    writeContract(options);
  } else if (!options.check.empty()) {
    return checkContract(options) == 0 ? 0 : 1;
  } else {
    measure(options);
  }
  return 0;
}

void declare(CLI::App& app, Options& options) {
  app.add_option("--cases", options.cases, "List of cases (JSON)")->required();
  app.add_option("--case", options.names, "Only this case; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--rounds", options.rounds, "Interleaved rounds (default 30; quick 10)");
  app.add_option("--timed-width", options.timedWidth,
                 "Least width of the pictures that are timed: GPUs draw a case's own in no time")
      ->check(CLI::Range(1, 8192));
  app.add_flag("--quick", options.quick, "Fewer methods and rounds");
  app.add_flag("--levels-only", options.levelsOnly, "The four quality levels only");
  app.add_option("--out", options.json, "Write the results to this file (JSON)");
  app.add_option("--csv", options.csv, "Write the rows to this file (CSV)");
  app.add_option("--reference-dir", options.references, "Folder of the references");
  app.add_option("--commit", options.commit, "Name of the source's state, for the results");
  app.add_option("--check", options.check, "Compare the levels with this contract, then end");
  app.add_option("--write-contract", options.writeContract,
                 "Write the contract and the converged pictures, then end");
  app.add_flag("--keep-converged", options.keepConverged,
               "With --write-contract: the converged pictures stay as they are");
  app.add_flag("--list-references", options.listReferences,
               "Print name, kind, paths per pixel, scene and assignments, then end");
  app.add_option("--pack", options.pack, "Round the mantissas of these references, then end");
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  CLI::App app("Error against time of Welkin's methods");
  bench::Options options;
  bench::declare(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    return bench::run(options);
  } catch (const host::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
