// SPDX-License-Identifier: MIT
// Successive orders of scattering for SkyField.
#include "tables/sky_field_solver.hpp"

#include <limits>

#include "model/air_input.hpp"
#include "model/model.hpp"
#include "tables/fog_light_solver.hpp"
#include "tables/sky_fan.hpp"
#include "tables/sky_light.hpp"
#include "tables/sky_zenith.hpp"

namespace welkin {
namespace {

using namespace model::f64;

constexpr double PI = std::numbers::pi;
constexpr size_t ALTITUDES = SkyField::ALTITUDES;
constexpr size_t SUNS = SkyField::SUNS;
// An order whose largest share is smaller ends the sum; what would follow is summed as a geometric
// series.
constexpr double LAST_SHARE = 2e-3;
constexpr double LARGEST_RATIO = 0.98;

// One order of scattering at every node.
struct Order {
  std::vector<float> moments = std::vector<float>(ALTITUDES * SUNS * VALUES);
  std::vector<float> irradiance = std::vector<float>(SUNS * LANES);
};

// All directions of one zenith angle, and the steps along them. They are the same in every order;
// the first one plans them.
struct Cone {
  double cosine;
  double weight;  // solid angle of one azimuth and its mirror image
  SkyRay ray;
};

struct Angle {
  double cosine;
  double sine;
};

// Takes one order of scattering to the next.
class Gatherer {
 public:
  Gatherer(const SkyFieldInput& input, const AirInput& scaled, const std::array<SkyColor, 2>& chi,
           const SkyFieldSteps& steps);

  // One altitude of an order that follows `previous`, or of the light itself if that is null.
  void gather(const Order* previous, size_t altitude, Order& next);

 private:
  void gatherCone(const Order* previous, size_t altitude, const Cone& cone);
  void addScattered(const Order& previous, const SkyStep& step, float radius, float viewMu);
  void addSunlit(const SkyStep& step, float radius);
  void addGround(const Order* previous, const Cone& cone, float radius);
  void addMoments(const Cone& cone, size_t altitude, Order& next) const;

  AirInput scaled_;
  SkyAxes axes_;
  int stepCount_;
  Air air_;
  FogTerms terms_;
  SkyColor albedo_;
  double lightRadius_;
  std::array<Angle, SUNS> suns_{};  // from the up
  Suns sunMu_{};
  std::vector<double> altitudes_;
  std::vector<Angle> azimuths_;  // of half the circle
  std::vector<Cone> cones_;      // by altitude
  // Of the cone in work: one fan for each azimuth.
  std::vector<SkyFan> fans_;
  SkySource airs_{};
  SkySource fogs_{};
};

Gatherer::Gatherer(const SkyFieldInput& input, const AirInput& scaled,
                   const std::array<SkyColor, 2>& chi, const SkyFieldSteps& steps)
    : scaled_(scaled),
      axes_(scaled),
      stepCount_(steps.steps),
      air_(airFrom(scaled)),
      terms_(fogTerms(chi)),
      albedo_(input.groundAlbedo),
      lightRadius_(input.lightAngularRadius) {
  for (size_t s = 0; s < SUNS; ++s) {
    const double mu = SkyAxes::sunAt(static_cast<double>(s) / (SUNS - 1));
    suns_[s] = {mu, std::sqrt((1 - mu) * (1 + mu))};
    sunMu_[s] = static_cast<float>(mu);
  }
  // The other half of the circle is their mirror image.
  const int half = steps.azimuths / 2;
  for (int j = 0; j < half; ++j) {
    const double azimuth = PI * (j + 0.5) / half;
    azimuths_.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
  fans_.resize(azimuths_.size());
  const std::vector<Zenith> nodes = gaussNodes(steps.zenithNodes);
  for (size_t a = 0; a < ALTITUDES; ++a) {
    const double altitude = axes_.altitudeAt(static_cast<double>(a) / (ALTITUDES - 1));
    altitudes_.push_back(altitude);
    const double horizon = horizonMu(altitude, air_.planetRadius);
    for (const Zenith& zenith : zenithNodes(horizon, nodes)) {
      cones_.push_back({zenith.cosine, zenith.weight * 2 * PI / half, {}});
      cones_.back().ray.steps.reserve(static_cast<size_t>(stepCount_));
    }
  }
}

void Gatherer::gather(const Order* previous, size_t altitude, Order& next) {
  std::fill_n(next.moments.data() + altitude * SUNS * VALUES, SUNS * VALUES, 0.0F);
  if (altitude == 0) {
    std::fill(next.irradiance.begin(), next.irradiance.end(), 0.0F);
  }
  const size_t count = cones_.size() / ALTITUDES;
  for (size_t i = altitude * count; i < (altitude + 1) * count; ++i) {
    if (previous == nullptr) {
      planRay(scaled_, axes_, altitudes_[altitude], cones_[i].cosine,
              std::numeric_limits<double>::infinity(), stepCount_, cones_[i].ray);
    }
    gatherCone(previous, altitude, cones_[i]);
    addMoments(cones_[i], altitude, next);
  }
}

void Gatherer::gatherCone(const Order* previous, size_t altitude, const Cone& cone) {
  const double sine = std::sqrt((1 - cone.cosine) * (1 + cone.cosine));
  for (size_t j = 0; j < fans_.size(); ++j) {
    for (size_t s = 0; s < SUNS; ++s) {
      fans_[j].viewSun[s] = static_cast<float>(sine * azimuths_[j].cosine * suns_[s].sine +
                                               cone.cosine * suns_[s].cosine);
      fans_[j].radiance[s] = {};
    }
  }
  const auto radius = static_cast<float>(air_.planetRadius + altitudes_[altitude]);
  for (const SkyStep& step : cone.ray.steps) {
    if (previous != nullptr) {
      addScattered(*previous, step, radius, static_cast<float>(cone.cosine));
    } else {
      addSunlit(step, radius);
    }
  }
  if (cone.ray.ground >= 0) {
    addGround(previous, cone, radius);
  }
}

void Gatherer::addScattered(const Order& previous, const SkyStep& step, float radius,
                            float viewMu) {
  const float y = std::clamp((radius * viewMu + step.distance) * (1 / step.radius), -1.0F, 1.0F);
  const float flat = std::sqrt((1 - y) * (1 + y));
  const bool fog = air_.fogExtinction > 0;
  const float* moments = previous.moments.data() + step.high.index * SUNS * VALUES;
  airSource(moments, step, y, flat, airs_);
  if (fog) {
    fogSource(moments, step, terms_, y, flat, fogs_);
  }
  for (SkyFan& fan : fans_) {
    const SkyPlaces places =
        placesOf(sunsAt(step, radius, sunMu_, fan.viewSun), fan.viewSun, y, flat);
    addAir(airs_, places, fan);
    if (fog) {
      addFog(fogs_, places, fan);
    }
  }
}

void Gatherer::addSunlit(const SkyStep& step, float radius) {
  const LightAtAltitude light(air_, step.altitude, lightRadius_);
  const FogTerms chi = terms_;
  Lanes air;
  Lanes fog;
  for (size_t c = 0; c < LANES; ++c) {
    air[c] = RAYLEIGH * step.air[c];
    fog[c] = ISOTROPIC * step.fog[c];
  }
  for (SkyFan& fan : fans_) {
    const Suns mu = sunsAt(step, radius, sunMu_, fan.viewSun);
    const std::array<Lanes, SUNS> transmittance = light.at(mu);
    for (size_t s = 0; s < SUNS; ++s) {
      const float cosine = fan.viewSun[s];
      const float square = cosine * cosine;
      Lanes radiance = fan.radiance[s];
      for (size_t c = 0; c < LANES; ++c) {
        const float phase = 1 + chi.first[c] * cosine + chi.second[c] * (3 * square - 1);
        const float scattered = air[c] * (1 + square) + fog[c] * std::max(phase, 0.0F);
        radiance[c] += transmittance[s][c] * scattered;
      }
      fan.radiance[s] = radiance;
    }
  }
}

void Gatherer::addGround(const Order* previous, const Cone& cone, float radius) {
  Lanes albedo{};
  for (size_t c = 0; c < 3; ++c) {
    albedo[c] = cone.ray.atGround[c] * static_cast<float>(albedo_[c] / PI);
  }
  const LightAtAltitude light(air_, 0, lightRadius_);
  for (SkyFan& fan : fans_) {
    Suns mu;  // at the foot
    for (size_t s = 0; s < SUNS; ++s) {
      const double foot = (static_cast<double>(radius) * static_cast<double>(sunMu_[s]) +
                           cone.ray.ground * static_cast<double>(fan.viewSun[s])) /
                          air_.planetRadius;
      mu[s] = static_cast<float>(std::clamp(foot, -1.0, 1.0));
    }
    std::array<Lanes, SUNS> irradiance;
    if (previous == nullptr) {
      irradiance = light.at(mu);
      for (size_t s = 0; s < SUNS; ++s) {
        for (float& one : irradiance[s]) {
          one *= std::max(mu[s], 0.0F);
        }
      }
    } else {
      for (size_t s = 0; s < SUNS; ++s) {
        irradiance[s] = irradianceIn(previous->irradiance, static_cast<double>(mu[s]));
      }
    }
    for (size_t s = 0; s < SUNS; ++s) {
      for (size_t c = 0; c < LANES; ++c) {
        fan.radiance[s][c] += albedo[c] * irradiance[s][c];
      }
    }
  }
}

void Gatherer::addMoments(const Cone& cone, size_t altitude, Order& next) const {
  const double sine = std::sqrt((1 - cone.cosine) * (1 + cone.cosine));
  const double y = cone.cosine;
  for (size_t j = 0; j < fans_.size(); ++j) {
    const double x = sine * azimuths_[j].cosine;
    const double z = sine * azimuths_[j].sine;
    const double products[SkyField::MOMENTS] = {x * x, y * y, z * z, x * y, x, y};
    float weights[SkyField::MOMENTS];
    for (size_t k = 0; k < SkyField::MOMENTS; ++k) {
      weights[k] = static_cast<float>(cone.weight * products[k]);
    }
    for (size_t s = 0; s < SUNS; ++s) {
      const Lanes radiance = fans_[j].radiance[s];
      float* out = next.moments.data() + (altitude * SUNS + s) * VALUES;
      for (size_t k = 0; k < SkyField::MOMENTS; ++k) {
        for (size_t c = 0; c < LANES; ++c) {
          out[k * LANES + c] += weights[k] * radiance[c];
        }
      }
      if (altitude == 0 && y > 0) {
        for (size_t c = 0; c < LANES; ++c) {
          next.irradiance[LANES * s + c] += weights[SkyField::MOMENTS - 1] * radiance[c];
        }
      }
    }
  }
}

void add(std::vector<float>& sum, const std::vector<float>& more, float scale) {
  for (size_t i = 0; i < sum.size(); ++i) {
    sum[i] += scale * more[i];
  }
}

// Sum of the light in all directions over all nodes.
double energy(const std::vector<float>& moments) {
  double sum = 0;
  for (size_t i = 0; i < moments.size(); i += VALUES) {
    for (size_t k = 0; k < 3 * LANES; ++k) {
      sum += static_cast<double>(moments[i + k]);
    }
  }
  return sum;
}

// Mean of the colours, which differ by a few per cent: the extinction is grey. `l`: from 1 on.
double meanMoment(const SkyFieldInput& input, size_t l) {
  double sum = 0;
  for (const double one : input.fogMoments[l - 1]) {
    sum += std::clamp(one, 0.0, 0.99) / 3;
  }
  return sum;
}

// What is left of fog without the part `peak` of its scattering.
AirInput withoutPeak(double peak, const SkyFieldInput& input) {
  double albedo = 0;
  for (const double one : input.air.fogAlbedo) {
    albedo += one / 3;
  }
  AirInput air = input.air;
  air.fogExtinction *= 1 - albedo * peak;
  for (size_t c = 0; c < 3; ++c) {
    air.fogAlbedo[c] = std::min(input.air.fogAlbedo[c] * (1 - peak) / (1 - albedo * peak), 1.0);
  }
  return air;
}

double momentWithout(double peak, double moment) {
  return (moment - peak) / (1 - peak);
}

FogLightInput fogLightInputOf(const SkyFieldInput& input, const AirInput& eye, double peak) {
  FogLightInput fog;
  fog.air = eye;
  fog.groundAlbedo = input.groundAlbedo;
  fog.lightAngularRadius = input.lightAngularRadius;
  for (size_t c = 0; c < 3; ++c) {
    fog.terms[c][0] = 1;
    for (size_t l = 1; l < FOG_TERMS; ++l) {
      fog.terms[c][l] = momentWithout(peak, input.fogMoments[l - 1][c]);
    }
  }
  return fog;
}

}  // namespace

struct SkyFieldSolver::State {
  SkyFieldInput input;
  int maxOrders;
  SkyField field;
  Gatherer gatherer;
  FogLightSolver fog;
  std::array<Order, 2> orders;  // the one in work and its predecessor
  double last = 0;              // energy of the predecessor
  size_t rows = 0;
  bool enough = false;  // orders
  [[nodiscard]] bool done() const { return enough && fog.done(); }

  Order& order(int number) { return orders[static_cast<size_t>(number % 2)]; }
};

SkyFieldSolver::SkyFieldSolver(const SkyFieldInput& input, const SkyFieldSteps& steps) {
  SkyField field;
  field.groundAlbedo_ = input.groundAlbedo;
  field.lightAngularRadius_ = input.lightAngularRadius;
  field.peak_ = meanMoment(input, 3);
  // Of droplets that scatter backwards the odd moments are negative: they have no peak.
  field.eyePeak_ = std::min(meanMoment(input, FOG_TERMS), meanMoment(input, FOG_TERMS - 1));
  field.air_ = withoutPeak(field.peak_, input);
  field.eye_ = withoutPeak(field.eyePeak_, input);
  FogLightSolver fog(fogLightInputOf(input, field.eye_, field.eyePeak_));
  for (size_t c = 0; c < 3; ++c) {
    double top = 1;
    for (size_t l = 1; l < FOG_TERMS; ++l) {
      top += static_cast<double>(2 * l + 1) *
             momentWithout(field.eyePeak_, input.fogMoments[l - 1][c]);
    }
    field.fogBound_[c] = std::max(top, 1.0) / (4 * PI);
    for (size_t l = 0; l < 2; ++l) {
      field.fogMoments_[l][c] = momentWithout(field.peak_, input.fogMoments[l][c]);
    }
  }
  field.attenuated_ = input.air;
  for (double& albedo : field.attenuated_.fogAlbedo) {
    albedo *= 1 - field.eyePeak_;
  }
  field.moments_.resize(ALTITUDES * SUNS * VALUES);
  field.irradiance_.resize(SUNS * LANES);
  Gatherer gatherer(input, field.air_, field.fogMoments_, steps);
  state_ = std::make_unique<State>(
      State{input, steps.maxOrders, std::move(field), std::move(gatherer), std::move(fog), {}});
}

SkyFieldSolver::SkyFieldSolver(SkyFieldSolver&&) noexcept = default;
SkyFieldSolver& SkyFieldSolver::operator=(SkyFieldSolver&&) noexcept = default;
SkyFieldSolver::~SkyFieldSolver() = default;

bool SkyFieldSolver::advance(size_t rows) {
  State& state = *state_;
  for (; rows > 0 && !state.done(); --rows) {
    if (state.enough) {
      state.fog.advance();
      ++state.rows;
      continue;
    }
    const int number = state.field.orders_;
    const Order* previous = number > 0 ? &state.order(number - 1) : nullptr;
    state.gatherer.gather(previous, state.rows % ALTITUDES, state.order(number));
    ++state.rows;
    if (state.rows % ALTITUDES == 0) {
      finishOrder();
    }
  }
  return state.done();
}

void SkyFieldSolver::finishOrder() {
  State& state = *state_;
  SkyField& field = state.field;
  const Order& order = state.order(field.orders_);
  ++field.orders_;
  const double now = energy(order.moments);
  bool ends = field.orders_ >= state.maxOrders;
  double scale = 1;
  if (field.orders_ > 1) {
    const double ratio = std::min(now / state.last, LARGEST_RATIO);
    ends = ends || now < LAST_SHARE * energy(field.moments_);
    scale = ends ? 1 / (1 - ratio) : 1;
  }
  add(field.moments_, order.moments, static_cast<float>(scale));
  add(field.irradiance_, order.irradiance, static_cast<float>(scale));
  state.last = now;
  state.enough = ends || !(now > 0);
}

bool SkyFieldSolver::done() const {
  return state_->done();
}

size_t SkyFieldSolver::rows() const {
  return state_->rows;
}

const SkyFieldInput& SkyFieldSolver::input() const {
  return state_->input;
}

SkyField SkyFieldSolver::take() {
  SkyField field = std::move(state_->field);
  if (field.eye_.fogExtinction > 0) {
    field.fogLight_ = std::make_shared<const FogLight>(state_->fog.take());
  }
  return field;
}

SkyField solveSkyField(const SkyFieldInput& input, const SkyFieldSteps& steps) {
  SkyFieldSolver solver(input, steps);
  while (!solver.advance(ALTITUDES)) {
  }
  return solver.take();
}

}  // namespace welkin
