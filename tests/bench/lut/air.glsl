// SPDX-License-Identifier: MIT
// Shared by the passes of the sky that game engines have in common, for comparison only:
// S. Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique (EGSR).
// Air of one species that only scatters, around a sphere; the eye is above its sea-level point.
// Lengths in m, radiance in irradiance of the light per sr. Altitudes are kept, not radii: sums of
// radii in single precision lose half a metre.

// Where in a step the air is sampled: 0.3 as published, or 0.5.
layout(constant_id = 0) const float SAMPLE_AT = 0.3f;

layout(set = 0, binding = 0, std140) uniform Scene {
  vec4 right;       // the camera's axes, right and up times half the picture at distance 1
  vec4 up;
  vec4 forward;     // w: near plane
  vec4 size;        // width, height, 1/width, 1/height
  vec4 light;       // unit vector towards it; w: farthest froxel
  vec4 irradiance;  // w: planet radius
  vec4 scattering;  // at sea level, 1/m; w: scale height
  vec4 ground;      // albedo; w: altitude of the eye
  vec4 horizon;     // angle of the horizon from the zenith, and from the nadir; zw: of the light's
                    // direction over the ground, unit vector
} scene;

const vec2 TRANSMITTANCE_SIZE = vec2(256.0f, 64.0f);
const vec2 SCATTERING_SIZE = vec2(32.0f, 32.0f);
const vec2 SKY_SIZE = vec2(192.0f, 108.0f);
const float FROXELS = 32.0f;
const float TOP = 1e5f;  // of the air
const float PI = 3.14159265f;

layout(set = 0, binding = 1) uniform sampler2D transmittanceTable;
layout(set = 0, binding = 2) uniform sampler2D scatteringTable;

float planetRadius() {
  return scene.irradiance.w;
}

// Tables keep their ends in the middle of their outer texels.
vec2 fromTexel(uvec2 texel, vec2 size) {
  return vec2(texel) / (size - 1.0f);
}
vec2 toTexture(vec2 unit, vec2 size) {
  return (unit * (size - 1.0f) + 0.5f) / size;
}

// Radius squared less that of the ground squared.
float power(float altitude) {
  return altitude * (2.0f * planetRadius() + altitude);
}

float altitudeAfter(float altitude, float mu, float t) {
  float radius = planetRadius();
  float q = t * (2.0f * (radius + altitude) * mu + t) + power(altitude);
  return max(q / (sqrt(radius * radius + q) + radius), 0.0f);
}

// Cosine of a fixed direction with the up at a point t further on; `along` its cosine with the ray.
float cosineAfter(float altitude, float cosine, float t, float along, float there) {
  float radius = planetRadius();
  return clamp(((radius + altitude) * cosine + t * along) / (radius + there), -1.0f, 1.0f);
}

float topDistance(float altitude, float mu) {
  float b = (planetRadius() + altitude) * mu;
  float rise = (TOP - altitude) * (2.0f * planetRadius() + TOP + altitude);
  float root = sqrt(b * b + rise);
  return mu > 0.0f ? rise / (root + b) : root - b;
}

// Negative if the ray passes.
float groundDistance(float altitude, float mu) {
  float b = (planetRadius() + altitude) * mu;
  float inside = b * b - power(altitude);
  return mu < 0.0f && inside >= 0.0f ? power(altitude) / (sqrt(inside) - b) : -1.0f;
}

vec3 extinctionAt(float altitude) {
  return scene.scattering.xyz * exp(-altitude / scene.scattering.w);
}

// The mapping of the transmittance table: distance to the top between its least and its most,
// distance of the horizon.
vec2 transmittanceUnit(float altitude, float mu) {
  float rho = sqrt(power(altitude));
  float most = sqrt(power(TOP));
  float least = TOP - altitude;
  return vec2((topDistance(altitude, mu) - least) / (rho + most - least), rho / most);
}

// What is left of the light; none behind the planet.
vec3 lightAt(float altitude, float lightMu) {
  vec2 at = toTexture(transmittanceUnit(altitude, lightMu), TRANSMITTANCE_SIZE);
  float visible = groundDistance(altitude, lightMu) < 0.0f ? 1.0f : 0.0f;
  return textureLod(transmittanceTable, at, 0.0f).xyz * visible;
}

// Mean over all directions of the light that comes from scattering.
vec3 scatteredAt(float altitude, float lightMu) {
  vec2 at = toTexture(vec2(0.5f + 0.5f * lightMu, altitude / TOP), SCATTERING_SIZE);
  return textureLod(scatteringTable, at, 0.0f).xyz;
}

float rayleighPhase(float cosine) {
  return 3.0f / (16.0f * PI) * (1.0f + cosine * cosine);
}

// Light on its way to the eye, and what is left of it.
struct March {
  vec3 radiance;
  vec3 throughput;
};

// One step of a ray: constant air and light, the step's own extinction integrated.
March marchStep(March march, float altitude, float lightMu, float phase, float length) {
  vec3 left = exp(-extinctionAt(altitude) * length);
  vec3 source = lightAt(altitude, lightMu) * phase + scatteredAt(altitude, lightMu);
  march.radiance += march.throughput * (1.0f - left) * source;
  march.throughput *= left;
  return march;
}
