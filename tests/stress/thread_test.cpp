// SPDX-License-Identifier: MIT
// The thread classes of welkin.h: [F] from any thread at any time, [C] from one thread at a time
// per context. What threads get beside each other is, bit for bit, what one gets alone. The preset
// `tsan` (tools/test --tsan) runs the same under ThreadSanitizer.
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "stress/abuse.hpp"
#include "stress/in_threads.hpp"
#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr size_t THREADS = 4;

// Functions of class [F], whose last error is the thread's own. True if all is as documented.
bool freeFunctionsHold(size_t thread) {
  auto light = make<WlkLight>();
  const float toSun[3] = {0, 1, 0};
  const float toMoon[3] = {0, 0, 1};
  const float irradiance[3] = {1, 1, 1};
  bool holds = wlkGetVersion() == WLK_API_VERSION &&
               wlkInitMoon(toSun, toMoon, irradiance, &light) == WLK_SUCCESS;
  auto sky = make<WlkSky>();
  holds = holds &&
          wlkInitPresetStruct(WLK_ATMOSPHERE_MARS, WLK_STRUCT_SKY, sizeof sky, &sky) == WLK_SUCCESS;
  // Even threads fail in one way, odd ones in another.
  const WlkResult failed = thread % 2 == 0 ? wlkInitStruct(9999, sizeof sky, &sky)
                                           : wlkInitMoon(nullptr, toMoon, irradiance, &light);
  std::this_thread::yield();
  auto info = make<WlkErrorInfo>();
  return holds && failed < 0 && wlkGetLastError(&info) == WLK_SUCCESS && info.result == failed &&
         (std::strcmp(info.field, "toSun") == 0) == (thread % 2 != 0) &&
         std::strcmp(wlkResultName(failed), "WLK_UNKNOWN_RESULT") != 0;
}

// Everything that a context without a device answers, for an atmosphere that `seed` chooses.
std::vector<double> answers(size_t seed) {
  std::vector<double> all;
  const CpuContext cpu;
  auto sky = make<WlkSky>();
  sky.scaleHeight = 7000.0f + 500.0f * static_cast<float>(seed % 3);
  check(wlkSetSky(cpu.context, &sky));
  auto light = make<WlkLight>();
  check(wlkSetLights(cpu.context, 1, sizeof light, &light));
  for (const uint32_t particle : {WLK_PARTICLE_CLOUD, WLK_PARTICLE_HAZE, WLK_PARTICLE_ICE_COLUMN}) {
    auto info = make<WlkMediumInfo>();
    info.particle = particle;
    WlkMedium medium{};
    check(wlkCreateMedium(cpu.context, &info, &medium));
    const double angles[3] = {0.01, 1.0, 3.0};
    auto query = make<WlkPhaseQuery>();
    query.medium = medium;
    query.count = 3;
    query.scatteringAngle = angles;
    query.orderKind = WLK_ORDER_POISSON;
    double phase[9] = {};
    check(wlkEvalPhase(cpu.context, &query, phase));
    all.insert(all.end(), phase, phase + 9);
  }
  const WlkRay ray{{0, 2, 0}, {0.6, 0.8, 0}, 1e5};
  auto batch = make<WlkRayBatch>();
  batch.count = 1;
  batch.rays = &ray;
  double radiance[3] = {};
  double transmittance[3] = {};
  check(wlkEvalSky(cpu.context, &batch, radiance, transmittance));
  all.insert(all.end(), radiance, radiance + 3);
  all.insert(all.end(), transmittance, transmittance + 3);
  double harmonics[WLK_AMBIENT_VALUES] = {};
  check(wlkEvalAmbient(cpu.context, ray.origin, harmonics));
  all.insert(all.end(), harmonics, harmonics + WLK_AMBIENT_VALUES);
  auto map = make<WlkSkyMapQuery>();
  map.size = 4;
  float rgb[4 * 4 * 3] = {};
  check(wlkEvalSkyMap(cpu.context, &map, rgb, sizeof rgb));
  all.insert(all.end(), rgb, rgb + std::size(rgb));
  return all;
}

TEST(Threads, ContextsOfTheirOwnAnswerAsAlone) {
  std::vector<std::vector<double>> found(THREADS);
  std::atomic<size_t> wrong{0};
  // First together: tables that are made once for all have to be made by several at a time.
  inThreads(THREADS, [&](size_t i) {
    for (int n = 0; n < 100; ++n) {
      wrong += freeFunctionsHold(i) ? 0U : 1U;
    }
    found[i] = answers(i);
    wrong += freeFunctionsHold(i) ? 0U : 1U;
  });
  EXPECT_EQ(wrong.load(), 0u);
  for (size_t i = 0; i < THREADS; ++i) {
    EXPECT_EQ(found[i], answers(i)) << "thread " << i;
  }
}

// Two views of one scene with a cloud surface that grows, drawn one after the other, twice.
std::vector<Image> pictures(size_t seed) {
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  options.validation = false;  // it has threads and locks of its own
  HeadlessScene scene(options);
  scene.setSky();
  scene.setFog(2e-4f, 300.0f);
  scene.setSun(30.0 + 10.0 * static_cast<double>(seed), 40);
  scene.addBall(0.005f);
  const WlkSurface surface = addSurface(scene, support::boxMesh(), scene.addHenyeyGreenstein(0.7f),
                                        0.01f, {100, 100, 100}, {300, 400, -1500});
  scene.setCamera({0, 2, 0}, 0, 12);
  const WlkView first = scene.view;
  const WlkView second = scene.addView(options);
  std::vector<Image> all;
  for (int frame = 0; frame < 2; ++frame) {
    setScaledPositions(scene, surface, support::boxMesh(), 1.0f + 0.1f * static_cast<float>(frame));
    for (const WlkView view : {first, second}) {
      scene.view = view;
      all.push_back(scene.render());
    }
  }
  return all;
}

TEST(Threads, ContextsOfTheirOwnDrawAsAlone) {
  constexpr size_t CONTEXTS = 2;
  std::vector<std::vector<Image>> drawn(CONTEXTS);
  inThreads(CONTEXTS, [&](size_t i) { drawn[i] = pictures(i); });
  for (size_t i = 0; i < CONTEXTS; ++i) {
    EXPECT_TRUE(drawn[i] == pictures(i)) << "context " << i;
  }
}

TEST(Threads, AContextMayPassFromOneToTheOther) {
  const CpuContext cpu;
  std::mutex turn;
  std::atomic<size_t> wrong{0};
  inThreads(THREADS, [&](size_t i) {
    for (int n = 0; n < 50; ++n) {
      const std::lock_guard lock(turn);
      auto sky = make<WlkSky>();
      sky.scaleHeight = 5000.0f + 1000.0f * static_cast<float>(i);
      WlkMedium medium{};
      auto info = make<WlkMediumInfo>();
      info.particle = WLK_PARTICLE_AIR;
      const double from[3] = {0, 0, 0};
      const double to[3] = {0, 1e5, 0};
      double through[3] = {};
      const bool worked = wlkSetSky(cpu.context, &sky) == WLK_SUCCESS &&
                          wlkCreateMedium(cpu.context, &info, &medium) == WLK_SUCCESS &&
                          wlkEvalTransmittance(cpu.context, from, to, through) == WLK_SUCCESS &&
                          wlkDestroyMedium(cpu.context, medium) == WLK_SUCCESS;
      // Straight up: e^(-scattering times scale height), within the 0.2 % of the depth.
      const double depth = double{sky.rayleighScattering[2]} * double{sky.scaleHeight};
      wrong += worked && std::abs(-std::log(through[2]) / depth - 1.0) < 0.01 ? 0U : 1U;
    }
  });
  EXPECT_EQ(wrong.load(), 0u);
}

}  // namespace
}  // namespace welkin::test
