// SPDX-License-Identifier: MIT
const int MAX_LIGHTS = 2;

const int MAX_CASCADES = 4;

// A light that reaches the air.
struct LightUniforms {
  vec4 direction;   // to the light, angular radius
  vec4 irradiance;  // RGB outside the atmosphere; w: cosine of light and local up
  vec4 disk;        // mean RGB radiance of the disk; w: 1 - cos(angular radius)
  vec4 limb;        // RGB exponents of its limb darkening
  vec4 litFrom;     // direction to what lights it, phaseIntegral(); 0 if it shines itself
};

// One view's constants, as 16-byte rows: std140, std430 and C++ agree. Positions are relative to
// the eye, in m, in world orientation.
struct FrameUniforms {
  mat4 eyeFromNdc;      // (ndc x, ndc y, depth, 1) to homogeneous position relative to the eye
  vec4 viewport;        // width, height, 1/width, 1/height
  vec4 output_;         // sky depth value, pre-exposure, largest of the target, 1 with an input
  vec4 eye;             // local up at the eye, altitude of the eye
  LightUniforms lights[MAX_LIGHTS];  // volumes are lit by the first
  vec4 air;             // RGB scattering at sea level, scale height
  vec4 fog;             // extinction at base, base altitude, scale height, planet radius
  vec4 fogAlbedo;       // RGB; w: 1 / number of lights that the sky table has room for
  vec4 absorber;        // RGB absorption at the peak, altitude of the peak
  // RGB albedo; power of the volumes' transmittance by which they hide the disk more than that.
  vec4 ground;
  vec4 colorRed;        // rows of the matrix from wavelengths to the target's colours
  vec4 colorGreen;
  vec4 colorBlue;
  vec4 volumeRect;      // x0, y0, x1, y1: pixels any volume may cover
  // Light scattered more than once, see src/tables/sky_field.hpp.
  // Highest altitude of the moments, share of their nodes in the fog, 0 to leave them out, 1 if the
  // table holds all light.
  vec4 skyLight;
  // Cosines of the horizon and of the table's upper end, scale height of the moments' fog, half
  // width of the absorber.
  vec4 skyView;
  vec4 eyeFog;          // fog without the eye's part of its peak: albedo RGB, extinction
  // Of the fog's table: vertical optical depth, 1 / log(1 + that), asymmetry of the lobe; scale of
  // the phase function.
  vec4 fogTable;
  // Part of the fog's extinction that sunlight on its way to the ground sees where the moments hold
  // the rest; w: zeniths above the horizon of the sky table.
  vec4 skyZeniths;
  vec4 fogBound;        // largest value of the phase function without the peak, RGB, 1/sr
  // Of the map of volumes' shadow: u, v in [0, 1] and distance d along the light (m), as
  // dot((position, 1), row); least d of a volume.
  vec4 shadow[3];
  // Least d of a volume; cascades of the engine's map; distance of the nearest volume; cosine
  // of the light's zenith angle where what volumes scatter goes on behind them, else 0.
  vec4 shadowRange;
  // Of each cascade: u, v and depth from the light on, in [0, 1], as dot((position, 1), row).
  vec4 cascade[3 * MAX_CASCADES];
  // What turns the map's value into that depth: factor, summand; bias as depth.
  vec4 cascadeDepth[MAX_CASCADES];
  // Of froxels, which the viewport counts then: distance of the last slice (m), exponent, 1 over
  // the slices less one.
  vec4 froxels;
  // First and last slice in which volumes are marched; 1 where their images, or that of the
  // volumes' distance, have half floats; 1 where the bare planet is drawn.
  vec4 froxelRange;
};
