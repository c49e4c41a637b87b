// SPDX-License-Identifier: MIT
// The hypertexture as [B08] 6.2, 6.3 and 8 have it, in the place of that of surface_shell.glsl, to
// measure its cost (-DSHELL_NOISE_COMPUTED): 512 voxels along the body, noise computed in each. In
// no shipped pass. Steps are a pixel or a texel wide where that is wider than a voxel; the core,
// which has no noise, is crossed in wider ones, as Crassin and Neyret 2007 do in a sparse volume.
#include "computed_noise.glsl"

const int SHELL_STEPS = 1024;
const float SHELL_CORE = 1.0f / 3.0f;  // a step there, in depths of the detail
const float SHELL_DENSE = 0.5f;  // rho_0

float voxelOf(SurfaceUniforms s) {
  float cell = s.detailShift.w * s.detail.x;
  return cell * float(max(max(s.cells.x, s.cells.y), s.cells.z)) / 512.0f;
}

float shellDensityAt(ShellDetail detail, vec3 place, float depth) {
  if (depth <= 0.0f || depth >= 1.0f) {
    return depth <= 0.0f ? 0.0f : 1.0f;
  }
  vec3 at = place * detail.scale + detail.shift;
  return shellDensity(depth, computedNoise(at), detail.softness);
}

// 6.3: opacity.
ShellMarch shellMarch(Inside inside, ShellRay ray, float extinction, float seen) {
  float voxel = max(voxelOf(surface), ray.width);
  float core = max(voxel, SHELL_CORE * surface.detail.x);
  ShellDetail detail = shellDetail();
  ShellMarch march;
  march.filled = 0.0f;
  march.lost = 0.0f;
  float at = 0.0f;
  int steps = 0;
  while (steps < SHELL_STEPS && at < inside.chord && extinction * march.filled < SHELL_HIDDEN) {
    vec3 place = ray.origin + pointAt(inside, min(at + 0.5f * voxel, inside.chord)) * ray.slope;
    float depth = shellDepthAt(detail, place);
    float width = min(depth < 1.0f ? voxel : core, inside.chord - at);
    float density = shellDensityAt(detail, place, depth);
    if (march.filled < seen) {
      march.lost += (1.0f - density) * width;
    }
    march.filled += density * width;
    at += width;
    ++steps;
  }
  march.filled += max(inside.chord - at, 0.0f);
  return march;
}

// 6.2: a stretch of the chord with the density in its middle, m.
float shellStretch(Inside inside, ShellRay ray, float begin, float length_) {
  vec3 place = ray.origin + pointAt(inside, begin + 0.5f * length_) * ray.slope;
  ShellDetail detail = shellDetail();
  return length_ * shellDensityAt(detail, place, shellDepthAt(detail, place));
}

// 8: what a light map shows begins at the first voxel of a density above rho_0.
Inside shellLit(Inside inside, ShellRay ray) {
  float voxel = max(voxelOf(surface), ray.width);
  ShellDetail detail = shellDetail();
  float at = 0.0f;
  bool dense = false;
  int steps = 0;
  while (steps < SHELL_STEPS && at < inside.chord && !dense) {
    vec3 place = ray.origin + pointAt(inside, at + 0.5f * voxel) * ray.slope;
    dense = shellDensityAt(detail, place, shellDepthAt(detail, place)) > SHELL_DENSE;
    at += dense ? 0.0f : voxel;
    ++steps;
  }
  Inside lit = inside;
  lit.front = pointAt(inside, min(at, inside.chord));
  lit.leave = lit.front < inside.leave ? inside.leave : inside.back;
  lit.chord = max(inside.chord - at, 0.0f);
  return lit;
}

// The light maps tell it.
float shellShadeLost(ShellRay ray, float shade, int steps) {
  return 0.0f;
}
