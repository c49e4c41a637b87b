// SPDX-License-Identifier: MIT
// Phase functions in closed form, in 1/sr: HG + Draine of water droplets, Henyey-Greenstein,
// Rayleigh. No Vulkan.
#pragma once

namespace welkin {

enum class PhaseKind { HgDraine, HenyeyGreenstein, Rayleigh };

// The six numbers of shaders/model/phase/fog.glsl, which serve every kind. gap = 1 - g, held as its
// own number because 1 - g of a rounded g loses up to 3 digits.
struct FogPhaseParams {
  double gHg = 0;
  double gapHg = 1;
  double gD = 0;
  double gapD = 1;
  double alpha = 0;
  double weightD = 0;
};

// Parameters of a phase function; diameter_um counts for HgDraine only (clamped to [0, 50]),
// asymmetry for HenyeyGreenstein only.
FogPhaseParams phaseParameters(PhaseKind kind, double diameter_um, double asymmetry);

// Phase function in 1/sr at y = 1 - cos(scattering angle), y in [0, 2].
double evalPhase(const FogPhaseParams& phase, double y);

// Mean cosine of the phase function, closed form. HG: g; Draine: g (1 + alpha (3 + 2 g^2) / 5) /
// (1 + alpha (1 + 2 g^2) / 3).
double meanCosine(const FogPhaseParams& phase);

}  // namespace welkin
