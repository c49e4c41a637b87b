// SPDX-License-Identifier: MIT
// Clouds, camera, light and truth of welkin_volume_cost, single scattering of light of
// irradiance 1. Lengths in m relative to the eye, which looks along -z with y up; the picture is
// square.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/vec.hpp"

namespace bench {

using host::Vec3;

constexpr int CLOUD_VOXELS = 128;
constexpr int CLOUD_BRICK = 16;       // voxels along a brick's edge
constexpr double CLOUD_EDGE = 640.0;  // m
constexpr double CLOUD_DISTANCE = 1500.0;
constexpr double CLOUD_EXTINCTION = 0.0125;  // 1/m at value 1
constexpr double CLOUD_G = 0.6;
constexpr double CLOUD_TANGENT = 0.27;  // of half the field of view: the cloud fills the picture

// Values of the cloud at multiples of 1/1024 in [0, 1], which half precision holds exactly.
struct Cloud {
  std::vector<float> values;  // x fastest
  std::vector<uint16_t> halves;
  double occupied;   // part of the bricks that hold a value above 0
  double meanDepth;  // optical depth across the box, along z
};
// A field that is 0 on the box's faces only if `occupied` is 1, else the bricks with most of it.
Cloud makeCloud(double occupied);

struct VolumeCase {
  std::string name;
  double occupied;
  double light_deg;  // between the light's direction and that of the view
};
std::vector<VolumeCase> volumeCases();
// Towards the light.
Vec3 cloudLight(double degrees);

// Unit box to positions relative to the eye: edge times box plus this.
Vec3 cloudCorner();
Vec3 cloudRay(double x, double y, uint32_t size);  // unit, through (x, y) in pixels

struct CloudTruth {
  std::vector<std::array<uint32_t, 2>> pixels;
  std::vector<double> radiance;
  double mean;
};
// By quadrature with tests/reference, of `edge` x `edge` pixels spread irregularly.
CloudTruth cloudTruth(const Cloud& cloud, const Vec3& toLight, uint32_t size, uint32_t edge);
// Root mean square over the pixels, over the mean. `picture`: RGBA, of which red counts.
double cloudError(const CloudTruth& truth, const std::vector<float>& picture, uint32_t size);
double cloudBias(const CloudTruth& truth, const std::vector<float>& picture, uint32_t size);

// Planes across an axis: coordinate dot(position, axis) / thickness + offset counts slabs, 0 to
// `count` across the box. Light buffer: u = dot(position, u) + uAt in [0, 1], so is v.
struct CloudSlabs {
  Vec3 axis;
  double thickness;
  double offset;
  double lightPath;  // of the light through a slab, m
  Vec3 u;
  Vec3 v;
  double uAt;
  double vAt;
};
CloudSlabs cloudSlabs(const Vec3& axis, const Vec3& toLight, uint32_t count, uint32_t lightSize);

// Step of the library's eye pass in slabs, which fixes how many samples a ray has.
constexpr double EYE_STEP = 0.5;
// Samples in the box of all rays, when slabs lie across the light: stretches between multiples of
// the step from the box's middle.
uint64_t eyeSamples(const Vec3& toLight, uint32_t size, uint32_t slices);

}  // namespace bench
