// SPDX-License-Identifier: MIT
#include "frame/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frame/transport_shape.hpp"

namespace welkin {
namespace {

constexpr int GRID = 12;  // rays along either side of the picture

using Color = std::array<double, 3>;

// Fitted constants: m = light left out over light computed, of which the error is m / (1 + m).
struct Fit {
  // Air, from vertical optical depth t of all of it and transmittance T of sunlight down to sea
  // level: m = scatterScale t^scatterPower / T^scatterSun
  //          + groundScale albedo cos(zenith) e^(-groundFade t / cos) / T.
  double scatterScale, scatterPower, scatterSun, groundScale, groundFade;
  // Fog, from reduced depth t = (1 - g) depth along the ray and vertically:
  // m = fogScale t^fogPower / T^fogSun, and the same light of the ground.
  double fogScale, fogPower, fogSun, fogGround;
  // Volumes: m = scale ((1 - g) depth)^power, depth the mean of those along the ray and along the
  // light; seen with the light (cosine 1) and against it (-1), between them in the logarithm.
  double forwardWith, forwardAgainst, forwardPower;
  double singleWith, singleAgainst, singlePower;
  // Slabs: m = slabScale (optical depth of a slab)^slabPower
  //            + voxelScale (slab / voxel along the light)^voxelPower (1 / fill - 1)^edgePower,
  // since bodies that fill little of their box are the ones with much surface.
  double slabScale, slabPower, voxelScale, voxelPower, edgePower;
};
constexpr Fit FIT{
    0.959, 0.691, 0.252,   1.229, 0.669,  // air
    2.462, 0.638, 1.053,   0.011,         // fog
    0.766, 7.73,  0.449,                  // volumes, forward scattering
    1.342, 4.603, 1.361,                  // volumes, single scattering
    0.128, 1.66,  0.00205, 1.80,  1.63,   // slabs
};

double missing(double m) {
  return m / (1 + m);
}

// What all orders leave of the error of the first alone: in air half a per cent, of which no more
// than the part it replaces; in fog two Legendre terms, the fewer the more is scattered again.
constexpr double ALL_ORDERS_AIR = 0.005;
constexpr double ALL_ORDERS_FOG = 1.3;
double leftOfSky(double first) {
  return std::min(first, ALL_ORDERS_AIR);
}
double leftOfFog(double first) {
  return std::min(first, ALL_ORDERS_FOG * first * first * first);
}

// In volumes what the grid of their light leaves, whatever the view: directions, and cells that are
// deep. Fitted to the root mean squares of spheres of optical radius 2 to 30 at every level
// (docs/results/volume-errors.csv); its test allows a factor of 2.
constexpr double ALL_ORDERS_VOLUME = 0.035;
constexpr double ALL_ORDERS_CELLS = 0.4;
constexpr double ALL_ORDERS_CELL_POWER = 1.5;
// And light of sky and ground on volumes, where it is left out: `share` is what they bring over
// what the light does. It counts for less where the light itself scatters much: thin bodies towards
// the light, thick ones on their lit side. Not fitted: factors of the phase functions' and of a
// cloud's two sides, between them in the logarithm.
constexpr double AMBIENT_THIN_WITH = 0.2;
constexpr double AMBIENT_THIN_AGAINST = 4.0;
constexpr double AMBIENT_THICK_WITH = 10.0;  // against the light: 1
double leftOfAmbient(double share, double with, double reducedDepth) {
  const double thin =
      with * std::log(AMBIENT_THIN_WITH) + (1 - with) * std::log(AMBIENT_THIN_AGAINST);
  const double thick = with * std::log(AMBIENT_THICK_WITH);
  const double depth = reducedDepth / (1 + reducedDepth);
  return missing(share * std::exp((1 - depth) * thin + depth * thick));
}
// An eye inside sees single cells: what they are off by is not averaged over many.
constexpr double ALL_ORDERS_INSIDE = 4.0;
double leftOfVolume(double single, double reducedDepthOfCell, bool inside) {
  const double cells = ALL_ORDERS_CELLS * std::pow(reducedDepthOfCell, ALL_ORDERS_CELL_POWER);
  const double near = inside ? missing(ALL_ORDERS_INSIDE * reducedDepthOfCell) : 0.0;
  return std::min(single, std::min(std::hypot(ALL_ORDERS_VOLUME, cells, near), 1.0));
}

// Of all orders only the first follows the slabs.
constexpr double SLABS_OF_FIRST = 0.7;

// Shadows of volumes on air and fog, where they are not drawn: how bright bodies are beside the
// air, in the unit of a phase function that is the same for all angles.
constexpr double BODY_RADIANCE = 0.2;
constexpr int SHADOW_SAMPLES = 32;
constexpr double SHADOW_REACH = 12;     // edges of the box
constexpr double ALL_OVER_FIRST = 1.4;  // light of the sky
constexpr double LAMBERT = 0.318309886183791;

// What of a ray a species contributes: radiance per irradiance of an isotropic phase function, and
// the optical depth.
struct Species {
  Color radiance{};
  Color depth{};
};

Species speciesAlong(const AirInput& air, const PlanetFrame& eye, const glm::dvec3& direction,
                     const ErrorInput& in, double distance) {
  Species s;
  constexpr double ISOTROPIC = 0.0795774715459477;
  const double phase[3] = {ISOTROPIC, ISOTROPIC, ISOTROPIC};
  evalAirRay(air, eye.altitude, glm::dot(direction, eye.up), glm::dot(in.toLight, eye.up),
             glm::dot(direction, in.toLight), distance, phase, in.lightAngularRadius,
             s.radiance.data(), s.depth.data());
  return s;
}

// Distances at which a ray from the eye enters and leaves the unit box; empty if entry >= exit.
std::array<double, 2> crossBox(const glm::dmat3& boxFromWorld, const glm::dvec3& eyeInBox,
                               const glm::dvec3& direction) {
  const glm::dvec3 step = boxFromWorld * direction;
  double entry = 0;
  double exit = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double a = -eyeInBox[i] / step[i];
    const double b = (1 - eyeInBox[i]) / step[i];
    if (step[i] == 0) {
      if (eyeInBox[i] < 0 || eyeInBox[i] > 1) {
        return {0, 0};
      }
      continue;
    }
    entry = std::max(entry, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return {entry, exit};
}

// Light of sky and ground that meets a body from all sides over the light that it casts a shadow
// in: half of what the air takes from the light comes down as the sky's, and of all that reaches
// the ground its albedo comes back.
double ambientShare(double sunMu, double albedo, const Color& sunlight) {
  double share = 0;
  for (const double passed : sunlight) {
    const double sky = 0.5 * (1 - passed);
    share +=
        2 * std::max(sunMu, 0.0) * (sky + albedo * (passed + sky)) / std::max(passed, 1e-6) / 3;
  }
  return std::min(share, 10.0);
}

// A volume with what does not depend on the ray.
class Body {
 public:
  Body(const ErrorVolume& volume, const ErrorInput& in)
      : volume_(volume), cover_(std::cbrt(volume.fill * volume.fill)) {
    const glm::dmat3 axes(volume.worldFromBox);
    boxFromWorld_ = glm::inverse(axes);
    eyeInBox_ = boxFromWorld_ * (in.eye - volume.worldFromBox[3]);
    // Mean chord along the light: volume over shadow.
    const double shadow = std::abs(glm::dot(glm::cross(axes[0], axes[1]), in.toLight)) +
                          std::abs(glm::dot(glm::cross(axes[1], axes[2]), in.toLight)) +
                          std::abs(glm::dot(glm::cross(axes[2], axes[0]), in.toLight));
    const double size = std::abs(glm::determinant(axes));
    thin_ = std::cbrt(volume.fill);
    lightDepth_ = volume.extinction * size / shadow * thin_;
    double chord = 0;  // of the box and of a voxel, along the light
    double cell = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double reach = std::abs(glm::dot(axes[i], in.toLight));
      chord += reach;
      if (reach > 0) {
        cell = std::min(
            cell, glm::dot(axes[i], axes[i]) / (volume.voxels[static_cast<size_t>(i)] * reach));
      }
    }
    voxelsAlong_ = chord / cell;
    const double edges[3] = {glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
    longest_ = *std::max_element(edges, edges + 3);
    const auto thin = static_cast<size_t>(std::min_element(edges, edges + 3) - edges);
    flatness_ = edges[thin] / longest_;
    // Half-way between light and view the light still goes slab by slab.
    if (flatness_ < FLAT && !in.quality.halfAngle) {
      thinVoxels_ = volume.voxels[thin];
    }
    nearest_ = glm::length(volume.worldFromBox * glm::dvec4(0.5, 0.5, 0.5, 1) - in.eye);
  }

  // Error of so many slabs where the body is seen.
  double slices(double slabs) const {
    const double across = flatStretchesAcross(static_cast<uint32_t>(slabs));
    const double voxels = std::min(voxelsAlong_ / slabs, thinVoxels_ / across);
    return missing(FIT.slabScale * std::pow(lightDepth_ / slabs, FIT.slabPower) +
                   FIT.voxelScale * std::pow(voxels, FIT.voxelPower) *
                       std::pow(std::max(1 / volume_.fill - 1, 0.0), FIT.edgePower));
  }

  // Share of the pixel that the body hides, and its error of scattering there.
  struct Seen {
    double share = 0;
    double scattering = 0;
    double radiance = 0;  // per share and irradiance
    double entry = 0;     // m
  };
  Seen along(const glm::dvec3& direction, const ErrorInput& in, double ambient) const {
    const std::array<double, 2> cut = crossBox(boxFromWorld_, eyeInBox_, direction);
    if (!(cut[1] > cut[0])) {
      return {};
    }
    const double depth = volume_.extinction * (cut[1] - cut[0]) * thin_;
    Seen seen;
    seen.share = cover_ * -std::expm1(-depth);
    seen.entry = cut[0];
    seen.radiance = BODY_RADIANCE * depth * volume_.gap / (1 + depth * volume_.gap);
    const double both = std::sqrt(std::min(depth, 1e3) * std::min(lightDepth_, 1e3));
    const double with = 0.5 * (1 + glm::dot(direction, in.toLight));
    const bool forward = in.quality.forwardScattering;
    const double a = forward ? FIT.forwardWith : FIT.singleWith;
    const double b = forward ? FIT.forwardAgainst : FIT.singleAgainst;
    const double reduced = forward ? both * volume_.gap : both;
    const double scale = std::exp(with * std::log(a) + (1 - with) * std::log(b));
    const double power = forward ? FIT.forwardPower : FIT.singlePower;
    seen.scattering = missing(volume_.albedo * scale * std::pow(reduced, power));
    if (in.quality.transport) {
      seen.scattering =
          std::hypot(leftOfVolume(seen.scattering, both * volume_.gap / in.quality.transportCells,
                                  cut[0] == 0),
                     leftOfAmbient(volume_.albedo * ambient, with, both * volume_.gap));
    }
    return seen;
  }

  // Stretch of a ray in the body's shadow, roughly; empty if they are equal.
  std::array<double, 2> shadowOn(const glm::dvec3& direction, const glm::dvec3& toLight,
                                 double reach) const {
    const double step = std::min(SHADOW_REACH * longest_ + nearest_, reach) / SHADOW_SAMPLES;
    std::array<double, 2> found{0, 0};
    for (int i = 0; i < SHADOW_SAMPLES; ++i) {
      const double t = (i + 0.5) * step;
      if (shades(direction * t, toLight)) {
        found[0] = found[1] > 0 ? found[0] : t - 0.5 * step;
        found[1] = t + 0.5 * step;
      }
    }
    return found;
  }
  bool shades(const glm::dvec3& position, const glm::dvec3& toLight) const {
    const std::array<double, 2> cut =
        crossBox(boxFromWorld_, eyeInBox_ + boxFromWorld_ * position, toLight);
    return cut[1] > cut[0];
  }
  // Of the box's shadow that is the body's.
  double cover() const { return cover_; }
  // Share of the light that is lacking there: what a layer turns back, all that others scatter.
  double shade() const {
    const double turned = lightDepth_ * (1 - volume_.albedo * (1 - volume_.gap));
    const double layer = missing(0.5 * turned);
    const double flat = std::clamp(1 - 2 * flatness_, 0.0, 1.0);
    return flat * layer + (1 - flat) * -std::expm1(-lightDepth_);
  }

 private:
  const ErrorVolume& volume_;
  glm::dmat3 boxFromWorld_{1.0};
  glm::dvec3 eyeInBox_{0};
  double cover_;
  double thin_ = 1;  // the body's chord over the box's
  double lightDepth_ = 0;
  double voxelsAlong_ = 0;
  double thinVoxels_ = std::numeric_limits<double>::infinity();  // across a flat volume
  double longest_ = 0;                                           // edge, m
  double flatness_ = 1;                                          // shortest edge over longest
  double nearest_ = 0;                                           // distance of the middle, m
};

// Light of air and fog that is drawn though volumes shade it; `ground`: that of the ground at
// `reach`, by the light alone. `cover`: of the pixel.
Color shadowedLight(const ErrorInput& in, const PlanetFrame& eye, const glm::dvec3& direction,
                    double reach, const Color& ground, double& cover) {
  Color lost{};
  cover = 0;
  if (in.quality.volumeShadows) {
    return lost;
  }
  for (const ErrorVolume& volume : in.volumes) {
    const Body body(volume, in);
    const std::array<double, 2> shadow = body.shadowOn(direction, in.toLight, reach);
    if (shadow[1] > shadow[0]) {
      cover = std::max(cover, body.cover());
      const Species far = speciesAlong(in.air, eye, direction, in, shadow[1]);
      const Species near = speciesAlong(in.air, eye, direction, in, shadow[0]);
      for (size_t c = 0; c < 3; ++c) {
        lost[c] += body.shade() * std::max(far.radiance[c] - near.radiance[c], 0.0);
      }
    }
    if (ground[0] > 0 && body.shades(direction * reach, in.toLight)) {
      cover = std::max(cover, body.cover());
      for (size_t c = 0; c < 3; ++c) {
        lost[c] += body.shade() * ground[c];
      }
    }
  }
  return lost;
}

// Means over the picture of the squared parts; those of the slabs for each of `slabs` into
// `slices`.
ErrorParts meanSquares(const ErrorInput& in, std::span<const uint32_t> slabs,
                       std::span<double> slices) {
  ErrorParts squares{};
  std::fill(slices.begin(), slices.end(), 0.0);
  if (!in.light) {
    return squares;
  }
  const PlanetFrame eye = planetFrameAt(in.planet, in.eye);
  const double albedo = (static_cast<double>(in.planet.groundAlbedo[0]) +
                         in.planet.groundAlbedo[1] + in.planet.groundAlbedo[2]) /
                        3;
  const double sunMu = glm::dot(in.toLight, eye.up);
  AirInput airOnly = in.air;
  airOnly.fogExtinction = 0;
  AirInput fogOnly = in.air;
  std::fill(std::begin(fogOnly.airScattering), std::end(fogOnly.airScattering), 0.0);
  Color airDepth{};
  Color fogDepth{};
  Color sunDepth{};
  double visible = 0;
  evalLightDepth(airOnly, 0, 1.0, 0, airDepth.data(), &visible);
  evalLightDepth(fogOnly, std::min(eye.altitude, in.air.fogBaseAltitude), 1.0, 0, fogDepth.data(),
                 &visible);
  evalLightDepth(in.air, 0, std::max(sunMu, 0.0), 0, sunDepth.data(), &visible);
  Color skyError{};
  Color sunlight{};
  Color fromGround{};
  for (size_t c = 0; c < 3; ++c) {
    sunDepth[c] = std::min(sunDepth[c], 30.0);
    sunlight[c] = std::exp(-sunDepth[c]);
    fromGround[c] = albedo * std::max(sunMu, 0.0) * std::exp((1 - FIT.groundFade) * sunDepth[c]);
    skyError[c] = missing(FIT.scatterScale * std::pow(airDepth[c], FIT.scatterPower) *
                              std::pow(sunlight[c], -FIT.scatterSun) +
                          FIT.groundScale * fromGround[c]);
    if (in.quality.multipleSky) {
      skyError[c] = leftOfSky(skyError[c]);
    }
  }

  const double ambient = in.ambient ? 0 : ambientShare(sunMu, albedo, sunlight);

  for (int y = 0; y < GRID; ++y) {
    for (int x = 0; x < GRID; ++x) {
      const glm::dvec4 ndc((x + 0.5) * 2.0 / GRID - 1, (y + 0.5) * 2.0 / GRID - 1, 0.5, 1);
      const glm::dvec4 far = in.eyeFromNdc * ndc;
      const glm::dvec3 direction = glm::normalize(glm::dvec3(far) / far.w);
      double free = 1;      // share of the pixel that no volume hides
      double before = 0;    // radiance of bodies
      bool hidden = false;  // what is farther than `reach`
      double reach = std::numeric_limits<double>::infinity();
      for (const ErrorVolume& volume : in.volumes) {
        const Body body(volume, in);
        const Body::Seen seen = body.along(direction, in, ambient);
        const double share = free * seen.share;
        squares[WLK_APPROXIMATION_VOLUME_SCATTERING] += share * seen.scattering * seen.scattering;
        for (size_t i = 0; share > 0 && i < slabs.size(); ++i) {
          const double error =
              (in.quality.transport ? SLABS_OF_FIRST : 1.0) * body.slices(slabs[i]);
          slices[i] += share * error * error / (GRID * GRID);
        }
        free -= share;
        before += share * seen.radiance;
        if (free < 0.5 && !hidden) {
          hidden = true;
          reach = seen.entry;
        }
      }
      const double ground =
          evalGroundDistance(eye.altitude, glm::dot(direction, eye.up), in.planet.radius);
      const double distance = ground >= 0 ? ground : std::numeric_limits<double>::infinity();
      const Species air = speciesAlong(airOnly, eye, direction, in, distance);
      const Species fog = speciesAlong(fogOnly, eye, direction, in, distance);
      // Of the ground, where nothing hides it.
      Color lit{};
      for (size_t c = 0; c < 3 && ground >= 0 && !hidden; ++c) {
        lit[c] = albedo * std::max(sunMu, 0.0) * LAMBERT * sunlight[c] *
                 std::exp(-air.depth[c] - fog.depth[c]);
      }
      double shaded = 0;
      const Color lost = shadowedLight(in, eye, direction, std::min(distance, reach), lit, shaded);
      for (size_t c = 0; c < 3; ++c) {
        const double sum = air.radiance[c] + fog.radiance[c];
        if (!(sum > 0)) {
          continue;
        }
        const double all = ALL_OVER_FIRST * (free * sum + (1 - free) * lost[c] + free * lit[c]) +
                           before * sunlight[c];
        // Too much light, not too little: over what is right.
        const double shade = std::min(lost[c] / std::max(all - lost[c], 1e-30), 10.0);
        squares[WLK_APPROXIMATION_VOLUME_SCATTERING] += shaded * shade * shade / 3;
        const double reduced =
            std::sqrt(std::min(fog.depth[c], 50.0) * std::min(fogDepth[c], 50.0)) * in.fogGap;
        const double first = missing(FIT.fogScale * std::pow(reduced, FIT.fogPower) *
                                         std::pow(sunlight[c], -FIT.fogSun) +
                                     FIT.fogGround * fromGround[c]);
        const double fogError = in.quality.multipleSky ? leftOfFog(first) : first;
        squares[WLK_APPROXIMATION_SKY] +=
            free * air.radiance[c] / sum * skyError[c] * skyError[c] / 3;
        squares[WLK_APPROXIMATION_FOG] += free * fog.radiance[c] / sum * fogError * fogError / 3;
      }
    }
  }
  for (double& square : squares) {
    square /= GRID * GRID;
  }
  return squares;
}

}  // namespace

ErrorParts estimateError(const ErrorInput& in) {
  const uint32_t slabs = in.quality.sliceCount;
  double slices = 0;
  ErrorParts parts = meanSquares(in, {&slabs, 1}, {&slices, 1});
  parts[WLK_APPROXIMATION_VOLUME_SLICES] = slices;
  for (double& part : parts) {
    part = std::sqrt(part);
  }
  return parts;
}

void estimateErrors(const ErrorInput& in, std::span<const uint32_t> slabs,
                    std::span<double> errors) {
  const ErrorParts squares = meanSquares(in, slabs, errors);
  double others = 0;
  for (const double square : squares) {
    others += square;
  }
  for (double& error : errors) {
    error = std::min(std::sqrt(others + error), 1.0);
  }
}

}  // namespace welkin
