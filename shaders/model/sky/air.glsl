// SPDX-License-Identifier: MIT
// Air, one fog layer and a gas that absorbs on a spherical planet: rays through them, columns and
// optical depths, RGB. Air and fog are exponential in altitude. [R04] 4.1. Lengths in m.

struct Air {
  real planetRadius;
  vec3 airScattering;
  real airScaleHeight;
  real fogExtinction;
  real fogBaseAltitude;
  real fogScaleHeight;
  vec3 fogAlbedo;
  vec3 absorption;  // at the peak of its density
  real absorberPeak;
  real absorberWidth;  // from the peak to either end
};

// A ray at its origin: cosines of view and light with the local up and with each other.
struct AirRay {
  real altitude;
  real viewMu;
  real sunMu;
  real viewSun;
};

// Scale heights above the base after which a layer counts as ended: e^-30 of 1e6 optical depths.
const real LAYER_EXTENT = real(30.0f);
// Rays may go this far below the lower of sea level and origin before they are stopped, in m.
const real UNDERGROUND = real(1000.0f);

// The part of a ray inside the layers.
struct AirPath {
  real altitude;
  real viewMu;
  real sunMu;
  real viewSun;
  real reach;
  // Distance to the point nearest the planet's centre, and that point's radius.
  real lowest;
  real lowestRadius;
  AbsorberRay absorber;
};

// A point of a ray.
struct AirPoint {
  real distance;
  real altitude;
  LayerPoint air;
  LayerPoint fog;
  real absorber;  // column from the ray's lowest point, negative before it
};

// Area fraction of a disk of half angle `angularRadius` above the geometric horizon, 0..1: within
// 1.2e-3 of the circle's segment (odd polynomial of degree 5). The sine of the light's height above
// the horizon is (mu R + sqrt(h (2R + h)) sqrt(1 - mu^2)) / (R + h); above 90 degrees mu is larger.
const real DISK_1 = real(0.62970841);
const real DISK_3 = real(-0.06792375);
const real DISK_5 = real(-0.06178466);
const real SMALLEST_DISK = real(1e-5);
real lightVisibility(Air air, real altitude, real lightMu, real angularRadius) {
  real h = max(altitude, real(0.0f));
  real dip = sqrt(altitudePower(h, air.planetRadius));
  real sinus = sqrt(max((real(1.0f) - lightMu) * (real(1.0f) + lightMu), real(0.0f)));
  real height = (lightMu * air.planetRadius + dip * sinus) / (air.planetRadius + h);
  real x = max(height, lightMu) / max(angularRadius, SMALLEST_DISK);
  x = clamp(x, real(-1.0f), real(1.0f));
  real z = x * x;
  return clamp(real(0.5f) + x * (DISK_1 + z * (DISK_3 + z * DISK_5)), real(0.0f), real(1.0f));
}

// Moves the ray's origin to the top of the layers if it lies above, and ends the ray there or
// underground, so that every number that follows is finite. The surface is the caller's to clip.
AirPath clipToAir(Air air, AirRay ray, real distance) {
  real top = real(1.0f);
  if (AIR_ENABLED) {
    top = LAYER_EXTENT * air.airScaleHeight;
  }
  if (FOG_ENABLED) {
    real fogTop = max(air.fogBaseAltitude, real(0.0f)) + LAYER_EXTENT * air.fogScaleHeight;
    top = max(top, fogTop);
  }
  if (ABSORBER_ENABLED) {
    top = max(top, air.absorberPeak + air.absorberWidth);
  }
  real h = max(ray.altitude, real(-0.5f) * air.planetRadius);
  real radius = air.planetRadius + h;
  real topRadius = air.planetRadius + top;
  real lowest = radius * sqrt(max((real(1.0f) - ray.viewMu) * (real(1.0f) + ray.viewMu),
                                  real(0.0f)));
  bool above = h > top;
  bool reaches = !above || (ray.viewMu < real(0.0f) && lowest < topRadius);
  bool enters = above && reaches;
  // Entry: (r^2 - rt^2) / (r |mu| + rt |mu_t|), from above only.
  real chord = sqrt(max((topRadius - lowest) * (topRadius + lowest), real(0.0f)));
  real span = (h - top) * (radius + topRadius);
  real entry = enters ? span / (chord - radius * ray.viewMu) : real(0.0f);
  AirPath path;
  path.altitude = above ? top : h;
  path.viewMu = enters ? -chord / topRadius : ray.viewMu;
  path.sunMu = enters ? (radius * ray.sunMu + entry * ray.viewSun) / topRadius : ray.sunMu;
  path.sunMu = clamp(path.sunMu, real(-1.0f), real(1.0f));
  path.viewSun = ray.viewSun;
  path.lowestRadius = lowest;
  real r = air.planetRadius + path.altitude;
  real along = r * path.viewMu;
  path.lowest = -along;
  real leave = chord - along;
  leave = !above && along > real(0.0f) ? -span / (along + chord) : leave;
  real floorAltitude = min(path.altitude, real(0.0f)) - UNDERGROUND;
  real under = groundDistance(path.altitude - floorAltitude, path.viewMu,
                              air.planetRadius + floorAltitude);
  leave = under >= real(0.0f) ? under : leave;
  path.reach = reaches ? max(min(distance - entry, leave), real(0.0f)) : real(0.0f);
  if (ABSORBER_ENABLED) {
    path.absorber = absorberRay(path.altitude, along, air.planetRadius, air.absorberPeak,
                                air.absorberWidth);
  }
  return path;
}

AirPoint airPoint(Air air, AirPath path, real t) {
  AirPoint point;
  point.distance = t;
  point.altitude = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, t);
  real radius = air.planetRadius + point.altitude;
  real fromLowest = t - path.lowest;
  if (AIR_ENABLED) {
    point.air = layerPoint(point.altitude, real(0.0f), air.airScaleHeight, radius, fromLowest);
  }
  if (FOG_ENABLED) {
    point.fog = layerPoint(point.altitude, air.fogBaseAltitude, air.fogScaleHeight, radius,
                           fromLowest);
  }
  if (ABSORBER_ENABLED) {
    point.absorber = absorberColumn(path.absorber, fromLowest, air.planetRadius, air.absorberPeak,
                                    air.absorberWidth);
  }
  return point;
}

// Columns of air (x), fog (y) and absorber (z) from a point of a ray to the light, per unit
// extinction. m.
vec3 lightColumns(Air air, AirPoint point, real lightMu) {
  vec3 columns = vec3(real(0.0f));
  real radius = air.planetRadius + point.altitude;
  if (AIR_ENABLED) {
    columns.x = layerColumn(point.air.exponent, point.air.density, air.airScaleHeight, radius,
                            lightMu);
  }
  if (FOG_ENABLED) {
    columns.y = layerColumn(point.fog.exponent, point.fog.density, air.fogScaleHeight, radius,
                            lightMu);
  }
  if (ABSORBER_ENABLED) {
    columns.z = absorberColumnTo(point.altitude, lightMu, air.planetRadius, air.absorberPeak,
                                 air.absorberWidth);
  }
  return columns;
}

// Optical depth of columns without the absorber, RGB.
vec3 scatteringDepth(Air air, vec3 columns) {
  return air.airScattering * columns.x + vec3(air.fogExtinction * columns.y);
}

// Optical depth of columns, RGB.
vec3 depthOfColumns(Air air, vec3 columns) {
  vec3 depth = scatteringDepth(air, columns);
  if (ABSORBER_ENABLED) {
    depth = depth + air.absorption * columns.z;
  }
  return depth;
}

// Optical depth from `altitude` to the light, RGB. Below the horizon it grows smoothly up to
// opaque; lightVisibility says whether the planet is in the way.
vec3 lightOpticalDepth(Air air, real altitude, real lightMu) {
  AirPoint point;
  point.altitude = altitude;
  if (AIR_ENABLED) {
    point.air.exponent = layerExponent(altitude, real(0.0f), air.airScaleHeight);
    point.air.density = layerDensity(point.air.exponent);
  }
  if (FOG_ENABLED) {
    point.fog.exponent = layerExponent(altitude, air.fogBaseAltitude, air.fogScaleHeight);
    point.fog.density = layerDensity(point.fog.exponent);
  }
  return depthOfColumns(air, lightColumns(air, point, lightMu));
}

// What lies between two points of a ray.
struct AirSpan {
  LayerSpan air;
  LayerSpan fog;
  real absorber;  // column, m
};

vec3 columnsOf(AirSpan span) {
  return vec3(span.air.column, span.fog.column, span.absorber);
}

AirSpan airSpan(Air air, AirPath path, AirPoint a, AirPoint b) {
  real length = b.distance - a.distance;
  real radius = air.planetRadius + real(0.5f) * (a.altitude + b.altitude);
  real across = length * path.lowestRadius / radius;
  real sag = across * across / (real(8.0f) * radius);
  AirSpan span;
  span.air.column = real(0.0f);
  span.air.lean = real(0.0f);
  span.fog.column = real(0.0f);
  span.fog.lean = real(0.0f);
  span.absorber = real(0.0f);
  if (AIR_ENABLED) {
    span.air = layerSpan(a.air, b.air, air.airScaleHeight, length, sag);
  }
  if (FOG_ENABLED) {
    span.fog = layerSpan(a.fog, b.fog, air.fogScaleHeight, length, sag);
  }
  if (ABSORBER_ENABLED) {
    span.absorber = max(b.absorber - a.absorber, real(0.0f));
  }
  return span;
}

// Optical depth along a ray of `distance` m (may be infinite; the ground is the caller's to clip).
vec3 airOpticalDepth(Air air, AirRay ray, real distance) {
  AirPath path = clipToAir(air, ray, distance);
  AirPoint first = airPoint(air, path, real(0.0f));
  AirPoint middle = airPoint(air, path, clamp(path.lowest, real(0.0f), path.reach));
  AirPoint last = airPoint(air, path, path.reach);
  AirSpan before = airSpan(air, path, first, middle);
  AirSpan after = airSpan(air, path, middle, last);
  return depthOfColumns(air, columnsOf(before) + columnsOf(after));
}
