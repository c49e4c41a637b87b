// SPDX-License-Identifier: MIT
// A view's sky table: what sky_light.glsl gathers along rays from the eye, as mean source. One
// invocation for each light and direction. Recorded only when eye, light or air have changed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/sky_table.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1) uniform sampler2D skyMoments;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image3D skyTable;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image3D skyPeak;
layout(set = 0, binding = 4) uniform sampler3D skyFog;

// Air alone: the table holds its light of all orders, and by phase function of air, so that pixels
// need no more.
layout(constant_id = 3) const bool ALL_LIGHT = false;

#include "ray.glsl"
#include "air_column.glsl"
#include "sky_light.glsl"

const int STEPS = 20;
const int FOG_STEPS_MORE = 12;
const int BISECTIONS = 12;
// The first node stands for the source at the eye.
const float FIRST_SHARE = 1.0e-3f;

vec3 opacityOf(vec3 depth) {
  return vec3(oneMinusExp(depth.x), oneMinusExp(depth.y), oneMinusExp(depth.z));
}

// Opacity in green from the ray's origin to t.
float opacityTo(Air air, AirPath path, AirPoint first, AirPoint lowest, float t) {
  vec3 columns = columnsTo(air, path, first, lowest, airPoint(air, path, t));
  return oneMinusExp(scatteringDepth(air, columns).y);
}

// What was gathered up to one node of the share of opacity.
struct Node {
  vec3 light;
  vec3 peak;
  vec3 fog;
  vec3 opacity;
  float distance_;
};

Node between(Node a, Node b, float part) {
  Node node;
  node.light = mix(a.light, b.light, part);
  node.peak = mix(a.peak, b.peak, part);
  node.fog = mix(a.fog, b.fog, part);
  node.opacity = mix(a.opacity, b.opacity, part);
  node.distance_ = mix(a.distance_, b.distance_, part);
  return node;
}

// First order up to the last node stored: each node's stretch goes on from the node before.
struct FirstOrder {
  AirRay ray;
  float distance_;
  vec3 light;
  vec3 columns;
};

FirstOrder firstOrderTo(Air air, FirstOrder sum, float distance_, float radius) {
  AirResult part =
      airAlongRay(air, sum.ray, max(distance_ - sum.distance_, 0.0f), 1.0f, vec3(0.0f), radius);
  FirstOrder next;
  next.light = sum.light + safeExp3(-depthOfColumns(air, sum.columns)) * part.radiance;
  next.columns = sum.columns + part.columns;
  next.ray = advanceRay(air, sum.ray, max(distance_ - sum.distance_, 0.0f));
  next.distance_ = distance_;
  return next;
}

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  int which = place.x / SKY_AZIMUTHS;
  int above = int(frame.skyZeniths.w);
  if (place.x >= imageSize(skyTable).x || place.y >= above + SKY_BELOW) {
    return;
  }
  if (which >= int(LIGHT_COUNT)) {
    // Filters read a neighbour's texel with weight 0: it must be a number.
    for (int k = 0; k < SKY_SHARES; ++k) {
      imageStore(skyTable, ivec3(place, k), vec4(0.0f));
      if (FOG_ENABLED) {
        imageStore(skyPeak, ivec3(place, k), vec4(0.0f));
        imageStore(skyPeak, ivec3(place, k + SKY_SHARES), vec4(0.0f));
      }
    }
    return;
  }
  LightUniforms light = frameBlock.lights[which];
  Air air = airOf(frame);
  bool below = place.y >= above;
  float rise = below ? float(place.y - above) / float(SKY_BELOW - 1)
                     : float(place.y) / float(above - 1);
  rise = max(rise, 1.0e-3f);
  rise *= rise;
  // In twilight twice as dense at the horizon.
  float bend = above > SKY_ABOVE ? 1.0f : 0.0f;
  float horizon = frame.skyView.x;
  float range = below ? -1.0f - horizon : frame.skyView.y - horizon;
  AirRay ray;
  ray.altitude = frame.eye.w;
  ray.viewMu = clamp(horizon + range * rise / (1.0f + bend * (1.0f - rise)), -1.0f, 1.0f);
  ray.sunMu = light.irradiance.w;
  float azimuth = 1.0f - 2.0f * float(uint(place.x) % uint(SKY_AZIMUTHS)) / float(SKY_AZIMUTHS - 1);
  float sines = sqrt(max((1.0f - ray.viewMu) * (1.0f + ray.viewMu), 0.0f)) *
                sqrt(max((1.0f - ray.sunMu) * (1.0f + ray.sunMu), 0.0f));
  ray.viewSun = ray.viewMu * ray.sunMu + sines * azimuth;
  float ground = groundDistance(ray.altitude, ray.viewMu, air.planetRadius);

  AirPath path = clipToAir(air, ray, skyTableReach(ground, ALL_LIGHT));
  AirPoint lowest = airPoint(air, path, clamp(path.lowest, 0.0f, path.reach));
  SkyMarch march = skyMarchBegin(air, path);
  AirPoint first = march.at;
  float total = opacityTo(air, path, first, lowest, path.reach);

  Node nodes[SKY_SHARES];
  int share = 0;
  Node here;
  here.light = here.peak = here.fog = here.opacity = vec3(0.0f);
  here.distance_ = 0.0f;
  float x = 0.0f;
  const int COUNT = FOG_ENABLED ? STEPS + FOG_STEPS_MORE : STEPS;
  for (int i = 1; i <= COUNT; ++i) {
    float wanted = float(i) / float(COUNT);
    float stop = wanted;
    if (FOG_ENABLED && i < COUNT) {
      // Evenly in the mean of the stop's number and the opacity in front of it.
      float low = x;
      float high = 1.0f;
      for (int k = 0; k < BISECTIONS; ++k) {
        stop = 0.5f * (low + high);
        float part = opacityTo(air, path, first, lowest, skyStop(path, stop));
        bool far = 0.5f * stop + 0.5f * part / max(total, 1.0e-30f) > wanted;
        low = far ? low : stop;
        high = far ? stop : high;
      }
    }
    x = stop;
    march = skyMarchTo(air, path, march, skyStop(path, x), light.direction.w);
    Node next;
    next.light = march.light;
    next.peak = march.peak;
    next.fog = march.fog;
    next.opacity = opacityOf(scatteringDepth(air, march.columns));
    next.distance_ = march.at.distance;
    for (int k = 0; k < SKY_SHARES; ++k) {
      float target = total * max(float(share) / float(SKY_SHARES - 1), FIRST_SHARE);
      if (share >= SKY_SHARES - 1 || target > next.opacity.y) {
        break;
      }
      float part = (target - here.opacity.y) / max(next.opacity.y - here.opacity.y, 1.0e-30f);
      nodes[share] = between(here, next, clamp(part, 0.0f, 1.0f));
      share += 1;
    }
    here = next;
  }
  FirstOrder sum;
  sum.ray = ray;
  sum.distance_ = 0.0f;
  sum.light = sum.columns = vec3(0.0f);
  for (int k = 0; k < SKY_SHARES; ++k) {
    Node node = here;
    if (k < share) {
      node = nodes[k];
    }
    vec3 source = node.light / max(node.opacity, vec3(1.0e-30f));
    if (ALL_LIGHT) {
      sum = firstOrderTo(air, sum, node.distance_, light.direction.w);
      source = source / rayleighPhase(1.0f - ray.viewSun) +
               sum.light / max(opacityOf(scatteringDepth(air, sum.columns)), vec3(1.0e-30f));
    }
    imageStore(skyTable, ivec3(place, k), vec4(source, total));
    if (FOG_ENABLED) {
      vec3 share_ = 1.0f / max(node.opacity, vec3(1.0e-30f));
      imageStore(skyPeak, ivec3(place, k), vec4(node.peak * share_, 0.0f));
      imageStore(skyPeak, ivec3(place, k + SKY_SHARES), vec4(node.fog * share_, 0.0f));
    }
  }
}
