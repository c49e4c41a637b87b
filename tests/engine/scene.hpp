// SPDX-License-Identifier: MIT
// One small scene for every context: air, fog, sun, a cloud; the engine's colour and depth.
#pragma once

#include <array>
#include <vector>
#include <welkin/welkin.hpp>

namespace engine {

// How a camera maps depth and the picture's axes.
struct CameraCase {
  const char* name;
  bool reversed;
  bool infinite;
  bool flipY;
  bool mirrorX;
  bool leftHanded;  // view space looks along +z
};
inline constexpr std::array CAMERAS{
    CameraCase{"reversed infinite", true, true, false, false, false},
    CameraCase{"reversed finite", true, false, false, false, false},
    CameraCase{"standard finite", false, false, false, false, false},
    CameraCase{"standard infinite", false, true, false, false, false},
    CameraCase{"left-handed", true, true, false, false, true},
    CameraCase{"flipped", true, true, true, false, false},
    CameraCase{"mirrored", false, false, false, true, false}};

WlkCamera cameraOf(const CameraCase& camera, uint32_t width, uint32_t height);

// What the engine drew, seen by a camera: RGBA, and distances along the view's axis (m; infinite
// where nothing is).
struct EnginePicture {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> color;
  std::vector<double> viewDepth;
  // The depth buffer in the camera's convention.
  std::vector<float> depth(const CameraCase& camera) const;
};
EnginePicture makeEnginePicture(uint32_t width, uint32_t height, const CameraCase& camera);

// Swaps rows and columns as the camera does.
std::vector<float> turned(const std::vector<float>& rgba, uint32_t width, const CameraCase& camera);

inline constexpr uint32_t CLOUD_SIZE = 16;  // voxels along each axis
std::vector<float> cloudValues();

struct Scene {
  welkin::Medium medium;
  welkin::Volume cloud;
};
// Sets air, fog and sun, makes the cloud; fills it unless `upload` is false.
Scene makeScene(WlkContext context, bool upload = true);
void uploadCloud(WlkContext context, WlkVolume cloud, const std::vector<float>& values);
// Few slices: the tests compare pictures with each other, not with the truth.
void setQuality(WlkContext context, WlkView view, uint64_t flags = 0);

// A headless context with the scene and one view.
class Headless {
 public:
  Headless(uint32_t width, uint32_t height, uint64_t qualityFlags = 0);
  // RGBA of colour and depth (either may be empty) with the scene in front. `shadow`: whose shadow
  // map to take.
  std::vector<float> render(const WlkCamera& camera, const std::vector<float>& color,
                            const std::vector<float>& depth,
                            const WlkHeadlessInputs* shadow = nullptr);
  WlkContext context() const { return context_; }
  WlkVolume cloud() const { return scene_.cloud; }

 private:
  uint32_t width_;
  uint32_t height_;
  welkin::Context context_;
  Scene scene_;
  welkin::View view_;
};

}  // namespace engine
