// SPDX-License-Identifier: MIT
// Phase functions of a medium's three channels from tables that stand at fixed wavelengths. No
// Vulkan.
//
// A size distribution enters Mie theory as d / wavelength and as the index of refraction. So a
// wavelength between two of the table's is the mean of both at diameters scaled to it, weighted by
// the index, with bows and halos put where that index has them.
#pragma once

#include <array>
#include <functional>

#include "particles/catalogue.hpp"
#include "particles/phase_table.hpp"

namespace welkin {

constexpr double WATER_TEMPERATURE_C = 10;

// The channels of a table that a wavelength is mixed from. Outside of them the nearest two are
// continued (weights below 0 and above 1).
struct WavelengthMix {
  double wavelength_um = 0;
  double index = 1;
  std::array<size_t, 2> channel{};
  std::array<double, 2> weight{};
};

// Of a medium's channel: the channel itself, or params' one wavelength.
WavelengthMix wavelengthMix(Features features, bool ice, const ParticleParams& params,
                            size_t channel);

// The curve of a function of (channel, angle in rad), with the mean cosines given: the half of the
// energy that is turned least is weighed up or down by some 1e-3 until they hold.
PhaseCurve calibratedCurve(const std::function<double(size_t channel, double angle)>& phase,
                           const std::array<double, RGB>& asymmetry);

double angleOf(double y);  // rad, of 1 - cos

// What a table says about extinction, at a medium's wavelengths; see tableParticle.
ParticleOptics tableOptics(
    const PhaseTable& table, bool ice, const ParticleParams& params,
    const std::function<double(double tableWavelength_um, double wavelength_um)>& axisValue);

// Everything a table holds, at a medium's wavelengths. `axisValue` of a table channel and a
// wavelength.
Particle tableParticle(
    const PhaseTable& table, bool ice, const ParticleParams& params,
    const std::function<double(double tableWavelength_um, double wavelength_um)>& axisValue);

}  // namespace welkin
