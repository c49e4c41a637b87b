// SPDX-License-Identifier: MIT
#include "api/ambient_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "api/sky_map.hpp"
#include "frame/ambient.hpp"

namespace welkin {
namespace {

// Texels along a side of the map that the sky is taken from: irradiances on the six sides of a box
// are within 6 % of those by a map of 32 with suns of 30 degrees and more, within 13 % at 5, whose
// red band at the horizon is narrow (QuerySkyMap.OfTwelveTexelsLightsABoxAsAFineOneDoes).
constexpr uint32_t MAP_SIZE = 12;

// What an ambient light is made of, byte by byte. Of fixed size: frames compare it.
class Key {
 public:
  template <typename T>
  void add(const T& value) {
    std::memcpy(data_.data() + size_, &value, sizeof value);
    size_ += sizeof value;
  }
  template <typename T>
  void add(const std::optional<T>& value) {
    data_[size_++] = value ? 1 : 0;
    if (value) {
      add(*value);
    }
  }
  [[nodiscard]] bool isThatOf(const std::vector<char>& kept) const {
    return std::ranges::equal(kept, bytes());
  }
  void keepIn(std::vector<char>& kept) const {
    kept.reserve(data_.size());  // once
    kept.assign(bytes().begin(), bytes().end());
  }

 private:
  [[nodiscard]] std::span<const char> bytes() const { return {data_.data(), size_}; }

  using Scene = AirState;
  std::array<char, sizeof(glm::dmat4x3) + sizeof(int) + sizeof(Scene::ambient) +
                       sizeof(Scene::planet) + sizeof(Scene::sky) + sizeof(Scene::absorber) +
                       sizeof(Scene::fog) + sizeof(uintptr_t) + sizeof(Scene::lights) +
                       sizeof(Scene::lightCount) + sizeof(WlkContext_T::shownFieldVersion)>
      data_;
  size_t size_ = 0;
};

Key keyOf(const WlkContext_T& c, const glm::dmat4x3& worldFromBox, int thinAxis) {
  Key key;
  key.add(c.air.ambient);
  key.add(worldFromBox);
  key.add(thinAxis);
  key.add(c.air.planet);
  if (c.air.ambient.mode == WLK_AMBIENT_AUTOMATIC) {
    key.add(c.air.sky);
    key.add(c.air.absorber);
    key.add(c.air.fog);
    key.add(reinterpret_cast<uintptr_t>(c.air.fogPhase.get()));
    key.add(c.air.lights);
    key.add(c.air.lightCount);
    key.add(c.shownFieldVersion);
  }
  return key;
}

// Light from all directions, on the stack.
class Samples {
 public:
  void add(const AmbientSample& sample) { data_[size_++] = sample; }
  operator std::span<const AmbientSample>() const { return {data_.data(), size_}; }

  static constexpr size_t ROOM = 384;

 private:
  std::array<AmbientSample, ROOM> data_;
  size_t size_ = 0;
};

glm::dvec3 middleOf(const glm::dmat4x3& worldFromBox) {
  return worldFromBox * glm::dvec4(0.5, 0.5, 0.5, 1);
}

Samples skySamples(const WlkContext_T& c, const PlanetFrame& place) {
  static_assert(size_t{MAP_SIZE} * MAP_SIZE <= Samples::ROOM);
  std::array<std::optional<SkyMap>, MAX_LIGHTS> maps;
  for (uint32_t l = 0; l < c.air.lightCount; ++l) {
    maps[l].emplace(c.air, place, l, c.shownField.get());
  }
  Samples samples;
  const double halfWidth = 1.0 / MAP_SIZE;
  for (uint32_t j = 0; j < MAP_SIZE; ++j) {
    for (uint32_t i = 0; i < MAP_SIZE; ++i) {
      const glm::dvec2 uv((2.0 * i + 1) * halfWidth - 1, (2.0 * j + 1) * halfWidth - 1);
      AmbientSample sample{octahedralDirection(uv), octahedralSolidAngle(uv, MAP_SIZE),
                           glm::dvec3(0)};
      for (uint32_t l = 0; l < c.air.lightCount; ++l) {
        sample.radiance += maps[l]->texel(uv, halfWidth);
      }
      samples.add(sample);
    }
  }
  return samples;
}

// Sloan, Stupid Spherical Harmonics Tricks, 2008.
glm::dvec3 harmonicSum(const float (&c)[WLK_AMBIENT_VALUES], const glm::dvec3& v) {
  const double y[WLK_AMBIENT_VALUES / 3] = {0.28209479177387814,
                                            0.48860251190291992 * v.y,
                                            0.48860251190291992 * v.z,
                                            0.48860251190291992 * v.x,
                                            1.0925484305920792 * v.x * v.y,
                                            1.0925484305920792 * v.y * v.z,
                                            0.31539156525252005 * (3 * v.z * v.z - 1),
                                            1.0925484305920792 * v.x * v.z,
                                            0.54627421529603959 * (v.x * v.x - v.y * v.y)};
  glm::dvec3 sum(0);
  for (size_t i = 0; i < WLK_AMBIENT_VALUES / 3; ++i) {
    sum += y[i] * glm::dvec3(c[3 * i], c[3 * i + 1], c[3 * i + 2]);
  }
  return sum;
}

// Rings of equal solid angle around the local up: none crosses the horizontal plane.
Samples givenSamples(const WlkAmbient& given, const glm::dvec3& up) {
  constexpr int RINGS = 16;
  constexpr int AROUND = 24;
  const glm::dvec3 other = std::abs(up.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 a = glm::normalize(glm::cross(up, other));
  const glm::dvec3 b = glm::cross(up, a);
  static_assert(size_t{RINGS} * AROUND <= Samples::ROOM);
  Samples samples;
  for (int ring = 0; ring < RINGS; ++ring) {
    const double height = (2.0 * ring + 1) / RINGS - 1;
    const double flat = std::sqrt(1 - height * height);
    for (int i = 0; i < AROUND; ++i) {
      const double azimuth = 2 * std::numbers::pi * (i + 0.5 * (ring & 1)) / AROUND;
      const glm::dvec3 from = height * up + flat * (std::cos(azimuth) * a + std::sin(azimuth) * b);
      const float(&side)[3] = height > 0 ? given.sky : given.ground;
      const glm::dvec3 radiance =
          glm::dvec3(side[0], side[1], side[2]) + harmonicSum(given.harmonics, from);
      samples.add(
          {from, 4 * std::numbers::pi / (RINGS * AROUND), glm::max(radiance, glm::dvec3(0))});
    }
  }
  return samples;
}

Samples samplesOn(const WlkContext_T& c, const glm::dmat4x3& worldFromBox) {
  constexpr double FARTHEST = 1e9;  // m, as positions of queries
  glm::dvec3 middle = middleOf(worldFromBox);
  if (!(glm::length(middle) <= FARTHEST)) {
    middle = glm::dvec3(0);
  }
  const PlanetFrame place = planetFrameAt(c.air.planet, middle);
  const bool given = c.air.ambient.mode == WLK_AMBIENT_GIVEN;
  return given ? givenSamples(c.air.ambient, place.up) : skySamples(c, place);
}

// Means over both halves of the sky, by what comes onto a level plane.
SurfaceAmbientLight halvesOf(std::span<const AmbientSample> samples, const glm::dvec3& up) {
  SurfaceAmbientLight light;
  light.up = up;
  double above = 0;
  double below = 0;
  for (const AmbientSample& sample : samples) {
    const double weight = sample.solidAngle * glm::dot(sample.from, up);
    (weight > 0 ? light.sky : light.ground) += std::abs(weight) * sample.radiance;
    (weight > 0 ? above : below) += std::abs(weight);
  }
  light.sky /= std::max(above, 1e-30);
  light.ground /= std::max(below, 1e-30);
  return light;
}

void planSurfaceAmbient(WlkContext_T& c, const ViewState& view, PlannedVolume& planned) {
  SurfaceState& surface = *c.surfaces.find(planned.id);
  const glm::dmat4x3 box = surface.worldFromBox();
  const Key key = keyOf(c, box, 0);
  if (!key.isThatOf(surface.ambientKey)) {
    surface.ambient = halvesOf(samplesOn(c, box), planetFrameAt(c.air.planet, middleOf(box)).up);
    key.keepIn(surface.ambientKey);
  }
  const bool dark = surface.ambient.sky == glm::dvec3(0) && surface.ambient.ground == glm::dvec3(0);
  if (dark && !view.plan.quality.noSkip) {
    planned.ambient = false;
    planned.ambientReason = WLK_REASON_NO_LIGHT;
  }
}

}  // namespace

void planAmbient(WlkContext_T& c, ViewState& view) {
  for (PlannedVolume& planned : view.plan.volumes) {
    if (!planned.ambient) {
      continue;
    }
    VolumeState& volume = *c.volumes.find(planned.id);
    const TransportShape shape = transportShape(volume, view.plan.quality.ambientCells);
    const Key key = keyOf(c, volume.worldFromBox, shape.thinAxis);
    const bool whole = planned.ambientWhole;
    VolumeAmbient& ambient = volume.ambient[whole ? 1 : 0];
    if (!key.isThatOf(ambient.key)) {
      const Samples samples = samplesOn(c, volume.worldFromBox);
      ambient.light = ambientThrough(glm::dmat3(volume.worldFromBox), shape, samples);
      ambient.fine = ambientFine(*volume.transport, samples, whole);
      key.keepIn(ambient.key);
    }
    if (dark(ambient.light) && !view.plan.quality.noSkip) {
      planned.ambient = false;
      planned.ambientReason = WLK_REASON_NO_LIGHT;
    }
  }
  for (PlannedVolume& planned : view.plan.surfaces) {
    if (planned.ambient) {
      planSurfaceAmbient(c, view, planned);
    }
  }
}

}  // namespace welkin

namespace {

using namespace welkin;

WlkAmbient checkedAmbient(const WlkAmbient* ambient) {
  const WlkAmbient a = copyStruct(ambient, WLK_STRUCT_AMBIENT);
  checkNoChain(ambient);
  checkRange(a.sType, "mode", a.mode, WLK_AMBIENT_OFF, WLK_AMBIENT_GIVEN);
  checkRange3(a.sType, "sky", a.sky, 0, 1e6);
  checkRange3(a.sType, "ground", a.ground, 0, 1e6);
  for (const float x : a.harmonics) {
    checkRange(a.sType, "harmonics", x, -1e6, 1e6);
  }
  return a;
}

}  // namespace

WlkResult wlkSetAmbient(WlkContext context, const WlkAmbient* ambient) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    WlkAmbient value{};
    if (ambient != nullptr) {
      value = checkedAmbient(ambient);
      value.next = nullptr;
    } else {
      wlkInitStruct(WLK_STRUCT_AMBIENT, sizeof value, &value);
    }
    const bool before = c.ambientActive();
    c.air.ambient = value;
    if (c.ambientActive() != before) {
      c.invalidate();
    }
    return WLK_SUCCESS;
  });
}
