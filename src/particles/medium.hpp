// SPDX-License-Identifier: MIT
// A scattering medium as the tables and passes see it: phase function and albedo. No Vulkan.
#pragma once

#include <cstdint>

namespace welkin {

// Equal to WLK_PHASE_*.
enum class PhaseKind : uint32_t { HgDraine = 0, HenyeyGreenstein = 1, Rayleigh = 2 };

// The six numbers of shaders/model/phase/fog.glsl, which serve every kind. gap = 1 - g, held as its
// own number because 1 - g of a rounded g loses up to 3 digits.
template <typename T>
struct BasicPhaseParams {
  T gHg = 0;
  T gapHg = 1;
  T gD = 0;
  T gapD = 1;
  T alpha = 0;
  T weightD = 0;
};
using FogPhaseParams = BasicPhaseParams<double>;
using FogPhaseParamsF = BasicPhaseParams<float>;

struct Medium {
  PhaseKind kind = PhaseKind::HgDraine;
  double dropletDiameter_um = 20;  // for HgDraine, [5, 50]
  double asymmetry = 0.85;         // for HenyeyGreenstein, (-1, 1)
  double albedo[3] = {1, 1, 1};    // RGB, [0, 1]
  FogPhaseParams phase;            // of the three fields above, by makeMedium
  FogPhaseParamsF phaseF;          // the same, each rounded once
};

// Parameters of a phase function; diameter_um counts for HgDraine only (clamped to [5, 50]),
// asymmetry for HenyeyGreenstein only.
FogPhaseParams phaseParameters(PhaseKind kind, double diameter_um, double asymmetry);

// The same for the GPU: computed in double, each number rounded once.
FogPhaseParamsF phaseParametersF(PhaseKind kind, double diameter_um, double asymmetry);

Medium makeMedium(PhaseKind kind, double diameter_um, double asymmetry, const double albedo[3]);

// Phase function in 1/sr at y = 1 - cos(scattering angle), y in [0, 2].
double evalPhase(const FogPhaseParams& phase, double y);

// Mean cosine of the phase function, closed form. HG: g; Draine: g (1 + alpha (3 + 2 g^2) / 5) /
// (1 + alpha (1 + 2 g^2) / 3).
double meanCosine(const FogPhaseParams& phase);

}  // namespace welkin
