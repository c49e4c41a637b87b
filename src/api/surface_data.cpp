// SPDX-License-Identifier: MIT
#include "api/surface_data.hpp"

#include <algorithm>
#include <utility>

#include "frame/ladder.hpp"
#include "frame/surface_buffers.hpp"
#include "tables/detail_noise.hpp"

namespace welkin {
namespace {

void retireLight(WlkContext_T& c, SurfaceLight& light) {
  Retired& entry = c.retired.emplace_back(&c.memory);
  entry.frame = c.frameIndex;
  entry.images[0] = std::move(light.columns);
  entry.images[1] = std::move(light.faces);
  entry.images[2] = std::move(light.depths);
}

// The same on every rung.
uint32_t sizeFor(const ViewState& view) {
  return surfaceMapSize(roomFor(view.quality));
}

bool wanted(const WlkContext_T& c, uint32_t size) {
  for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
    const ViewState* view = c.views.at(i);
    if (view != nullptr && sizeFor(*view) == size) {
      return true;
    }
  }
  return false;
}

void copyTable(WlkContext_T& c, VkCommandBuffer commands, vk::Buffer& from, vk::Image& to,
               vk::Buffer& room) {
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = to.info().extent;
  copyInto(c.device->vk(), commands, from, to, region, false);
  c.bytesUploaded += from.size();
  ++c.updateCopies;
  room = std::move(from);
}

// All levels, from fine to coarse.
void copyNoise(WlkContext_T& c, VkCommandBuffer commands, vk::Buffer& room) {
  SurfaceTables& tables = c.surfaceTables;
  for (uint32_t level = 0; level < DETAIL_LEVELS; ++level) {
    VkBufferImageCopy region{};
    region.bufferOffset = sizeof(uint32_t) * detailLevelBegin(level);
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const uint32_t edge = DETAIL_TEXELS >> level;
    const auto [x, y, z] = detailBegin(level);
    region.imageOffset = {static_cast<int32_t>(x), static_cast<int32_t>(y),
                          static_cast<int32_t>(z)};
    region.imageExtent = {edge, edge, edge};
    copyInto(c.device->vk(), commands, tables.newNoise, tables.noise, region, false);
    ++c.updateCopies;
  }
  c.bytesUploaded += tables.newNoise.size();
  room = std::move(tables.newNoise);
}

}  // namespace

void prepareSurfaceLights(WlkContext_T& c) {
  for (uint32_t i = 0; i < c.surfaces.slotCount(); ++i) {
    SurfaceState* surface = c.surfaces.at(i);
    if (surface == nullptr) {
      continue;
    }
    c.retired.reserve(c.retired.size() + surface->lights.size());
    for (SurfaceLight& light : surface->lights) {
      if (!wanted(c, light.size) || (light.up && !c.ambientActive())) {
        retireLight(c, light);
      }
    }
    const bool ambient = c.ambientActive();
    if (std::erase_if(surface->lights, [](const SurfaceLight& light) { return !light.columns; }) >
        0) {
      c.forgetBindings();
    }
    for (uint32_t v = 0; v < c.views.slotCount(); ++v) {
      const ViewState* view = c.views.at(v);
      for (const bool up : {false, true}) {
        if (view != nullptr && (ambient || !up) &&
            findSurfaceLight(*surface, sizeFor(*view), up) == nullptr) {
          surface->lights.push_back(makeSurfaceLight(*c.device, sizeFor(*view), up));
        }
      }
    }
  }
}

void retireSurface(WlkContext_T& c, SurfaceState& surface) {
  c.retired.reserve(c.retired.size() + surface.lights.size() + 2);
  for (SurfaceLight& light : surface.lights) {
    retireLight(c, light);
  }
  Retired& mesh = c.retired.emplace_back(&c.memory);
  mesh.frame = c.frameIndex;
  mesh.buffers[0] = std::move(surface.shell.depth);
  mesh.images[0] = std::move(surface.phase);
  mesh.images[1] = std::move(surface.vertices);
  mesh.images[2] = std::move(surface.corners);
}

void uploadSurfaces(WlkContext_T& c, VkCommandBuffer commands) {
  SurfaceTables& tables = c.surfaceTables;
  if (tables.newSource) {
    Retired& entry = c.retired.emplace_back(&c.memory);
    entry.frame = c.frameIndex;
    copyTable(c, commands, tables.newSource, tables.source, entry.buffers[0]);
    copyTable(c, commands, tables.newCurves, tables.curves, entry.buffers[1]);
    copyTable(c, commands, tables.newShare, tables.share, entry.buffers[2]);
  }
  if (tables.newNoise) {
    Retired& entry = c.retired.emplace_back(&c.memory);
    entry.frame = c.frameIndex;
    copyNoise(c, commands, entry.buffers[0]);
  }
  for (uint32_t i = 0; i < c.surfaces.slotCount(); ++i) {
    SurfaceState* surface = c.surfaces.at(i);
    if (surface != nullptr && surface->newVertices) {
      c.bytesUploaded += uploadSurface(*c.device, commands, *surface);
      ++c.updateCopies;
      Retired& entry = c.retired.emplace_back(&c.memory);
      entry.frame = c.frameIndex;
      entry.buffers[0] = std::move(surface->newVertices);
      entry.buffers[1] = std::move(surface->newCorners);
      if (surface->newPhase) {
        copyTable(c, commands, surface->newPhase, surface->phase, entry.buffers[2]);
      }
    }
  }
}

bool surfacesUploaded(const WlkContext_T& c) {
  if (c.surfaceTables.newNoise) {
    return false;
  }
  for (uint32_t i = 0; i < c.surfaces.slotCount(); ++i) {
    const SurfaceState* surface = c.surfaces.at(i);
    if (surface != nullptr && surface->newCorners) {
      return false;
    }
  }
  return true;
}

void gatherSurfaces(WlkContext_T& c, ViewState& view, PlanInput& input) {
  view.planSurfaces.clear();
  c.recordSurfaces.clear();
  for (uint32_t i = 0; i < c.surfaces.slotCount(); ++i) {
    SurfaceState* surface = c.surfaces.at(i);
    if (surface == nullptr) {
      continue;
    }
    PlanVolume plan;
    plan.id = c.surfaces.idOf(i);
    plan.index = static_cast<uint32_t>(c.recordSurfaces.size());
    plan.worldFromBox = surface->worldFromBox();
    plan.anyDensity = surface->extinction > 0;
    view.planSurfaces.push_back(plan);
    const uint32_t size = sizeFor(view);
    c.recordSurfaces.push_back(
        {surface, findSurfaceLight(*surface, size, false), findSurfaceLight(*surface, size, true)});
  }
  input.surfaces = view.planSurfaces;
}

}  // namespace welkin
