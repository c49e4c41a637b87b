// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <cstring>

#include "codec.hpp"

namespace engine {
namespace {

using welkin::check;
using welkin::make;

welkin::Context makeContext(const Device& device, uint32_t framesInFlight) {
  const WlkVulkanDeviceInfo engine = device.info();
  auto info = make<WlkContextInfo>();
  info.next = &engine;
  info.maxFramesInFlight = framesInFlight;
  return welkin::Context(info);
}

VkImageUsageFlags colorUsage(const Request& request) {
  auto needs = make<WlkVulkanRequirements>();
  check(wlkVulkanGetRequirements(&needs));
  switch (request.composite) {
    case WLK_COMPOSITE_BLEND:
      return needs.blendTargetUsage;
    case WLK_COMPOSITE_COMPUTE:
      return needs.colorInputUsage |
             (request.inPlace ? needs.storageTargetUsage : VkImageUsageFlags{0});
    default:
      return needs.colorInputUsage;
  }
}

}  // namespace

uint32_t targetFormatOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return WLK_TARGET_RGBA32_FLOAT;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
      return WLK_TARGET_B10G11R11_FLOAT;
    default:
      return WLK_TARGET_RGBA16_FLOAT;
  }
}

Shot::Attachment::Attachment(const Device& device, VkFormat format, VkExtent2D extent,
                             VkImageUsageFlags usage, const std::vector<float>& values,
                             uint32_t layers)
    : image(device, format, {extent.width, extent.height, 1}, usage, layers),
      input(device, VkDeviceSize{extent.width} * extent.height * layers * texelBytes(format)),
      output(device, input.size()) {
  if (!values.empty()) {
    const std::vector<unsigned char> bytes = encode(format, values);
    std::memcpy(input.data(), bytes.data(), bytes.size());
  }
}

std::vector<float> Shot::Attachment::values() const {
  return decode(image.format(), {output.data(), output.size()});
}

Shot::Shot(const Device& device, const Request& request) : request_(request) {
  const auto usage = [](VkFormat format) -> VkImageUsageFlags {
    return format == VK_FORMAT_R32_SFLOAT
               ? VK_IMAGE_USAGE_SAMPLED_BIT
               : VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  };
  if (!request.depth.empty()) {
    depth_.emplace(device, request.depthFormat, request.extent, usage(request.depthFormat),
                   request.depth);
  }
  if (!request.shadowMap.empty()) {
    shadow_.emplace(device, request.shadowFormat, request.shadowExtent, usage(request.shadowFormat),
                    request.shadowMap, request.lightShadow.cascadeCount);
  }
  color_.emplace(device, request.format, request.extent, colorUsage(request), request.color);
  if (request.composite == WLK_COMPOSITE_COMPUTE && !request.inPlace) {
    target_.emplace(device, request.format, request.extent, VK_IMAGE_USAGE_STORAGE_BIT,
                    std::vector<float>());
  }
  if (request.composite == WLK_COMPOSITE_SEPARATE) {
    for (auto* layer : {&radiance_, &transmittance_}) {
      layer->emplace(device, request.format, request.extent, VK_IMAGE_USAGE_STORAGE_BIT,
                     std::vector<float>());
    }
  }
}

void Shot::record(VkCommandBuffer commands, WlkContext context) const {
  auto targets = make<WlkVulkanViewTargets>();
  WlkVulkanImage depth{};
  if (depth_) {
    depth_->image.write(commands, depth_->input);
    depth = depth_->image.imported(COPY_TARGET, COPY_SOURCE);
    targets.depth = &depth;
  }
  WlkVulkanImage shadowMap{};
  if (shadow_) {
    shadow_->image.write(commands, shadow_->input);
    shadowMap = shadow_->image.imported(COPY_TARGET, COPY_SOURCE);
    targets.lightShadow = &request_.lightShadow;
    targets.shadowMap = &shadowMap;
  }
  color_->image.write(commands, color_->input);
  const WlkVulkanImage color = color_->image.imported(COPY_TARGET, COPY_SOURCE);
  if (request_.composite == WLK_COMPOSITE_SEPARATE) {
    renderSeparate(commands, context, targets);
    color_->image.transition(commands, COPY_TARGET, COPY_SOURCE);
  } else {
    WlkVulkanImage output = color;
    if (target_) {
      output = target_->image.imported(UNDEFINED, COPY_SOURCE);
    }
    targets.colorInput = request_.composite == WLK_COMPOSITE_COMPUTE ? &color : nullptr;
    targets.color = &output;
    check(wlkVulkanCmdRenderView(context, commands, request_.view, &targets));
  }
  for (const auto* attachment :
       {&depth_, &shadow_, &color_, &target_, &radiance_, &transmittance_}) {
    if (*attachment) {
      (*attachment)->read(commands);
    }
  }
  orderCopiesBeforeHost(commands);
}

void Shot::renderSeparate(VkCommandBuffer commands, WlkContext context,
                          WlkVulkanViewTargets& targets) const {
  const WlkVulkanImage radiance = radiance_->image.imported(UNDEFINED, COPY_SOURCE);
  const WlkVulkanImage transmittance = transmittance_->image.imported(UNDEFINED, COPY_SOURCE);
  targets.radiance = &radiance;
  targets.transmittance = &transmittance;
  check(wlkVulkanCmdRenderView(context, commands, request_.view, &targets));
}

Result Shot::result() const {
  Result result;
  result.color = color_->values();
  result.output = target_ ? target_->values() : result.color;
  if (depth_) {
    result.depth = depth_->values();
  }
  if (radiance_) {
    result.radiance = radiance_->values();
    result.transmittance = transmittance_->values();
  }
  return result;
}

void Shot::forget(WlkContext context) const {
  for (const auto* attachment :
       {&depth_, &shadow_, &color_, &target_, &radiance_, &transmittance_}) {
    if (*attachment) {
      check(wlkVulkanForgetImage(context, (*attachment)->image.handle()));
    }
  }
}

Engine::Engine(uint32_t framesInFlight, bool uploadCloud)
    : context_(makeContext(device_, framesInFlight)), scene_(makeScene(context_, uploadCloud)) {}

Engine::~Engine() {
  device_.wait();
}

welkin::View Engine::makeView(VkExtent2D extent, uint32_t composite, VkFormat format) {
  auto info = make<WlkViewInfo>();
  info.width = extent.width;
  info.height = extent.height;
  info.composite = composite;
  info.targetFormat = targetFormatOf(format);
  welkin::View view(context_, info);
  setQuality(context_, view);
  check(wlkPrepare(context_));
  return view;
}

WlkResult Engine::beginFrame(uint64_t index, uint64_t completed) const {
  auto frame = make<WlkFrameInfo>();
  frame.frameIndex = index;
  frame.completedFrameIndex = completed;
  return wlkBeginFrame(context_, &frame);
}

Result Engine::render(const Request& request, const WlkCamera& camera) {
  const Shot shot(device_, request);
  check(wlkSetCamera(context_, request.view, &camera));
  ++frame_;
  check(beginFrame(frame_, frame_ - 1));
  VkCommandBuffer commands = device_.begin();
  check(wlkVulkanCmdUpdate(context_, commands));
  shot.record(commands, context_);
  device_.submit(commands);
  device_.wait();
  Result result = shot.result();
  shot.forget(context_);
  return result;
}

}  // namespace engine
