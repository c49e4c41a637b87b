// SPDX-License-Identifier: MIT
// What the rule for surface clouds (shaders/model/surface) makes of the reference's bodies: light
// maps with mipmaps from analytic geometry, then the model's text in double.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/body.hpp"
#include "tables/surface_source.hpp"

namespace welkin::test {

// A texel of a light map or of a level above: means over all of it.
struct LightTexel {
  double coverage = 0, through = 0, top = 0;
  reference::Point lit{}, shaded{};
  void add(const LightTexel& other, double weight);
};

class LightMap {
 public:
  LightMap(const reference::Body& body, size_t size);
  // From rows of a square of `half` to either side, a power of two of them.
  LightMap(std::vector<LightTexel> texels, double half);
  // Linear in place and level; nothing beyond the map.
  LightTexel at(double x, double y, double level) const;
  double texel() const { return texel_; }

 private:
  LightTexel linear(size_t level, double x, double y) const;
  std::vector<std::vector<LightTexel>> levels_;
  size_t size_;
  double half_;
  double texel_;
};

// What goes with a phase function other than the canonical one.
struct SurfaceCloud {
  // P of light scattered once, 1/sr, at 1 - cos.
  double (*phase)(double y) = nullptr;
  // Canonical depth per depth of the body.
  double scale = 1;
};

// Radiance along a ray per unit irradiance.
double surfaceRadiance(const reference::Body& body, const LightMap& map,
                       const SurfaceSource& source, const reference::BodyRay& ray,
                       const SurfaceCloud& cloud);

// A row of tests/unit/surface_truth.csv.
struct SurfaceTruth {
  std::string body;
  int angle, x, y;
  double radiance, error;
};
std::vector<SurfaceTruth> readSurfaceTruth(const std::string& file);

struct SurfaceError {
  std::string body;
  int angle;
  double total;  // ratio to the truth
  double rms;    // of the difference over that of the truth, its noise taken off
};
// Pixels are means of 4 x 4 rays.
std::vector<SurfaceError> surfaceErrors(const std::vector<SurfaceTruth>& truth,
                                        const SurfaceCloud& cloud);

}  // namespace welkin::test
