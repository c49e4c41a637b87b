// SPDX-License-Identifier: MIT
// Cloud surfaces: meshes filled with a medium.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "api/context.hpp"
#include "api/surface_data.hpp"
#include "surface/surface_mesh.hpp"

namespace {

using namespace welkin;

constexpr uint32_t LARGEST_STRIDE = 4096;

void checkStride(uint32_t stride) {
  checkRange(WLK_STRUCT_SURFACE_INFO, "vertexStride", stride, 3 * sizeof(float), LARGEST_STRIDE);
  if (stride % sizeof(float) != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_SURFACE_INFO, "vertexStride",
         "vertexStride is %u, expected a multiple of 4", stride);
  }
}

// Place of a vertex, whatever lies between them.
std::array<float, 3> vertexAt(const float* positions, uint32_t stride, size_t i) {
  std::array<float, 3> place;
  std::memcpy(place.data(), reinterpret_cast<const char*>(positions) + i * stride, sizeof place);
  return place;
}

WlkSurfaceInfo checkedInfo(const WlkSurfaceInfo* info) {
  const WlkSurfaceInfo s = copyStruct(info, WLK_STRUCT_SURFACE_INFO);
  checkNoChain(info);
  checkRange(s.sType, "extinction", s.extinction, 0, 1e6);
  checkRange(s.sType, "vertexCount", s.vertexCount, 4, 3.0 * SURFACE_TRIANGLES_MAX);
  checkRange(s.sType, "triangleCount", s.triangleCount, 4, SURFACE_TRIANGLES_MAX);
  checkStride(s.vertexStride);
  checkPointer(s.positions, "positions");
  checkPointer(s.indices, "indices");
  checkTransform(s.sType, "worldFromSurface", s.worldFromSurface);
  return s;
}

SurfaceDetail checkedDetail(const WlkSurfaceDetail* detail) {
  const WlkSurfaceDetail d = copyStruct(detail, WLK_STRUCT_SURFACE_DETAIL);
  checkNoChain(detail);
  checkRange(d.sType, "depth", d.depth, 0, 1e6);
  checkRange(d.sType, "size", d.size, 0, 1e6);
  checkRange(d.sType, "softness", d.softness, 0.05F, 1);
  for (const float x : d.offset) {
    checkRange(d.sType, "offset", x, -SURFACE_POSITION_MAX, SURFACE_POSITION_MAX);
  }
  // Far below a millimetre lumps are none.
  constexpr double LEAST = 1e-6;
  SurfaceDetail result;
  result.depth = d.depth < LEAST ? 0.0 : double{d.depth};
  result.size = std::max(d.size > 0 ? double{d.size} : 2 * result.depth, LEAST);
  result.softness = double{d.softness};
  result.offset = {d.offset[0], d.offset[1], d.offset[2]};
  return result;
}

glm::dmat4x3 transformOf(const double* m) {
  return {m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10], m[3], m[7], m[11]};
}

SurfaceMesh meshOf(const WlkSurfaceInfo& s) {
  std::vector<float> places;
  places.reserve(size_t{3} * s.vertexCount);
  for (size_t i = 0; i < s.vertexCount; ++i) {
    const std::array<float, 3> place = vertexAt(s.positions, s.vertexStride, i);
    places.insert(places.end(), place.begin(), place.end());
  }
  return makeSurfaceMesh(places, {s.indices, size_t{3} * s.triangleCount});
}

// Texels of the mesh's images, of four words each.
constexpr VkDeviceSize TEXEL = 4 * sizeof(float);

VkExtent3D meshExtent(size_t texels) {
  constexpr size_t ROW = interface_::SURFACE_MESH_ROW;
  static_assert(3 * SURFACE_TRIANGLES_MAX <= ROW * ROW, "any device has images so large");
  return {static_cast<uint32_t>(std::min(texels, ROW)),
          static_cast<uint32_t>((texels + ROW - 1) / ROW), 1};
}

// Room for whole rows of them.
vk::Buffer meshRows(vk::Device& device, size_t texels) {
  const VkExtent3D extent = meshExtent(texels);
  return {device, TEXEL * extent.width * extent.height, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true};
}

// Of three words each.
template <typename Triples>
vk::Buffer stage(vk::Device& device, const Triples& triples) {
  vk::Buffer buffer = meshRows(device, triples.size());
  std::memset(buffer.data(), 0, buffer.size());
  auto* to = static_cast<char*>(buffer.data());
  for (const auto& triple : triples) {
    std::memcpy(to, triple.data(), sizeof triple);
    to += TEXEL;
  }
  return buffer;
}

vk::Image meshImage(vk::Device& device, VkFormat format, const VkExtent3D& extent,
                    VkImageUsageFlags usage) {
  vk::ImageInfo info;
  info.format = format;
  info.extent = extent;
  info.usage = usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return {device, info};
}

// Everything of a new surface but its place among the context's.
void fillSurface(WlkContext_T& c, const WlkSurfaceInfo& s, const SurfaceMesh& mesh,
                 SurfaceState& state) {
  vk::Device& device = *c.device;
  state.extinction = s.extinction;
  state.optics = surfaceOptics(c.medium(s.medium).medium, c.surfaceTables.asymmetry);
  state.worldFromMesh = transformOf(s.worldFromSurface);
  state.newLow = mesh.low;
  state.newHigh = mesh.high;
  state.placeOf.assign(mesh.placeOf.begin(), mesh.placeOf.end());
  state.places = static_cast<uint32_t>(mesh.positions.size());
  state.triangles = static_cast<uint32_t>(mesh.triangles.size());
  const VkExtent3D vertices = meshExtent(mesh.positions.size());
  const VkExtent3D corners = meshExtent(mesh.triangles.size());
  constexpr VkFormat FLOATS = VK_FORMAT_R32G32B32A32_SFLOAT;
  constexpr VkImageUsageFlags LOADED = VK_IMAGE_USAGE_STORAGE_BIT;
  state.vertices = meshImage(device, FLOATS, vertices, LOADED);
  state.corners = meshImage(device, VK_FORMAT_R32G32B32A32_UINT, corners, LOADED);
  state.newVertices = stage(device, mesh.positions);
  state.newCorners = stage(device, mesh.triangles);
  const auto& curve = state.optics.curve;
  state.newPhase = vk::Buffer(device, curve.size() * TEXEL, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
  static_assert(sizeof curve[0] == TEXEL);
  std::memcpy(state.newPhase.data(), curve.data(), state.newPhase.size());
  state.phase = meshImage(device, FLOATS, {static_cast<uint32_t>(curve.size() / 2), 2, 1},
                          VK_IMAGE_USAGE_SAMPLED_BIT);
  state.optics.curve = {};
}

// Cells for detail so deep, where there are not as many.
void useShell(WlkContext_T& c, SurfaceState& surface, double depth) {
  vk::Device& device = c.requireDevice("wlkSetSurfaceDetail");
  const std::array<uint32_t, 3> cells = shellCells(surface, depth);
  if (surface.shell.depth && cells == surface.shell.cells) {
    return;
  }
  vk::Buffer made = makeShell(device, cells, c.surfaceTables);
  if (surface.shell.depth) {
    Retired& old = c.retired.emplace_back(&c.memory);
    old.frame = c.frameIndex;
    old.buffers[0] = std::move(surface.shell.depth);
    c.forgetBindings();
  }
  surface.shell.depth = std::move(made);
  surface.shell.cells = cells;
  surface.shell.version = 0;
}

void checkPlaces(const float* positions, uint32_t count, uint32_t stride) {
  for (size_t i = 0; i < count; ++i) {
    for (const float x : vertexAt(positions, stride, i)) {
      if (!(std::fabs(x) <= SURFACE_POSITION_MAX)) {  // NaN too
        fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_SURFACE_INFO, "positions",
             "vertex %zu: %g is not finite or beyond %g m", i, static_cast<double>(x),
             static_cast<double>(SURFACE_POSITION_MAX));
      }
    }
  }
}

}  // namespace

WlkResult wlkCreateSurface(WlkContext context, const WlkSurfaceInfo* info, WlkSurface* surface) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    checkPointer(surface, "surface");
    const WlkSurfaceInfo s = checkedInfo(info);
    vk::Device& device = c.requireDevice("wlkCreateSurface");
    c.medium(s.medium);
    const SurfaceMesh mesh = meshOf(s);
    if (!c.surfaceTables.source) {
      c.surfaceTables = makeSurfaceTables(device);
    }
    const uint64_t id = c.surfaces.create(&c.memory);
    try {
      fillSurface(c, s, mesh, *c.surfaces.find(id));
    } catch (...) {
      c.surfaces.destroy(id);
      throw;
    }
    c.invalidate();
    surface->id = id;
    return WLK_SUCCESS;
  });
}

WlkResult wlkDestroySurface(WlkContext context, WlkSurface surface) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    retireSurface(c, c.surface(surface));
    c.surfaces.destroy(surface.id);
    c.forgetBindings();
    c.collect();
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetSurfaceTransform(WlkContext context, WlkSurface surface,
                                 const double worldFromSurface[12]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    SurfaceState& state = c.surface(surface);
    checkPointer(worldFromSurface, "worldFromSurface");
    checkTransform(WLK_STRUCT_SURFACE_INFO, "worldFromSurface", worldFromSurface);
    state.worldFromMesh = transformOf(worldFromSurface);
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetSurfaceDetail(WlkContext context, WlkSurface surface,
                              const WlkSurfaceDetail* detail) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    SurfaceState& state = c.surface(surface);
    if (detail == nullptr) {
      state.detail = {};
      return WLK_SUCCESS;
    }
    const SurfaceDetail checked = checkedDetail(detail);
    if (checked.depth > 0) {
      useShell(c, state, checked.depth);
    }
    state.detail = checked;
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetSurfacePositions(WlkContext context, WlkSurface surface, const float* positions,
                                 uint32_t vertexCount, uint32_t vertexStride) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    SurfaceState& state = c.surface(surface);
    vk::Device& device = c.requireDevice("wlkSetSurfacePositions");
    checkPointer(positions, "positions");
    checkStride(vertexStride);
    if (vertexCount != state.placeOf.size()) {
      fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_SURFACE_INFO, "vertexCount",
           "vertexCount is %u, the surface was created with %zu", vertexCount,
           state.placeOf.size());
    }
    checkPlaces(positions, vertexCount, vertexStride);
    if (!state.newVertices) {
      state.newVertices = meshRows(device, state.places);
    }
    // Nothing throws from here on.
    state.newLow.fill(SURFACE_POSITION_MAX);
    state.newHigh.fill(-SURFACE_POSITION_MAX);
    for (size_t i = 0; i < vertexCount; ++i) {
      if (state.placeOf[i] == NO_PLACE) {
        continue;
      }
      const std::array<float, 3> place = vertexAt(positions, vertexStride, i);
      std::memcpy(static_cast<char*>(state.newVertices.data()) + TEXEL * state.placeOf[i],
                  place.data(), sizeof place);
      for (size_t axis = 0; axis < 3; ++axis) {
        state.newLow[axis] = std::min(state.newLow[axis], place[axis]);
        state.newHigh[axis] = std::max(state.newHigh[axis], place[axis]);
      }
    }
    return WLK_SUCCESS;
  });
}
