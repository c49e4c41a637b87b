// SPDX-License-Identifier: MIT
// Air and fog along the part of a ray inside a volume: exact at 5 nodes, interpolated between.
// Interpolated are optical depth, mean source (radiance / opacity) and the light's irradiance, all
// smooth where radiance itself rises as 1 - e^-tau. The nodes do not depend on the batches.
const int AIR_NODES = 5;

struct AirNodes {
  float begin;
  float scale;
  vec3 depth[AIR_NODES];
  vec3 source[AIR_NODES];
  vec3 light[AIR_NODES];
};

struct AirAt {
  vec3 transmittance;
  vec3 radiance;
  vec3 light;
};

vec3 lightAt(Air air, AirRay ray) {
  vec3 depth = lightOpticalDepth(air, ray.altitude, ray.sunMu);
  float visible = lightVisibility(air, ray.altitude, ray.sunMu, frame.light.w);
  return frame.lightIrradiance.xyz * exp(-depth) * visible;
}

AirNodes airNodes(vec3 direction, float begin, float end) {
  AirNodes nodes;
  nodes.begin = begin;
  float step_ = max(end - begin, 1.0e-3f) / float(AIR_NODES - 1);
  nodes.scale = 1.0f / step_;
  if (ALL_LIGHT) {
    Air air = airOf(frame);
    AirRay ray = airRayOf(frame, direction);
    AirPath path = clipToAir(air, ray, end);
    AirPoint first = airPoint(air, path, 0.0f);
    AirPoint lowest = airPoint(air, path, clamp(path.lowest, 0.0f, path.reach));
    SkyTableRay whole = skyTableRay(ray);
    for (int i = 0; i < AIR_NODES; ++i) {
      float t = begin + float(i) * step_;
      AirPoint there = airPoint(air, path, min(t, path.reach));
      nodes.depth[i] = depthOfColumns(air, columnsTo(air, path, first, lowest, there));
      float share = oneMinusExp(nodes.depth[i].y) / max(whole.total, 1.0e-30f);
      nodes.source[i] = skyTableSource(whole.direction, share, ray.viewSun) *
                        frame.lightIrradiance.xyz;
      nodes.light[i] = lightAt(air, advanceRay(air, ray, t));
    }
  } else if (AIR_ENABLED || FOG_ENABLED) {
    Air air = airOf(frame);
    AirRay ray = airRayOf(frame, direction);
    float airPhase = rayleighPhase(1.0f - ray.viewSun);
    vec3 droplets = FOG_ENABLED ? fogPhaseOf(frame, direction) : vec3(0.0f);
    SkyTableRay whole;
    if (MULTIPLE_ENABLED) {
      whole = skyTableRay(ray);
    }
    AirResult sum;
    sum.radiance = vec3(0.0f);
    sum.opticalDepth = vec3(0.0f);
    float length_ = begin;
    int i = 0;
    do {
      AirResult part = airAlongRay(air, ray, length_, airPhase, droplets, frame.light.w);
      sum.radiance += exp(-sum.opticalDepth) * part.radiance;
      sum.opticalDepth += part.opticalDepth;
      ray = advanceRay(air, ray, length_);
      nodes.depth[i] = sum.opticalDepth;
      nodes.source[i] = vec3(0.0f);
      if (LIGHT_ENABLED) {
        vec3 opacity = opacityOf(sum.opticalDepth);
        vec3 source = sum.radiance / max(opacity, vec3(1.0e-20f));
        if (MULTIPLE_ENABLED) {
          source += skySourceAt(whole, opacity, droplets);
        }
        nodes.source[i] = source * frame.lightIrradiance.xyz;
      }
      nodes.light[i] = LIGHT_ENABLED ? lightAt(air, ray) : vec3(0.0f);
      length_ = step_;
      i += 1;
    } while (i < AIR_NODES);
  }
  return nodes;
}

AirAt airAt(AirNodes nodes, float t) {
  AirAt at;
  if (AIR_ENABLED || FOG_ENABLED) {
    // Hat functions instead of an index: lavapipe runs dynamic indexing of registers slowly.
    float u = clamp((t - nodes.begin) * nodes.scale, 0.0f, float(AIR_NODES - 1));
    vec3 depth = vec3(0.0f);
    vec3 source = vec3(0.0f);
    at.light = vec3(0.0f);
    for (int i = 0; i < AIR_NODES; ++i) {
      float w = max(1.0f - abs(u - float(i)), 0.0f);
      depth += w * nodes.depth[i];
      source += w * nodes.source[i];
      at.light += w * nodes.light[i];
    }
    at.transmittance = exp(-depth);
    at.radiance = source * (1.0f - at.transmittance);
  } else {
    at.transmittance = vec3(1.0f);
    at.radiance = vec3(0.0f);
    at.light = frame.lightIrradiance.xyz;
  }
  return at;
}
