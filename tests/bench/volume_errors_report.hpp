// SPDX-License-Identifier: MIT
// Errors of pictures of volumes, relative, and the tables of docs/accuracy-and-performance.md.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/volume_truth.hpp"

namespace bench {

using Ordered = nlohmann::ordered_json;

struct VolumeErrors {
  double total = 0;       // sum over the truth's
  double rms = 0;         // over all pixels and their mean; the truth's noise is taken off
  double rmsCovered = 0;  // the same of the pixels that the volume covers
};

VolumeErrors volumeErrors(const std::vector<double>& picture, const TruthImage& truth);

/// The rows of a result file, empty if there is none.
Ordered readRows(const std::string& file);

/// In place of the row of the same case, level and form, or at the end.
void putRow(Ordered& rows, const Ordered& row);

/// Puts the tables between the marks of a page.
void writeTables(const std::string& page, const Ordered& rows);

}  // namespace bench
