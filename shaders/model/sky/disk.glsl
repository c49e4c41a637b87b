// SPDX-License-Identifier: MIT
// Radiance across the disk of a light relative to its mean, so that irradiance over solid angle
// (pi sin^2 of the radius, times 0.96 for the soft rim) times this carries the irradiance. A
// direction comes as y = 1 - cos of the angle to the disk's centre, the rim as `edge`, its y;
// y/edge is the share of the disk's area within, to (radius/2)^2: 5e-6 for the Sun.
// The rim is soft, so the body is laid out by the area that is kept: where the share m of the
// softened disk's area lies outside, the body shows the part of its surface with mu^2 = m, mu the
// cosine between surface normal and line of sight. Means over the softened disk are then those of a
// sharp one, in closed form (tests/unit/disk_test.cpp).

// 1 / share of the area that the smoothstep runs over, and the part of the area that is kept.
const real DISK_RIM = real(12.5f);
const real DISK_KEPT = real(0.96);

// 1 inside the disk, 0 outside, smooth over the last 4 % of the radius.
real diskCoverage(real y, real edge) {
  real x = clamp((real(1.0f) - y / edge) * DISK_RIM, real(0.0f), real(1.0f));
  return x * x * (real(3.0f) - real(2.0f) * x);
}

// mu^2: the integral of diskCoverage over the area from here to the rim. Float error 1e-7.
real diskMuSquared(real y, real edge) {
  real x = max((real(1.0f) - y / edge) * DISK_RIM, real(0.0f));
  real rim = x * x * x * (real(1.0f) - real(0.5f) * x);
  return (x < real(1.0f) ? rim : x - real(0.5f)) / (DISK_RIM * DISK_KEPT);
}

// Keeps the logarithm finite; mu^2 = 1e-15 lies where the coverage is 1e-9.
const real MU_SQUARED_FLOOR = real(1e-15);

// Limb darkening mu^a of a body that shines itself, RGB, after Hestroffer and Magnan 1998 (A&A 333,
// 338), times (a + 2) / 2 to make the mean 1. Exponent 0 gives diskCoverage exactly. The Sun at
// 680, 550 and 440 nm: a = 0.36, 0.47, 0.62, by least squares over the disk from the polynomials of
// Neckel and Labs 1994 (Solar Physics 153, 91): rms 1.3 % of the mean radiance, 1.3 % to mu =
// 0.3, 3 % to mu = 0.21, where the soft rim begins. Float follows double to 2e-6 but for the rim.
vec3 limbDarkenedDisk(real y, real edge, vec3 exponent) {
  vec3 result = vec3(real(0.0f));
  if (y < edge) {
    real logMu = real(0.5f) * log(max(diskMuSquared(y, edge), MU_SQUARED_FLOOR));
    vec3 brightness = exp(exponent * logMu) * (vec3(real(1.0f)) + exponent * real(0.5f));
    result = brightness * diskCoverage(y, edge);
  }
  return result;
}

// Below this phase integral a moon is less than the Sun's diameter from it, where light is no
// longer parallel; the crescent's radiance stops growing there. (0.0093 rad)^2 / 6.
const real PHASE_FLOOR = real(1.44e-5);

// Part of a full disk's light that a ball reflects by the law of Lommel and Seeliger, [0, 1]: 1 -
// sin(a/2) tan(a/2) ln cot(a/4), a the phase angle between unit vectors from the ball to its light
// (litFrom) and to the eye (-toLight). Rewritten: 1 - (1 - c^2) atanh(c) / c with c = cos(a/2), and
// near new moon its series, 2/3 c^2 + 2/15 c^4 + ..., of positive terms. Relative error 2e-9 in
// double, 8e-6 in float. Not below PHASE_FLOOR.
real phaseIntegral(vec3 toLight, vec3 litFrom) {
  vec3 across = litFrom - toLight;
  vec3 along = litFrom + toLight;
  real far = dot(across, across);
  real near = dot(along, along);
  real c2 = far / max(far + near, real(1e-20));
  real s2 = near / max(far + near, real(1e-20));
  real c = sqrt(c2);
  real series = real(2.0f) / real(143.0f) + c2 * (real(2.0f) / real(195.0f));
  series = real(2.0f) / real(63.0f) + c2 * (real(2.0f) / real(99.0f) + c2 * series);
  series = real(2.0f) / real(15.0f) + c2 * (real(2.0f) / real(35.0f) + c2 * series);
  series = c2 * (real(2.0f) / real(3.0f) + c2 * series);
  real cot = (real(1.0f) + c) / sqrt(max(s2, real(1e-20)));
  real direct = real(1.0f) - s2 * log(cot) / max(c, real(0.1));
  return max(c2 < real(0.1) ? series : direct, PHASE_FLOOR);
}

// A ball lit by another body, by Lommel and Seeliger: mu0 / (mu0 + mu), mu0 the cosine between
// normal and litFrom; the flat full moon. `direction`, toLight (to the ball) and litFrom are unit
// vectors, `phase` is phaseIntegral(toLight, litFrom). The mean of mu0 / (mu0 + mu) is half of it.
real litDisk(vec3 direction, vec3 toLight, vec3 litFrom, real phase, real y, real edge) {
  real result = real(0.0f);
  if (y < edge) {
    real mu2 = diskMuSquared(y, edge);
    // The point's distance from the centre in radii, over the sine of the direction's angle to it:
    // inside the rim the area share y / (0.96 edge) needs no difference from 1.
    real share = y < real(0.92) * edge ? real(1.0f) / (DISK_KEPT * edge)
                                       : (real(1.0f) - mu2) / y;
    real scale = sqrt(share / (real(2.0f) - y));
    vec3 sideways = direction - toLight + toLight * y;
    real mu = sqrt(mu2);
    real mu0 = scale * dot(sideways, litFrom) - mu * dot(toLight, litFrom);
    real lit = mu0 > real(0.0f) ? mu0 / (mu0 + mu) : real(0.0f);
    result = lit * (real(2.0f) / phase) * diskCoverage(y, edge);
  }
  return result;
}
