// SPDX-License-Identifier: MIT
#include "bench/front_report.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

#include "common/error.hpp"

namespace bench {
namespace {

// The value of "key : value" or KEY=value in a file of the system; empty if there is none.
std::string lineValue(const char* file, const std::string& key, char separator) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    const size_t at = line.find(separator);
    if (line.compare(0, key.size(), key) == 0 && at != std::string::npos) {
      const size_t begin = line.find_first_not_of(" \t\"", at + 1);
      const size_t end = line.find_last_not_of(" \t\"");
      return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
    }
  }
  return "";
}

Ordered machine() {
  std::array<double, 3> load{};
  if (getloadavg(load.data(), 3) < 0) {
    load = {};
  }
  const double memory_KiB = std::atof(lineValue("/proc/meminfo", "MemTotal", ':').c_str());
  return {{"cpu", lineValue("/proc/cpuinfo", "model name", ':')},
          {"cores", std::thread::hardware_concurrency()},
          {"memory_GiB", std::round(10.0 * memory_KiB / (1024.0 * 1024.0)) / 10.0},
          {"os", lineValue("/etc/os-release", "PRETTY_NAME", '=')},
          {"load", load}};
}

std::string versionText(uint32_t version) {
  return std::to_string(version >> 22) + "." + std::to_string(version >> 12 & 0x3ffu) + "." +
         std::to_string(version & 0xfffu);
}

// Nested objects become names with dots; the file's own order is kept.
void flatten(const Ordered& value, const std::string& name, Ordered& flat) {
  if (!value.is_object()) {
    flat[name] = value;
    return;
  }
  for (const auto& [key, child] : value.items()) {
    flatten(child, name.empty() ? key : name + "." + key, flat);
  }
}

void save(const std::string& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.flush();
  if (!stream) {
    throw host::HostError(file + ": cannot write");
  }
}

}  // namespace

Ordered reportHead(const std::string& commit, bool quick) {
  return {
      {"schema", 3},
      {"machine", machine()},
      {"device", Ordered::object()},
      {"build",
       {{"commit", commit}, {"compiler", __VERSION__}, {"version", versionText(wlkGetVersion())}}},
      {"quick", quick},
      {"rows", Ordered::array()}};
}

Ordered reportRow(const Case& one, const Row& row) {
  const Settings& settings = row.method.settings;
  const FrameCounts& counts = row.counts;
  const Timing& timing = row.timing;
  const uint64_t batches =
      settings.batchSize == 0 ? 1
                              : (settings.sliceCount + settings.batchSize - 1) / settings.batchSize;
  return {{"case", one.name},
          {"method", row.method.name},
          {"kind", row.method.isLevel ? "level" : "method"},
          {"level", levelName(settings.level)},
          {"settings",
           {{"sliceCount", settings.sliceCount},
            {"batchSize", settings.batchSize},
            {"lightBufferSize", settings.lightBufferSize},
            {"slicing", settings.halfAngle ? "half-angle" : "light"},
            {"scattering", scatteringName(settings.scattering)},
            {"resolution", settings.halfResolution ? "half" : "full"},
            {"phase", settings.analytic ? "analytic" : "table"}}},
          {"width", one.width},
          {"height", one.height},
          {"timedWidth", one.width * row.timedScale},
          {"timedHeight", one.height * row.timedScale},
          {"time_ms", timing.wall},
          {"timeMad_ms", timing.wallDeviation},
          {"cpu_ms", timing.cpu},
          {"gpu_ms", timing.gpu},
          {"relativeTime", timing.relative.time},
          {"relativeTimeError", timing.relative.error},
          {"relativeCpuTime", timing.relativeCpu.time},
          {"relativeCpuTimeError", timing.relativeCpu.error},
          {"oneCoreRounds", timing.oneCoreRounds},
          {"rounds", timing.rounds},
          {"quietRounds", timing.quietRounds},
          {"quiet", isQuiet(row)},
          {"handover_ns", timing.cores.handover_ns},
          {"coreWork_ns", timing.cores.work_ns},
          {"dispatches", counts.dispatches},
          {"draws", counts.draws},
          {"barriers", counts.barriers},
          {"invocations", counts.invocations},
          {"samples", counts.volumeInvocations * settings.sliceCount / batches},
          {"deviceMemory", counts.deviceMemory},
          {"hostMemory", counts.hostMemory},
          {"truth", row.truth},
          {"single", row.single},
          {"converged", row.converged}};
}

void writeJson(const std::string& file, const Ordered& report) {
  save(file, report.dump(1) + "\n");
}

void writeCsv(const std::string& file, const Ordered& rows) {
  std::vector<Ordered> flat;
  Ordered columns = Ordered::object();
  for (const Ordered& row : rows) {
    flatten(row, "", flat.emplace_back());
    for (const auto& [name, value] : flat.back().items()) {
      // "truth": null of one row is truth.relMSE, ... of another.
      if (!value.is_null()) {
        columns[name] = nullptr;
      }
    }
  }
  std::string text;
  for (const auto& [name, unused] : columns.items()) {
    text += (text.empty() ? "" : ",") + name;
  }
  for (const Ordered& row : flat) {
    std::string line;
    for (const auto& [name, unused] : columns.items()) {
      const auto found = row.find(name);
      const bool there = found != row.end() && !found->is_null();
      const std::string value =
          !there ? "" : (found->is_string() ? found->get<std::string>() : found->dump());
      line += (line.empty() ? "" : ",") + value;
    }
    text += "\n" + line;
  }
  save(file, text + "\n");
}

}  // namespace bench
