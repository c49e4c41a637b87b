// SPDX-License-Identifier: MIT
// The commands of the welkin program: each declares its options and what runs.
#pragma once

#include <CLI/CLI.hpp>

namespace cli {

void addRender(CLI::App& app);
void addCompare(CLI::App& app);
void addReference(CLI::App& app);
void addSlab(CLI::App& app);
void addSky(CLI::App& app);
void addPhase(CLI::App& app);

}  // namespace cli
