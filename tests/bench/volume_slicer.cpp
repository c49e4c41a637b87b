// SPDX-License-Identifier: MIT
#include "bench/volume_slicer.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "volume_eye_frag_spv.h"
#include "volume_light_frag_spv.h"
#include "volume_resolve_frag_spv.h"
#include "volume_screen_vert_spv.h"
#include "volume_slice_vert_spv.h"

namespace bench {
namespace {

constexpr size_t CORNERS = 6;  // of a plane's cut through a box, at most

Vec3 viewOf() {
  return {0, 0, -1};
}

// Across the slices: between the light's way and the view, or the view reversed.
Vec3 halfWay(const Vec3& toLight) {
  const Vec3 travel = toLight * -1.0;
  const double side = dot(travel, viewOf()) < 0 ? -1 : 1;
  return normalize(travel + viewOf() * side);
}

void barrier(VkCommandBuffer commands) {
  constexpr VkPipelineStageFlags STAGES =
      VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
  VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  memory.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
                         VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT;
  vkCmdPipelineBarrier(commands, STAGES, STAGES, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void beginDrawing(VkCommandBuffer commands, const GpuImage& image, bool clear, VkClearValue value) {
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = image.view;
  color.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  color.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.clearValue = value;
  const VkExtent2D extent{image.extent.width, image.extent.height};
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = extent;
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &color;
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{
      0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &info.renderArea);
}

struct Drawing {
  std::span<const uint32_t> vertex;
  std::span<const uint32_t> fragment;
  bool toLight;
  bool polygons;
  VkFormat format;
  VkPipelineColorBlendAttachmentState blend;
};

VkPipeline makeDrawing(VkDevice device, VkPipelineLayout layout, const Drawing& drawing) {
  const VkBool32 toLight = drawing.toLight ? VK_TRUE : VK_FALSE;
  const VkSpecializationMapEntry entry{0, 0, sizeof toLight};
  const VkSpecializationInfo constants{1, &entry, sizeof toLight, &toLight};
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  stages[0].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = makeModule(device, drawing.vertex);
  stages[0].pName = "main";
  stages[1] = stages[0];
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = makeModule(device, drawing.fragment);
  if (drawing.polygons) {
    stages[0].pSpecializationInfo = &constants;
  }
  const VkVertexInputBindingDescription binding{0, sizeof(std::array<float, 3>),
                                                VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
  VkPipelineVertexInputStateCreateInfo input{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  if (drawing.polygons) {
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = 1;
    input.pVertexAttributeDescriptions = &attribute;
  }
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineColorBlendStateCreateInfo blend{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = 1;
  blend.pAttachments = &drawing.blend;
  const std::array<VkDynamicState, 2> states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = static_cast<uint32_t>(states.size());
  dynamic.pDynamicStates = states.data();
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &drawing.format;
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  vkDestroyShaderModule(device, stages[0].module, nullptr);
  vkDestroyShaderModule(device, stages[1].module, nullptr);
  check(result, "vkCreateGraphicsPipelines");
  return pipeline;
}

// Premultiplied radiance over or under what is there; alpha is transmittance.
VkPipelineColorBlendAttachmentState eyeBlend(bool over) {
  VkPipelineColorBlendAttachmentState blend{};
  blend.blendEnable = VK_TRUE;
  blend.srcColorBlendFactor = over ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_DST_ALPHA;
  blend.dstColorBlendFactor = over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
  blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  blend.colorWriteMask = 0xf;
  return blend;
}

VkPipelineColorBlendAttachmentState lightBlend() {
  VkPipelineColorBlendAttachmentState blend{};
  blend.blendEnable = VK_TRUE;
  blend.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
  return blend;
}

}  // namespace

Slicer::Slicer(Gpu& gpu, const GpuImage& density, const GpuImage& target, const Vec3& toLight,
               uint32_t slices, uint32_t lightSize)
    : gpu_(gpu),
      target_(target),
      light_(gpu.makeImage(VK_FORMAT_R32_SFLOAT, {lightSize, lightSize, 1},
                           VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)),
      eye_(gpu.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, target.extent,
                         VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)),
      slabs_(cloudSlabs(halfWay(toLight), toLight, slices, lightSize)),
      slices_(slices),
      towardsEye_(dot(slabs_.axis, viewOf()) < 0),
      set_(gpu, slicerScene(slabs_, toLight, target.extent.width),
           {GpuImage{}, density, light_, eye_, GpuImage{}, target}),
      corners_(gpu.makeBuffer(slices * CORNERS * sizeof(std::array<float, 3>),
                              VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)) {
  makePipelines();
}

Slicer::~Slicer() {
  vkDeviceWaitIdle(gpu_.handle());
  for (VkPipeline pipeline : pipelines_) {
    vkDestroyPipeline(gpu_.handle(), pipeline, nullptr);
  }
}

void Slicer::makePipelines() {
  const std::array<Drawing, PIPES> drawings{{
      {volume_slice_vert_spv, volume_eye_frag_spv, false, true, eye_.format, eyeBlend(towardsEye_)},
      {volume_slice_vert_spv, volume_light_frag_spv, true, true, light_.format, lightBlend()},
      {volume_screen_vert_spv, volume_resolve_frag_spv, false, false, target_.format,
       eyeBlend(true)},
  }};
  for (size_t i = 0; i < drawings.size(); ++i) {
    pipelines_[i] = makeDrawing(gpu_.handle(), set_.layout(), drawings[i]);
  }
}

// Middles of the slabs, cut by the box; corners in the unit box, around their middle.
std::vector<Slicer::Polygon> Slicer::cutPolygons() const {
  auto* out = static_cast<std::array<float, 3>*>(corners_.data);
  const Vec3 corner = cloudCorner();
  // Plane coordinate of a point of the unit box: dot(rate, box) + at.
  const Vec3 rate = slabs_.axis * (CLOUD_EDGE / slabs_.thickness);
  const double at = dot(corner, slabs_.axis) / slabs_.thickness + slabs_.offset;
  const Vec3 across = normalize(std::abs(slabs_.axis.x) < 0.9 ? cross(slabs_.axis, {1, 0, 0})
                                                              : cross(slabs_.axis, {0, 1, 0}));
  const Vec3 other = cross(slabs_.axis, across);
  const std::array<double, 3> rates{rate.x, rate.y, rate.z};
  std::vector<Polygon> polygons;
  uint32_t next = 0;
  for (uint32_t k = 0; k < slices_; ++k) {
    const double plane = k + 0.5 - at;
    std::vector<std::array<double, 3>> points;
    for (size_t axis = 0; axis < 3; ++axis) {
      for (uint32_t bits = 0; bits < 4; ++bits) {
        std::array<double, 3> p{};
        p[(axis + 1) % 3] = bits & 1u;
        p[(axis + 2) % 3] = bits >> 1u;
        const double rest = plane - p[(axis + 1) % 3] * rates[(axis + 1) % 3] -
                            p[(axis + 2) % 3] * rates[(axis + 2) % 3];
        p[axis] = rest / rates[axis];
        if (p[axis] >= 0 && p[axis] <= 1 && points.size() < CORNERS) {
          points.push_back(p);
        }
      }
    }
    if (points.size() < 3) {
      continue;
    }
    Vec3 middle;
    for (const auto& p : points) {
      middle = middle + Vec3{p[0], p[1], p[2]} * (1.0 / static_cast<double>(points.size()));
    }
    const auto angle = [&](const std::array<double, 3>& p) {
      const Vec3 d = Vec3{p[0], p[1], p[2]} - middle;
      return std::atan2(dot(d, other), dot(d, across));
    };
    std::sort(points.begin(), points.end(),
              [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
    polygons.push_back({next, static_cast<uint32_t>(points.size())});
    for (const auto& p : points) {
      out[next++] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    }
  }
  return polygons;
}

void Slicer::record(VkCommandBuffer commands) {
  const std::vector<Polygon> polygons = cutPolygons();
  clearImage(commands, target_.handle);
  constexpr VkClearValue NO_DEPTH{};
  constexpr VkClearValue NOTHING{{{0, 0, 0, 1}}};
  const VkDeviceSize start = 0;
  set_.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS);
  vkCmdBindVertexBuffers(commands, 0, 1, &corners_.handle, &start);
  beginDrawing(commands, light_, true, NO_DEPTH);
  vkCmdEndRendering(commands);
  beginDrawing(commands, eye_, true, NOTHING);
  vkCmdEndRendering(commands);
  draws_ = 0;
  for (const Polygon& polygon : polygons) {
    barrier(commands);
    beginDrawing(commands, eye_, false, NOTHING);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[EYE]);
    vkCmdDraw(commands, polygon.count, 1, polygon.first, 0);
    vkCmdEndRendering(commands);
    barrier(commands);
    beginDrawing(commands, light_, false, NO_DEPTH);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[LIGHT]);
    vkCmdDraw(commands, polygon.count, 1, polygon.first, 0);
    vkCmdEndRendering(commands);
    draws_ += 2;
  }
  barrier(commands);
  beginDrawing(commands, target_, false, NOTHING);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[RESOLVE]);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
  ++draws_;
}

}  // namespace bench
