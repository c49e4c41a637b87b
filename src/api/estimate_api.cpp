// SPDX-License-Identifier: MIT
// Estimate of a view's error.
#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

#include "api/plan_input.hpp"
#include "frame/error_estimate.hpp"

namespace {

using namespace welkin;

double gapOf(const Particle& particle) {
  double sum = 0;
  for (size_t c = 0; c < RGB; ++c) {
    sum +=
        particle.analytic ? 1 - meanCosine(particle.phase) : meanOneMinusCosine(particle.curve, c);
  }
  return sum / RGB;
}

// All fields of a volume as one body, weighted by what they scatter.
ErrorVolume bodyOf(const VolumeState& volume) {
  ErrorVolume body;
  body.worldFromBox = volume.worldFromBox;
  double mean = 0;
  double square = 0;
  double gap = 0;
  double albedo = 0;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    const double scale =
        static_cast<double>(field.extinctionScale) * field.medium.extinctionFactor();
    // Nothing is known of the values in an engine's image.
    const double fieldMean = scale * (field.external ? 1 : field.mean);
    const double fieldRoot = scale * (field.external ? 1 : std::sqrt(field.meanSquare));
    const std::array<double, RGB> scaled = field.medium.scaledAlbedo();
    mean += fieldMean;
    square += fieldRoot;
    gap += fieldMean * gapOf(*field.medium.particle);
    albedo += fieldMean * (scaled[0] + scaled[1] + scaled[2]) / RGB;
  }
  if (mean > 0 && square > 0) {
    body.gap = gap / mean;
    body.albedo = albedo / mean;
    body.extinction = square * square / mean;
    body.fill = std::min(mean * mean / (square * square), 1.0);
  }
  for (size_t i = 0; i < 3; ++i) {
    body.voxels[i] = volume.size[i];
  }
  return body;
}

ErrorInput errorInput(const WlkContext_T& c, const ViewState& view, const Plan& plan) {
  ErrorInput in;
  in.planet = c.air.planet;
  in.air.planetRadius = c.air.planet.radius;
  if (plan.air) {
    std::copy_n(c.air.sky->rayleighScattering, 3, in.air.airScattering);
    in.air.airScaleHeight = c.air.sky->scaleHeight;
  }
  if (plan.fog) {
    in.air.fogExtinction = c.air.fog->extinction;
    in.air.fogBaseAltitude = c.air.fog->baseAltitude;
    in.air.fogScaleHeight = c.air.fog->scaleHeight;
    std::copy_n(c.air.fog->singleScatteringAlbedo, 3, in.air.fogAlbedo);
    in.fogGap = gapOf(c.air.fogPhase->particle);
  }
  in.eyeFromNdc = view.eyeFromNdc;
  return in;
}

}  // namespace

WlkResult wlkGetErrorEstimate(WlkContext context, WlkView view, WlkErrorEstimate* estimate) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const ViewState& state = c.view(view);
    checkOutput(estimate, WLK_STRUCT_ERROR_ESTIMATE, sizeof *estimate);
    std::pmr::vector<PlanVolume> planned(&c.memory);
    std::pmr::vector<const VolumeState*> states(&c.memory);
    for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
      if (const VolumeState* volume = c.volumes.at(i)) {
        planned.push_back(planVolume(c, i, static_cast<uint32_t>(states.size()), *volume));
        states.push_back(volume);
      }
    }
    PlanInput input = planInput(c, state);
    input.volumes = planned;
    Plan plan(&c.memory);
    makePlan(input, plan);

    std::pmr::vector<ErrorVolume> bodies(&c.memory);
    for (uint32_t i = 0; i < plan.drawnCount; ++i) {
      bodies.push_back(bodyOf(*states[plan.volumes[i].index]));
    }
    ErrorInput in = errorInput(c, state, plan);
    // Of several lights the first, which is the brightest as a rule.
    in.light = plan.lights.count > 0;
    in.toLight = plan.lights.light[0].toLight;
    in.lightAngularRadius = plan.lights.light[0].angularRadius;
    in.eye = input.eye;
    in.quality = input.quality;
    in.volumes = bodies;
    const ErrorParts parts = estimateError(in);

    double sum = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
      estimate->part[i] = static_cast<float>(parts[i]);
      sum += parts[i] * parts[i];
    }
    estimate->relativeError = static_cast<float>(std::min(std::sqrt(sum), 1.0));
    estimate->dominant =
        static_cast<uint32_t>(std::max_element(parts.begin(), parts.end()) - parts.begin());
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
