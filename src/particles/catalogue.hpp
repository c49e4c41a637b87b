// SPDX-License-Identifier: MIT
// Kinds of particles and what they do to light: phase function in 1/sr, extinction efficiency. One
// file in types/ and one line in catalogue.cpp each. No Vulkan.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "particles/fog_phase.hpp"
#include "particles/phase_curve.hpp"

namespace welkin {

constexpr size_t RGB = 3;

// Equal to WLK_PARTICLE_*.
enum class ParticleType : uint32_t {
  Cloud,
  Fog,
  Haze,
  Rain,
  IceColumn,
  IcePlate,
  Snow,
  Air,
  HenyeyGreenstein,
  User
};
constexpr size_t PARTICLE_TYPES = 10;

struct ParticleParams {
  double diameter_um = 0;             // median; the kind's range
  double spread = 0;                  // standard deviation of ln(diameter)
  double roughness = 0;               // standard deviation of the facets' slope
  double asymmetry = 0.85;            // HenyeyGreenstein
  double wavelength_um = 0;           // 0: red, green and blue
  bool analytic = false;              // the closed form
  std::span<const double> userAngle;  // rad, rising, 0 .. pi
  std::span<const double> userPhase;  // RGB at each
};

struct ParticleOptics {
  std::array<double, RGB> efficiency{};  // extinction / mean geometric cross-section; 0: no size
  std::array<double, RGB> delta{};       // part of the scattered light that is not in the curve
  double area_um2 = 0;                   // mean geometric cross-section of one particle
  double effectiveRadius_um = 0;
};

struct Particle {
  bool analytic = false;  // `phase` is exact; else `curve` is what there is
  bool empty = false;     // a user's table without energy in some channel
  FogPhaseParams phase;
  PhaseCurve curve;
  ParticleOptics optics;
};

// An allowed range and what 0 stands for; low == high == 0: the kind has no such number.
struct ParticleRange {
  double low = 0;
  double high = 0;
  double initial = 0;
};

struct ParticleKind {
  const char* name;
  ParticleRange diameter_um;
  ParticleRange spread;
  ParticleRange roughness;
  bool hasTable;
  bool hasAnalytic;
  Particle (*make)(const ParticleParams& params);
};

const ParticleKind& particleKind(ParticleType type);

// One line each of the catalogue.
extern const ParticleKind CLOUD, FOG, HAZE, RAIN, ICE_COLUMN, ICE_PLATE, SNOW, AIR,
    HENYEY_GREENSTEIN, USER;

}  // namespace welkin
