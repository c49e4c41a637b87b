// SPDX-License-Identifier: MIT
// welkin_tables: computes the phase tables and writes them as C++ arrays, NAME.inc each.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "particles/table_builder.hpp"

namespace {

using namespace welkin;

template <typename T>
void writeArray(std::ofstream& out, const char* type, const char* name,
                const std::vector<T>& values, const char* format) {
  out << "constexpr " << type << " " << name << "[] = {";
  for (size_t i = 0; i < values.size(); ++i) {
    char text[32];
    if constexpr (std::is_floating_point_v<T>) {
      std::snprintf(text, sizeof text, format, static_cast<double>(values[i]));
    } else {
      std::snprintf(text, sizeof text, format, static_cast<unsigned>(values[i]));
    }
    out << (i % 12 == 0 ? "\n  " : " ") << text << ",";
  }
  out << "\n};\n";
}

void write(const StoredTable& table, const std::filesystem::path& folder) {
  std::ofstream out(folder / (table.name + ".inc"));
  out << "// SPDX-License-Identifier: MIT\n// Written by welkin_tables; " << table.bytes()
      << " bytes. Do not edit.\n";
  writeArray(out, "float", "KNOT", table.knot, "%.9ef");
  writeArray(out, "float", "AXIS", table.axis, "%.9ef");
  writeArray(out, "float", "ASYMMETRY", table.asymmetry, "%.9ef");
  writeArray(out, "float", "EFFICIENCY", table.efficiency, "%.9ef");
  writeArray(out, "float", "DELTA", table.delta, "%.9ef");
  writeArray(out, "float", "RANGE", std::vector<float>{table.logMin, table.logStep}, "%.9ef");
  writeArray(out, "uint16_t", "CODE", table.code, "%u");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: welkin_tables FOLDER [NAME]...\n");
    return 2;
  }
  for (const TableKind kind : TABLE_KINDS) {
    TableDraft draft = emptyDraft(kind);
    bool wanted = argc == 2;
    for (int i = 2; i < argc; ++i) {
      wanted = wanted || draft.name == argv[i];
    }
    if (!wanted) {
      continue;
    }
    const auto begin = std::chrono::steady_clock::now();
    const unsigned threads = std::max(std::thread::hardware_concurrency(), 1u);
    if (kind == TableKind::Haze || kind == TableKind::Droplet || kind == TableKind::Rain) {
      for (size_t channel = 0; channel < kTableChannels; ++channel) {
        computeColumns(kind, draft, 0, draft.axis.size(), channel, threads);
      }
    } else {
      std::atomic<size_t> next = 0;
      const auto work = [&] {
        for (size_t i = next++; i < draft.axis.size() * kTableChannels; i = next++) {
          const size_t column = i / kTableChannels;
          computeColumns(kind, draft, column, column + 1, i % kTableChannels, 1);
        }
      };
      std::vector<std::jthread> helpers;
      for (unsigned i = 1; i < threads; ++i) {
        helpers.emplace_back(work);
      }
      work();
    }
    const StoredTable table = store(draft);
    write(table, argv[1]);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::printf("%s: %zu bytes, %.1f s\n", table.name.c_str(), table.bytes(), seconds.count());
  }
  return 0;
}
