// SPDX-License-Identifier: MIT
#include "api/plan_input.hpp"

namespace welkin {

PlanInput planInput(const WlkContext_T& c, const ViewState& view) {
  PlanInput input;
  input.layers = view.info.layers;
  input.sky = c.air.sky.has_value();
  input.fog = c.fogActive();
  if (input.sky) {
    input.airScaleHeight = c.air.sky->scaleHeight;
  }
  if (input.fog) {
    input.fogBaseAltitude = c.air.fog->baseAltitude;
    input.fogScaleHeight = c.air.fog->scaleHeight;
  }
  input.planet = c.air.planet;
  if (c.air.light) {
    const WlkLight& light = *c.air.light;
    input.light = light.irradiance[0] > 0 || light.irradiance[1] > 0 || light.irradiance[2] > 0;
    input.toLight =
        glm::normalize(glm::dvec3(light.direction[0], light.direction[1], light.direction[2]));
    input.lightAngularRadius = 0.5 * light.angularDiameter;
  }
  input.eye = {view.camera.position[0], view.camera.position[1], view.camera.position[2]};
  input.clipFromEye = view.clipFromEye;
  input.width = view.info.width;
  input.height = view.info.height;
  input.quality = resolveQuality(view.quality);
  return input;
}

PlanVolume planVolume(const WlkContext_T& c, uint32_t slot, uint32_t index,
                      const VolumeState& volume) {
  PlanVolume plan;
  plan.id = c.volumes.idOf(slot);
  plan.index = index;
  plan.worldFromBox = volume.worldFromBox;
  plan.anyDensity = volume.anyDensity();
  return plan;
}

}  // namespace welkin
