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
  double until_s = 470.0;
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
    if (!options.keepConverged && hasVolumes(one)) {
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
              "CPU", "error", "rounds", "invocations", "truth", "single", "converged");
  for (const Row& row : result.rows) {
    const auto figure = [](const Ordered& errors) {
      return errors.is_null() ? NAN : errors.at("rmseOverMean").get<double>();
    };
    std::printf("%-16s %-18s %9.3f %8.4f %8.4f %8zu %12llu %10.3g %10.3g %10.3g\n", "",
                row.method.name.c_str(), row.timing.wall, row.timing.relativeCpu.time,
                row.timing.relativeCpu.error, row.timing.rounds,
                static_cast<unsigned long long>(row.counts.invocations), figure(row.truth),
                figure(row.single), figure(row.converged));
  }
  std::fflush(stdout);
}

// How long the cases' frames are timed: in quick runs as long as there is time for it.
class Schedule {
 public:
  Schedule(const std::vector<Case>& cases, const StudyOptions& study, double until_s)
      : quick_(study.quick), until_s_(until_s) {
    for (const Case& one : cases) {
      cases_.push_back({hasVolumes(one), static_cast<double>(methodsOf(one, study).size())});
    }
  }
  [[nodiscard]] double spent_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void begin(size_t index) {
    index_ = index;
    begun_s_ = spent_s();
    timing_s_ = 0.0;
  }
  // Of the case that was begun. Called before its warm-ups.
  double timing_s() {
    const Entry& own = cases_[index_];
    if (!quick_) {
      timing_s_ = FULL_s * share(own);
      return timing_s_;
    }
    double left = until_s_ - spent_s() - WARMING * setup(own);
    double shares = share(own);
    for (size_t i = index_ + 1; i < cases_.size(); ++i) {
      left -= setup(cases_[i]);
      shares += share(cases_[i]);
    }
    timing_s_ = std::clamp(left * share(own) / shares, LEAST_s, MOST_s);
    return timing_s_;
  }
  void end() {
    Mean& mean = cases_[index_].hasVolumes ? volumes_ : sky_;
    mean.sum_s += spent_s() - begun_s_ - timing_s_;
    mean.methods += cases_[index_].methods;
  }

 private:
  struct Entry {
    bool hasVolumes = false;
    double methods = 0.0;
  };
  struct Mean {
    double sum_s = 0.0;
    double methods = 0.0;
  };
  // Of full runs, for each share.
  static constexpr double FULL_s = 2.0;
  static constexpr double LEAST_s = 2.0;
  static constexpr double MOST_s = 30.0;
  // Warm-ups' part of what a case takes beside its rounds.
  static constexpr double WARMING = 0.25;

  // Beside the rounds.
  [[nodiscard]] double setup(const Entry& one) const {
    const Mean& mean = one.hasVolumes ? volumes_ : sky_;
    return mean.sum_s / mean.methods * one.methods;
  }
  // Frames of skies are shorter, and all methods' alike.
  static double share(const Entry& one) { return one.methods * (one.hasVolumes ? 1.0 : 0.6); }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<Entry> cases_;
  bool quick_ = false;
  double until_s_ = 0.0;
  size_t index_ = 0;
  double begun_s_ = 0.0;
  double timing_s_ = 0.0;
  // What cases took so far; to begin with what one took on a loud machine of two cores.
  Mean volumes_{20.0, 8.0};
  Mean sky_{2.5, 5.0};
};

void measure(const Options& options) {
  constexpr size_t ROUNDS = 30;
  constexpr size_t QUICK_ROUNDS = 8;
  const std::vector<Case> cases = chosenCases(options);
  StudyOptions study;
  study.rounds = options.rounds != 0 ? options.rounds : (options.quick ? QUICK_ROUNDS : ROUNDS);
  study.quick = options.quick;
  study.levelsOnly = options.levelsOnly;
  study.referenceFolder = options.references;
  Schedule schedule(cases, study, options.until_s);
  study.timing_s = [&] { return options.rounds != 0 ? 0.0 : schedule.timing_s(); };
  Ordered report = reportHead(options.commit, study.rounds, options.quick);
  std::vector<Study> studies(cases.size());
  const auto visit = [&](size_t index, const Study* before) {
    const auto tell = [&](const std::string& step) {
      std::fprintf(stderr, "%5.0f s %s: %s\n", schedule.spent_s(), cases[index].name.c_str(),
                   step.c_str());
    };
    schedule.begin(index);
    Study result = studyCase(cases[index], study, tell, before);
    schedule.end();
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
  // Full runs time scenes again whose times are uncertain: the machine is another minutes later,
  // and memory lies elsewhere.
  constexpr size_t MOST_VISITS = 3;
  constexpr double CERTAIN = 0.01;
  const auto isCertain = [](const Row& row) { return row.timing.relativeCpu.error < CERTAIN; };
  for (size_t visits = 1; visits < MOST_VISITS && !options.quick; ++visits) {
    for (size_t i = 0; i < cases.size(); ++i) {
      if (!std::all_of(studies[i].rows.begin(), studies[i].rows.end(), isCertain)) {
        const Study before = studies[i];
        visit(i, &before);
      }
    }
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
  app.add_option("--rounds", options.rounds,
                 "Interleaved rounds, more of cheap and uncertain ones, for all the time they take "
                 "(default: as many as there is time for)");
  app.add_option("--until", options.until_s,
                 "Quick runs: share about so many seconds (default 470)");
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
