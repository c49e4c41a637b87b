// SPDX-License-Identifier: MIT
#include "stress/headless_life.hpp"

namespace welkin::test {

WlkResult HeadlessLife::create() {
  const auto headless = make<WlkHeadlessInfo>();
  auto info = make<WlkContextInfo>();
  info.next = &headless;
  info.allocator = memory.callbacks();
  return wlkCreateContext(WLK_API_VERSION, &info, &context);
}

WlkResult HeadlessLife::setLights() const {
  auto sun = make<WlkLight>();
  sun.direction[0] = 0.6f;
  sun.direction[1] = 0.8f;
  return wlkSetLights(context, 1, sizeof sun, &sun);
}

WlkResult HeadlessLife::createMedium() {
  auto info = make<WlkMediumInfo>();
  info.particle = droplets_ ? WLK_PARTICLE_CLOUD : WLK_PARTICLE_HENYEY_GREENSTEIN;
  return wlkCreateMedium(context, &info, &medium);
}

WlkResult HeadlessLife::createVolume() {
  WlkVolumeField field{};
  field.medium = medium;
  field.extinctionScale = 2e-3f;
  auto info = make<WlkVolumeInfo>();
  info.size[0] = info.size[1] = info.size[2] = 8;
  info.fieldCount = 1;
  info.fields = &field;
  const auto transform = boxTransform({-500, 0, -2000}, {1000, 800, 1000});
  std::memcpy(info.worldFromVolume, transform.data(), sizeof info.worldFromVolume);
  return wlkCreateVolume(context, &info, &volume);
}

WlkResult HeadlessLife::upload(float value) const {
  const std::vector<float> values(512, value);
  auto upload = make<WlkVolumeUpload>();
  upload.extent[0] = upload.extent[1] = upload.extent[2] = 8;
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  return wlkUploadVolume(context, volume, &upload);
}

WlkResult HeadlessLife::createView() {
  auto info = make<WlkViewInfo>();
  info.width = WIDTH;
  info.height = HEIGHT;
  return wlkCreateView(context, &info, &view);
}

WlkResult HeadlessLife::setQuality() const {
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = WLK_SCATTERING_FORWARD;
  return wlkSetQuality(context, view, &quality);
}

WlkResult HeadlessLife::readback() {
  picture.assign(size_t{4} * WIDTH * HEIGHT, 0.0f);
  auto data = make<WlkImageData>();
  data.data = picture.data();
  data.dataSize = picture.size() * sizeof(float);
  return wlkReadback(context, view, &data);
}

std::vector<Step> HeadlessLife::steps() {
  const auto render = [this] { return wlkRenderHeadless(context, view, nullptr); };
  const auto prepare = [this] { return wlkPrepare(context); };
  return {
      {"wlkCreateContext", [this] { return create(); }, false},
      {"wlkSetLights", [this] { return setLights(); }, false},
      {"wlkCreateMedium", [this] { return createMedium(); }, false},
      {"wlkCreateVolume", [this] { return createVolume(); }, true},
      {"wlkUploadVolume", [this] { return upload(0.5f); }, true},
      {"wlkCreateView", [this] { return createView(); }, true},
      {"wlkSetQuality", [this] { return setQuality(); }, false},
      {"wlkPrepare", prepare, true},
      {"wlkRenderHeadless", render, true},
      {"wlkReadback", [this] { return readback(); }, true},
      {"wlkUploadVolume", [this] { return upload(0.25f); }, true},
      {"wlkRenderHeadless", render, true},
      {"wlkRenderHeadless", render, true},
      {"wlkReadback", [this] { return readback(); }, true},
      {"wlkDestroyView", [this] { return wlkDestroyView(context, view); }, false},
      {"wlkDestroyVolume", [this] { return wlkDestroyVolume(context, volume); }, false},
  };
}

}  // namespace welkin::test
