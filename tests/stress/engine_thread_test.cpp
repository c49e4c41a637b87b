// SPDX-License-Identifier: MIT
// Contexts on one device of the engine's, each in a thread with a command pool of its own, while
// the others draw: air, fog, a volume and a cloud surface, in frames between which everything
// moves. Only the queue is shared, and the engine's to lock.
#include <welkin/welkin_vulkan.h>

#include <mutex>

#include "stress/abuse.hpp"
#include "stress/in_threads.hpp"
#include "support/surface_scene.hpp"
#include "support/test_device.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t WIDTH = 16;
constexpr uint32_t HEIGHT = 12;
constexpr uint64_t FRAMES = 3;

support::DeviceOptions deviceOptions() {
  chooseDriver();
  support::DeviceOptions options;
  options.validation = false;  // it has threads and locks of its own
  options.queueFlags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  options.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  options.features13.synchronization2 = VK_TRUE;
  options.features13.dynamicRendering = VK_TRUE;
  return options;
}

struct SharedDevice {
  support::TestDevice device{deviceOptions()};
  std::mutex queue;
};

// A thread's own commands.
class Recorder {
 public:
  explicit Recorder(SharedDevice& shared) : shared_(shared) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = shared.device.family();
    support::check(vkCreateCommandPool(shared.device.handle(), &pool, nullptr, &pool_),
                   "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                           pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    support::check(vkAllocateCommandBuffers(shared.device.handle(), &info, &commands_),
                   "vkAllocateCommandBuffers");
  }
  ~Recorder() { vkDestroyCommandPool(shared_.device.handle(), pool_, nullptr); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void run(const std::function<void(VkCommandBuffer)>& record) {
    VkDevice device = shared_.device.handle();
    support::check(vkResetCommandPool(device, pool_, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    support::check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    record(commands_);
    support::check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    const std::lock_guard lock(shared_.queue);
    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(device, shared_.device.family(), 0, &queue);
    support::check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    support::check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
  }

 private:
  SharedDevice& shared_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// A scene that `seed` chooses, drawn into an image of its own.
class SharedScene : public SceneBuilder {
 public:
  SharedScene(SharedDevice& shared, size_t seed) : SceneBuilder(options()), shared_(shared) {
    auto info = make<WlkVulkanDeviceInfo>();
    info.getInstanceProcAddr = vkGetInstanceProcAddr;
    info.instance = shared.device.instance();
    info.physicalDevice = shared.device.physical();
    info.device = shared.device.handle();
    info.apiVersion = VK_API_VERSION_1_3;
    info.queueFamilyIndex = shared.device.family();
    create(&info);
    setSky();
    setFog(2e-4f, 300.0f);
    setSun(30.0 + 10.0 * static_cast<double>(seed), 40);
    volume_ = addBall(0.005f);
    surface_ = addSurface(*this, support::boxMesh(), addHenyeyGreenstein(0.7f), 0.01f,
                          {100, 100, 100}, {300, 400, -1500});
    setCamera({0, 2, 0}, 0, 12);
    check(wlkPrepare(context));
  }

  // The picture of each frame; volume and surface change between them.
  std::vector<Image> frames() {
    std::vector<Image> all;
    for (uint64_t i = 1; i <= FRAMES; ++i) {
      upload(volume_, {8, 8, 8}, std::vector<float>(512, 1.0f / static_cast<float>(i)));
      setScaledPositions(*this, surface_, support::boxMesh(), 1.0f + 0.1f * static_cast<float>(i));
      auto frame = make<WlkFrameInfo>();
      frame.frameIndex = i;
      frame.completedFrameIndex = i - 1;
      check(wlkBeginFrame(context, &frame));
      recorder_.run([&](VkCommandBuffer commands) { record(commands); });
      Image image{WIDTH, HEIGHT, {}};
      const auto* pixels = reinterpret_cast<const float*>(pixels_.data());
      image.rgba.assign(pixels, pixels + size_t{4} * WIDTH * HEIGHT);
      all.push_back(image);
    }
    wlkDestroyContext(context);  // before the image it has a view of
    context = nullptr;
    return all;
  }

 private:
  static SceneOptions options() {
    SceneOptions options;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.scattering = WLK_SCATTERING_FORWARD;
    return options;
  }

  void record(VkCommandBuffer commands) const {
    check(wlkVulkanCmdUpdate(context, commands));
    auto image = make<WlkVulkanImage>();
    image.image = target_.handle();
    image.format = target_.format();
    image.width = WIDTH;
    image.height = HEIGHT;
    image.depth = 1;
    image.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    image.after.layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    image.before.stages = image.after.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    image.before.access = image.after.access =
        VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    auto targets = make<WlkVulkanViewTargets>();
    targets.color = &image;
    check(wlkVulkanCmdRenderView(context, commands, view, &targets));
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = target_.extent();
    vkCmdCopyImageToBuffer(commands, target_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           pixels_.handle(), 1, &region);
  }

  SharedDevice& shared_;
  Recorder recorder_{shared_};
  support::Image target_{shared_.device,
                         VK_FORMAT_R32G32B32A32_SFLOAT,
                         {WIDTH, HEIGHT, 1},
                         VK_IMAGE_USAGE_STORAGE_BIT};
  support::Buffer pixels_{shared_.device, VkDeviceSize{16} * WIDTH* HEIGHT};
  WlkVolume volume_{};
  WlkSurface surface_{};
};

TEST(Threads, EnginesContextsOnOneDeviceDrawAsAlone) {
  constexpr size_t CONTEXTS = 2;
  SharedDevice shared;
  std::vector<std::vector<Image>> drawn(CONTEXTS);
  inThreads(CONTEXTS, [&](size_t i) { drawn[i] = SharedScene(shared, i).frames(); });
  for (size_t i = 0; i < CONTEXTS; ++i) {
    ASSERT_EQ(drawn[i].size(), FRAMES);
    EXPECT_EQ(drawn[i].back().badValues(), 0u);
    EXPECT_TRUE(drawn[i].front() != drawn[i].back());
    EXPECT_TRUE(drawn[i] == SharedScene(shared, i).frames()) << "context " << i;
  }
  EXPECT_TRUE(drawn[0] != drawn[1]);
}

}  // namespace
}  // namespace welkin::test
