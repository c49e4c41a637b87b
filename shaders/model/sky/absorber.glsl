// SPDX-License-Identifier: MIT
// Columns of a gas that absorbs and does not scatter (ozone), per unit of its peak density. m.
// Around the planet its density rises linearly with altitude to 1 at the peak and falls linearly to
// 0: a tent, whose column along a ray is closed: with s the distance from the ray's point nearest
// the planet's centre and a the radius of a knot of the tent, r - a = (s^2 - q) / (r + a), where
// q = a^2 minus that point's radius squared is constant along the ray. r + a is taken as constant
// too: within 1e-5 of the column, or of the vertical one if that is more, for the Earth's ozone
// (tests/unit/absorber_test.cpp).

// Where a ray meets the layer: values of s, 0 where the whole ray lies above that knot.
struct AbsorberRay {
  real bottom;
  real peak;
  real top;
  // How far the ray's lowest point lies above bottom and peak: -q, at least 0. m^2.
  real overBottom;
  real overPeak;
};

// altitude and `along` = s of any one of its points.
AbsorberRay absorberRay(real altitude, real along, real radius, real peak, real halfWidth) {
  real square = along * along;
  real grow = real(2.0f) * radius + altitude;
  real bottom = max(peak - halfWidth, real(-0.5f) * radius);
  real top = peak + halfWidth;
  real q0 = square - (altitude - bottom) * (grow + bottom);
  real q1 = square - (altitude - peak) * (grow + peak);
  real q2 = square - (altitude - top) * (grow + top);
  AbsorberRay ray;
  ray.bottom = sqrt(max(q0, real(0.0f)));
  ray.peak = sqrt(max(q1, real(0.0f)));
  ray.top = sqrt(max(q2, real(0.0f)));
  ray.overBottom = max(-q0, real(0.0f));
  ray.overPeak = max(-q1, real(0.0f));
  return ray;
}

// Integral of r - a along the ray from the knot of radius a to s, three times; nothing below it.
// r + a is taken at the mean of r^2 - a^2, weighted with itself; either the knot or `over` is 0.
real absorberRamp(real s, real knot, real over, real a) {
  real beyond = max(s - knot, real(0.0f));
  real square = s * s;
  real whole = beyond * beyond * (s + real(2.0f) * knot) + real(3.0f) * over * s;
  real level = (square * (real(0.6) * square + real(2.0f) * over) + real(3.0f) * over * over) /
              max(square + real(3.0f) * over, real(1e-30));
  real steep = beyond *
               (beyond * (real(0.6) * beyond + real(3.0f) * knot) + real(4.0f) * knot * knot) /
               max(beyond + real(3.0f) * knot, real(1e-30));
  real mean = knot > real(0.0f) ? steep : level;
  return whole / (a + sqrt(a * a + mean));
}

// Column between the ray's lowest point and its point at s, signed like s.
real absorberColumn(AbsorberRay ray, real s, real radius, real peak, real halfWidth) {
  real reach = min(abs(s), ray.top);
  real middle = radius + peak;
  real a = max(middle - halfWidth, real(0.5f) * radius);
  real low = absorberRamp(reach, ray.bottom, ray.overBottom, a);
  real high = absorberRamp(reach, ray.peak, ray.overPeak, middle);
  real column = max(low - real(2.0f) * high, real(0.0f)) / (real(3.0f) * halfWidth);
  return s < real(0.0f) ? -column : column;
}

// From a point to infinity, with cosine mu to the up.
real absorberColumnTo(real altitude, real mu, real radius, real peak, real halfWidth) {
  real along = (radius + altitude) * mu;
  AbsorberRay ray = absorberRay(altitude, along, radius, peak, halfWidth);
  real all = absorberColumn(ray, ray.top, radius, peak, halfWidth);
  return max(all - absorberColumn(ray, along, radius, peak, halfWidth), real(0.0f));
}
