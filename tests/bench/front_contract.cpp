// SPDX-License-Identifier: MIT
#include "bench/front_contract.hpp"

#include <cmath>
#include <cstdio>

#include "common/error.hpp"
#include "common/text.hpp"

namespace bench {
namespace {

// What float arithmetic of another order may give where the contract says 0: some hundred roundings
// of 6e-8.
constexpr double ERROR_FLOOR = 1e-5;
// Standard error of the mean of a sky's reference: 4 % per pixel over 128 x 72 pixels.
constexpr double BIAS_FLOOR = 4e-4;

double floorOf(const std::string& figure) {
  if (figure == "bias") {
    return BIAS_FLOOR;
  }
  return figure == "relMSE" ? ERROR_FLOOR * ERROR_FLOOR : ERROR_FLOOR;
}

// Of the metrics, those that a contract holds: they answer for the whole picture, for its worst
// part and for what is seen.
Ordered contractErrors(const Ordered& errors) {
  Ordered kept;
  for (const char* name : {"relMSE", "rmseOverMean", "p999RelativeError", "flip"}) {
    kept[name] = errors.at(name);
  }
  kept["bias"] = std::abs(errors.at("bias").get<double>());
  kept["nonFinite"] = errors.at("nonFinite");
  return kept;
}

std::string describe(const Ordered& row, const std::string& figure, double value, double promised,
                     double tolerance) {
  char text[256];
  const double change = promised > 0.0 ? 100.0 * (value / promised - 1.0) : INFINITY;
  std::snprintf(text, sizeof text,
                "%s, level %s: %s is %.6g, the contract says %.6g: %.3g %% more, %.3g %% allowed",
                row.at("case").get<std::string>().c_str(),
                row.at("level").get<std::string>().c_str(), figure.c_str(), value, promised, change,
                100.0 * (tolerance - 1.0));
  return text;
}

Measured measureMethod(World& world, const Method& method, const host::RasterResult& opaque,
                       const References& references, const Case& one) {
  const WlkView view = world.addView(qualityOf(method));
  world.prepare();
  world.render(view, opaque);
  const host::Image picture = world.read(view);
  const FrameCounts counts = world.counts(view);
  Measured measured;
  measured.isLevel = method.isLevel;
  measured.estimate = world.estimate(view);
  world.removeView(view);
  measured.row = {{"case", one.name},
                  {"level", method.name},
                  {"counts",
                   {{"dispatches", counts.dispatches},
                    {"draws", counts.draws},
                    {"invocations", counts.invocations},
                    {"nonFinitePixels", counts.nonFinite}}},
                  {"errors", Ordered::object()}};
  Ordered& errors = measured.row["errors"];
  if (method.isLevel && references.all.picture) {
    const Ordered truth = errorsOf(picture, references.all, one);
    measured.truth = std::sqrt(truth.value("relMSEdenoised", NAN));
    errors["truth"] = contractErrors(truth);
  }
  if (!method.isLevel) {
    const Ordered limit = errorsOf(picture, references.converged, one);
    measured.slabs = std::sqrt(limit.at("relMSE").get<double>());
    errors["converged"] = contractErrors(limit);
  }
  return measured;
}

}  // namespace

std::vector<Measured> measureLevels(const Case& one, const References& references, bool ultra) {
  World shown(one, false);
  World bare(one, false, false);
  const host::RasterResult opaque = shown.makeOpaque();
  // Slabs and texels answer for themselves with forward scattering, whose limit is no grid's.
  std::vector<Method> methods = levelMethods();
  if (references.converged.picture) {
    if (!ultra) {
      methods.resize(WLK_QUALITY_ULTRA);
    }
    const std::vector<Method> forward = forwardMethods();
    methods.insert(methods.end(), forward.begin(), forward.end());
  }
  std::vector<Measured> all;
  for (const Method& method : methods) {
    World& world = method.settings.ambient ? shown : bare;
    all.push_back(measureMethod(world, method, opaque, references, one));
  }
  return all;
}

Measured measureBare(const Case& one, const References& references) {
  World bare(one, false, false);
  const Method high = levelMethods()[WLK_QUALITY_HIGH];
  return measureMethod(bare, high, bare.makeOpaque(), references, one);
}

host::Image convergedPicture(const Case& one) {
  World world(one, false, false);
  const host::RasterResult opaque = world.makeOpaque();
  const Settings fine = convergedSettings(forwardMethods()[WLK_QUALITY_HIGH].settings);
  const WlkView view = world.addView(explicitQuality(fine));
  world.prepare();
  world.render(view, opaque);
  return world.read(view);
}

std::vector<std::string> violations(const Ordered& measured, const Ordered& contract) {
  if (contract.is_null()) {
    return {measured.at("case").get<std::string>() + ", level " +
            measured.at("level").get<std::string>() + ": the contract has no such row"};
  }
  std::vector<std::string> found;
  for (const auto& [name, promised] : contract.at("counts").items()) {
    const auto value = measured.at("counts").at(name).get<double>();
    if (!(value <= COUNT_TOLERANCE * promised.get<double>())) {
      found.push_back(describe(measured, name, value, promised.get<double>(), COUNT_TOLERANCE));
    }
  }
  for (const auto& [kind, figures] : contract.at("errors").items()) {
    if (!measured.at("errors").contains(kind)) {
      found.push_back(measured.at("case").get<std::string>() + ": no reference of kind " + kind);
      continue;
    }
    for (const auto& [name, promised] : figures.items()) {
      const auto value = measured.at("errors").at(kind).at(name).get<double>();
      if (!(value <= ERROR_TOLERANCE * promised.get<double>() + floorOf(name))) {
        found.push_back(describe(measured, "error " + kind + "." + name, value,
                                 promised.get<double>(), ERROR_TOLERANCE));
      }
    }
  }
  return found;
}

Ordered readContract(const std::string& file) {
  const std::string text = host::readTextFile(file, size_t{16} << 20, "JSON");
  Ordered contract = Ordered::parse(text, nullptr, false);
  if (contract.is_discarded() || !contract.contains("rows")) {
    throw host::InputError(file, "", "expected the contract that welkin_front wrote");
  }
  return contract;
}

Ordered findRow(const Ordered& contract, const Ordered& measured) {
  for (const Ordered& row : contract.at("rows")) {
    if (row.at("case") == measured.at("case") && row.at("level") == measured.at("level")) {
      return row;
    }
  }
  return nullptr;
}

}  // namespace bench
