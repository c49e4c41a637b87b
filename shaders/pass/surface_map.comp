// SPDX-License-Identifier: MIT
// Texels of a surface's light map from what its triangles cover, and the levels of means above.
// Texels of the levels follow each other, coarser ones last; copies make images of them.
//
// An invocation has what it takes the means of at hand: drivers such as lavapipe take all lanes
// through what few have a part in, and pay for what they share.
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
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

struct MapTexel {
  vec4 column;  // coverage, through (m), x and y of the lit face's normal
  vec4 face;    // z of that; x and y of the shaded face's; depth of the lit face, m
};

// Rows from the mesh to the light's frame, m.
struct MapFrame {
  vec4 x;
  vec4 y;
  vec4 depth;
};

// Normal in the light's frame, of either sign; 0 where the triangle is seen edge on.
vec3 normalOf(MapFrame f, uint triangle) {
  uvec3 corners = surfaceCorners(triangle);
  vec3 p[3];
  for (uint i = 0u; i < 3u; ++i) {
    vec4 at = vec4(surfaceVertex(corners[i]), 1.0f);
    p[i] = vec3(dot(f.x, at), dot(f.y, at), -dot(f.depth, at));
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

MapTexel fromTriangles(MapFrame frame, uvec2 texel, uint size) {
  uint at = texel.y * size + texel.x;
  SurfaceCover cover = coverOf(at);
  MapTexel result;
  result.column = vec4(0.0f);
  result.face = vec4(0.0f);
  vec4 depth = vec4(0.0f);
  if (cover.chord > 0 && cover.front != 0u) {
    uint lit = faces[at].lit;
    uint shaded = faces[at].shaded;
    vec3 near = lit > 0u ? normalOf(frame, lit - 1u) : vec3(0.0f);
    vec3 far = shaded > 0u ? normalOf(frame, shaded - 1u) : vec3(0.0f);
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

MapTexel fromLevel(uint row) {
  return MapTexel(levels[row], levels[slice.slabCount + row]);
}

void addTo(inout MapTexel mean, MapTexel one) {
  mean.column += 0.25f * one.column;
  mean.face += 0.25f * one.face;
}

// The mean of the four texels of a level, `size` along an edge from row `first`, that texel `block`
// of the next covers; those of the lowest level are made.
MapTexel meanOf(MapFrame frame, uvec2 block, uint size, uint first) {
  MapTexel mean = MapTexel(vec4(0.0f), vec4(0.0f));
  for (uint corner = 0u; corner < 4u; ++corner) {
    uvec2 texel = 2u * block + uvec2(corner & 1u, corner >> 1u);
    uint row = first + texel.y * size + texel.x;
    if (FROM_LEVEL) {
      addTo(mean, fromLevel(row));
    } else {
      MapTexel one = fromTriangles(frame, texel, size);
      store(row, one);
      addTo(mean, one);
    }
  }
  return mean;
}

// slice.lightSize: texels along an edge of the level at hand; firstSlab: row its texels begin at;
// slabCount: rows of all levels, behind which the faces' begin. From triangles one level of means,
// from a level two, where there are so many.
void main() {
  uint size = slice.lightSize;
  uint next = size / 2u;
  uint first = slice.firstSlab;
  uint above = first + size * size;
  uvec2 at = gl_GlobalInvocationID.xy;
  float texel = surface.map.x;
  MapFrame frame = MapFrame(texel * surface.pixelX, texel * surface.pixelY, surface.depth);
  if (FROM_LEVEL && next > 1u) {
    uint last = next / 2u;
    if (at.x < last && at.y < last) {
      MapTexel mean = MapTexel(vec4(0.0f), vec4(0.0f));
      for (uint corner = 0u; corner < 4u; ++corner) {
        uvec2 block = 2u * at + uvec2(corner & 1u, corner >> 1u);
        MapTexel one = meanOf(frame, block, size, first);
        store(above + block.y * next + block.x, one);
        addTo(mean, one);
      }
      store(above + next * next + at.y * last + at.x, mean);
    }
  } else if (at.x < next && at.y < next) {
    store(above + at.y * next + at.x, meanOf(frame, at, size, first));
  }
}
