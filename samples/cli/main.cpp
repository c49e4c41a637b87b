// SPDX-License-Identifier: MIT
// welkin: renders scenes, compares pictures and queries the CPU models, over the public API only.
#include <welkin/welkin.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "cli/commands.hpp"
#include "common/error.hpp"

namespace {

constexpr int EXIT_OTHER = 1;
constexpr int EXIT_BAD_INPUT = 2;

// One line, whatever the message came from.
int report(std::string message, int code) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "welkin: %s\n", message.c_str());
  return code;
}

// That of the library that was found, which need not be the one built with.
std::string versionText() {
  const uint32_t version = wlkGetVersion();
  return std::to_string(version >> 22) + "." + std::to_string(version >> 12 & 0x3ff) + "." +
         std::to_string(version & 0xfff);
}

int run(int argc, char** argv) {
  CLI::App app{"Welkin's sample host. Exit code: 0 success, 1 failure, 2 bad input.", "welkin"};
  app.set_version_flag("--version", versionText);
  app.require_subcommand(1);
  cli::addRender(app);
  cli::addCompare(app);
  cli::addReference(app);
  cli::addSlab(app);
  cli::addSky(app);
  cli::addPhase(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::Error& e) {
    return report(std::string("command line: ") + e.what(), EXIT_BAD_INPUT);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const host::InputError& e) {
    return report(e.what(), EXIT_BAD_INPUT);
  } catch (const std::bad_alloc&) {
    return report("out of memory", EXIT_OTHER);
  } catch (const std::exception& e) {
    return report(e.what(), EXIT_OTHER);
  }
}
