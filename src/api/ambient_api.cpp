// SPDX-License-Identifier: MIT
// wlkEvalAmbient and wlkEvalIrradiance: the moments of SkyField in the world's axes.
#include <algorithm>
#include <cmath>

#include "api/context.hpp"
#include "api/sky_query.hpp"
#include "api/validate.hpp"

namespace {

using namespace welkin;

// Integrals over all directions w: of L, of L w, of L w w^T.
struct Tensors {
  double light = 0;
  glm::dvec3 first{0};
  glm::dmat3 second{0};
};

void addOuter(glm::dmat3& sum, double value, const glm::dvec3& a, const glm::dvec3& b) {
  sum += value * glm::outerProduct(a, b);
}

// Sloan, Stupid Spherical Harmonics Tricks, 2008.
void storeHarmonics(const Tensors& t, size_t channel, double* coefficients) {
  const glm::dmat3& m = t.second;
  const double values[WLK_AMBIENT_VALUES / 3] = {0.28209479177387814 * t.light,
                                                 0.48860251190291992 * t.first.y,
                                                 0.48860251190291992 * t.first.z,
                                                 0.48860251190291992 * t.first.x,
                                                 1.0925484305920792 * m[0][1],
                                                 1.0925484305920792 * m[1][2],
                                                 0.31539156525252005 * (3 * m[2][2] - t.light),
                                                 1.0925484305920792 * m[0][2],
                                                 0.54627421529603959 * (m[0][0] - m[1][1])};
  for (size_t i = 0; i < WLK_AMBIENT_VALUES / 3; ++i) {
    coefficients[3 * i + channel] = values[i];
  }
}

// Irradiance from the integrals of L, of L x and of L x^2, x = cosine with the normal, by three
// terms of the clamped cosine: 1/4 + x/2 + 5/32 (3 x^2 - 1). Ramamoorthi and Hanrahan, On the
// relationship between radiance and irradiance, J. Opt. Soc. Am. A 18, 2001.
double irradianceOf(double light, double first, double second) {
  return light / 4 + first / 2 + 5.0 / 32 * (3 * second - light);
}

double irradianceOn(const glm::dvec3& normal, const Tensors& t) {
  return irradianceOf(t.light, glm::dot(normal, t.first), glm::dot(normal, t.second * normal));
}

double irradianceUp(const SkyField::Moments& m, size_t colour) {
  const double light = m[0][colour] + m[1][colour] + m[2][colour];
  return irradianceOf(light, m[5][colour], m[1][colour]);
}

// Legendre polynomial of degree 4.
double fourth(double x) {
  return ((35 * x * x - 30) * x * x + 3) / 8;
}

// Light around a point, per unit irradiance of the light.
struct Surroundings {
  Tensors sky[3];   // by colour
  SkyColor peak{};  // irradiance from the light's direction, not in the tensors
  // What the tensors alone give horizontal ground too much: the horizon's bright band, which three
  // terms of the cosine are too few for. It is a fourth term, symmetric around the up.
  SkyColor band{};
  glm::dvec3 up{0};
};

// Light turned by the fog's forward peak counts as the light's own direction, but half of a lobe
// around a light at the horizon is not seen: the height of the light against the lobe's width.
// Fitted to wlkEvalSkyMap with droplets of 1 and 10 um at heights of 2 to 60 degrees.
constexpr double LOBE = 0.15;
double seenShareOfPeak(const AirInput& air, double altitude, double sunMu) {
  const double dip = std::sqrt(altitude * (2 * air.planetRadius + altitude));
  const double height = std::max(sunMu + dip / (air.planetRadius + altitude), 0.0);
  const double hidden = 1 - height / std::sqrt(height * height + LOBE * LOBE);
  return 1 - hidden * std::exp(-std::max(altitude - air.fogBaseAltitude, 0.0) / air.fogScaleHeight);
}

// The band grows a little up to the air's scale height and is gone at three of them; above fog, the
// fog's own is gone. By the fog's vertical optical depth; fitted like LOBE, without fog and at
// depths of 0.012 and 0.2.
double bandShare(const AirInput& air, double altitude) {
  const double clear = std::clamp(2 - altitude / (1.5 * air.airScaleHeight), 0.0, 1.0);
  const double base = std::min(air.fogBaseAltitude / air.fogScaleHeight, 30.0);
  const double above = 1 / (1 + 7.5 * air.fogExtinction * air.fogScaleHeight * std::exp(base));
  const double inFog =
      std::exp(-std::max(altitude - air.fogBaseAltitude, 0.0) / air.fogScaleHeight);
  return clear * (above + (1 - above) * inFog);
}

Surroundings surroundingsOf(const SkyField& field, const AirQuery& query,
                            const PlanetFrame& frame) {
  if (frame.altitude > field.top()) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "position",
         "position is %g m high, ambient light is known up to %g m", frame.altitude, field.top());
  }
  const double altitude = std::max(frame.altitude, 0.0);
  const double sunMu = std::clamp(glm::dot(query.toLight, frame.up), -1.0, 1.0);
  const SkyField::Moments moments = field.momentsAt(altitude, sunMu);
  Surroundings around;
  around.up = frame.up;
  around.peak = field.peakIrradianceAt(altitude, sunMu);
  for (double& one : around.peak) {
    one *= seenShareOfPeak(query.air, altitude, sunMu);
  }
  const SkyField::Moments low = field.momentsAt(0, sunMu);
  const SkyColor ground = field.irradianceAt(sunMu);
  const double share = bandShare(query.air, altitude);
  // The frame of the moments; with the light overhead any azimuth will do.
  const glm::dvec3 flat = query.toLight - sunMu * frame.up;
  const glm::dvec3 other = std::abs(frame.up.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 along =
      glm::length(flat) > 1e-9 ? glm::normalize(flat) : glm::normalize(glm::cross(frame.up, other));
  const glm::dvec3 across = glm::cross(along, frame.up);
  for (size_t k = 0; k < 3; ++k) {
    const auto at = [&](size_t moment) { return moments[moment][k]; };
    Tensors& sum = around.sky[k];
    sum.light = at(0) + at(1) + at(2);
    sum.first = at(4) * along + at(5) * frame.up;
    addOuter(sum.second, at(0), along, along);
    addOuter(sum.second, at(1), frame.up, frame.up);
    addOuter(sum.second, at(2), across, across);
    addOuter(sum.second, at(3), along, frame.up);
    addOuter(sum.second, at(3), frame.up, along);
    around.band[k] = share * (irradianceUp(low, k) - ground[k]);
  }
  return around;
}

}  // namespace

WlkResult wlkEvalAmbient(WlkContext context, const double position[3],
                         double coefficients[WLK_AMBIENT_VALUES]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const glm::dvec3 point = checkedPoint(position, "position");
    checkPointer(coefficients, "coefficients");
    std::array<double, WLK_AMBIENT_VALUES> total{};
    for (uint32_t l = 0; l < c.air.lightCount; ++l) {
      const AirQuery query = airQueryOf(c.air, l);
      const Surroundings around = surroundingsOf(skyFieldOf(c, airQueryOf(c.air)), query,
                                                 planetFrameAt(c.air.planet, point));
      std::array<double, WLK_AMBIENT_VALUES> one{};
      for (size_t k = 0; k < 3; ++k) {
        Tensors sum = around.sky[k];
        sum.light += around.peak[k];
        sum.first += around.peak[k] * query.toLight;
        addOuter(sum.second, around.peak[k], query.toLight, query.toLight);
        storeHarmonics(sum, k, one.data());
        for (size_t i = 0; i < WLK_AMBIENT_VALUES / 3; ++i) {
          total[3 * i + k] += one[3 * i + k] * query.irradiance[k];
        }
      }
    }
    std::copy(total.begin(), total.end(), coefficients);
    return WLK_SUCCESS;
  });
}

WlkResult wlkEvalIrradiance(WlkContext context, const double position[3], const double normal[3],
                            double direct[3], double diffuse[3]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const glm::dvec3 point = checkedPoint(position, "position");
    const glm::dvec3 facing = checkedDirection(normal, "normal");
    const PlanetFrame frame = planetFrameAt(c.air.planet, point);
    glm::dvec3 sky(0);
    glm::dvec3 light(0);
    for (uint32_t l = 0; l < c.air.lightCount; ++l) {
      const AirQuery query = airQueryOf(c.air, l);
      const double cosine = std::max(glm::dot(facing, query.toLight), 0.0);
      if (diffuse != nullptr) {
        const Surroundings around = surroundingsOf(skyFieldOf(c, airQueryOf(c.air)), query, frame);
        for (size_t k = 0; k < 3; ++k) {
          // The peak comes from one direction, which needs no harmonics.
          const double one = irradianceOn(facing, around.sky[k]) + around.peak[k] * cosine -
                             around.band[k] * fourth(glm::dot(facing, around.up));
          sky[static_cast<int>(k)] += std::max(one, 0.0) * query.irradiance[k];
        }
      }
      if (direct != nullptr && cosine > 0) {
        light += cosine * lightIrradiance(query, frame);
      }
    }
    for (int k = 0; k < 3; ++k) {
      if (direct != nullptr) {
        direct[k] = light[k];
      }
      if (diffuse != nullptr) {
        diffuse[k] = sky[k];
      }
    }
    return WLK_SUCCESS;
  });
}
