// SPDX-License-Identifier: MIT
// One view's constants, as 16-byte rows: std140, std430 and C++ agree. Positions are relative to
// the eye, in m, in world orientation.
struct FrameUniforms {
  mat4 eyeFromNdc;      // (ndc x, ndc y, depth, 1) to homogeneous position relative to the eye
  vec4 viewport;        // width, height, 1/width, 1/height
  vec4 output_;         // sky depth value, pre-exposure, largest of the target, 1 with an input
  vec4 eye;             // local up at the eye, altitude of the eye
  vec4 light;           // direction to the light, angular radius
  vec4 lightIrradiance; // RGB outside the atmosphere; w: cosine of light and local up
  vec4 lightDisk;       // RGB radiance of the disk; w: 1 - cos(angular radius)
  vec4 air;             // RGB scattering at sea level, scale height
  vec4 fog;             // extinction at base, base altitude, scale height, planet radius
  vec4 fogAlbedo;       // RGB
  vec4 ground;          // RGB albedo
  vec4 volumeRect;      // x0, y0, x1, y1: pixels any volume may cover
  // Light scattered more than once, see src/tables/sky_field.hpp.
  // Highest altitude of the moments, share of their nodes in the fog, 0 to leave them out, 1 if the
  // table holds all light.
  vec4 skyLight;
  // Cosines of the horizon and of the table's upper end, scale height of the moments' fog.
  vec4 skyView;
  vec4 eyeFog;          // fog without the eye's part of its peak: albedo RGB, extinction
  vec4 fogFirst;        // 3 times its first moment, RGB; scale of the phase function
  vec4 fogSecond;       // 5/2 of its second moment, RGB
  vec4 fogBound;        // largest value of the phase function without the peak, RGB, 1/sr
};
