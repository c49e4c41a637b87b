// SPDX-License-Identifier: MIT
// The benchmark's result files: JSON, and the same rows as CSV. Times in ms, memory in bytes.
#pragma once

#include <string>

#include "bench/front_study.hpp"

namespace bench {

/// Everything but the rows and the device: machine, build.
Ordered reportHead(const std::string& commit, bool quick);

Ordered reportRow(const Case& one, const Row& row);

void writeJson(const std::string& file, const Ordered& report);

/// One line per row; nested values as truth.relMSE and so on, null empty.
void writeCsv(const std::string& file, const Ordered& rows);

}  // namespace bench
