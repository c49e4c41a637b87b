// SPDX-License-Identifier: MIT
// What a sun that moves 0.25 degrees per frame costs with WLK_SCATTERING_ALL_ORDERS, by
// WlkQuality::lightFrames, and how far the picture lies from the one whose light is computed at
// once. Level high, 256 x 256 pixels, CPU time of all threads; rows of Markdown.
// Usage: welkin_light_frames [LES.txt]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>
#include <welkin/welkin.hpp>

#include "bench/volume_clouds.hpp"

namespace {

constexpr uint32_t PIXELS = 256;
constexpr double STEP = 0.25 * 3.14159265358979323846 / 180;
constexpr uint32_t SHOTS = 3;      // frames whose pictures are compared
constexpr uint32_t MEASURED = 16;  // frames

struct Cloud {
  const char* name;
  uint32_t size[3];
  double edges[3];  // m
  std::vector<float> extinction;
};

double clock_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Frame {
  double cpu_ms = 0;
  uint64_t invocations = 0;  // of the volume's light
  uint32_t commands = 0;
};

class World {
 public:
  World(const Cloud& cloud, uint32_t lightFrames) {
    auto info = welkin::make<WlkContextInfo>();
    const auto headless = welkin::make<WlkHeadlessInfo>();
    info.next = &headless;
    welkin::check(context_.create(info));
    const auto medium = welkin::make<WlkMediumInfo>();
    WlkMedium made{};
    welkin::check(wlkCreateMedium(context_, &medium, &made));
    const WlkVolumeField field{made, 1, 0};
    auto volume = welkin::make<WlkVolumeInfo>();
    std::copy_n(cloud.size, 3, volume.size);
    volume.fieldCount = 1;
    volume.fields = &field;
    for (int i = 0; i < 3; ++i) {
      volume.worldFromVolume[5 * i] = cloud.edges[i];
      volume.worldFromVolume[4 * i + 3] = -0.5 * cloud.edges[i];
    }
    volume.worldFromVolume[11] -= 2.2 * cloud.edges[0];
    WlkVolume cloudVolume{};
    welkin::check(wlkCreateVolume(context_, &volume, &cloudVolume));
    auto upload = welkin::make<WlkVolumeUpload>();
    upload.format = WLK_FORMAT_R32_FLOAT;
    std::copy_n(cloud.size, 3, upload.extent);
    upload.data = cloud.extinction.data();
    upload.dataSize = cloud.extinction.size() * sizeof(float);
    welkin::check(wlkUploadVolume(context_, cloudVolume, &upload));
    auto view = welkin::make<WlkViewInfo>();
    view.width = view.height = PIXELS;
    view.layers = WLK_LAYER_VOLUMES;
    welkin::check(wlkCreateView(context_, &view, &view_));
    auto camera = welkin::make<WlkCamera>();
    camera.clipFromView[0] = 3;
    camera.clipFromView[5] = -3;
    welkin::check(wlkSetCamera(context_, view_, &camera));
    auto quality = welkin::make<WlkQuality>();
    quality.scattering = WLK_SCATTERING_ALL_ORDERS;
    quality.lightFrames = lightFrames;
    welkin::check(wlkSetQuality(context_, view_, &quality));
    shine(0);
    welkin::check(wlkPrepare(context_));
  }
  // From the side and above, on its way behind the eye.
  void shine(double steps) {
    const double azimuth = 0.9 + steps * STEP;
    auto light = welkin::make<WlkLight>();
    light.direction[0] = static_cast<float>(0.8 * std::sin(azimuth));
    light.direction[1] = 0.6f;
    light.direction[2] = static_cast<float>(-0.8 * std::cos(azimuth));
    welkin::check(wlkSetLights(context_, 1, sizeof light, &light));
  }
  Frame frame() {
    const double begin = clock_ms();
    welkin::check(wlkRenderHeadless(context_, view_, nullptr));
    Frame frame;
    frame.cpu_ms = clock_ms() - begin;
    auto stats = welkin::make<WlkFrameStats>();
    WlkPassStats passes[16];
    uint32_t count = 16;
    welkin::check(wlkGetFrameStats(context_, view_, &stats, &count, sizeof(WlkPassStats), passes));
    for (uint32_t i = 0; i < count; ++i) {
      if (passes[i].pass == WLK_PASS_VOLUME_LIGHT) {
        frame.invocations += passes[i].invocations;
        frame.commands += passes[i].commands;
      }
    }
    return frame;
  }
  std::vector<float> picture() {
    std::vector<float> rgba(size_t{PIXELS} * PIXELS * 4);
    auto data = welkin::make<WlkImageData>();
    data.data = rgba.data();
    data.dataSize = rgba.size() * sizeof(float);
    welkin::check(wlkReadback(context_, view_, &data));
    return rgba;
  }

 private:
  welkin::Context context_;
  WlkView view_{};
};

double apart(const std::vector<float>& a, const std::vector<float>& truth) {
  double difference = 0;
  double all = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    if (i % 4 != 3) {
      const auto value = static_cast<double>(truth[i]);
      difference += (static_cast<double>(a[i]) - value) * (static_cast<double>(a[i]) - value);
      all += value * value;
    }
  }
  return std::sqrt(difference / all);
}

double frameOf(uint32_t shot) {
  return 48 + shot * (MEASURED - 1.0) / (SHOTS - 1);
}

void measure(const Cloud& cloud) {
  World still(cloud, 1);
  std::vector<std::vector<float>> truth;
  for (uint32_t shot = 0; shot < SHOTS; ++shot) {
    still.shine(std::floor(frameOf(shot)));
    still.frame();
    truth.push_back(still.picture());
  }
  double kept = 1e30;
  for (int i = 0; i < 4; ++i) {
    kept = std::min(kept, still.frame().cpu_ms);
  }
  for (const uint32_t frames : {1u, 8u, 16u}) {
    World world(cloud, frames);
    const uint32_t begin = frames == 1 ? 46 : 48 - 3 * frames;
    world.shine(begin);
    world.frame();
    std::vector<Frame> measured;
    double error = 0;
    for (uint32_t i = begin + 1; i < 48 + MEASURED; ++i) {
      world.shine(i);
      const Frame frame = world.frame();
      for (uint32_t shot = 0; shot < SHOTS; ++shot) {
        if (i == static_cast<uint32_t>(frameOf(shot))) {
          error = std::max(error, apart(world.picture(), truth[shot]));
        }
      }
      // In-between frames of light at once say the same as the first of them.
      if (i >= 48 && (frames > 1 || i < 54 || i + 1 == 48 + MEASURED)) {
        measured.push_back(frame);
      }
      if (frames == 1 && i == 53) {
        break;
      }
    }
    double sum = 0;
    double worst = 0;
    uint64_t invocations = 0;
    uint64_t most = 0;
    uint32_t commands = 0;
    for (const Frame& frame : measured) {
      const double light = std::max(frame.cpu_ms - kept, 0.0);
      sum += light;
      worst = std::max(worst, light);
      invocations += frame.invocations;
      most = std::max(most, frame.invocations);
      commands = std::max(commands, frame.commands);
    }
    const auto count = static_cast<double>(measured.size());
    std::printf("| %s | %u | %.0f | %.0f | %.2f | %.2f | %u | %.1f %% |\n", cloud.name, frames,
                sum / count, worst, 1e-6 * static_cast<double>(invocations) / count,
                1e-6 * static_cast<double>(most), commands, 100 * error);
    std::fflush(stdout);
  }
  std::printf("frame without light: %.0f ms\n", kept);
}

}  // namespace

int main(int argc, char** argv) {
  std::printf(
      "| cloud | lightFrames | light, mean ms | worst ms | invocations, mean M | worst M | "
      "commands at most | rms |\n|---|---|---|---|---|---|---|---|\n");
  measure({"cumulus", {96, 72, 96}, {2400, 1800, 2400}, bench::cumulusExtinction()});
  if (argc > 1) {
    measure({"LES", {32, 26, 37}, {640, 1040, 740}, bench::lesExtinction(argv[1])});
  }
  return 0;
}
