// SPDX-License-Identifier: MIT
// Single scattering along one stretch of a ray through an exponential layer, per unit irradiance,
// phase function and albedo (dimensionless). Follows [R04] 4.1, Eq. 11-15; rewritten: Eq. 15 lacks
// the factor exp(-beta_eye / (gamma p)), and its closed form is singular at p = 0 and p = l. Here
// the stretch is described by optical depths at its two ends: light depth a at the near end, and
// b = light depth at the far end + depth of the stretch. The integral is the depth times the
// logarithmic mean of e^-a and e^-b: symmetric, never negative, without a singular case, exact in a
// flat exponential layer, and of second order where the layer is not (tests/unit/sky_test.cpp).

struct Segment {
  real opticalDepth;
  real inscatter;
};

// Cap on optical depths, so that infinite ones never meet as inf - inf.
const real DEPTH_CAP = real(1e30);

// tau exp(-min(a, b)) phi1(|b - a|); light below e^-46 counts as none. Flat layers: relative error
// <= 1e-12 in double and 5e-5 in float down to that cut.
real segmentInscatter(real nearSunDepth, real farSunDepth, real opticalDepth) {
  real tau = min(opticalDepth, DEPTH_CAP);
  real a = min(nearSunDepth, DEPTH_CAP);
  real b = min(farSunDepth + tau, DEPTH_CAP);
  return tau * safeExp(-min(a, b)) * phi1(abs(b - a));
}

// Highest exponent of the density's growth along a downward ray, which ends there: deeper, every
// layer is opaque, e^40 = 2e17.
const real GROWTH_CAP = real(40.0f);

// Optical depth of `distance` (<= DEPTH_CAP) m with extinction (1/m) at the near end, heightRatio
// = rise / scale height: [R04] Eq. 11 as beta K phi1(gamma p K), free of 0/0 for horizontal rays.
real exponentialDepth(real extinction, real heightRatio, real distance) {
  real reach = heightRatio < -GROWTH_CAP ? distance * (-GROWTH_CAP / heightRatio) : distance;
  return min(extinction * reach * phi1(max(heightRatio, -GROWTH_CAP)), DEPTH_CAP);
}

// Cap on the depth of light along the horizon: times e^GROWTH_CAP it is still finite in float.
const real GRAZING_CAP = real(1e21);

// [R04] Eq. 11-15 as corrected, flat Earth: extinctionAtEye and inverseScaleHeight (> 0) in 1/m,
// viewSlope p and lightSlope l the vertical components of the directions to the far end and to the
// light, distance in m, may be infinite. l <= 0 gives no light: a flat Earth has no twilight.
Segment flatExponentialSegment(real extinctionAtEye, real inverseScaleHeight, real viewSlope,
                               real lightSlope, real distance) {
  real length = min(distance, DEPTH_CAP);
  real rise = inverseScaleHeight * viewSlope * length;
  real nearDepth = min(extinctionAtEye / (inverseScaleHeight * max(lightSlope, DIRECTION_FLOOR)),
                       GRAZING_CAP);
  Segment result;
  result.opticalDepth = exponentialDepth(extinctionAtEye, rise, length);
  real farDepth = nearDepth * safeExp(min(-rise, GROWTH_CAP));
  real lit = segmentInscatter(nearDepth, farDepth, result.opticalDepth);
  result.inscatter = lightSlope > real(0.0f) ? lit : real(0.0f);
  return result;
}

// ---- Exponential layers around a sphere, in segments that share their ends.

// Exponent of the relative density is kept in this range: e^-60 is vacuum without subnormal
// numbers, e^30 times any extinction is opaque.
const real LAYER_VACUUM = real(-60.0f);
const real LAYER_SOLID = real(30.0f);
const real VACUUM_DENSITY = real(1e-27);
const real SQRT_PI_HALF = real(0.886226925452758);

// One exponential layer at one point of a ray.
struct LayerPoint {
  real exponent;
  real density;
  // Depth per unit extinction from here along the ray to infinity, away from the lowest point. m.
  real column;
};

real layerExponent(real altitude, real base, real scaleHeight) {
  return (base - altitude) / scaleHeight;
}

real layerDensity(real exponent) {
  return exp(clamp(exponent, LAYER_VACUUM, LAYER_SOLID));
}

// e^(x^2) erfc(x) of a layer around a sphere: times sqrt(pi X/2) the column above a point in scale
// heights, X = r/H, x = sqrt(X/2) |mu|. The next order in 1/X is c(x)/X, c from 3/8 (horizontal) to
// 1 (vertical), here within 7e-3; the whole within 2e-5 for X > 700. 1/(X + 1) keeps it harmless
// around a body no larger than its layer.
const real HORIZONTAL_BEND = real(0.375);
const real BEND_2 = real(-0.4);
const real BEND_3 = real(2.7);
const real BEND_4 = real(-1.3);
real layerErfcx(real x, real radius, real scaleHeight) {
  real t = real(1.0f) / (real(1.0f) + ERFCX_SCALE * x);
  real near = t * t * (BEND_2 + t * (BEND_3 + t * BEND_4));
  real bend = real(1.0f) - (real(1.0f) - HORIZONTAL_BEND) * near;
  return erfcxPositive(x) * (real(1.0f) + bend * scaleHeight / (radius + scaleHeight));
}

// Depth per unit extinction (m) from radius r towards a direction with cosine mu to the up; for
// mu < 0 twice the lowest point's horizontal value less the opposite direction, which is exact.
// Within 2e-5 of the sphere's integral for X > 700.
real layerColumn(real exponent, real density, real scaleHeight, real radius, real mu) {
  real width = sqrt(real(2.0f) * radius * scaleHeight);
  real up = density * layerErfcx(radius * abs(mu) / width, radius, scaleHeight);
  real sinus = sqrt(max((real(1.0f) - mu) * (real(1.0f) + mu), real(0.0f)));
  real drop = radius * mu * mu / (scaleHeight * (real(1.0f) + sinus));
  real bent = real(1.0f) + HORIZONTAL_BEND * scaleHeight / (radius * sinus + scaleHeight);
  real down = real(2.0f) * sqrt(sinus) * layerDensity(exponent + drop) * bent - up;
  // At the nadir the chord is no exponential column; keep it monotone and never negative.
  return SQRT_PI_HALF * width * (mu < real(0.0f) ? max(down, up) : up);
}

LayerPoint layerPoint(real altitude, real base, real scaleHeight, real radius, real fromLowest) {
  LayerPoint point;
  point.exponent = min(layerExponent(altitude, base, scaleHeight), LAYER_SOLID);
  point.density = layerDensity(point.exponent);
  real width = sqrt(real(2.0f) * radius * scaleHeight);
  point.column = SQRT_PI_HALF * width * point.density *
                 layerErfcx(abs(fromLowest) / width, radius, scaleHeight);
  return point;
}

// A layer between two points of a ray.
struct LayerSpan {
  // Depth per unit extinction. m.
  real column;
  // How far the layer's centre lies before the middle, as a share of the span: -0.5..0.5.
  real lean;
};

// Two points on the same side of the ray's lowest one, at most `sag` m above the ray's chord.
// Nearly straight: logarithmic mean of the densities, all from c = (b/2) coth(b/2), b the
// difference of exponents, times the curvature's series in g sag/H, g = 8 (c - 1) / b^2 the first
// moment (error <= 5e-4 at the switch). Else: difference of columns.
const real CURVATURE_2 = real(0.6);
const real CURVATURE_3 = real(0.857);
LayerSpan layerSpan(LayerPoint a, LayerPoint b, real scaleHeight, real length, real sag) {
  real rise = a.exponent - b.exponent;
  real size = abs(rise);
  real z = rise * rise;
  real sum = a.density + b.density;
  real fall = max(abs(a.density - b.density), VACUUM_DENSITY);
  real slope = size < real(0.5f) ? cothSeries(z)
                                 : (real(0.5f) * size * sum / fall - real(1.0f)) / z;
  real g = min(real(8.0f) * slope, real(1.0f));
  real s = sag / scaleHeight;
  real p = g * s;
  real p2 = (real(1.0f) - CURVATURE_2 * g) * p;
  real p3 = (real(1.0f) - CURVATURE_3 * g) * p;
  real curvature = real(1.0f) + p * (real(1.0f) + p2 * (real(1.0f) + p3));
  real straight = length * real(0.5f) * sum / (real(1.0f) + z * slope) * curvature;
  LayerSpan span;
  span.column = s < real(0.25f) ? straight : abs(a.column - b.column);
  span.lean = clamp(rise * slope, real(-0.5f), real(0.5f));
  return span;
}

// Logarithmic mean of e0 = e^-t0 and e1 = e^-t1, with rise = t1 - t0: segmentInscatter per unit
// depth, with exponentials that neighbouring segments share.
real meanTransmittance(real e0, real e1, real rise) {
  return abs(rise) < real(0.5f) ? e0 * phi1Small(rise) : (e0 - e1) / rise;
}

vec3 meanTransmittance3(vec3 e0, vec3 e1, vec3 rise) {
  vec3 mean;
  mean.x = meanTransmittance(e0.x, e1.x, rise.x);
  mean.y = meanTransmittance(e0.y, e1.y, rise.y);
  mean.z = meanTransmittance(e0.z, e1.z, rise.z);
  return mean;
}

// One end of a segment: light depth + view depth in front of it, and its exponential.
struct SegmentEnd {
  vec3 depth;
  vec3 transmittance;
};

// Mean transmittance for one layer when the other adds `other` to the depth over the segment: of
// that |share| is passed before (share > 0) or after (share < 0) all of the layer, the rest evenly
// along it. What is moved may be all but a rounding of the depth: that rounding stays, or light
// might come of it; and the mean is that of the depths as they are then, or it might be negative.
const real DEPTH_ROUNDED = real(1.0000002384185791);  // 1 + 2^-22
vec3 displacedMean(SegmentEnd a, SegmentEnd b, vec3 other, real wanted) {
  real share = clamp(wanted, real(-1.0f), real(1.0f));
  vec3 moved = (share > real(0.0f) ? a.depth : b.depth) * DEPTH_ROUNDED + other * share;
  vec3 e = safeExp3(-moved);
  vec3 e0 = share > real(0.0f) ? e : a.transmittance;
  vec3 e1 = share > real(0.0f) ? b.transmittance : e;
  vec3 rise = share > real(0.0f) ? b.depth - moved : moved - a.depth;
  return meanTransmittance3(e0, e1, rise);
}

// Share for displacedMean of a layer whose own depth changes by `own` over the segment, when the
// other layer leans by otherLean. Its light comes from the depth share y with mean weight e^(-own
// x), close to 1/2 - L(own/2)/2, L(x) = x / (2 + sqrt(1 + x^2)) near Langevin's function. y is
// taken to the distance s through the exponential profile (to second order where that is nearly
// flat), and s to the other layer's share x there. Both layers pass alike if x = y. Cuts the worst
// error of fog and air from 30 % to 12 %, and its p95 by a third to a half.
const real OWN_CAP = real(1e6);
real displacement(LayerPoint a, LayerPoint b, real own, real otherLean) {
  real bend = clamp(own, -OWN_CAP, OWN_CAP) * real(0.5f);
  real y = real(0.5f) - real(0.5f) * bend / (real(2.0f) + sqrt(real(1.0f) + bend * bend));
  real start = max(a.exponent, LAYER_VACUUM);
  real growth = max(b.exponent, LAYER_VACUUM) - start;
  bool even = abs(growth) < real(0.5f);
  real bent = y + real(0.5f) * growth * y * (real(1.0f) - y);
  real steep = (log(a.density + (b.density - a.density) * y) - start) /
               (even ? real(1.0f) : growth);
  real s = clamp(even ? bent : steep, real(0.0f), real(1.0f));
  real x = s + real(4.0f) * s * (real(1.0f) - s) * otherLean;
  return (x - y) / (x < y ? y : real(1.0f) - y);
}

// ---- What the two ends do not tell: how the depth bends between them.

// Excess of the depth's slope over its mean at either end, times the span's column.
struct Bend {
  real near;
  real far;
};

// Densities below this times the base's give no slope, and no slope is steeper than SLOPE_CAP: high
// up in twilight the light comes through air that is 1e6 times as dense.
const real SLOPE_DENSITY = real(1e-12);
const real SLOPE_CAP = real(1e9);
real slopeOf(real rate, real density, real cap) {
  return clamp(rate / max(density, SLOPE_DENSITY), -cap, cap);
}

// For a layer whose light and view columns together change by `change` over the span, at rates (per
// metre) at its ends. Where the density changes much, the slope follows its logarithm: the thin end
// then counts for nothing and the dense one three times (sech^2 of half the change of the exponent,
// exact in both limits).
Bend layerBend(LayerPoint a, LayerPoint b, real rateA, real rateB, real column, real change) {
  bool grows = a.density < b.density;
  real ratio = grows ? a.density / b.density : b.density / a.density;
  real thin = real(4.0f) * ratio / ((real(1.0f) + ratio) * (real(1.0f) + ratio));
  real dense = real(3.0f) - real(2.0f) * thin;
  Bend bend;
  bend.near = (grows ? thin : dense) * (column * slopeOf(rateA, a.density, SLOPE_CAP) - change);
  bend.far = (grows ? dense : thin) * (column * slopeOf(rateB, b.density, SLOPE_CAP) - change);
  return bend;
}

// Depth by which the mean transmittance of a span differs from meanTransmittance, with the depth as
// a cubic of the span's column: mean of y (1 - y) (near (1 - y) - far y) weighted with e^(-rise y).
// The two moments by rational fits, exact to first order at rise = 0 and within 10 % anywhere. Cuts
// the median error of clear skies from 4e-4 to 1e-5 (sky_test.cpp).
const real BEND_RISE = real(1e15);
const real BEND_CAP = real(2.0f);
real bentDepth(real near, real far, real rise) {
  real x = min(abs(rise), BEND_RISE);
  real lit = rise > real(0.0f) ? near : -far;
  real hidden = rise > real(0.0f) ? -far : near;
  real x12 = real(12.0f) + real(1.2) * x;
  real a = x12 + real(0.2) * x * x;
  real b = x12 + real(0.45) * x * x;
  real depth = lit * ((real(1.0f) + real(0.2) * x) / a) + hidden / b;
  return clamp(depth, -BEND_CAP, BEND_CAP);
}

vec3 bentDepth3(vec3 near, vec3 far, vec3 rise) {
  return vec3(bentDepth(near.x, far.x, rise.x), bentDepth(near.y, far.y, rise.y),
              bentDepth(near.z, far.z, rise.z));
}

// e^-depth to second order and positive.
real bentTransmittance(real depth) {
  real e = real(1.0f) + abs(depth) * (real(1.0f) + real(0.5f) * abs(depth));
  return depth > real(0.0f) ? real(1.0f) / e : e;
}

vec3 bentTransmittance3(vec3 depth) {
  return vec3(bentTransmittance(depth.x), bentTransmittance(depth.y), bentTransmittance(depth.z));
}

// Twice the column, in m, by which another layer is in the mean ahead of even along a span of the
// first one: rateA and rateB are the other's change per metre of the first's column at the ends.
// Where they grow e^G-fold this is G/6 of the change for small G, all of it for large.
const real RATE_CAP = real(1e12);
const real RATE_FLOOR = real(1e-18);
real bulge(real rateA, real rateB, real column) {
  real growth = log(max(abs(rateA), RATE_FLOOR) / max(abs(rateB), RATE_FLOOR));
  return column * (rateA - rateB) / sqrt(real(36.0f) + growth * growth);
}

// Mean over a span of what is near, middle and far (as a parabola), where the light there grows
// e^growth-fold. Langevin's function of y = growth/2 as y / (1 + sqrt(4 + y^2)), within 3 %.
const real GROWTH_MOST = real(1e6);
vec3 meanVisibility(real near, real middle, real far, vec3 growth) {
  vec3 y = real(0.5f) * clamp(growth, vec3(-GROWTH_MOST), vec3(GROWTH_MOST));
  vec3 g = vec3(real(1.0f)) / (vec3(real(1.0f)) + sqrt(vec3(real(4.0f)) + y * y));
  real even = real(0.5f) * (near + far);
  vec3 mean = g * (y * (real(0.5f) * (far - near)) + vec3(real(2.0f) * (middle - even)));
  return clamp(mean + vec3(even), vec3(real(0.0f)), vec3(real(1.0f)));
}
