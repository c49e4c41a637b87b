// SPDX-License-Identifier: MIT
// True radiance of thick volumes, all orders, and the files that keep it: 1/sr per unit irradiance
// normal to the sun's beam. Nothing but the volume scatters; it absorbs nothing; around it is
// black. Made by welkin_volume_truth, which says how.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reference/phase_function.hpp"
#include "reference/vector.hpp"

namespace bench {

constexpr double TRUTH_G = 0.85;  // of the Henyey-Greenstein phase function

// Spheres of radius 1 and optical radius R: voxels hold the covered part, over a cube of edge
// SPHERE_BOX around 0 with axes along those of the world, extinction R. The sun stands in direction
// +z. The eye is at -SPHERE_DISTANCE (sin a, 0, cos a), looks at 0 and has +y up: a is the angle
// between view and sun, 180 degrees with the sun behind the eye. The picture's edges pass
// SPHERE_BOX / 2 from the centre: vertical field of view 2 atan(0.0125).
constexpr std::array<int, 3> SPHERE_RADII = {2, 10, 30};
constexpr std::array<int, 5> SPHERE_ANGLES = {180, 120, 90, 60, 20};  // degrees
constexpr int SPHERE_VOXELS = 64;                                     // along an edge
constexpr int SPHERE_SUBSAMPLES = 8;     // along a voxel's edge, in the middles of its parts
constexpr double SPHERE_BOX = 2.5;       // radii
constexpr double SPHERE_DISTANCE = 100;  // radii
constexpr int SPHERE_PIXELS = 32;        // along an edge

// Covered parts of the voxels, x fastest: multiples of 1/512.
std::vector<float> sphereVoxels();
// "sphere-10-180".
std::string sphereName(int opticalRadius, int angle_deg);

// A cloud before a camera, the world's y up. Sun where it stands: front is behind the eye.
struct CloudCase {
  std::string name;
  std::array<int, 3> voxels{};
  welkin::reference::Point min{};     // of the box, m
  welkin::reference::Point extent{};  // m
  welkin::reference::Point eye{};     // m
  welkin::reference::Point target{};
  double verticalFov_deg = 0;
  int width = 0;
  int height = 0;
  welkin::reference::Point sun{};  // towards it
  bool droplets = false;           // the phase function of DROPLET_FILE, or Henyey-Greenstein
};
// samples/scenes/cumulus-side.json with 96 x 72 x 96 voxels, without sky, and with the suns of
// cumulus-side, -front and -behind: "cumulus-front-hg", "cumulus-side-droplets", ...
std::vector<CloudCase> cumulusCases();
// The same suns for the cloud of samples/scenes/les-cloud.json, "les-back-hg".
std::vector<CloudCase> lesCases();
// The same cloud and camera, Henyey-Greenstein, light scattered once, with the sun at angles to the
// view: "les-single-10". A pixel is the mean of LES_SINGLE_RAYS^2 rays through its parts' middles.
constexpr std::array<double, 6> LES_SINGLE_ANGLES = {10, 45, 89.9, 90.1, 135, 170};  // degrees
constexpr int LES_SINGLE_RAYS = 4;
std::vector<CloudCase> lesSingleCases();

// Rows angle_deg,phase: `cloud` of 12 um at 0.55 um as the library has it, 1/sr; linear in
// 1 - cos between the angles.
constexpr const char* DROPLET_FILE = "cloud-12um-550nm.csv";
struct PhaseCurve {
  std::vector<double> angle;  // rad
  std::vector<double> value;
};
PhaseCurve readPhaseCurve(const std::string& file);

// Means over the pixels' areas and their standard errors; pixel (0, 0) is the upper left one.
// Pixels that mirror each other have one value and one error: those of a sphere's upper and lower
// half, and at 180 degrees all eight images.
struct TruthImage {
  uint64_t paths = 0;  // per pixel
  int width = 0;
  int height = 0;
  std::vector<double> radiance;
  std::vector<double> error;
  double mean() const;
};

TruthImage traceSphere(int opticalRadius, int angle_deg, uint64_t paths, uint64_t seed);
// extinction: 1/m, x fastest.
TruthImage traceCloud(const CloudCase& one, std::vector<float> extinction,
                      const welkin::reference::PhaseFunction& phase, uint64_t paths, uint64_t seed);

// "# paths N", then x,y,radiance,error. These throw std::runtime_error.
void writeTruthImage(const std::string& file, const TruthImage& image, int digits);
TruthImage readTruthImage(const std::string& file);

// A slab seen from outside. viewZenith is that of the light's direction of travel for reflected
// light, its nadir angle for transmitted; azimuth 0: it travels as the beam does. By discrete
// ordinates; some rows with Monte Carlo beside it.
struct SlabTruth {
  bool droplets = false;  // or Henyey-Greenstein
  double tau = 0;
  double sunZenith_deg = 0;
  bool reflected = false;
  double viewZenith_deg = 0;
  double azimuth_deg = 0;
  double radiance = 0;
  double single = 0;      // order 1
  double monteCarlo = 0;  // 0: not made
  double error = 0;       // its standard error
};
std::vector<SlabTruth> readSlabTruth(const std::string& file);

}  // namespace bench
