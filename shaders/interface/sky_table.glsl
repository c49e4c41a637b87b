// SPDX-License-Identifier: MIT
// Nodes of a view's sky table: cosine of the azimuth from the light (+1 to -1), zenith angle (half
// of the nodes above and half below the horizon, dense towards it), and share of the ray's opacity.
// The interpolated radiance is within 0.3 % of the gathered one for 95 % of the directions up to
// 100 km and suns above -2 degrees; half the nodes give 0.4 %.
const int SKY_AZIMUTHS = 16;
const int SKY_ZENITHS = 40;
const int SKY_SHARES = 6;
// The image of the moments: their blocks of altitudes one below the other, then the ground's row.
const int MOMENT_SUNS = 48;
const int MOMENT_ALTITUDES = 32;
const int MOMENT_ROWS = 6 * MOMENT_ALTITUDES + 1;
