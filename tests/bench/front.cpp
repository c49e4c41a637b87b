// SPDX-License-Identifier: MIT
// welkin_front: error against time, in ms, of every method in every case; writes and checks the
// contract of the quality levels.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "bench/driver_threads.hpp"
#include "bench/front_contract.hpp"
#include "bench/front_report.hpp"
#include "bench/memory.hpp"
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
  size_t turns = 0;
  double until_s = 490.0;
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

void print(const Case& one, const std::vector<Row>& rows) {
  std::printf("%-16s %-18s %9s %8s %8s %8s %8s %12s %10s %10s %10s\n", one.name.c_str(), "method",
              "ms", "CPU", "error", "one core", "all", "invocations", "truth", "single",
              "converged");
  for (const Row& row : rows) {
    const auto figure = [](const Ordered& errors) {
      return errors.is_null() ? NAN : errors.at("rmseOverMean").get<double>();
    };
    std::printf("%-16s %-18s %9.3f %8.4f %8.4f %8zu %8zu %12llu %10.3g %10.3g %10.3g\n", "",
                row.method.name.c_str(), row.timing.wall, row.timing.relativeCpu.time,
                row.timing.relativeCpu.error, row.timing.oneCoreRounds, row.timing.rounds,
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
  // What case `index` took before its frames can be timed.
  void note(size_t index, double setup_s) {
    Mean& mean = cases_[index].hasVolumes ? volumes_ : sky_;
    mean.sum_s += setup_s;
    mean.methods += cases_[index].methods;
  }
  // Of the cases from `first` to before `last`, which are ready; those after are not.
  [[nodiscard]] double timing_s(size_t first, size_t last) const {
    double own = 0.0;
    for (size_t i = first; i < last; ++i) {
      own += share(cases_[i]);
    }
    if (!quick_) {
      return FULL_s * own;
    }
    double left = until_s_ - spent_s();
    double shares = own;
    for (size_t i = last; i < cases_.size(); ++i) {
      const Mean& mean = cases_[i].hasVolumes ? volumes_ : sky_;
      left -= mean.sum_s / mean.methods * cases_[i].methods;
      shares += share(cases_[i]);
    }
    return left * own / shares;
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
  static constexpr double FULL_s = 4.0;

  // Frames of skies are shorter.
  static double share(const Entry& one) { return one.methods * (one.hasVolumes ? 1.0 : 0.4); }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<Entry> cases_;
  bool quick_ = false;
  double until_s_ = 0.0;
  // To begin with what one took on a loud machine of two cores.
  Mean volumes_{20.0, 8.0};
  Mean sky_{2.5, 5.0};
};

// Bytes that a case takes: the most until now, a guess before the first.
class Needs {
 public:
  void note(const Case& one, uint64_t bytes) {
    uint64_t& most = most_.at(hasVolumes(one));
    most = std::max(most, bytes);
  }
  [[nodiscard]] uint64_t of(const Case& one) const {
    constexpr std::array<uint64_t, 2> GUESS = {uint64_t{1} << 28, uint64_t{2} << 30};
    constexpr uint64_t LEAST = 4;  // part of the guess: others may have freed memory meanwhile
    const uint64_t guess = GUESS.at(hasVolumes(one));
    const uint64_t most = most_.at(hasVolumes(one));
    return most != 0 ? std::max(most, guess / LEAST) : guess;
  }

 private:
  std::array<uint64_t, 2> most_{};
};

// Cases whose contexts are there together and whose frames are timed in turn, so that one minute's
// loud machine is not one case's.
class Group {
 public:
  // From case `first` on, as many as leave a quarter of the memory; one with drivers whose memory
  // is another.
  Group(const std::vector<Case>& cases, size_t first, const StudyOptions& study, Schedule& schedule,
        Needs& needs) {
    do {
      const size_t index = first + studies_.size();
      const auto tell = [&](const std::string& step) {
        std::fprintf(stderr, "%5.0f s %s: %s\n", schedule.spent_s(), cases[index].name.c_str(),
                     step.c_str());
      };
      const uint64_t before = memoryNow().available;
      const double start_s = schedule.spent_s();
      studies_.push_back(std::make_unique<FrontStudy>(cases[index], study, tell));
      schedule.note(index, schedule.spent_s() - start_s);
      needs.note(cases[index], before - std::min(before, memoryNow().available));
      cores_ = studies_.back()->cores();
    } while (cores_ > 0 && first + studies_.size() < cases.size() &&
             hasRoom(needs.of(cases[first + studies_.size()])));
  }
  // Of four turns the first is on all cores, for times in ms, the others on one: times relative to
  // each other then do not depend on how near cores are to each other, which changes them by up to
  // 6 %.
  void takeTurn() {
    constexpr size_t PERIOD = 4;
    const bool onOneCore = cores_ > 1 && turns_++ % PERIOD != 0;
    const auto together = onOneCore ? std::make_unique<OnOneCore>() : nullptr;
    for (const std::unique_ptr<FrontStudy>& study : studies_) {
      study->takeBlock(onOneCore);
    }
  }
  [[nodiscard]] size_t size() const { return studies_.size(); }
  [[nodiscard]] const FrontStudy& operator[](size_t index) const { return *studies_[index]; }

 private:
  static bool hasRoom(uint64_t need) {
    constexpr uint64_t KEPT = 4;
    const Memory memory = memoryNow();
    return memory.available > memory.total / KEPT + need;
  }

  std::vector<std::unique_ptr<FrontStudy>> studies_;
  size_t cores_ = 0;  // of the driver in this process
  size_t turns_ = 0;
};

void measure(const Options& options) {
  // One on all cores, and as many on one as tell a standard error.
  constexpr size_t LEAST_TURNS = 3;
  const std::vector<Case> cases = chosenCases(options);
  const StudyOptions study{options.quick, options.levelsOnly, options.references};
  Schedule schedule(cases, study, options.until_s);
  Ordered report = reportHead(options.commit, options.quick);
  std::vector<std::vector<Row>> rows;  // of cases
  Needs needs;
  for (size_t first = 0; first < cases.size();) {
    Group group(cases, first, study, schedule, needs);
    const size_t last = first + group.size();
    const double start_s = schedule.spent_s();
    const double timing_s = schedule.timing_s(first, last);
    std::fprintf(stderr, "%5.0f s %zu cases in turn\n", start_s, group.size());
    double turn_s = 0.0;  // the longest
    // The last may end later by half of one; others leave the next its time.
    const double part = last == cases.size() ? 0.5 : 1.0;
    const auto hasTime = [&] { return schedule.spent_s() - start_s + part * turn_s < timing_s; };
    const size_t least = options.turns != 0 ? options.turns : LEAST_TURNS;
    size_t turns = 0;
    do {
      const double before_s = schedule.spent_s();
      group.takeTurn();
      turn_s = std::max(turn_s, schedule.spent_s() - before_s);
      ++turns;
    } while (turns < least || (options.turns == 0 && hasTime()));
    for (size_t i = 0; i < group.size(); ++i) {
      rows.push_back(group[i].rows());
      print(cases[first + i], rows.back());
    }
    // All again: what is quiet depends on the best cores seen until now.
    report["rows"] = Ordered::array();
    for (size_t i = 0; i < last; ++i) {
      for (const Row& row : rows[i]) {
        report["rows"].push_back(reportRow(cases[i], row));
      }
    }
    report["device"] = group[0].device();
    // After every group: a run that is cut short leaves what it has.
    if (!options.json.empty()) {
      writeJson(options.json, report);
    }
    if (!options.csv.empty()) {
      writeCsv(options.csv, report["rows"]);
    }
    first = last;
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
  app.add_option(
      "--turns", options.turns,
      "Turns of all cases, of four rounds, long frames in one or two (default: as many as there is "
      "time for)");
  app.add_option("--until", options.until_s,
                 "Quick runs: share about so many seconds (default 490)");
  app.add_option("--timed-width", options.timedWidth,
                 "Least width of the pictures that are timed: GPUs draw a case's own in no time")
      ->check(CLI::Range(1, 8192));
  app.add_flag("--quick", options.quick, "Fewer methods, in less than ten minutes");
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
