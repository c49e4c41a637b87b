// SPDX-License-Identifier: MIT
// Errors of a picture against the references of its case, relative to their radiance (no unit).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bench/front_cases.hpp"
#include "common/image.hpp"

namespace bench {

using Ordered = nlohmann::ordered_json;

/// A picture that others are compared with; `variance` of its mean if it is an estimate.
struct Reference {
  std::optional<host::Image> picture;
  std::optional<host::Image> variance;
};

/// CASE.all.exr and CASE.single.exr, Monte Carlo of all orders and of the first, each with
/// .variance.exr beside it; CASE.converged.exr, the library's own with many slabs and texels.
struct References {
  Reference all;
  Reference single;
  Reference converged;
};

/// Reads what is there; empty folder name: nothing. Throws InputError for pictures of another size.
References readReferences(const std::string& folder, const Case& one);
std::string referenceFile(const std::string& folder, const Case& one, const std::string& kind);

/// Metrics by name; null without a reference.
Ordered errorsOf(const host::Image& picture, const Reference& reference, const Case& one);

/// Writes a reference with mantissas of `bits` bits: what noise fills needs no space. The relative
/// rounding error is 2^-(bits + 1).
void writePacked(const std::string& file, host::Image image, int bits);

}  // namespace bench
