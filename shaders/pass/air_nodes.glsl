// SPDX-License-Identifier: MIT
// Air and fog along the part of a ray inside a volume: exact at 5 nodes, interpolated between.
// Interpolated are optical depth, mean source (radiance / opacity) and the light's irradiance, all
// smooth where radiance itself rises as 1 - e^-tau. By the first light alone. The nodes do not
// depend on the batches.
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
  float visible = lightVisibility(air, ray.altitude, ray.sunMu, frame.lights[0].direction.w);
  return frame.lights[0].irradiance.xyz * exp(-depth) * visible;
}

// The table's source belongs to the opacity of what scatters, the nodes' to all of it.
vec3 scatteringShare(vec3 opacity, vec3 depth) {
  vec3 share = vec3(1.0f);
  if (ABSORBER_ENABLED) {
    share = opacity / max(opacityOf(depth), vec3(1.0e-30f));
  }
  return share;
}

AirNodes airNodes(vec3 direction, float begin, float end) {
  AirNodes nodes;
  nodes.begin = begin;
  float step_ = max(end - begin, 1.0e-3f) / float(AIR_NODES - 1);
  nodes.scale = 1.0f / step_;
  if (ALL_LIGHT) {
    Air air = airOf(frame);
    AirRay ray = airRayOf(frame, frame.lights[0], direction);
    AirPath path = clipToAir(air, ray, end);
    AirPoint first = airPoint(air, path, 0.0f);
    AirPoint lowest = airPoint(air, path, clamp(path.lowest, 0.0f, path.reach));
    SkyTableRay whole = skyTableRay(ray, 0);
    for (int i = 0; i < AIR_NODES; ++i) {
      float t = begin + float(i) * step_;
      AirPoint there = airPoint(air, path, min(t, path.reach));
      vec3 columns = columnsTo(air, path, first, lowest, there);
      nodes.depth[i] = depthOfColumns(air, columns);
      vec3 opacity = opacityOf(scatteringDepth(air, columns));
      float share = opacity.y / max(whole.total, 1.0e-30f);
      nodes.source[i] = skyTableSource(whole.direction, share, ray.viewSun) *
                        scatteringShare(opacity, nodes.depth[i]) * frame.lights[0].irradiance.xyz;
      nodes.light[i] = lightAt(air, advanceRay(air, ray, t));
    }
  } else if (AIR_ENABLED || FOG_ENABLED) {
    Air air = airOf(frame);
    AirRay ray = airRayOf(frame, frame.lights[0], direction);
    float airPhase = rayleighPhase(1.0f - ray.viewSun);
    vec3 droplets = FOG_ENABLED ? fogPhaseOf(direction, frame.lights[0].direction.xyz) : vec3(0.0f);
    SkyTableRay whole;
    if (MULTIPLE_ENABLED) {
      whole = skyTableRay(ray, 0);
    }
    AirResult sum;
    sum.radiance = vec3(0.0f);
    sum.opticalDepth = vec3(0.0f);
    sum.columns = vec3(0.0f);
    float length_ = begin;
    float viewSun = ray.viewSun;
    float lightRadius = frame.lights[0].direction.w;
    int i = 0;
    do {
      AirResult part = airAlongRay(air, ray, length_, airPhase, droplets, lightRadius);
      sum.radiance += exp(-sum.opticalDepth) * part.radiance;
      sum.opticalDepth += part.opticalDepth;
      sum.columns += part.columns;
      ray = advanceRay(air, ray, length_);
      nodes.depth[i] = sum.opticalDepth;
      nodes.source[i] = vec3(0.0f);
      if (LIGHT_ENABLED) {
        vec3 source = sum.radiance / max(opacityOf(sum.opticalDepth), vec3(1.0e-20f));
        if (MULTIPLE_ENABLED) {
          vec3 opacity = opacityOf(scatteringDepth(air, sum.columns));
          source += skySourceAt(whole, opacity, droplets, viewSun) *
                    scatteringShare(opacity, sum.opticalDepth);
        }
        nodes.source[i] = source * frame.lights[0].irradiance.xyz;
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
    at.light = frame.lights[0].irradiance.xyz;
  }
  return at;
}
