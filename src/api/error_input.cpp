// SPDX-License-Identifier: MIT
#include "api/error_input.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

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
    gap += fieldMean * meanOneMinusCosine(*field.medium.particle);
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

}  // namespace

ErrorInput errorInput(const WlkContext_T& c, const ViewState& view, const PlanInput& input,
                      const Plan& plan, std::span<const RecordVolume> volumes,
                      std::pmr::vector<ErrorVolume>& bodies) {
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
    in.fogGap = meanOneMinusCosine(c.air.fogPhase->particle);
  }
  in.eyeFromNdc = view.eyeFromNdc;
  // Of several lights the first, which is the brightest as a rule.
  in.light = plan.lights.count > 0;
  in.ambient = input.ambient || (!plan.air && !plan.fog);
  in.toLight = plan.lights.light[0].toLight;
  in.lightAngularRadius = plan.lights.light[0].angularRadius;
  in.eye = input.eye;
  in.quality = input.quality;
  bodies.clear();
  for (uint32_t i = 0; i < plan.drawnCount; ++i) {
    bodies.push_back(bodyOf(*volumes[plan.volumes[i].index].state));
  }
  in.volumes = bodies;
  return in;
}

}  // namespace welkin
