// SPDX-License-Identifier: MIT
// Commands, bytes and objects of frames, exactly those of golden.csv: a few scenes at each level,
// while they are prepared, in their first frame, in one like it, and in one whose sun, eye and
// volumes have moved. A steady frame makes nothing at all.
//
// After an intended change, from the repository's root:
//   rm tests/budget/golden.csv
//   export WELKIN_GOLDEN_BUDGETS=tests/budget/golden.csv
//   build/release/bin/welkin_budget --gtest_filter='*GoldenBudget*'
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"
#include "support/library_allocations.hpp"
#include "support/light_shadow.hpp"
#include "support/on_gpu.hpp"
#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr std::array LEVELS{"low", "medium", "high", "ultra"};
// Of lavapipe, whose alignments the memory has.
constexpr std::array FIGURES{"dispatches",       "draws",         "barriers",
                             "copies",           "objects",       "allocations",
                             "descriptorWrites", "bytesUploaded", "deviceMemory"};
using Figures = std::array<uint64_t, FIGURES.size()>;

Figures figuresOf(const VulkanCounts& counts, uint64_t uploaded, uint64_t memory) {
  return {counts.dispatches,       counts.draws,   counts.barriers,
          counts.copies,           counts.created, counts.allocated,
          counts.descriptorWrites, uploaded,       memory};
}

VulkanCounts sum(const FrameCounts& frame) {
  VulkanCounts all = frame.view;
  all.dispatches += frame.update.dispatches;
  all.draws += frame.update.draws;
  all.barriers += frame.update.barriers;
  all.copies += frame.update.copies;
  all.created += frame.update.created;
  all.destroyed += frame.update.destroyed;
  all.allocated += frame.update.allocated;
  all.descriptorWrites += frame.update.descriptorWrites;
  return all;
}

// "scene,level,frame" and its figures.
using Rows = std::map<std::string, Figures>;

Rows goldenRows() {
  std::ifstream file(WELKIN_BUDGET_FOLDER "/golden.csv");
  Rows rows;
  std::string line;
  std::getline(file, line);  // the names
  while (std::getline(file, line)) {
    size_t end = 0;
    for (int commas = 0; commas < 3; ++commas) {
      end = line.find(',', end) + 1;
    }
    Figures figures{};
    std::istringstream numbers(line.substr(end));
    for (uint64_t& one : figures) {
      numbers >> one;
      numbers.ignore();
    }
    rows.emplace(line.substr(0, end - 1), figures);
  }
  return rows;
}

// Against the file, or into the one that WELKIN_GOLDEN_BUDGETS names.
void settle(const std::string& key, const Figures& figures) {
  static const Rows GOLDEN = goldenRows();
  if (const char* path = std::getenv("WELKIN_GOLDEN_BUDGETS")) {
    std::ofstream file(path, std::ios::app);
    if (file.tellp() == std::ofstream::pos_type(0)) {
      file << "scene,level,frame";
      for (const char* name : FIGURES) {
        file << ',' << name;
      }
      file << '\n';
    }
    file << key;
    for (const uint64_t one : figures) {
      file << ',' << one;
    }
    file << '\n';
    return;
  }
  const auto found = GOLDEN.find(key);
  ASSERT_NE(found, GOLDEN.end()) << key << " is not in golden.csv";
  for (size_t i = 0; i < FIGURES.size(); ++i) {
    if (onGpu() && std::string_view(FIGURES[i]) == "deviceMemory") {
      continue;  // of lavapipe's alignments
    }
    EXPECT_EQ(figures[i], found->second[i]) << key << ": " << FIGURES[i];
  }
}

struct GoldenScene {
  const char* name;
  int volumes;
  bool fog;
  bool surface;
  int lights;
  bool outputs = false;
};
void PrintTo(const GoldenScene& scene, std::ostream* out) {
  *out << scene.name;
}

// All that a view may write beside its picture, and the engine's shadow map.
class Outputs {
 public:
  explicit Outputs(EngineScene& scene)
      : scene_(scene),
        radiance_(scene.device(), VK_FORMAT_R16G16B16A16_SFLOAT, FROXELS, STORED),
        transmittance_(scene.device(), VK_FORMAT_R16G16B16A16_SFLOAT, FROXELS, STORED),
        distance_(scene.device(), VK_FORMAT_R32G32_SFLOAT,
                  {scene.options().width, scene.options().height, 1}, STORED),
        shadow_(scene.device(), VK_FORMAT_R32_SFLOAT, {16, 16, 1}, VK_IMAGE_USAGE_SAMPLED_BIT) {
    auto aerial = make<WlkAerialPerspective>();
    aerial.width = FROXELS.width;
    aerial.height = FROXELS.height;
    aerial.depth = FROXELS.depth;
    check(wlkSetAerialPerspective(scene.context, scene.view, &aerial));
    check(wlkSetVolumeDistance(scene.context, scene.view, 1));
    LightFrame({0, 0, 0}, 5000, directionTo(30, 20))
        .write({0, 0, 0}, false, place_.clipFromWorld[0]);
    scene.lightShadow = &place_;
    scene.shadowMap = &images_[3];
    scene.addTargets = [this](WlkVulkanViewTargets& targets) {
      targets.aerialRadiance = images_.data();
      targets.aerialTransmittance = &images_[1];
      targets.volumeDistance = &images_[2];
    };
  }
  ~Outputs() {
    for (const SpyImage* image : {&radiance_, &transmittance_, &distance_, &shadow_}) {
      check(wlkVulkanForgetImage(scene_.context, image->handle));
    }
  }
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

 private:
  static constexpr VkExtent3D FROXELS{8, 6, 10};
  static constexpr VkImageUsageFlags STORED =
      VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  static WlkVulkanImage described(const SpyImage& image) {
    return EngineScene::describe(image, VK_IMAGE_LAYOUT_GENERAL);
  }
  EngineScene& scene_;
  SpyImage radiance_;
  SpyImage transmittance_;
  SpyImage distance_;
  SpyImage shadow_;
  std::array<WlkVulkanImage, 4> images_{described(radiance_), described(transmittance_),
                                        described(distance_), described(shadow_)};
  WlkLightShadow place_ = make<WlkLightShadow>();
};

class GoldenBudget : public ::testing::TestWithParam<GoldenScene> {
 protected:
  static void setLights(const EngineScene& scene, double elevation_deg) {
    if (GetParam().lights == 1) {
      scene.setSun(elevation_deg, 20);
    } else {
      std::array<WlkLight, 2> lights{make<WlkLight>(), make<WlkLight>()};
      lights[0].direction[1] = static_cast<float>(std::sin(elevation_deg * 0.017453));
      lights[0].direction[2] = -static_cast<float>(std::cos(elevation_deg * 0.017453));
      lights[1].direction[0] = 0.6f;
      lights[1].direction[1] = 0.8f;
      check(wlkSetLights(scene.context, 2, sizeof(WlkLight), lights.data()));
    }
  }
  static std::vector<WlkVolume> build(const EngineScene& scene) {
    scene.setSky();
    setLights(scene, 30);
    scene.setCamera({0, 2, 0}, 0, 12);
    if (GetParam().fog) {
      scene.setFog(1e-4f, 200.0f);
    }
    std::vector<WlkVolume> volumes;
    volumes.reserve(2);
    for (int i = 0; i < GetParam().volumes; ++i) {
      volumes.push_back(scene.addBall(i == 0 ? 0.01f : 0.002f));
    }
    if (GetParam().surface) {
      addSurface(scene, support::boxMesh(), scene.addMedium(), 0.01f, {900, 900, 900},
                 {0, 1500, -5000});
    }
    return volumes;
  }
  static void move(const EngineScene& scene, const std::vector<WlkVolume>& volumes, int step) {
    setLights(scene, 31 + step);
    scene.setCamera({10.0 * step, 2.5 + step, 0}, step, 12);
    for (size_t i = 0; i < volumes.size(); ++i) {
      const auto box = boxTransform({-900.0 + step, 500, -6000}, {2000, 2000, 2000});
      check(wlkSetVolumeTransform(scene.context, volumes[i], box.data()));
    }
  }
};

TEST_P(GoldenBudget, IsExactAtEveryLevel) {
  for (uint32_t level = WLK_QUALITY_LOW; level <= WLK_QUALITY_ULTRA; ++level) {
    CountingAllocator memory;
    SceneOptions options;
    options.width = 24;
    options.height = 16;
    options.level = level;
    options.volumeResolution = WLK_VOLUME_RESOLUTION_DEFAULT;
    options.ambient = true;
    options.validation = false;  // frames of other tests have it
    options.allocator = memory.callbacks();
    if (GetParam().outputs) {
      options.qualityFlags = WLK_QUALITY_FLAG_VOLUME_SHADOWS | WLK_QUALITY_FLAG_LIGHT_SHADOWS;
    }
    EngineScene scene(options);
    scene.submit = false;
    std::optional<Outputs> outputs;
    if (GetParam().outputs) {
      outputs.emplace(scene);
    }
    const std::string key = std::string(GetParam().name) + "," + LEVELS[level] + ",";
    const auto volumes = build(scene);
    check(wlkPrepare(scene.context));
    const VulkanCounts prepared = SpyDevice::counts();
    EXPECT_EQ(prepared.descriptorsShort, 0u) << key;
    const VulkanCounts first = sum(scene.renderFrame());
    const WlkFrameStats stats = scene.stats();
    settle(key + "prepare", figuresOf(prepared, 0, 0));
    settle(key + "first", figuresOf(first, stats.bytesUploaded, stats.deviceMemory));
    for (const char* name : {"steady", "moving"}) {
      const bool moves = std::string_view(name) == "moving";
      VulkanCounts frame;
      uint64_t before = 0;
      for (int i = 0; i <= WARM_UP; ++i) {
        if (moves) {
          move(scene, volumes, i);
        }
        before = memory.calls() + libraryAllocations();
        frame = sum(scene.renderFrame());
      }
      const WlkFrameStats now = scene.stats();
      settle(key + name, figuresOf(frame, now.bytesUploaded, now.deviceMemory));
      SCOPED_TRACE(key + name);
      EXPECT_EQ(frame.created + frame.destroyed + frame.allocated + frame.descriptorWrites, 0u);
      EXPECT_EQ(memory.calls() + libraryAllocations(), before) << "host allocations";
    }
  }
}

std::string nameOf(const ::testing::TestParamInfo<GoldenScene>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Of, GoldenBudget,
                         ::testing::Values(GoldenScene{"sky", 0, false, false, 1},
                                           GoldenScene{"fog", 0, true, false, 1},
                                           GoldenScene{"volume", 1, false, false, 1},
                                           GoldenScene{"volumes", 2, false, false, 1},
                                           GoldenScene{"surface", 0, false, true, 1},
                                           GoldenScene{"lights", 1, true, false, 2},
                                           GoldenScene{"outputs", 1, true, false, 1, true}),
                         nameOf);

}  // namespace
}  // namespace welkin::test
