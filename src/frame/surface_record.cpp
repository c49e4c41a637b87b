// SPDX-License-Identifier: MIT
#include "frame/surface_record.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "failure.hpp"
#include "frame/resources.hpp"
#include "frame/sky_bindings.hpp"
#include "frame/surface_buffers.hpp"

namespace welkin {
namespace {

using interface_::FrameUniforms;
using interface_::SliceConstants;
using interface_::SurfaceFaces;
using interface_::SurfaceUniforms;

bool isDetailed(const SurfaceState& surface) {
  return surface.detail.depth > 0;
}

vk::PipelineKey shadeKeyOf(const FrameCommands& c, const ViewTargets& targets,
                           const PlannedVolume& planned) {
  const Plan& plan = c.view.plan;
  return surfaceShadeKey({plan.airKind(), plan.fog, planned.lit, plan.allLight,
                          static_cast<bool>(targets.volumeDistance), planned.ambient,
                          isDetailed(*c.in.surfaces[planned.index].state)},
                         c.quality);
}

vk::PipelineKey listKeyOf(const FrameCommands& c, const ViewTargets& targets) {
  return surfaceListKey(static_cast<bool>(targets.volumeDistance), c.quality.halfVolumes);
}

// Whether anything opaque, or the ground, may end rays.
bool raysEnd(const FrameCommands& c, const ViewTargets& targets) {
  return static_cast<bool>(targets.depth) || c.view.plan.ground;
}

class SurfaceRecorder {
 public:
  SurfaceRecorder(FrameCommands& commands, const ViewTargets& targets, const PlannedVolume& planned)
      : c_(commands),
        targets_(targets),
        planned_(planned),
        surface_(*commands.in.surfaces[planned.index].state),
        light_(*commands.in.surfaces[planned.index].light),
        up_(commands.in.surfaces[planned.index].up),
        rank_(static_cast<uint32_t>(&planned - commands.view.plan.surfaces.data())) {}

  void run(bool first) {
    WlkPassStats light = passStats("surface light", WLK_PASS_SURFACE_LIGHT, 0, planned_.id);
    WlkPassStats eye = passStats("surface", WLK_PASS_SURFACE, 0, planned_.id);
    light.reason = planned_.lightReason;
    eye.reason = planned_.eyeReason;
    index_ = static_cast<uint32_t>(passes().size());
    if (planned_.drawn) {
      firstUse(light_);
      if (up_ != nullptr) {
        firstUse(*up_);
      }
      if (isDetailed(surface_)) {
        recordShell(light);
      }
      recordLights(light);
      recordEye(eye, first);
    }
    passes().push_back(light);
    passes().push_back(eye);
  }

 private:
  std::pmr::vector<WlkPassStats>& passes() const { return c_.view.record.passes; }
  const ViewResources& resources() const { return c_.view.resources; }

  void firstUse(SurfaceLight& light) {
    c_.firstUse(light.columns);
    c_.firstUse(light.faces);
    c_.firstUse(light.depths);
  }

  // The light maps, unless they are there already.
  void recordLights(WlkPassStats& stats) {
    bool changed = false;
    if (planned_.lit) {
      changed = recordMap(light_, c_.view.plan.lights.light[0].toLight, 0, stats);
    }
    if (planned_.ambient) {
      changed = recordMap(*up_, surface_.ambient.up, 1, stats) || changed;
      stats.reason = planned_.lit ? stats.reason : planned_.ambientReason;
    }
    if ((planned_.lit || planned_.ambient) && !changed) {
      stats.reason = c_.quality.noSkip ? WLK_REASON_NO_SKIP_FLAG : WLK_REASON_UNCHANGED;
    }
  }

  // How deep points lie under the surface, unless that is there already.
  void recordShell(WlkPassStats& stats) {
    SurfaceShell& shell = surface_.shell;
    if (shell.version == surface_.version && !c_.quality.noSkip) {
      return;
    }
    shell.version = surface_.version;
    SurfaceUniforms uniforms;
    fillShell(surface_, uniforms);
    use(light_, uniforms, 3);
    const auto [x, y, z] = shell.cells;
    const VkDeviceSize bytes = VkDeviceSize{x} * y * z * sizeof(float);
    const vk::Buffer& cells = c_.in.surfaceTables->cells;
    clear(cells, bytes);
    triangles(surfaceCellsKey, uniforms, stats, index_);
    c_.orderShaders();
    c_.dispatch(c_.find(surfaceShellKey(false)), c_.pipelines.surfaceLayout(), nullptr, groups(x),
                groups(z), stats, index_);
    c_.orderShaders();
    c_.dispatch(c_.find(surfaceShellKey(true)), c_.pipelines.surfaceLayout(), nullptr, groups(x),
                groups(y), stats, index_, z);
    c_.orderShaders();
  }

  // Whether the map along a direction had changed; `which`: its uniforms and set.
  bool recordMap(SurfaceLight& light, const glm::dvec3& from, uint32_t which, WlkPassStats& stats) {
    SurfaceUniforms uniforms;
    fillSurfaceLight(surface_, from, light.size, uniforms);
    const SurfaceLightKey now = surfaceLightKey(surface_, uniforms);
    const bool changed = !(now == light.key);
    if (!changed && !c_.quality.noSkip) {
      return false;
    }
    light.key = now;
    use(light, uniforms, which);
    clear(resources().surfaceCover, coverBytes(VkDeviceSize{light.size} * light.size, false));
    clear(resources().surfaceFaces, sizeof(SurfaceFaces) * light.size * light.size);
    triangles([](bool large) { return surfaceCoverKey(false, large); }, uniforms, stats, index_);
    triangles(surfaceFacesKey, uniforms, stats, index_);
    recordLevels(light.size, stats);
    copyLevels(light.columns, light.size, 0);
    copyLevels(light.faces, light.size, surfaceMapTexels(light.size));
    return changed;
  }

  void recordLevels(uint32_t edge, WlkPassStats& stats) {
    SliceConstants push{};
    push.slabCount = surfaceMapTexels(edge);
    bool fromLevel = false;
    for (uint32_t size = edge; size > 1;) {
      const uint32_t means = fromLevel && size > 2 ? 2 : 1;  // levels of them
      push.lightSize = size;
      c_.orderShaders();
      const bool detail = !fromLevel && isDetailed(surface_);
      c_.dispatch(c_.find(surfaceMapKey(fromLevel, detail)), c_.pipelines.surfaceLayout(), &push,
                  groups(size >> means), groups(size >> means), stats, index_);
      fromLevel = true;
      for (uint32_t level = 0; level < means; ++level, size /= 2) {
        push.firstSlab += size * size;
      }
    }
  }

  // From texels `first` on, level by level.
  void copyLevels(const vk::Image& image, uint32_t edge, uint32_t first) {
    constexpr VkDeviceSize TEXEL = 16;
    constexpr uint32_t MOST_LEVELS = 16;
    std::array<VkBufferImageCopy, MOST_LEVELS> regions{};
    uint32_t count = 0;
    for (uint32_t size = edge; size > 0; size /= 2) {
      VkBufferImageCopy& region = regions[count];
      region.bufferOffset = TEXEL * first;
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, count, 0, 1};
      region.imageExtent = {size, size, 1};
      first += size * size;
      ++count;
    }
    copyImage(resources().surfaceLevels, image, {regions.data(), count});
  }

  // What shaders have written.
  void copyImage(const vk::Buffer& from, const vk::Image& image,
                 std::span<const VkBufferImageCopy> regions) {
    const WlkVulkanImageState target{VK_IMAGE_LAYOUT_GENERAL, 0, VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                     VK_ACCESS_2_TRANSFER_WRITE_BIT};
    c_.barrier({COMPUTE, SHADER_ACCESS},
               {VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
    c_.image(image.handle(), WHOLE_IMAGE, GENERAL_STATE, target);
    c_.vk.CmdCopyBufferToImage(c_.commands, from.handle(), image.handle(), VK_IMAGE_LAYOUT_GENERAL,
                               static_cast<uint32_t>(regions.size()), regions.data());
    c_.image(image.handle(), WHOLE_IMAGE, target, GENERAL_STATE);
  }

  void recordEye(WlkPassStats& stats, bool first) {
    SurfaceUniforms uniforms;
    const PixelRect& shade = first ? c_.view.plan.volumeRect : planned_.rect;
    const double* position = c_.view.camera.position;
    fillSurfaceView(surface_, planned_,
                    {{position[0], position[1], position[2]},
                     c_.view.clipFromEye,
                     c_.view.info.width,
                     c_.view.info.height},
                    c_.view.plan.lights.light[0].toLight, light_.size, shade, uniforms);
    use(light_, uniforms, 2);
    const VkDeviceSize pixels =
        VkDeviceSize{planned_.rect.x1 - planned_.rect.x0} * (planned_.rect.y1 - planned_.rect.y0);
    if (pixels > 0) {
      const bool ends = raysEnd(c_, targets_);
      clear(resources().surfaceCover, coverBytes(pixels, ends));
      if (ends) {
        orderClears();
        c_.dispatch(c_.find(surfaceEndsKey(static_cast<bool>(targets_.depth))),
                    c_.pipelines.surfaceLayout(), nullptr,
                    groups(planned_.rect.x1 - planned_.rect.x0),
                    groups(planned_.rect.y1 - planned_.rect.y0), stats, index_ + 1);
      }
      triangles(
          ends ? [](bool large) { return surfaceCoverKey(true, large); }
               : [](bool large) { return surfaceCoverKey(false, large); },
          uniforms, stats, index_ + 1);
    }
    emptyLists();
    SliceConstants push{};
    push.flags = first ? interface_::SLICE_FIRST_VOLUME : 0;
    constexpr uint32_t CELL = interface_::SURFACE_CELL;
    const uint32_t wide = shade.x1 - shade.x0 / CELL * CELL;
    const uint32_t high = shade.y1 - shade.y0 / CELL * CELL;
    c_.dispatch(c_.find(listKeyOf(c_, targets_)), c_.pipelines.surfaceLayout(), &push,
                groups((wide + CELL - 1) / CELL), groups((high + CELL - 1) / CELL), stats,
                index_ + 1);
    const vk::PipelineKey shades = shadeKeyOf(c_, targets_, planned_);
    const vk::PipelineKey scatters = surfaceScatterKey(c_.quality.halfVolumes);
    const auto over = [&](uint32_t list, uint32_t own) {
      orderLists();
      overList(shades, list, push, stats);
      if (planned_.lit) {  // light scattered more than once
        orderLists();
        overList(scatters, own, push, stats);
      }
    };
    over(interface_::SURFACE_LIST_FOURTHS, interface_::SURFACE_LIST_FOURTHS);
    if (c_.quality.halfVolumes) {
      over(interface_::SURFACE_LIST_SECONDS, interface_::SURFACE_LIST_OWN_SECONDS);
      over(interface_::SURFACE_LIST_OTHERS, interface_::SURFACE_LIST_OWN);
    }
  }

  void overList(const vk::PipelineKey& key, uint32_t list, SliceConstants& push,
                WlkPassStats& stats) {
    push.firstSlab = list;
    c_.push(c_.pipelines.surfaceLayout(), push);
    c_.dispatchIndirect(c_.find(key), resources().surfaceList.handle(), 4 * sizeof(uint32_t) * list,
                        stats, index_ + 1);
  }

  void orderLists() {
    c_.barrier({COMPUTE, SHADER_ACCESS}, {COMPUTE | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                                          SHADER_ACCESS | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
  }

  // Their heads: no pixel, and as few groups along x, a power of 2, as 65535 along y, which any
  // device has, allow.
  void emptyLists() {
    constexpr uint32_t ROWS = 64 * 65535;
    const WlkViewInfo& info = c_.view.info;
    const uint64_t pixels = uint64_t{info.width} * info.height;
    const uint32_t across = std::bit_ceil(static_cast<uint32_t>(pixels / ROWS + 1));
    std::array<uint32_t, interface_::SURFACE_LIST_HEAD> head{};
    for (uint32_t list = 0; list < interface_::SURFACE_LISTS; ++list) {
      head[size_t{4} * list] = across;
      head[size_t{4} * list + 2] = 1;
    }
    writeList(head);
  }

  // The list's first words. What was recorded before is done, and seen by what comes after.
  void writeList(std::span<const uint32_t> words) {
    c_.barrier({COMPUTE | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                SHADER_ACCESS | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT},
               {VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    c_.vk.CmdUpdateBuffer(c_.commands, resources().surfaceList.handle(), 0, words.size_bytes(),
                          words.data());
    c_.barrier({COMPUTE | VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                SHADER_ACCESS | VK_ACCESS_2_TRANSFER_WRITE_BIT},
               {COMPUTE, SHADER_ACCESS});
  }

  // The mesh's triangles, then those that it finds to be large, after all that was recorded before.
  void triangles(vk::PipelineKey (*key)(bool large), const SurfaceUniforms& uniforms,
                 WlkPassStats& stats, uint32_t index) {
    const auto [x, y] = surfaceGroups(uniforms);
    const std::array<uint32_t, interface_::SURFACE_LARGE_HEAD> none{0, 1, 0, 0};
    writeList(none);
    c_.dispatch(c_.find(key(false)), c_.pipelines.surfaceLayout(), nullptr, x, y, stats, index);
    orderLists();
    c_.dispatchIndirect(c_.find(key(true)), resources().surfaceList.handle(), 0, stats, index);
  }

  // What readers before it have to have finished, too.
  void clear(const vk::Buffer& buffer, VkDeviceSize bytes) {
    c_.barrier({COMPUTE, SHADER_ACCESS},
               {VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    c_.vk.CmdFillBuffer(c_.commands, buffer.handle(), 0, bytes, 0);
  }

  void orderClears() {
    c_.barrier({VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
               {COMPUTE, SHADER_ACCESS});
  }

  // Writes the constants of picture `which` (0: the light's, 1: the vertical's, 2: the view's) and
  // binds what the passes read and write; `light`: the map whose depths they are about.
  void use(const SurfaceLight& light, const SurfaceUniforms& uniforms, uint32_t which) {
    BoundSet& set = c_.slot.surfaces[size_t{SURFACE_PICTURES} * rank_ + which];
    const ViewResources& r = resources();
    Bindings& b = c_.bindings;
    const VkDeviceSize frame = c_.in.slot * r.slotStride;
    const VkDeviceSize at =
        frame + r.surfaceOffset + (SURFACE_PICTURES * rank_ + which) * r.surfaceStride;
    std::memcpy(static_cast<char*>(r.uniforms.data()) + at, &uniforms, sizeof uniforms);
    b.buffer(set, vk::BIND_SURFACE_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
             frame, sizeof(FrameUniforms));
    b.buffer(set, vk::BIND_SURFACE_UNIFORMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r.uniforms.handle(),
             at, sizeof(SurfaceUniforms));
    b.buffer(set, vk::BIND_SURFACE_FOG_CURVE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
             r.uniforms.handle(), frame + r.fogOffset, FOG_CURVE_BYTES);
    const auto storage = [&](uint32_t binding, const vk::Buffer& buffer) {
      b.buffer(set, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer.handle(), 0, buffer.size());
    };
    b.image(set, vk::BIND_SURFACE_VERTICES, surface_.vertices.view(), VK_NULL_HANDLE,
            VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_SURFACE_CORNERS, surface_.corners.view(), VK_NULL_HANDLE,
            VK_IMAGE_LAYOUT_GENERAL);
    storage(vk::BIND_SURFACE_COVER, r.surfaceCover);
    b.texels(set, vk::BIND_SURFACE_COVER_TEXELS, r.surfaceCover);
    b.texels(set, vk::BIND_SURFACE_STATE_TEXELS, r.frameState);
    storage(vk::BIND_SURFACE_LIST, r.surfaceList);
    storage(vk::BIND_SURFACE_STATE, r.frameState);
    const SurfaceLight& up = up_ != nullptr ? *up_ : light_;
    b.image(set, vk::BIND_SURFACE_DEPTHS, light.depths.view(), VK_NULL_HANDLE,
            VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_SURFACE_UP_DEPTHS, up.depths.view(), c_.pipelines.nearest(),
            VK_IMAGE_LAYOUT_GENERAL);
    storage(vk::BIND_SURFACE_FACE_IDS, r.surfaceFaces);
    storage(vk::BIND_SURFACE_LEVELS, r.surfaceLevels);
    storage(vk::BIND_SURFACE_DISTANCES, r.distances ? r.distances : r.frameState);
    constexpr VkImageLayout READ = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    b.image(set, vk::BIND_SURFACE_DEPTH, targets_.depth ? targets_.depth.view : c_.in.dummy2d,
            c_.pipelines.nearest(), READ);
    b.image(set, vk::BIND_SURFACE_COLUMNS, light_.columns.view(), c_.pipelines.means(),
            VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_SURFACE_FACES, light_.faces.view(), c_.pipelines.means(),
            VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_SURFACE_UP_COLUMNS, up.columns.view(), c_.pipelines.means(),
            VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_SURFACE_UP_FACES, up.faces.view(), c_.pipelines.means(),
            VK_IMAGE_LAYOUT_GENERAL);
    b.image(set, vk::BIND_SURFACE_SHARE, c_.in.surfaceTables->share.view(), c_.pipelines.linear(),
            READ);
    b.image(set, vk::BIND_SURFACE_SOURCE, c_.in.surfaceTables->source.view(), c_.pipelines.linear(),
            READ);
    b.image(set, vk::BIND_SURFACE_PHASE, surface_.phase.view(), c_.pipelines.nearest(), READ);
    b.image(set, vk::BIND_SURFACE_CURVES, c_.in.surfaceTables->curves.view(), c_.pipelines.linear(),
            READ);
    const SurfaceTables& tables = *c_.in.surfaceTables;
    const bool detailed = isDetailed(surface_);
    storage(vk::BIND_SURFACE_CELLS, detailed ? tables.cells : r.surfaceFaces);
    b.image(set, vk::BIND_SURFACE_NOISE, detailed ? tables.noise.view() : tables.source.view(),
            c_.pipelines.nearest(), READ);
    const vk::Buffer& depth = detailed ? surface_.shell.depth : r.frameState;
    b.texels(set, vk::BIND_SURFACE_SHELL, depth);
    storage(vk::BIND_SURFACE_SHELL_ROWS, depth);
    bindSkyLookup(b, c_.pipelines, r, set, {vk::BIND_SURFACE_SKY_TABLE, vk::BIND_SURFACE_SKY_PEAK},
                  c_.in);
    c_.vk.CmdBindDescriptorSets(c_.commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                c_.pipelines.surfaceLayout(), 0, 1, &set.set, 0, nullptr);
  }

  FrameCommands& c_;
  const ViewTargets& targets_;
  const PlannedVolume& planned_;
  SurfaceState& surface_;
  SurfaceLight& light_;
  SurfaceLight* up_;
  uint32_t rank_;
  uint32_t index_ = 0;  // of the light's line of the statistics
};

}  // namespace

void findSurfacePipelines(const FrameCommands& commands, const ViewTargets& targets,
                          const PlannedVolume& planned) {
  if (!planned.drawn) {
    return;
  }
  const RecordSurface& surface = commands.in.surfaces[planned.index];
  const bool lit = planned.lit || planned.ambient;
  for (const bool large : {false, true}) {
    commands.find(surfaceCoverKey(raysEnd(commands, targets), large));
    if (lit) {
      commands.find(surfaceCoverKey(false, large));
      commands.find(surfaceFacesKey(large));
      commands.find(surfaceCellsKey(large));
    }
  }
  if (lit) {
    commands.find(surfaceMapKey(false, isDetailed(*surface.state)));
    commands.find(surfaceMapKey(true, false));
    commands.find(surfaceShellKey(false));
    commands.find(surfaceShellKey(true));
  }
  commands.find(surfaceEndsKey(static_cast<bool>(targets.depth)));
  commands.find(listKeyOf(commands, targets));
  if (planned.lit) {
    commands.find(surfaceScatterKey(commands.quality.halfVolumes));
  }
  commands.find(shadeKeyOf(commands, targets, planned));
  if (surface.light == nullptr || (planned.ambient && surface.up == nullptr)) {
    fail(WLK_ERROR_NOT_PREPARED, 0, "view", "call wlkPrepare before recording");
  }
}

void recordSurface(FrameCommands& commands, const ViewTargets& targets,
                   const PlannedVolume& planned, bool first) {
  SurfaceRecorder(commands, targets, planned).run(first);
}

}  // namespace welkin
