// SPDX-License-Identifier: MIT
// Clouds bounded by meshes before a camera, and what is true of their pictures: radiance in 1/sr
// per unit irradiance normal to the sun's beam. Nothing but the body scatters, by the phase
// function of the canonical cloud; it absorbs nothing; around it is black. Made by
// welkin_surface_view_truth, which says how.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reference/mesh_body.hpp"
#include "reference/phase_function.hpp"

namespace bench {

struct BodyMesh {
  std::vector<float> positions;   // x, y, z of each, m, the world's y up
  std::vector<uint32_t> indices;  // three for each triangle
};

struct SurfaceView {
  std::string name;  // of the body, "-", of the sun: front is behind the eye
  std::string body;
  double extinction = 0;  // 1/m
  welkin::reference::Point eye{};
  welkin::reference::Point target{};
  double verticalFov_deg = 0;
  int width = 0;
  int height = 0;
  welkin::reference::Point sun{};  // towards it
};
std::vector<SurfaceView> surfaceViews();
// Unit vector from the eye through a place in the picture, in pixels, rows downwards.
welkin::reference::Point pixelWay(const SurfaceView& view, double x, double y);
BodyMesh bodyMesh(const std::string& body);
welkin::reference::MeshBody referenceBody(const BodyMesh& mesh);

// Of the canonical cloud: angles in rad, 1/sr.
struct CanonicalCurve {
  std::vector<double> angle;
  std::vector<double> value;
};
CanonicalCurve canonicalCurve();

// Means over a pixel's area with their standard errors. Pixel (0, 0) is the upper left one.
struct SurfacePixel {
  int x = 0, y = 0;
  double once = 0, onceError = 0;  // light scattered once
  double rest = 0, restError = 0;  // all other
  double opacity = 0;
  double facing = 0;  // cosine between the sun and the normal where the eye's ray enters
};
struct SurfaceTruthImage {
  uint64_t paths = 0;  // per pixel
  // Of the mesh that was traced: another one is another truth.
  double volume_m3 = 0;
  size_t triangles = 0;
  std::vector<SurfacePixel> pixels;  // those that see the body
};
// One pixel of `every`.
SurfaceTruthImage traceView(const SurfaceView& view, const BodyMesh& mesh, uint64_t paths,
                            uint64_t seed, unsigned threads, int every = 1);

// Silhouette: less than opaque or partly beside the body. Elsewhere by the sign of `facing`.
enum class SurfaceRegion { LIT, SHADOW, SILHOUETTE };
constexpr double SILHOUETTE_OPACITY = 0.9;
SurfaceRegion regionOf(const SurfacePixel& pixel);

// A comment line, a header, rows. These throw std::runtime_error.
void writeSurfaceTruth(const std::string& file, const SurfaceTruthImage& image);
SurfaceTruthImage readSurfaceTruth(const std::string& file);

}  // namespace bench
