// SPDX-License-Identifier: MIT
#include "api/plan_input.hpp"

#include <algorithm>

namespace welkin {

PlanInput planInput(const WlkContext_T& c, const ViewState& view) {
  PlanInput input;
  input.layers = view.info.layers;
  input.sky = c.air.sky.has_value();
  input.absorber = c.absorbs();
  input.fog = c.fogActive();
  if (input.sky) {
    input.airScaleHeight = c.air.sky->scaleHeight;
  }
  if (input.fog) {
    input.fogBaseAltitude = c.air.fog->baseAltitude;
    input.fogScaleHeight = c.air.fog->scaleHeight;
  }
  input.planet = c.air.planet;
  input.ambient = c.air.ambient.mode != WLK_AMBIENT_OFF;
  input.ambientOfAir = c.air.ambient.mode == WLK_AMBIENT_AUTOMATIC;
  for (uint32_t i = 0; i < c.air.lightCount; ++i) {
    const WlkLight& light = c.air.lights[i];
    if (light.irradiance[0] > 0 || light.irradiance[1] > 0 || light.irradiance[2] > 0) {
      PlanLight& one = input.lights.light[input.lights.count++];
      one.index = i;
      one.toLight =
          glm::normalize(glm::dvec3(light.direction[0], light.direction[1], light.direction[2]));
      one.angularRadius = 0.5 * light.angularDiameter;
      one.irradiance = *std::max_element(light.irradiance, light.irradiance + 3);
      one.shaped = hasShapedDisk(light);
    }
  }
  input.eye = {view.camera.position[0], view.camera.position[1], view.camera.position[2]};
  input.clipFromEye = view.clipFromEye;
  input.width = view.info.width;
  input.height = view.info.height;
  input.quality = governed(view.quality) ? rungQuality(view.quality, view.governor.state().rung)
                                         : resolveQuality(view.quality);
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
