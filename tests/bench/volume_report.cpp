// SPDX-License-Identifier: MIT
#include "bench/volume_report.hpp"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "bench/front_timing.hpp"
#include "common/error.hpp"

namespace bench {
namespace {

constexpr double WANTED_RATE = 0.7;  // of the bare loop's
constexpr double WANTED_FULL = 0.4;  // of the slicer's time
constexpr double WANTED_SPARSE = 0.2;
constexpr double WANTED_SPEED_UP = 1.8;  // of two cores

std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

std::string format(const char* pattern, ...) {
  std::array<char, 512> text{};
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, values);
  va_end(values);
  return text.data();
}

const VolumeRow* find(const std::vector<VolumeRow>& rows, const std::string& method,
                      uint32_t slices) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const VolumeRow& r) {
    return r.method == method && r.slices == slices;
  });
  return row == rows.end() ? nullptr : &*row;
}

// Of all threads in the eye pass: the frame's, divided as the passes' times are.
double eyeCpu_ms(const VolumeRow& row) {
  return row.cpu_ms * row.eye_ms / (row.eye_ms + row.light_ms);
}

// CPU time per sample of the eye pass.
double sampleNs(const VolumeRow& row) {
  return 1e6 * eyeCpu_ms(row) / static_cast<double>(row.samples);
}

// The library's samples per time over the bare loop's.
struct RateRatio {
  uint32_t slices;
  double time;
  double cpu;
};

std::vector<RateRatio> ratesOf(const VolumeStudy& study) {
  std::vector<RateRatio> rates;
  for (const VolumeRow& row : study.rows) {
    const VolumeRow* own = find(study.rows, "welkin", row.slices);
    if (row.method == "bare" && own != nullptr && row.eye_ms > 0 && own->eye_ms > 0) {
      rates.push_back({row.slices, row.eye_ms / own->eye_ms, eyeCpu_ms(row) / eyeCpu_ms(*own)});
    }
  }
  return rates;
}

struct EqualError {
  double error;
  double welkin_ms;
  double slicer_ms;
  double ratio;
  double cpuRatio;
  bool halved;
};

// The library with rays in every pixel or in some, whichever is faster at that error.
std::vector<EqualError> equalErrors(const VolumeStudy& study) {
  std::vector<EqualError> result;
  for (const double error : commonErrors(study.rows)) {
    const auto time = [&](const char* method, double VolumeRow::*which) {
      return timeAtError(study.rows, method, error, which);
    };
    const double full = time("welkin", &VolumeRow::time_ms);
    const double half = time("welkin, half", &VolumeRow::time_ms);
    const bool halved = half > 0 && half < full;
    const double welkin = halved ? half : full;
    const double slicer = time("slicer", &VolumeRow::time_ms);
    const double cpuRatio = time(halved ? "welkin, half" : "welkin", &VolumeRow::cpu_ms) /
                            time("slicer", &VolumeRow::cpu_ms);
    result.push_back({error, welkin, slicer, welkin / slicer, cpuRatio, halved});
  }
  return result;
}

double speedUp(const VolumeResults& results) {
  if (!results.halfSky.contains("1") || !results.halfSky.contains("2")) {
    return -1;
  }
  return results.halfSky["1"]["time_ms"].get<double>() /
         results.halfSky["2"]["time_ms"].get<double>();
}

// What it would be if nothing else ran: by the CPU times of the threads.
double balance(const VolumeResults& results) {
  return results.halfSky.contains("2") ? results.halfSky["2"].value("cpuOverLongest", -1.0) : -1;
}

std::string percent(double value) {
  return value < 0 ? "-" : format("%.2f", 100 * value);
}

std::string number(double value) {
  return value < 0 ? "-" : format("%.2f", value);
}

const char* verdict(const Goal& goal) {
  if (goal.measured < 0) {
    return "not measured";
  }
  return goal.reached() ? "reached" : "missed";
}

std::string studyTable(const std::vector<VolumeStudy>& studies) {
  std::string text =
      "| cloud | method | slices | light buffer | ms | CPU ms | error, % | bias, % | eye pass, CPU "
      "ns per sample |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const VolumeStudy& study : studies) {
    for (const VolumeRow& row : study.rows) {
      const bool known = row.samples > 0 && row.eye_ms > 0;
      text += format("| %s | %s | %u | %u | %.0f | %.0f | %s | %s | %s |\n", study.one.name.c_str(),
                     row.method.c_str(), row.slices, row.lightSize, row.time_ms, row.cpu_ms,
                     percent(row.error).c_str(),
                     row.error < 0 ? "-" : format("%+.2f", 100 * row.bias).c_str(),
                     known ? format("%.1f", sampleNs(row)).c_str() : "-");
    }
  }
  return text;
}

std::string equalTable(const std::vector<VolumeStudy>& studies) {
  std::string text =
      "| cloud | error, % | rays in | welkin, ms | slicer, ms | welkin / slicer | of CPU "
      "time |\n|---|---|---|---|---|---|---|\n";
  for (const VolumeStudy& study : studies) {
    for (const EqualError& at : equalErrors(study)) {
      text += format("| %s | %.2f | %s | %.0f | %.0f | %.2f | %.2f |\n", study.one.name.c_str(),
                     100 * at.error, at.halved ? "some pixels" : "each pixel", at.welkin_ms,
                     at.slicer_ms, at.ratio, at.cpuRatio);
    }
  }
  return text;
}

std::string fitTable(const std::vector<Scaling>& scalings) {
  std::string text =
      "| against | from ... to | CPU ms | line's CPU ms at 0 | variance it explains | of the "
      "invocations |\n|---|---|---|---|---|---|\n";
  for (const Scaling& s : scalings) {
    const Fit cpu = fitLine(s.x, s.cpu_ms);
    text += format("| %s | %.0f ... %.0f | %.0f ... %.0f | %.0f | %.4f | %.4f |\n", s.what.c_str(),
                   s.x.front(), s.x.back(), s.cpu_ms.front(), s.cpu_ms.back(), cpu.offset,
                   cpu.explained, fitLine(s.x, s.invocations).explained);
  }
  return text;
}

Ordered fitJson(const std::vector<double>& x, const std::vector<double>& y) {
  const Fit fit = fitLine(x, y);
  return {{"offset", fit.offset},
          {"slope", fit.slope},
          {"explained", fit.explained},
          {"exponent", fit.exponent}};
}

Ordered rowJson(const VolumeRow& row) {
  Ordered json = {{"method", row.method},
                  {"slices", row.slices},
                  {"lightBufferSize", row.lightSize},
                  {"time_ms", row.time_ms},
                  {"timeMad_ms", row.deviation_ms},
                  {"cpu_ms", row.cpu_ms},
                  {"error", nullptr},
                  {"bias", nullptr},
                  {"samples", row.samples},
                  {"eye_ms", row.eye_ms},
                  {"light_ms", row.light_ms},
                  {"invocations", row.invocations},
                  {"commands", row.commands}};
  if (row.error >= 0) {
    json["error"] = row.error;
    json["bias"] = row.bias;
  }
  return json;
}

}  // namespace

std::vector<Goal> goalsOf(const VolumeResults& results) {
  // Worst of all cases; of times and of CPU times.
  double rate = -1;
  double cpuRate = -1;
  std::array<double, 2> full{-1, -1};
  std::array<double, 2> sparse{-1, -1};
  std::array<double, 2> coarse{-1, -1};
  for (const VolumeStudy& study : results.studies) {
    // Samples that a sparse cloud's rays leap over would count as taken.
    for (const RateRatio& one :
         study.one.occupied < 1 ? std::vector<RateRatio>{} : ratesOf(study)) {
      rate = rate < 0 ? one.time : std::min(rate, one.time);
      cpuRate = cpuRate < 0 ? one.cpu : std::min(cpuRate, one.cpu);
    }
    for (const EqualError& at : equalErrors(study)) {
      std::array<double, 2>& worst = study.one.occupied == 1      ? full
                                     : at.error <= DIVIDING_ERROR ? sparse
                                                                  : coarse;
      worst = {std::max(worst[0], at.ratio), std::max(worst[1], at.cpuRatio)};
    }
  }
  return {{"sample rate over the bare loop's", WANTED_RATE, true, rate, cpuRate},
          {"time over the slicer's at equal error, full", WANTED_FULL, false, full[0], full[1]},
          {"the same, 20 % of bricks, errors of a half or less", WANTED_SPARSE, false, sparse[0],
           sparse[1]},
          {"the same, 20 % of bricks, larger errors", WANTED_SPARSE, false, coarse[0], coarse[1]},
          {"speed-up from two cores, sky above, cloud below", WANTED_SPEED_UP, true,
           speedUp(results), balance(results)}};
}

Ordered volumeJson(const VolumeResults& results) {
  Ordered cases = Ordered::array();
  for (const VolumeStudy& study : results.studies) {
    Ordered rows = Ordered::array();
    for (const VolumeRow& row : study.rows) {
      rows.push_back(rowJson(row));
    }
    Ordered rates = Ordered::array();
    for (const RateRatio& one : ratesOf(study)) {
      rates.push_back({{"slices", one.slices}, {"ratio", one.time}, {"cpuRatio", one.cpu}});
    }
    Ordered equal = Ordered::array();
    for (const EqualError& at : equalErrors(study)) {
      equal.push_back({{"error", at.error},
                       {"resolution", at.halved ? "half" : "full"},
                       {"welkin_ms", at.welkin_ms},
                       {"slicer_ms", at.slicer_ms},
                       {"ratio", at.ratio},
                       {"cpuRatio", at.cpuRatio}});
    }
    cases.push_back({{"name", study.one.name},
                     {"light_deg", study.one.light_deg},
                     {"occupiedBricks", study.occupied},
                     {"meanDepth", study.meanDepth},
                     {"rows", rows},
                     {"sampleRates", rates},
                     {"atEqualError", equal}});
  }
  Ordered scaling = Ordered::array();
  for (const Scaling& s : results.scalings) {
    scaling.push_back({{"against", s.what},
                       {"x", s.x},
                       {"time_ms", s.time_ms},
                       {"cpu_ms", s.cpu_ms},
                       {"invocations", s.invocations},
                       {"timeFit", fitJson(s.x, s.time_ms)},
                       {"cpuFit", fitJson(s.x, s.cpu_ms)},
                       {"invocationsFit", fitJson(s.x, s.invocations)}});
  }
  Ordered goals = Ordered::array();
  for (const Goal& goal : goalsOf(results)) {
    goals.push_back({{"what", goal.what},
                     {goal.atLeast ? "atLeast" : "atMost", goal.wanted},
                     {"measured", goal.measured},
                     {"byCpuTime", goal.byCpu},
                     {"reached", goal.reached()}});
  }
  return {{"cases", cases},
          {"scaling", scaling},
          {"recorded", results.skips},
          {"threads", results.halfSky},
          {"goals", goals}};
}

VolumeResults readVolumeJson(const Ordered& report) {
  VolumeResults results;
  for (const Ordered& one : report.at("cases")) {
    VolumeStudy study{{one.at("name"), one.at("occupiedBricks"), one.at("light_deg")},
                      one.at("occupiedBricks"),
                      one.at("meanDepth"),
                      {}};
    for (const Ordered& row : one.at("rows")) {
      const bool drawn = row.at("error").is_number();
      study.rows.push_back(
          {row.at("method"), row.at("slices"), row.at("lightBufferSize"), row.at("time_ms"),
           row.at("timeMad_ms"), row.at("cpu_ms"), drawn ? row.at("error").get<double>() : -1.0,
           drawn ? row.at("bias").get<double>() : 0.0, row.at("samples"), row.at("eye_ms"),
           row.at("light_ms"), row.at("invocations"), row.at("commands")});
    }
    results.studies.push_back(study);
  }
  for (const Ordered& one : report.at("scaling")) {
    results.scalings.push_back({one.at("against"), one.at("x"), one.at("time_ms"), one.at("cpu_ms"),
                                one.at("invocations")});
  }
  results.skips = report.at("recorded");
  results.halfSky = report.at("threads");
  return results;
}

std::string volumeTables(const VolumeResults& results) {
  std::string text = "| wanted | by time | by CPU time | |\n|---|---|---|---|\n";
  for (const Goal& goal : goalsOf(results)) {
    text += format("| %s: %s %.1f | %s | %s | %s |\n", goal.what.c_str(),
                   goal.atLeast ? "at least" : "at most", goal.wanted,
                   number(goal.measured).c_str(), number(goal.byCpu).c_str(), verdict(goal));
  }
  text +=
      "\nAt equal error, by straight lines between the points of each front, in logarithms:\n\n";
  text += equalTable(results.studies);
  text +=
      "\nCost of a frame of the library, as it grows (light buffer 256, full cloud but for the "
      "last two lines):\n\n";
  text += fitTable(results.scalings);
  text += "\nEvery method:\n\n";
  text += studyTable(results.studies);
  return text;
}

void writeBlock(const std::string& file, const std::string& text) {
  const std::string begin = "<!-- volume-cost:begin -->\n";
  const std::string end = "<!-- volume-cost:end -->";
  std::ifstream in(file);
  std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const size_t from = all.find(begin);
  const size_t to = all.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) {
    throw host::HostError(file + ": no block between volume-cost:begin and volume-cost:end");
  }
  all.replace(from + begin.size(), to - from - begin.size(), text);
  std::ofstream out(file);
  out << all;
  out.flush();
  if (!out) {
    throw host::HostError(file + ": cannot write");
  }
}

}  // namespace bench
