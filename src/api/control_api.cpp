// SPDX-License-Identifier: MIT
// Governed views: their part of a frame, reported times, state.
#include "api/control.hpp"
#include "api/error_input.hpp"
#include "api/plan_input.hpp"

namespace welkin {

void beginControl(WlkContext_T& c, ViewState& view) {
  if (governed(view.quality)) {
    c.harvest(view);
    view.governor.beginFrame(c.frameIndex);
  }
}

void controlPlan(WlkContext_T& c, ViewState& view, PlanInput& input) {
  if (!governed(view.quality)) {
    return;
  }
  if (view.plan.drawnCount == 0) {
    view.governor.idle(c.frameIndex);
    return;
  }
  if (view.quality.control != WLK_CONTROL_ERROR || !view.governor.wantsErrors(c.frameIndex)) {
    return;
  }
  std::array<uint32_t, RUNGS> slabs{};
  std::array<double, RUNGS> errors{};
  for (uint32_t i = 0; i < RUNGS; ++i) {
    slabs[i] = rungQuality(view.quality, i).sliceCount;
  }
  const ErrorInput in = errorInput(c, view, input, view.plan, c.recordVolumes, c.errorVolumes);
  estimateErrors(in, slabs, errors);
  if (view.governor.feedErrors(c.frameIndex, errors,
                               static_cast<double>(view.quality.errorTarget))) {
    view.governor.beginFrame(c.frameIndex);
    input.quality = rungQuality(view.quality, view.governor.state().rung);
    makePlan(input, view.plan);
  }
}

}  // namespace welkin

using namespace welkin;

WlkResult wlkGetQualityState(WlkContext context, WlkView view, WlkQualityState* state) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ViewState& v = c.view(view);
    WlkQualityState value = startOutput(state, WLK_STRUCT_QUALITY_STATE);
    const bool control = governed(v.quality);
    if (control) {
      c.harvest(v);
    }
    const GovernorState& governor = v.governor.state();
    const SliceQuality quality =
        control ? rungQuality(v.quality, governor.rung) : resolveQuality(v.quality);
    const RungRange range = rungRange(v.quality);
    value.control = v.quality.control;
    value.reason = control ? governor.reason : uint32_t{WLK_CONTROL_REASON_NONE};
    value.rung = control ? governor.rung : range.highest;
    value.lowestRung = control ? range.lowest : range.highest;
    value.highestRung = range.highest;
    value.sliceCount = quality.sliceCount;
    const bool kept = quality.stored && !(v.prepared && v.resources.batches);
    value.batchSize = kept ? 0 : quality.batchSize;
    value.lightBufferSize = quality.lightSize;
    value.volumeCells = quality.transport ? quality.transportCells : 0;
    value.time_ms = control ? static_cast<float>(governor.time) : 0.0f;
    value.predictedTime_ms = control ? static_cast<float>(governor.predicted) : 0.0f;
    value.relativeError = control ? static_cast<float>(governor.error) : 0.0f;
    value.sinceFrame = control ? governor.since : 0;
    value.switches = control ? governor.switches : 0;
    finishOutput(value, state);
    return WLK_SUCCESS;
  });
}

WlkResult wlkReportFrameTime(WlkContext context, WlkView view, uint64_t frameIndex,
                             double milliseconds) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ViewState& v = c.view(view);
    if (!(milliseconds > 0 && milliseconds <= GOVERNOR_LONGEST)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "milliseconds", "milliseconds is %g, expected (0, %g]",
           milliseconds, GOVERNOR_LONGEST);
    }
    if (frameIndex == 0 || frameIndex > v.lastFrame) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "frameIndex",
           "frameIndex is %llu, the view's last frame was %llu",
           static_cast<unsigned long long>(frameIndex),
           static_cast<unsigned long long>(v.lastFrame));
    }
    if (v.quality.control != WLK_CONTROL_REPORTED_TIME) {
      fail(WLK_ERROR_WRONG_STATE, 0, "view", "wlkReportFrameTime needs WLK_CONTROL_REPORTED_TIME");
    }
    v.governor.feedTime(frameIndex, milliseconds, static_cast<double>(v.quality.timeBudget_ms));
    return WLK_SUCCESS;
  });
}

const char* wlkControlReasonName(uint32_t reason) {
  switch (reason) {
    case WLK_CONTROL_REASON_NONE:
      return "WLK_CONTROL_REASON_NONE";
    case WLK_CONTROL_REASON_MEASURING:
      return "WLK_CONTROL_REASON_MEASURING";
    case WLK_CONTROL_REASON_FITS:
      return "WLK_CONTROL_REASON_FITS";
    case WLK_CONTROL_REASON_BEST:
      return "WLK_CONTROL_REASON_BEST";
    case WLK_CONTROL_REASON_RISING:
      return "WLK_CONTROL_REASON_RISING";
    case WLK_CONTROL_REASON_OVER:
      return "WLK_CONTROL_REASON_OVER";
    case WLK_CONTROL_REASON_UNREACHABLE:
      return "WLK_CONTROL_REASON_UNREACHABLE";
    case WLK_CONTROL_REASON_IDLE:
      return "WLK_CONTROL_REASON_IDLE";
    default:
      return "WLK_UNKNOWN_CONTROL_REASON";
  }
}
