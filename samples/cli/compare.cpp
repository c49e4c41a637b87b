// SPDX-License-Identifier: MIT
// welkin compare: how far one picture is from another.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "common/error.hpp"
#include "common/flip.hpp"
#include "common/metrics.hpp"
#include "common/text.hpp"

namespace cli {
namespace {

struct CompareOptions {
  std::string picture;
  std::string reference;
  std::string variance;
  std::string json;
  std::string flipExposures;
  std::string flipMap;
  double pixelsPerDegree = host::DEFAULT_PIXELS_PER_DEGREE;
};

constexpr const char* COMPARE_HELP = R"(
Metrics over the R, G, B samples that are finite in both pictures, with a from A and b from B:
  relMSE               mean((a - b)^2 / max(|b|, f)^2), f = 1 % of the mean |b|
  rmseOverMean         sqrt(mean((a - b)^2)) / mean |b|
  medianRelativeError  median of |a - b| / max(|b|, f); p90, p95 and p999 are its 90th, 95th
                       and 99.9th percentile
  maxRelativeError     the largest of these
  bias                 mean(a - b) / mean |b|
  nonFinite            samples that are NaN or infinite in A or B
  negative             samples of A below 0
With --variance, of the mean of each sample of B:
  relMSEdenoised       relMSE less the share of B's noise, at least 0
  rmseOverMeanDenoised the same of rmseOverMean
  standardError        sqrt(mean(variance / max(|b|, f)^2)); its square is the noise's relMSE
HDR-FLIP (Andersson et al. 2020, 2021), 0 to 1 per pixel, with 1 where A or B is not finite:
  flip                 mean; flipP95 is the 95th percentile
  flipExposures        stops of the first and the last exposure, and their number. The default
                       brings B's 99.9th percentile of luminance (the sun's disk left out) and
                       its median to 0.85 on the display; pictures to be ranked need the same)";

void requireSize(const std::string& file, const host::Image& image, const std::string& otherFile,
                 const host::Image& other) {
  if (image.width != other.width || image.height != other.height) {
    throw host::InputError(file, "",
                           "expected " + std::to_string(other.width) + " x " +
                               std::to_string(other.height) + " pixels as in " + otherFile +
                               ", got " + std::to_string(image.width) + " x " +
                               std::to_string(image.height));
  }
}

host::Image readVariance(const CompareOptions& options, const host::Image& reference) {
  host::Image variance = host::readExr(options.variance);
  requireSize(options.variance, variance, options.reference, reference);
  for (size_t i = 0; i < variance.rgba.size(); ++i) {
    if (i % 4 != 3 && !(variance.rgba[i] >= 0.0f && std::isfinite(variance.rgba[i]))) {
      throw host::InputError(options.variance, "", "expected variances, finite and at least 0");
    }
  }
  return variance;
}

// START,STOP,COUNT in stops.
host::FlipExposures parseExposures(const std::string& text) {
  // Far beyond what floats can hold.
  constexpr double MOST_STOPS = 300.0;
  const auto parts = host::splitCommas(text);
  const auto number = [&](size_t i) {
    return parts.size() == 3 ? host::parseNumber(parts[i]).value_or(NAN) : NAN;
  };
  const double count = number(2);
  if (!(number(0) >= -MOST_STOPS && number(1) >= number(0) && number(1) <= MOST_STOPS) ||
      !(count >= 1.0 && count <= host::MAX_FLIP_EXPOSURES && count == std::floor(count))) {
    throw host::InputError("command line", "--flip-exposures",
                           "expected START,STOP,COUNT in stops, START <= STOP, COUNT 1 to " +
                               std::to_string(host::MAX_FLIP_EXPOSURES));
  }
  return {number(0), number(1), static_cast<uint32_t>(count)};
}

void writeMetrics(const std::string& file, const nlohmann::ordered_json& result) {
  std::ofstream stream(file);
  stream << result.dump(2) << '\n';
  stream.flush();
  if (!stream) {
    throw host::HostError(file + ": cannot write");
  }
}

void run(const CompareOptions& options) {
  host::FlipOptions flipOptions;
  flipOptions.pixelsPerDegree = options.pixelsPerDegree;
  if (!options.flipExposures.empty()) {
    flipOptions.exposures = parseExposures(options.flipExposures);
  }
  const host::Image picture = host::readExr(options.picture);
  const host::Image reference = host::readExr(options.reference);
  requireSize(options.picture, picture, options.reference, reference);
  const bool denoise = !options.variance.empty();
  const host::Image variance = denoise ? readVariance(options, reference) : host::Image{};
  const host::ImageMetrics metrics =
      host::compareImages(picture, reference, denoise ? &variance : nullptr);
  const host::FlipResult flip = host::hdrFlip(picture, reference, flipOptions);
  nlohmann::ordered_json result = {
      {"relMSE", metrics.relMse},
      {"rmseOverMean", metrics.rmseOverMean},
      {"medianRelativeError", metrics.medianRelativeError},
      {"p90RelativeError", metrics.p90RelativeError},
      {"p95RelativeError", metrics.p95RelativeError},
      {"p999RelativeError", metrics.p999RelativeError},
      {"maxRelativeError", metrics.maxRelativeError},
      {"bias", metrics.bias},
      {"referenceMean", metrics.referenceMean},
      {"nonFinite", metrics.nonFinite},
      {"negative", metrics.negative},
      {"samples", metrics.samples},
  };
  if (denoise) {
    result["relMSEdenoised"] = metrics.relMseDenoised;
    result["rmseOverMeanDenoised"] = metrics.rmseOverMeanDenoised;
    result["standardError"] = metrics.standardError;
  }
  result["flip"] = flip.mean;
  result["flipP95"] = flip.p95;
  result["flipExposures"] = {flip.exposures.start, flip.exposures.stop, flip.exposures.count};
  result["flipPixelsPerDegree"] = options.pixelsPerDegree;
  for (const auto& [name, value] : result.items()) {
    std::printf("%-20s %s\n", name.c_str(), value.dump().c_str());
  }
  if (!options.json.empty()) {
    writeMetrics(options.json, result);
  }
  if (!options.flipMap.empty()) {
    host::writeFlipMap(options.flipMap, flip, reference.width);
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
  command->add_option("--variance", options->variance,
                      "Variance of the mean of each sample of B (EXR)");
  command->add_option("--flip-exposures", options->flipExposures,
                      "START,STOP,COUNT: exposures of FLIP in stops");
  command
      ->add_option("--flip-pixels-per-degree", options->pixelsPerDegree,
                   "Pixels per degree of the viewer's angle, 67.02 by default: 3840 pixels on "
                   "0.7 m at 0.7 m")
      ->check(CLI::Range(1.0, 1000.0));
  command->add_option("--flip-map", options->flipMap, "Write FLIP per pixel to this file (PNG)");
  command->callback([options] { run(*options); });
}

}  // namespace cli
