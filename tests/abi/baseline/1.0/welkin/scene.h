/* SPDX-License-Identifier: MIT
 *
 * Planet, air, lights, fog, media and volumes. Part of welkin.h, which states the conventions.
 */
#ifndef WELKIN_SCENE_H
#define WELKIN_SCENE_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Where altitude is measured. Altitude 0 is the sphere through seaLevelPoint. */
typedef struct WlkPlanet {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** A world point at sea level. m, |x| <= 1e9. Default (0, 0, 0). */
  double seaLevelPoint[3];
  /** Unit vector away from the planet's centre at that point. Default (0, 1, 0). */
  float up[3];
  /** Radius of the sea-level sphere. m, [1e4, 1e9], default 6.371e6. */
  float radius;
  /** Lambertian reflectance of the bare planet, seen where the engine drew nothing. RGB, [0, 1],
   *  default 0.1. */
  float groundAlbedo[3];
  uint32_t reserved0;
} WlkPlanet;

/** Sets the planet; null restores the defaults. [C] Errors: INVALID_ARGUMENT (seaLevelPoint, up,
 * radius, groundAlbedo). */
WLK_API WlkResult wlkSetPlanet(WlkContext context, const WlkPlanet* planet);

/** Air molecules: sky light, aerial perspective, reddening of the sun. [R04] 4.1. */
typedef struct WlkSky {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Scattering coefficient at sea level. RGB, 1/m, [0, 1], default 5.8e-6, 1.35e-5, 3.31e-5
   *  ([R04] Table 3). */
  float rayleighScattering[3];
  /** Altitude over which the density falls by e. m, [100, 1e5], default 8000 ([R04] 4.1.1). */
  float scaleHeight;
} WlkSky;

/** Sets the air; null means none. Coming or going needs wlkPrepare. [C] Errors: INVALID_ARGUMENT
 *  (rayleighScattering, scaleHeight). */
WLK_API WlkResult wlkSetSky(WlkContext context, const WlkSky* sky);

/** A gas that absorbs and does not scatter: ozone. A part of the air: it is nothing without
 *  wlkSetSky. Its density rises linearly with altitude to a peak and falls linearly to 0 above it,
 *  as far as below. */
typedef struct WlkAbsorber {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Absorption coefficient at peakAltitude. RGB, 1/m, [0, 1], default 2.7e-6, 1.7e-6, 8.5e-8: 300
   *  Dobson units of ozone as the eye sees them. Ozone absorbs most at 600 nm, between the
   *  wavelengths; at 680, 550 and 440 nm alone it is 6.5e-7, 1.881e-6, 8.5e-8, with which twilight
   *  is green (docs/accuracy-and-performance.md, Colour). Times halfWidth, it is the vertical
   *  optical depth where the whole profile is above the ground. */
  float absorption[3];
  /** Altitude of the densest part. m, [0, 1e5], default 25000. */
  float peakAltitude;
  /** From the peak to where the density is 0, up and down. m, [100, 1e5], default 15000. */
  float halfWidth;
  uint32_t reserved0;
} WlkAbsorber;

/** Sets the absorbing gas; null means none. Coming or going needs wlkPrepare. [C] Errors:
 *  INVALID_ARGUMENT (absorption, peakAltitude, halfWidth). */
WLK_API WlkResult wlkSetAbsorber(WlkContext context, const WlkAbsorber* absorber);

/** A directional light with a disk: the sun, or a moon (wlkInitMoon). */
typedef struct WlkLight {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Unit vector towards the light. Default (0, 1, 0). */
  float direction[3];
  /** Full angle of the disk. rad, [0, 0.2], default 0.00930 (the sun, 0.533 degrees).
   *  0: no disk. */
  float angularDiameter;
  /** Irradiance on a surface facing the light, outside the atmosphere, in any unit: radiance has it
   *  per steradian. RGB, linear, [0, 1e6], default 1. */
  float irradiance[3];
  uint32_t reserved0;
  /** Exponent a of the disk's brightness mu^a, mu being the cosine between the surface's normal and
   *  the line of sight (Hestroffer and Magnan 1998). RGB, [0, 2], default 0: uniform. The
   *  Sun: 0.36, 0.47, 0.62. */
  float limbDarkening[3];
  /** Unit vector towards what lights the body (for a moon: the Sun); the disk shows its phase.
   *  `irradiance` is the light of that phase. Default (0, 0, 0): it shines by
   *  itself. */
  float litFrom[3];
} WlkLight;

/** Fills a light with the Earth's moon as seen from the Earth: direction, disk, phase, and the
 *  irradiance that it reflects, 2.5e-6 of the sun's when full (Allen 1973, colour of Kieffer and
 *  Stone 2005; without the surge within 2 degrees of full moon). `toSun` and `toMoon` are unit
 *  vectors, `sunIrradiance` is that of the sun's light (RGB, [0, 1e6]). `moon` must have sType and
 *  structSize set. [F]
 *  Errors: INVALID_ARGUMENT (toSun, toMoon, sunIrradiance, moon), UNKNOWN_STRUCT. */
WLK_API WlkResult wlkInitMoon(const float toSun[3], const float toMoon[3],
                              const float sunIrradiance[3], WlkLight* moon);

/** Replaces all lights: sun and moon, or two suns. Those below every horizon are left out of the
 *  frame; volumes, and the air in front of them, are lit by one of the others: the one that is
 *  brightest there, twilight included. Two lights instead of one or none, or the other way round,
 *  and a disk that is not uniform where all were, need wlkPrepare. `stride` is the distance between
 *  elements in bytes. count 0: no light.
 *  [C] Errors: LIMIT_EXCEEDED over WlkCapabilities::maxLights. */
WLK_API WlkResult wlkSetLights(WlkContext context, uint32_t count, uint32_t stride,
                               const WlkLight* lights);

/** Values of wlkEvalAmbient: 9 coefficients of 3 colours. */
#define WLK_AMBIENT_VALUES 27

/** Where the light comes from that falls on volumes from everywhere but the lights themselves. */
enum {
  /** There is none: what no light reaches is black. */
  WLK_AMBIENT_OFF = 0,
  /** From the context's own sky and ground, as wlkEvalSkyMap has them at the middle of each volume:
   *  air, fog, all lights, all orders of scattering. For views that show the sky or the fog. */
  WLK_AMBIENT_AUTOMATIC = 1,
  /** From the engine: the fields of WlkAmbient. */
  WLK_AMBIENT_GIVEN = 2
};

/** Light of sky and ground on volumes. It is followed through each volume from all directions, so
 *  that what is hidden from the sky is dark, on a grid of cells half as fine as
 *  WlkQuality::volumeCells says: with WLK_SCATTERING_ALL_ORDERS and FORWARD through all orders of
 *  scattering, with WLK_SCATTERING_SINGLE not at all. Volumes do not take it from each other or
 *  from the ground. */
typedef struct WlkAmbient {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_AMBIENT_*. Default AUTOMATIC, also for a context whose ambient light was never set. */
  uint32_t mode;
  uint32_t reserved0;
  /** Of GIVEN: radiance from all directions above the horizontal plane through the volume's middle,
   *  and below it. RGB, [0, 1e6], in the unit of the lights' irradiance per sr. Default 0. */
  float sky[3];
  float ground[3];
  /** Of GIVEN: radiance that is added to them, as harmonics in the order and the axes of
   *  wlkEvalAmbient; where their sum is negative, 0. [-1e6, 1e6]. Default 0. */
  float harmonics[WLK_AMBIENT_VALUES];
  uint32_t reserved1;
} WlkAmbient;

/** Sets the ambient light of volumes; null means the defaults, AUTOMATIC. From or to OFF, as to and
 *  from AUTOMATIC without air and fog, needs wlkPrepare. AUTOMATIC costs 4 ms of CPU time for each
 * volume in a frame before which planet, air, lights or the volume's place have changed. [C]
 * Errors: INVALID_ARGUMENT (mode, sky, ground, harmonics). */
WLK_API WlkResult wlkSetAmbient(WlkContext context, const WlkAmbient* ambient);

enum {
  /** The type's choice: TABLE where there is one. */
  WLK_PHASE_DEFAULT = 0,
  /** Closed form: HG + Draine of the droplet diameter ([J23] Eq. 2-7 and, below 5 um, the fits of
   *  its supplement). One function for red, green and blue; no bows, no glory. */
  WLK_PHASE_ANALYTIC = 1,
  /** Table per wavelength from Mie theory or ray-traced crystals. */
  WLK_PHASE_TABLE = 2
};

/** A layer of particles, water droplets unless `medium` says otherwise: fog, haze, dust. Extinction
 *  falls exponentially with altitude and is the same for all colours. */
typedef struct WlkFog {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Median droplet diameter. um, [0.1, 50], default 10. Without effect if `medium` is set. */
  float dropletDiameter_um;
  /** Extinction coefficient at baseAltitude. 1/m, [0, 10], default 0.002. */
  float extinction;
  /** Altitude of that value. m, [-1e4, 1e5], default 0. */
  float baseAltitude;
  /** Altitude over which the extinction falls by e. m, [1, 1e5], default 100. */
  float scaleHeight;
  /** Single-scattering albedo. RGB, [0, 1], default 1. */
  float singleScatteringAlbedo[3];
  /** WLK_PHASE_*. Default WLK_PHASE_DEFAULT: TABLE. Without effect if `medium` is set. */
  uint32_t phaseModel;
  /** Particles of the layer; id 0: droplets of dropletDiameter_um. Only the phase function is
   *  taken; singleScatteringAlbedo above is the layer's. It is copied: the medium may be destroyed
   *  afterwards, but setting it once more needs it. Where WlkMediumOptics::deltaFraction is not 0
   *  (rain, ice, snow), what goes straight on is taken off the extinction, as volumes do. Default
   *  id 0. */
  WlkMedium medium;
} WlkFog;

/** Sets the fog layer; null means none. Coming or going needs wlkPrepare. [C] Errors:
 *  INVALID_ARGUMENT, INVALID_HANDLE (medium). */
WLK_API WlkResult wlkSetFog(WlkContext context, const WlkFog* fog);

/** Kinds of particles; sizes are medians of number, log-normal with standard deviation `spread`. */
enum {
  /** Cloud droplets, [5, 50] um, default 20 ([R04] Table 2). */
  WLK_PARTICLE_CLOUD = 0,
  /** Fog droplets, [0.1, 50] um, default 10. */
  WLK_PARTICLE_FOG = 1,
  /** Wet haze, [0.1, 5] um, default 0.6. */
  WLK_PARTICLE_HAZE = 2,
  /** Rain drops, [100, 2000] um, default 2000 ([R04] Table 2). Light turned by less than 0.5
   *  degrees counts as unscattered (WlkMediumOptics::deltaFraction). */
  WLK_PARTICLE_RAIN = 3,
  /** Hexagonal ice columns (length 2.5 diameters) in random orientation, over 100 um.
   *  Diffraction and light through parallel faces count as unscattered. */
  WLK_PARTICLE_ICE_COLUMN = 4,
  /** Hexagonal ice plates (thickness a quarter of the diameter), the same. */
  WLK_PARTICLE_ICE_PLATE = 5,
  /** Snow: strongly rough crystals, the same. */
  WLK_PARTICLE_SNOW = 6,
  /** Air molecules: Rayleigh, [R04] Eq. 1. */
  WLK_PARTICLE_AIR = 7,
  /** Henyey-Greenstein, from asymmetry. */
  WLK_PARTICLE_HENYEY_GREENSTEIN = 8,
  /** A table of the caller's: userAngle and userPhase. */
  WLK_PARTICLE_USER = 9
};

/** Zero in diameter_um, spread and roughness means the type's default. */
typedef struct WlkMediumInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_PARTICLE_*. Default WLK_PARTICLE_CLOUD. */
  uint32_t particle;
  /** WLK_PHASE_*. ANALYTIC exists for CLOUD, FOG, HAZE, AIR and HENYEY_GREENSTEIN. Default
   *  WLK_PHASE_DEFAULT. */
  uint32_t phaseModel;
  /** Median diameter, for droplets and drops. um, 0 or the type's range. Default 0. */
  float diameter_um;
  /** Standard deviation of ln(diameter). CLOUD, FOG and HAZE: 0 or [0.05, 0.5], default 0.25
   *  ([J23] 1.1); other values than 0.25 need TABLE, and 0.2 to 10 s of computing here (longest
   *  for large droplets and wide spreads). RAIN: 0 or 0.25. */
  float spread;
  /** Standard deviation of the facets' tilt, a slope. ICE: [0, 0.2], default 0. SNOW: 0 or
   *  [0.3, 0.6], default 0.45. */
  float roughness;
  /** Mean cosine, for HENYEY_GREENSTEIN. [-0.999, 0.999], default 0.85. */
  float asymmetry;
  /** Single-scattering albedo. RGB, [0, 1], default 1. Where deltaFraction is not 0, volumes use
   *  the mean over the colours for what goes straight on: keep it grey there. */
  float singleScatteringAlbedo[3];
  /** One wavelength for all three channels; 0 means red 0.68, green 0.55 and blue 0.44. um, 0 or
   *  [0.4, 0.7]; other than 0 not for USER. Droplets below 0.44 and above 0.68 are computed as for
   *  another spread. Default 0. */
  float wavelength_um;
  /** For USER: userCount scattering angles in rad, rising from 0 to pi, and 3 * userCount values,
   * RGB of each angle together, in any unit, [0, 1e30]. Between them ln P is interpolated, 0 being
   * 1e-20 of its neighbour; what is narrower than 0.1 degrees is averaged. Read during the call
   * only. Default null. */
  const double* userAngle;
  const double* userPhase;
  /** [2, 65536] for USER, else 0. Default 0. */
  uint32_t userCount;
  uint32_t reserved0;
} WlkMediumInfo;

/** Creates a medium; a spread of its own blocks the caller for 0.2 to 10 s (WlkMediumInfo::spread).
 * [C] Errors: INVALID_ARGUMENT, OUT_OF_HOST_MEMORY. */
WLK_API WlkResult wlkCreateMedium(WlkContext context, const WlkMediumInfo* info, WlkMedium* medium);
/** What was made with it keeps a copy. [C] Errors: INVALID_HANDLE. */
WLK_API WlkResult wlkDestroyMedium(WlkContext context, WlkMedium medium);

/** Atmospheres to start from; docs/atmospheres.md has numbers and sources. */
enum {
  /** The Earth on a clear day: 300 Dobson units of ozone, vertical optical depth of haze 0.05. */
  WLK_ATMOSPHERE_EARTH_CLEAR = 0,
  /** Summer haze: 0.25. */
  WLK_ATMOSPHERE_EARTH_HAZY = 1,
  /** A polluted city: 0.7, of particles that absorb. */
  WLK_ATMOSPHERE_EARTH_POLLUTED = 2,
  /** Thin carbon dioxide and dust of vertical optical depth 0.5. */
  WLK_ATMOSPHERE_MARS = 3
};

/** As wlkInitStruct, with the values of an atmosphere (WLK_ATMOSPHERE_*) instead of the defaults.
 * It consists of WLK_STRUCT_PLANET, SKY, ABSORBER (absorption 0 where there is no such gas), FOG
 * (its haze or dust; `medium` is 0: create the next and set it), MEDIUM_INFO (what the haze is) and
 * LIGHT (the sun as seen from there, straight up; `irradiance` is relative to that at the Earth, 1
 * there: multiply it by the engine's own value). The caller changes what it wants and sets what it
 * needs. [F] Errors: INVALID_ARGUMENT (preset; null, structSize too short), UNKNOWN_STRUCT (another
 *  structure). */
WLK_API WlkResult wlkInitPresetStruct(uint32_t preset, uint32_t sType, uint32_t structSize,
                                      void* structure);

/** What one particle of a medium does to light. RGB. */
typedef struct WlkMediumOptics {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Extinction cross-section over mean geometric cross-section; 2 for large particles, 0 where
   *  there is no size (AIR, HENYEY_GREENSTEIN, USER). */
  float extinctionEfficiency[3];
  /** <r^3> / <r^2> of the sizes; 0 where there is no size. um. */
  float effectiveRadius_um;
  /** Mean extinction cross-section of one particle: the extinction coefficient is this times the
   *  number of particles per volume. m^2; 0 where there is no size. */
  double extinctionCrossSection[3];
  /** Mean cosine of the phase function. */
  float asymmetry[3];
  /** Part of the phase function within 90 degrees. */
  float forwardFraction[3];
  /** Part of the scattered light that goes straight on and is not in the phase function. Volumes
   *  take it off their extinction. */
  float deltaFraction[3];
  uint32_t reserved0;
} WlkMediumOptics;

/** Fills a medium's optics. [C] Errors: INVALID_HANDLE, INVALID_ARGUMENT. */
WLK_API WlkResult wlkGetMediumOptics(WlkContext context, WlkMedium medium, WlkMediumOptics* optics);

/** Formats of volume data. */
enum {
  WLK_FORMAT_R32_FLOAT = 1,
  WLK_FORMAT_R16_FLOAT = 2,
  /** Unsigned bytes, 255 meaning 1. */
  WLK_FORMAT_R8_UNORM = 3
};

/** One particle field of a volume. */
typedef struct WlkVolumeField {
  WlkMedium medium;
  /** Extinction coefficient at value 1, for all colours: extinction = value * extinctionScale.
   *  1/m, [0, 1e6]. */
  float extinctionScale;
  uint32_t reserved0;
} WlkVolumeField;

/** A box of voxels: how many, of what, and where. */
typedef struct WlkVolumeInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Voxels along x, y, z. [1, WlkCapabilities::maxVolumeSize] each. Default 1. */
  uint32_t size[3];
  /** [1, WLK_MAX_FIELDS], default 0. */
  uint32_t fieldCount;
  /** sizeof(WlkVolumeField) of the caller. Default that. */
  uint32_t fieldStride;
  uint32_t reserved0;
  /** fieldCount elements. Default null. */
  const WlkVolumeField* fields;
  /** Row-major 3x4: world = M * (x, y, z, 1), where the volume is the unit box [0, 1]^3 and voxel
   *  (i, j, k) has its centre at ((i+0.5)/size[0], (j+0.5)/size[1], (k+0.5)/size[2]). Elements
   *  |x| <= 1e9, edges of 1 mm and more, a volume of more than 1e-6 of the edges' product. Default
   *  identity. */
  double worldFromVolume[12];
} WlkVolumeInfo;

/** Creates a volume of value 0 everywhere; it needs wlkPrepare. Media are copied. [C] Errors:
 * INVALID_ARGUMENT, INVALID_HANDLE (medium), LIMIT_EXCEEDED, OUT_OF_*, WRONG_STATE in CPU mode. */
WLK_API WlkResult wlkCreateVolume(WlkContext context, const WlkVolumeInfo* info, WlkVolume* volume);
/** The memory is freed when no frame in flight uses it. [C] Errors: INVALID_HANDLE. */
WLK_API WlkResult wlkDestroyVolume(WlkContext context, WlkVolume volume);
/** Moves a volume; as WlkVolumeInfo::worldFromVolume. [C] Errors: INVALID_HANDLE, INVALID_ARGUMENT.
 */
WLK_API WlkResult wlkSetVolumeTransform(WlkContext context, WlkVolume volume,
                                        const double worldFromVolume[12]);

/** Values for a box of voxels of one field. Negative values, NaN and infinities become 0; values
 *  over 65504 become 65504. */
typedef struct WlkVolumeUpload {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Index of the field. Default 0. */
  uint32_t field;
  /** WLK_FORMAT_R32_FLOAT, R16_FLOAT or R8_UNORM. A field keeps half floats of what came as these
   *  two, until all of its voxels come as R32_FLOAT at once. Default R32_FLOAT. */
  uint32_t format;
  /** First voxel. Default 0. */
  uint32_t offset[3];
  /** Voxels along x, y, z, 1 or more; offset + extent <= size. Default 0, which is refused. */
  uint32_t extent[3];
  /** Bytes from one row (y) to the next; 0 means tight. Default 0. */
  uint64_t rowPitch;
  /** Bytes from one slice (z) to the next; 0 means tight rows. Default 0. */
  uint64_t slicePitch;
  /** x fastest. Read during the call only. Default null. */
  const void* data;
  /** Bytes at data; what the pitches reach must lie inside. Default 0. */
  uint64_t dataSize;
} WlkVolumeUpload;

/** Copies the data; the GPU copy is made by the next frame. A field that is kept as bricks takes
 *  only all of its voxels at once, is no longer kept so, and then needs wlkPrepare. Values that had
 *  to be replaced go to the log (WLK_LOG_ID_VALUES_REPLACED). [C] Errors: INVALID_ARGUMENT (field,
 *  extent, data, dataSize, rowPitch, slicePitch), UNSUPPORTED_FORMAT, OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkUploadVolume(WlkContext context, WlkVolume volume,
                                  const WlkVolumeUpload* upload);

/** Diameters of one field's droplets per voxel, median in um, linear in their logarithm between
 *  voxels: each sample of the eye's march then scatters towards the eye by its own phase function.
 *  Extinction and albedo stay the field's (wlkEvalWaterExtinction makes extinction of water and
 *  diameter). What light has scattered before keeps the medium's own diameter: give it the mean of
 *  the volume (where it was 2.5 times as large as all voxels', pictures of optical depth 8 were up
 *  to 6 % off with WLK_SCATTERING_FORWARD, 12 % with ALL_ORDERS). Values outside
 *  of the type's range become its nearest; 0, negative values, NaN and infinities the medium's own
 *  diameter. Needs all voxels at once, R32_FLOAT or R16_FLOAT, and a medium of cloud, fog, haze or
 *  rain with the default spread. Of one field per volume: another field's replace them. The first
 *  and those of another field need wlkPrepare, which makes 24 MiB of tables per volume and
 *  scattering mode. [C] Errors: INVALID_ARGUMENT, UNSUPPORTED_FORMAT, OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkUploadVolumeDiameters(WlkContext context, WlkVolume volume,
                                           const WlkVolumeUpload* diameters);
/** The volume's droplets have their medium's diameter again; needs wlkPrepare if there were
 *  others. [C] */
WLK_API WlkResult wlkClearVolumeDiameters(WlkContext context, WlkVolume volume);

/** Extinction (1/m, mean of the colours) of liquid water as droplets: 0.75 Q W / (density r),
 *  where W is waterContent (kg/m^3, [0, 1000]), r the effective radius and Q the extinction
 *  efficiency of diameter_um; values of these as in wlkUploadVolumeDiameters, null: the medium's
 *  own. The medium as there. Upload the result with an extinctionScale of 1. [C] Errors:
 * INVALID_HANDLE, INVALID_ARGUMENT (medium, waterContent, extinction). */
WLK_API WlkResult wlkEvalWaterExtinction(WlkContext context, WlkMedium medium, uint32_t count,
                                         const float* waterContent, const float* diameter_um,
                                         float* extinction);

/** All that one field holds, as bricks of 8 x 8 x 8 voxels; elsewhere it is 0. Brick (i, j, k) has
 *  the voxels 8 i to 8 i + 7 along x, and so on; voxels outside the volume are ignored. Values as
 *  in WlkVolumeUpload, kept as half floats: under 3e-8 they become 0. */
typedef struct WlkVolumeBricks {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Index of the field. Default 0. */
  uint32_t field;
  /** WLK_FORMAT_R32_FLOAT, R16_FLOAT or R8_UNORM. Default R32_FLOAT. */
  uint32_t format;
  /** Number of bricks, at most those of the volume. 0 empties the field. Default 0. */
  uint32_t count;
  uint32_t reserved0;
  /** i, j, k of each brick, 3 * count numbers, in any order and no brick twice. Default null. */
  const uint32_t* coordinates;
  /** 512 values of each brick, x fastest. Read during the call only. Default null. */
  const void* data;
  /** Bytes from one brick to the next; 0 means tight. Default 0. */
  uint64_t brickPitch;
  /** Bytes at data. Default 0. */
  uint64_t dataSize;
} WlkVolumeBricks;

/** Replaces what the field holds; memory and time grow with the bricks given, but for 5 bytes per
 *  brick of the whole volume. The GPU copy is made by the next frame. The first bricks of a field
 *  need wlkPrepare. [C] Errors: INVALID_ARGUMENT, UNSUPPORTED_FORMAT, LIMIT_EXCEEDED (more bricks
 *  than a 3D image of the device holds), OUT_OF_*; after an error the field is as before. */
WLK_API WlkResult wlkUploadVolumeBricks(WlkContext context, WlkVolume volume,
                                        const WlkVolumeBricks* bricks);

/** What a volume holds. Engines' images are not looked into, and not counted. */
typedef struct WlkVolumeState {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Bricks of 8 x 8 x 8 voxels along x, y, z. */
  uint32_t bricks[3];
  /** 1 where eye rays leap over empty bricks, else 0. wlkPrepare decides; the picture is the same.
   */
  uint32_t leaps;
  /** Bricks that hold a value above 0, those of all fields together. What is overwritten by parts
   *  of a brick counts as before. */
  uint64_t occupiedBricks;
  /** The same for fields kept as bricks, with those that only interpolation reaches. */
  uint64_t storedBricks;
  /** Bytes of the images on the device: voxels, bricks and where they are. */
  uint64_t deviceMemory;
  /** Bytes on the host, not in deviceMemory. */
  uint64_t hostMemory;
  /** Bytes of copies that wait for the next frame. */
  uint64_t pendingMemory;
} WlkVolumeState;

/** Fills `state`. [C] Errors: INVALID_ARGUMENT, INVALID_HANDLE, UNKNOWN_STRUCT. */
WLK_API WlkResult wlkGetVolumeState(WlkContext context, WlkVolume volume, WlkVolumeState* state);

#ifdef __cplusplus
}
#endif

#endif
