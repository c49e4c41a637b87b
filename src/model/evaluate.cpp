// SPDX-License-Identifier: MIT
#include "model/evaluate.hpp"

#include "model/air_input.hpp"
#include "model/model.hpp"

namespace welkin {
namespace {

using namespace model::f64;

vec3 vectorOf(const double v[3]) {
  return vec3(v[0], v[1], v[2]);
}

void store(const vec3& v, double out[3]) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

}  // namespace

void evalAirRay(const AirInput& air, double altitude, double viewMu, double sunMu, double viewSun,
                double distance, const double fogPhase[3], double angularRadius, double radiance[3],
                double opticalDepth[3]) {
  AirRay ray;
  ray.altitude = altitude;
  ray.viewMu = viewMu;
  ray.sunMu = sunMu;
  ray.viewSun = viewSun;
  const AirResult result = airAlongRay(airFrom(air), ray, distance, rayleighPhase(1.0 - viewSun),
                                       vectorOf(fogPhase), angularRadius);
  store(result.radiance, radiance);
  store(result.opticalDepth, opticalDepth);
}

void evalAirDepth(const AirInput& air, double altitude, double viewMu, double distance,
                  double opticalDepth[3]) {
  AirRay ray;
  ray.altitude = altitude;
  ray.viewMu = viewMu;
  ray.sunMu = 1.0;
  ray.viewSun = viewMu;
  store(airOpticalDepth(airFrom(air), ray, distance), opticalDepth);
}

void evalLightDepth(const AirInput& air, double altitude, double lightMu, double angularRadius,
                    double opticalDepth[3], double* visibility) {
  const Air input = airFrom(air);
  store(lightOpticalDepth(input, altitude, lightMu), opticalDepth);
  *visibility = lightVisibility(input, altitude, lightMu, angularRadius);
}

double evalGroundDistance(double altitude, double viewMu, double planetRadius) {
  return groundDistance(altitude, viewMu, planetRadius);
}

double evalRayleigh(double y) {
  return rayleighPhase(y);
}

}  // namespace welkin
