// SPDX-License-Identifier: MIT
// Sequences of calls of a context without a device: atmosphere, lights, media, queries. What is
// accepted gives finite light; what is not leaves its message; memory comes back.
#include "framed.hpp"

namespace fuzz {
namespace {

constexpr uint32_t MAX_CALLS = 24;
constexpr double NO_LIMIT = std::numeric_limits<double>::max();

uint64_t g_blocks = 0;
uint64_t g_untilFailure = 0;

void* allocate(void*, uint64_t size, uint64_t alignment) {
  if (g_untilFailure-- == 0) {
    g_untilFailure = 0;
    return nullptr;
  }
  ++g_blocks;
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void release(void*, void* memory, uint64_t, uint64_t) {
  --g_blocks;
  std::free(memory);
}

class Run {
 public:
  explicit Run(Input& input) : input_(input), dear_(input.oneIn(64)) {
    auto info = welkin::make<WlkContextInfo>();
    info.allocator = {nullptr, allocate, release};
    g_untilFailure = input.oneIn(16) ? input.take<uint8_t>() : ~uint64_t{0} / 2;
    (void)checkResult(wlkCreateContext(WLK_API_VERSION, &info, &context_));
  }
  ~Run() {
    wlkDestroyContext(context_);
    require(g_blocks == 0, "a destroyed context has given all memory back");
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void call() {
    switch (input_.below(17)) {
      case 0:
        return set<WlkPlanet>(wlkSetPlanet);
      case 1:
        return set<WlkSky>(wlkSetSky);
      case 2:
        return set<WlkAbsorber>(wlkSetAbsorber);
      case 3:
        return set<WlkAmbient>(wlkSetAmbient);
      case 4:
        return setLights();
      case 5:
        return setFog();
      case 6:
        return createMedium();
      case 7:
        (void)checkResult(wlkDestroyMedium(context_, media_.pick(input_)));
        return;
      case 8:
        return optics();
      case 9:
        return evalSky();
      case 10:
        return evalPoints();
      case 11:
        return evalAmbient();
      case 12:
        return evalSkyMap();
      case 13:
        return evalPhase();
      case 14:
        return samplePhase();
      case 15:
        return waterExtinction();
      default:
        return moonAndPreset();
    }
  }

 private:
  Input& input_;
  bool dear_;  // solving for all orders of scattering takes a second here: once in few inputs
  WlkContext context_ = nullptr;
  Handles<WlkMedium> media_;

  template <typename T>
  void set(WlkResult (*function)(WlkContext, const T*)) {
    Framed<T> info(input_);
    (void)checkResult(function(context_, info.get()));
  }

  void setLights() {
    Framed<WlkLight> first(input_);
    const Framed<WlkLight> second(input_);
    const WlkLight lights[2] = {*(first.get() != nullptr ? &first.value : &second.value),
                                second.value};
    // A structSize over the element's own would read the next one: the stride bounds it.
    (void)checkResult(wlkSetLights(context_, input_.below(3), sizeof(WlkLight), lights));
  }

  void setFog() {
    Framed<WlkFog> fog(input_);
    fog.value.medium = input_.oneIn(2) ? WlkMedium{} : media_.pick(input_);
    (void)checkResult(wlkSetFog(context_, fog.get()));
  }

  void createMedium() {
    Framed<WlkMediumInfo> info(input_);
    WlkMediumInfo& value = info.value;
    constexpr uint32_t ROWS = 8;
    double angle[ROWS];
    double phase[ROWS * 3];
    if (value.particle == WLK_PARTICLE_USER || input_.oneIn(8)) {
      for (uint32_t i = 0; i < ROWS; ++i) {
        angle[i] = 3.14159265358979323846 * i / (ROWS - 1);
      }
      for (double& x : phase) {
        x = std::abs(input_.number<double>());
      }
      angle[input_.below(ROWS)] = input_.number<double>();
      value.particle = WLK_PARTICLE_USER;
    }
    const bool user = value.particle == WLK_PARTICLE_USER;
    value.userAngle = user ? angle : nullptr;
    value.userPhase = user ? phase : nullptr;
    value.userCount = user ? ROWS : input_.below(2);
    // Sums of Mie theory for other spreads and colours take seconds, which are no defect.
    value.spread = value.spread >= 0.05f && value.spread <= 0.5f ? 0.25f : value.spread;
    value.wavelength_um =
        value.wavelength_um >= 0.4f && value.wavelength_um <= 0.7f ? 0.55f : value.wavelength_um;
    WlkMedium medium{};
    const bool made = checkResult(wlkCreateMedium(context_, info.get(), &medium));
    require(made == (medium.id != 0), "a medium comes back exactly if there is one");
    media_.add(medium);
  }

  void optics() {
    auto optics = welkin::make<WlkMediumOptics>();
    if (checkResult(wlkGetMediumOptics(context_, media_.pick(input_), &optics))) {
      requireLight(optics.forwardFraction, 3, 1.0f, "forward fractions are in [0, 1]");
      requireLight(optics.deltaFraction, 3, 1.0f, "delta fractions are in [0, 1]");
    }
  }

  template <typename T, size_t N>
  void fill(T (&values)[N]) {
    for (T& value : values) {
      value = input_.number<T>();
    }
  }

  // A direction that is a unit vector more often than not.
  void direction(double (&d)[3]) {
    fill(d);
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!input_.oneIn(8)) {
      for (double& x : d) {
        x = std::isfinite(length) && length > 0 ? x / length : &x == &d[1] ? 1.0 : 0.0;
      }
    }
  }

  void evalSky() {
    WlkRay rays[2];
    for (WlkRay& ray : rays) {
      fill(ray.origin);
      direction(ray.direction);
      ray.length = input_.number<double>();
    }
    Framed<WlkRayBatch> batch(input_);
    batch.value.rays = rays;
    batch.value.stride = sizeof(WlkRay);
    batch.value.count = input_.below(3);
    if (!dear_ && batch.value.maxOrder == 0) {
      batch.value.maxOrder = 1;
    }
    double radiance[6] = {};
    double transmittance[6] = {};
    const WlkRayBatch* given = batch.get();
    // An older structure has no maxOrder: all orders.
    if (!dear_ && given != nullptr && given->structSize < sizeof(WlkRayBatch)) {
      return;
    }
    if (checkResult(wlkEvalSky(context_, given, radiance, transmittance))) {
      requireLight(radiance, 6, NO_LIMIT, "the sky's radiance is finite, not negative");
      requireLight(transmittance, 6, 1.0, "transmittances of rays are in [0, 1]");
    }
  }

  void evalPoints() {
    double from[3];
    double to[3];
    fill(from);
    fill(to);
    double values[3] = {};
    if (checkResult(wlkEvalTransmittance(context_, from, to, values))) {
      requireLight(values, 3, 1.0, "transmittances between points are in [0, 1]");
    }
    if (checkResult(wlkEvalLight(context_, input_.below(3), from, values))) {
      requireLight(values, 3, 1e6, "light is not brighter than outside");
    }
    direction(to);
    if (checkResult(wlkEvalIrradiance(context_, from, to, values, nullptr))) {
      requireLight(values, 3, 1e6 * 2, "direct light is that of two lights at most");
    }
  }

  void evalAmbient() {
    if (!dear_) {
      return;
    }
    double position[3];
    double normal[3];
    fill(position);
    direction(normal);
    double coefficients[WLK_AMBIENT_VALUES];
    if (checkResult(wlkEvalAmbient(context_, position, coefficients))) {
      for (const double x : coefficients) {
        require(std::isfinite(x), "harmonics are finite");
      }
    }
    double direct[3];
    double diffuse[3];
    if (checkResult(wlkEvalIrradiance(context_, position, normal, direct, diffuse))) {
      requireLight(direct, 3, NO_LIMIT, "direct light is finite");
      requireLight(diffuse, 3, NO_LIMIT, "diffuse light is finite");
    }
  }

  void evalSkyMap() {
    Framed<WlkSkyMapQuery> query(input_);
    query.value.size = query.value.size > 8 && query.value.size <= 1024 ? 8 : query.value.size;
    if (!dear_ && query.value.maxOrder == 0) {
      query.value.maxOrder = 1;
    }
    float rgb[8 * 8 * 3] = {};
    if (checkResult(wlkEvalSkyMap(context_, query.get(), rgb, sizeof rgb))) {
      requireLight(rgb, std::size(rgb), std::numeric_limits<float>::max(), "sky maps are finite");
    }
  }

  void evalPhase() {
    double angles[2];
    fill(angles);
    angles[1] = std::fmod(std::abs(angles[1]), 3.14);
    Framed<WlkPhaseQuery> query(input_);
    query.value.medium = media_.pick(input_);
    query.value.count = input_.below(3);
    query.value.scatteringAngle = input_.oneIn(4) ? angles : angles + 1;
    query.value.count = query.value.scatteringAngle == angles ? query.value.count : 1;
    double values[6] = {};
    if (checkResult(wlkEvalPhase(context_, query.get(), values))) {
      requireLight(values, 6, NO_LIMIT, "phase functions are finite, not negative");
    }
  }

  void samplePhase() {
    const double random[2] = {std::abs(input_.number<double>()), 0.5};
    double angle[2] = {};
    double density[2] = {};
    if (checkResult(wlkSamplePhase(context_, media_.pick(input_), input_.below(4), input_.below(3),
                                   random, angle, density))) {
      requireLight(angle, 2, 3.1415926536, "sampled angles are in [0, pi]");
      requireLight(density, 2, NO_LIMIT, "densities are finite");
    }
  }

  void waterExtinction() {
    float water[2];
    float diameter[2];
    fill(water);
    fill(diameter);
    float extinction[2] = {};
    if (checkResult(wlkEvalWaterExtinction(context_, media_.pick(input_), input_.below(3), water,
                                           input_.oneIn(3) ? nullptr : diameter, extinction))) {
      requireLight(extinction, 2, std::numeric_limits<float>::max(), "extinctions are finite");
    }
  }

  void moonAndPreset() {
    float toSun[3];
    float toMoon[3];
    float irradiance[3];
    fill(toSun);
    fill(toMoon);
    fill(irradiance);
    auto moon = welkin::make<WlkLight>();
    if (checkResult(wlkInitMoon(toSun, toMoon, irradiance, &moon))) {
      (void)checkResult(wlkSetLights(context_, 1, sizeof moon, &moon));
    }
    auto sky = welkin::make<WlkSky>();
    if (checkResult(wlkInitPresetStruct(input_.below(6), WLK_STRUCT_SKY, sizeof sky, &sky))) {
      require(wlkSetSky(context_, &sky) == WLK_SUCCESS || g_untilFailure == 0,
              "a preset's air is accepted");
    }
    unsigned char structure[512];
    const auto room = static_cast<uint32_t>(input_.take<uint16_t>() % (sizeof structure + 1));
    (void)checkResult(wlkInitStruct(input_.below(60), room, structure));
    (void)checkResult(wlkInitPresetStruct(input_.below(6), input_.below(32), room, structure));
  }
};

}  // namespace
}  // namespace fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::run<fuzz::Run>(data, size, fuzz::MAX_CALLS);
}
