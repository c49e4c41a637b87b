// SPDX-License-Identifier: MIT
// welkin compare: how far one picture is from another.
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "common/error.hpp"
#include "common/metrics.hpp"
#include "common/text.hpp"

namespace cli {
namespace {

struct CompareOptions {
  std::string picture;
  std::string reference;
  std::string json;
};

constexpr const char* COMPARE_HELP = R"(
Metrics over the R, G, B samples that are finite in both pictures, with a from A and b from B:
  relMSE               mean((a - b)^2 / max(|b|, f)^2), f = 1 % of the mean |b|
  rmseOverMean         sqrt(mean((a - b)^2)) / mean |b|
  p999RelativeError    99.9th percentile of |a - b| / max(|b|, f)
  maxRelativeError     the largest of these
  bias                 mean(a - b) / mean |b|
  nonFinite            samples that are NaN or infinite in A or B)";

void run(const CompareOptions& options) {
  const host::Image picture = host::readExr(options.picture);
  const host::Image reference = host::readExr(options.reference);
  if (picture.width != reference.width || picture.height != reference.height) {
    throw host::InputError(options.picture, "",
                           "expected " + std::to_string(reference.width) + " x " +
                               std::to_string(reference.height) + " pixels as in " +
                               options.reference + ", got " + std::to_string(picture.width) +
                               " x " + std::to_string(picture.height));
  }
  const host::ImageMetrics metrics = host::compareImages(picture, reference);
  const nlohmann::ordered_json result = {
      {"relMSE", metrics.relMse},
      {"rmseOverMean", metrics.rmseOverMean},
      {"p999RelativeError", metrics.p999RelativeError},
      {"maxRelativeError", metrics.maxRelativeError},
      {"bias", metrics.bias},
      {"referenceMean", metrics.referenceMean},
      {"nonFinite", metrics.nonFinite},
      {"samples", metrics.samples},
  };
  for (const auto& [name, value] : result.items()) {
    std::printf("%-18s %s\n", name.c_str(), value.dump().c_str());
  }
  if (!options.json.empty()) {
    std::ofstream stream(options.json);
    stream << result.dump(2) << '\n';
    stream.flush();
    if (!stream) {
      throw host::HostError(options.json + ": cannot write");
    }
  }
}

}  // namespace

void addCompare(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Compare two EXR pictures");
  const auto options = std::make_shared<CompareOptions>();
  command->footer(COMPARE_HELP);
  command->add_option("A", options->picture, "The picture (EXR)")->required();
  command->add_option("B", options->reference, "The reference (EXR)")->required();
  command->add_option("--json", options->json, "Write the metrics to this file as JSON");
  command->callback([options] { run(*options); });
}

}  // namespace cli
