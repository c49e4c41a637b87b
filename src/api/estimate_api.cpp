// SPDX-License-Identifier: MIT
// Estimate of a view's error.
#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

#include "api/error_input.hpp"
#include "api/plan_input.hpp"

using namespace welkin;

WlkResult wlkGetErrorEstimate(WlkContext context, WlkView view, WlkErrorEstimate* estimate) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const ViewState& state = c.view(view);
    WlkErrorEstimate value = startOutput(estimate, WLK_STRUCT_ERROR_ESTIMATE);
    std::pmr::vector<PlanVolume> planned(&c.memory);
    std::pmr::vector<RecordVolume> states(&c.memory);
    for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
      if (const VolumeState* volume = c.volumes.at(i)) {
        planned.push_back(planVolume(c, i, static_cast<uint32_t>(states.size()), *volume));
        states.push_back({volume, {}});
      }
    }
    PlanInput input = planInput(c, state);
    input.volumes = planned;
    Plan plan(&c.memory);
    makePlan(input, plan);

    std::pmr::vector<ErrorVolume> bodies(&c.memory);
    const ErrorInput in = errorInput(c, state, input, plan, states, bodies);
    const ErrorParts parts = estimateError(in);

    double sum = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
      value.part[i] = static_cast<float>(parts[i]);
      sum += parts[i] * parts[i];
    }
    value.relativeError = static_cast<float>(std::min(std::sqrt(sum), 1.0));
    value.dominant =
        static_cast<uint32_t>(std::max_element(parts.begin(), parts.end()) - parts.begin());
    finishOutput(value, estimate);
    return WLK_SUCCESS;
  });
}

const char* wlkApproximationName(uint32_t approximation) {
  switch (approximation) {
    case WLK_APPROXIMATION_SKY:
      return "WLK_APPROXIMATION_SKY";
    case WLK_APPROXIMATION_FOG:
      return "WLK_APPROXIMATION_FOG";
    case WLK_APPROXIMATION_VOLUME_SCATTERING:
      return "WLK_APPROXIMATION_VOLUME_SCATTERING";
    case WLK_APPROXIMATION_VOLUME_SLICES:
      return "WLK_APPROXIMATION_VOLUME_SLICES";
    default:
      return "WLK_UNKNOWN_APPROXIMATION";
  }
}
