// SPDX-License-Identifier: MIT
// Points in a surface's light maps. Before: surface_mesh.glsl, surface_light.glsl, the map along
// the light as the image `depths`, whose texels cost drivers such as lavapipe less as loads than as
// fetches.

// Where a point lies in a light map: the first of four texels around it and the part of the way to
// the next ones; and its depth along the light, m.
struct MapPlace {
  ivec2 first;
  vec2 part;
  float depth;
};

// Along a ray from the eye: texels and depth of the eye and per metre, and the last texel.
struct MapRay {
  vec3 origin;
  vec3 slope;
  float last;
};

MapRay mapRay(vec4 x, vec4 y, vec4 z, vec4 map, vec3 direction) {
  MapRay ray;
  ray.origin = vec3(x.w * map.z - 0.5f, y.w * map.z - 0.5f, z.w);
  ray.slope = vec3(dot(x.xyz, direction) * map.z, dot(y.xyz, direction) * map.z,
                   dot(z.xyz, direction));
  ray.last = map.z - 1.001f;
  return ray;
}

MapPlace mapPlace(MapRay ray, float distance_) {
  vec3 at = ray.origin + distance_ * ray.slope;
  vec2 texel = clamp(at.xy, vec2(0.0f), vec2(ray.last));
  vec2 low = floor(texel);
  MapPlace place;
  place.first = ivec2(low);
  place.part = texel - low;
  place.depth = at.z;
  return place;
}

// Metres of cloud between the light and a point from what four texels show: between their middles
// linear, where they show the cloud.
float shadeOf(MapPlace place, vec4 a, vec4 b, vec4 c, vec4 d) {
  vec4 covered = step(vec4(1.0e-20f), vec4(a.w, b.w, c.w, d.w));
  vec2 u = vec2(1.0f - place.part.x, place.part.x);
  vec4 weight = covered * vec4(u * (1.0f - place.part.y), u * place.part.y);
  float weights = weight.x + weight.y + weight.z + weight.w;
  vec4 mean = (weight.x * a + weight.y * b + weight.z * c + weight.w * d) *
              (1.0f / max(weights, 1.0e-20f));
  float near = place.depth - mean.x;
  float far = max(mean.w - (mean.z - place.depth), mean.y - mean.x);
  float before = place.depth <= mean.y ? near : far;
  return weights > 1.0e-6f ? clamp(before, 0.0f, mean.w) : 0.0f;
}

MapRay lightRay(vec3 direction) {
  return mapRay(surface.lightX, surface.lightY, surface.lightZ, surface.map, direction);
}

float shadeAt(MapRay ray, float distance_) {
  MapPlace place = mapPlace(ray, distance_);
  return shadeOf(place, imageLoad(depths, place.first),
                 imageLoad(depths, place.first + ivec2(1, 0)),
                 imageLoad(depths, place.first + ivec2(0, 1)),
                 imageLoad(depths, place.first + ivec2(1, 1)));
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
