// SPDX-License-Identifier: MIT
// Successive orders of scattering for SkyField.
#include <limits>

#include "model/air_input.hpp"
#include "model/model.hpp"
#include "tables/sky_field.hpp"
#include "tables/sky_ray.hpp"

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

struct Zenith {
  double cosine;
  double weight;
};

// Gauss nodes in the square root of the distance from the horizon, where radiance changes fastest.
std::vector<Zenith> zenithNodes(double horizon, int count) {
  std::vector<Zenith> nodes;
  for (int i = 0; i < count; ++i) {
    // Newton's iteration for the roots of P_n, from the usual guess.
    double x = std::cos(PI * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int k = 0; k < 50; ++k) {
      double p0 = 1;
      double p1 = x;
      for (int l = 2; l <= count; ++l) {
        const double p2 = ((2 * l - 1) * x * p1 - (l - 1) * p0) / l;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    const double s = 0.5 + 0.5 * x;
    const double weight = 1 / ((1 - x * x) * slope * slope) * 2 * s;
    nodes.push_back({horizon + (1 - horizon) * s * s, weight * (1 - horizon)});
    nodes.push_back({horizon - (1 + horizon) * s * s, weight * (1 + horizon)});
  }
  return nodes;
}

// One order of scattering at every node.
struct Order {
  std::vector<float> moments;
  std::vector<float> irradiance;
};

class Solver {
 public:
  Solver(const SkyFieldInput& input, const AirInput& scaled, const std::array<SkyColor, 2>& chi,
         const SkyFieldSteps& steps)
      : input_(scaled),
        air_(airFrom(scaled)),
        axes_(scaled),
        terms_(fogTerms(chi)),
        albedo_(input.groundAlbedo),
        radius_(input.lightAngularRadius),
        steps_(steps) {
    for (size_t a = 0; a < ALTITUDES; ++a) {
      altitudes_.push_back(axes_.altitudeAt(static_cast<double>(a) / (ALTITUDES - 1)));
    }
  }

  // Of the light itself if `previous` is null.
  Order gather(const Order* previous) const {
    Order next{std::vector<float>(ALTITUDES * SUNS * VALUES), std::vector<float>(SUNS * LANES)};
    for (size_t a = 0; a < ALTITUDES; ++a) {
      const double horizon = horizonMu(altitudes_[a], air_.planetRadius);
      for (const Zenith& zenith : zenithNodes(horizon, steps_.zenithNodes)) {
        gatherCone(previous, a, zenith, next);
      }
    }
    return next;
  }

 private:
  struct Light {
    Lanes transmittance;
  };
  Light lightAt(double altitude, double sunMu) const {
    const double visible = lightVisibility(air_, altitude, sunMu, radius_);
    Light light{};
    if (visible > 0) {
      const vec3 depth = lightOpticalDepth(air_, altitude, sunMu);
      for (int c = 0; c < 3; ++c) {
        light.transmittance[static_cast<size_t>(c)] =
            static_cast<float>(visible * std::exp(-depth[c]));
      }
    }
    return light;
  }

  // All azimuths of one zenith angle for every sun; the other half of the circle is their mirror.
  void gatherCone(const Order* previous, size_t a, const Zenith& zenith, Order& next) const {
    const SkyRay plan = planRay(input_, axes_, altitudes_[a], zenith.cosine,
                                std::numeric_limits<double>::infinity(), steps_.steps);
    const auto half = static_cast<size_t>(steps_.azimuths / 2);
    const double sine = std::sqrt((1 - zenith.cosine) * (1 + zenith.cosine));
    std::vector<SkyAim> aims;
    for (size_t s = 0; s < SUNS; ++s) {
      const double sunMu = SkyAxes::sunAt(static_cast<double>(s) / (SUNS - 1));
      const double sunSine = std::sqrt((1 - sunMu) * (1 + sunMu));
      for (size_t j = 0; j < half; ++j) {
        const double azimuth = PI * (static_cast<double>(j) + 0.5) / static_cast<double>(half);
        const double viewSun = sine * std::cos(azimuth) * sunSine + zenith.cosine * sunMu;
        aims.push_back({static_cast<float>(air_.planetRadius + altitudes_[a]),
                        static_cast<float>(zenith.cosine), static_cast<float>(sunMu),
                        static_cast<float>(viewSun)});
      }
    }
    std::vector<Lanes> radiance(aims.size());
    for (const SkyStep& step : plan.steps) {
      if (previous != nullptr) {
        addScattered(*previous, step, aims, radiance);
      } else {
        addSunlit(step, aims, radiance);
      }
    }
    for (size_t i = 0; i < aims.size(); ++i) {
      if (plan.ground >= 0) {
        addGround(previous, plan, aims[i], radiance[i]);
      }
      const double azimuth = PI * (static_cast<double>(i % half) + 0.5) / static_cast<double>(half);
      const double weight = zenith.weight * 2 * PI / static_cast<double>(half);
      const double x = sine * std::cos(azimuth);
      const double y = zenith.cosine;
      const double z = sine * std::sin(azimuth);
      const double products[SkyField::MOMENTS] = {x * x, y * y, z * z, x * y, x, y};
      float* out = next.moments.data() + (a * SUNS + i / half) * VALUES;
      for (size_t k = 0; k < VALUES; ++k) {
        out[k] += static_cast<float>(weight * products[k / LANES]) * radiance[i][k % LANES];
      }
      if (a == 0 && y > 0) {
        for (size_t c = 0; c < LANES; ++c) {
          next.irradiance[LANES * (i / half) + c] +=
              static_cast<float>(weight * y) * radiance[i][c];
        }
      }
    }
  }

  void addScattered(const Order& previous, const SkyStep& step, const std::vector<SkyAim>& aims,
                    std::vector<Lanes>& radiance) const {
    SunRow row;
    blendAltitudes(previous.moments, step.high, 0, row.size(), row.data());
    const bool fog = air_.fogExtinction > 0;
    for (size_t i = 0; i < aims.size(); ++i) {
      const SkyPlace place = placeAt(aims[i], step);
      const SkyLight g = gatherMoments(row.data(), place.view, sunNode(place.sunMu));
      for (size_t c = 0; c < LANES; ++c) {
        radiance[i][c] += step.air[c] * RAYLEIGH * (g.mean[c] + g.square[c]);
      }
      if (fog) {
        for (size_t c = 0; c < LANES; ++c) {
          const float source = g.mean[c] + terms_.first[c] * g.along[c] +
                               terms_.second[c] * (3 * g.square[c] - g.mean[c]);
          radiance[i][c] += step.fog[c] * ISOTROPIC * std::max(source, 0.0F);
        }
      }
    }
  }

  void addSunlit(const SkyStep& step, const std::vector<SkyAim>& aims,
                 std::vector<Lanes>& radiance) const {
    for (size_t i = 0; i < aims.size(); ++i) {
      const SkyPlace place = placeAt(aims[i], step);
      const Light light = lightAt(step.altitude, static_cast<double>(place.sunMu));
      const float cosine = aims[i].viewSun;
      const float rayleigh = RAYLEIGH * (1 + cosine * cosine);
      for (size_t c = 0; c < 3; ++c) {
        const float fog =
            1 + terms_.first[c] * cosine + terms_.second[c] * (3 * cosine * cosine - 1);
        radiance[i][c] += light.transmittance[c] *
                          (step.air[c] * rayleigh + step.fog[c] * ISOTROPIC * std::max(fog, 0.0F));
      }
    }
  }

  void addGround(const Order* previous, const SkyRay& plan, const SkyAim& aim,
                 Lanes& radiance) const {
    const double foot = (static_cast<double>(aim.radius) * static_cast<double>(aim.sunMu) +
                         plan.ground * static_cast<double>(aim.viewSun)) /
                        air_.planetRadius;
    const double mu = std::clamp(foot, -1.0, 1.0);
    Lanes irradiance{};
    if (previous == nullptr) {
      irradiance = lightAt(0, mu).transmittance;
      for (float& one : irradiance) {
        one *= static_cast<float>(std::max(mu, 0.0));
      }
    } else {
      irradiance = irradianceIn(previous->irradiance, mu);
    }
    for (size_t c = 0; c < 3; ++c) {
      radiance[c] += plan.atGround[c] * static_cast<float>(albedo_[c] / PI) * irradiance[c];
    }
  }

  AirInput input_;
  Air air_;
  SkyAxes axes_;
  FogTerms terms_;
  SkyColor albedo_;
  double radius_;
  SkyFieldSteps steps_;
  std::vector<double> altitudes_;
};

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

// Of the fog's forward peak, as much as counts as unscattered along a ray that is looked at. The
// third moment belongs to a lobe tens of degrees wide, and thin haze is a band of a degree or two
// at the horizon: light that is turned by more than that leaves it. By the vertical optical depth.
// Chosen among 0 to 1 on random rays in Henyey-Greenstein 0.76 and 0.87, depths 0.012 to 0.5.
double eyeShare(const AirInput& air) {
  const double base = std::min(air.fogBaseAltitude / air.fogScaleHeight, 30.0);
  const double depth = air.fogExtinction * air.fogScaleHeight * std::exp(base);
  return std::min(1.0, std::pow(depth, 0.3));
}

// What is left of fog without the part `peak` of its scattering.
void takeOff(double peak, const SkyFieldInput& input, AirInput& air,
             std::array<SkyColor, 2>& moments) {
  double albedo = 0;
  for (const double one : input.air.fogAlbedo) {
    albedo += one / 3;
  }
  air = input.air;
  air.fogExtinction *= 1 - albedo * peak;
  for (size_t c = 0; c < 3; ++c) {
    air.fogAlbedo[c] = std::min(input.air.fogAlbedo[c] * (1 - peak) / (1 - albedo * peak), 1.0);
    for (size_t l = 0; l < 2; ++l) {
      moments[l][c] = (input.fogMoments[l][c] - peak) / (1 - peak);
    }
  }
}

}  // namespace

SkyField solveSkyField(const SkyFieldInput& input, const SkyFieldSteps& steps) {
  SkyField field;
  field.groundAlbedo_ = input.groundAlbedo;
  field.lightAngularRadius_ = input.lightAngularRadius;
  // One peak for all colours: they differ by a few per cent, the extinction is grey.
  for (const double third : input.fogMoments[2]) {
    field.peak_ += std::clamp(third, 0.0, 0.99) / 3;
  }
  field.eyePeak_ = eyeShare(input.air) * field.peak_;
  takeOff(field.peak_, input, field.air_, field.fogMoments_);
  takeOff(field.eyePeak_, input, field.eye_, field.eyeMoments_);
  field.attenuated_ = input.air;
  for (double& albedo : field.attenuated_.fogAlbedo) {
    albedo *= 1 - field.eyePeak_;
  }
  const Solver solver(input, field.air_, field.fogMoments_, steps);
  Order order = solver.gather(nullptr);
  field.moments_ = order.moments;
  field.irradiance_ = order.irradiance;
  field.orders_ = 1;
  double last = energy(order.moments);
  while (field.orders_ < steps.maxOrders && last > 0) {
    order = solver.gather(&order);
    ++field.orders_;
    const double now = energy(order.moments);
    const double ratio = std::min(now / last, LARGEST_RATIO);
    const bool ends = now < LAST_SHARE * energy(field.moments_) || field.orders_ == steps.maxOrders;
    const double scale = ends ? 1 / (1 - ratio) : 1;
    add(field.moments_, order.moments, static_cast<float>(scale));
    add(field.irradiance_, order.irradiance, static_cast<float>(scale));
    last = now;
    if (ends) {
      break;
    }
  }
  return field;
}

}  // namespace welkin
