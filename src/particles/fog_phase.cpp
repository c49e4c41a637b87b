// SPDX-License-Identifier: MIT
#include "particles/fog_phase.hpp"

#include "model/model.hpp"

namespace welkin {
namespace {

namespace text = model::f64;

FogPhaseParams fromText(const text::FogPhase& p) {
  return {p.gHg, p.gapHg, p.gD, p.gapD, p.alpha, p.weightD};
}

text::FogPhase toText(const FogPhaseParams& p) {
  text::FogPhase result;
  result.gHg = p.gHg;
  result.gapHg = p.gapHg;
  result.gD = p.gD;
  result.gapD = p.gapD;
  result.alpha = p.alpha;
  result.weightD = p.weightD;
  return result;
}

}  // namespace

FogPhaseParams phaseParameters(PhaseKind kind, double diameter_um, double asymmetry) {
  switch (kind) {
    case PhaseKind::HenyeyGreenstein:
      return fromText(text::henyeyGreensteinOnly(asymmetry));
    case PhaseKind::Rayleigh:
      return fromText(text::rayleighAsDraine());
    case PhaseKind::HgDraine:
      break;
  }
  return fromText(text::fogPhaseFromDiameter(diameter_um));
}

double evalPhase(const FogPhaseParams& phase, double y) {
  return text::fogPhase(toText(phase), y);
}

double meanCosine(const FogPhaseParams& phase) {
  const double g2 = phase.gD * phase.gD;
  const double draine =
      phase.gD * (1 + phase.alpha * (3 + 2 * g2) / 5) / (1 + phase.alpha * (1 + 2 * g2) / 3);
  return (1 - phase.weightD) * phase.gHg + phase.weightD * draine;
}

}  // namespace welkin
