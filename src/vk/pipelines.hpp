// SPDX-License-Identifier: MIT
// Pipelines by pass and specialisation constants, made in wlkPrepare and only looked up while
// recording; the descriptor set layouts of the passes.
#pragma once

#include <algorithm>
#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "vk/device.hpp"

namespace welkin::vk {

enum class Pass : uint32_t {
  LightSlices,
  LightDepth,
  EyeSlices,
  EyeMarch,
  EyeSpread,
  EyeTiles,
  EyeClear,
  SkyTable,
  Composite,
  CompositeBlend,
  TransportDepth,
  TransportCells,
  TransportSweep,
  TransportGather,
  TransportExtrapolate,
  TransportRestrict,
  TransportResponse,
  TransportSource,
  TransportView,
  ShadowMap,
  ShadowResolve,
  AmbientCells,
  AmbientSweep,
  AmbientGather,
  AmbientRestrict,
  AmbientSource,
  AmbientView,
  Aerial,
  VolumeDistance,
  SurfaceEnds,
  SurfaceCover,
  SurfaceFaces,
  SurfaceMap,
  SurfaceCells,
  SurfaceShell,
  SurfaceList,
  SurfaceShade,
  SurfaceScatter
};

constexpr uint32_t MAX_CONSTANTS = 16;
// Behind those, the same for all: Device::texels().
constexpr uint32_t TEXELS_CONSTANT = MAX_CONSTANTS;
// Of CompositeBlend's: 1 where it draws tiles instead of the whole target. No shader's.
constexpr uint32_t BLEND_TILES = 15;

// Values of constant_id 0, 1, 2, ... of the pass; booleans are 0 or 1.
struct PipelineKey {
  Pass pass = Pass::Composite;
  VkFormat format = VK_FORMAT_UNDEFINED;  // colour attachment of CompositeBlend
  std::array<uint32_t, MAX_CONSTANTS> constants{};
  bool operator==(const PipelineKey&) const = default;
};

// Bindings of the volume passes and of the composite, see shaders/pass.
enum VolumeBinding : uint32_t {
  BIND_FRAME = 0,
  BIND_VOLUME = 1,
  BIND_LIGHT_STORAGE = 2,
  BIND_LIGHT_SAMPLED = 3,
  BIND_FIELD0 = 4,
  BIND_TABLE = 8,
  BIND_DEPTH = 9,
  BIND_FRAME_STATE = 10,
  BIND_VOLUME_STATE = 11,
  BIND_FOG_CURVE = 12,
  BIND_SKY_TABLE = 13,
  BIND_SKY_PEAK = 14,
  BIND_VIEW_SOURCE = 15,
  BIND_PAGES = 16,
  BIND_VIEW_AMBIENT = 17,
  BIND_LEAPS = 18,
  BIND_DISTANCES = 19,
  BIND_DIAMETERS = 20,
  BIND_SECOND_TEXELS = 21,
  VOLUME_BINDING_COUNT = 22
};
enum CompositeBinding : uint32_t {
  BIND_COMPOSITE_FRAME = 0,
  BIND_COMPOSITE_STATE = 1,
  BIND_COMPOSITE_DEPTH = 2,
  BIND_COMPOSITE_INPUT = 3,
  BIND_COMPOSITE_TARGET0 = 4,
  BIND_COMPOSITE_TARGET1 = 5,
  BIND_COMPOSITE_COUNTERS = 6,
  BIND_COMPOSITE_FOG_CURVE = 7,
  BIND_COMPOSITE_SKY_TABLE = 8,
  BIND_COMPOSITE_SKY_PEAK = 9,
  BIND_COMPOSITE_SKY_MOMENTS = 10,
  BIND_COMPOSITE_SHADOW = 11,
  BIND_COMPOSITE_LIGHT_SHADOW = 12,
  BIND_COMPOSITE_SKY_FOG = 13,
  BIND_COMPOSITE_TILES = 14,
  BIND_COMPOSITE_STATE_TEXELS = 15,
  COMPOSITE_BINDING_COUNT = 16
};
enum SkyTableBinding : uint32_t {
  BIND_SKY_FRAME = 0,
  BIND_SKY_MOMENTS = 1,
  BIND_SKY_TABLE_STORAGE = 2,
  BIND_SKY_PEAK_STORAGE = 3,
  BIND_SKY_FOG = 4,
  SKY_BINDING_COUNT = 5
};

enum TransportBinding : uint32_t {
  BIND_TRANSPORT_UNIFORMS = 0,
  BIND_TRANSPORT_WORK = 1,
  BIND_TRANSPORT_KEPT = 2,
  BIND_TRANSPORT_FIELD0 = 3,
  BIND_TRANSPORT_PAIRS = 7,
  BIND_TRANSPORT_TARGET = 8,
  BIND_TRANSPORT_VIEW = 9,
  BIND_TRANSPORT_PAGES = 10,
  BIND_TRANSPORT_SWEPT = 11,
  TRANSPORT_BINDING_COUNT = 12
};

enum AmbientBinding : uint32_t {
  BIND_AMBIENT_UNIFORMS = 0,
  BIND_AMBIENT_WORK = 1,
  BIND_AMBIENT_KEPT = 2,
  BIND_AMBIENT_FIELD0 = 3,
  BIND_AMBIENT_TARGET = 7,
  BIND_AMBIENT_VIEW = 8,
  BIND_AMBIENT_PAGES = 9,
  AMBIENT_BINDING_COUNT = 10
};

enum ShadowBinding : uint32_t {
  BIND_SHADOW_VOLUME = 0,
  BIND_SHADOW_SUMS = 1,
  BIND_SHADOW_TARGET = 2,
  BIND_SHADOW_FIELD0 = 3,
  BIND_SHADOW_PAGES = 7,
  SHADOW_BINDING_COUNT = 8
};

enum DistanceBinding : uint32_t {
  BIND_DISTANCE_FRAME = 0,
  BIND_DISTANCE_SUMS = 1,
  BIND_DISTANCE_TARGET = 2
};

enum SurfaceBinding : uint32_t {
  BIND_SURFACE_FRAME = 0,
  BIND_SURFACE_UNIFORMS = 1,
  BIND_SURFACE_VERTICES = 2,
  BIND_SURFACE_CORNERS = 3,
  BIND_SURFACE_COVER = 4,
  BIND_SURFACE_DEPTH = 5,
  BIND_SURFACE_STATE = 6,
  BIND_SURFACE_DEPTHS = 7,
  BIND_SURFACE_FACE_IDS = 8,
  BIND_SURFACE_LEVELS = 9,
  BIND_SURFACE_COLUMNS = 10,
  BIND_SURFACE_FACES = 11,
  BIND_SURFACE_SOURCE = 12,
  BIND_SURFACE_CURVES = 13,
  BIND_SURFACE_PHASE = 14,
  BIND_SURFACE_FOG_CURVE = 15,
  BIND_SURFACE_SKY_TABLE = 16,
  BIND_SURFACE_SKY_PEAK = 17,
  BIND_SURFACE_DISTANCES = 18,
  BIND_SURFACE_UP_DEPTHS = 19,
  BIND_SURFACE_UP_COLUMNS = 20,
  BIND_SURFACE_UP_FACES = 21,
  BIND_SURFACE_SHARE = 22,
  BIND_SURFACE_NOISE = 23,
  BIND_SURFACE_CELLS = 24,
  BIND_SURFACE_SHELL = 25,
  BIND_SURFACE_LIST = 26,
  BIND_SURFACE_SHELL_ROWS = 27,
  BIND_SURFACE_COVER_TEXELS = 28,
  BIND_SURFACE_STATE_TEXELS = 29,
  SURFACE_BINDING_COUNT = 30
};

// Of any set.
constexpr uint32_t MOST_BINDINGS =
    std::max({+VOLUME_BINDING_COUNT, +COMPOSITE_BINDING_COUNT, +TRANSPORT_BINDING_COUNT,
              +AMBIENT_BINDING_COUNT, +SHADOW_BINDING_COUNT, +SURFACE_BINDING_COUNT});

class Pipelines {
 public:
  Pipelines(Device& device, std::pmr::memory_resource* host);
  ~Pipelines();
  Pipelines(const Pipelines&) = delete;
  Pipelines& operator=(const Pipelines&) = delete;

  // Makes the pipeline if it does not exist.
  void prepare(const PipelineKey& key);
  // VK_NULL_HANDLE if it was not prepared.
  VkPipeline find(const PipelineKey& key) const;

  VkDescriptorSetLayout volumeSetLayout() const { return volumeSet_; }
  VkDescriptorSetLayout compositeSetLayout() const { return compositeSet_; }
  VkDescriptorSetLayout skySetLayout() const { return skySet_; }
  VkDescriptorSetLayout transportSetLayout() const { return transportSet_; }
  VkDescriptorSetLayout shadowSetLayout() const { return shadowSet_; }
  VkDescriptorSetLayout distanceSetLayout() const { return distanceSet_; }
  VkPipelineLayout distanceLayout() const { return distanceLayout_; }
  VkDescriptorSetLayout ambientSetLayout() const { return ambientSet_; }
  VkPipelineLayout ambientLayout() const { return ambientLayout_; }
  VkPipelineLayout shadowLayout() const { return shadowLayout_; }
  VkPipelineLayout transportLayout() const { return transportLayout_; }
  VkPipelineLayout skyLayout() const { return skyLayout_; }
  VkPipelineLayout volumeLayout() const { return volumeLayout_; }
  VkPipelineLayout compositeLayout() const { return compositeLayout_; }
  VkDescriptorSetLayout surfaceSetLayout() const { return surfaceSet_; }
  VkPipelineLayout surfaceLayout() const { return surfaceLayout_; }
  VkSampler linear() const { return linear_; }
  VkSampler nearest() const { return nearest_; }
  // Linear in place and level, 0 beyond the border.
  VkSampler means() const { return means_; }

 private:
  void destroy();
  struct Compute {
    std::span<const uint32_t> code;
    VkPipelineLayout layout;
  };
  Compute computeOf(Pass pass) const;
  VkPipeline makeCompute(const PipelineKey& key);
  VkPipeline makeBlend(const PipelineKey& key);
  std::pmr::memory_resource* hostMemory() const { return entries_.get_allocator().resource(); }

  struct Entry {
    PipelineKey key;
    VkPipeline pipeline;
  };
  Device& device_;
  std::pmr::vector<Entry> entries_;
  VkDescriptorSetLayout volumeSet_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout compositeSet_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout skySet_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout transportSet_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout shadowSet_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout ambientSet_ = VK_NULL_HANDLE;
  VkPipelineLayout ambientLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout shadowLayout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout surfaceSet_ = VK_NULL_HANDLE;
  VkPipelineLayout surfaceLayout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout distanceSet_ = VK_NULL_HANDLE;
  VkPipelineLayout distanceLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout transportLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout volumeLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout skyLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout compositeLayout_ = VK_NULL_HANDLE;
  VkSampler linear_ = VK_NULL_HANDLE;
  VkSampler nearest_ = VK_NULL_HANDLE;
  VkSampler means_ = VK_NULL_HANDLE;
};

}  // namespace welkin::vk
