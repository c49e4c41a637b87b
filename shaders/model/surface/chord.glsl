// SPDX-License-Identifier: MIT
// What a view ray's chord through a surface cloud hides and scatters once ([B08] 6.2 and 6.3), per
// unit irradiance and phase function. Depths are optical. Rewritten: Eq. 1 has the wrong sign and
// lacks the Jacobian 1 / (1 + dl/dx), which is 0/0 where the ray goes straight to the light, and
// Eq. 2 is no opacity; the two-ended form of segment.glsl has neither singular case nor
// cancellation.

struct ChordLight {
  real transmittance;
  real inscatter;
};

ChordLight emptyChord() {
  ChordLight empty;
  empty.transmittance = real(1.0f);
  empty.inscatter = real(0.0f);
  return empty;
}

// -ln(1 - x) for x in [0, 1]: the series ends 2e-7 short, the logarithm is known to 6e-8 / x.
const real CHORD_SERIES = real(0.03);
real chordLogarithm(real x) {
  real series = x * (real(1.0f) + x * (real(0.5f) + x * (real(1.0f) / real(3.0f) +
                                                         real(0.25f) * x)));
  return x < CHORD_SERIES ? series : -log(max(real(1.0f) - x, real(1e-20)));
}

// Depth into a chord of depth tau >= 0 in front of which the part u in [0, 1] of its opacity lies:
// where [B08] Fig. 10 spaces samples exponentially, each stretch between even u hides as much.
// `opacity`: oneMinusExp(tau).
real chordDepthOf(real u, real opacity, real tau) {
  return u < real(1.0f) ? min(chordLogarithm(u * opacity), tau) : tau;
}
real chordDepth(real u, real tau) {
  return chordDepthOf(u, oneMinusExp(tau), tau);
}

// [B08] Eq. 1 and 2 as corrected, one stretch of depth tau behind `before`: lightNear and lightFar
// are the depths of its ends from the light, linear between. Inscatter is at most the opacity.
ChordLight chordStretch(ChordLight before, real lightNear, real lightFar, real tau) {
  ChordLight result;
  result.transmittance = before.transmittance * safeExp(-tau);
  result.inscatter =
      before.inscatter + before.transmittance * segmentInscatter(lightNear, lightFar, tau);
  return result;
}
