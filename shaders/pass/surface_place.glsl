// SPDX-License-Identifier: MIT
// Points in a surface's light maps. Before: surface_mesh.glsl, surface_light.glsl, the map along
// the light as `depths`.

// Where a point lies in a light map: the first of four texels around it and the part of the way to
// the next ones; and its depth along the light, m.
struct MapPlace {
  ivec2 first;
  vec2 part;
  float depth;
};

MapPlace mapPlace(vec4 x, vec4 y, vec4 z, vec4 map, vec3 p) {
  vec4 q = vec4(p, 1.0f);
  vec2 texel = clamp(vec2(dot(x, q), dot(y, q)) * map.z - 0.5f, vec2(0.0f), vec2(map.z - 1.001f));
  vec2 low = floor(texel);
  MapPlace place;
  place.first = ivec2(low);
  place.part = texel - low;
  place.depth = dot(z, q);
  return place;
}

// Metres of cloud between the light and a point from what four texels show: between their middles
// linear, where they show the cloud.
float shadeOf(MapPlace place, sampler2D map) {
  vec4 a = texelFetch(map, place.first, 0);
  vec4 b = texelFetch(map, place.first + ivec2(1, 0), 0);
  vec4 c = texelFetch(map, place.first + ivec2(0, 1), 0);
  vec4 d = texelFetch(map, place.first + ivec2(1, 1), 0);
  vec4 covered = step(vec4(1.0e-20f), vec4(a.w, b.w, c.w, d.w));
  vec2 u = vec2(1.0f - place.part.x, place.part.x);
  vec4 weight = covered * vec4(u * (1.0f - place.part.y), u * place.part.y);
  float weights = weight.x + weight.y + weight.z + weight.w;
  vec4 mean = (weight.x * a + weight.y * b + weight.z * c + weight.w * d) / max(weights, 1.0e-20f);
  float near = place.depth - mean.x;
  float far = max(mean.w - (mean.z - place.depth), mean.y - mean.x);
  float before = place.depth <= mean.y ? near : far;
  return weights > 1.0e-6f ? clamp(before, 0.0f, mean.w) : 0.0f;
}

float shadeAt(vec3 p) {
  MapPlace place = mapPlace(surface.lightX, surface.lightY, surface.lightZ, surface.map, p);
  return shadeOf(place, depths);
}

// The way to the eye in a light map's frame, z towards the light.
vec3 eyeInMap(vec4 x, vec4 y, vec4 z, vec4 map, vec3 direction) {
  float scale = map.x * map.z;
  return vec3(-dot(x.xyz, direction) * scale, -dot(y.xyz, direction) * scale,
              dot(z.xyz, direction));
}

SurfaceMap mapOf(vec4 row) {
  SurfaceMap map;
  map.texel = row.x;
  map.levels = row.y;
  map.extinction = surface.optics.z;
  return map;
}
