// SPDX-License-Identifier: MIT
#include "frame/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tables/surface_ambient.hpp"
#include "tables/surface_source.hpp"

namespace welkin {
namespace {

using interface_::SurfaceUniforms;

// Steps of depth: a chord of the sum of 2047 crossings fits 31 bits.
constexpr double STEPS = 1 << 20;
// Texels of the light map on each side in which nothing of the mesh lies.
constexpr double BORDER = 2;

glm::vec4 rowOf(const glm::dvec4& row) {
  return glm::vec4(row);
}

// The box's corners in the mesh's frame.
std::array<glm::dvec3, 8> cornersOf(const SurfaceState& s) {
  std::array<glm::dvec3, 8> corners;
  for (size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {i & 1 ? s.high[0] : s.low[0], i & 2 ? s.high[1] : s.low[1],
                  i & 4 ? s.high[2] : s.low[2]};
  }
  return corners;
}

glm::dmat4 full(const glm::dmat4x3& m) {
  return {glm::dvec4(m[0], 0), glm::dvec4(m[1], 0), glm::dvec4(m[2], 0), glm::dvec4(m[3], 1)};
}

glm::dvec4 rowOf(const glm::dmat4& m, int row) {
  return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

// The light's frame: two axes across it, a picture of which has its y downwards.
struct LightFrame {
  glm::dvec3 x, y, toLight;
};

LightFrame lightFrame(const glm::dvec3& toLight) {
  const glm::dvec3 a = std::abs(toLight.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(a, toLight));
  return {x, glm::cross(x, toLight), toLight};
}

// The square around the box along the light: its middle in the world relative to the mesh's origin,
// half its edge without and with the border, and half the depth.
struct LightSquare {
  LightFrame frame;
  glm::dvec3 middle;
  double half = 0;
  double depth = 0;
};

LightSquare lightSquare(const SurfaceState& s, const glm::dvec3& toLight, uint32_t size) {
  LightSquare square;
  square.frame = lightFrame(toLight);
  const glm::dmat3 linear(s.worldFromMesh);
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (const glm::dvec3& corner : cornersOf(s)) {
    const glm::dvec3 p = linear * corner;
    const glm::dvec3 q(glm::dot(p, square.frame.x), glm::dot(p, square.frame.y),
                       glm::dot(p, square.frame.toLight));
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  square.middle =
      middle.x * square.frame.x + middle.y * square.frame.y + middle.z * square.frame.toLight;
  const glm::dvec3 extent = 0.5 * (high - low);
  square.half = std::max(std::max(extent.x, extent.y) * size / (size - 2 * BORDER), 1e-30);
  square.depth = std::max(extent.z * 1.001, 1e-30);
  return square;
}

// Rows that take a position whose origin lies at `origin` (in the square's world) to texel place
// and depth.
void fillLightRows(const LightSquare& square, const glm::dvec3& origin, SurfaceUniforms& out) {
  const glm::dvec3 at = origin - square.middle;
  const double scale = 0.5 / square.half;
  out.lightX =
      rowOf(glm::dvec4(square.frame.x * scale, glm::dot(at, square.frame.x) * scale + 0.5));
  out.lightY =
      rowOf(glm::dvec4(square.frame.y * scale, glm::dot(at, square.frame.y) * scale + 0.5));
  out.lightZ =
      rowOf(glm::dvec4(-square.frame.toLight, square.depth - glm::dot(at, square.frame.toLight)));
}

void fillMap(const LightSquare& square, uint32_t size, SurfaceUniforms& out) {
  out.map = {static_cast<float>(2 * square.half / size),
             static_cast<float>(std::log2(static_cast<double>(size))), static_cast<float>(size),
             0.0f};
}

bool mirrors(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& depth) {
  return glm::determinant(glm::dmat3(glm::dvec3(x), glm::dvec3(y), glm::dvec3(depth))) < 0;
}

}  // namespace

glm::dmat4x3 SurfaceState::worldFromBox() const {
  const glm::dvec3 from(low[0], low[1], low[2]);
  const glm::dvec3 edge = glm::dvec3(high[0], high[1], high[2]) - from;
  const double longest = std::max({edge.x, edge.y, edge.z, 1e-6});
  glm::dmat4x3 box = worldFromMesh;
  for (int i = 0; i < 3; ++i) {
    box[i] *= std::max(edge[i], 1e-6 * longest);  // never flat, as an animated mesh may be
  }
  box[3] += glm::dmat3(worldFromMesh) * from;
  return box;
}

void fillTriangles(const SurfaceState& s, bool mirrored, SurfaceUniforms& out) {
  out.triangle = {s.triangles, mirrored ? 1U : 0U, 0, 0};
}

SurfaceTables makeSurfaceTables(vk::Device& device) {
  const CanonicalTable table = decodeCanonical(shippedCanonical());
  const SurfaceSource source = surfaceSource(table);
  SurfaceTables made;
  made.asymmetry = table.asymmetry;
  const auto stage = [&](const std::vector<float>& values) {
    vk::Buffer buffer(device, values.size() * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                      true);
    std::memcpy(buffer.data(), values.data(), values.size() * sizeof(float));
    return buffer;
  };
  const SurfaceSourceImage image = surfaceSourceImage(source);
  made.newSource = stage(image.values);
  made.newCurves = stage(image.logPhase);
  const SurfaceAmbient ambient = surfaceAmbient(source, table.asymmetry);
  made.newShare = stage(ambient.share);
  vk::ImageInfo info;
  info.format = VK_FORMAT_R32_SFLOAT;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.extent = {static_cast<uint32_t>(ambient.size[0]), static_cast<uint32_t>(ambient.size[1]), 1};
  made.share = vk::Image(device, info);
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  info.extent = {CANONICAL_ANGLES, CANONICAL_SETS / 4, 1};
  made.curves = vk::Image(device, info);
  info.type = VK_IMAGE_TYPE_3D;
  info.extent = {static_cast<uint32_t>(image.size[0]), static_cast<uint32_t>(image.size[1]),
                 static_cast<uint32_t>(image.size[2])};
  made.source = vk::Image(device, info);
  return made;
}

uint32_t surfaceMapSize(const SliceQuality& quality) {
  return quality.lightRoom <= 128 ? 128 : (quality.lightRoom <= 256 ? 256 : 512);
}

SurfaceLight makeSurfaceLight(vk::Device& device, uint32_t size, bool up) {
  vk::ImageInfo info;
  info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  info.extent = {size, size, 1};
  info.levels = static_cast<uint32_t>(std::lround(std::log2(size))) + 1;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  SurfaceLight light;
  light.size = size;
  light.up = up;
  light.columns = vk::Image(device, info);
  light.faces = vk::Image(device, info);
  info.levels = 1;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
  light.depths = vk::Image(device, info);
  return light;
}

SurfaceLight* findSurfaceLight(SurfaceState& surface, uint32_t size, bool up) {
  const auto found =
      std::find_if(surface.lights.begin(), surface.lights.end(),
                   [&](const SurfaceLight& light) { return light.size == size && light.up == up; });
  return found == surface.lights.end() ? nullptr : &*found;
}

void fillSurfaceLight(const SurfaceState& s, const glm::dvec3& toLight, uint32_t size,
                      SurfaceUniforms& out) {
  out = {};
  const LightSquare square = lightSquare(s, toLight, size);
  fillLightRows(square, glm::dvec3(0), out);
  fillMap(square, size, out);
  // Positions of the mesh instead.
  const glm::dmat4 mesh = full(glm::dmat4x3(glm::dmat3(s.worldFromMesh)));
  const auto compose = [&](const glm::vec4& row) {
    glm::dvec4 result(0);
    for (int i = 0; i < 4; ++i) {
      result[i] = glm::dot(glm::dvec3(glm::dvec4(row)), glm::dvec3(mesh[i])) +
                  (i == 3 ? static_cast<double>(row.w) : 0.0);
    }
    return result;
  };
  const glm::dvec4 half(0, 0, 0, 0.5);
  const glm::dvec4 x = compose(out.lightX) * double(size) - half;
  const glm::dvec4 y = compose(out.lightY) * double(size) - half;
  const glm::dvec4 depth = compose(out.lightZ);
  out.pixelX = rowOf(x);
  out.pixelY = rowOf(y);
  out.pixelW = {0, 0, 0, 1};
  out.depth = rowOf(depth);
  out.steps = {0, static_cast<float>(STEPS / (2 * square.depth)), static_cast<float>(STEPS),
               -1e30f};
  const int edge = static_cast<int>(size);
  out.rect = {0, 0, edge, edge};
  fillTriangles(s, mirrors(x, y, depth), out);
  const LightFrame& frame = square.frame;
  const double width = 2 * square.half;
  fillDetail(s, square.middle - square.half * (frame.x + frame.y) + square.depth * frame.toLight,
             {width * frame.x, width * frame.y, -frame.toLight}, width / size, out);
}

SurfaceLightKey surfaceLightKey(const SurfaceState& surface, const SurfaceUniforms& uniforms) {
  SurfaceLightKey key;
  const std::array rows{uniforms.pixelX, uniforms.pixelY,      uniforms.depth,      uniforms.steps,
                        uniforms.map,    uniforms.detail,      uniforms.cellX,      uniforms.cellY,
                        uniforms.cellZ,  uniforms.detailScale, uniforms.detailShift};
  static_assert(sizeof rows == sizeof key.rows);
  std::memcpy(key.rows.data(), rows.data(), sizeof rows);
  key.version = surface.version;
  return key;
}

void fillSurfaceView(const SurfaceState& s, const PlannedVolume& planned, const SurfaceEye& view,
                     const glm::dvec3& toLight, uint32_t size, const PixelRect& shade,
                     SurfaceUniforms& out) {
  out = {};
  glm::dmat4x3 eyeFromMesh = s.worldFromMesh;
  eyeFromMesh[3] -= view.eye;
  const glm::dmat4 clip = view.clipFromEye * full(eyeFromMesh);
  const glm::dvec4 w = rowOf(clip, 3);
  const glm::dvec4 half(0.5);
  const glm::dvec4 x = (rowOf(clip, 0) * half + w * half) * double(view.width) - w * half;
  const glm::dvec4 y = (rowOf(clip, 1) * half + w * half) * double(view.height) - w * half;
  // The view's axis is where clip-space w grows, which the eye is the origin of.
  const glm::dvec3 axis = glm::normalize(glm::dvec3(rowOf(view.clipFromEye, 3)));
  glm::dvec4 depth(0);
  for (int i = 0; i < 4; ++i) {
    depth[i] = glm::dot(axis, eyeFromMesh[i]);
  }
  double nearest = 1e300;
  double farthest = 0;
  for (const glm::dvec3& corner : cornersOf(s)) {
    const double at = glm::dot(depth, glm::dvec4(corner, 1));
    nearest = std::min(nearest, at);
    farthest = std::max(farthest, at);
  }
  const double first = std::max(nearest, 0.0) * 0.9999;
  const double range = std::max(farthest * 1.0001 - first, 1e-30);
  out.pixelX = rowOf(x);
  out.pixelY = rowOf(y);
  out.pixelW = rowOf(w);
  out.depth = rowOf(depth);
  out.steps = {static_cast<float>(first), static_cast<float>(STEPS / range),
               static_cast<float>(STEPS), 0.0f};
  const auto rect = [](const PixelRect& r) {
    return glm::ivec4(static_cast<int>(r.x0), static_cast<int>(r.y0), static_cast<int>(r.x1),
                      static_cast<int>(r.y1));
  };
  out.rect = rect(planned.rect);
  out.shade = rect(shade);
  out.axis = glm::vec4(glm::vec3(axis), 0.0f);
  fillTriangles(s, mirrors(x, y, w), out);
  const LightSquare square = lightSquare(s, toLight, size);
  // The origin of positions relative to the eye is the eye, the square's the mesh's own.
  const glm::dvec3 eye = view.eye - glm::dvec3(s.worldFromMesh[3]);
  SurfaceUniforms above{};
  const LightSquare vertical = lightSquare(s, s.ambient.up, size);
  fillLightRows(vertical, eye, above);
  fillMap(vertical, size, above);
  out.upX = above.lightX;
  out.upY = above.lightY;
  out.upZ = above.lightZ;
  out.upMap = above.map;
  out.sky = glm::vec4(glm::vec3(s.ambient.sky), 0.0f);
  out.ground = glm::vec4(glm::vec3(s.ambient.ground), 0.0f);
  fillLightRows(square, eye, out);
  fillMap(square, size, out);
  out.optics = {static_cast<float>(s.extinction * s.optics.whole),
                static_cast<float>(s.extinction * s.optics.smooth),
                static_cast<float>(s.extinction * s.optics.canonical), 0.0f};
  const auto color = [](const std::array<double, RGB>& v, double last) {
    return glm::vec4(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
                     static_cast<float>(last));
  };
  out.albedo = color(s.optics.albedo, s.optics.peakAlbedo);
  // Homogeneous pixels of ways from the eye, and back.
  const glm::dmat4& c = view.clipFromEye;
  const glm::dvec4 across = rowOf(c, 3) * half;
  const glm::dvec3 right((rowOf(c, 0) * half + across) * double(view.width) - across);
  const glm::dvec3 down((rowOf(c, 1) * half + across) * double(view.height) - across);
  const glm::dmat3 ways =
      glm::inverse(glm::transpose(glm::dmat3(right, down, glm::dvec3(rowOf(c, 3)))));
  const glm::dvec3 ahead = ways[2] + ways[0] * (0.5 * view.width) + ways[1] * (0.5 * view.height);
  fillDetail(s, eye, glm::dmat3(1.0), glm::length(ways[1]) / glm::length(ahead), out);
  for (size_t set = 0; set < CANONICAL_SETS; ++set) {
    out.orders[set] = color(s.optics.orders[set], 0);
  }
}

std::array<uint32_t, 2> surfaceGroups(const SurfaceUniforms& uniforms) {
  const uint32_t all =
      (uniforms.triangle.x + interface_::SURFACE_LANES - 1) / interface_::SURFACE_LANES;
  return {std::min(all, interface_::SURFACE_ROW),
          (all + interface_::SURFACE_ROW - 1) / interface_::SURFACE_ROW};
}

}  // namespace welkin
