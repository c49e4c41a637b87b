// SPDX-License-Identifier: MIT
// Everything behind a WlkContext.
#pragma once

#include <algorithm>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

#include "api/error.hpp"
#include "api/handle_pool.hpp"
#include "api/validate.hpp"
#include "frame/error_estimate.hpp"
#include "frame/record.hpp"
#include "frame/resources.hpp"
#include "frame/scene.hpp"
#include "frame/shadow_map_record.hpp"
#include "host_memory.hpp"
#include "tables/sky_field.hpp"
#include "tables/sky_field_solver.hpp"
#include "vk/headless.hpp"

namespace welkin {

constexpr uint32_t CONTEXT_MAGIC = 0x574c4b43;  // "WLKC"

// Objects whose last use was recorded in `frame`; destroyed when that is complete.
struct Retired {
  explicit Retired(std::pmr::memory_resource* memory) : view(memory), shadowMap(memory) {}
  uint64_t frame = 0;
  ViewResources view;
  ShadowMapResources shadowMap;
  std::array<vk::Image, WLK_MAX_FIELDS + SCATTERING_FORMS + 3> images;
  std::array<vk::Buffer, SCATTERING_FORMS + 1> buffers;
};

// Light of all orders with what it was made of.
struct SkyFieldEntry {
  SkyFieldInput input;
  std::shared_ptr<const FogPhaseState> fogPhase;  // whose moments are in `input`
  SkyField field;
};

// What the moments on the GPU were made of.
struct SkyLightSource {
  AirInput air;
  std::array<float, 3> groundAlbedo{};
  double angularRadius = -1;
  std::shared_ptr<const FogPhaseState> fogPhase;
};

// The moments of another air, solved a few rows per frame.
struct SkyLightWork {
  SkyLightSource source;
  SkyFieldSolver solver;
  std::optional<SkyField> field;  // once it is solved
};

// A view of an engine's image, kept until wlkVulkanForgetImage.
struct ImportedView {
  VkImage image;
  VkImageViewType type;
  VkFormat format;
  uint32_t mipLevel;
  uint32_t baseArrayLayer;
  uint32_t layerCount;
  VkImageView view;
};

}  // namespace welkin

// Members in order of dependence: destroyed from the last to the first.
struct WlkContext_T {
  explicit WlkContext_T(const WlkContextInfo& contextInfo);
  ~WlkContext_T();
  WlkContext_T(const WlkContext_T&) = delete;
  WlkContext_T& operator=(const WlkContext_T&) = delete;

  uint32_t magic = welkin::CONTEXT_MAGIC;
  uint32_t mode = WLK_MODE_CPU;
  uint32_t maxFramesInFlight = 3;
  WlkLogCallback log = nullptr;
  void* logUser = nullptr;
  welkin::HostMemory memory;
  std::optional<welkin::vk::Headless> headless;
  std::optional<welkin::vk::Device> device;
  std::optional<welkin::vk::Pipelines> pipelines;

  welkin::AirState air;
  std::unique_ptr<welkin::SkyFieldEntry> skyField;  // of the last air that was asked for
  welkin::SkyLightState skyLight;
  welkin::SkyLightSource skyLightSource;
  // What the moments on the GPU, or on their way there, are of; for the ambient light of volumes.
  std::shared_ptr<const welkin::SkyField> shownField;
  uint64_t shownFieldVersion = 0;
  std::unique_ptr<welkin::SkyLightWork> skyLightWork;  // for an air that has changed
  welkin::ViewLights viewLights;
  welkin::HandlePool<welkin::MediumState> media;
  welkin::HandlePool<welkin::VolumeState> volumes;
  welkin::HandlePool<welkin::ViewState> views;
  welkin::HandlePool<welkin::SurfaceState> surfaces;
  welkin::HandlePool<welkin::ShadowMapState> shadowMaps;

  uint64_t frameIndex = 0;  // 0: no frame begun
  uint64_t completedFrame = 0;
  bool deviceLost = false;
  uint64_t bytesUploaded = 0;  // by the frame's updates
  uint32_t updateCopies = 0;
  std::pmr::vector<welkin::PendingUpload> pending;
  std::pmr::vector<welkin::Retired> retired;
  std::pmr::vector<welkin::ImportedView> imported;
  std::pmr::vector<welkin::RecordVolume> recordVolumes;
  std::pmr::vector<welkin::RecordSurface> recordSurfaces;
  std::pmr::vector<welkin::ErrorVolume> errorVolumes;  // of a view whose error is governed
  std::pmr::vector<welkin::ShadowCaster> shadowCasters;
  welkin::SurfaceTables surfaceTables;  // where there is, or was, a surface
  welkin::vk::Image dummy2d;
  welkin::vk::Image dummy3d;
  welkin::vk::Image dummyArray;

  bool fogActive() const { return air.fog && air.fog->extinction > 0; }
  // Whether there is anything that ambient light could come from.
  bool ambientActive() const {
    return air.ambient.mode == WLK_AMBIENT_GIVEN ||
           (air.ambient.mode == WLK_AMBIENT_AUTOMATIC && (air.sky || fogActive()));
  }
  bool absorbs() const {
    return air.absorber && (air.absorber->absorption[0] > 0 || air.absorber->absorption[1] > 0 ||
                            air.absorber->absorption[2] > 0);
  }
  bool shapedDisk() const {
    return std::any_of(air.lights.begin(), air.lights.begin() + air.lightCount,
                       welkin::hasShapedDisk);
  }
  welkin::vk::Device& requireDevice(const char* what);
  welkin::MediumState& medium(WlkMedium handle);
  welkin::VolumeState& volume(WlkVolume handle);
  welkin::ViewState& view(WlkView handle);
  welkin::SurfaceState& surface(WlkSurface handle);
  // Every view and map needs wlkPrepare again.
  void invalidate();
  // Forget what descriptor sets point to: handles may be reused for other objects.
  void forgetBindings();
  void retireView(welkin::ViewState& view);
  // Reads the times of finished frames, unless there is no device any more that could tell.
  void harvest(welkin::ViewState& view);
  void collect();
  // To the caller's log, if there is one. One sentence; the id is one of WLK_LOG_ID_*.
  __attribute__((format(printf, 4, 5))) void emit(uint32_t severity, uint32_t id,
                                                  const char* format, ...) const;
};

namespace welkin {

// Throws INVALID_HANDLE for null or something that is no context.
WlkContext_T& checkContext(WlkContext context);

// Throws WRONG_STATE unless a frame of the engine's has begun.
WlkContext_T& requireFrame(WlkContext context, VkCommandBuffer commands, const char* what);

// Whether every image that descriptors will name has been written once.
bool everythingUploaded(const WlkContext_T& context);

// Makes what the maps of shadows need.
void prepareShadowMaps(WlkContext_T& context, std::span<const uint32_t> fieldKinds);

// Hands the map's objects to the frames that use them.
void retireShadowMap(WlkContext_T& context, ShadowMapState& map);

// The images of aerial perspective among a view's targets, if there are any.
void importAerial(WlkContext_T& context, const ViewState& view, const WlkVulkanViewTargets& targets,
                  ViewTargets& images);

// The image of the volumes' distance among a view's targets, if there is one.
void importDistance(WlkContext_T& context, const ViewState& view,
                    const WlkVulkanViewTargets& targets, ViewTargets& images);

// Copies `region` into an image that shaders sample afterwards.
void copyInto(const vk::Dispatch& vk, VkCommandBuffer commands, const vk::Buffer& from,
              vk::Image& image, const VkBufferImageCopy& region, bool clearFirst);

// Records pending uploads and first-use transitions.
void recordUpdate(WlkContext_T& context, VkCommandBuffer commands);

// Plans the view's frame and records it.
void recordFrame(WlkContext_T& context, VkCommandBuffer commands, ViewState& view,
                 const ViewTargets& targets);

}  // namespace welkin
