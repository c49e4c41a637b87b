// SPDX-License-Identifier: MIT
// Tabulated RGB phase function in 1/sr, for any particle: its value, exact samples, mean cosine and
// forward part. The cell arithmetic is shaders/model/phase/curve.glsl. No Vulkan.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace welkin {

constexpr size_t kCurveChannels = 3;
constexpr size_t kCurveNodes = 2048;  // CURVE_NODES of curve.glsl

// 2048 nodes at s = i / 2047 of phaseCoordinate (shaders/model/volume/forward_scattering.glsl), P
// linear in y = 1 - cos(angle) between them, so that its integral and inverse are closed forms.
// Energies from both ends: each end keeps its relative precision. 160 KB in double. Half as many
// nodes would put a rainbow's peak up to 0.12 degrees off.
template <typename T>
struct BasicPhaseCurve {
  std::vector<T> y;                                  // of the nodes, rising, 0 .. 2
  std::array<std::vector<T>, kCurveChannels> value;  // 1/sr, integral over the sphere 1
  std::array<std::vector<T>, kCurveChannels> cdf;    // energy within [0, y], 0 .. 1
  std::array<std::vector<T>, kCurveChannels> tail;   // energy within [y, 2], 1 .. 0
};
using PhaseCurve = BasicPhaseCurve<double>;
using PhaseCurveF = BasicPhaseCurve<float>;

// P of a channel at y in [0, 2], in any unit; negative or non-finite values count as 0.
using PhaseFunction = std::function<double(size_t channel, double y)>;

// The curve of P, normalised in closed form. Nodes are the least-squares fit in y, not samples:
// that keeps the integral and the mean cosine of P, where chords of a convex peak would add energy.
// Against P itself, HG + Draine of 5..50 um and Henyey-Greenstein 0.95: 1 - g within 1e-9 and the
// backward part within 1e-8, relative (PhaseCurve.KeepsTheMomentsOfTheFunction). A channel without
// energy becomes isotropic. 4094 calls per channel.
PhaseCurve makePhaseCurve(const PhaseFunction& phase);

// The same for the GPU, each number rounded once.
PhaseCurveF roundPhaseCurve(const PhaseCurve& curve);

// P in 1/sr at y in [0, 2]; also the density over the sphere of samplePhaseCurve.
double evalPhaseCurve(const PhaseCurve& curve, size_t channel, double y);
float evalPhaseCurve(const PhaseCurveF& curve, size_t channel, float y);

// y up to which the part xi in [0, 1] of the energy is scattered: exact inversion.
double samplePhaseCurve(const PhaseCurve& curve, size_t channel, double xi);

// The same for a float curve, counted from the nearer end of the axis: in float, y near 2 would
// move the energy of a narrow backward peak by its rounding (Henyey-Greenstein -0.95: 4e-5).
struct AxisAngleF {
  float y;        // 1 - cos of the angle to the forward or backward direction, [0, 1.002]
  bool backward;  // which of the two
};
AxisAngleF samplePhaseCurve(const PhaseCurveF& curve, size_t channel, float xi);
float evalPhaseCurve(const PhaseCurveF& curve, size_t channel, AxisAngleF angle);

// Energy within [0, y]; samplePhaseCurve's inverse.
double phaseCurveCdf(const PhaseCurve& curve, size_t channel, double y);

// Mean of 1 - cos without cancellation, and the mean cosine, 1 minus that.
double meanOneMinusCosine(const PhaseCurve& curve, size_t channel);
double meanCosine(const PhaseCurve& curve, size_t channel);

// Energy below 90 degrees.
double forwardFraction(const PhaseCurve& curve, size_t channel);

}  // namespace welkin
