// SPDX-License-Identifier: MIT
// Texels of a surface's light map from what its triangles cover, and four levels of means above.
// Texels of the levels follow each other, coarser ones last; copies make images of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// From a level that is there, not from triangles.
layout(constant_id = 3) const bool FROM_LEVEL = false;
layout(constant_id = 7) const bool DETAIL = true;
#include "surface_mesh.glsl"
#include "surface_shell.glsl"
#include "../interface/slices.glsl"
layout(set = 0, binding = 8, std430) readonly buffer Faces { SurfaceFaces faces[]; };
layout(set = 0, binding = 9, std430) buffer Levels { vec4 levels[]; };
layout(set = 0, binding = 7, rgba32f) writeonly uniform image2D depths;
layout(push_constant) uniform Push { SliceConstants slice; };

struct MapTexel {
  vec4 column;  // coverage, through (m), x and y of the lit face's normal
  vec4 face;    // z of that; x and y of the shaded face's; depth of the lit face, m
};

shared vec4 columns[64];
shared vec4 sides[64];

// Normal in the light's frame, of either sign; 0 where the triangle is seen edge on.
vec3 normalOf(uint triangle) {
  uvec3 corners = surfaceCorners(triangle);
  vec3 p[3];
  for (uint i = 0u; i < 3u; ++i) {
    vec4 at = vec4(surfaceVertex(corners[i]), 1.0f);
    p[i] = vec3(dot(surface.pixelX, at) * surface.map.x, dot(surface.pixelY, at) * surface.map.x,
                -dot(surface.depth, at));
  }
  return directionOr(cross(p[1] - p[0], p[2] - p[0]), vec3(0.0f));
}

// Along a texel's way.
ShellRay shellRay(vec2 place) {
  vec4 origin = vec4(place, 0.0f, 1.0f);
  ShellRay ray;
  ray.origin =
      vec3(dot(surface.cellX, origin), dot(surface.cellY, origin), dot(surface.cellZ, origin));
  ray.slope = vec3(surface.cellX.z, surface.cellY.z, surface.cellZ.z);
  ray.width = surface.detail.w;
  return ray;
}

MapTexel fromTriangles(uvec2 texel, uint size) {
  uint at = texel.y * size + texel.x;
  SurfaceCover cover = coverOf(at);
  MapTexel result;
  result.column = vec4(0.0f);
  result.face = vec4(0.0f);
  vec4 depth = vec4(0.0f);
  if (cover.chord > 0 && cover.front != 0u) {
    uint lit = faces[at].lit;
    uint shaded = faces[at].shaded;
    vec3 near = lit > 0u ? normalOf(lit - 1u) : vec3(0.0f);
    vec3 far = shaded > 0u ? normalOf(shaded - 1u) : vec3(0.0f);
    near = near.z < 0.0f ? -near : near;
    far = far.z > 0.0f ? -far : far;
    float metre = 1.0f / surface.steps.y;
    Inside inside;
    inside.front = float(~cover.front) * metre;
    inside.leave = float(~cover.leave) * metre;
    inside.back = float(cover.back) * metre;
    inside.chord = float(cover.chord) * metre;
    float through = inside.chord;
    if (DETAIL) {
      ShellRay ray = shellRay((vec2(texel) + 0.5f) / float(size));
#ifdef SHELL_NOISE_COMPUTED
      inside = shellLit(inside, ray);
      through = inside.chord;
#else
      through = shellMarch(inside, ray, 0.0f, 0.0f).filled;
#endif
    }
    if (through > 0.0f) {
      result.column = vec4(1.0f, through, near.xy);
      result.face = vec4(near.z, far.xy, inside.front);
    }
    depth = vec4(inside.front, inside.leave, inside.back, inside.chord);
  }
  imageStore(depths, ivec2(texel), depth);
  return result;
}

void store(uint row, MapTexel texel) {
  levels[row] = texel.column;
  levels[slice.slabCount + row] = texel.face;
}

// slice.lightSize: texels along an edge of the level at hand; firstSlab: row its texels begin at;
// slabCount: rows of all levels, behind which the faces' begin. An invocation takes four texels and
// has their mean at hand: drivers such as lavapipe take all lanes through the levels above, which
// few of them have anything to do with.
void main() {
  uint size = slice.lightSize;
  uint half_ = size / 2u;
  uvec2 block = gl_GlobalInvocationID.xy;
  uint lane = gl_LocalInvocationIndex;
  MapTexel mean;
  mean.column = vec4(0.0f);
  mean.face = vec4(0.0f);
  uint first = slice.firstSlab;
  if (block.x < half_ && block.y < half_) {
    for (uint corner = 0u; corner < 4u; ++corner) {
      uvec2 texel = 2u * block + uvec2(corner & 1u, corner >> 1u);
      uint row = first + texel.y * size + texel.x;
      MapTexel one;
      if (FROM_LEVEL) {
        one.column = levels[row];
        one.face = levels[slice.slabCount + row];
      } else {
        one = fromTriangles(texel, size);
        store(row, one);
      }
      mean.column += 0.25f * one.column;
      mean.face += 0.25f * one.face;
    }
    store(first + size * size + block.y * half_ + block.x, mean);
  }
  columns[lane] = mean.column;
  sides[lane] = mean.face;
  for (uint level = 2u; level <= SURFACE_MAP_LEVELS; ++level) {
    memoryBarrierShared();
    barrier();
    first += size * size;
    size /= 2u;
    uint edge = 16u >> level;
    uvec2 here = uvec2(lane % edge, lane / edge);
    bool mine = lane < edge * edge && size > 1u;
    if (mine) {
      uint corner = 4u * edge * here.y + 2u * here.x;
      mean.column = 0.25f * (columns[corner] + columns[corner + 1u] + columns[corner + 2u * edge] +
                             columns[corner + 2u * edge + 1u]);
      mean.face = 0.25f * (sides[corner] + sides[corner + 1u] + sides[corner + 2u * edge] +
                           sides[corner + 2u * edge + 1u]);
      uvec2 place = gl_WorkGroupID.xy * edge + here;
      uint above = size / 2u;
      if (place.x < above && place.y < above) {
        store(first + size * size + place.y * above + place.x, mean);
      }
    }
    memoryBarrierShared();
    barrier();
    if (mine) {
      columns[lane] = mean.column;
      sides[lane] = mean.face;
    }
  }
}
