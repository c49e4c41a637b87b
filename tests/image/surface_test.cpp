// SPDX-License-Identifier: MIT
// Pictures of cloud surfaces: what they hide is the exact chord, whatever the eye, the order and
// the age of the mesh; frames repeat; what is unchanged is not computed again.
#include <gtest/gtest.h>

#include <cmath>

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr float EXTINCTION = 8e-4f;
constexpr std::array<double, 3> MIDDLE{100, 900, -4000};
constexpr std::array<double, 3> HALF{700, 500, 900};

SceneOptions separate() {
  SceneOptions options;
  options.composite = WLK_COMPOSITE_SEPARATE;
  return options;
}

// Of many pixels or triangles.
SceneOptions quick(uint32_t width, uint32_t height) {
  SceneOptions options = separate();
  options.width = width;
  options.height = height;
  options.validation = false;
  return options;
}

class SurfaceImage : public ::testing::Test {
 protected:
  ~SurfaceImage() override {
    for (const std::string& message : scene.messages()) {
      ADD_FAILURE() << message;
    }
  }

  // Isotropic: there is no forward peak to take off.
  WlkSurface addBox(const std::array<double, 3>& scale = HALF,
                    const std::array<double, 3>& middle = MIDDLE) const {
    return addSurface(scene, support::boxMesh(), scene.addHenyeyGreenstein(0), EXTINCTION, scale,
                      middle);
  }

  // Length of a ray in the box, up to `wall` from the eye.
  static double chord(const glm::dvec3& eye, const glm::dvec3& ray, double wall) {
    double begin = 0;
    double end = wall;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<size_t>(i);
      const double a = (MIDDLE[axis] - HALF[axis] - eye[i]) / ray[i];
      const double b = (MIDDLE[axis] + HALF[axis] - eye[i]) / ray[i];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return std::max(end - begin, 0.0);
  }

  // Transmittances against the exact ones; counts pixels that the box covers.
  int expectChords(const glm::dvec3& eye, const WlkHeadlessInputs* targets = nullptr,
                   double wallDepth = 1e30) const {
    // Two roundings to steps of 2^-20 of the box's depth, 2 km, and of floats at 5 km.
    constexpr double LENGTH = 2 * (2000 * std::exp2(-20) + 5000 * 8 * 6e-8);
    scene.setCamera({eye.x, eye.y, eye.z}, 0, 0);
    scene.render(targets);
    const Image image = scene.read(WLK_IMAGE_TRANSMITTANCE);
    int covered = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x) {
        const glm::dvec3 ray = pixelDirection(scene, x, y);
        const double length = chord(eye, ray, wallDepth / -ray.z);
        covered += length > 0 ? 1 : 0;
        EXPECT_NEAR(image.at(x, y)[0], std::exp(-static_cast<double>(EXTINCTION) * length),
                    static_cast<double>(EXTINCTION) * LENGTH + 4e-6)
            << x << ' ' << y;
      }
    }
    return covered;
  }

  const WlkPassStats pass(uint32_t kind) const {
    for (const WlkPassStats& one : scene.passes()) {
      if (one.pass == kind) {
        return one;
      }
    }
    ADD_FAILURE() << "no such pass";
    return {};
  }

  HeadlessScene scene{separate()};
};

TEST_F(SurfaceImage, HidesByTheExactChord) {
  addBox();
  EXPECT_GT(expectChords({0, 2, 0}), 30);
  EXPECT_GT(expectChords({0, 900, -4000}), 600);   // inside
  EXPECT_GT(expectChords({0, 1500, -3000}), 100);  // beside a face
  EXPECT_EQ(expectChords({0, 900, -8000}), 0);     // behind it
}

TEST_F(SurfaceImage, EndsAtOpaqueSurfaces) {
  addBox();
  const auto camera = make<WlkCamera>();
  constexpr double WALL = 3800;  // through the box
  const auto* m = camera.clipFromView;
  const double depth = (static_cast<double>(m[10]) * -WALL + static_cast<double>(m[14])) /
                       (static_cast<double>(m[11]) * -WALL + static_cast<double>(m[15]));
  const std::vector<float> pixels(size_t{scene.options().width} * scene.options().height,
                                  static_cast<float>(depth));
  auto targets = make<WlkHeadlessInputs>();
  targets.depth = pixels.data();
  targets.depthSize = pixels.size() * sizeof(float);
  EXPECT_GT(expectChords({0, 2, 0}, &targets, WALL), 30);
}

// Pixels of a picture from between the tips of a body of needles, so wide that nowhere in view is
// it less than nine tenths as thick as between them, in which it is thinner.
int thinPixels(const support::ClosedMesh& needles, const HeadlessScene& scene, double wide) {
  constexpr double HEIGHT = 500;
  addSurface(scene, needles, scene.addHenyeyGreenstein(0), EXTINCTION, {wide, wide, HEIGHT},
             {0, 0, -3000});
  scene.setCamera({0, 0, 0}, 0, 0);
  scene.render();
  const Image image = scene.read(WLK_IMAGE_TRANSMITTANCE);
  int thin = 0;
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      thin += image.at(x, y)[0] > std::exp(-0.9 * 2 * HEIGHT * EXTINCTION) ? 1 : 0;
    }
  }
  return thin;
}

// Triangles that are thin but whose boxes are a quarter of the picture: drivers such as lavapipe
// end a workgroup without a word after 65535 rounds of its loops.
TEST_F(SurfaceImage, HasAllOfNeedles) {
  EXPECT_EQ(thinPixels(support::needleMesh(2560), HeadlessScene(quick(1280, 720)), 5e4), 0);
}

// More large triangles than the list of them has room for, in a picture of few pixels: most of the
// needles have boxes of 160 by 112 pixels or more, and those beyond the list are shared by their
// neighbours.
TEST_F(SurfaceImage, HasAllOfMoreNeedlesThanListed) {
  constexpr double NARROW = 0.1;  // the body's shape along the picture's other diagonal
  support::ClosedMesh mesh = support::needleMesh(20000);
  for (glm::dvec3& p : mesh.position) {
    p = {p.x - NARROW * p.y, p.x + NARROW * p.y, p.z};
  }
  EXPECT_EQ(thinPixels(mesh, HeadlessScene(quick(320, 320)), 5e5), 0);
}

// Triangles of half a pixel to many, 131072 of them: a pixel that slipped between two would see the
// sky through the ball.
TEST_F(SurfaceImage, HasNoCracks) {
  const HeadlessScene fine(quick(960, 540));
  addSurface(fine, support::sphereMesh(7), fine.addHenyeyGreenstein(0), EXTINCTION,
             {1000, 1000, 1000}, {0, 0, 0});
  for (const std::array<double, 3>& eye :
       {std::array{30.0, 40.0, 7000.0}, {600.0, 700.0, 2500.0}, {-500.0, 300.0, 1300.0}}) {
    fine.setCamera(eye, 0, 0);
    fine.render();
    const Image image = fine.read(WLK_IMAGE_TRANSMITTANCE);
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x) {
        const glm::dvec3 ray = pixelDirection(fine, x, y);
        const glm::dvec3 origin(eye[0], eye[1], eye[2]);
        const double nearest = -glm::dot(origin, ray);
        const double square = 1e6 - glm::dot(origin, origin) + nearest * nearest;
        const double length = 2 * std::sqrt(std::max(square, 0.0));
        // Facets of 1/128 of a right angle, 1.7 times that where the octahedron's faces bulge, lie
        // up to 0.06 m below the ball; at its rim by as much as the chord of that.
        const double facet = 2 * std::sqrt(std::max(square, 0.0) + 2 * 1000 * 0.12) - length;
        EXPECT_NEAR(image.at(x, y)[0], std::exp(-static_cast<double>(EXTINCTION) * length),
                    static_cast<double>(EXTINCTION) * facet + 1e-5)
            << x << ' ' << y;
      }
    }
  }
}

// In the mirror the triangles run the other way round.
TEST_F(SurfaceImage, MirroredMeshesAreTheSame) {
  addBox({-HALF[0], HALF[1], HALF[2]});
  EXPECT_GT(expectChords({0, 2, 0}), 30);
}

TEST_F(SurfaceImage, MovedMeshesShowInTheNextFrame) {
  const WlkSurface surface = addBox({1, 1, 1}, {0, 0, 0});
  scene.setSun(40, 60);
  scene.render();
  SurfaceArrays arrays(support::boxMesh());
  for (size_t i = 0; i < arrays.positions.size(); ++i) {
    arrays.positions[i] =
        static_cast<float>(static_cast<double>(arrays.positions[i]) * HALF[i % 3] + MIDDLE[i % 3]);
  }
  check(wlkSetSurfacePositions(scene.context, surface, arrays.positions.data(), 8, 12));
  EXPECT_GT(expectChords({0, 2, 0}), 30);
  const Image moved = scene.read(WLK_IMAGE_RADIANCE);
  // As if it had always been there.
  check(wlkDestroySurface(scene.context, surface));
  addSurface(scene, support::boxMesh(), scene.addHenyeyGreenstein(0), EXTINCTION, HALF, MIDDLE);
  const Image fresh = scene.render();
  EXPECT_GT(fresh.mean(), 0);
  EXPECT_LT(relativeRms(moved, fresh), 1e-4);  // places are floats in one of them
}

// Buffers shared by meshes hold vertices of others.
TEST_F(SurfaceImage, VerticesThatNoTriangleUsesMoveNothing) {
  SurfaceArrays arrays(support::boxMesh());
  arrays.positions.insert(arrays.positions.end(), {9, 7, 8});
  WlkSurfaceInfo info = arrays.info(scene.addHenyeyGreenstein(0), EXTINCTION);
  place(info, HALF, MIDDLE);
  WlkSurface surface{};
  check(wlkCreateSurface(scene.context, &info, &surface));
  scene.setSun(40, 60);
  EXPECT_GT(expectChords({0, 2, 0}), 30);
  const Image before = scene.read(WLK_IMAGE_RADIANCE);
  EXPECT_GT(before.mean(), 0);
  check(wlkSetSurfacePositions(scene.context, surface, arrays.positions.data(), 9, 12));
  EXPECT_GT(expectChords({0, 2, 0}), 30);
  EXPECT_TRUE(scene.read(WLK_IMAGE_RADIANCE) == before);
  // Nor does the box see where they are.
  arrays.positions[24] = -500;
  check(wlkSetSurfacePositions(scene.context, surface, arrays.positions.data(), 9, 12));
  EXPECT_GT(expectChords({0, 2, 0}), 30);
  EXPECT_TRUE(scene.read(WLK_IMAGE_RADIANCE) == before);
}

TEST_F(SurfaceImage, FramesRepeatAndKeepTheLight) {
  addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f, {900, 900, 900}, MIDDLE);
  scene.setSun(40, 60);
  const Image first = scene.render();
  EXPECT_EQ(first.badValues(), 0u);
  EXPECT_GT(first.mean(), 0);
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).reason, uint32_t{WLK_REASON_NEEDED});
  EXPECT_TRUE(scene.render() == first);
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).reason, uint32_t{WLK_REASON_UNCHANGED});
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).commands, 0u);
  scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  EXPECT_TRUE(scene.render() == first);
  EXPECT_GT(pass(WLK_PASS_SURFACE_LIGHT).commands, 0u);
  scene.setQuality(WLK_QUALITY_LOW);
  scene.setSun(40, 61);
  EXPECT_FALSE(scene.render() == first);
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).reason, uint32_t{WLK_REASON_NEEDED});
}

TEST_F(SurfaceImage, SkipsWhatIsNotSeen) {
  const WlkSurface surface = addBox();
  scene.setSun(40, 60);
  scene.setCamera({0, 2, 0}, 180, 0);
  scene.render();
  EXPECT_EQ(pass(WLK_PASS_SURFACE).reason, uint32_t{WLK_REASON_OUTSIDE_VIEW});
  for (const uint32_t kind : {WLK_PASS_SURFACE, WLK_PASS_SURFACE_LIGHT}) {
    EXPECT_EQ(pass(kind).surface.id, surface.id);
    EXPECT_EQ(pass(kind).volume.id, 0u);
  }
  EXPECT_EQ(pass(WLK_PASS_SURFACE).commands + pass(WLK_PASS_SURFACE_LIGHT).commands, 0u);
  scene.setCamera({0, 2, 0}, 0, 0);
  scene.clearLights();
  const Image dark = scene.render();
  EXPECT_EQ(dark.mean(), 0);
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).reason, uint32_t{WLK_REASON_NO_LIGHT});
  EXPECT_GT(pass(WLK_PASS_SURFACE).commands, 0u);
  check(wlkDestroySurface(scene.context, surface));
  scene.render();
  EXPECT_EQ(scene.stats().dispatches, 1u);  // the composite that the targets need
}

// Whatever lies in front: radiances add behind its transmittance, transmittances multiply.
TEST_F(SurfaceImage, LayersStandBehindEachOther) {
  constexpr float WEIGHT_BITS = 0x1p-18F;  // surface_point.glsl
  scene.setSun(30, 150);
  const WlkSurface near = addBox({300, 300, 300}, {0, 700, -2500});
  const Image nearLight = scene.render();
  const Image nearPasses = scene.read(WLK_IMAGE_TRANSMITTANCE);
  check(wlkDestroySurface(scene.context, near));
  const auto expectOver = [&](const Image& farLight, const Image& farPasses) {
    addBox({300, 300, 300}, {0, 700, -2500});
    const Image light = scene.render();
    const Image passes = scene.read(WLK_IMAGE_TRANSMITTANCE);
    for (size_t i = 0; i < light.rgba.size(); ++i) {
      if (i % 4 < 3) {
        const float expected = nearLight.rgba[i] + nearPasses.rgba[i] * farLight.rgba[i];
        // Floats, and the 18 bits that light scattered more than once waits in.
        EXPECT_NEAR(light.rgba[i], expected, (1e-6f + WEIGHT_BITS) * expected);
        EXPECT_NEAR(passes.rgba[i], nearPasses.rgba[i] * farPasses.rgba[i], 1e-6f);
      }
    }
    EXPECT_GT(farLight.mean(), 0);
  };
  const WlkSurface far = addBox();
  const Image farLight = scene.render();
  expectOver(farLight, scene.read(WLK_IMAGE_TRANSMITTANCE));
  check(wlkDestroySurface(scene.context, far));
}

TEST_F(SurfaceImage, StandsBeforeAVolume) {
  scene.setSun(30, 150);
  scene.addBall(0.002f);
  const Image farLight = scene.render();
  const Image farPasses = scene.read(WLK_IMAGE_TRANSMITTANCE);
  const WlkSurface near = addBox({300, 300, 300}, {0, 700, -2500});
  const Image light = scene.render();
  const Image passes = scene.read(WLK_IMAGE_TRANSMITTANCE);
  (void)near;
  int covered = 0;
  for (uint32_t y = 0; y < light.height; ++y) {
    for (uint32_t x = 0; x < light.width; ++x) {
      const float through = passes.at(x, y)[0] / farPasses.at(x, y)[0];
      covered += through < 0.9f ? 1 : 0;
      EXPECT_LE(through, 1.000001f);
      EXPECT_GE(light.at(x, y)[0], through * farLight.at(x, y)[0] * 0.99999f);
      if (through > 0.999999f) {
        EXPECT_EQ(light.at(x, y)[0], farLight.at(x, y)[0]);
      }
    }
  }
  EXPECT_GT(covered, 10);
}

WlkAmbient givenAmbient(float sky, float ground) {
  auto ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_GIVEN;
  for (size_t c = 0; c < 3; ++c) {
    ambient.sky[c] = sky;
    ambient.ground[c] = ground;
  }
  return ambient;
}

// In light that is equal from everywhere a cloud that absorbs nothing is not seen.
TEST_F(SurfaceImage, VanishesInAFurnace) {
  const WlkAmbient furnace = givenAmbient(1, 1);
  check(wlkSetAmbient(scene.context, &furnace));
  addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f, {900, 900, 900}, MIDDLE);
  addSurface(scene, support::boxMesh(), scene.addHenyeyGreenstein(0.5f), 0.002f, {300, 300, 300},
             {-700, 700, -2500});
  const Image light = scene.render();
  const Image passes = scene.read(WLK_IMAGE_TRANSMITTANCE);
  int covered = 0;
  for (size_t i = 0; i < light.rgba.size(); ++i) {
    if (i % 4 < 3) {
      covered += passes.rgba[i] < 0.5f ? 1 : 0;
      // What linear filters of the shares lack of 1, which nodes have in floats.
      EXPECT_NEAR(light.rgba[i] + passes.rgba[i], 1, 1e-5) << i;
    }
  }
  EXPECT_GT(covered, 100);
  EXPECT_TRUE(scene.render() == light);
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).reason, uint32_t{WLK_REASON_UNCHANGED});
}

// Sky above and a dark ground: the lower half of a thick ball is darker, nowhere brighter than the
// sky; without either nothing is computed.
TEST_F(SurfaceImage, TakesLightFromTheSkyAbove) {
  const WlkAmbient sky = givenAmbient(1, 0);
  check(wlkSetAmbient(scene.context, &sky));
  addSurface(scene, support::sphereMesh(4), scene.addMedium(), 0.05f, {700, 700, 700},
             {0, 2, -3000});
  scene.setCamera({0, 2, 0}, 0, 0);
  const Image light = scene.render();
  double upper = 0;
  double lower = 0;
  for (uint32_t y = 0; y < light.height; ++y) {
    for (uint32_t x = 0; x < light.width; ++x) {
      const float value = light.at(x, y)[0];
      (y < light.height / 2 ? upper : lower) += static_cast<double>(value);
      EXPECT_LE(value, 1);
      EXPECT_GE(value, 0);
    }
  }
  EXPECT_GT(upper, 2 * lower);
  EXPECT_GT(lower, 0.1 * upper);  // light comes through
  const WlkAmbient dark = givenAmbient(0, 0);
  check(wlkSetAmbient(scene.context, &dark));
  EXPECT_EQ(scene.render().mean(), 0);
  EXPECT_EQ(pass(WLK_PASS_SURFACE_LIGHT).commands, 0u);
}

}  // namespace
}  // namespace welkin::test
