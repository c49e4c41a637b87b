// SPDX-License-Identifier: MIT
// What a surface's detail takes from rays. Before: surface_mesh.glsl.

// Where a ray runs through cloud, m: from front to leave, then up to back, `chord` in all.
struct Inside {
  float front;
  float leave;
  float back;
  float chord;
};

// Distance of the point that has `depth` metres of the cloud in front of it: of two stretches and a
// gap that is exact.
float pointAt(Inside inside, float depth) {
  float near = inside.front + depth;
  return near <= inside.leave ? near : max(inside.back - (inside.chord - depth), inside.leave);
}

// Along a ray: place in the cells' box at distance 0 and per metre, and the ray's width, m.
struct ShellRay {
  vec3 origin;
  vec3 slope;
  float width;
};

struct ShellMarch {
  float filled;  // metres that detail leaves
  float lost;    // that it takes in front of the point whose light stands for all
};

// What steps read of a surface's detail. Uniforms of a loop are read before it, here and in other
// passes: drivers such as lavapipe gather each word of theirs for all lanes, about 25 instructions.
struct ShellDetail {
  vec3 scale;      // place in periods of the noise
  vec3 shift;
  float softness;
  float cell;      // depths of the detail
  vec3 cells;      // along the axes
  int edge;        // texels of the noise's level
  ivec3 first;     // where they begin
};

// Without the noise's.
ShellDetail shellDetail() {
  ShellDetail detail;
  detail.scale = surface.detailScale.xyz;
  detail.shift = surface.detailShift.xyz;
  detail.softness = surface.detail.z;
  detail.cell = surface.detailShift.w;
  detail.cells = vec3(surface.cells.xyz);
  return detail;
}

// In depths of the detail, linear between the middles of cells. Beyond the outermost it is theirs.
float shellDepthAt(ShellDetail detail, vec3 place) {
  vec3 cell = clamp(place * detail.cells - 0.5f, vec3(0.0f), detail.cells - 1.001f);
  vec3 low = floor(cell);
  vec3 part = cell - low;
  ivec3 first = ivec3(low);
  ivec2 count = ivec2(detail.cells.xy);
  int at = (first.z * count.y + first.y) * count.x + first.x;
  vec4 face = mix(shellFace(at), shellFace(at + count.x * count.y), part.z);
  vec2 column = mix(face.xz, face.yw, part.x);
  return (mix(column.x, column.y, part.y) - SHELL_OUTSIDE) * detail.cell;
}

// Optical depth behind which nothing counts: an 8 bit picture's last step.
const float SHELL_HIDDEN = 5.5f;

#ifdef SHELL_NOISE_COMPUTED
#include "computed_shell.glsl"
#else
// From where a ray comes in, and before where it leaves for good if what is between is longer.
const int SHELL_STEPS = 28;
const int SHELL_STEPS_BACK = 6;
const float SHELL_FINEST = 0.25f;  // steps in depths of the detail
const float SHELL_COARSEST = 1.0f / 3.0f;
const float SHELL_CORE = 1.0f;  // where the middle of the step is in the core, without detail
const float SHELL_BACK = 0.25f;

// Level of the noise that a ray reads, the same for all steps. The finer of two: steps among what
// they miss are nearer to the truth than what they would blur. Wider pixels have means about as
// wide as they are.
int shellLevel(ShellRay ray) {
  float texels = surface.detailScale.w;  // per metre
  float steps = floor(log2(max(SHELL_COARSEST * surface.detail.x * texels, 1.0f)));
  float pixel = floor(log2(max(ray.width * texels, 1.0f)) + 0.5f);
  return int(min(max(steps, pixel), float(SHELL_LEVELS - 1u)));
}

ShellDetail shellDetail(ShellRay ray) {
  ShellDetail detail = shellDetail();
  int level = shellLevel(ray);
  detail.edge = int(SHELL_NOISE) >> level;
  // As detailBegin has it.
  detail.first = level > 0 ? ivec3(int(SHELL_NOISE) - 2 * detail.edge, 0, SHELL_NOISE) : ivec3(0);
  return detail;
}

// Between the texels of a level, of which each has four corners; along z, the image's x, two of
// them next to each other.
float shellNoiseAt(ShellDetail detail, vec3 at) {
  vec3 texel = at * float(detail.edge) - 0.5f;
  vec3 low = floor(texel);
  vec3 part = texel - low;
  ivec3 first = ivec3(low.zxy) & (detail.edge - 1);
  ivec3 next = ivec3((first.x + 1) & (detail.edge - 1), first.yz);
  vec4 here = texelFetch(shellNoise, detail.first + first, 0);
  vec4 face = mix(here, texelFetch(shellNoise, detail.first + next, 0), part.z);
  vec2 column = mix(face.xz, face.yw, part.x);
  return mix(column.x, column.y, part.y);
}

float shellDensityAt(ShellDetail detail, float depth, vec3 place) {
  vec3 at = place * detail.scale + detail.shift;
  return shellDensity(depth, shellNoiseAt(detail, at), detail.softness);
}

// `seen`: metres of core that end at that point where there are as many; in thinner cloud `lost` is
// the mean over what is seen.
ShellMarch shellMarch(Inside inside, ShellRay ray, float extinction, float seen) {
  float shell = surface.detail.x;
  float base = clamp(inside.chord / float(SHELL_STEPS), SHELL_FINEST * shell,
                     SHELL_COARSEST * shell);
  ShellDetail detail = shellDetail(ray);
  ShellMarch march;
  march.filled = 0.0f;
  march.lost = 0.0f;
  float core = max(base, SHELL_CORE * shell);
  float gap = inside.leave - inside.front;  // wide steps end there
  float at = 0.0f;
  float narrow = 0.0f;  // up to there
  int steps = 0;
  bool inCore = false;
  while (steps < SHELL_STEPS && at < inside.chord && extinction * march.filled < SHELL_HIDDEN) {
    float wide = at < gap ? clamp(gap - at, base, core) : core;
    float width = min(inCore ? wide : base, inside.chord - at);
    vec3 place = ray.origin + pointAt(inside, at + 0.5f * width) * ray.slope;
    float depth = shellDepthAt(detail, place);
    float density = depth < 1.0f ? shellDensityAt(detail, depth, place) : 1.0f;
    // A wide step that comes upon the shell is taken again, in narrow ones.
    bool again = inCore && depth < 1.0f;
    narrow = again ? at + width : narrow;
    width = again ? 0.0f : width;
    inCore = depth >= 1.0f && at + width >= narrow;
    float filled = march.filled + density * width;
    if (filled < seen) {
      march.lost += (1.0f - density) * width * exp(-extinction * march.filled);
    } else if (march.filled < seen) {
      march.lost = at + (seen - march.filled) / density - seen;
    }
    march.filled = filled;
    at += width;
    ++steps;
  }
  float rest = inside.chord - at;
  march.filled += rest;
  // Of a loop that no lane enters lavapipe runs one turn, of a branch all of it.
  int back = rest > 0.0f && extinction * march.filled < SHELL_HIDDEN ? SHELL_STEPS_BACK : 0;
  float width = min(SHELL_BACK * shell, rest / float(SHELL_STEPS_BACK));
  while (back > 0) {
    float depth = inside.chord - (float(back) - 0.5f) * width;
    vec3 place = ray.origin + pointAt(inside, depth) * ray.slope;
    march.filled -=
        (1.0f - shellDensityAt(detail, shellDepthAt(detail, place), place)) * width;
    --back;
  }
  march.filled = max(march.filled, 0.0f);
  return march;
}

// Metres that detail takes from the `shade` metres of cloud between a point and the light, near the
// point; further away what it takes in the mean. ray: from the point to the light, looked along
// `steps` times.
const float SHELL_SHADE = 2.0f;  // depths of the detail that are looked at
float shellShadeLost(ShellRay ray, float shade, int steps) {
  float shell = surface.detail.x;
  float width = min(shade, SHELL_SHADE * shell) / float(steps);
  ShellDetail detail = shellDetail(ray);
  float lost = 0.0f;
  for (int i = 0; i < steps; ++i) {
    vec3 place = ray.origin + (float(i) + 0.5f) * width * ray.slope;
    lost += 1.0f - shellDensityAt(detail, shellDepthAt(detail, place), place);
  }
  float beyond = clamp(shade / shell - SHELL_SHADE, 0.0f, 1.0f);
  return min(lost * width + 0.5f * shell * beyond, shade);
}
#endif
