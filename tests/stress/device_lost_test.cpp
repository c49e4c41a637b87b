// SPDX-License-Identifier: MIT
// After a lost device each exported function, in a context of the engine's and in a headless one:
// what it returns, and that Vulkan is asked nothing but to destroy. The table has every name of
// tests/abi/symbols.txt.
#include <algorithm>
#include <fstream>
#include <set>

#include "stress/device_lost_table.hpp"
#include "support/fault_layer.hpp"
#include "support/vulkan_layer.hpp"

namespace welkin::test {
namespace {

constexpr Kind ALL{"all", false, true, WLK_SCATTERING_FORWARD, true, true, true, true};

enum class Mode { ENGINE, HEADLESS };

class DeviceLost : public ::testing::Test {
 protected:
  DeviceLost() {
    FaultLayer::failNever();
    FaultLayer::makeHollowPipelines(true);
  }
  ~DeviceLost() override {
    FaultLayer::failNever();
    FaultLayer::makeHollowPipelines(false);
  }
  // Calls each function of the table once.
  void expectTable(const LostObjects& objects, Mode mode);
};

void DeviceLost::expectTable(const LostObjects& objects, Mode mode) {
  for (const LostRow& row : lostTable()) {
    SCOPED_TRACE(row.name);
    const uint64_t any = FaultLayer::anyCalls();
    const uint64_t destroyed = FaultLayer::destructions();
    EXPECT_STREQ(wlkResultName(row.call(objects)),
                 wlkResultName(mode == Mode::ENGINE ? row.engine : row.headless));
    EXPECT_EQ(FaultLayer::anyCalls() - any, FaultLayer::destructions() - destroyed)
        << "asks a lost device";
    EXPECT_TRUE(row.destroys || FaultLayer::destructions() == destroyed);
  }
  EXPECT_TRUE(FaultLayer::live().empty());
}

TEST_F(DeviceLost, TheTableHasEveryExportedFunction) {
  std::ifstream file(WELKIN_SYMBOLS);
  std::set<std::string> exported;
  for (std::string line; std::getline(file, line);) {
    exported.insert(line.substr(0, line.find('@')));
  }
  EXPECT_GT(exported.size(), 60u);
  std::set<std::string> tabled;
  for (const LostRow& row : lostTable()) {
    EXPECT_TRUE(tabled.insert(row.name).second) << row.name << " stands there twice";
  }
  EXPECT_EQ(tabled, exported);
}

// Lives until `before` is reached for the `nth` time, and loses the device in `by`.
struct Place {
  const char* before;
  int nth;
  const char* by;
};

template <typename Some>
void loseAt(Some& life, Place place) {
  const std::vector<Step> steps = life.steps();
  for (const Step& step : steps) {
    if (std::string(step.entry) == place.before && --place.nth == 0) {
      break;
    }
    ASSERT_GE(step.call(), 0) << step.entry << ": " << lastError().message;
  }
  ASSERT_EQ(place.nth, 0) << place.before;
  const auto by = std::find_if(steps.begin(), steps.end(), [&](const Step& step) {
    return std::string(step.entry) == place.by;
  });
  FaultLayer::failAt(0, VK_ERROR_DEVICE_LOST, true);
  ASSERT_EQ(by->call(), WLK_ERROR_DEVICE_LOST) << place.by;
}

// In an upload after three frames, and in a preparation after a resize.
TEST_F(DeviceLost, AnEnginesContextAsksNothingButToDestroy) {
  Engine engine;
  for (const Place& place : {Place{"wlkVulkanForgetImage", 1, "wlkUploadVolume"},
                             Place{"wlkPrepare", 2, "wlkPrepare"}}) {
    SCOPED_TRACE(place.by);
    FaultLayer::failNever();
    Life life(engine, ALL, FaultLayer::getInstanceProcAddr());
    loseAt(life, place);
    LostObjects objects{&life.context, life.medium,  life.volume, life.second,
                        life.view,     life.surface, life.map};
    objects.image = EngineScene::describe(engine.field, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    // No command goes into it.
    objects.commands = reinterpret_cast<VkCommandBuffer>(uintptr_t{1});
    expectTable(objects, Mode::ENGINE);
    EXPECT_EQ(life.memory.live(), 0u);
  }
  EXPECT_TRUE(engine.spy.messages().empty()) << engine.spy.messages().front();
}

TEST_F(DeviceLost, AHeadlessContextAsksNothingButToDestroy) {
  const UnderFaultLayer layer;
  HeadlessLife life(true);
  loseAt(life, {"wlkReadback", 2, "wlkRenderHeadless"});
  LostObjects objects{&life.context, life.medium, life.volume, {}, life.view, {}, {}};
  objects.image = make<WlkVulkanImage>();
  objects.commands = reinterpret_cast<VkCommandBuffer>(uintptr_t{1});
  expectTable(objects, Mode::HEADLESS);
  EXPECT_EQ(life.memory.live(), 0u);
}

}  // namespace
}  // namespace welkin::test
