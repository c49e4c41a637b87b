// SPDX-License-Identifier: MIT
// Rays against boxes and the planet. Lengths in m; directions are unit vectors. The planet is met
// through the altitude h and h (2R + h), never r^2 - R^2: a float radius is only known to 0.5 m.

// Stretch [begin, end] of a ray; empty when end <= begin.
struct Span {
  real begin;
  real end;
};

// Smallest direction component that is divided by: 0 and -0 become this, so that no 0/0 arises;
// over 1e9 m it moves the ray by 1e-11 m.
const real DIRECTION_FLOOR = real(1e-20);

// Stretch t >= 0 of the ray inside the box. Touching a face from inside counts as inside.
Span rayBox(vec3 origin, vec3 direction, vec3 lo, vec3 hi) {
  real dx = abs(direction.x) < DIRECTION_FLOOR ? DIRECTION_FLOOR : direction.x;
  real dy = abs(direction.y) < DIRECTION_FLOOR ? DIRECTION_FLOOR : direction.y;
  real dz = abs(direction.z) < DIRECTION_FLOOR ? DIRECTION_FLOOR : direction.z;
  real x0 = (lo.x - origin.x) / dx;
  real x1 = (hi.x - origin.x) / dx;
  real y0 = (lo.y - origin.y) / dy;
  real y1 = (hi.y - origin.y) / dy;
  real z0 = (lo.z - origin.z) / dz;
  real z1 = (hi.z - origin.z) / dz;
  Span span;
  span.begin = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), real(0.0f)));
  span.end = min(min(max(x0, x1), max(y0, y1)), max(z0, z1));
  return span;
}

// h (2R + h) = r^2 - R^2 without cancellation. m^2.
real altitudePower(real altitude, real radius) {
  return altitude * (real(2.0f) * radius + altitude);
}

// Altitude at distance t >= 0 (finite, <= 1e15) along a ray that starts at `altitude` with cosine
// mu to the local up. Float error a few 1e-7 of max(altitude, |t mu|, t^2/2R).
real altitudeAlongRay(real altitude, real mu, real radius, real t) {
  real q = t * (real(2.0f) * (radius + altitude) * mu + t) + altitudePower(altitude, radius);
  return q / (sqrt(max(radius * radius + q, real(0.0f))) + radius);
}

// Cosine of the geometric horizon seen from altitude >= 0: -sqrt(h (2R + h)) / (R + h).
real horizonMu(real altitude, real radius) {
  return -sqrt(altitudePower(altitude, radius)) / (radius + altitude);
}

// Distance from outside to the sea-level sphere, -1 if the ray misses it; below sea level the
// origin counts as on it. The discriminant is r^2 (mu_h - mu)(-mu_h - mu): hit and miss are told
// apart by the horizon's cosine, which at eye height the usual discriminant gets wrong for 2 % of
// the rays near the horizon (Haines et al., Ray Tracing Gems ch. 7). From far away, where mu_h is
// close to -1, the discriminant is R^2 - r^2 (1 - mu^2) instead.
real groundDistance(real altitude, real mu, real radius) {
  real h = max(altitude, real(0.0f));
  real muHorizon = horizonMu(h, radius);
  real shrink = radius / (radius + h);
  real nearBy = (muHorizon - mu) * (-muHorizon - mu);
  real farOff = shrink * shrink - (real(1.0f) - mu) * (real(1.0f) + mu);
  real root = sqrt(max(h < radius ? nearBy : farOff, real(0.0f)));
  real t = altitudePower(h, radius) / ((radius + h) * (root - min(mu, -DIRECTION_FLOOR)));
  return mu < muHorizon ? t : real(-1.0f);
}
