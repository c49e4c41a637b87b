// SPDX-License-Identifier: MIT
// A scene that any input makes and changes: planet, sky, fog, absorber, ambient light, lights, one
// volume, one cloud surface, camera and quality of one view.
#pragma once

#include <algorithm>
#include <cmath>

#include "framed.hpp"

namespace fuzz {

// Where a volume or a surface lies.
struct Place {
  // A box around the eye or beside it, mostly.
  explicit Place(Input& input) {
    const double edge = 100.0 * (1 + input.below(40));
    for (size_t i = 0; i < 3; ++i) {
      transform[5 * i] = edge;
      transform[4 * i + 3] = edge * (input.below(5) - 2.5);
    }
    while (input.oneIn(3)) {
      transform[input.below(12)] = input.number<double>();
      isBox = false;
    }
  }
  // What was `made` lies there if it is a box; else that may be refused.
  void require(bool made, WlkResult result) const {
    fuzz::require(checkResult(result) || !made || !isBox, "a box is a place");
  }

  double transform[12] = {};  // row-major 3x4
  bool isBox = true;
};

class SceneCalls {
 public:
  static constexpr uint32_t COUNT = 11;
  static constexpr uint32_t EDGE = 6;  // voxels, at most

  // Begins with an Earth's sky.
  SceneCalls(Input& input, WlkContext context, WlkMedium medium, WlkView view)
      : input_(input), context_(context), medium_(medium), view_(view) {
    quality();
    const auto sky = welkin::make<WlkSky>();
    (void)checkResult(wlkSetSky(context_, &sky));
    camera();
  }
  // Leaves the context as it was; the view is the caller's.
  ~SceneCalls() {
    (void)wlkDestroyVolume(context_, volume_);
    (void)wlkDestroySurface(context_, surface_);
    (void)wlkSetSky(context_, nullptr);
    (void)wlkSetFog(context_, nullptr);
    (void)wlkSetAbsorber(context_, nullptr);
    (void)wlkSetAmbient(context_, nullptr);
    (void)wlkSetPlanet(context_, nullptr);
    (void)wlkSetLights(context_, 0, 0, nullptr);
  }
  SceneCalls(const SceneCalls&) = delete;
  SceneCalls& operator=(const SceneCalls&) = delete;

  // `which` is less than COUNT.
  void call(uint32_t which) {
    switch (which) {
      case 0:
        return set(wlkSetSky);
      case 1:
        return set(wlkSetFog);
      case 2:
        return set(wlkSetAbsorber);
      case 3:
        return set(wlkSetAmbient);
      case 4:
        return set(wlkSetPlanet);
      case 5:
        return lights();
      case 6:
        return volume();
      case 7:
        return surface();
      case 8:
        return camera();
      case 9:
        return quality();
      default:
        return upload();
    }
  }

 private:
  Input& input_;
  WlkContext context_;
  WlkMedium medium_;
  WlkView view_;
  WlkVolume volume_{};
  WlkSurface surface_{};
  uint32_t size_[3] = {};

  template <typename T>
  void set(WlkResult (*function)(WlkContext, const T*)) {
    Framed<T> value(input_);
    (void)checkResult(function(context_, input_.oneIn(8) ? nullptr : value.get()));
  }

  void lights() {
    WlkLight two[2];
    for (WlkLight& one : two) {
      Framed<WlkLight> light(input_);
      (void)light.get();
      one = light.value;
      one.next = nullptr;
    }
    (void)checkResult(wlkSetLights(context_, input_.below(3), sizeof two[0], two));
  }

  void camera() {
    Framed<WlkCamera> camera(input_);
    // Near the ground, most of the time.
    camera.value.position[1] += input_.oneIn(4) ? input_.number<double>() : 100.0;
    (void)checkResult(wlkSetCamera(context_, view_, camera.get()));
  }

  // Of any level, and small: what is asked for in pixels, slices and cells is time.
  void quality() {
    Framed<WlkQuality> quality(input_);
    WlkQuality& q = quality.value;
    q.level = input_.below(4);
    q.sliceCount = 1 + input_.below(24);
    q.batchSize = input_.oneIn(4) ? 1 + input_.below(8) : 0;
    q.lightBufferSize = 16 + input_.below(32);
    q.volumeCells = 8;
    static constexpr uint32_t SCATTERING[] = {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD,
                                              WLK_SCATTERING_ALL_ORDERS};
    q.scattering = SCATTERING[input_.below(3)];
    (void)checkResult(wlkSetQuality(context_, view_, quality.get()));
  }

  void volume() {
    (void)wlkDestroyVolume(context_, volume_);
    Framed<WlkVolumeInfo> info(input_);
    WlkVolumeField field{medium_, std::abs(input_.number<float>()), 0};
    info.value.fields = &field;
    info.value.fieldStride = sizeof field;
    info.value.fieldCount = 1;
    for (size_t i = 0; i < 3; ++i) {
      size_[i] = 1 + input_.below(EDGE);
      info.value.size[i] = size_[i];
    }
    const bool made = checkResult(wlkCreateVolume(context_, info.get(), &volume_));
    const Place place(input_);
    place.require(made, wlkSetVolumeTransform(context_, volume_, place.transform));
    upload();
  }

  void upload() {
    float voxels[EDGE * EDGE * EDGE];
    const bool any = input_.oneIn(4);
    for (float& one : voxels) {
      one = any ? input_.number<float>() : static_cast<float>(input_.below(3));
    }
    Framed<WlkVolumeUpload> info(input_);
    std::copy_n(size_, 3, info.value.extent);
    info.value.data = voxels;
    info.value.dataSize = sizeof voxels;
    (void)checkResult(wlkUploadVolume(context_, volume_, info.get()));
  }

  void surface() {
    static constexpr uint32_t CLOSED[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    (void)wlkDestroySurface(context_, surface_);
    Framed<WlkSurfaceInfo> info(input_);
    float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (input_.oneIn(4)) {
      positions[input_.below(12)] = input_.number<float>();
    }
    info.value.medium = medium_;
    info.value.positions = positions;
    info.value.indices = CLOSED;
    info.value.vertexStride = 12;
    info.value.vertexCount = 4;
    info.value.triangleCount = 4;
    if (!checkResult(wlkCreateSurface(context_, info.get(), &surface_))) {
      return;
    }
    const Place place(input_);
    place.require(true, wlkSetSurfaceTransform(context_, surface_, place.transform));
    if (input_.oneIn(2)) {
      Framed<WlkSurfaceDetail> detail(input_);
      (void)checkResult(wlkSetSurfaceDetail(context_, surface_, detail.get()));
    }
  }
};

}  // namespace fuzz
