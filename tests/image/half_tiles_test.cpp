// SPDX-License-Identifier: MIT
// Volumes with empty bricks, rays in some pixels: pixels in tiles in which no ray saw anything are
// left out. Bit for bit the picture of frames that skip nothing, whose rays do not leap either.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t VOXELS = 48;  // along an edge: 6 bricks
// Neither a multiple of the tiles' 16 pixels nor even.
constexpr uint32_t WIDTH = 203;
constexpr uint32_t HEIGHT = 157;

// Two balls in opposite corners of the box, half of them outside, one voxel alone and a column of
// them along an edge of the box.
std::vector<float> sparse() {
  std::vector<float> values(size_t{VOXELS} * VOXELS * VOXELS, 0.0f);
  for (size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i % VOXELS);
    const double y = static_cast<double>(i / VOXELS % VOXELS);
    const double z = static_cast<double>(i / VOXELS / VOXELS);
    const double r = std::min(std::hypot(x - 6, y - 8, z - 24), std::hypot(x - 42, y - 44, z - 10));
    values[i] = static_cast<float>(std::clamp(1.5 - r / 6, 0.0, 1.0));
  }
  values[(size_t{30} * VOXELS + 12) * VOXELS + 33] = 1.0f;
  for (size_t y = 10; y < 30; ++y) {
    values[y * VOXELS + VOXELS - 1] = 1.0f;
  }
  return values;
}

SceneOptions halfWith(uint64_t flags) {
  SceneOptions o;
  o.width = WIDTH;
  o.height = HEIGHT;
  o.scattering = WLK_SCATTERING_FORWARD;
  o.volumeResolution = WLK_VOLUME_RESOLUTION_HALF;
  o.qualityFlags = flags;
  o.volumeCells = 16;  // the light inside is not what tiles change
  return o;
}

void addSparse(const SceneBuilder& scene, const std::array<double, 3>& lo, double edge) {
  const std::array<uint32_t, 3> size{VOXELS, VOXELS, VOXELS};
  const WlkVolume volume = scene.addVolume(scene.addHenyeyGreenstein(0.6f), size,
                                           boxTransform(lo, {edge, edge, edge}), 0.01f);
  scene.upload(volume, size, sparse());
}

// Voxels of 2.1 pixels at the far end, where rays begin with every fourth pixel, and of 1.1, where
// they do with every second one.
constexpr std::array<double, 3> COARSE{-2250, -2250, -5200};
constexpr double COARSE_EDGE = 4500;
constexpr std::array<double, 3> FINE{-300, -1300, -4500};
constexpr double FINE_EDGE = 2000;
constexpr std::array<double, 3> NARROW{-600, -200, -3000};  // of a third of a pixel
constexpr double NARROW_EDGE = 400;

struct Case {
  const char* name;
  bool sky;
  uint32_t scattering;
  void (*add)(const SceneBuilder&);
};

const std::array CASES{
    Case{"every fourth", false, WLK_SCATTERING_FORWARD,
         [](const SceneBuilder& s) { addSparse(s, COARSE, COARSE_EDGE); }},
    Case{"every second", false, WLK_SCATTERING_FORWARD,
         [](const SceneBuilder& s) { addSparse(s, FINE, FINE_EDGE); }},
    Case{"narrow", false, WLK_SCATTERING_SINGLE,
         [](const SceneBuilder& s) { addSparse(s, NARROW, NARROW_EDGE); }},
    Case{"all orders, air", true, WLK_SCATTERING_ALL_ORDERS,
         [](const SceneBuilder& s) { addSparse(s, COARSE, COARSE_EDGE); }},
    Case{"two, sparse behind", true, WLK_SCATTERING_SINGLE,
         [](const SceneBuilder& s) {
           addSparse(s, COARSE, COARSE_EDGE);
           s.addBall(0.002f);
         }},
    Case{"two, sparse in front", false, WLK_SCATTERING_SINGLE,
         [](const SceneBuilder& s) {
           addSparse(s, {-700, -700, -3000}, 1400);
           addSparse(s, {-2000, -2000, -9000}, 4000);
         }},
    Case{"inside", true, WLK_SCATTERING_SINGLE,
         [](const SceneBuilder& s) {
           addSparse(s, {-1500, -1500, -2000}, COARSE_EDGE);
         }},
};

Image picture(const Case& c, uint64_t flags, const WlkHeadlessInputs* targets = nullptr) {
  SceneOptions o = halfWith(flags);
  o.scattering = c.scattering;
  HeadlessScene scene(o);
  scene.setSun(40, 60);
  scene.setCamera({0, 0, 0}, 0, 0);
  if (c.sky) {
    scene.setSky();
  }
  c.add(scene);
  Image image = scene.render(targets);
  EXPECT_EQ(image.badValues(), 0u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  return image;
}

size_t blackPixels(const Image& image) {
  size_t count = 0;
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    count += image.rgba[i] == 0.0f ? size_t{1} : 0;
  }
  return count;
}

TEST(HalfTiles, LeaveThePictureAsItIs) {
  for (const Case& c : CASES) {
    SCOPED_TRACE(c.name);
    const Image skipping = picture(c, 0);
    EXPECT_TRUE(skipping == picture(c, WLK_QUALITY_FLAG_NO_SKIP));
    if (!c.sky) {
      EXPECT_GT(blackPixels(skipping), size_t{WIDTH} * HEIGHT / 4) << "tiles to leave out";
      EXPECT_LT(blackPixels(skipping), size_t{WIDTH} * HEIGHT - 50) << "something to see";
    }
  }
}

// Where there is a surface.
enum class Wall { NOWHERE, BARS, DOTS, HOLES };

bool wallAt(Wall wall, uint32_t x, uint32_t y) {
  switch (wall) {
    case Wall::BARS:
      return x % 37 == 5 || y % 41 < 3 || (x % 7 == 3 && y % 9 == 2) || (x < 60 && y > 90);
    case Wall::DOTS:  // on no ray of every second pixel
      return x % 10 == 3 && y % 6 == 5;
    case Wall::HOLES:  // likewise
      return x % 10 != 3 || y % 7 != 3;
    default:
      return false;
  }
}

// Behind bars, dots and in holes lies another part of the cloud, or nothing.
TEST(HalfTiles, LeaveThePictureBehindSurfacesAsItIs) {
  constexpr float NEAR = 0.1f;  // of the default camera: depth = near / distance along the view
  for (const auto& [distance, wall] :
       {std::pair{1.0f, Wall::NOWHERE}, std::pair{500.0f, Wall::BARS},
        std::pair{3000.0f, Wall::BARS}, std::pair{2900.0f, Wall::DOTS},
        std::pair{500.0f, Wall::HOLES}}) {
    std::vector<float> depth(size_t{WIDTH} * HEIGHT, 0.0f);
    for (uint32_t i = 0; i < depth.size(); ++i) {
      depth[i] = wallAt(wall, i % WIDTH, i / WIDTH) ? NEAR / distance : 0.0f;
    }
    auto targets = make<WlkHeadlessInputs>();
    targets.depth = depth.data();
    targets.depthSize = depth.size() * sizeof(float);
    for (const Case& c : std::span(CASES).first(4)) {
      SCOPED_TRACE(c.name);
      const Image skipping = picture(c, 0, &targets);
      EXPECT_TRUE(skipping == picture(c, WLK_QUALITY_FLAG_NO_SKIP, &targets))
          << distance << " " << static_cast<int>(wall);
      if (wall == Wall::HOLES) {
        EXPECT_GT(skipping.mean(), 0.0) << "through holes that no other ray goes through";
      }
    }
  }
}

// A column of voxels at the box's silhouette, between rays of every second pixel, in views with a
// depth image: rays that miss the box end elsewhere than those beside them, and see as little.
TEST(HalfTiles, LeaveThePictureAtTheBoxsSilhouetteAsItIs) {
  HeadlessScene scene(halfWith(0));
  HeadlessScene all(halfWith(WLK_QUALITY_FLAG_NO_SKIP));
  const std::vector<float> depth(size_t{WIDTH} * HEIGHT, 0.0f);
  auto targets = make<WlkHeadlessInputs>();
  targets.depth = depth.data();
  targets.depthSize = depth.size() * sizeof(float);
  constexpr std::array<uint32_t, 3> SIZE{256, 24, 8};  // of 8 m
  std::vector<float> values(size_t{256} * 24 * 8, 0.0f);
  std::fill_n(values.begin(), 8, 1.0f);  // so that something is seen in other tiles
  for (size_t y = 4; y < 20; ++y) {
    values[(7 * 24 + y) * 256 + 255] = 1.0f;
  }
  for (const HeadlessScene* s : {&scene, &all}) {
    s->setSun(40, 60);
    const WlkVolume volume =
        s->addVolume(s->addHenyeyGreenstein(0.6f), SIZE,
                     boxTransform({-1748, -96, -3000}, {2048, 192, 64}), 0.01f);
    s->upload(volume, SIZE, values);
  }
  for (int i = 0; i < 16; ++i) {
    const std::array<double, 3> eye{3.0 * i, 0, 0};  // pixels are 22 m apart there
    scene.setCamera(eye, 0, 0);
    all.setCamera(eye, 0, 0);
    EXPECT_TRUE(scene.render(&targets) == all.render(&targets)) << i;
  }
}

// What earlier frames left in tiles, lists and counters is not taken for this one's.
TEST(HalfTiles, KnowNothingOfTheFrameBefore) {
  HeadlessScene scene(halfWith(0));
  HeadlessScene fresh(halfWith(WLK_QUALITY_FLAG_NO_SKIP));
  for (const HeadlessScene* s : {&scene, &fresh}) {
    s->setSun(40, 60);
    addSparse(*s, COARSE, COARSE_EDGE);
  }
  for (int i = 0; i < 6; ++i) {
    const std::array<double, 3> eye{500.0 * (i % 3) - 400, 250.0 * (i % 2), -900.0 * (i % 4)};
    scene.setCamera(eye, 9.0 * i - 20, 4.0 * i - 8);
    fresh.setCamera(eye, 9.0 * i - 20, 4.0 * i - 8);
    EXPECT_TRUE(scene.render() == fresh.render()) << i;
  }
}

// A blended frame without air, fog or other layers: draws the tiles alone.
struct BlendScene : EngineScene {
  explicit BlendScene(uint64_t flags, uint64_t layers = WLK_LAYER_ALL & ~uint64_t{WLK_LAYER_SKY})
      : EngineScene(blended(flags, layers)) {
    setSky();  // a layer that the view leaves out
    setSun(40, 60);
    setCamera({0, 0, 0}, 0, 0);
    addSparse(*this, COARSE, COARSE_EDGE);
  }
  ~BlendScene() { EXPECT_TRUE(device().messages().empty()) << device().messages().front(); }
  static SceneOptions blended(uint64_t flags, uint64_t layers) {
    SceneOptions o = halfWith(flags);
    o.composite = WLK_COMPOSITE_BLEND;
    o.layers = layers;
    return o;
  }
  FrameCounts frame() {
    check(wlkPrepare(context));
    return renderFrame();
  }
  WlkPassStats pass(uint32_t kind) const {
    for (const WlkPassStats& p : passes()) {
      if (p.pass == kind) {
        return p;
      }
    }
    return {};
  }
};

TEST(HalfTiles, AreAllThatIsBlendedWhereNothingElseIsSeen) {
  BlendScene skipping(0);
  BlendScene all(WLK_QUALITY_FLAG_NO_SKIP);
  // The second frame lies over the first one: transmittance shows. The third one is of another eye.
  for (int i = 0; i < 3; ++i) {
    const std::array<double, 3> eye{i < 2 ? 0.0 : -700.0, 0, i < 2 ? 0.0 : 800.0};
    skipping.setCamera(eye, 0, 0);
    all.setCamera(eye, 0, 0);
    const FrameCounts counts = skipping.frame();
    all.frame();
    const Image image = skipping.read();
    EXPECT_EQ(image.badValues(), 0u);
    EXPECT_TRUE(image == all.read()) << i;
    EXPECT_EQ(counts.view.draws, 1u);
    EXPECT_EQ(skipping.stats().draws, 1u);
  }
  EXPECT_GT(blackPixels(skipping.read()), size_t{WIDTH} * HEIGHT / 4);
  EXPECT_EQ(skipping.pass(WLK_PASS_COMPOSITE).invocations, 0u) << "of pixels that nobody counts";
  EXPECT_GT(all.pass(WLK_PASS_COMPOSITE).invocations, 0u);
  EXPECT_LE(all.pass(WLK_PASS_COMPOSITE).invocations, uint64_t{WIDTH} * HEIGHT);
}

// With air in front of everything, a second volume or a volume without empty bricks all pixels of
// them are drawn.
TEST(HalfTiles, AreNotAllThatIsBlendedWhereOthersAreSeen) {
  BlendScene air(0, WLK_LAYER_ALL);
  air.frame();
  EXPECT_EQ(air.pass(WLK_PASS_COMPOSITE).invocations, uint64_t{WIDTH} * HEIGHT);
  BlendScene airAll(WLK_QUALITY_FLAG_NO_SKIP, WLK_LAYER_ALL);
  airAll.frame();
  EXPECT_TRUE(air.read() == airAll.read());

  BlendScene two(0);
  BlendScene twoAll(WLK_QUALITY_FLAG_NO_SKIP);
  for (BlendScene* s : {&two, &twoAll}) {
    addSparse(*s, {-900, -1000, -3000}, 900);
    s->frame();
  }
  EXPECT_GT(two.pass(WLK_PASS_COMPOSITE).invocations, 0u);
  EXPECT_TRUE(two.read() == twoAll.read());
}

// Grid, spread and list of second pixels, tiles, spread and list of pixels; one more clears the
// other tiles where the whole picture is composited. Spreads on a list are not counted.
TEST(HalfTiles, RecordWhatTheyNeed) {
  BlendScene tiles(0);
  tiles.frame();
  EXPECT_EQ(tiles.pass(WLK_PASS_EYE_SLICES).commands, 6u);
  BlendScene air(0, WLK_LAYER_ALL);
  air.frame();
  EXPECT_EQ(air.pass(WLK_PASS_EYE_SLICES).commands, 7u);
  BlendScene all(WLK_QUALITY_FLAG_NO_SKIP);
  all.frame();
  EXPECT_EQ(all.pass(WLK_PASS_EYE_SLICES).commands, 5u);
  EXPECT_LT(tiles.pass(WLK_PASS_EYE_SLICES).invocations, all.pass(WLK_PASS_EYE_SLICES).invocations);
}

// Distance and part hidden, after a frame of another eye whose values have to go.
std::vector<float> distancesOf(BlendScene& scene) {
  check(wlkSetVolumeDistance(scene.context, scene.view, 1));
  SpyImage image(scene.device(), VK_FORMAT_R32G32_SFLOAT, {WIDTH, HEIGHT, 1},
                 VK_IMAGE_USAGE_STORAGE_BIT);
  const WlkVulkanImage described = scene.describe(image, VK_IMAGE_LAYOUT_GENERAL);
  std::memset(image.bytes(), 0x3c, size_t{8} * WIDTH * HEIGHT);
  image.write(VK_IMAGE_LAYOUT_GENERAL);
  scene.addTargets = [&](WlkVulkanViewTargets& targets) { targets.volumeDistance = &described; };
  for (const double x : {600.0, 0.0}) {
    scene.setCamera({x, 0, 0}, 0, 0);
    scene.frame();
  }
  image.read(VK_IMAGE_LAYOUT_GENERAL);
  check(wlkVulkanForgetImage(scene.context, image.handle));
  const auto* values = static_cast<const float*>(image.bytes());
  return {values, values + size_t{2} * WIDTH * HEIGHT};
}

// Where the view tells its volumes' distance, tiles that are left out say that there is nothing.
TEST(HalfTiles, TellOfNoDistanceWhereNothingIsSeen) {
  BlendScene tiles(0);
  BlendScene all(WLK_QUALITY_FLAG_NO_SKIP);
  const std::vector<float> found = distancesOf(tiles);
  const std::vector<float> truth = distancesOf(all);
  EXPECT_EQ(std::memcmp(found.data(), truth.data(), found.size() * sizeof(float)), 0);
  EXPECT_GT(std::count(found.begin(), found.end(), 0.0f), ptrdiff_t{WIDTH} * HEIGHT / 4);
  EXPECT_EQ(tiles.pass(WLK_PASS_EYE_SLICES).commands, 7u);
  EXPECT_EQ(all.pass(WLK_PASS_EYE_SLICES).commands, 5u);
}

}  // namespace
}  // namespace welkin::test
