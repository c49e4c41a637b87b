// SPDX-License-Identifier: MIT
// Runs a target of fuzzing over files, and over inputs made from them by a fixed rule, without
// libFuzzer: the same on every machine, so that the test suite can hold it.
//   welkin_fuzz_TARGET [--mutations N] FILE|FOLDER...
// What fails ends the process; its name is printed, and the input is left in failed-input.bin.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "input.hpp"

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<uint8_t>;

std::string g_name;
Bytes g_input;

// No reports from std::terminate or sanitizers' aborts name the input.
void report(int signal) {
  std::fprintf(stderr, "input: %s (%zu bytes)\n", g_name.c_str(), g_input.size());
  if (FILE* file = std::fopen("failed-input.bin", "wb")) {
    (void)std::fwrite(g_input.data(), 1, g_input.size(), file);
    (void)std::fclose(file);
  }
  std::signal(signal, SIG_DFL);
  (void)std::raise(signal);
}

Bytes read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void run(const std::string& name, const Bytes& input) {
  g_name = name;
  g_input = input;
  // A copy of its exact size: sanitizers see a read past its end.
  const Bytes exact(input);
  (void)LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

// What OpenEXR's own fuzzer does to files: a tenth of the bytes in a window, where the header is
// as often as anywhere; and cuts, and parts of another file.
Bytes mutate(const Bytes& original, const Bytes& other, std::mt19937& random) {
  Bytes bytes = original;
  const auto below = [&](size_t end) { return end == 0 ? 0 : random() % end; };
  const size_t window = random() % 2 == 0 ? std::min<size_t>(bytes.size(), 256) : bytes.size();
  const size_t begin = window == bytes.size() ? below(bytes.size()) : 0;
  switch (random() % 5) {
    case 0:
      bytes.resize(below(bytes.size()));
      break;
    case 1:
      if (!other.empty() && !bytes.empty()) {
        const size_t from = below(other.size());
        const size_t count = std::min(other.size() - from, below(64) + 1);
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())),
                     other.begin() + static_cast<std::ptrdiff_t>(from),
                     other.begin() + static_cast<std::ptrdiff_t>(from + count));
      }
      break;
    case 2:
      if (bytes.size() >= 4) {
        static constexpr uint32_t EDGES[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000};
        const uint32_t value = EDGES[below(std::size(EDGES))];
        std::memcpy(bytes.data() + below(std::min(window, bytes.size() - 3)), &value, sizeof value);
      }
      break;
    default:
      for (size_t i = begin; i < std::min(begin + 40, bytes.size()); ++i) {
        bytes[i] = random() % 10 == 0 ? static_cast<uint8_t>(random()) : bytes[i];
      }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned long mutations = 0;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--mutations" && i + 1 < argc) {
      mutations = std::strtoul(argv[++i], nullptr, 10);
    } else if (fs::is_directory(argument)) {
      for (const auto& entry : fs::recursive_directory_iterator(argument)) {
        if (entry.is_regular_file()) {
          files.push_back(entry.path());
        }
      }
    } else {
      files.emplace_back(argument);
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    std::fprintf(stderr, "no inputs\n");
    return 1;
  }
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) {
    std::signal(signal, report);
  }
  unsigned long count = 0;
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same inputs every time
  for (size_t f = 0; f < files.size(); ++f) {
    const Bytes original = read(files[f]);
    run(files[f].string(), original);
    ++count;
    const Bytes other = read(files[(f + 1) % files.size()]);
    for (unsigned long n = 0; n < mutations; ++n, ++count) {
      run(files[f].string() + ", mutation " + std::to_string(n), mutate(original, other, random));
    }
  }
  std::printf("%lu inputs of %zu files\n", count, files.size());
  return 0;
}
