// SPDX-License-Identifier: MIT
#include "cli/statistics.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/api.hpp"
#include "common/error.hpp"

namespace cli {
namespace {

using Ordered = nlohmann::ordered_json;

const char* passKind(uint32_t pass) {
  switch (pass) {
    case WLK_PASS_LIGHT_SLICES:
      return "light_slices";
    case WLK_PASS_EYE_SLICES:
      return "eye_slices";
    case WLK_PASS_SKY_TABLE:
      return "sky_table";
    case WLK_PASS_VOLUME_LIGHT:
      return "volume_light";
    case WLK_PASS_CLOUD_SHADOW:
      return "shadow_map";
    case WLK_PASS_COMPOSITE:
      return "composite";
    default:
      return "unknown";
  }
}

Ordered passesOf(const std::vector<WlkPassStats>& passes) {
  Ordered list = Ordered::array();
  for (const WlkPassStats& pass : passes) {
    list.push_back({{"name", std::string(pass.name)},
                    {"kind", passKind(pass.pass)},
                    {"recorded", pass.recorded != 0},
                    {"reason", wlkReasonName(pass.reason)},
                    {"commands", pass.commands},
                    {"volume", pass.volume.id},
                    {"surface", pass.surface.id},
                    {"invocations", pass.invocations},
                    {"gpuTime_ns", pass.gpuTime_ns}});
  }
  return list;
}

Ordered estimateOf(WlkContext context, WlkView view) {
  auto estimate = host::make<WlkErrorEstimate>();
  host::check(wlkGetErrorEstimate(context, view, &estimate), "wlkGetErrorEstimate");
  return {{"relativeError", estimate.relativeError},
          {"dominant", wlkApproximationName(estimate.dominant)},
          {"sky", estimate.part[WLK_APPROXIMATION_SKY]},
          {"fog", estimate.part[WLK_APPROXIMATION_FOG]},
          {"volumeScattering", estimate.part[WLK_APPROXIMATION_VOLUME_SCATTERING]},
          {"volumeSlices", estimate.part[WLK_APPROXIMATION_VOLUME_SLICES]}};
}

}  // namespace

void writeStatistics(const std::string& file, WlkContext context, WlkView view,
                     const host::Scene& scene, const RenderTimes& times) {
  auto stats = host::make<WlkFrameStats>();
  uint32_t count = 0;
  host::check(wlkGetFrameStats(context, view, &stats, &count, sizeof(WlkPassStats), nullptr),
              "wlkGetFrameStats");
  std::vector<WlkPassStats> passes(count);
  host::check(wlkGetFrameStats(context, view, &stats, &count, sizeof(WlkPassStats), passes.data()),
              "wlkGetFrameStats");
  passes.resize(count);
  auto capabilities = host::make<WlkCapabilities>();
  host::check(wlkGetCapabilities(context, &capabilities), "wlkGetCapabilities");

  const Ordered result = {{"scene", scene.file},
                          {"width", scene.view.width},
                          {"height", scene.view.height},
                          {"quality", scene.quality.level},
                          {"device", std::string(capabilities.deviceName)},
                          {"load_ms", times.load_ms},
                          {"prepare_ms", times.prepare_ms},
                          {"frames_ms", times.frames_ms},
                          {"total_ms", times.total_ms},
                          {"frame",
                           {{"frameIndex", stats.frameIndex},
                            {"dispatches", stats.dispatches},
                            {"draws", stats.draws},
                            {"barriers", stats.barriers},
                            {"descriptorWrites", stats.descriptorWrites},
                            {"bytesUploaded", stats.bytesUploaded},
                            {"deviceMemory", stats.deviceMemory},
                            {"hostMemory", stats.hostMemory},
                            {"nonFinitePixels", stats.nonFinitePixels}}},
                          {"errorEstimate", estimateOf(context, view)},
                          {"passes", passesOf(passes)}};
  std::ofstream stream(file);
  stream << result.dump(2, ' ', false, Ordered::error_handler_t::replace) << '\n';
  stream.flush();
  if (!stream) {
    throw host::HostError(file + ": cannot write");
  }
}

}  // namespace cli
