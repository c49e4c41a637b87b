// SPDX-License-Identifier: MIT
#include "panel_pass.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include "targets.hpp"

namespace {

void checkBackend(VkResult result) {
  check(result, "ImGui");
}

}  // namespace

PanelPass::PanelPass(const Gpu& gpu, GLFWwindow* window, const Swapchain& swapchain) : gpu_(gpu) {
  createRenderPass(swapchain.format());
  createBackend(window, swapchain.imageCount());
  uploadFonts();
  setSwapchain(swapchain);
}

PanelPass::~PanelPass() {
  destroyFramebuffers();
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  vkDestroyDescriptorPool(gpu_.device(), pool_, nullptr);
  vkDestroyRenderPass(gpu_.device(), renderPass_, nullptr);
}

// The backend knows render passes only. This one draws over what is there.
void PanelPass::createRenderPass(VkFormat format) {
  VkAttachmentDescription color{};
  color.format = format;
  color.samples = VK_SAMPLE_COUNT_1_BIT;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  color.initialLayout = COLOR_ATTACHMENT.layout;
  color.finalLayout = COLOR_ATTACHMENT.layout;
  const VkAttachmentReference reference{0, COLOR_ATTACHMENT.layout};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  // Blending reads what the present pass wrote.
  VkSubpassDependency before{};
  before.srcSubpass = VK_SUBPASS_EXTERNAL;
  before.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  before.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  info.attachmentCount = 1;
  info.pAttachments = &color;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &before;
  check(vkCreateRenderPass(gpu_.device(), &info, nullptr, &renderPass_), "vkCreateRenderPass");
}

void PanelPass::createBackend(GLFWwindow* window, uint32_t images) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};  // the font
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  pool.maxSets = 1;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  check(vkCreateDescriptorPool(gpu_.device(), &pool, nullptr, &pool_), "vkCreateDescriptorPool");

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the sample leaves no files behind
  ImGui::StyleColorsDark();
  ImGui_ImplGlfw_InitForVulkan(window, true);
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = gpu_.instance();
  info.PhysicalDevice = gpu_.physical();
  info.Device = gpu_.device();
  info.QueueFamily = gpu_.family();
  info.Queue = gpu_.queue();
  info.DescriptorPool = pool_;
  info.MinImageCount = 2;
  info.ImageCount = images;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = checkBackend;
  ImGui_ImplVulkan_Init(&info, renderPass_);
}

void PanelPass::uploadFonts() const {
  VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  poolInfo.queueFamilyIndex = gpu_.family();
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(gpu_.device(), &poolInfo, nullptr, &pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = pool;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(gpu_.device(), &allocate, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  ImGui_ImplVulkan_CreateFontsTexture(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(gpu_.queue(), 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  gpu_.waitIdle();
  vkDestroyCommandPool(gpu_.device(), pool, nullptr);
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

void PanelPass::destroyFramebuffers() {
  for (VkFramebuffer framebuffer : framebuffers_) {
    vkDestroyFramebuffer(gpu_.device(), framebuffer, nullptr);
  }
  framebuffers_.clear();
}

void PanelPass::setSwapchain(const Swapchain& swapchain) {
  destroyFramebuffers();
  extent_ = swapchain.extent();
  for (uint32_t i = 0; i < swapchain.imageCount(); ++i) {
    const VkImageView view = swapchain.view(i);
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = renderPass_;
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent_.width;
    info.height = extent_.height;
    info.layers = 1;
    check(vkCreateFramebuffer(gpu_.device(), &info, nullptr, &framebuffers_.emplace_back()),
          "vkCreateFramebuffer");
  }
}

void PanelPass::begin() const {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void PanelPass::skip() const {
  ImGui::EndFrame();
}

void PanelPass::record(VkCommandBuffer commands, uint32_t image) const {
  ImGui::Render();
  VkRenderPassBeginInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  info.renderPass = renderPass_;
  info.framebuffer = framebuffers_[image];
  info.renderArea = {{0, 0}, extent_};
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
  vkCmdEndRenderPass(commands);
}

bool PanelPass::wantsMouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool PanelPass::wantsKeys() const {
  return ImGui::GetIO().WantCaptureKeyboard;
}
