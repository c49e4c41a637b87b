// SPDX-License-Identifier: MIT
#include "vk/pipelines.hpp"

#include <span>

#include "aerial_comp_spv.h"
#include "ambient_cells_comp_spv.h"
#include "ambient_gather_comp_spv.h"
#include "ambient_restrict_comp_spv.h"
#include "ambient_source_comp_spv.h"
#include "ambient_sweep_comp_spv.h"
#include "ambient_view_comp_spv.h"
#include "composite_blend_frag_spv.h"
#include "composite_comp_spv.h"
#include "composite_tiles_vert_spv.h"
#include "composite_vert_spv.h"
#include "eye_clear_comp_spv.h"
#include "eye_march_comp_spv.h"
#include "eye_slices_comp_spv.h"
#include "eye_spread_comp_spv.h"
#include "eye_tiles_comp_spv.h"
#include "light_depth_comp_spv.h"
#include "light_slices_comp_spv.h"
#include "shadow_map_comp_spv.h"
#include "shadow_resolve_comp_spv.h"
#include "sky_table_comp_spv.h"
#include "surface_cells_comp_spv.h"
#include "surface_cover_comp_spv.h"
#include "surface_ends_comp_spv.h"
#include "surface_faces_comp_spv.h"
#include "surface_list_comp_spv.h"
#include "surface_map_comp_spv.h"
#include "surface_scatter_comp_spv.h"
#include "surface_shade_comp_spv.h"
#include "surface_shell_comp_spv.h"
#include "transport_cells_comp_spv.h"
#include "transport_depth_comp_spv.h"
#include "transport_extrapolate_comp_spv.h"
#include "transport_gather_comp_spv.h"
#include "transport_response_comp_spv.h"
#include "transport_restrict_comp_spv.h"
#include "transport_source_comp_spv.h"
#include "transport_sweep_comp_spv.h"
#include "transport_view_comp_spv.h"
#include "vk/pruned_code.hpp"
#include "volume_distance_comp_spv.h"

namespace welkin::vk {
namespace {

constexpr uint32_t PUSH_CONSTANT_BYTES = 16;

VkDescriptorSetLayoutBinding binding(uint32_t index, VkDescriptorType type) {
  return {index, type, 1, VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
}

VkDescriptorSetLayout makeSetLayout(const Device& device,
                                    std::span<const VkDescriptorSetLayoutBinding> bindings) {
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = static_cast<uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(device.vk().CreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
        "vkCreateDescriptorSetLayout");
  return layout;
}

VkPipelineLayout makeLayout(const Device& device, VkDescriptorSetLayout set) {
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, PUSH_CONSTANT_BYTES};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(device.vk().CreatePipelineLayout(device.handle(), &info, nullptr, &layout),
        "vkCreatePipelineLayout");
  return layout;
}

VkSampler makeSampler(const Device& device, VkFilter filter) {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = filter;
  info.minFilter = filter;
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkSampler sampler = VK_NULL_HANDLE;
  check(device.vk().CreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  return sampler;
}

VkSampler makeMeanSampler(const Device& device) {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  info.maxLod = VK_LOD_CLAMP_NONE;
  info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  info.addressModeU = info.addressModeV = info.addressModeW =
      VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
  VkSampler sampler = VK_NULL_HANDLE;
  check(device.vk().CreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  return sampler;
}

// A shader module for the time a pipeline is made.
class Module {
 public:
  Module(const Device& device, std::span<const uint32_t> code) : device_(device) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    check(device.vk().CreateShaderModule(device.handle(), &info, nullptr, &module_),
          "vkCreateShaderModule");
  }
  ~Module() { device_.vk().DestroyShaderModule(device_.handle(), module_, nullptr); }
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;
  VkShaderModule handle() const { return module_; }

 private:
  const Device& device_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

struct Specialization {
  std::array<uint32_t, MAX_CONSTANTS + 1> constants{};
  std::array<VkSpecializationMapEntry, MAX_CONSTANTS + 1> entries{};
  VkSpecializationInfo info{};
  Specialization(const Device& device, const PipelineKey& key) {
    std::copy(key.constants.begin(), key.constants.end(), constants.begin());
    constants[TEXELS_CONSTANT] = device.texels() ? 1 : 0;
    for (uint32_t i = 0; i < entries.size(); ++i) {
      entries[i] = {i, i * 4, 4};
    }
    info = {static_cast<uint32_t>(entries.size()), entries.data(), sizeof constants,
            constants.data()};
  }
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;
};

}  // namespace

Pipelines::Pipelines(Device& device, std::pmr::memory_resource* host)
    : device_(device), entries_(host) {
  try {
    std::array<VkDescriptorSetLayoutBinding, VOLUME_BINDING_COUNT> volume{};
    for (uint32_t i = 0; i < VOLUME_BINDING_COUNT; ++i) {
      volume[i] = binding(i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    }
    volume[BIND_FRAME].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    volume[BIND_VOLUME].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    volume[BIND_LIGHT_STORAGE].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    volume[BIND_FRAME_STATE].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    volume[BIND_VOLUME_STATE].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    volume[BIND_FOG_CURVE].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    volume[BIND_DISTANCES].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const VkDescriptorType texels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    volume[BIND_SECOND_TEXELS].descriptorType = texels;
    volumeSet_ = makeSetLayout(device_, volume);
    std::array composite{
        binding(BIND_COMPOSITE_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER),
        binding(BIND_COMPOSITE_STATE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(BIND_COMPOSITE_DEPTH, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_INPUT, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_TARGET0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE),
        binding(BIND_COMPOSITE_TARGET1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE),
        binding(BIND_COMPOSITE_COUNTERS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(BIND_COMPOSITE_FOG_CURVE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(BIND_COMPOSITE_SKY_TABLE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_SKY_PEAK, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_SKY_MOMENTS, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_SHADOW, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_LIGHT_SHADOW, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_SKY_FOG, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
        binding(BIND_COMPOSITE_TILES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(BIND_COMPOSITE_STATE_TEXELS, texels)};
    for (const uint32_t i : {BIND_COMPOSITE_FRAME, BIND_COMPOSITE_TILES}) {
      composite[i].stageFlags |= VK_SHADER_STAGE_VERTEX_BIT;
    }
    const std::array sky{binding(BIND_SKY_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER),
                         binding(BIND_SKY_MOMENTS, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
                         binding(BIND_SKY_TABLE_STORAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE),
                         binding(BIND_SKY_PEAK_STORAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE),
                         binding(BIND_SKY_FOG, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)};
    std::array<VkDescriptorSetLayoutBinding, TRANSPORT_BINDING_COUNT> transport{};
    for (uint32_t i = 0; i < TRANSPORT_BINDING_COUNT; ++i) {
      transport[i] = binding(i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    }
    transport[BIND_TRANSPORT_UNIFORMS].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    transport[BIND_TRANSPORT_WORK].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    transport[BIND_TRANSPORT_KEPT].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    transport[BIND_TRANSPORT_SWEPT].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    transport[BIND_TRANSPORT_PAIRS].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    transport[BIND_TRANSPORT_TARGET].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    transport[BIND_TRANSPORT_VIEW].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    transportSet_ = makeSetLayout(device_, transport);
    transportLayout_ = makeLayout(device_, transportSet_);
    std::array<VkDescriptorSetLayoutBinding, AMBIENT_BINDING_COUNT> ambient{};
    for (uint32_t i = 0; i < AMBIENT_BINDING_COUNT; ++i) {
      ambient[i] = binding(i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    }
    ambient[BIND_AMBIENT_UNIFORMS].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    ambient[BIND_AMBIENT_WORK].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    ambient[BIND_AMBIENT_KEPT].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    ambient[BIND_AMBIENT_TARGET].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    ambient[BIND_AMBIENT_VIEW].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    ambientSet_ = makeSetLayout(device_, ambient);
    ambientLayout_ = makeLayout(device_, ambientSet_);
    std::array<VkDescriptorSetLayoutBinding, SHADOW_BINDING_COUNT> shadow{};
    for (uint32_t i = 0; i < SHADOW_BINDING_COUNT; ++i) {
      shadow[i] = binding(i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    }
    shadow[BIND_SHADOW_VOLUME].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    shadow[BIND_SHADOW_SUMS].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    shadow[BIND_SHADOW_TARGET].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    shadowSet_ = makeSetLayout(device_, shadow);
    shadowLayout_ = makeLayout(device_, shadowSet_);
    const std::array distance{binding(BIND_DISTANCE_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER),
                              binding(BIND_DISTANCE_SUMS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
                              binding(BIND_DISTANCE_TARGET, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE)};
    distanceSet_ = makeSetLayout(device_, distance);
    distanceLayout_ = makeLayout(device_, distanceSet_);
    std::array<VkDescriptorSetLayoutBinding, SURFACE_BINDING_COUNT> surface{};
    for (uint32_t i = 0; i < SURFACE_BINDING_COUNT; ++i) {
      surface[i] = binding(i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    }
    for (const uint32_t i : {BIND_SURFACE_FRAME, BIND_SURFACE_UNIFORMS}) {
      surface[i].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    }
    for (const uint32_t i :
         {BIND_SURFACE_DEPTH, BIND_SURFACE_COLUMNS, BIND_SURFACE_FACES, BIND_SURFACE_SOURCE,
          BIND_SURFACE_CURVES, BIND_SURFACE_PHASE, BIND_SURFACE_SKY_TABLE, BIND_SURFACE_SKY_PEAK,
          BIND_SURFACE_UP_DEPTHS, BIND_SURFACE_UP_COLUMNS, BIND_SURFACE_UP_FACES,
          BIND_SURFACE_SHARE, BIND_SURFACE_NOISE}) {
      surface[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
    for (const uint32_t i : {BIND_SURFACE_VERTICES, BIND_SURFACE_CORNERS, BIND_SURFACE_DEPTHS}) {
      surface[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    }
    for (const uint32_t i :
         {BIND_SURFACE_COVER_TEXELS, BIND_SURFACE_STATE_TEXELS, BIND_SURFACE_SHELL}) {
      surface[i].descriptorType = texels;
    }
    surfaceSet_ = makeSetLayout(device_, surface);
    surfaceLayout_ = makeLayout(device_, surfaceSet_);
    skySet_ = makeSetLayout(device_, sky);
    skyLayout_ = makeLayout(device_, skySet_);
    compositeSet_ = makeSetLayout(device_, composite);
    volumeLayout_ = makeLayout(device_, volumeSet_);
    compositeLayout_ = makeLayout(device_, compositeSet_);
    linear_ = makeSampler(device_, VK_FILTER_LINEAR);
    nearest_ = makeSampler(device_, VK_FILTER_NEAREST);
    means_ = makeMeanSampler(device_);
  } catch (...) {
    destroy();
    throw;
  }
}

Pipelines::~Pipelines() {
  destroy();
}

void Pipelines::destroy() {
  const Dispatch& vk = device_.vk();
  const VkDevice device = device_.handle();
  for (const Entry& entry : entries_) {
    vk.DestroyPipeline(device, entry.pipeline, nullptr);
  }
  vk.DestroySampler(device, linear_, nullptr);
  vk.DestroySampler(device, nearest_, nullptr);
  vk.DestroySampler(device, means_, nullptr);
  vk.DestroyPipelineLayout(device, surfaceLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, surfaceSet_, nullptr);
  vk.DestroyPipelineLayout(device, skyLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, skySet_, nullptr);
  vk.DestroyPipelineLayout(device, ambientLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, ambientSet_, nullptr);
  vk.DestroyPipelineLayout(device, distanceLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, distanceSet_, nullptr);
  vk.DestroyPipelineLayout(device, shadowLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, shadowSet_, nullptr);
  vk.DestroyPipelineLayout(device, transportLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, transportSet_, nullptr);
  vk.DestroyPipelineLayout(device, volumeLayout_, nullptr);
  vk.DestroyPipelineLayout(device, compositeLayout_, nullptr);
  vk.DestroyDescriptorSetLayout(device, volumeSet_, nullptr);
  vk.DestroyDescriptorSetLayout(device, compositeSet_, nullptr);
}

VkPipeline Pipelines::find(const PipelineKey& key) const {
  for (const Entry& entry : entries_) {
    if (entry.key == key) {
      return entry.pipeline;
    }
  }
  return VK_NULL_HANDLE;
}

void Pipelines::prepare(const PipelineKey& key) {
  if (find(key) != VK_NULL_HANDLE) {
    return;
  }
  entries_.reserve(entries_.size() + 1);
  entries_.push_back({key, key.pass == Pass::CompositeBlend ? makeBlend(key) : makeCompute(key)});
}

Pipelines::Compute Pipelines::computeOf(Pass pass) const {
  switch (pass) {
    case Pass::LightSlices:
      return {light_slices_comp_spv, volumeLayout_};
    case Pass::LightDepth:
      return {light_depth_comp_spv, volumeLayout_};
    case Pass::EyeSlices:
      return {eye_slices_comp_spv, volumeLayout_};
    case Pass::EyeMarch:
      return {eye_march_comp_spv, volumeLayout_};
    case Pass::EyeSpread:
      return {eye_spread_comp_spv, volumeLayout_};
    case Pass::EyeTiles:
      return {eye_tiles_comp_spv, volumeLayout_};
    case Pass::EyeClear:
      return {eye_clear_comp_spv, volumeLayout_};
    case Pass::SkyTable:
      return {sky_table_comp_spv, skyLayout_};
    case Pass::AmbientCells:
      return {ambient_cells_comp_spv, ambientLayout_};
    case Pass::AmbientSweep:
      return {ambient_sweep_comp_spv, ambientLayout_};
    case Pass::AmbientGather:
      return {ambient_gather_comp_spv, ambientLayout_};
    case Pass::AmbientRestrict:
      return {ambient_restrict_comp_spv, ambientLayout_};
    case Pass::AmbientSource:
      return {ambient_source_comp_spv, ambientLayout_};
    case Pass::AmbientView:
      return {ambient_view_comp_spv, ambientLayout_};
    case Pass::TransportDepth:
      return {transport_depth_comp_spv, transportLayout_};
    case Pass::TransportCells:
      return {transport_cells_comp_spv, transportLayout_};
    case Pass::TransportSweep:
      return {transport_sweep_comp_spv, transportLayout_};
    case Pass::TransportGather:
      return {transport_gather_comp_spv, transportLayout_};
    case Pass::TransportExtrapolate:
      return {transport_extrapolate_comp_spv, transportLayout_};
    case Pass::TransportResponse:
      return {transport_response_comp_spv, transportLayout_};
    case Pass::TransportRestrict:
      return {transport_restrict_comp_spv, transportLayout_};
    case Pass::TransportSource:
      return {transport_source_comp_spv, transportLayout_};
    case Pass::ShadowMap:
      return {shadow_map_comp_spv, shadowLayout_};
    case Pass::ShadowResolve:
      return {shadow_resolve_comp_spv, shadowLayout_};
    case Pass::TransportView:
      return {transport_view_comp_spv, transportLayout_};
    case Pass::VolumeDistance:
      return {volume_distance_comp_spv, distanceLayout_};
    case Pass::SurfaceEnds:
      return {surface_ends_comp_spv, surfaceLayout_};
    case Pass::SurfaceCover:
      return {surface_cover_comp_spv, surfaceLayout_};
    case Pass::SurfaceFaces:
      return {surface_faces_comp_spv, surfaceLayout_};
    case Pass::SurfaceMap:
      return {surface_map_comp_spv, surfaceLayout_};
    case Pass::SurfaceCells:
      return {surface_cells_comp_spv, surfaceLayout_};
    case Pass::SurfaceShell:
      return {surface_shell_comp_spv, surfaceLayout_};
    case Pass::SurfaceList:
      return {surface_list_comp_spv, surfaceLayout_};
    case Pass::SurfaceShade:
      return {surface_shade_comp_spv, surfaceLayout_};
    case Pass::SurfaceScatter:
      return {surface_scatter_comp_spv, surfaceLayout_};
    case Pass::Aerial:
      return {aerial_comp_spv, compositeLayout_};
    default:
      return {composite_comp_spv, compositeLayout_};
  }
}

VkPipeline Pipelines::makeCompute(const PipelineKey& key) {
  const auto [code, layout] = computeOf(key.pass);
  const Specialization specialization(device_, key);
  const Module module(device_, prunedCode(code, specialization.constants, hostMemory()));
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.handle();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization.info;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(device_.vk().CreateComputePipelines(device_.handle(), device_.info().pipelineCache, 1,
                                            &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
  return pipeline;
}

VkPipeline Pipelines::makeBlend(const PipelineKey& key) {
  const bool tiles = key.constants[BLEND_TILES] != 0;
  const Module vertex(device_, tiles ? std::span<const uint32_t>(composite_tiles_vert_spv)
                                     : std::span<const uint32_t>(composite_vert_spv));
  const Specialization specialization(device_, key);
  const Module fragment(
      device_, prunedCode(composite_blend_frag_spv, specialization.constants, hostMemory()));
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (auto& stage : stages) {
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.pName = "main";
  }
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vertex.handle();
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = fragment.handle();
  stages[1].pSpecializationInfo = &specialization.info;

  const VkPipelineVertexInputStateCreateInfo vertexInput{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1.0f;
  VkPipelineMultisampleStateCreateInfo samples{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  // target = radiance + target * transmittance; the engine's alpha stays.
  VkPipelineColorBlendAttachmentState blend{};
  blend.blendEnable = VK_TRUE;
  blend.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.dstColorBlendFactor = VK_BLEND_FACTOR_SRC1_COLOR;
  blend.colorBlendOp = VK_BLEND_OP_ADD;
  blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
  blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.alphaBlendOp = VK_BLEND_OP_ADD;
  blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  VkPipelineColorBlendStateCreateInfo blending{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blending.attachmentCount = 1;
  blending.pAttachments = &blend;
  const std::array dynamicStates{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = static_cast<uint32_t>(dynamicStates.size());
  dynamic.pDynamicStates = dynamicStates.data();
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &key.format;

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.pNext = &rendering;
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &vertexInput;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pColorBlendState = &blending;
  info.pDynamicState = &dynamic;
  info.layout = compositeLayout_;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(device_.vk().CreateGraphicsPipelines(device_.handle(), device_.info().pipelineCache, 1,
                                             &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  return pipeline;
}

}  // namespace welkin::vk
