// SPDX-License-Identifier: MIT
// Planet, sky, absorber, lights and fog.
#include <utility>

#include "api/context.hpp"

namespace {

using namespace welkin;

WlkPlanet checkedPlanet(const WlkPlanet* planet) {
  const WlkPlanet p = copyStruct(planet, WLK_STRUCT_PLANET);
  checkNoChain(planet);
  for (const double x : p.seaLevelPoint) {
    checkRange(p.sType, "seaLevelPoint", x, -1e9, 1e9);
  }
  checkUnit(p.sType, "up", p.up);
  checkRange(p.sType, "radius", p.radius, 1e4, 1e9);
  checkRange3(p.sType, "groundAlbedo", p.groundAlbedo, 0, 1);
  return p;
}

WlkSky checkedSky(const WlkSky* sky) {
  const WlkSky s = copyStruct(sky, WLK_STRUCT_SKY);
  checkNoChain(sky);
  checkRange3(s.sType, "rayleighScattering", s.rayleighScattering, 0, 1);
  checkRange(s.sType, "scaleHeight", s.scaleHeight, 100, 1e5);
  return s;
}

WlkAbsorber checkedAbsorber(const WlkAbsorber* absorber) {
  const WlkAbsorber a = copyStruct(absorber, WLK_STRUCT_ABSORBER);
  checkNoChain(absorber);
  checkRange3(a.sType, "absorption", a.absorption, 0, 1);
  checkRange(a.sType, "peakAltitude", a.peakAltitude, 0, 1e5);
  checkRange(a.sType, "halfWidth", a.halfWidth, 100, 1e5);
  return a;
}

bool absorbs(const std::optional<WlkAbsorber>& absorber) {
  return absorber && (absorber->absorption[0] > 0 || absorber->absorption[1] > 0 ||
                      absorber->absorption[2] > 0);
}

WlkLight checkedLight(const WlkLight* light) {
  const WlkLight l = copyStruct(light, WLK_STRUCT_LIGHT);
  checkNoChain(light);
  checkUnit(l.sType, "direction", l.direction);
  checkRange(l.sType, "angularDiameter", l.angularDiameter, 0, double{0.2f});
  checkRange3(l.sType, "irradiance", l.irradiance, 0, 1e6);
  checkRange3(l.sType, "limbDarkening", l.limbDarkening, 0, 2);
  if (l.litFrom[0] != 0 || l.litFrom[1] != 0 || l.litFrom[2] != 0) {
    checkUnit(l.sType, "litFrom", l.litFrom);
  }
  return l;
}

WlkFog checkedFog(const WlkFog* fog) {
  const WlkFog f = copyStruct(fog, WLK_STRUCT_FOG);
  checkNoChain(fog);
  checkRange(f.sType, "dropletDiameter_um", f.dropletDiameter_um, 0.1f, 50);
  checkRange(f.sType, "phaseModel", f.phaseModel, WLK_PHASE_DEFAULT, WLK_PHASE_TABLE);
  checkRange(f.sType, "extinction", f.extinction, 0, 10);
  checkRange(f.sType, "baseAltitude", f.baseAltitude, -1e4, 1e5);
  checkRange(f.sType, "scaleHeight", f.scaleHeight, 1, 1e5);
  checkRange3(f.sType, "singleScatteringAlbedo", f.singleScatteringAlbedo, 0, 1);
  return f;
}

Particle dropletsOf(const WlkFog& fog) {
  ParticleParams params;
  params.diameter_um = static_cast<double>(fog.dropletDiameter_um);
  params.spread = FOG.spread.initial;
  params.analytic = fog.phaseModel == WLK_PHASE_ANALYTIC;
  return FOG.make(params);
}

std::shared_ptr<const FogPhaseState> makeFogPhase(Particle particle) {
  auto phase = std::make_shared<FogPhaseState>();
  phase->particle = std::move(particle);
  for (size_t i = 0; i < phase->curve.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      phase->curve[i][c] =
          static_cast<float>(phase->particle.curve.value[static_cast<size_t>(c)][i]);
    }
  }
  return phase;
}

// What the layer's light goes through once the part that goes straight on is taken off.
void takeOffDelta(const Medium& medium, WlkFog& fog) {
  Medium layer = medium;
  for (size_t c = 0; c < RGB; ++c) {
    layer.albedo[c] = static_cast<double>(fog.singleScatteringAlbedo[c]);
  }
  const std::array<double, RGB> albedo = layer.scaledAlbedo();
  for (size_t c = 0; c < RGB; ++c) {
    fog.singleScatteringAlbedo[c] = static_cast<float>(albedo[c]);
  }
  fog.extinction *= static_cast<float>(layer.extinctionFactor());
}

[[noreturn]] void failStride(uint32_t stride, size_t size) {
  fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_LIGHT, "stride",
       "stride is %u, expected at least %zu", stride, size);
}

// Same handle, same particles: a handle is never given out twice.
bool samePhase(const WlkFog& a, const WlkFog& b) {
  return a.medium.id == b.medium.id &&
         (a.medium.id != 0 ||
          (a.dropletDiameter_um == b.dropletDiameter_um && a.phaseModel == b.phaseModel));
}

}  // namespace

WlkResult wlkSetPlanet(WlkContext context, const WlkPlanet* planet) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    WlkPlanet value;
    if (planet == nullptr) {
      wlkInitStruct(WLK_STRUCT_PLANET, sizeof value, &value);
    } else {
      value = checkedPlanet(planet);
    }
    c.air.planet = value;
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetSky(WlkContext context, const WlkSky* sky) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    std::optional<WlkSky> value;
    if (sky != nullptr) {
      value = checkedSky(sky);
    }
    if (value.has_value() != c.air.sky.has_value()) {
      c.invalidate();
    }
    c.air.sky = value;
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetAbsorber(WlkContext context, const WlkAbsorber* absorber) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    std::optional<WlkAbsorber> value;
    if (absorber != nullptr) {
      value = checkedAbsorber(absorber);
    }
    if (absorbs(value) != absorbs(c.air.absorber)) {
      c.invalidate();
    }
    c.air.absorber = value;
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetFog(WlkContext context, const WlkFog* fog) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    std::optional<WlkFog> value;
    const Medium* medium = nullptr;
    if (fog != nullptr) {
      value = checkedFog(fog);
      if (value->medium.id != 0) {
        medium = &c.medium(value->medium).medium;
        takeOffDelta(*medium, *value);
      }
    }
    const bool same = value && c.air.fog && c.air.fogPhase && samePhase(*value, *c.air.fog);
    // What may fail first: a failed call changes nothing.
    std::shared_ptr<const FogPhaseState> phase = c.air.fogPhase;
    if (value && !same) {
      phase = makeFogPhase(medium != nullptr ? *medium->particle : dropletsOf(*value));
    }
    if ((value && value->extinction > 0) != c.fogActive()) {
      c.invalidate();
    }
    c.air.fogPhase = phase;
    c.air.fog = value;
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetLights(WlkContext context, uint32_t count, uint32_t stride,
                       const WlkLight* lights) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    if (count > MAX_LIGHTS) {
      fail(WLK_ERROR_LIMIT_EXCEEDED, WLK_STRUCT_LIGHT, "count", "%u lights, this version takes %u",
           count, MAX_LIGHTS);
    }
    if (count > 0) {
      checkPointer(lights, "lights");
    }
    std::array<WlkLight, MAX_LIGHTS> values{};
    for (uint32_t i = 0; i < count; ++i) {
      if (stride < FIRST_SIZE<WlkLight>) {
        failStride(stride, FIRST_SIZE<WlkLight>);
      }
      const auto* light = reinterpret_cast<const WlkLight*>(reinterpret_cast<const char*>(lights) +
                                                            size_t{i} * stride);
      values[i] = checkedLight(light);
      // Elements of an older header are shorter: each says how long it is.
      const size_t known = std::min<size_t>(light->structSize, sizeof(WlkLight));
      if (stride < known) {
        failStride(stride, known);
      }
    }
    const bool before = c.shapedDisk();
    const uint32_t countBefore = std::exchange(c.air.lightCount, count);
    c.air.lights = values;
    // A second light and another kind of disk need pipelines of their own.
    if ((countBefore > 1) != (count > 1) || (c.shapedDisk() && !before)) {
      c.invalidate();
    }
    return WLK_SUCCESS;
  });
}
