// SPDX-License-Identifier: MIT
#include "bench/front_errors.hpp"

#include <cmath>
#include <filesystem>

#include "common/error.hpp"
#include "common/flip.hpp"
#include "common/metrics.hpp"

namespace bench {
namespace {

std::optional<host::Image> readIfThere(const std::string& file, const Case& one) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return std::nullopt;
  }
  host::Image image = host::readExr(file);
  if (image.width != one.width || image.height != one.height) {
    throw host::InputError(file, "",
                           "expected " + std::to_string(one.width) + " x " +
                               std::to_string(one.height) + " pixels as in the list of cases");
  }
  return image;
}

}  // namespace

std::string referenceFile(const std::string& folder, const Case& one, const std::string& kind) {
  return (std::filesystem::path(folder) / (one.name + "." + kind + ".exr")).string();
}

References readReferences(const std::string& folder, const Case& one) {
  References references;
  if (folder.empty()) {
    return references;
  }
  const auto read = [&](const std::string& kind) {
    return readIfThere(referenceFile(folder, one, kind), one);
  };
  references.all = {read("all"), read("all.variance")};
  references.single = {read("single"), read("single.variance")};
  references.converged = {read("converged"), std::nullopt};
  return references;
}

Ordered errorsOf(const host::Image& picture, const Reference& reference, const Case& one) {
  if (!reference.picture) {
    return nullptr;
  }
  const host::ImageMetrics metrics = host::compareImages(
      picture, *reference.picture, reference.variance ? &*reference.variance : nullptr);
  host::FlipOptions flip;
  flip.exposures = host::FlipExposures{one.flipStart, one.flipStop, one.flipCount};
  Ordered errors = {{"relMSE", metrics.relMse}};
  if (reference.variance) {
    errors["relMSEdenoised"] = metrics.relMseDenoised;
    errors["rmseOverMeanDenoised"] = metrics.rmseOverMeanDenoised;
    errors["standardError"] = metrics.standardError;
  }
  errors["rmseOverMean"] = metrics.rmseOverMean;
  errors["medianRelativeError"] = metrics.medianRelativeError;
  errors["p95RelativeError"] = metrics.p95RelativeError;
  errors["p999RelativeError"] = metrics.p999RelativeError;
  errors["maxRelativeError"] = metrics.maxRelativeError;
  errors["bias"] = metrics.bias;
  errors["flip"] = host::hdrFlip(picture, *reference.picture, flip).mean;
  errors["nonFinite"] = metrics.nonFinite;
  errors["negative"] = metrics.negative;
  return errors;
}

void writePacked(const std::string& file, host::Image image, int bits) {
  for (float& value : image.rgba) {
    int exponent = 0;
    const float mantissa = std::frexp(value, &exponent);
    value = std::ldexp(std::nearbyint(std::ldexp(mantissa, bits + 1)), exponent - bits - 1);
  }
  host::writeExr(file, image);
}

}  // namespace bench
